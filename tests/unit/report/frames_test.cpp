// Frames come out of their packing as they went in, to the quantum.
#include "strandlab/report/frames.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "strandlab/core/error.hpp"
#include "strandlab/panel/point_fields.hpp"
#include "unit/report/synthetic_panel.hpp"

namespace strandlab::report {
namespace {

using test::flat_strand;
using test::panel_of;

std::vector<std::uint8_t> bytes_of(const std::string& base64) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  std::uint32_t group = 0;
  int bits = 0;
  for (const char c : base64) {
    if (c == '=') break;
    group = group << 6U | static_cast<std::uint32_t>(digits.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(static_cast<std::uint8_t>(group >> static_cast<unsigned>(bits) & 255U));
  }
  return bytes;
}

std::int64_t next_number(const std::vector<std::uint8_t>& bytes, std::size_t& at) {
  std::uint64_t value = 0;
  for (unsigned shift = 0;; shift += 7) {
    const auto byte = bytes.at(at++);
    value |= static_cast<std::uint64_t>(byte & 127U) << shift;
    if (byte < 128) break;
  }
  return value % 2 == 0 ? static_cast<std::int64_t>(value / 2) : -static_cast<std::int64_t>(value / 2) - 1;
}

// Two strands on one another, waved and flattened more and more.
std::vector<Panel<2>> film() {
  std::vector<Panel<2>> frames;
  for (const double compaction : {0.0, 0.1, 0.25}) {
    auto panel = panel_of({flat_strand(0, 20, 0, 1, 20, 3), flat_strand(5, 20, 1, 2, 15, 3)}, 20, 2);
    panel.strands[1].row = 1;
    test::undulate(panel, 0.1 * compaction, 8);
    test::compact(panel, compaction);
    for (auto& strand : panel.strands) {
      for (std::size_t p = 0; p < strand.size(); ++p) {
        strand.points.plastic[p] = compaction * static_cast<double>(p);
        strand.points.stress[p][2] = -10 * compaction * static_cast<double>(p % 7);
      }
    }
    frames.push_back(panel);
  }
  return frames;
}

TEST(Frames, UnpackToTheQuantum) {
  const auto frames = film();
  const auto packed = pack_frames(frames, {});
  const double quantum = packed.at("quantum_mm");
  EXPECT_NEAR(quantum, 20e-5, 1e-15);
  ASSERT_EQ(packed.at("frames").size(), frames.size());
  ASSERT_EQ(packed.at("strands").size(), 2U);
  EXPECT_EQ(packed["strands"][1]["row"], 1);
  std::vector<std::array<std::int64_t, 2>> quanta;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const auto& frame = packed["frames"][f];
    EXPECT_DOUBLE_EQ(frame.at("compaction"), frames[f].compaction());
    const auto bytes = bytes_of(frame.at("cells"));
    std::size_t at = 0, corner = 0;
    for (const auto& strand : frames[f].strands) {
      std::array<std::int64_t, 2> last{};
      for (const auto& expected : corners(strand)) {
        if (f == 0) quanta.emplace_back();
        for (std::size_t d = 0; d < 2; ++d) {
          last[d] += next_number(bytes, at);
          quanta[corner][d] += last[d];
          EXPECT_NEAR(static_cast<double>(quanta[corner][d]) * quantum, expected[static_cast<Eigen::Index>(d)],
                      0.5001 * quantum);
        }
        ++corner;
      }
    }
    for (const auto& field : packed.at("fields")) {
      const double low = field.at("low"), high = field.at("high");
      ASSERT_LT(low, high);
      for (const auto& strand : frames[f].strands) {
        for (std::size_t p = 0; p < strand.size(); ++p) {
          const double shown = low + (high - low) * bytes.at(at++) / 255;
          if (field.at("key") == "plastic_strain") {
            EXPECT_NEAR(shown, strand.points.plastic[p], (high - low) / 255 + 1e-12);
          }
          if (field.at("key") == "density_kg_m3") {
            EXPECT_NEAR(shown, density_kg_m3(strand, p), (high - low) / 255 + 1e-9);
          }
        }
      }
    }
    EXPECT_EQ(at, bytes.size()) << "bytes of frame " << f << " left over";
  }
}

// The second strand lies on the first from x = 5 to 20: one line between them, 15 mm long, at y = 1.
TEST(Frames, GlueLinesLieWhereStrandsTouch) {
  const auto packed = pack_frames({film()[0]}, {});
  const double quantum = packed.at("quantum_mm");
  const auto bytes = bytes_of(packed.at("frames")[0].at("glue"));
  std::size_t at = 0;
  EXPECT_EQ(next_number(bytes, at), 0);
  EXPECT_EQ(next_number(bytes, at), 1);
  const auto count = next_number(bytes, at);
  ASSERT_GT(count, 10);
  std::array<std::int64_t, 2> place{};
  double first = 0;
  for (std::int64_t i = 0; i < count; ++i) {
    for (auto& coordinate : place) coordinate += next_number(bytes, at);
    if (i == 0) first = static_cast<double>(place[0]) * quantum;
    EXPECT_NEAR(static_cast<double>(place[1]) * quantum, 1, quantum);
  }
  EXPECT_NEAR(first, 5, 1e-3);
  EXPECT_NEAR(static_cast<double>(place[0]) * quantum, 20, 1e-3);
  EXPECT_EQ(at, bytes.size()) << "one line only";
}

TEST(Frames, OfDifferentMatsAreRefused) {
  auto other = film()[1];
  other.strands.pop_back();
  EXPECT_THROW(pack_frames({film()[0], other}, {}), InputError);
}

// A mat of the main job keeps about 8000 cells, so that 41 frames stay within a few megabytes: at most 2 numbers of 3
// bytes a corner and 5 bytes a cell, over 3/4 for base64.
TEST(Frames, OfAPanelAreSmall) {
  const auto panel = test::reference_panel("osb_s1");
  const auto frame = frame_of(panel);
  std::size_t cells = 0;
  for (const auto& strand : frame.strands) cells += strand.size();
  EXPECT_GT(cells, 6000U);
  EXPECT_LT(cells, 9000U);
  auto pressed = frame;
  test::undulate(pressed, 0.05, 10);
  test::compact(pressed, 0.01);
  const auto packed = pack_frames({frame, pressed}, {});
  EXPECT_LT(packed["frames"][1].dump().size(), 180000U);
}

TEST(Frames, NoneIsAnEmptyFilm) {
  EXPECT_TRUE(pack_frames({}, {}).at("frames").empty());
}

}  // namespace
}  // namespace strandlab::report
