// Panels with a known morphology, made by hand instead of by pressing.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "strandlab/mat/mat.hpp"
#include "strandlab/panel/panel.hpp"
#include "support/strands.hpp"

namespace strandlab::test {

inline std::vector<StrandKind> osb_kinds() {
  wood::Material poplar;
  poplar.name = "poplar";
  return {{"surface", poplar, 0}, {"core", poplar, 90}};
}

// A reference mat as formed, material points 0.2667 mm along and 6 through each strand of 0.8 mm.
inline Panel<2> reference_panel(const std::string& name) {
  const std::string file = std::string(STRANDLAB_TEST_DATA) + "/reference/" + name + ".json";
  return make_panel(mat::read(file, {"surface", "core"}), osb_kinds(), 0.8 / 3, 6);
}

// One strand filling x0..x1, y0..y1.
inline Strand<2> flat_strand(double x0, double x1, double y0, double y1, int along, int through) {
  auto strand = strand_between<2>(wood::in_strand_axes(osb_kinds()[0].material, 0), Vec<2>(x0, y0), Vec<2>(x1, y1),
                                  {along, through});
  strand.kind = "surface";
  return strand;
}

inline Panel<2> panel_of(std::vector<Strand<2>> strands, double length_mm, double thickness_mm) {
  Panel<2> panel;
  panel.length_mm = length_mm;
  panel.initial_thickness_mm = panel.top_mm = thickness_mm;
  panel.strands = std::move(strands);
  return panel;
}

// x -> map(x), with gradient(x) = d map/d x applied to the deformation gradients.
template <class Map, class Gradient>
void deform(Strand<2>& strand, const Map& map, const Gradient& gradient) {
  for (std::size_t p = 0; p < strand.size(); ++p) {
    strand.points.F[p] = gradient(strand.points.x[p]) * strand.points.F[p];
    strand.points.x[p] = map(strand.points.x[p]);
  }
}

// Flattens everything to (1 - compaction) of its height.
inline void compact(Panel<2>& panel, double compaction) {
  const double f = 1 - compaction;
  for (auto& strand : panel.strands) {
    deform(
        strand, [f](const Vec<2>& x) { return Vec<2>(x[0], f * x[1]); },
        [f](const Vec<2>&) {
          return Tensor<2>{{1, 0}, {0, f}};
        });
  }
  panel.bottom_mm *= f;
  panel.top_mm *= f;
}

// y -> y + A sin(2 pi x/wavelength) sin(pi y/h): waves that die out at the platens.
inline void undulate(Panel<2>& panel, double amplitude_mm, double wavelength_mm) {
  const double a = amplitude_mm, k = 2 * std::numbers::pi / wavelength_mm, q = std::numbers::pi / panel.thickness_mm();
  for (auto& strand : panel.strands) {
    deform(
        strand, [=](const Vec<2>& x) { return Vec<2>(x[0], x[1] + a * std::sin(k * x[0]) * std::sin(q * x[1])); },
        [=](const Vec<2>& x) {
          return Tensor<2>{
              {1, 0},
              {a * k * std::cos(k * x[0]) * std::sin(q * x[1]), 1 + a * q * std::sin(k * x[0]) * std::cos(q * x[1])}};
        });
  }
}

}  // namespace strandlab::test
