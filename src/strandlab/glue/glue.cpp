#include "strandlab/glue/glue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "strandlab/core/error.hpp"

namespace strandlab::glue {
namespace {

// A strand's top or bottom face: the outer row of its corner lattice with outward normals averaged at the corners.
// A place on it is s = segment + xi.
struct Face {
  std::vector<Vec<2>> corner;  // mm
  std::vector<Vec<2>> normal;  // unit, outward
  std::vector<double> arc;     // mm, deformed length up to a corner

  int segments() const { return static_cast<int>(corner.size()) - 1; }
  int segment_of(double s) const { return std::clamp(static_cast<int>(s), 0, segments() - 1); }
  Vec<2> position(double s) const {
    const int i = segment_of(s);
    return corner[i] + (s - i) * (corner[i + 1] - corner[i]);
  }
  Vec<2> normal_at(double s) const {
    const int i = segment_of(s);
    return (normal[i] + (s - i) * (normal[i + 1] - normal[i])).normalized();
  }
  double arc_at(double s) const {
    const int i = segment_of(s);
    return arc[i] + (s - i) * (arc[i + 1] - arc[i]);
  }
};

double cross(const Vec<2>& a, const Vec<2>& b) {
  return a[0] * b[1] - a[1] * b[0];
}

Face make_face(const Strand<2>& strand, Side side) {
  const auto lattice = corners(strand);
  const int n = strand.points[0] + 1;
  const auto begin = lattice.begin() + (side == Side::kTop ? static_cast<std::ptrdiff_t>(n) * strand.points[1] : 0);
  Face face;
  face.corner.assign(begin, begin + n);
  face.normal.assign(face.corner.size(), Vec<2>::Zero());
  face.arc.assign(face.corner.size(), 0.0);
  for (int i = 0; i < face.segments(); ++i) {
    const Vec<2> d = face.corner[i + 1] - face.corner[i];
    const Vec<2> outward = side == Side::kTop ? Vec<2>(-d[1], d[0]) : Vec<2>(d[1], -d[0]);
    face.normal[i] += outward;
    face.normal[i + 1] += outward;
    face.arc[i + 1] = face.arc[i] + d.norm();
  }
  for (auto& normal : face.normal) normal.normalize();
  return face;
}

// The two faces that may be glued and how far apart: gap within (lowest, highest).
struct Pair {
  const Face& a;           // a top face
  const Face& b;           // a bottom face above it
  double lowest, highest;  // mm
};

// Where the normal of face a at s meets face b, as a place on b; nothing if it passes b's ends.
std::optional<double> meet(const Face& a, double s, const Face& b) {
  const Vec<2> p = a.position(s), n = a.normal_at(s);
  const auto side = [&](int corner) {
    return cross(n, b.corner[corner] - p);
  };  // falls along b, which lies to the right of n
  int low = 0, high = b.segments();
  if (side(low) < 0 || side(high) > 0) return std::nullopt;
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    (side(middle) >= 0 ? low : high) = middle;
  }
  const double before = side(low), after = side(high);
  return low + (before > after ? std::clamp(before / (before - after), 0.0, 1.0) : 0.5);
}

// The place on b that s on a is glued to, if it is.
std::optional<double> glued(const Pair& pair, double s) {
  const auto other = meet(pair.a, s, pair.b);
  if (!other) return std::nullopt;
  const Vec<2> na = pair.a.normal_at(s), nb = pair.b.normal_at(*other);
  if (na.dot(nb) > -0.5) return std::nullopt;  // not face to face
  const double gap = (pair.b.position(*other) - pair.a.position(s)).dot((na - nb).normalized());
  if (gap < pair.lowest || gap > pair.highest) return std::nullopt;
  return other;
}

// Last place from `inside` (glued) towards `outside` (not glued) that is glued.
double last_glued(const Pair& pair, double inside, double outside) {
  for (int step = 0; step < 50; ++step) {
    const double middle = 0.5 * (inside + outside);
    (glued(pair, middle) ? inside : outside) = middle;
  }
  return inside;
}

// Stretches [first, second] of face a that are glued to face b. Sampled at every corner and halfway between, ends
// bisected.
std::vector<std::pair<double, double>> contact_stretches(const Pair& pair) {
  std::vector<std::pair<double, double>> stretches;
  const int samples = 2 * pair.a.segments();
  bool before = false;
  for (int k = 0; k <= samples; ++k) {
    const double s = 0.5 * k;
    const bool now = glued(pair, s).has_value();
    if (now && !before) stretches.emplace_back(k == 0 ? s : last_glued(pair, s, s - 0.5), s);
    if (!now && before) stretches.back().second = last_glued(pair, s - 0.5, s);
    if (now) stretches.back().second = s;
    before = now;
  }
  return stretches;
}

FacePoint<2> face_point(const Face& face, int strand, Side side, double s) {
  FacePoint<2> point;
  point.strand = strand;
  point.side = side;
  point.segment = face.segment_of(s);
  point.xi = s - point.segment;
  point.position = face.position(s);
  return point;
}

struct Line {
  int strand_a, strand_b;
  int intervals;       // between glue points
  double first, last;  // the stretch, on face a
};

void append_points(const Pair& pair, const Line& line, std::vector<GluePoint<2>>& points) {
  const double step = (line.last - line.first) / line.intervals;
  for (int k = 0; k <= line.intervals; ++k) {
    const double s = k == line.intervals ? line.last : line.first + k * step;
    const auto other = glued(pair, s);
    if (!other) continue;  // a gap shorter than the sampling of contact_stretches
    GluePoint<2> point;
    point.a = face_point(pair.a, line.strand_a, Side::kTop, s);
    point.b = face_point(pair.b, line.strand_b, Side::kBottom, *other);
    point.normal = (pair.a.normal_at(s) - pair.b.normal_at(*other)).normalized();
    point.gap = (point.b.position - point.a.position).dot(point.normal);
    point.area =
        pair.a.arc_at(std::min(s + 0.5 * step, line.last)) - pair.a.arc_at(std::max(s - 0.5 * step, line.first));
    points.push_back(point);
  }
}

struct Box {
  Vec<2> low, high;
};

Box bounding_box(const Face& face) {
  Box box{face.corner.front(), face.corner.front()};
  for (const auto& c : face.corner) {
    box.low = box.low.cwiseMin(c);
    box.high = box.high.cwiseMax(c);
  }
  return box;
}

bool near(const Box& a, const Box& b, double distance) {
  return ((a.low - b.high).array() < distance).all() && ((b.low - a.high).array() < distance).all();
}

void check(const CuringOptions& options) {
  if (!(options.max_gap_mm > 0) || !std::isfinite(options.max_gap_mm)) {
    throw InputError(fmt::format("curing gap of {} mm: it must be positive", options.max_gap_mm));
  }
  if (!(options.point_spacing_mm >= 0) || !std::isfinite(options.point_spacing_mm)) {
    throw InputError(
        fmt::format("spacing of glue points of {} mm: it must be positive, or 0 for that of the material points",
                    options.point_spacing_mm));
  }
}

}  // namespace

