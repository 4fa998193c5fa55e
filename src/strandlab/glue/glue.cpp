#include "strandlab/glue/glue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "strandlab/core/error.hpp"
#include "strandlab/glue/bond.hpp"
#include "strandlab/glue/rules.hpp"

namespace strandlab::glue {
namespace {

// A strand's top or bottom face: the outer row of its corner lattice with outward normals averaged at the corners.
// A place on it is s = segment + xi.
struct Face {
  std::vector<Vec<2>> corner;  // mm
  std::vector<Vec<2>> normal;  // unit, outward
  std::vector<double> arc;     // mm, deformed length up to a corner
  double sense = 1;            // -1 for a bottom face

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

Face make_face(const Strand<2>& strand, StrandFace which) {
  const auto position = corners(strand);
  Face face;
  face.sense = which == StrandFace::kTop ? 1 : -1;
  for (const auto c : strand.lattice.face_corners(which == StrandFace::kTop ? kTop<2> : kBottom<2>)) {
    face.corner.push_back(position[c]);
  }
  face.normal.assign(face.corner.size(), Vec<2>::Zero());
  face.arc.assign(face.corner.size(), 0.0);
  for (int i = 0; i < face.segments(); ++i) {
    const Vec<2> d = face.corner[i + 1] - face.corner[i];
    const Vec<2> outward = which == StrandFace::kTop ? Vec<2>(-d[1], d[0]) : Vec<2>(d[1], -d[0]);
    face.normal[i] += outward;
    face.normal[i + 1] += outward;
    face.arc[i + 1] = face.arc[i] + d.norm();
  }
  for (auto& normal : face.normal) normal.normalize();
  return face;
}

// A face on the other side of a face's glue line: one of the faces that the glue may reach. Faces in contact overlap a
// little, which is a negative gap; one further behind than `lowest` is the far side of a strand and is not reached.
struct Neighbour {
  const Face* face;
  double lowest;  // mm, gap
  int strand;
};

// A top face a and a bottom face b above it, which may be glued: where the gap is from `lowest` to `highest`, and no
// other neighbour of a or of b is nearer.
struct Pair {
  const Face& a;
  const Face& b;
  double lowest, highest;  // mm
  int strand_a, strand_b;
  const std::vector<Neighbour>& over_a;   // bottom faces near a, b among them
  const std::vector<Neighbour>& under_b;  // top faces near b, a among them
};

// The place on b that the normal of a at s meets; nothing if it passes b's ends.
std::optional<double> meet(const Face& a, double s, const Face& b) {
  const Vec<2> p = a.position(s), n = a.normal_at(s);
  // Which side of the normal's line a corner of b lies on: positive towards b's first corner, negative towards its
  // last, whichever of the two faces is the top one.
  const auto side = [&](int corner) { return a.sense * cross(n, b.corner[corner] - p); };
  int low = 0, high = b.segments();
  if (side(low) < 0 || side(high) > 0) return std::nullopt;
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    (side(middle) >= 0 ? low : high) = middle;
  }
  const double before = side(low), after = side(high);
  return low + (before > after ? std::clamp(before / (before - after), 0.0, 1.0) : 0.5);
}

// The place on b that lies opposite a place on a, and the gap along the mean of the two normals.
struct Facing {
  double place;
  double gap;  // mm
};

std::optional<Facing> facing(const Face& a, double s, const Face& b) {
  const auto place = meet(a, s, b);
  if (!place) return std::nullopt;
  const Vec<2> na = a.normal_at(s), nb = b.normal_at(*place);
  if (na.dot(nb) > kFaceToFace) return std::nullopt;
  return Facing{*place, (b.position(*place) - a.position(s)).dot((na - nb).normalized())};
}

// Whether a neighbour of place s is nearer than that of `strand`, which is at `gap`. Of two as near, the one of the
// lower number counts as nearer, so that no place is glued twice.
bool occluded(const Face& face, double s, const std::vector<Neighbour>& neighbours, int strand, double gap) {
  return std::any_of(neighbours.begin(), neighbours.end(), [&](const Neighbour& neighbour) {
    if (neighbour.strand == strand) return false;
    const auto other = facing(face, s, *neighbour.face);
    if (!other || other->gap < neighbour.lowest) return false;
    return other->gap < gap || (other->gap == gap && neighbour.strand < strand);
  });
}

// The place on b that s on a is glued to; nothing where the gap is too wide or another strand lies between the two.
std::optional<double> glued(const Pair& pair, double s) {
  const auto other = facing(pair.a, s, pair.b);
  if (!other || other->gap < pair.lowest || other->gap > pair.highest) return std::nullopt;
  if (occluded(pair.a, s, pair.over_a, pair.strand_b, other->gap)) return std::nullopt;
  if (occluded(pair.b, other->place, pair.under_b, pair.strand_a, other->gap)) return std::nullopt;
  return other->place;
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

FacePoint<2> face_point(const Face& face, int strand, StrandFace which, double s) {
  FacePoint<2> point;
  point.strand = strand;
  point.face = which;
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

// Of a strand's resin at a point of its face; 1 where the panel does not know.
double quality_at(const Panel<2>& panel, const FacePoint<2>& at) {
  const auto& strand = panel.strands[static_cast<std::size_t>(at.strand)];
  if (strand.points.bond_quality.empty()) return 1;
  return strand.points
      .bond_quality[strand.lattice.point({at.segment, at.face == StrandFace::kTop ? strand.lattice.counts[1] - 1 : 0})];
}

// Resin on the faces of a panel.
class Resin {
 public:
  Resin(const Panel<2>& panel, const Coverage& coverage) : coverage_(coverage) {
    if (coverage.spot_mm == 0) return;
    for (const auto& strand : panel.strands) {
      lengths_.push_back(strand.lattice.spacing[0]);
      const double length = lengths_.back() * strand.lattice.counts[0];
      for (int side = 0; side < 2; ++side) spots_.emplace_back(coverage, length, spots_.size());
    }
  }

  // What a bond lacks between two faces, from `before` to `after` (mm as formed) about these points.
  double lacking(const FacePoint<2>& a, const FacePoint<2>& b, double before, double after) const {
    const bool even = spots_.empty();
    return glue::lacking(coverage_,
                         even ? coverage_.mean : .5 * (covered(a, before, after) + covered(b, before, after)));
  }

 private:
  double covered(const FacePoint<2>& at, double before, double after) const {
    const auto strand = static_cast<std::size_t>(at.strand);
    const double place = (at.segment + at.xi) * lengths_[strand];
    return spots_[2 * strand + (at.face == StrandFace::kTop ? 1 : 0)].covered(place - before, place + after);
  }
  const Coverage& coverage_;
  std::vector<double> lengths_;  // mm, of a segment, by strand
  std::vector<Spots> spots_;     // by strand: on its bottom, on its top
};

void append_points(const Panel<2>& panel, const Resin& resin, const Pair& pair, const Line& line,
                   std::vector<GluePoint<2>>& points) {
  const double step = (line.last - line.first) / line.intervals;
  for (int k = 0; k <= line.intervals; ++k) {
    const double s = k == line.intervals ? line.last : line.first + k * step;
    const auto other = glued(pair, s);
    if (!other) continue;  // a gap shorter than the sampling of contact_stretches
    GluePoint<2> point;
    point.a = face_point(pair.a, line.strand_a, StrandFace::kTop, s);
    point.b = face_point(pair.b, line.strand_b, StrandFace::kBottom, *other);
    point.normal = (pair.a.normal_at(s) - pair.b.normal_at(*other)).normalized();
    point.gap = (point.b.position - point.a.position).dot(point.normal);
    const double from = std::max(s - 0.5 * step, line.first), to = std::min(s + 0.5 * step, line.last);
    point.area = pair.a.arc_at(to) - pair.a.arc_at(from);
    point.quality = .5 * (quality_at(panel, point.a) + quality_at(panel, point.b));
    const double spacing = panel.strands[static_cast<std::size_t>(line.strand_a)].lattice.spacing[0];
    point.lacking = resin.lacking(point.a, point.b, (s - from) * spacing, (to - s) * spacing);
    if (point.quality >= kLeastQuality && std::isfinite(point.lacking)) points.push_back(point);
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

struct Faces {
  std::vector<Face> tops, bottoms;  // by strand
  std::vector<Box> top_boxes, bottom_boxes;
};

Faces make_faces(const Panel<2>& panel) {
  Faces faces;
  for (const auto& strand : panel.strands) {
    faces.tops.push_back(make_face(strand, StrandFace::kTop));
    faces.bottoms.push_back(make_face(strand, StrandFace::kBottom));
    faces.top_boxes.push_back(bounding_box(faces.tops.back()));
    faces.bottom_boxes.push_back(bounding_box(faces.bottoms.back()));
  }
  return faces;
}

}  // namespace

void check(const CuringOptions& options) {
  if (!(options.max_gap_mm > 0) || !std::isfinite(options.max_gap_mm)) {
    throw InputError(fmt::format("curing gap of {} mm: it must be positive", options.max_gap_mm));
  }
  if (!(options.point_spacing_mm >= 0) || !std::isfinite(options.point_spacing_mm)) {
    throw InputError(
        fmt::format("spacing of glue points of {} mm: it must be positive, or 0 for that of the material points",
                    options.point_spacing_mm));
  }
  check(options.coverage);
}

std::vector<GluePoint<2>> cure(const Panel<2>& panel, const CuringOptions& options) {
  check(options);
  const auto faces = make_faces(panel);
  const Resin resin(panel, options.coverage);
  const int strands = static_cast<int>(panel.strands.size());
  std::vector<std::vector<Neighbour>> over(panel.strands.size()), under(panel.strands.size());
  for (int a = 0; a < strands; ++a) {
    for (int b = 0; b < strands; ++b) {
      const double overlap =
          overlap_in_contact(panel.strands[a].lattice.thickness(), panel.strands[b].lattice.thickness());
      const bool above = panel.strands[b].row > panel.strands[a].row;
      if (!above || !near(faces.top_boxes[a], faces.bottom_boxes[b], std::max(options.max_gap_mm, overlap))) continue;
      over[a].push_back({&faces.bottoms[b], -overlap, b});
      under[b].push_back({&faces.tops[a], -overlap, a});
    }
  }
  std::vector<GluePoint<2>> points;
  for (int a = 0; a < strands; ++a) {
    const auto& lower = panel.strands[a];
    for (const auto& [face, lowest, b] : over[a]) {
      const auto& upper = panel.strands[b];
      const Pair pair{faces.tops[a], *face, lowest, options.max_gap_mm, a, b, over[a], under[b]};
      const double spacing = options.point_spacing_mm > 0 ? options.point_spacing_mm : lower.lattice.spacing[0];
      for (const auto& [first, last] : contact_stretches(pair)) {
        const double on_b = std::abs(*glued(pair, last) - *glued(pair, first)) * upper.lattice.spacing[0];
        const double length = 0.5 * ((last - first) * lower.lattice.spacing[0] + on_b);  // as formed
        if (length < 1e-3 * spacing) continue;                                           // a touch, not a line
        append_points(panel, resin, pair,
                      {a, b, std::max(1, static_cast<int>(std::lround(length / spacing))), first, last}, points);
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
    if (strand.row < top_row) length += make_face(strand, StrandFace::kTop).arc.back();
    if (strand.row > 0) length += make_face(strand, StrandFace::kBottom).arc.back();
  }
  return length;
}

}  // namespace strandlab::glue
