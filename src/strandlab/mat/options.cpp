#include "strandlab/mat/options.hpp"

#include <algorithm>

#include "strandlab/mat/mat.hpp"

namespace strandlab::mat {
namespace {

template <class Choice>
Declaration<PlateLayup> declare_named(const std::string& name, const std::string& help, Choice PlateLayup::*member,
                                      const std::vector<std::string>& names) {
  return declare_choice(
      name, help, member, names, [&names](Choice choice) { return names[static_cast<std::size_t>(choice)]; },
      [&names](const std::string& text) {
        return static_cast<Choice>(std::find(names.begin(), names.end(), text) - names.begin());
      });
}

}  // namespace

std::vector<Declaration<StrandStatistics>> statistics_options() {
  using S = StrandStatistics;
  const Range size_or_zero{.lo = kSmallestSize_mm, .hi = kLargestSize_mm, .zero = true};
  return {declare("length_mm", "mm", size_or_zero,
                  "mean length of a strand: in the section, or of the whole strand when width_mm is given; 0 with gap "
                  "0: one strand fills the row; 3D: of the whole strand, 150 with sd 0 unless given",
                  &S::length_mm),
          declare("length_sd_mm", "mm", kNotNegative, "its standard deviation, at most the mean", &S::length_sd_mm),
          declare("width_mm", "mm", size_or_zero,
                  "mean width of a strand, of which a section then shows what its angle lets it, the width of one that "
                  "lies across; 0: length_mm is what the section shows; 3D: 25 unless given",
                  &S::width_mm),
          declare("width_sd_mm", "mm", kNotNegative, "its standard deviation, at most the mean", &S::width_sd_mm),
          declare("gap_mm", "mm", {.lo = 0, .hi = kLargestSize_mm}, "mean gap between strands of a row", &S::gap_mm),
          declare("gap_sd_mm", "mm", kNotNegative, "its standard deviation, at most the mean", &S::gap_sd_mm)};
}

std::vector<Declaration<PlateLayup>> plate_options() {
  using P = PlateLayup;
  using S = SequentialOptions;
  const auto sequential = [](const Declaration<S>& option) {
    return within<P>(
        [](auto& layup) -> auto& { return layup.sequential; }, option);
  };
  return {declare("width_mm", "mm", {.lo = kSmallestSize_mm, .hi = 1e5, .zero = true},
                  "width of a plate (3D); the key makes a 3D case (docs/panels3d.md); 0: a section", &P::width_mm),
          declare_named("forming",
                        "3D: flat layers of strands that do not overlap (random sequential addition), or strands laid "
                        "anywhere, each draped on those below",
                        &P::stack, stack_names()),
          declare_named("sides", "3D: the window repeats in x and y, or strands along x and y are cut at it", &P::sides,
                        plate_side_names()),
          sequential(declare("in_layer_gap_mm", "mm", kNotNegative, "3D: least distance of the strands of a layer",
                             &S::in_layer_gap_mm)),
          sequential(declare("rsa_failures", "", {.lo = 1, .hi = 1e7},
                             "3D: a layer ends when so many strands in a row have found no place", &S::rsa_failures)),
          sequential(declare("keep_angle", "", kAny,
                             "3D: a strand that finds no place is tried elsewhere, in place of another strand",
                             &S::keep_angle)),
          declare("drape_slopes", "", {.lo = 0, .hi = 10},
                  "3D: steepest slopes of a draped strand, along and across it", &P::drape_slopes)};
}

std::vector<Declaration<SizeStatistics>> size_options() {
  using S = SizeStatistics;
  const Range size{.lo = kSmallestSize_mm, .hi = kLargestSize_mm};
  return {declare("length_mm", "mm", size, "mean length of a strand", &S::length_mm),
          declare("length_sd_mm", "mm", kNotNegative, "its standard deviation, at most the mean", &S::length_sd_mm),
          declare("width_mm", "mm", size, "3D: mean width of a strand", &S::width_mm),
          declare("width_sd_mm", "mm", kNotNegative, "3D: its standard deviation, at most the mean", &S::width_sd_mm)};
}

}  // namespace strandlab::mat
