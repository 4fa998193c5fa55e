#include "strandlab/mat/mat.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

#include "strandlab/core/error.hpp"
#include "strandlab/mat/form.hpp"
#include "support/temporary_folder.hpp"

namespace strandlab::mat {
namespace {

namespace fs = std::filesystem;

// A folder of the test's own, removed at the end.
class MatFile : public testing::Test {
 protected:
  fs::path put(const std::string& text) const {
    auto file = folder_ / "mat.json";
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }
  static std::string content(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  test::TemporaryFolder folder_;
};

const std::vector<std::string> kKinds{"surface", "core"};

TEST_F(MatFile, ReadsWhatTheFormatSays) {
  const auto mat = read(put(R"({"length_mm":100, "layer_thickness_mm":0.8,
      "layers":[ {"role":"surface", "strands":[{"x0":0.0,"x1":91.73}]},
                 {"role":"core", "strands":[{"x0":40,"x1":60.5,"angle_deg":-45,"material":"vtc"}, {"x0":1e1,"x1":32.5}]}]})"),
                        kKinds);
  EXPECT_EQ(mat.length_mm, 100);
  EXPECT_EQ(mat.layer_thickness_mm, 0.8);
  ASSERT_EQ(mat.layers.size(), 2U);
  EXPECT_EQ(mat.layers[0].role, "surface");
  EXPECT_EQ(mat.layers[0].strands[0].x1_mm, 91.73);
  EXPECT_FALSE(mat.layers[0].strands[0].angle_deg);
  EXPECT_FALSE(mat.layers[0].strands[0].material);
  const auto& core = mat.layers[1].strands;  // sorted by x0
  ASSERT_EQ(core.size(), 2U);
  EXPECT_EQ(core[0].x0_mm, 10);
  EXPECT_EQ(core[1].x1_mm, 60.5);
  EXPECT_EQ(core[1].angle_deg, -45);
  EXPECT_EQ(core[1].material, "vtc");
}

TEST_F(MatFile, WrittenReadAndWrittenAgainIsUnchanged) {
  Layup layup;
  layup.rows.assign(6, {"core", {25, 3, 10, 1}});
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto file = folder_ / "mat.json";
    write(form(layup, seed), file);
    const auto first = content(file);
    const auto again = read(file, {"core"});
    write(again, file);
    EXPECT_EQ(content(file), first);
    // What the program goes on with is the same to the last bit as what a later command reads.
    const auto formed = form(layup, seed);
    for (std::size_t i = 0; i < formed.layers.size(); ++i) {
      for (std::size_t k = 0; k < formed.layers[i].strands.size(); ++k) {
        EXPECT_EQ(formed.layers[i].strands[k].x0_mm, again.layers[i].strands[k].x0_mm);
        EXPECT_EQ(formed.layers[i].strands[k].x1_mm, again.layers[i].strands[k].x1_mm);
      }
    }
  }
}

// A layer has its own thickness or the mat's; it is kept on write, in a file that reads back to the same bytes.
TEST_F(MatFile, LayersMayDifferInThickness) {
  const auto mat = read(put(R"({"length_mm":20,"layer_thickness_mm":0.8,"layers":[
      {"role":"surface","strands":[{"x0":0,"x1":20}],"thickness_mm":1.3},{"role":"core","strands":[{"x0":0,"x1":20}]}]})"),
                        kKinds);
  EXPECT_EQ(mat.thickness_of(0), 1.3);
  EXPECT_EQ(mat.thickness_of(1), .8);
  EXPECT_EQ(mat.height_below(0), 0);
  EXPECT_EQ(mat.height_below(1), 1.3);
  EXPECT_DOUBLE_EQ(mat.thickness_mm(), 2.1);
  EXPECT_EQ(mat.layers[0].extra, "");
  const auto text = to_text(mat);
  EXPECT_NE(text.find("{\"role\":\"surface\", \"thickness_mm\":1.3, \"strands\":["), std::string::npos) << text;
  EXPECT_NE(text.find("{\"role\":\"core\", \"strands\":["), std::string::npos) << text;
  EXPECT_EQ(to_text(read(put(text), kKinds)), text);
}

