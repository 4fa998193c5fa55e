// Which closed-form model a virtual test is compared with.
#include "strandlab/report/theory_curves.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "strandlab/core/error.hpp"
#include "strandlab/theory/estimate.hpp"
#include "strandlab/vtest/vtest.hpp"
#include "support/temporary_folder.hpp"

namespace strandlab::report {
namespace {

PanelModulus modulus_of(const std::string& test) {
  PanelModulus m;
  m.compaction = 0.2;
  m.test = test;
  m.compliance_t_mm_per_MPa = 0.0105;
  return m;
}

std::vector<TheoryModulus> theory_of(const std::string& test) {
  return theory_moduli(theory::default_osb(), {modulus_of(test)}, wood::OffAxis::kExact);
}

// A test that is added to vtest has to be added here: with the model that answers it, or with none.
TEST(TheoryCurves, EveryVirtualTestHasItsOwnModels) {
  const std::vector<std::string> beam{"laminated beam"};
  const std::map<std::string, std::vector<std::string>> expected{{"tension", {"rule of mixtures", "shear-lag"}},
                                                                 {"bending_end_rotation", beam},
                                                                 {"bending_end_couple", beam},
                                                                 {"bending_3_point", beam},
                                                                 {"bending_4_point", beam}};
  ASSERT_EQ(vtest::test_names().size(), expected.size());
  for (const auto& test : vtest::test_names()) {
    ASSERT_TRUE(expected.count(test)) << test;
    std::vector<std::string> models;
    for (const auto& t : theory_of(test)) {
      EXPECT_EQ(t.test, test);
      EXPECT_EQ(t.compaction, 0.2);
      models.push_back(t.model);
    }
    EXPECT_EQ(models, expected.at(test)) << test;
  }
  const auto rows = theory::default_osb();
  EXPECT_EQ(theory_of("tension")[0].modulus_MPa, theory::tension_modulus_MPa(rows, 0.2, wood::OffAxis::kExact));
  EXPECT_EQ(theory_of("bending_3_point")[0].modulus_MPa, theory::bending_modulus_MPa(rows, 0.2, wood::OffAxis::kExact));
}

TEST(TheoryCurves, ATestThatNoModelKnowsIsNotTakenForBending) {
  const auto message = test::message_of<InputError>([] { theory_of("compression"); });
  EXPECT_NE(message.find("unknown virtual test \"compression\""), std::string::npos) << message;
}

}  // namespace
}  // namespace strandlab::report
