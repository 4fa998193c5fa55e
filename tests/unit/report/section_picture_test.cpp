#include "strandlab/report/section_picture.hpp"

#include <cairo.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <set>

#include "strandlab/core/error.hpp"
#include "strandlab/report/colour_map.hpp"
#include "support/fontconfig_leaks.hpp"
#include "support/temporary_folder.hpp"
#include "synthetic_panel.hpp"

namespace strandlab::report {
namespace {

using test::flat_strand;
using test::message_of;
using test::panel_of;
using test::TemporaryFolder;

// A picture read back from its file.
class Image {
 public:
  explicit Image(const std::filesystem::path& file) : surface_(cairo_image_surface_create_from_png(file.c_str())) {
    EXPECT_EQ(cairo_surface_status(surface_), CAIRO_STATUS_SUCCESS) << file;
  }
  ~Image() { cairo_surface_destroy(surface_); }
  Image(const Image&) = delete;
  Image& operator=(const Image&) = delete;
  int width() const { return cairo_image_surface_get_width(surface_); }
  int height() const { return cairo_image_surface_get_height(surface_); }
  std::array<int, 3> at(int x, int y) const {
    const unsigned char* p =
        cairo_image_surface_get_data(surface_) + y * cairo_image_surface_get_stride(surface_) + 4 * x;
    return {p[2], p[1], p[0]};
  }
  int count(const Colour& colour) const {
    int n = 0;
    for (int y = 0; y < height(); ++y) {
      for (int x = 0; x < width(); ++x) n += near(at(x, y), colour) ? 1 : 0;
    }
    return n;
  }

