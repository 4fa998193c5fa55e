// Closed-form models against moduli of the same mats from an independent plane-strain finite-element solution
// (tests/data/reference/fe_moduli.json; 0.26667 mm elements, discretisation error about .5 % where there are gaps).
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "strandlab/mat/mat.hpp"
#include "strandlab/theory/models.hpp"

namespace strandlab::theory {
namespace {

double fe_modulus(const std::string& mat, const std::string& test, const std::string& compliance) {
  std::ifstream in(std::string(STRANDLAB_TEST_DATA) + "/reference/fe_moduli.json");
  return nlohmann::json::parse(in)[mat][test][compliance].get<double>();
}

// Rows of a reference mat: poplar, surface along and core across, with the row's own solid fraction.
std::vector<Row> rows_of(const std::string& name) {
  const auto mat = mat::read(std::string(STRANDLAB_TEST_DATA) + "/reference/" + name + ".json", {"surface", "core"});
  std::vector<Row> rows;
  for (const auto& layer : mat.layers) {
    double wood = 0;
    for (const auto& strand : layer.strands) wood += strand.x1_mm - strand.x0_mm;
    const double angle = layer.role == "core" ? 90 : 0;
    rows.push_back({wood::library().front(), angle, {wood, 0, mat.length_mm - wood, 0}});
  }
  return rows;
}

// Without gaps every row carries the same strain, so both models are exact for a plane-strain section.
TEST(TheoryAgainstFiniteElements, PanelsWithoutGaps) {
  for (const auto* mat : {"plywood", "lvl"}) {
    const auto rows = rows_of(mat);
    EXPECT_NEAR(tension_modulus_MPa(rows, 0, OffAxis::kExact), fe_modulus(mat, "tension", "0.0"), .1) << mat;
    EXPECT_NEAR(bending_modulus_MPa(rows, 0, OffAxis::kExact), fe_modulus(mat, "bending_end_rotation", "0.0"), .1)
        << mat;
    EXPECT_NEAR(tension_modulus_MPa(rows, .2, OffAxis::kExact), fe_modulus(mat, "tension_flat_compacted_0.2", "0.0"),
                .1)
        << mat;
  }
}

// With gaps the rule of mixtures bounds the stiffness from above, and by more the softer the glue.
TEST(TheoryAgainstFiniteElements, GapsMakeTheRuleOfMixturesTooStiff) {
  for (const auto* mat : {"osb_s1", "osl_s1", "osb_fine_s11", "osl_fine_s12"}) {
    const double mixture = tension_modulus_MPa(rows_of(mat), 0, OffAxis::kExact);
    const double perfect = fe_modulus(mat, "tension", "0.0"), soft = fe_modulus(mat, "tension", "0.05");
    EXPECT_LT(perfect, mixture) << mat;
    EXPECT_LT(soft, perfect) << mat;
  }
}

}  // namespace
}  // namespace strandlab::theory
