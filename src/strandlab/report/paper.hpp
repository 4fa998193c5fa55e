// How a picture is set for paper.
#pragma once

#include <string>

namespace strandlab::report {

enum class PaperFormat { kPdf, kSvg, kPng };

inline constexpr double kPaperDpi = 300;  // of PNG

struct Paper {
  PaperFormat format = PaperFormat::kPdf;
  double width_mm = 84;  // of a column of most journals
  std::string font = "sans";
  double font_pt = 8;
};

}  // namespace strandlab::report
