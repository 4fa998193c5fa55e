// Mats of turned strands for the press tests, and their stress at a compaction.
#pragma once

#include <string>
#include <vector>

#include "verification/press/stacks.hpp"

namespace strandlab::press_tests {

inline constexpr double kLayer = 0.8;  // mm

// A strand in plan, in a layer 0.8 mm thick.
struct Plank {
  int layer = 0;
  double cx = 0, cy = 0, length = 0, width = 0;  // mm
  double angle_deg = 0;
};

inline Panel<3> panel_of(const std::vector<Plank>& planks, const Vec<2>& window, double spacing, bool yields = true) {
  Panel<3> panel;
  panel.length_mm = window[0];
  panel.depth_mm = window[1];
  panel.periodic = true;
  for (const auto& p : planks) {
    const int along = divisions(p.length, spacing), across = divisions(p.width, spacing);
    const Lattice<3> lattice{{along, across, 6}, {p.length / along, p.width / across, kLayer / 6}};
    auto strand = formed_strand<3>(lattice, turned(lattice, {p.cx, p.cy, (p.layer + 0.5) * kLayer}, p.angle_deg),
                                   wood::in_strand_axes(poplar(yields), 0));
    strand.kind = "surface";
    strand.row = p.layer;
    strand.angle_deg = p.angle_deg;
    panel.strands.push_back(std::move(strand));
    panel.initial_thickness_mm = std::max(panel.initial_thickness_mm, (p.layer + 1) * kLayer);
  }
  panel.top_mm = panel.initial_thickness_mm;
  return panel;
}

// Three layers of turned strands on a torus of 12 mm, one of them across an edge and one across a corner.
inline std::vector<Plank> turned_planks() {
  return {{0, 4, 3, 10, 4, 10}, {0, 7, 9, 10, 5, -5},  {1, 2, 5, 10, 4, 80},
          {1, 8, 9, 10, 5, 97}, {2, 11, 11, 9, 4, 20}, {2, 6, 5, 9, 4, 33}};
}

// Mean stress of the records about a compaction, MPa.
inline double stress_about(const std::vector<press::Record>& records, double compaction, double to_either_side) {
  double sum = 0;
  int count = 0;
  for (const auto& r : records) {
    if (std::abs(r.compaction - compaction) > to_either_side) continue;
    sum += r.stress_MPa;
    ++count;
  }
  return sum / count;
}

}  // namespace strandlab::press_tests
