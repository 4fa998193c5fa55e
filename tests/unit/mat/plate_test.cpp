#include "strandlab/mat/plate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>

#include "strandlab/core/error.hpp"
#include "strandlab/mat/mat.hpp"
#include "support/temporary_folder.hpp"

namespace strandlab::mat {
namespace {

namespace fs = std::filesystem;

const std::vector<RoleAngle> kRoles{{"surface", 0}, {"core", 90}};

class PlateFile : public testing::Test {
 protected:
  fs::path put(const std::string& text) const {
    auto file = folder_ / "plate.json";
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }
  static std::string content(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  test::TemporaryFolder folder_;
};

fs::path reference_mat(const std::string& name) {
  return fs::path(STRANDLAB_TEST_DATA) / "mats3d" / (name + ".json");
}

TEST_F(PlateFile, ReadsWhatTheFormatSays) {
  const auto mat = read_plate(put(R"({"dim":3, "length_mm":40, "width_mm":50.0000004, "layer_thickness_mm":0.8,
      "stack":"draped", "drape_slopes":[0.05,0.1], "seed":7, "layers":[
       {"role":"surface", "thickness_mm":1.0, "strands":[
         {"cx":12,"cy":30.5,"length":28,"width":8,"angle_deg":-17.2500004,"material":"vtc","id":3},
         {"cx":1,"cy":2,"length":10,"width":4}]},
       {"role":"core", "strands":[{"cx":1,"cy":2,"length":10,"width":4}]}]})"),
                              kRoles);
  EXPECT_EQ(mat.length_mm, 40);
  EXPECT_EQ(mat.width_mm, 50);
  EXPECT_EQ(mat.sides, PlateSides::kPeriodic);
  EXPECT_EQ(mat.stack, Stack::kDraped);
  EXPECT_EQ(mat.drape_slopes, (std::array<double, 2>{0.05, 0.1}));
  EXPECT_EQ(mat.extra, R"({"seed":7})");
  ASSERT_EQ(mat.layers.size(), 2U);
  EXPECT_EQ(mat.thickness_of(0), 1);
  EXPECT_EQ(mat.height_below(2), 1.8);
  const auto& strands = mat.layers[0].strands;  // in the order of the file
  ASSERT_EQ(strands.size(), 2U);
  EXPECT_EQ(strands[0].cy_mm, 30.5);
  EXPECT_EQ(strands[0].length_mm, 28);
  EXPECT_EQ(strands[0].angle_deg, -17.25);
  EXPECT_EQ(strands[0].material, "vtc");
  EXPECT_EQ(strands[0].extra, R"({"id":3})");
  EXPECT_FALSE(strands[1].angle_deg || strands[1].material);
  EXPECT_EQ(angle_deg(strands[0], "surface", kRoles), -17.25);
  EXPECT_EQ(angle_deg(strands[1], "surface", kRoles), 0);
  EXPECT_EQ(angle_deg(mat.layers[1].strands[0], "core", kRoles), 90);
}

// What is left out is a periodic mat in layers.
TEST_F(PlateFile, WritesEveryKeyAndKeepsOthers) {
  const auto text = to_text(read_plate(
      put(R"({"dim":3,"length_mm":40,"width_mm":40,"layer_thickness_mm":0.8,"note":"n","layers":[{"role":"core",
              "strands":[{"cx":12,"cy":30.5,"length":28,"width":8,"angle_deg":45,"k":[1]}]}]})"),
      kRoles));
  EXPECT_EQ(text,
            "{\"dim\":3, \"length_mm\":40.0, \"width_mm\":40.0, \"layer_thickness_mm\":0.8, \"sides\":\"periodic\", "
            "\"stack\":\"layers\", \"note\":\"n\",\n \"layers\":[\n  {\"role\":\"core\", \"strands\":[\n"
            "    {\"cx\":12.0,\"cy\":30.5,\"length\":28.0,\"width\":8.0,\"angle_deg\":45.0,\"k\":[1]}]}\n ]}\n");
}

