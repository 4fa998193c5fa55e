// Pictures of a panel's section, strands coloured by grain angle or by density.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "strandlab/panel/panel.hpp"
#include "strandlab/report/paper.hpp"

namespace strandlab::report {

enum class Colouring { kGrainAngle, kDensity };

struct ColourRange {
  double low = 0, high = 1;  // degrees or kg/m^3; values outside take the end colours
};

// A range that suits all these panels, with round ends: symmetric about 0 and 30 degrees at most for angles (diverging
// map), from the lightest to the densest wood for densities; the extreme 2 % of the wood may fall outside.
ColourRange common_range(const std::vector<const Panel<2>*>& panels, Colouring colouring);

struct PictureOptions {
  Colouring colouring = Colouring::kGrainAngle;
  std::optional<ColourRange> range;  // else common_range() of the one panel
  std::string title;                 // else "<percent> % compaction"
  int width_px = 2000;               // 400..20000
  double vertical_exaggeration = 1;  // > 0
  std::optional<Paper> paper{};      // for paper: PDF, SVG or PNG of its width and font in place of the pixels
};

// Writes a PNG, or what the paper says: strands cell by cell with thin outlines, platens, axes in mm, colour bar with
// its unit. All states of a run get the same extent (window length x thickness as formed), so that pictures can be
// flipped through. Throws InputError for options out of range, else as files::write_atomically().
void draw_section(const Panel<2>& panel, const PictureOptions& options, const std::filesystem::path& file);

}  // namespace strandlab::report
