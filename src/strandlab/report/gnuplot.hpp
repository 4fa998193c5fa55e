// Line plots and histograms by gnuplot. Used by plots.cpp.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "strandlab/report/paper.hpp"

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

// The gnuplot program text of a plot that prints a picture to its standard output: a PNG, or for paper, without a
// title, what the paper says. Curves keep their colour from the first (dark) to the last (light) of a sequential map.
std::string gnuplot_script(const Plot& plot, const std::optional<Paper>& paper = std::nullopt);

// What draws, and how long it may take: plots take a tenth of a second each, a gnuplot that waits for something is
// ended.
struct Gnuplot {
  std::string program = "gnuplot";
  double limit_s = 60;
};

// A gnuplot program that prints one picture to its standard output (PNG, PDF or SVG), and the file of that picture.
struct Script {
  std::string text;
  std::filesystem::path file;
};

struct Drawn {
  std::vector<std::filesystem::path> pictures;
  std::vector<std::string> warnings;  // sentences for the log on those that are missing
};

// Runs all programs in one gnuplot, whose start takes longer than a plot, and replaces each file atomically by its
// picture. A mistake costs its own picture only. Throws as files::write_atomically(), and RunError where the system has
// no pipes left.
[[nodiscard]] Drawn draw_scripts(const std::vector<Script>& scripts, const Gnuplot& gnuplot = {});

// A plot and the file of its picture.
struct Picture {
  Plot plot;
  std::filesystem::path file;
};

// The same for plots; one whose curves have no points is not drawn, and its sentence says so.
[[nodiscard]] Drawn draw(const std::vector<Picture>& pictures, const Gnuplot& gnuplot = {},
                         const std::optional<Paper>& paper = std::nullopt);

}  // namespace strandlab::report