// The mats that moduli of other programs are known for.
TEST_F(PlateFile, ReferenceMatsReadAndWrittenAgainAreTheSame) {
  for (const auto* name : {"per_a", "per_a_45", "per_a_26", "cut_a", "rot_a"}) {
    const auto mat = read_plate(reference_mat(name), kRoles);
    const auto text = to_text(mat);
    EXPECT_EQ(to_text(read_plate(put(text), kRoles)), text) << name;
    const auto original = nlohmann::json::parse(std::ifstream(reference_mat(name)));
    auto written = nlohmann::json::parse(text);
    EXPECT_EQ(written["stack"], "layers");
    written.erase("stack");
    EXPECT_EQ(written, original) << name;
    write(mat, kRoles, folder_ / "again.json");
    EXPECT_EQ(content(folder_ / "again.json"), text);
  }
}

// Areas of the layers of the reference mats over that of the window, as the programs that made them give them.
TEST(ReferencePlates, CoverWhatTheirAuthorsSay) {
  const auto moduli = nlohmann::json::parse(std::ifstream(reference_mat("fe_moduli3d")));
  for (const auto* name : {"per_a", "cut_a", "rot_a"}) {
    const auto mat = read_plate(reference_mat(name), kRoles);
    const auto& coverage = moduli[name]["coverage"];
    ASSERT_EQ(coverage.size(), mat.layers.size()) << name;
    for (std::size_t i = 0; i < mat.layers.size(); ++i) {
      double area = 0;
      for (const auto& strand : mat.layers[i].strands) area += strand.length_mm * strand.width_mm;
      EXPECT_NEAR(area / (mat.length_mm * mat.width_mm), coverage[i].get<double>(), 1e-4) << name << " " << i;
    }
  }
}

TEST_F(PlateFile, EitherReaderRefusesTheOthersMat) {
  const auto section =
      put(R"({"length_mm":9,"layer_thickness_mm":1,"layers":[{"role":"core","strands":[{"x0":0,"x1":9}]}]})");
  EXPECT_EQ(dimensions(section), 2);
  EXPECT_EQ(dimensions(reference_mat("per_a")), 3);
  const auto message = [](const auto& attempt) -> std::string {
    try {
      attempt();
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message([&] { read_plate(section, kRoles); }),
            section.string() +
                ": without \"dim\":3 this is a section mat (2D); here the mat of a plate is read, whose "
                "file has it");
  EXPECT_EQ(message([&] { read(reference_mat("per_a"), {}); }),
            reference_mat("per_a").string() +
                ": \"dim\":3 makes it the mat of a plate (3D); here a section mat is "
                "read, whose file has no \"dim\"");
  const auto neither = put(R"({"dim":4})");
  for (const auto& told : {message([&] { dimensions(neither); }), message([&] { read(neither, {}); }),
                           message([&] { read_plate(neither, kRoles); })}) {
    EXPECT_NE(told.find("dim = 4 must be 2"), std::string::npos) << told;
  }
}

// Rows of bricks that touch along their edges and ends, turned by atan(1/2): their corners are no numbers of the file's
// raster, and what its rounding makes of them is no overlap.
TEST_F(PlateFile, StrandsThatTouchDoNotOverlapHoweverTheyAreTurned) {
  PlateMat mat;
  mat.length_mm = mat.width_mm = 200;
  mat.layer_thickness_mm = 0.8;
  mat.layers.resize(1);
  mat.layers[0].role = "surface";
  const double turn = std::atan(0.5);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 4; ++j) {
      const double x = 30 * i + 11 * (j % 2), y = 7 * j;
      PlateStrand strand{60 + x * std::cos(turn) - y * std::sin(turn),
                         60 + x * std::sin(turn) + y * std::cos(turn),
                         30,
                         7,
                         turn * 180 / std::numbers::pi,
                         {},
                         {}};
      mat.layers[0].strands.push_back(strand);
    }
  }
  const auto file = put(to_text(mat));
  EXPECT_EQ(read_plate(file, kRoles).layers[0].strands.size(), 12U);
  mat.layers[0].strands[5].width_mm += 2.1 * kMayOverlap_mm;
  EXPECT_THROW(validate(mat, kRoles, "mat"), InputError);
}

