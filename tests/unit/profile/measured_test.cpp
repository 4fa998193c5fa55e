#include "strandlab/profile/measured.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "strandlab/core/error.hpp"

namespace strandlab::profile {
namespace {

std::vector<Specimen> read(const std::string& text, const MeasuredColumns& columns = {}) {
  return measured_from_text(text, "xray.csv", columns);
}

std::string message(const std::string& text, const MeasuredColumns& columns = {}) {
  try {
    read(text, columns);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

void expect_message(const std::string& text, const std::vector<std::string>& parts,
                    const MeasuredColumns& columns = {}) {
  const auto given = message(text, columns);
  for (const auto& part : parts) EXPECT_NE(given.find(part), std::string::npos) << part << " in: " << given;
}

// One specimen of 1 mm, the same in every spelling.
void expect_specimen(const std::vector<Specimen>& all) {
  ASSERT_EQ(all.size(), 1u);
  const std::vector<double> x{0, .25, .5, .75, 1}, density{900, 700, 600, 720, 880};
  ASSERT_EQ(all[0].position_mm.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(all[0].position_mm[i], x[i], 1e-12);
    EXPECT_NEAR(all[0].density_kg_m3[i], density[i], 1e-9);
  }
}

TEST(Measured, CommaAndPoint) {
  expect_specimen(read("Position (mm),Density (kg/m3)\n0,900\n0.25,700\n0.5,600\n0.75,720\n1.0,880\n"));
}

// It would take the rows that follow into its cell.
TEST(Measured, QuoteThatIsNotClosedIsNamedByItsLine) {
  expect_message("Position (mm),Density (kg/m3)\n0,900\n0.25,\"700\n0.5,600\n0.75,720\n1.0,880\n",
                 {"xray.csv:3", "quote", "not closed"});
}

TEST(Measured, LinesOfTheInstrumentAboveTheHeader) {
  expect_specimen(
      read("X-ray densitometer\nDate:,12.03.2009\nSpecimen thickness (mm),1.00\n\n"
           "Depth from top face (mm),Density kg/m^3\n2,900\n2.25,700\n2.5,600\n2.75,720\n3,880\n"));
}

TEST(Measured, SemicolonDecimalCommaAndARowOfUnits) {
  expect_specimen(read("Position;Density\n[mm];[kg/m³]\n0,0;900\n0,25;700\n0,5;600\n0,75;720\n1,0;880\n"));
}

// 1 lb/ft^3 = 0.45359237/0.3048^3 = 16.018463 kg/m^3, 1 in = 25.4 mm; positions run downwards.
TEST(Measured, TabInchesAndPoundsPerCubicFoot) {
  std::string text = "Depth (in)\tDensity (lb/ft3)\n";
  const std::vector<double> x{1, .75, .5, .25, 0}, density{900, 700, 600, 720, 880};
  for (std::size_t i = 0; i < 5; ++i)
    text += std::to_string(x[i] / 25.4) + "\t" + std::to_string(density[i] / 16.01846337396014) + "\n";
  const auto all = read(text);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_NEAR(all[0].thickness_mm(), 1, 5e-5);  // six decimals of an inch
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(all[0].position_mm[i], 1 - x[i], 5e-5);
    EXPECT_NEAR(all[0].density_kg_m3[i], density[i], 2e-5);
  }
}

// No header at all: columns by number, units by option.
TEST(Measured, ColumnsByNumberAndUnitsByOption) {
  MeasuredColumns columns;
  columns.position = 2;
  columns.density = {3};
  columns.position_unit = "mm";
  columns.density_unit = "g/cm3";
  expect_specimen(read("1;0,00;,9\n2;0,25;,7\n3;0,50;,6\n4;0,75;,72\n5;1,00;,88\n", columns));
  expect_specimen(read("a;b;c\n1;0,00;,9\n2;0,25;,7\n3;0,50;,6\n4;0,75;,72\n5;1,00;,88\n", columns));
}

TEST(Measured, SeveralColumnsOfDensity) {
  const auto all =
      read("x_mm,Density A (kg/m3),Density B (kg/m3)\n0,900,501\n.25,700,502\n.5,600,503\n.75,720,504\n1,880,505\n");
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].name, "A");
  EXPECT_EQ(all[1].name, "B");
  expect_specimen({all[0]});
  EXPECT_DOUBLE_EQ(all[1].density_kg_m3[4], 505);
}

// Specimens of different length beside each other, each with its own positions; cells at the end are empty.
TEST(Measured, PairsOfColumns) {
  const auto all = read(
      "position 1 (mm);density 1 (kg/m3);position 2 (mm);density 2 (kg/m3)\n0;900;0;501\n0,25;700;1;502\n"
      "0,5;600;2;503\n0,75;720;3;504\n1;880;4;505\n;;5;506\n");
  ASSERT_EQ(all.size(), 2u);
  expect_specimen({all[0]});
  EXPECT_EQ(all[1].position_mm.size(), 6u);
  EXPECT_EQ(all[1].name, "2");
}

TEST(Measured, SpecimensBelowEachOther) {
  const std::string rows = "0,900\n.25,700\n.5,600\n.75,720\n1,880\n";
  const auto runs = read("position_mm,density_kg_m3\n" + rows + rows);
  ASSERT_EQ(runs.size(), 2u);
  expect_specimen({runs[1]});
  EXPECT_EQ(runs[1].name, "1 (2)");
  const auto named = read(
      "specimen,position_mm,density_kg_m3\nS7,0,900\nS7,.25,700\nS7,.5,600\nS7,.75,720\nS7,1,880\n"
      "S8,0,900\nS8,.25,700\nS8,.5,600\nS8,.75,720\nS8,1,880\n");
  ASSERT_EQ(named.size(), 2u);
  EXPECT_EQ(named[1].name, "S8");
}

const std::string kRows = "0,900\n.25,700\n.5,600\n.75,720\n1,880\n";

// One export after the other in a file: the header again, with remarks above and units below it.
TEST(Measured, SpecimensEachUnderItsOwnHeader) {
  const std::string head = "Position,Density\n(mm),(kg/m3)\n";
  const auto all = read("Specimen: A\n" + head + kRows + "\nSpecimen: B,12.03.2009\nBoard no.,2\n" + head + kRows);
  ASSERT_EQ(all.size(), 2u);
  expect_specimen({all[0]});
  expect_specimen({all[1]});
  EXPECT_EQ(all[1].name, "1 (2)");
  // Below its own header a specimen may begin anywhere, and a bad reading before it is no remark.
  const std::string short_head = "position_mm,density_kg_m3\n";
  EXPECT_EQ(read(short_head + kRows + short_head + "10,900\n11,700\n12,600\n13,720\n14,880\n").size(), 2u);
  expect_message(short_head + kRows + "1.25,x\n" + short_head + kRows, {"xray.csv:7", "'x' is not a number"});
}

// Readings of two specimens in turns, as an instrument with two detectors writes them.
TEST(Measured, SpecimensInTurns) {
  const auto all = read(
      "specimen,position_mm,density_kg_m3\nA,0,900\nB,0,500\nA,.25,700\nB,.25,501\nA,.5,600\nB,.5,502\nA,.75,720\n"
      "B,.75,503\nA,1,880\nB,1,504\n");
  ASSERT_EQ(all.size(), 2u);
  expect_specimen({all[0]});
  EXPECT_EQ(all[0].name, "A");
  EXPECT_DOUBLE_EQ(all[1].density_kg_m3[4], 504);
}

// The name of the column need not come first in its header; of thickness and position, position is the position.
TEST(Measured, NamesWithinTheHeader) {
  const auto all = read(
      "No.;Thickness (mm);Rel. position (mm);S1 density (kg/m3);S2 density (kg/m3)\n1;1;0;900;501\n2;1;0,25;700;502\n"
      "3;1;0,5;600;503\n4;1;0,75;720;504\n5;1;1;880;505\n",
      [] {
        MeasuredColumns columns;
        columns.position = 3;
        return columns;
      }());
  ASSERT_EQ(all.size(), 2u);
  expect_specimen({all[0]});
  EXPECT_EQ(all[0].name, "S1");
  EXPECT_EQ(all[1].name, "S2");
  expect_specimen(
      read("Thickness (mm),Position (mm),Density (kg/m3)\n1,0,900\n1,.25,700\n1,.5,600\n1,.75,720\n1,1,880\n"));
  expect_specimen(read("Tiefe (mm);Rohdichte (kg/m³)\n0;900\n0,25;700\n0,5;600\n0,75;720\n1;880\n"));
}

// Remarks that name thickness and density with their values do not pass for the header.
TEST(Measured, RemarksThatNameColumns) {
  expect_specimen(
      read("Specimen ID: A1; thickness 1 mm\nDensity (kg/m3);706;Thickness (mm);1,00\n\n"
           "Position (mm);Density (kg/m3)\n0,0;900\n0,25;700\n0,5;600\n0,75;720\n1,0;880\n"));
}

// A column by number, the other by name, whatever the delimiter.
TEST(Measured, OneColumnByNumber) {
  MeasuredColumns columns;
  columns.density = {2};
  expect_specimen(read("Position (mm);Masse (kg/m³)\n0;900\n0,25;700\n0,5;600\n0,75;720\n1;880\n", columns));
}

TEST(Measured, UnitsStatedInTheRemarks) {
  const std::string rows = "Position,Density\n0,.9\n.25,.7\n.5,.6\n.75,.72\n1,.88\n";
  expect_specimen(read("Operator: X, thickness 25 in\nUnits: mm, g/cm3\n" + rows));
  expect_specimen(read("Units in mm\nunit of density = g/cm3\n" + rows));
  expect_message("Units: mm\n" + rows, {"xray.csv:2", "'Density' has no unit", "--density-unit"});
  expect_message("Units: mm, g/cm3\nUnits: lb/ft3\n" + rows, {"'Density' has no unit"});
}

// The beam starts and ends beside the specimen: zero there, with noise.
TEST(Measured, AirBesideTheSpecimenIsLeftOut) {
  const std::string header = "position_mm,density_kg_m3\n";
  expect_specimen(read(header + "4,-3\n4.5,2.5\n5,900\n5.25,700\n5.5,600\n5.75,720\n6,880\n6.25,12\n6.5,-1\n"));
  expect_specimen(read(header + "6.5,0\n6,900\n5.75,700\n5.5,600\n5.25,720\n5,880\n4,-3\n"));
  expect_message(header + "0,0\n1,0\n2,900\n3,900\n4,0\n", {"xray.csv:2", "has 2 readings in wood", "at least 5"});
}

TEST(Measured, SpellingsOfUnits) {
  for (const std::string unit : {"kg/m3", "kg m-3", "kg m⁻³", "kg per m³", "kg/m^3"})
    expect_specimen(read("position (mm),density (" + unit + ")\n" + kRows));
  // 1 lb/ft^3 = 0.45359237/0.3048^3 kg/m^3
  const auto pounds = [](const std::string& unit) {
    return read("position (mm),density (" + unit + ")\n0,50\n1,50\n2,50\n3,50\n4,50\n").at(0).density_kg_m3[0];
  };
  for (const std::string unit : {"lb/ft3", "lbs/cu ft", "lb/cu.ft", "pcf", "lbs/ft³"})
    EXPECT_NEAR(pounds(unit), 50 * 16.01846337396014, 1e-9) << unit;
}

TEST(Measured, BadFilesGetTheLineAndTheReason) {
  const std::string header = "position_mm,density_kg_m3\n";
  expect_message("", {"xray.csv", "is empty"});
  expect_message("a,b\n1,2\n", {"xray.csv:1", "missing column position_mm, density_kg_m3", "has: a, b"});
  expect_message("position,density_kg_m3\n0,1\n", {"xray.csv:1", "'position' has no unit", "mm, cm"});
  expect_message("position_mm,density (stone)\n0,1\n", {"xray.csv:1", "has no unit", "kg/m3, g/cm3, lb/ft3"});
  expect_message(header + "0,900\n.25,x\n", {"xray.csv:3", "'density_kg_m3'", "'x' is not a number"});
  expect_message(header + "0,900\n.25,45000\n", {"xray.csv:3", "45000 kg/m3", "0 and 2000"});
  expect_message(header + "0,900\n.25,-60\n", {"xray.csv:3", "-60 kg/m3"});
  expect_message(header + "0,1\n1,1\n2,1\n1.5,1\n", {"xray.csv:5", "position 1.5 mm after 2 mm"});
  expect_message(header + "0,1\n1,1\n1,1\n", {"xray.csv:4", "position 1 mm after 1 mm"});
  expect_message(header + "0,1\n1,1\n", {"xray.csv:2", "specimen '1' has 2 readings", "at least 5"});
  expect_message(header + "0,1\n", {"xray.csv:2", "has 1 reading;"});
  // g/cm3 or lb/ft3 that the header calls kg/m3
  expect_message(header + "0,.8\n1,.6\n2,.6\n3,.6\n4,.8\n", {"xray.csv:2", "no more than 0.8 kg/m3", "unit right"});
  expect_message("0.0;800\n0.5;700\n", {"xray.csv:1", "missing column", "--position-column, --density-column"});
  expect_message(header + "-,-\n", {"xray.csv", "no readings"});
  expect_message(header + "0,1,2\n", {"xray.csv:2", "3 cells"});
  MeasuredColumns columns;
  columns.density = {7};
  expect_message(header + "0,1\n", {"xray.csv:1", "no column 7 for density; there are 2"}, columns);
  columns = {};
  columns.density_unit = "lb/ft3";
  expect_message(header + "0,1\n", {"xray.csv:1", "'density_kg_m3' states its unit, and it is not lb/ft3"}, columns);
  columns.density_unit = "stone";
  expect_message("position_mm,density\n0,1\n", {"unit 'stone' of density is not known"}, columns);
  expect_message("position_mm,position 2 (mm),density_kg_m3\n0,0,1\n", {"2 columns of positions for 1 of densities"});
  EXPECT_THROW(read_measured("/nonexistent/xray.csv"), InputError);
}

// Readings 0, 100, 200, 300, 400 at 0..4 mm are the line 100 x: its mean over each half is 100 and 300.
TEST(Binned, IntegratesTheReadings) {
  const Specimen line{"a", {0, 1, 2, 3, 4}, {0, 100, 200, 300, 400}};
  const auto p = binned(line, 2);
  EXPECT_NEAR(p.density_kg_m3[0], 100, 1e-12);
  EXPECT_NEAR(p.density_kg_m3[1], 300, 1e-12);
  EXPECT_NEAR(binned(line, 7).density_kg_m3[3], 200, 1e-10);
  EXPECT_DOUBLE_EQ(p.thickness_mm, 4);
}

}  // namespace
}  // namespace strandlab::profile
