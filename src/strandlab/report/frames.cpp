#include "strandlab/report/frames.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "strandlab/core/error.hpp"
#include "strandlab/files/base64.hpp"
#include "strandlab/panel/lumped.hpp"
#include "strandlab/panel/point_fields.hpp"

namespace strandlab::report {
namespace {

using Json = nlohmann::json;

constexpr double kCells = 8000;
constexpr int kThrough = 3;
constexpr double kQuantaPerLength = 1e5;
constexpr double kTrimmed = 0.0005;  // share of the cells at each end that a field's bytes may clip

// What the section can be coloured by, in the words of the page.
struct Field {
  std::string key, label, unit;
  int digits = 0;          // shown behind the point
  bool diverging = false;  // its colours are symmetric about 0
  std::function<double(const Strand<2>&, std::size_t)> value;
};

// "plastic_strain" is "Plastic strain", "temperature_C" of unit "C" is "Temperature".
std::string label_of(std::string name, const std::string& unit) {
  if (name.ends_with("_" + unit)) name.resize(name.size() - unit.size() - 1);
  std::replace(name.begin(), name.end(), '_', ' ');
  name.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(name.front())));
  return name;
}

// What can be read off points as these are, and the fields of theirs that are shown as they are.
std::vector<Field> colourings(const Points<2>& points) {
  const auto stress = [](const Strand<2>& s, std::size_t p) {
    return cauchy_stress<2>(s.points.F[p], s.points.stress[p]);
  };
  std::vector<Field> fields{{"grain_angle_deg", "Grain angle", "°", 1, true,
                             [](const Strand<2>& s, std::size_t p) { return grain_angle_deg<2>(s.points.F[p]); }},
                            {"density_kg_m3", "Density", "kg/m³", 0, false,
                             [](const Strand<2>& s, std::size_t p) { return density_kg_m3(s, p); }}};
  for_each_shown_field<2>(points, [&](const auto& field) {
    const std::string unit = field.unit == std::string_view("1") ? "" : field.unit;
    fields.push_back({field.name, label_of(field.name, unit), unit, 3, false,
                      [field](const Strand<2>& s, std::size_t p) { return (s.points.*field.values)[p]; }});
  });
  fields.push_back({"stress_through_MPa", "Stress through thickness (tension +)", "MPa", 2, true,
                    [=](const Strand<2>& s, std::size_t p) { return stress(s, p)(1, 1); }});
  fields.push_back({"stress_along_MPa", "Stress along panel (tension +)", "MPa", 1, true,
                    [=](const Strand<2>& s, std::size_t p) { return stress(s, p)(0, 0); }});
  return fields;
}

void append_number(std::string& bytes, std::int64_t n) {
  auto zigzag = n >= 0 ? 2 * static_cast<std::uint64_t>(n) : 2 * static_cast<std::uint64_t>(-(n + 1)) + 1;
  for (; zigzag >= 128; zigzag >>= 7U) bytes += static_cast<char>((zigzag & 127U) | 128U);
  bytes += static_cast<char>(zigzag);
}

using Quanta = std::vector<std::array<std::int64_t, 2>>;

// Corners of all strands in quanta, and where each strand begins.
Quanta quanta(const Panel<2>& panel, double quantum, std::vector<std::size_t>& starts) {
  Quanta all;
  starts.clear();
  for (const auto& strand : panel.strands) {
    starts.push_back(all.size());
    for (const auto& c : corners(strand)) {
      if (!c.allFinite()) throw InputError("a frame has a corner that is not a finite number");
      all.push_back({std::llround(c[0] / quantum), std::llround(c[1] / quantum)});
    }
  }
  return all;
}

std::string pack_corners(const Quanta& now, const Quanta& before, const std::vector<std::size_t>& starts) {
  std::string bytes;
  auto start = starts.begin();
  std::array<std::int64_t, 2> last{};
  for (std::size_t c = 0; c < now.size(); ++c) {
    if (start != starts.end() && *start == c) {
      last = {};
      ++start;
    }
    for (std::size_t d = 0; d < 2; ++d) {
      const auto value = now[c][d] - (before.empty() ? 0 : before[c][d]);
      append_number(bytes, value - last[d]);
      last[d] = value;
    }
  }
  return bytes;
}

struct Range {
  double low = 0, high = 1;
};

