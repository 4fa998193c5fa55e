#include "strandlab/bondline/analysis.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "strandlab/core/error.hpp"
#include "support/temporary_folder.hpp"

namespace strandlab::bondline {
namespace {

constexpr const char* kHeader = "id,group,wood,E1_MPa,E2_MPa,t1_mm,t2_mm,W_mm,l_mm,L1_mm,L2_mm,k_N_per_mm\n";

// A row with the default geometry (tabs of 5 mm) and a given stiffness cell.
std::string row(const std::string& id, const std::string& group, const std::string& k,
                const std::string& wood = "poplar") {
  return fmt::format("{},{},{},9936,9936,0.69,0.69,6,25,5,5,{}\n", id, group, wood, k);
}

std::string stiffness(double compliance) {
  Geometry g;
  g.L1_mm = g.L2_mm = 5;
  return fmt::format("{:.9g}", stiffness_N_per_mm(g, compliance));
}

class BondlineFiles : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  std::string message(const std::string& table) {
    try {
      read_specimens(write("bad.csv", table));
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
  test::TemporaryFolder folder_;
};

// Two groups whose specimens have known 1/D_t: .01, .02, .03 and .001, .002, .003 mm/MPa.
std::string two_groups() {
  std::string table = kHeader;
  for (int i = 1; i <= 3; ++i) table += row(fmt::format("a{}", i), "low", stiffness(.01 * i));
  for (int i = 1; i <= 3; ++i) table += row(fmt::format("b{}", i), "high", stiffness(.001 * i), "vtc");
  return table;
}

TEST_F(BondlineFiles, GroupsHaveMeanScatterAndTests) {
  const Analysis analysis = analyse(read_specimens(write("dls.csv", two_groups())), {});
  ASSERT_EQ(analysis.groups.size(), 2U);
  const Group& low = analysis.groups[0];
  EXPECT_EQ(low.name, "low");
  EXPECT_NEAR(low.compliance_t.mean, .02, 1e-8);
  EXPECT_NEAR(low.compliance_t.sd, .01, 1e-8);
  EXPECT_NEAR(low.compliance_t.high - .02, 4.302653 * .01 / std::sqrt(3), 1e-7);  // t(.975, 2) = 4.302653
  EXPECT_EQ(low.excluded, 0);
  // k falls with 1/D_t ever more slowly, so the mean of k stands for a smaller 1/D_t than the mean of 1/D_t.
  ASSERT_TRUE(low.compliance_of_mean.has_value());
  EXPECT_LT(*low.compliance_of_mean, .02);
  EXPECT_GT(*low.compliance_of_mean, .018);
  ASSERT_EQ(analysis.families.size(), 1U);
  // Between: 3 (.009)^2 2 = means .02 and .002; SSB = 3 * .018^2 / 2; SSW = 2 (.01^2 + .001^2).
  EXPECT_NEAR(analysis.families[0].anova->F, (3 * .018 * .018 / 2) / (2 * (1e-4 + 1e-6) / 4), 1e-4);
  EXPECT_EQ(analysis.families[0].pairs.size(), 1U);
}

TEST_F(BondlineFiles, SpecimensCarryTheirUncertainty) {
  const Analysis analysis = analyse(read_specimens(write("dls.csv", two_groups())), {});
  for (const auto& s : analysis.specimens) {
    EXPECT_LT(s.uncertainty.low_mm_per_MPa, *s.compliance_t);
    EXPECT_GT(s.uncertainty.high_mm_per_MPa, *s.compliance_t);
    EXPECT_GT(s.ratio, 1);
    EXPECT_LT(s.sensitivity, 0);
  }
}

TEST_F(BondlineFiles, GivenUncertaintyOfStiffnessIsUsed) {
  std::string table = "id,group,E1_MPa,E2_MPa,t1_mm,t2_mm,W_mm,l_mm,L1_mm,L2_mm,k_N_per_mm,u_k_N_per_mm\n";
  table += "a,g,9936,9936,0.69,0.69,6,25,5,5,1900,95\nb,g,9936,9936,0.69,0.69,6,25,5,5,1900,\n";
  Options options;
  options.uncertainty = {.01, 0, 0, 0};
  const Analysis analysis = analyse(read_specimens(write("dls.csv", table)), options);
  EXPECT_NEAR(analysis.specimens[0].uncertainty.k_equivalent, .05, 1e-12);
  EXPECT_NEAR(analysis.specimens[1].uncertainty.k_equivalent, .01, 1e-12);
}

// Specimens without a solution stay in the list with their reason; slightly negative values stay in the group.
TEST_F(BondlineFiles, ExcludedSpecimensAreVisible) {
  std::string table = kHeader;
  table += row("good", "g", stiffness(.01)) + row("negative", "g", stiffness(-.0003)) + row("rigid", "g", "9999");
  table += row("below", "g", "-3") + row("empty", "g", "");
  const Analysis analysis = analyse(read_specimens(write("dls.csv", table)), {});
  ASSERT_EQ(analysis.specimens.size(), 5U);
  EXPECT_TRUE(analysis.specimens[0].excluded.empty());
  EXPECT_NEAR(*analysis.specimens[1].compliance_t, -.0003, 1e-9);
  EXPECT_NE(analysis.specimens[2].excluded.find("rigid-bond limit"), std::string::npos);
  EXPECT_NE(analysis.specimens[3].excluded.find("not above zero"), std::string::npos);
  EXPECT_EQ(analysis.specimens[4].excluded, "no value for k");
  EXPECT_EQ(analysis.groups[0].compliance_t.n, 2);
  EXPECT_EQ(analysis.groups[0].excluded, 3);
  EXPECT_NEAR(analysis.groups[0].compliance_t.mean, (.01 - .0003) / 2, 1e-8);
  EXPECT_EQ(analysis.groups[0].n_mean_k, 4);
}

TEST_F(BondlineFiles, FurtherColumnsGroup) {
  const SpecimenTable table = read_specimens(write("dls.csv", two_groups()));
  EXPECT_EQ(table.factors, std::vector<std::string>{"wood"});
  Options options;
  options.within = {"wood"};
  const Analysis analysis = analyse(table, options);
  ASSERT_EQ(analysis.families.size(), 2U);
  EXPECT_EQ(analysis.groups[1].name, "vtc high");
  EXPECT_FALSE(analysis.families[0].anova.has_value());
  EXPECT_NE(analysis.families[0].note.find("two groups"), std::string::npos);
  options.within = {"species"};
  EXPECT_THROW(analyse(table, options), InputError);
  options.within.clear();
  options.group_by.clear();
  EXPECT_THROW(analyse(table, options), InputError);
}

TEST_F(BondlineFiles, GroupsOfOneAreNotCompared) {
  const Analysis analysis =
      analyse(read_specimens(write("dls.csv", two_groups() + row("c", "single", stiffness(.1)))), {});
  EXPECT_EQ(analysis.families[0].note, "not compared, fewer than two different values: single");
  EXPECT_EQ(analysis.families[0].pairs.size(), 1U);
}

TEST_F(BondlineFiles, ResultIsReadBackByGroup) {
  const Analysis analysis = analyse(read_specimens(write("dls.csv", two_groups())), {});
  const auto file = write("dls.json", to_json(analysis, "dls.csv"));
  EXPECT_EQ(group_compliance(file, "low"), analysis.groups[0].compliance_t.mean);
  EXPECT_EQ(group_compliance(file, "high"), analysis.groups[1].compliance_t.mean);
  try {
    group_compliance(file, "medium");
    FAIL() << "an unknown group was accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("has no group 'medium'; it has: low, high"), std::string::npos);
  }
  EXPECT_THROW(group_compliance(write("other.json", "{\"groups\": []}"), "low"), InputError);
  EXPECT_THROW(group_compliance(write("other.json", R"({"format": 3, "groups": [1]})"), "low"), InputError);
  EXPECT_THROW(group_compliance(write("other.json", R"({"format": "strandlab bondline 1", "groups": [1]})"), "low"),
               InputError);
  EXPECT_THROW(group_compliance(write("broken.json", "{"), "low"), InputError);
  EXPECT_THROW(group_compliance(folder_ / "none.json", "low"), InputError);
}

TEST_F(BondlineFiles, GroupWithoutValueCannotBeNamed) {
  const Analysis analysis = analyse(read_specimens(write("dls.csv", kHeader + row("a", "g", "9999"))), {});
  EXPECT_THROW(group_compliance(write("dls.json", to_json(analysis, "dls.csv")), "g"), InputError);
}

TEST_F(BondlineFiles, BadTablesAreNamedWithTheirLine) {
  EXPECT_NE(message(kHeader).find("no specimens"), std::string::npos);
  EXPECT_NE(message(kHeader + row("a", "g", "1900") + row("a", "g", "1800"))
                .find(":3: specimen 'a' of group 'g' stands on line 2"),
            std::string::npos);
  EXPECT_NE(message(kHeader + row("", "g", "1900")).find(":2: the specimen has no id"), std::string::npos);
  EXPECT_NE(message(std::string(kHeader) + "a,g,w,9936,9936,-0.69,0.69,6,25,5,5,1900\n")
                .find(":2: t1_mm = -0.69 must be positive"),
            std::string::npos);
  EXPECT_EQ(message(kHeader + row("a", "g", "1900") + row("a", "h", "1800")), "no error");
}

// Records of 2500 and 2000 N/mm; the third one stops before ten points.
TEST_F(BondlineFiles, StiffnessFromRecords) {
  const auto record = [](double k, int points) {
    std::string text = "load_N,displacement_mm\n";
    for (int i = 0; i < points; ++i) text += fmt::format("{},{:.9f}\n", i, i / k);
    return text;
  };
  write("a.csv", record(2300, 500));
  write("other.csv", record(2000, 500));
  write("c.csv", record(2000, 12));
  const auto table =
      write("specimens.csv",
            "id,group,E1_MPa,E2_MPa,t1_mm,t2_mm,W_mm,l_mm,L1_mm,L2_mm,record\na,g,9936,9936,0.69,0.69,6,25,5,5,\n"
            "b,g,9936,9936,0.69,0.69,6,25,5,5,other.csv\nc,g,9936,9936,0.69,0.69,6,25,5,5,\n");
  const SpecimenTable read = read_specimens(table, Records{folder_.path(), {}});
  EXPECT_NEAR(*read.specimens[0].k_N_per_mm, 2300, .01);
  EXPECT_NEAR(*read.specimens[1].k_N_per_mm, 2000, .01);
  EXPECT_NE(read.specimens[2].problem.find("c.csv: only"), std::string::npos);
  EXPECT_EQ(analyse(read, {}).groups[0].excluded, 1);
  EXPECT_THROW(read_specimens(table, Records{folder_ / "none", {}}), InputError);
  EXPECT_THROW(read_specimens(table, Records{folder_.path(), {.5, .2, true}}), InputError);
  EXPECT_THROW(read_specimens(table), InputError);  // without records k must be in the table
}

}  // namespace
}  // namespace strandlab::bondline