TEST_F(MatFile, ExtraKeysAreKeptAtEveryLevel) {
  const auto mat =
      read(put(R"({"length_mm":20,"layer_thickness_mm":0.75,"author":"E. \"L\" é","stats":{"sd":[1,2.5,null]},
      "layers":[{"role":"core","strands":[{"x0":0,"x1":20,"angle_deg":12.5,"material":"vtc","knots":[1,2]}],"moisture":0.08}]})"),
           kKinds);
  EXPECT_EQ(mat.extra, R"({"author":"E. \"L\" é","stats":{"sd":[1,2.5,null]}})");
  EXPECT_EQ(mat.layers[0].extra, R"({"moisture":0.08})");
  EXPECT_EQ(mat.layers[0].strands[0].extra, R"({"knots":[1,2]})");
  const auto text = to_text(mat);
  EXPECT_EQ(to_text(read(put(text), kKinds)), text);
  const auto json = nlohmann::json::parse(text);
  EXPECT_EQ(json["author"], "E. \"L\" é");
  EXPECT_EQ(json["stats"]["sd"][1], 2.5);
  EXPECT_EQ(json["layers"][0]["moisture"], 0.08);
  EXPECT_EQ(json["layers"][0]["strands"][0]["knots"][1], 2);
  EXPECT_EQ(json["layers"][0]["strands"][0]["angle_deg"], 12.5);
  EXPECT_EQ(json["layers"][0]["strands"][0]["material"], "vtc");
}

TEST_F(MatFile, CoordinatesAreWrittenToAMillionthOfAMillimetre) {
  Mat mat;
  mat.length_mm = 100;
  mat.layer_thickness_mm = 0.8;
  mat.layers.resize(1);
  mat.layers[0].role = "surface";
  mat.layers[0].strands.resize(2);
  mat.layers[0].strands[0].x0_mm = 1e-9;
  mat.layers[0].strands[0].x1_mm = 91.0 + 11.0 / 15;
  mat.layers[0].strands[1].x0_mm = 95.5;
  mat.layers[0].strands[1].x1_mm = 100 + 1e-8;
  EXPECT_EQ(to_text(mat),
            "{\"length_mm\":100.0, \"layer_thickness_mm\":0.8,\n \"layers\":[\n"
            "  {\"role\":\"surface\", \"strands\":[{\"x0\":0.0,\"x1\":91.733333}, {\"x0\":95.5,\"x1\":100.0}]}\n ]}\n");
}

// The mats the finite-element moduli were computed for; their coordinates have nine decimals.
TEST_F(MatFile, ReferenceMatsReadFine) {
  for (const auto* name : {"lvl", "plywood", "osb_s1", "osl_s1", "osb_fine_s11", "osl_fine_s12"}) {
    const auto file = fs::path(STRANDLAB_TEST_DATA) / "reference" / (std::string(name) + ".json");
    const auto json = nlohmann::json::parse(std::ifstream(file));
    const auto mat = read(file, kKinds);
    ASSERT_EQ(mat.layers.size(), json["layers"].size()) << name;
    EXPECT_EQ(nlohmann::json::parse(mat.extra)["stats"], json["stats"]) << name;
    for (std::size_t i = 0; i < mat.layers.size(); ++i) {
      ASSERT_EQ(mat.layers[i].strands.size(), json["layers"][i]["strands"].size()) << name;
      for (std::size_t k = 0; k < mat.layers[i].strands.size(); ++k) {
        const auto& strand = json["layers"][i]["strands"][k];
        EXPECT_NEAR(mat.layers[i].strands[k].x0_mm, strand["x0"].get<double>(), 5.1e-7) << name;
        EXPECT_NEAR(mat.layers[i].strands[k].x1_mm, strand["x1"].get<double>(), 5.1e-7) << name;
      }
    }
    const auto text = to_text(mat);
    EXPECT_EQ(to_text(read(put(text), kKinds)), text) << name;
  }
}

TEST_F(MatFile, WriteRefusesWhatReadWouldNotTake) {
  Mat mat;
  mat.length_mm = 100;
  mat.layer_thickness_mm = 0.8;
  EXPECT_THROW(write(mat, folder_ / "mat.json"), InputError);
  mat.layers.resize(1);
  mat.layers[0].role = "surface";
  mat.layers[0].strands.resize(1);
  mat.layers[0].strands[0].x1_mm = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(write(mat, folder_ / "mat.json"), InputError);
  EXPECT_FALSE(fs::exists(folder_ / "mat.json"));
}

TEST_F(MatFile, AnyRoleIsFineWithoutAListOfKinds) {
  const auto file =
      put(R"({"length_mm":9,"layer_thickness_mm":1,"layers":[{"role":"odd","strands":[{"x0":0,"x1":9}]}]})");
  EXPECT_EQ(read(file, {}).layers[0].role, "odd");
  EXPECT_THROW(read(file, kKinds), InputError);
}