// All values of a field over all frames, but for the extreme ones; never empty.
Range range_of(const std::vector<Panel<2>>& frames, const Field& field) {
  std::vector<double> values;
  for (const auto& frame : frames) {
    for (const auto& strand : frame.strands) {
      for (std::size_t p = 0; p < strand.size(); ++p) {
        const double value = field.value(strand, p);
        if (std::isfinite(value)) values.push_back(value);
      }
    }
  }
  if (values.empty()) return {};
  const auto at = [&values](double share) {
    const auto place = values.begin() + std::lround(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return *place;
  };
  const double low = at(kTrimmed), high = at(1 - kTrimmed);
  return {low, high > low ? high : low + 1};
}

void append_field(std::string& bytes, const Panel<2>& frame, const Field& field, const Range& range) {
  for (const auto& strand : frame.strands) {
    for (std::size_t p = 0; p < strand.size(); ++p) {
      const double t = (field.value(strand, p) - range.low) / (range.high - range.low);
      const double byte = std::isfinite(t) ? std::round(255 * std::clamp(t, 0.0, 1.0)) : 0;
      bytes += static_cast<char>(static_cast<unsigned char>(byte));
    }
  }
}

// Glue points follow one another along a line: same strands, next to each other.
bool continues(const glue::GluePoint<2>& before, const glue::GluePoint<2>& point) {
  const double reach = 2.5 * std::max(before.area, point.area);
  return before.a.strand == point.a.strand && before.b.strand == point.b.strand &&
         (point.a.position - before.a.position).norm() <= reach;
}

std::string pack_glue(const Panel<2>& frame, const glue::CuringOptions& curing, double quantum) {
  glue::CuringOptions options = curing;
  options.point_spacing_mm = 0;  // as the frame's own points
  const auto points = glue::cure(frame, options);
  std::string bytes;
  for (std::size_t first = 0, end = 0; first < points.size(); first = end) {
    for (end = first + 1; end < points.size() && continues(points[end - 1], points[end]);) ++end;
    append_number(bytes, points[first].a.strand);
    append_number(bytes, points[first].b.strand);
    append_number(bytes, static_cast<std::int64_t>(end - first));
    std::array<std::int64_t, 2> last{};
    for (std::size_t p = first; p < end; ++p) {
      const Vec<2> middle = 0.5 * (points[p].a.position + points[p].b.position);
      for (std::size_t d = 0; d < 2; ++d) {
        const auto value = std::llround(middle[static_cast<Eigen::Index>(d)] / quantum);
        append_number(bytes, value - last[d]);
        last[d] = value;
      }
    }
  }
  return bytes;
}

Json describe_strands(const Panel<2>& frame) {
  Json list = Json::array();
  for (const auto& s : frame.strands) {
    list.push_back({{"kind", s.kind}, {"row", s.row}, {"angle_deg", s.angle_deg}, {"points", s.lattice.counts}});
  }
  return list;
}

}  // namespace

Panel<2> frame_of(const Panel<2>& panel) {
  double length = 0;
  for (const auto& strand : panel.strands) length += strand.lattice.extent(0);
  return length > 0 ? lumped(panel, kThrough * length / kCells, kThrough) : panel;
}

Json pack_frames(const std::vector<Panel<2>>& frames, const glue::CuringOptions& curing) {
  Json packed{{"strands", Json::array()}, {"fields", Json::array()}, {"frames", Json::array()}};
  if (frames.empty()) return packed;
  const double quantum = frames[0].length_mm / kQuantaPerLength;
  packed["quantum_mm"] = quantum;
  packed["length_mm"] = frames[0].length_mm;
  packed["initial_thickness_mm"] = frames[0].initial_thickness_mm;
  packed["strands"] = describe_strands(frames[0]);
  const auto fields = colourings(pattern_of_points(frames[0]));
  std::vector<Range> ranges;
  for (const auto& field : fields) {
    ranges.push_back(range_of(frames, field));
    packed["fields"].push_back({{"key", field.key},
                                {"label", field.label},
                                {"unit", field.unit},
                                {"digits", field.digits},
                                {"diverging", field.diverging},
                                {"low", ranges.back().low},
                                {"high", ranges.back().high}});
  }
  Quanta before;
  std::vector<std::size_t> starts;
  for (const auto& frame : frames) {
    if (describe_strands(frame) != packed["strands"]) throw InputError("the frames are not all of the same mat");
    auto now = quanta(frame, quantum, starts);
    auto cells = pack_corners(now, before, starts);
    for (std::size_t f = 0; f < fields.size(); ++f) append_field(cells, frame, fields[f], ranges[f]);
    packed["frames"].push_back({{"compaction", frame.compaction()},
                                {"time_ms", 1e3 * frame.time_s},
                                {"bottom_mm", frame.bottom_mm},
                                {"top_mm", frame.top_mm},
                                {"cells", files::base64(cells)},
                                {"glue", files::base64(pack_glue(frame, curing, quantum))}});
    before = std::move(now);
  }
  return packed;
}

}  // namespace strandlab::report