std::vector<GluePoint<2>> cure(const Panel<2>& panel, const CuringOptions& options) {
  check(options);
  std::vector<Face> tops, bottoms;
  for (const auto& strand : panel.strands) {
    tops.push_back(make_face(strand, Side::kTop));
    bottoms.push_back(make_face(strand, Side::kBottom));
  }
  std::vector<Box> boxes;
  boxes.reserve(bottoms.size());
  for (const auto& bottom : bottoms) boxes.push_back(bounding_box(bottom));

  std::vector<GluePoint<2>> points;
  for (int a = 0; a < static_cast<int>(tops.size()); ++a) {
    const auto& lower = panel.strands[a];
    const Box box = bounding_box(tops[a]);
    for (int b = 0; b < static_cast<int>(bottoms.size()); ++b) {
      const auto& upper = panel.strands[b];
      const double overlap = 0.5 * std::min(formed_thickness(lower), formed_thickness(upper));
      if (upper.row <= lower.row || !near(box, boxes[b], std::max(options.max_gap_mm, overlap))) continue;
      const Pair pair{tops[a], bottoms[b], -overlap, options.max_gap_mm};
      const double spacing = options.point_spacing_mm > 0 ? options.point_spacing_mm : lower.spacing[0];
      for (const auto& [first, last] : contact_stretches(pair)) {
        const double on_b = std::abs(*glued(pair, last) - *glued(pair, first)) * upper.spacing[0];
        const double length = 0.5 * ((last - first) * lower.spacing[0] + on_b);  // as formed
        if (length < 1e-3 * spacing) continue;                                   // a touch, not a line
        append_points(pair, {a, b, std::max(1, static_cast<int>(std::lround(length / spacing))), first, last}, points);
      }
    }
  }
  return points;
}

double facing_length(const Panel<2>& panel) {
  int top_row = 0;
  for (const auto& strand : panel.strands) top_row = std::max(top_row, strand.row);
  double length = 0;
  for (const auto& strand : panel.strands) {
    if (strand.row < top_row) length += make_face(strand, Side::kTop).arc.back();
    if (strand.row > 0) length += make_face(strand, Side::kBottom).arc.back();
  }
  return length;
}

}  // namespace strandlab::glue
