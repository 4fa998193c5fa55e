#include "strandlab/table/table.hpp"

#include <gtest/gtest.h>

#include "strandlab/core/error.hpp"

namespace strandlab::table {
namespace {

std::vector<Quantity> quantities() {
  return {{{"id"}, Dimension::kText, "", true},
          {{"E1"}, Dimension::kModulus, "MPa", true},
          {{"t1", "thickness"}, Dimension::kLength, "mm", true},
          {{"k", "stiffness"}, Dimension::kStiffness, "N_per_mm", true},
          {{"G1"}, Dimension::kModulus, "MPa", false}};
}

Table table(const std::string& text) {
  return Table(text, "dls.csv", quantities());
}

std::string message(const std::string& text) {
  try {
    table(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

// The same two specimens in every spelling.
void expect_two_specimens(const Table& t) {
  ASSERT_EQ(t.rows(), 2);
  EXPECT_EQ(t.text(0, "id"), "a");
  EXPECT_EQ(t.text(1, "id"), "b");
  EXPECT_DOUBLE_EQ(*t.number(0, "E1"), 9936);
  EXPECT_DOUBLE_EQ(*t.number(1, "E1"), 10120.5);
  EXPECT_DOUBLE_EQ(*t.number(0, "t1"), .69);
  EXPECT_DOUBLE_EQ(*t.number(1, "t1"), .715);
  EXPECT_DOUBLE_EQ(*t.number(0, "k"), 3014);
  EXPECT_DOUBLE_EQ(*t.number(1, "k"), 2950.25);
  EXPECT_FALSE(t.has("G1"));
}

TEST(Table, CommaAndPoint) {
  expect_two_specimens(table("id,E1_MPa,t1_mm,k_N_per_mm\na,9936,0.69,3014\nb,10120.5,0.715,2950.25\n"));
}

TEST(Table, SemicolonAndDecimalComma) {
  expect_two_specimens(table("id;E1_MPa;t1_mm;k_N_per_mm\na;9936;0,69;3014\nb;10120,5;0,715;2950,25\n"));
}

TEST(Table, TabAndDecimalComma) {
  expect_two_specimens(table("id\tE1_MPa\tt1_mm\tk_N_per_mm\na\t9936\t0,69\t3014\nb\t10120,5\t0,715\t2950,25\n"));
}

TEST(Table, CommaWithQuotedDecimalComma) {
  expect_two_specimens(
      table("\"id\",\"E1_MPa\",\"t1_mm\",\"k_N_per_mm\"\n\"a\",\"9936\",\"0,69\",\"3014\"\nb,\"10120,5\",\"0,715\","
            "\"2950,25\"\n"));
}

TEST(Table, ByteOrderMarkAndCarriageReturns) {
  expect_two_specimens(
      table("\xEF\xBB\xBFid;E1_MPa;t1_mm;k_N_per_mm\r\na;9936;0,69;3014\r\nb;10120,5;0,715;2950,25\r\n"));
  expect_two_specimens(table("id,E1_MPa,t1_mm,k_N_per_mm\ra,9936,0.69,3014\rb,10120.5,0.715,2950.25"));
}

TEST(Table, Latin1IsReadAsUtf8) {
  const Table t = table(
      "id,E1_MPa,t1_\xB5m,k_N_per_mm,Gr\xF6\xDF"
      "e\na,9936,690,3014,\xE9\n");
  EXPECT_NEAR(*t.number(0, "t1"), .69, 1e-12);
  EXPECT_EQ(t.other_columns(), std::vector<std::string>{"Gr\xC3\xB6\xC3\x9F"
                                                        "e"});
  EXPECT_EQ(t.other(0, 0), "\xC3\xA9");
}

TEST(Table, RowOfUnits) {
  expect_two_specimens(table("id;E1;t1;k\n;MPa;mm;N/mm\na;9936;0,69;3014\nb;10120,5;0,715;2950,25\n"));
  expect_two_specimens(table("id,E1,t1,k\n,(GPa),[mm],(kN/mm)\na,9.936,0.69,3.014\nb,10.1205,0.715,2.95025\n"));
}

TEST(Table, RemarksAboveTheHeaderEmptyRowsAndComments) {
  expect_two_specimens(
      table("Test method;DLS 5445\nOperator;x\n\n# "
            "exported\nid;E1_MPa;t1_mm;k_N_per_mm;;\na;9936;0,69;3014;;\n;;;;;\nb;10120,5;"
            "0,715;2950,25\n"));
}

TEST(Table, ThousandsSeparators) {
  expect_two_specimens(
      table("id,E1_MPa,t1_mm,k_N_per_mm\na,\"9,936\",0.69,\"3,014\"\nb,\"10,120.5\",0.715,\"2,950.25\"\n"));
  expect_two_specimens(table("id;E1_MPa;t1_mm;k_N_per_mm\na;9.936;0,69;3.014\nb;10.120,5;0,715;2.950,25\n"));
  expect_two_specimens(
      table("id;E1_MPa;t1_mm;k_N_per_mm\na;9 936;0,69;3\xC2\xA0"
            "014\nb;10 120,5;0,715;2\xE2\x80\xAF"
            "950,25\n"));
}

// Three digits after a comma everywhere: decimals where cells are separated by something else, thousands where by a
// comma.
TEST(Table, GroupsOfThreeDigitsAlone) {
  EXPECT_DOUBLE_EQ(*table("id;E1_GPa;t1_mm;k_kN_per_mm\na;9,936;1,125;3,014\n").number(0, "k"), 3014);
  EXPECT_DOUBLE_EQ(*table("id,E1_MPa,t1_um,k_N_per_mm\na,\"9,936\",690,\"3,014\"\n").number(0, "k"), 3014);
  EXPECT_DOUBLE_EQ(*table("id;E1_GPa;t1_mm;k_kN_per_mm\na;9.936;1.125;3.014\n").number(0, "t1"), 1.125);
}

TEST(Table, KnownUnitsConvert) {
  const Table t = table("id,E1 (psi),Thickness [in],\"Stiffness, lbf/in\"\na,1e6,0.03,1000\n");
  EXPECT_NEAR(*t.number(0, "E1"), 6894.757, 5e-4);  // 1 Msi
  EXPECT_NEAR(*t.number(0, "t1"), .762, 1e-12);
  EXPECT_NEAR(*t.number(0, "k"), 175.12684, 5e-6);  // NIST SP 811: 1 lbf/in = 175.1268 N/m
  const Table si = table("id,E1_GPa,t1_\xC2\xB5m,k_MN/m\na,9.936,690,3.014\n");
  EXPECT_NEAR(*si.number(0, "E1"), 9936, 1e-9);
  EXPECT_NEAR(*si.number(0, "t1"), .69, 1e-12);
  EXPECT_NEAR(*si.number(0, "k"), 3014, 1e-9);
}

TEST(Table, MissingValuesAndSigns) {
  const Table t = table(
      "id,E1_MPa,t1_mm,k_N_per_mm\na,NA,0.69,\xE2\x88\x92"
      "12.5\nb,,-,+3e3\n");
  EXPECT_FALSE(t.number(0, "E1").has_value());
  EXPECT_DOUBLE_EQ(*t.number(0, "k"), -12.5);
  EXPECT_FALSE(t.number(1, "t1").has_value());
  EXPECT_DOUBLE_EQ(*t.number(1, "k"), 3000);
}

TEST(Table, OtherColumnsAreKeptInOrder) {
  const Table t = table("id,resin,E1_MPa,t1_mm,k_N_per_mm,\"coverage, %\"\na,PF,9936,0.69,3014,25\n");
  EXPECT_EQ(t.other_columns(), (std::vector<std::string>{"resin", "coverage, %"}));
  EXPECT_EQ(t.other(0, 0), "PF");
  EXPECT_EQ(t.other(0, 1), "25");
  EXPECT_EQ(t.where(0), "dls.csv:2");
}

TEST(Table, MissingColumnIsNamedWithItsLine) {
  const std::string text = message("id,E1_MPa,t1_mm\na,9936,0.69\n");
  EXPECT_NE(text.find("dls.csv:1: missing column k_N_per_mm"), std::string::npos) << text;
  EXPECT_NE(text.find("id, E1_MPa, t1_mm"), std::string::npos) << text;
}

TEST(Table, ColumnWithoutOrWithUnknownUnitIsNamed) {
  EXPECT_NE(message("id,E1,t1_mm,k_N_per_mm\na,9936,0.69,3014\n").find("'E1' has no unit; write E1_MPa"),
            std::string::npos);
  const std::string text = message("\nid,E1_bar,t1_mm,k_N_per_mm\na,9936,0.69,3014\n");
  EXPECT_NE(text.find("dls.csv:2: column 'E1_bar' has no known unit"), std::string::npos) << text;
  EXPECT_NE(text.find("GPa"), std::string::npos) << text;
  EXPECT_NE(message("id,E1,t1,k\n,bar,mm,N/mm\na,1,2,3\n").find("dls.csv:2: column 'E1': 'bar'"), std::string::npos);
  EXPECT_NE(message("id,E1_MPa,t1_mm,k_N_per_mm\n,GPa,mm,N/mm\na,1,2,3\n").find("row of units 'GPa'"),
            std::string::npos);
}

TEST(Table, WrongCellIsNamedWithItsLine) {
  EXPECT_NE(message("id,E1_MPa,t1_mm,k_N_per_mm\na,9936,0.69,3014\nb,9936,O.69,3014\n")
                .find("dls.csv:3: column 't1_mm': 'O.69' is not a number"),
            std::string::npos);
  EXPECT_NE(message("id,E1_MPa,t1_mm,k_N_per_mm\na,9936,0,69,3014\n").find("dls.csv:2: has 5 cells, the header 4"),
            std::string::npos);
  EXPECT_NE(message("id;E1_MPa;t1_mm;k_N_per_mm\na;9936;0,69;3014\nb;9936;0.69;3014\n").find("are mixed (line 2"),
            std::string::npos);
}

TEST(Table, ColumnGivenTwiceIsAnError) {
  EXPECT_NE(message("id,E1_MPa,E1_GPa,t1_mm,k_N_per_mm\na,1,2,3,4\n").find("'E1_MPa' and 'E1_GPa' both give E1"),
            std::string::npos);
}

// A quote that is not closed would take the specimens behind it into one cell, and they would be missed by nobody.
TEST(Table, QuoteThatIsNotClosedIsNamedByItsLine) {
  const std::string header = "id,resin,E1_MPa,t1_mm,k_N_per_mm\n";
  const auto refused = [&](const std::string& rows, const std::string& where) {
    const auto text = message(header + rows);
    EXPECT_NE(text.find("dls.csv:" + where), std::string::npos) << text << "\nof:\n" << rows;
    EXPECT_NE(text.find("quote"), std::string::npos) << text;
  };
  refused("a,PF,1,2,3\nb,\"PF,1,2,3\nc,PF,1,2,3\n", "3: a cell opens with a quote (\") that is not closed to the end");
  refused("a,PF,1,2,\"3\n", "2: ");
  refused("a,PF,1,2,3\n\"", "3: ");
  // The next quote, opening another cell, is taken for its end.
  refused("a,\"PF,1,2,3\nb,\"PF\",1,2,3\nc,PF,1,2,3\n",
          "2: a cell opens with a quote (\") that is not closed before line 3");
  refused("a,\"PF,1,2,3\n\"b\",PF,1,2,3\n", "2: ");
  // One more that opens nothing ends it, and a specimen is in the cell.
  refused("a,\"PF,1,2,3\nb,PF\",1,2,3\nc,PF,1,2,3\n", "2: ");
  refused("a,\"PF,1,2,3\nb,PF,1,2,3\"\nc,PF,1,2,3\n", "2: ");
  refused("a,\"P\"F,1,2,3\n", "2: text follows the closing quote");
  EXPECT_NE(message("id,\"resin,E1_MPa,t1_mm,k_N_per_mm\na,PF,1,2,3\n").find("dls.csv:1: a cell opens"),
            std::string::npos);
  EXPECT_NE(message("A \"remark\"\n\"not closed\n\n" + header + "a,PF,1,2,3\n").find("dls.csv:2: a cell opens"),
            std::string::npos);
}

TEST(Table, QuotedCellsMayHoldLineBreaksQuotesAndDelimiters) {
  const Table t = table(
      "\"lines of \"\"remarks\"\",\nabove\"\n\"A\" remark of old\n# 3, \"no quote here\n"
      "id,\"notes,\r\nand more\",E1_MPa,t1_mm,k_N_per_mm\na,\"one,\ntwo \"\"and\"\" \n\nthree\" ,9936,0.69,3014\n"
      "b, \"3\"\" thick\",10120.5,0.715,2950.25\n");
  expect_two_specimens(t);
  EXPECT_EQ(t.other_columns(), std::vector<std::string>{"notes, and more"});
  EXPECT_EQ(t.other(0, 0), "one, two \"and\"   three");
  EXPECT_EQ(t.other(1, 0), "3\" thick");
  EXPECT_EQ(t.where(1), "dls.csv:11");
}

TEST(Table, InchMarksAndApostrophesInCellsAreText) {
  const Table t =
      table("id,notes,E1_MPa,t1_mm,k_N_per_mm\na,3\" thick,9936,0.69,3014\nb,o'clock '\",10120.5,0.715,2950.25\n");
  expect_two_specimens(t);
  EXPECT_EQ(t.other(0, 0), "3\" thick");
  EXPECT_EQ(t.other(1, 0), "o'clock '\"");
}

TEST(Table, UnreadableFiles) {
  EXPECT_NE(message("").find("is empty"), std::string::npos);
  EXPECT_NE(message(std::string("\xFF\xFEi\0d\0", 6)).find("UTF-16"), std::string::npos);
  EXPECT_NE(message(std::string("i\0d\0,\0", 6)).find("UTF-16"), std::string::npos);
  EXPECT_NE(message(std::string("id,E1_MPa,t1_mm,k_N_per_mm\na,1,2,3\0004\n", 37)).find("dls.csv:2: a NUL byte"),
            std::string::npos);
  EXPECT_THROW(Table(std::filesystem::path("no_such_file.csv"), quantities()), InputError);
  EXPECT_THROW(Table(std::filesystem::temp_directory_path(), quantities()), InputError);
}

// What controllers of presses record: 1 bar = .1 MPa, 1 kgf/cm2 = .0980665 MPa. A bar is no unit of a modulus.
TEST(Table, UnitsOfAPress) {
  EXPECT_DOUBLE_EQ(*unit_factor(Dimension::kPressure, "bar"), .1);
  EXPECT_DOUBLE_EQ(*unit_factor(Dimension::kPressure, "kgf/cm2"), .0980665);
  EXPECT_DOUBLE_EQ(*unit_factor(Dimension::kTime, "min"), 60);
  EXPECT_DOUBLE_EQ(*unit_factor(Dimension::kTemperature, "°C"), 1);
  EXPECT_FALSE(unit_factor(Dimension::kTemperature, "F"));
  EXPECT_FALSE(unit_factor(Dimension::kModulus, "bar"));
}

}  // namespace
}  // namespace strandlab::table