// Strands may touch: the end of one at the start of the next is a butt joint, not an overlap.
TEST_F(MatFile, TouchingStrandsAreNoOverlap) {
  const auto file = put(R"({"length_mm":9,"layer_thickness_mm":1,"layers":[
      {"role":"core","strands":[{"x0":0,"x1":4.0000001},{"x0":4,"x1":9}]}]})");
  EXPECT_EQ(read(file, kKinds).layers[0].strands[1].x0_mm, 4);
}

struct Fault {
  const char* name;
  std::string text;
  std::vector<const char*> told;
};

std::string second_layer(const std::string& layer) {
  return R"({"length_mm":100,"layer_thickness_mm":0.8,"layers":[{"role":"surface","strands":[{"x0":0,"x1":100}]},)" +
         layer + "]}";
}
std::string second_strand(const std::string& strand) {
  return second_layer(R"({"role":"core","strands":[{"x0":20,"x1":40},)" + strand + "]}");
}

class BadMatFile : public MatFile, public testing::WithParamInterface<Fault> {};

TEST_P(BadMatFile, GetsOneClearMessage) {
  const auto file = put(GetParam().text);
  try {
    read(file, kKinds);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find(file.string() + ":"), 0U) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    for (const auto* words : GetParam().told) EXPECT_NE(message.find(words), std::string::npos) << message;
  }
}

const char* const kPlace = "layer 2, strand 2: ";

