#include "strandlab/case/estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

#include "strandlab/case/hotpress.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/core/free_memory.hpp"
#include "strandlab/mat/cut.hpp"

namespace strandlab::cases {
namespace {

// Costs as measured on the reference machine (docs/performance.md).
constexpr double kNsPerParticleStep = 80;         // one thread, mean over a pressing to 40 %
constexpr double kSpeedUpPerThread = 0.7;         // of each further thread
constexpr double kHotCost = 1.4;                  // of wood that heat softens, over that
constexpr double kHotRamps = 1.2;                 // ramps are longer
constexpr double kSettlings = 87;                 // transits of waves through cold wood in which a hot mat settles
constexpr double kHotSteps = 1.45;                // steps get shorter as the mat is crushed
constexpr double kBytesPerParticle = 2500;        // of a whole run at its largest, tests included
constexpr double kLeastBytes = 700;               // of them, without which not even a pressing goes
constexpr double kBytesPerStrand = 2000;          // in the mat, its text, the panel and the engine
constexpr double kStoredBytesPerParticle = 250;   // of one state: HDF5 and ParaView
constexpr double kFrameBytes = 4e7;               // all frames of the pressing: 41 coarse panels of 8000 cells
constexpr double kSolveSecondsPerElement = 1e-5;  // of virtual tests, per 1/D_t and element
constexpr double kGapSolves = 3;                  // how much the moduli hang on glue.max_gap_mm
constexpr double kSolveExponent = 1.2;            // sparse Cholesky in two dimensions
constexpr double kElementsAtReference = 1e5;

double memory_bytes(double particles) {
  return particles * kBytesPerParticle + 5e7;
}

void refuse_too_large(double length_mm, double strands, double particles) {
  const double needed = particles * kLeastBytes + strands * kBytesPerStrand, free = free_memory_bytes();
  if (needed < free) return;
  throw InputError(
      fmt::format("the panel of {} mm would have {:.3g} strands and {:.3g} particles and need {:.3g} MB of memory, of "
                  "which {:.3g} MB are free; shorten mat.length_mm, lower grid.cells_through_strand or lengthen the "
                  "strands",
                  length_mm, strands, particles, needed / 1e6, free / 1e6));
}

// Shortest time (s) in which a wave passes a cell, over all strands and both axes.
double transit_time(const Panel<2>& panel, double cell_length, double cell_height) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const auto& strand : panel.strands) {
    const double specific = strand.stiffness_factor / strand.material.density;
    const double along = std::sqrt(strand.material.stiffness(0, 0) * specific);
    const double through = std::sqrt(strand.material.stiffness(2, 2) * specific);
    shortest = std::min({shortest, cell_length / along, cell_height / through});
  }
  return shortest;
}

// Elements of the virtual tests: as many through the thinnest strand as the case says.
double elements(const Case& c, const Panel<2>& panel) {
  const double thinnest = thinnest_strand(panel);
  double count = 0;
  for (const auto& strand : panel.strands) {
    const double length = strand.lattice.extent(0);
    const int through = mat::through(strand.lattice.thickness(), thinnest, c.test.elements_through_strand);
    count += through * length / (thinnest / c.test.elements_through_strand);  // as long as they are thick
  }
  return count;
}

// Of the engine, s: the press closes, then the mat settles again and again (hotpress/strands.cpp).
double hot_pressing_time(double closing_s, const Panel<2>& panel) {
  double slowest = 0, solid = 0;
  for (const auto& strand : panel.strands) {
    slowest = std::max(slowest, std::sqrt(strand.material.density / strand.material.stiffness(2, 2)));
    solid += strand.lattice.point_volume() * static_cast<double>(strand.size()) / panel.length_mm;
  }
  return kHotRamps * closing_s + kSettlings * slowest * solid;
}

}  // namespace

