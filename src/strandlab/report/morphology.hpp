// The shape of a pressed panel in numbers: how far strands undulate and thin, how much they overlap, how much is void.
#pragma once

#include <string>
#include <vector>

#include "strandlab/files/csv.hpp"
#include "strandlab/panel/panel.hpp"

namespace strandlab::report {

// Shares of the strands' wood (volume at formation) by the value of a quantity.
struct Histogram {
  std::string quantity;          // name with unit: "grain_angle_deg", "strand_thickness_strain"
  std::vector<double> edges;     // bins + 1, equally wide
  std::vector<double> fraction;  // per bin; they sum to 1
  double mean = 0, sd = 0, lowest = 0, highest = 0;
};

// A histogram's quantity in the words of charts.
struct QuantityWords {
  std::string title, axis;  // "Grain angle", "grain angle against the panel, °"
  double factor = 1;        // of values on the axis over those in the tables
};
// Throws std::invalid_argument for a quantity that no histogram here has.
QuantityWords words_of(const std::string& quantity);

// Values outside low..high count in the first or last bin. Throws std::invalid_argument for no bins or high <= low.
Histogram histogram(std::string quantity, const std::vector<double>& values, const std::vector<double>& weights,
                    double low, double high, int bins);

// Angle of the strands' long axis against the panel's plane, at each material point: bins of 1 degree around 0, to
// +-90.5.
Histogram grain_angle_histogram(const Panel<2>& panel);
// Strain of the strands' thickness, t/t0 - 1 with t perpendicular to the strand, mean over the points through the
// thickness at each place along it: bins of 0.02 around 0, -0.91..1.01.
Histogram thickness_strain_histogram(const Panel<2>& panel);

// Areas over the area between the platens in the window 0..length. Strands are the polygons of their corner lattices;
// overlaps are the exact intersections of these polygons.
struct Areas {
  double strands = 0;                  // all strands, inside the window and between the platens
  double overlap = 0;                  // sum over all pairs of strands
  double largest_overlap = 0;          // of one pair
  int overlap_a = -1, overlap_b = -1;  // that pair, order in the panel; -1 when no strands overlap
  double outside = 0;                  // of strands that stick out of the window or into the platens
  double void_fraction() const { return 1 - strands + overlap; }  // where three strands meet, one too many is taken off
};
Areas areas(const Panel<2>& panel);

// Sum of overlaps over the section that drawing strands as cells with straight edges explains: OSB
// pressed to 40 % has .0064 (tests/verification/report/overlap_test.cpp).
inline constexpr double kExplainedOverlap = 0.01;

struct Morphology {
  double compaction = 0;          // that was asked for: the state's name in every table
  double compaction_reached = 0;  // of the panel, up to a time step beyond
  Histogram grain_angle, thickness_strain;
  Areas areas;
};
Morphology morphology(const Panel<2>& panel, double compaction);

// One row per state: compaction, compaction_reached, overlap_fraction, largest_overlap_fraction, void_fraction,
// outside_fraction and mean, sd, lowest and highest of both quantities.
files::CsvTable morphology_table(const std::vector<Morphology>& states);
// One row per state, quantity and bin: compaction, quantity, from, to, fraction.
files::CsvTable histogram_table(const std::vector<Morphology>& states);

}  // namespace strandlab::report
