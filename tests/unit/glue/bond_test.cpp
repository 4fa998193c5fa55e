// What a glue line's compliances mean: perfect, negative, softer than the floor, stiffer than the penalty.
#include "strandlab/glue/bond.hpp"

#include <gtest/gtest.h>

namespace strandlab::glue {
namespace {

constexpr double kPenalty = 1e6;  // MPa/mm

TEST(Bond, HasTheInverseOfItsCompliances) {
  const auto s = stiffness({0.0125, 0.002}, kPenalty);
  EXPECT_DOUBLE_EQ(s.tangential, 80);
  EXPECT_DOUBLE_EQ(s.normal, 500);
  EXPECT_FALSE(s.perfect_t || s.perfect_n);
  EXPECT_TRUE(remarks({0.0125, 0.002}).empty());
}

// A perfect bond is the penalty's, and so is one that would be stiffer than it.
TEST(Bond, IsPerfectAtNoCompliance) {
  for (const double none : {0.0, 1e-7}) {
    const auto s = stiffness({none, 0.002}, kPenalty);
    EXPECT_EQ(s.tangential, kPenalty);
    EXPECT_TRUE(s.perfect_t);
    EXPECT_FALSE(s.perfect_n);
  }
}

TEST(Bond, IsPerfectWhereItsComplianceIsNegativeAndSaysSo) {
  EXPECT_EQ(taken(-0.001), 0);
  EXPECT_EQ(taken(0.001), 0.001);
  EXPECT_TRUE(stiffness({0.01, -0.001}, kPenalty).perfect_n);
  const auto sentences = remarks({0.01, -0.001});
  ASSERT_EQ(sentences.size(), 1U);
  EXPECT_EQ(sentences[0], "The glue compliance 1/D_n = -0.001 mm/MPa is negative; it is taken as a perfect bond.");
}

// (1/D_t)/Q + (1/Q - 1) .0105: half a bond of .01 is .02 + .0105, half a perfect one is a bond of little resin.
TEST(Bond, IsSofterWhereItIsUnfinished) {
  EXPECT_DOUBLE_EQ(unfinished({.01, .002}, .5).compliance_t, .0305);
  EXPECT_DOUBLE_EQ(unfinished({.01, .002}, .5).compliance_n, .002);
  EXPECT_DOUBLE_EQ(unfinished({0, 0}, .5).compliance_t, .0105);
  EXPECT_DOUBLE_EQ(unfinished({-.01, 0}, .5).compliance_t, .0105);
  for (const double given : {-.01, 0., .01}) EXPECT_EQ(unfinished({given, 0}, 1).compliance_t, given);
}

// Where resin does not cover all, the bond given has so much more compliance, before what is unfinished of it.
TEST(Bond, IsSofterWhereResinIsLacking) {
  EXPECT_EQ(at_point({.01, .002}, 1, 0).compliance_t, .01);
  EXPECT_EQ(at_point({-.01, 0}, 1, 0).compliance_t, -.01);
  EXPECT_DOUBLE_EQ(at_point({.01, .002}, 1, .02).compliance_t, .03);
  EXPECT_DOUBLE_EQ(at_point({-.01, .002}, .5, .02).compliance_t, .0505);
  EXPECT_DOUBLE_EQ(at_point({.01, .002}, .5, .02).compliance_n, .002);
}

TEST(Bond, IsNoSofterThanTheFloorAndSaysSo) {
  EXPECT_EQ(stiffness({2000, 0}, kPenalty).tangential, kSoftest);
  EXPECT_EQ(stiffness({1000, 0}, kPenalty).tangential, kSoftest);
  EXPECT_TRUE(remarks({1000, 0}).empty());
  const auto sentences = remarks({2000, 0});
  ASSERT_EQ(sentences.size(), 1U);
  EXPECT_NE(sentences[0].find("D_t = 0.0005 MPa/mm is raised to 0.001"), std::string::npos) << sentences[0];
}

}  // namespace
}  // namespace strandlab::glue