INSTANTIATE_TEST_SUITE_P(
    Faults, BadMatFile,
    testing::Values(
        Fault{"Overlap", second_strand(R"({"x0":39.9,"x1":60})"), {kPlace, "39.9", "overlaps strand 1", "x1 = 40"}},
        Fault{"OverlapOutOfOrder",
              second_strand(R"({"x0":5,"x1":21})"),
              {"layer 2, strand 1: ", "overlaps strand 2", "21"}},
        Fault{"SamePlaceTwice", second_strand(R"({"x0":20,"x1":40})"), {kPlace, "overlaps strand 1"}},
        Fault{"Reversed", second_strand(R"({"x0":60,"x1":50})"), {kPlace, "x1 = 50", "larger than x0 = 60"}},
        Fault{"NoLength", second_strand(R"({"x0":60,"x1":60})"), {kPlace, "x1 = 60", "larger than x0 = 60"}},
        Fault{"Sliver", second_strand(R"({"x0":60,"x1":60.009})"), {kPlace, "x1 = 60.009", "at least 0.01 mm long"}},
        Fault{"BelowResolution", second_strand(R"({"x0":60,"x1":60.0000001})"), {kPlace, "1e-6 mm"}},
        Fault{"LeftOfWindow", second_strand(R"({"x0":-0.5,"x1":10})"), {kPlace, "x0 = -0.5", "window 0 to 100"}},
        Fault{"RightOfWindow", second_strand(R"({"x0":60,"x1":100.01})"), {kPlace, "x1 = 100.01", "window 0 to 100"}},
        Fault{"NullCoordinate", second_strand(R"({"x0":null,"x1":60})"), {kPlace, "x0 = null", "must be a number"}},
        Fault{"TextCoordinate", second_strand(R"({"x0":"50","x1":60})"), {kPlace, "x0 = \"50\"", "must be a number"}},
        Fault{"BooleanCoordinate", second_strand(R"({"x0":50,"x1":true})"), {kPlace, "x1 = true", "must be a number"}},
        Fault{"NanIsNotJson", second_strand("\n{\"x0\":NaN,\"x1\":60}"), {"line 2", "not valid JSON"}},
        Fault{"TooLargeANumber", second_strand(R"({"x0":50,"x1":1e999})"), {"not valid JSON", "1e999"}},
        Fault{"MissingX1", second_strand(R"({"x0":50})"), {kPlace, "key \"x1\" is missing"}},
        Fault{"MisspeltX0", second_strand(R"({"x_0":50,"x1":60})"), {kPlace, "key \"x0\" is missing", "\"x_0\""}},
        Fault{"StrandIsNumber", second_strand("7"), {kPlace, "found 7"}},
        Fault{"AngleIsText", second_strand(R"({"x0":50,"x1":60,"angle_deg":"90"})"), {kPlace, "angle_deg = \"90\""}},
        Fault{"MaterialIsNumber", second_strand(R"({"x0":50,"x1":60,"material":3})"), {kPlace, "material = 3"}},
        Fault{"MaterialIsEmpty", second_strand(R"({"x0":50,"x1":60,"material":""})"), {kPlace, "material"}},
        Fault{"UnknownRole",
              second_layer(R"({"role":"cor","strands":[{"x0":0,"x1":9}]})"),
              {"layer 2: ", "unknown role \"cor\"", "did you mean \"core\"?", "\"surface\", \"core\""}},
        Fault{"ForeignRole",
              second_layer(R"({"role":"veneer","strands":[{"x0":0,"x1":9}]})"),
              {"layer 2: ", "unknown role \"veneer\"; the strand kinds are \"surface\", \"core\""}},
        Fault{"EmptyRole",
              second_layer(R"({"role":"","strands":[{"x0":0,"x1":9}]})"),
              {"layer 2: ", "role must not be empty"}},
        Fault{"RoleIsNumber", second_layer(R"({"role":1,"strands":[{"x0":0,"x1":9}]})"), {"layer 2: ", "role = 1"}},
        Fault{
            "MissingRole", second_layer(R"({"strands":[{"x0":0,"x1":9}]})"), {"layer 2: ", "key \"role\" is missing"}},
        Fault{"LayerWithoutThickness",
              second_layer(R"({"role":"core","thickness_mm":0,"strands":[{"x0":0,"x1":9}]})"),
              {"layer 2: ", "thickness_mm = 0", "between 0.001"}},
        Fault{"LayerThicknessIsText",
              second_layer(R"({"role":"core","thickness_mm":"1","strands":[{"x0":0,"x1":9}]})"),
              {"layer 2: ", "thickness_mm = \"1\"", "must be a number"}},
        Fault{"MissingStrands", second_layer(R"({"role":"core"})"), {"layer 2: ", "key \"strands\" is missing"}},
        Fault{"NoStrands", second_layer(R"({"role":"core","strands":[]})"), {"layer 2: ", "strands is empty"}},
        Fault{
            "StrandsIsObject", second_layer(R"({"role":"core","strands":{}})"), {"layer 2: ", "strands = {}", "list"}},
        Fault{"LayerIsList", second_layer("[]"), {"layer 2: ", "found []"}},
        Fault{"NoLayers", R"({"length_mm":100,"layer_thickness_mm":0.8,"layers":[]})", {"layers is empty"}},
        Fault{"MissingLayers", R"({"length_mm":100,"layer_thickness_mm":0.8})", {"key \"layers\" is missing"}},
        Fault{"MissingLength",
              R"({"lenght_mm":100,"layer_thickness_mm":0.8,"layers":[]})",
              {"key \"length_mm\" is missing", "\"lenght_mm\""}},
        Fault{"ZeroLength", R"({"length_mm":0,"layer_thickness_mm":0.8,"layers":[]})", {"length_mm = 0", "positive"}},
        Fault{
            "NegativeThickness", R"({"length_mm":9,"layer_thickness_mm":-1,"layers":[]})", {"layer_thickness_mm = -1"}},
        Fault{"NotAnObject", "[1, 2]", {"found [1,2]"}},
        Fault{"NotJson", "length = 100\n", {"line 1", "not valid JSON"}},
        Fault{"CutOff", "{\"length_mm\":100,\n\"layers\":[\n", {"line 3", "not valid JSON"}},
        Fault{"DecimalComma",
              second_strand(R"({"x0":50,"x1":60,5})"),
              {"line 1", "not valid JSON", "numbers have a decimal point, 1.5"}},
        Fault{"NotUtf8",
              second_strand("\n{\"x0\":50,\"x1\":60,\"material\":\"\xFC\"}"),
              {":2: the byte \\xfc is not UTF-8"}},
        Fault{"TextAfterNul", second_strand(R"({"x0":50,"x1":60})") + std::string("\n\0{", 3), {":2: a NUL byte"}},
        Fault{"Utf16", std::string("{\0}\0", 4), {"this file is UTF-16; save it as UTF-8"}},
        Fault{"LongRole",
              second_layer("{\"role\":\"" + std::string(100000, 'x') + R"(","strands":[{"x0":0,"x1":9}]})"),
              {"xxx... (100000 characters)\"; the strand kinds are"}},
        Fault{"EmptyFile", "", {"line 1", "not valid JSON"}}),
    [](const auto& tested) { return tested.param.name; });

TEST_F(MatFile, MissingFileAndFolderAreNamed) {
  for (const auto& file : {folder_ / "none.json", folder_.path()}) {
    try {
      read(file, kKinds);
      FAIL() << "accepted";
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find(file.string() + ": "), 0U) << error.what();
      EXPECT_NE(std::string(error.what()).find(file == folder_.path() ? "is a folder" : "No such file"),
                std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace strandlab::mat
