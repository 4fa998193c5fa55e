// A panel ready to be tested: everything that does not depend on the glue, and the panel glued by one bond.
#pragma once

#include <vector>

#include "strandlab/statics/bonded.hpp"
#include "strandlab/vtest/connection.hpp"
#include "strandlab/vtest/vtest.hpp"

namespace strandlab::vtest {

// Nodes of the two end planes, and what the tests need to know of the section. Per mm of depth throughout.
struct Section {
  double length = 0, thickness = 0, middle = 0;  // mm; middle: height of the mid-plane
  std::vector<int> left, right;                  // nodes
  std::vector<int> pins;                         // one node of each group, held in y where nothing else holds it
  std::vector<Vec<2>> nodes;                     // mm, positions
  double second_moment() const { return thickness * thickness * thickness / 12; }
};

struct Model {
  Connection connection;
  statics::Mesh<2> mesh;
  Section section;
  std::vector<glue::GluePoint<2>> points;  // of strands that are kept
  statics::BondedPanel<2> bonded;
};

// Cures and meshes the specimen; fills what of the result depends on no glue. Throws InputError where no strands
// connect both ends, RunError for an inverted element.
Model make_model(const Panel<2>& panel, const Options& options, Result& result);

// Nothing held yet.
statics::Supports no_supports(const statics::LowerMatrix& stiffness);

// No force, or no displacement given, at any dof.
std::vector<double> nothing(const Model& model);

}  // namespace strandlab::vtest