struct PlateFault {
  const char* name;
  std::string text;
  std::vector<const char*> told;
};

std::string plate_of(const std::string& strand, const std::string& more = "") {
  return R"({"dim":3,"length_mm":100,"width_mm":60,"layer_thickness_mm":0.8)" + more +
         R"(,"layers":[{"role":"surface","strands":[{"cx":50,"cy":30,"length":40,"width":9}]},
             {"role":"core","strands":[{"cx":20,"cy":30,"length":40,"width":10},)" +
         strand + "]}]}";
}

class BadPlateFile : public PlateFile, public testing::WithParamInterface<PlateFault> {};

TEST_P(BadPlateFile, GetsOneClearMessage) {
  const auto file = put(GetParam().text);
  try {
    read_plate(file, kRoles);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find(file.string() + ":"), 0U) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    for (const auto* words : GetParam().told) EXPECT_NE(message.find(words), std::string::npos) << message;
  }
}

const char* const kSecond = "layer 2, strand 2: ";

INSTANTIATE_TEST_SUITE_P(
    Faults, BadPlateFile,
    testing::Values(
        PlateFault{
            "Overlap", plate_of(R"({"cx":29.9,"cy":30,"length":40,"width":10})"), {kSecond, "overlaps strand 1;"}},
        PlateFault{"OverlapTurned",
                   plate_of(R"({"cx":45,"cy":30,"length":45,"width":10,"angle_deg":0})"),
                   {kSecond, "overlaps strand 1;"}},
        PlateFault{"OverlapOverTheEdge",
                   plate_of(R"({"cx":96,"cy":30,"length":60,"width":8,"angle_deg":0})"),
                   {kSecond, "overlaps strand 1, moved by (100, 0) mm as the window repeats"}},
        PlateFault{"OwnImage",
                   plate_of(R"({"cx":60,"cy":30,"length":61,"width":8})"),
                   {kSecond, "overlaps its own image, moved by (0, ", "60) mm", "the window is too small"}},
        PlateFault{"OwnImageOfADrapedMat",
                   plate_of(R"({"cx":60,"cy":30,"length":61,"width":8})", R"(,"stack":"draped")"),
                   {kSecond, "overlaps its own image"}},
        PlateFault{"NoLength", plate_of(R"({"cx":60,"cy":30,"length":0,"width":8})"), {kSecond, "length = 0 must be"}},
        PlateFault{
            "NegativeWidth", plate_of(R"({"cx":60,"cy":30,"length":9,"width":-8})"), {kSecond, "width = -8 must be"}},
        PlateFault{"MissingWidth", plate_of(R"({"cx":60,"cy":30,"length":9})"), {kSecond, "key \"width\" is missing"}},
        PlateFault{"MisspeltLength",
                   plate_of(R"({"cx":60,"cy":30,"lenght":9,"width":8})"),
                   {kSecond, "key \"length\" is missing", "\"lenght\""}},
        PlateFault{"TextCentre", plate_of(R"({"cx":"6","cy":30,"length":9,"width":8})"), {kSecond, "cx = \"6\""}},
        PlateFault{"FarAway",
                   plate_of(R"({"cx":60,"cy":1e5,"length":9,"width":8})"),
                   {kSecond, "cy = 100000", "10 windows of 100 x 60 mm"}},
        PlateFault{"ManyWindowsLong",
                   plate_of(R"({"cx":60,"cy":30,"length":1000,"width":8})"),
                   {kSecond, "length = 1000", "at most 10 times"}},
        PlateFault{"WildAngle",
                   plate_of(R"({"cx":60,"cy":30,"length":9,"width":8,"angle_deg":1e300})"),
                   {kSecond, "angle_deg = 1e+300", "between"}},
        PlateFault{"MaterialIsEmpty",
                   plate_of(R"({"cx":60,"cy":30,"length":9,"width":8,"material":""})"),
                   {kSecond, "material"}},
        PlateFault{"CutAndTurned",
                   plate_of(R"({"cx":60,"cy":30,"length":20,"width":8,"angle_deg":45})", R"(,"sides":"cut")"),
                   {kSecond, "angle_deg = 45", "0 or 90 degrees"}},
        PlateFault{"CutBeyondX",
                   plate_of(R"({"cx":97,"cy":30,"length":20,"width":8})", R"(,"sides":"cut")"),
                   {kSecond, "cx = 97", "beyond the window 0 to 100 mm"}},
        PlateFault{"CutBeyondY",
                   plate_of(R"({"cx":60,"cy":9,"length":20,"width":8})", R"(,"sides":"cut")"),
                   {kSecond, "cy = 9", "beyond the window 0 to 60 mm"}},
        PlateFault{"UnknownSides",
                   plate_of(R"({"cx":60,"cy":30,"length":9,"width":8})", R"(,"sides":"roller")"),
                   {"sides = \"roller\"", "\"periodic\" or \"cut\""}},
        PlateFault{"UnknownStack",
                   plate_of(R"({"cx":60,"cy":30,"length":9,"width":8})", R"(,"stack":"pile")"),
                   {"stack = \"pile\"", "\"layers\" or \"draped\""}},
        PlateFault{"SlopesOfLayers",
                   plate_of(R"({"cx":60,"cy":30,"length":9,"width":8})", R"(,"drape_slopes":[0.1,0.2])"),
                   {"drape_slopes belongs to a mat with"}},
        PlateFault{"OneSlope",
                   plate_of(R"({"cx":60,"cy":30,"length":9,"width":8})", R"(,"stack":"draped","drape_slopes":[0.1])"),
                   {"drape_slopes has 1 numbers"}},
        PlateFault{"NegativeSlope",
                   plate_of(R"({"cx":60,"cy":30,"length":9,"width":8})", R"(,"stack":"draped","drape_slopes":[0,-1])"),
                   {"drape_slopes: -1 must be between 0 and 10"}},
        PlateFault{
            "UnknownRole",
            R"({"dim":3,"length_mm":9,"width_mm":9,"layer_thickness_mm":1,"layers":[{"role":"cor","strands":[]}]})",
            {"layer 1: ", "unknown role \"cor\"", "did you mean \"core\"?"}},
        PlateFault{
            "NoStrands",
            R"({"dim":3,"length_mm":9,"width_mm":9,"layer_thickness_mm":1,"layers":[{"role":"core","strands":[]}]})",
            {"layer 1: strands is empty"}},
        PlateFault{
            "LayerWithoutThickness",
            R"({"dim":3,"length_mm":9,"width_mm":9,"layer_thickness_mm":1,"layers":[{"role":"core","thickness_mm":0}]})",
            {"layer 1: ", "key \"strands\" is missing"}},
        PlateFault{"NoLayers",
                   R"({"dim":3,"length_mm":9,"width_mm":9,"layer_thickness_mm":1,"layers":[]})",
                   {"layers is empty"}},
        PlateFault{"NoWidth", R"({"dim":3,"length_mm":9,"layer_thickness_mm":1})", {"key \"width_mm\" is missing"}},
        PlateFault{"ZeroWidth",
                   R"({"dim":3,"length_mm":9,"width_mm":0,"layer_thickness_mm":1,"layers":[]})",
                   {"width_mm = 0 must be between"}},
        PlateFault{"NotAnObject", "[3]", {"found [3]"}}),
    [](const auto& tested) { return tested.param.name; });

TEST_F(PlateFile, WriteRefusesWhatReadWouldNotTake) {
  auto mat = read_plate(reference_mat("per_a"), kRoles);
  mat.layers[0].strands[0].cx_mm = std::nan("");
  EXPECT_THROW(write(mat, kRoles, folder_ / "bad.json"), InputError);
  EXPECT_FALSE(fs::exists(folder_ / "bad.json"));
}

}  // namespace
}  // namespace strandlab::mat
