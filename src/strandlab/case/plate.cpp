#include "strandlab/case/plate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "strandlab/case/estimate.hpp"
#include "strandlab/case/plate_mat.hpp"
#include "strandlab/core/error.hpp"

namespace strandlab::cases {
namespace {

std::string opening(const Case& c) {
  if (c.mat_file.empty()) return c.places.rows.empty() ? c.name : c.places.rows;
  return c.places.mat_file.empty() ? c.mat_file : fmt::format("{}: {}", c.places.mat_file, c.mat_file);
}

// Costs per material point as measured (docs/performance.md).
constexpr double kNsPerParticleStep3 = 220;        // one thread
constexpr double kSpeedUpPerThread3 = 0.7;         // of each further thread
constexpr double kBytesPerParticle3 = 1800;        // of a pressing: engine, grid and copies of the panel
constexpr double kStoredBytesPerParticle3 = 1100;  // of one state: HDF5 and ParaView
constexpr double kMeanCellHeight = 0.85;           // over a pressing, of that at the start
constexpr double kStepFactor = 1.2;                // of strands under stress, whose waves are faster

double thinnest_plate_layer(const mat::PlateMat& mat) {
  double thinnest = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < mat.layers.size(); ++i) thinnest = std::min(thinnest, mat.thickness_of(i));
  return thinnest;
}

// Of a message about the mat: where it is from.
template <class Make>
auto about_plate(const Case& c, const Make& make) {
  try {
    return make();
  } catch (const InputError& e) {
    throw InputError(fmt::format("{}: {}", opening(c), e.what()));
  }
}

}  // namespace

bool has_plate_mat(const Case& c) {
  return is_plate(c) || (!c.mat_file.empty() && mat::dimensions(c.mat_file) == 3);
}

mat::PlateMat make_plate_mat(const Case& c) {
  if (presses_hot(c)) {
    throw InputError(fmt::format(
        "{}: plates are pressed cold: leave out [hotpress], or give hotpress.mechanics = \"column\"", c.name));
  }
  return make_plate(c).mat;
}

Weight weigh(const Case& c, const mat::PlateMat& mat) {
  return about_plate(c, [&] { return strandlab::weigh(mat, kinds_and_materials(c)); });
}

double density_kg_m3(const Case& c, const mat::PlateMat& mat, double compaction) {
  return weigh(c, mat).kg_per_m2 / (1e-3 * mat.thickness_mm() * (1 - compaction));
}

void settle_states(Case& c, const mat::PlateMat& mat) {
  settle_states(c, density_kg_m3(c, mat, 0), mat.thickness_mm());
}

bool is_pressed(const Case& c) {
  return c.schedule.compactions.back() > 0;
}

Panel<3> make_panel(const Case& c, const mat::PlateMat& mat) {
  const auto make = [&](double spacing_mm, int through) {
    return about_plate(c, [&] { return strandlab::make_panel(mat, kinds_and_materials(c), spacing_mm, through); });
  };
  if (!is_pressed(c)) return make(c.test.element_length_mm, c.test.elements_through_strand);
  const double cell = thinnest_plate_layer(mat) / c.grid.cells_through_strand * c.grid.cell_aspect;
  return make(cell / kPointsPerCell, c.grid.cells_through_strand * kPointsPerCell);
}

mpm::Side press_sides(const Case& c, const mat::PlateMat& mat) {
  return mat.sides == mat::PlateSides::kPeriodic ? mpm::Side::kPeriodic : c.sides;
}

// Steps: the time of the pressing over that in which a wave through a strand crosses a cell. At an aspect of 3 and more
// waves along the strands are no faster.
PlatePressSize press_size(const Case& c, const Panel<3>& panel) {
  PlatePressSize size;
  double fastest = 0;
  for (const auto& strand : panel.strands) {
    size.particles += strand.size();
    const auto& stiffness = strand.material.stiffness;
    const double along = std::sqrt(stiffness(0, 0) / strand.material.density) / c.grid.cell_aspect;
    fastest = std::max({fastest, along, std::sqrt(stiffness(2, 2) / strand.material.density)});
  }
  const double travel_mm = panel.initial_thickness_mm * c.schedule.compactions.back();
  const double time_s = travel_mm / (1e3 * c.schedule.speed_m_s) / (1 - c.schedule.ramp_time_fraction / 2);
  const double cell = kMeanCellHeight * thinnest_strand(panel) / c.grid.cells_through_strand;
  size.steps = std::ceil(kStepFactor * time_s * fastest / (c.mpm.courant * cell));
  const auto n = static_cast<double>(size.particles);
  size.memory_bytes = n * kBytesPerParticle3 + 5e7;
  size.disk_bytes = n * kStoredBytesPerParticle3 * (static_cast<double>(c.schedule.compactions.size()) + 2) + 1e6;
  size.press_s = n * size.steps * kNsPerParticleStep3 * 1e-9 / (1 + kSpeedUpPerThread3 * (thread_count(c) - 1));
  return size;
}

vtest::PlateOptions plate_options(const Case& c) {
  vtest::PlateOptions options;
  options.compliance_t_mm_per_MPa = c.test.compliance_t_mm_per_MPa;
  options.compliance_n_mm_per_MPa = c.test.compliance_n_mm_per_MPa;
  options.elements_through_strand = c.test.elements_through_strand;
  options.element_length_mm = c.test.element_length_mm;
  if (c.test.curing.coverage.spot_mm > 0)
    throw InputError("glue.spot_mm: spots of resin are laid on sections only; leave it at 0 for a mat in 3D");
  options.curing = c.test.curing;
  return options;
}

}  // namespace strandlab::cases
