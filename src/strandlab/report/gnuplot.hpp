// Line plots and histograms by gnuplot. Used by plots.cpp.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace strandlab::report {

struct Curve {
  std::string name;  // in the key; empty: none
  std::vector<double> x, y;
};

// Drawn behind the curve of the same number, in its colour made light.
struct Band {
  std::vector<double> x, low, high;
};

enum class CurveStyle { kLines, kLinesAndPoints, kSteps };

struct Plot {
  std::string title, x_label, y_label;
  std::string key_title;
  CurveStyle style = CurveStyle::kLines;
  double x_low = 0, x_high = 1;  // ends of the axis; y starts at 0
  std::vector<Curve> curves;
  // What the curves are compared with: dashed dark lines over them, a mark where there is only one point. An empty name
  // continues the reference before it: the same dashes, no further entry in the key.
  std::vector<Curve> references;
  std::vector<Band> bands{};  // none, or one for each curve (which may be empty)
};

// The gnuplot program text of a plot that prints a PNG to its standard output. Curves keep their colour from the first
// (dark) to the last (light) of a sequential map.
std::string gnuplot_script(const Plot& plot);

// What draws, and how long it may take: a plot takes a second, a gnuplot that waits for something is ended.
struct Gnuplot {
  std::string program = "gnuplot";
  double limit_s = 60;
};

// Runs a gnuplot program that prints a PNG to its standard output and replaces `png` atomically by it. Returns a
// sentence for the log where gnuplot is missing, fails or takes too long; throws as files::write_atomically(), and
// RunError where the system has no pipes left.
std::optional<std::string> draw_script(const std::string& script, const std::filesystem::path& png,
                                       const Gnuplot& gnuplot = {});

// The same for a plot; nothing is drawn, and the sentence says so, where its curves have no points.
std::optional<std::string> draw(const Plot& plot, const std::filesystem::path& png, const Gnuplot& gnuplot = {});

}  // namespace strandlab::report