double particle_count(const Case& c, const mat::Mat& mat) {
  const int through = c.grid.cells_through_strand * kPointsPerCell;
  const double thinnest = mat::thinnest_layer(mat);
  const double spacing = thinnest / through * c.grid.cell_aspect;
  double points = 0;
  for (std::size_t i = 0; i < mat.layers.size(); ++i) {
    double length = 0;
    for (const auto& strand : mat.layers[i].strands) length += strand.x1_mm - strand.x0_mm;
    points += mat::through(mat.thickness_of(i), thinnest, through) * length / spacing;
  }
  return points;
}

void refuse_too_large(const Case& c, const mat::Mat& mat) {
  double strands = 0;
  for (const auto& layer : mat.layers) strands += static_cast<double>(layer.strands.size());
  refuse_too_large(mat.length_mm, strands, particle_count(c, mat));
}

void refuse_too_large(const Case& c, const mat::Layup& layup) {
  double thinnest = std::numeric_limits<double>::infinity();
  for (const auto& row : layup.rows) thinnest = std::min(thinnest, row.thickness_mm.value_or(layup.layer_thickness_mm));
  const int through = c.grid.cells_through_strand * kPointsPerCell;
  const double spacing = thinnest / through * c.grid.cell_aspect;
  double strands = 0, particles = 0;
  for (const auto& row : layup.rows) {
    const auto s = mat::in_section(row.statistics, row.angles.value_or(mat::AngleDistribution{}));
    const double cycle = s.length_mm + s.gap_mm;
    const bool filled = !(s.length_mm > 0);
    const double thickness = row.thickness_mm.value_or(layup.layer_thickness_mm);
    strands += filled ? 1 : layup.length_mm / cycle;
    particles +=
        mat::through(thickness, thinnest, through) * layup.length_mm / spacing * (filled ? 1 : s.length_mm / cycle);
  }
  // Half of it, so that a mat is judged by itself wherever chance could decide.
  refuse_too_large(layup.length_mm, strands / 2, particles / 2);
}

int thread_count(const Case& c) {
  return c.threads > 0 ? c.threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

Estimate estimate(const Case& c, const Panel<2>& panel) {
  Estimate e;
  e.strands = panel.strands.size();
  for (const auto& strand : panel.strands) e.particles += strand.size();
  e.cell_height_mm = thinnest_strand(panel) / c.grid.cells_through_strand;
  e.cell_length_mm = e.cell_height_mm * c.grid.cell_aspect;
  e.cells = static_cast<std::size_t>(std::ceil(panel.length_mm / e.cell_length_mm) *
                                     std::ceil(panel.initial_thickness_mm / e.cell_height_mm));
  e.time_step_s = c.mpm.courant * transit_time(panel, e.cell_length_mm, e.cell_height_mm);
  const double travel_mm = panel.initial_thickness_mm * c.schedule.compactions.back();
  e.pressing_time_s = travel_mm / (1e3 * c.schedule.speed_m_s) / (1 - c.schedule.ramp_time_fraction / 2);
  if (presses_hot(c)) e.pressing_time_s = hot_pressing_time(e.pressing_time_s, panel);
  e.steps = std::ceil(e.pressing_time_s / e.time_step_s * (presses_hot(c) ? kHotSteps : 1));

  const auto n = static_cast<double>(e.particles);
  const auto states = static_cast<double>(c.schedule.compactions.size());
  const double speed_up = 1 + kSpeedUpPerThread * (thread_count(c) - 1);
  e.memory_bytes = memory_bytes(n);
  e.disk_bytes = n * kStoredBytesPerParticle * (states + 2) + kFrameBytes + 1e7;
  const double ns = kNsPerParticleStep * (presses_hot(c) ? kHotCost : 1);
  e.press_s = n * e.steps * ns * 1e-9 / speed_up;
  const double element_count = elements(c, panel);
  const double solves = states * (static_cast<double>(c.test.compliance_t_mm_per_MPa.size()) + kGapSolves);
  e.test_s = solves * element_count * kSolveSecondsPerElement *
             std::pow(element_count / kElementsAtReference, kSolveExponent - 1);
  return e;
}

}  // namespace strandlab::cases
