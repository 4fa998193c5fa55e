// Short mats between free sides: strands are squeezed out beside the mat, some with speed and whole; the pressing goes
// on.
#include <gtest/gtest.h>

#include <algorithm>

#include "strandlab/mat/form.hpp"
#include "strandlab/press/press.hpp"
#include "support/report.hpp"

namespace strandlab::press_tests {
namespace {

constexpr double kLength = 20;  // mm, far shorter than a surface strand

// The rows of the OSB of the main job (5 of surface strands, 10 of core strands, 5 of surface strands).
Panel<2> osb(std::uint64_t seed, const press::Resolution& resolution) {
  mat::Layup layup;
  layup.length_mm = kLength;
  for (int row = 0; row < 20; ++row) {
    const bool core = row >= 5 && row < 15;
    layup.rows.push_back(
        {core ? "core" : "surface", core ? mat::StrandStatistics{25, 3, 10, 1} : mat::StrandStatistics{}});
  }
  const auto& poplar = wood::library().front();
  const double cell = layup.layer_thickness_mm / resolution.cells_through_strand;
  return make_panel(mat::form(layup, seed), {{"surface", poplar, 0}, {"core", poplar, 90}},
                    cell * resolution.cell_aspect / 2, 2 * resolution.cells_through_strand);
}

// Presses to 40 % between free sides and returns how far beyond the mat's ends its wood then reaches, mm.
double press_and_reach(std::uint64_t seed, const press::Resolution& resolution) {
  const auto mat = osb(seed, resolution);
  press::Schedule schedule;
  schedule.compactions = {0.4};
  double reach = 0;
  press::Sink<2> sink;
  sink.snapshot = [&reach](const Panel<2>& panel, int) {
    for (const auto& strand : panel.strands) {
      for (const auto& x : strand.points.x) reach = std::max({reach, -x[0], x[0] - kLength});
    }
  };
  press::press<2>(mat, schedule, press::setup(mat, resolution, mpm::Side::kFree, mpm::Options{}), sink);
  return reach;
}

double furthest(int seeds, const press::Resolution& resolution) {
  double reach = 0;
  for (int seed = 1; seed <= seeds; ++seed) reach = std::max(reach, press_and_reach(seed, resolution));
  return reach;
}

// The room beside the mat is its length: what no strand can exceed that is only pushed out whole.
TEST(FreeSides, LetStrandsOfShortMatsGoNightly) {
  press::Resolution resolution;
  resolution.cell_aspect = 1.5;
  const double reach = furthest(24, resolution);
  report("24 OSB mats of 20 mm between free sides, pressed to 40 %: wood reaches beyond the ends by at most, mm", reach,
         "< 20");
  EXPECT_LT(reach, kLength);
}

}  // namespace
}  // namespace strandlab::press_tests
