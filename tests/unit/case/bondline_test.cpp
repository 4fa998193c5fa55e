// A case whose glue lines come from a bond-line result.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "strandlab/case/case.hpp"
#include "strandlab/core/error.hpp"
#include "support/temporary_folder.hpp"

namespace strandlab::cases {
namespace {

using test::put;
using test::TemporaryFolder;

// What `strandlab bondline` writes, reduced to what a case needs.
constexpr const char* kResult =
    R"({"format": "strandlab bondline 1", "groups": [{"group": "PF-25", "compliance_t_mm_per_MPa": 0.01048}]})";

class CaseBondline : public testing::Test {
 protected:
  void SetUp() override { put(folder_ / "dls.json", kResult); }
  Case read(const std::string& glue, const std::vector<std::string>& overrides = {}) {
    put(folder_ / "panel.toml", "[glue]\n" + glue);
    return read_case(folder_ / "panel.toml", overrides);
  }
  std::string message(const std::string& glue, const std::vector<std::string>& overrides = {}) {
    try {
      read(glue, overrides);
    } catch (const InputError& e) {
      return e.what();
    }
    return "no error";
  }
  TemporaryFolder folder_;
};

TEST_F(CaseBondline, GroupGivesTheCompliance) {
  const Case c = read("from_bondline = \"dls.json\"\ngroup = \"PF-25\"");
  EXPECT_EQ(c.test.compliance_t_mm_per_MPa, std::vector<double>{0.01048});
  // Written out in full by `strandlab check`: the same compliance beside its source is no contradiction.
  EXPECT_EQ(message("from_bondline = \"dls.json\"\ngroup = \"PF-25\"\ncompliance_t_mm_per_MPa = [0.01048]"),
            "no error");
}

// Several groups give a compliance and a name each, in the order asked for; other compliances have names of their own.
TEST_F(CaseBondline, GroupsGiveCompliancesAndNames) {
  put(folder_ / "dls.json",
      R"({"format": "strandlab bondline 1", "groups": [{"group": "8 %", "compliance_t_mm_per_MPa": 0.01},)"
      R"({"group": "2 %", "compliance_t_mm_per_MPa": 0.03}, {"group": "best", "compliance_t_mm_per_MPa": -0.001}]})");
  const Case c = read("from_bondline = \"dls.json\"\ngroups = [\"2 %\", \"8 %\", \"best\"]");
  EXPECT_EQ(c.test.compliance_t_mm_per_MPa, (std::vector<double>{0.03, 0.01, -0.001}));
  EXPECT_EQ(name_of_glue(c, 0.01), "8 %");
  EXPECT_EQ(name_of_glue(c, 0), "best") << "a negative compliance is taken as a perfect bond";
  EXPECT_EQ(name_of_glue(c, 0.0105), "PF 25 %");
  EXPECT_EQ(name_of_glue(Case(), 0), "perfect bond");
  EXPECT_EQ(name_of_glue(Case(), 0.02), "1/D_t 0.02");
  EXPECT_NE(message("from_bondline = \"dls.json\"\ngroup = \"8 %\"\ngroups = [\"2 %\"]").find("give one of the two"),
            std::string::npos);
  // The message is about the key that holds the wrong name.
  const auto wrong = message("from_bondline = \"dls.json\"\ngroup = \"8 %\"", {"glue.group=9 %"});
  EXPECT_EQ(wrong.rfind("--set glue.group=9 %: glue.group = \"9 %\": ", 0), 0U) << wrong;
}

TEST_F(CaseBondline, WhatDoesNotFitIsNamed) {
  EXPECT_NE(message("from_bondline = \"dls.json\"\ngroup = \"PF-1\"").find("has no group 'PF-1'; it has: PF-25"),
            std::string::npos);
  const auto missing = message("from_bondline = \"none.json\"\ngroup = \"PF-25\"");
  EXPECT_NE(missing.find("panel.toml:2: glue.from_bondline = \"none.json\": "), std::string::npos) << missing;
  EXPECT_NE(missing.find("none.json: cannot be read as a result of 'strandlab bondline': No such file"),
            std::string::npos)
      << missing;
  const auto backslash = message("from_bondline = \"C:\\table.json\"\ngroup = \"PF-25\"");  // a tab to TOML
  EXPECT_NE(backslash.find("or single quotes"), std::string::npos) << backslash;
  EXPECT_NE(message("from_bondline = \"dls.json\"").find("needs glue.group"), std::string::npos);
  EXPECT_NE(message("group = \"PF-25\"").find("panel.toml:2: glue.group = \"PF-25\": needs glue.from_bondline"),
            std::string::npos);
  EXPECT_NE(message("", {"glue.group=PF-25"}).find("--set glue.group=PF-25: glue.group = \"PF-25\": needs"),
            std::string::npos);
  EXPECT_NE(
      message("from_bondline = \"dls.json\"\ngroup = \"PF-25\"\ncompliance_t_mm_per_MPa = [0.5]").find("contradict"),
      std::string::npos);
}

}  // namespace
}  // namespace strandlab::cases
