// A plate ready to be tested: everything that does not depend on the glue, and the plate glued by one bond.
#pragma once

#include <functional>
#include <vector>

#include "strandlab/statics/plate.hpp"
#include "strandlab/vtest/plate.hpp"

namespace strandlab::vtest {

struct PlateModel {
  Vec<2> window = Vec<2>::Zero();    // mm, along x and y
  double thickness = 0, bottom = 0;  // mm: platen gap, height of the lower platen
  double max_gap = 0;                // mm, between faces that are glued
  statics::Mesh<3> mesh;
  std::vector<glue::GluePoint<3>> points;  // of strands that are kept
  statics::BondedPanel<3> bonded;
  double middle() const { return bottom + 0.5 * thickness; }
  double volume() const { return window.prod() * thickness; }  // mm^3, gaps included
};

// Cures and meshes the panel; fills what of the result depends on no glue. Throws as measure().
PlateModel make_plate_model(const Panel<3>& panel, const PlateOptions& options, PlateResult& result);

// Supports of nothing yet.
statics::Supports no_supports(const PlateModel& model);
// A load case of nothing.
statics::LoadCase no_load(const PlateModel& model);

// A test carried out on a model that is glued: adds its moduli, and a tensor where it finds one. Compliances are filled
// in by measure().
struct Solver {
  statics::SolveTimes& times;
  const std::function<void()>& before_solve;
};
void test_torus(PlateModel& model, const statics::PlateLoads& loads, const Solver& solver, PlateResult& result);
void test_glued_plates(PlateModel& model, const Solver& solver, PlateResult& result);
void test_plane_ends(PlateModel& model, const Solver& solver, PlateResult& result);

}  // namespace strandlab::vtest