 private:
  static bool near(const std::array<int, 3>& pixel, const Colour& c) {
    return std::abs(pixel[0] - 255 * c.red) < 2 && std::abs(pixel[1] - 255 * c.green) < 2 &&
           std::abs(pixel[2] - 255 * c.blue) < 2;
  }
  cairo_surface_t* surface_;
};

double brightness(const Colour& c) {
  return 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue;
}

// Denser is darker, step by step, so that the picture also reads in grey.
TEST(ColourMap, SequentialFallsInBrightness) {
  for (int i = 0; i < 100; ++i) EXPECT_GT(brightness(sequential(i / 100.0)), brightness(sequential((i + 1) / 100.0)));
}

TEST(ColourMap, DivergingIsBrightestInTheMiddleBlueBelowRedAbove) {
  for (int i = 0; i < 50; ++i) {
    EXPECT_LT(brightness(diverging(i / 100.0)), brightness(diverging((i + 1) / 100.0)));
    EXPECT_LT(brightness(diverging(1 - i / 100.0)), brightness(diverging(1 - (i + 1) / 100.0)));
  }
  EXPECT_GT(diverging(0.2).blue, diverging(0.2).red);
  EXPECT_GT(diverging(0.8).red, diverging(0.8).blue);
}

TEST(ColourMap, ValuesOutsideTakeTheEnds) {
  EXPECT_EQ(sequential(-3).red, sequential(0).red);
  EXPECT_EQ(diverging(7).red, diverging(1).red);
  EXPECT_EQ(sequential(std::nan("")).red, 0.5);
}

TEST(ColourRange, IsSharedRoundAndSymmetric) {
  auto before = panel_of({flat_strand(0, 10, 0, 1, 40, 6)}, 10, 1);
  auto after = before;
  test::compact(after, 0.4);  // 350 -> 583 kg/m^3
  const auto density = common_range({&before, &after}, Colouring::kDensity);
  EXPECT_EQ(density.low, 350);
  EXPECT_EQ(density.high, 600);
  for (auto& F : after.strands[0].points.F) F = Tensor<2>{{1, 0}, {-std::tan(0.2), 1}} * F;  // -11.46 degrees
  const auto angle = common_range({&before, &after}, Colouring::kGrainAngle);
  EXPECT_EQ(angle.low, -12);
  EXPECT_EQ(angle.high, 12);
}

TEST(ColourRange, OfAFlatMatIsNotEmpty) {
  const auto mat = panel_of({flat_strand(0, 10, 0, 1, 40, 6)}, 10, 1);
  for (const auto colouring : {Colouring::kDensity, Colouring::kGrainAngle}) {
    const auto range = common_range({&mat}, colouring);
    EXPECT_LT(range.low, range.high);
  }
}

// A flat strand that fills half the window paints half the section in its colour.
TEST(SectionPicture, PaintsStrandsInTheirColour) {
  const TemporaryFolder folder;
  const auto panel = panel_of({flat_strand(0, 10, 0, 2, 40, 6)}, 20, 2);
  draw_section(panel, {Colouring::kDensity, ColourRange{200, 500}, "", 1000, 1}, folder / "a.png");
  const Image image(folder / "a.png");
  EXPECT_EQ(image.width(), 1000);
  const double section = 1000 * (1 - 11.2 / 85);  // px, what the margins leave
  const double expected = section / 2 * section / 10;
  EXPECT_NEAR(image.count(sequential(0.5)), expected, 0.05 * expected);  // but for outline and colour bar
}

TEST(SectionPicture, AllStatesOfARunHaveOneFrame) {
  const TemporaryFolder folder;
  auto panel = test::reference_panel("osb_s1");
  draw_section(panel, {}, folder / "before.png");
  test::undulate(panel, 0.2, 12);
  test::compact(panel, 0.4);
  draw_section(panel, {}, folder / "after.png");
  const Image before(folder / "before.png"), after(folder / "after.png");
  EXPECT_EQ(before.width(), 2000);
  EXPECT_EQ(before.height(), after.height());
}

TEST(SectionPicture, ExaggerationStretchesTheHeightOnly) {
  const TemporaryFolder folder;
  const auto panel = panel_of({flat_strand(0, 20, 0, 4, 40, 6)}, 20, 4);
  draw_section(panel, {Colouring::kGrainAngle, {}, "", 1000, 1}, folder / "1.png");
  draw_section(panel, {Colouring::kGrainAngle, {}, "", 1000, 3}, folder / "3.png");
  const Image one(folder / "1.png"), three(folder / "3.png");
  EXPECT_EQ(three.width(), 1000);
  EXPECT_NEAR(three.height() - one.height(), 2 * 1000 * (1 - 11.2 / 85) * 4 / 20, 2);
}

// 84 mm are 992 pixels of 1/300 inch, which are 238.08 points.
TEST(SectionPicture, ForPaperHasItsWidth) {
  const TemporaryFolder folder;
  const auto panel = panel_of({flat_strand(0, 20, 0, 4, 40, 6)}, 20, 4);
  PictureOptions options;
  const auto drawn = [&](PaperFormat format, const char* name) {
    options.paper = Paper{format, 84, "sans", 8};
    draw_section(panel, options, folder / name);
    return test::contents(folder / name);
  };
  drawn(PaperFormat::kPng, "a.png");
  EXPECT_EQ(Image(folder / "a.png").width(), 992);
  EXPECT_NE(drawn(PaperFormat::kSvg, "a.svg").find("width=\"238.08"), std::string::npos);
  const auto pdf = drawn(PaperFormat::kPdf, "a.pdf");
  EXPECT_EQ(pdf.substr(0, 4), "%PDF");
  EXPECT_NE(pdf.find("238.08"), std::string::npos) << "of the page's box";
  EXPECT_TRUE(pdf == drawn(PaperFormat::kPdf, "b.pdf")) << "no time of the day is in it";
}

TEST(SectionPicture, OptionsOutOfRangeAreNamed) {
  const TemporaryFolder folder;
  const auto panel = panel_of({flat_strand(0, 10, 0, 2, 40, 6)}, 20, 2);
  const auto refusal = [&](const PictureOptions& options) {
    return message_of<InputError>([&] { draw_section(panel, options, folder / "a.png"); });
  };
  EXPECT_EQ(refusal({Colouring::kDensity, {}, "", 100, 1}), "picture width is 100 pixels, allowed 400..20000");
  EXPECT_EQ(refusal({Colouring::kDensity, {}, "", 1000, 0}), "vertical exaggeration is 0, allowed 0.1..20");
  EXPECT_EQ(refusal({Colouring::kDensity, ColourRange{5, 5}, "", 1000, 1}), "colour range 5..5 is empty");
  EXPECT_EQ(folder.files(), 0U);
  EXPECT_THROW(draw_section(panel, {}, folder / "none" / "a.png"), InputError);
}

}  // namespace
}  // namespace strandlab::report
