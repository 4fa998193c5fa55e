// Curing of panels: corners of a face, their shares of it, and what of them faces another strand.
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <optional>

#include "strandlab/core/polygon.hpp"
#include "strandlab/glue/plan_grid.hpp"
#include "strandlab/glue/rules.hpp"

namespace strandlab::glue {
namespace {

using Tangents = Eigen::Matrix<double, 3, 2>;  // mm per cell

// A strand's top or bottom face on a lattice of corners of its own, with outward normals averaged at the corners. A
// coordinate counts its cells.
struct Patch {
  Lattice<2> cells;
  Vec<2> points_per_cell;      // of the strand's lattice
  std::vector<Vec<3>> corner;  // mm
  std::vector<Vec<3>> normal;  // unit, outward

  Vec<3> position(const Vec<2>& at) const { return cells.between_corners(corner, at); }
  Vec<3> normal_at(const Vec<2>& at) const { return cells.between_corners(normal, at).normalized(); }

  // Over the facets around the place: at a corner, means of those on either side.
  Tangents tangents(const Vec<2>& at) const {
    Tangents t;
    for (int a = 0; a < 2; ++a) {
      Vec<2> before = at, after = at;
      before[a] = std::max(at[a] - 0.5, 0.0);
      after[a] = std::min(at[a] + 0.5, static_cast<double>(cells.counts[static_cast<std::size_t>(a)]));
      if (after[a] - before[a] < 0.5) {  // beyond an end
        (at[a] < 1 ? after : before)[a] = at[a] < 1 ? before[a] + 0.5 : after[a] - 0.5;
      }
      t.col(a) = (position(after) - position(before)) / (after[a] - before[a]);
    }
    return t;
  }

  Vec<2> clamped(const Vec<2>& at) const {
    return {std::clamp(at[0], 0.0, static_cast<double>(cells.counts[0])),
            std::clamp(at[1], 0.0, static_cast<double>(cells.counts[1]))};
  }
};

Patch make_patch(const Strand<3>& strand, StrandFace face, double spacing) {
  Patch patch;
  for (int a = 0; a < 2; ++a) {
    const auto k = static_cast<std::size_t>(a);
    const double extent = strand.lattice.extent(a);
    patch.cells.counts[k] = spacing > 0 ? divisions(extent, spacing) : strand.lattice.counts[k];
    patch.cells.spacing[a] = extent / patch.cells.counts[k];
    patch.points_per_cell[a] = static_cast<double>(strand.lattice.counts[k]) / patch.cells.counts[k];
  }
  const auto at_corners = corners(strand);
  const double through = face == StrandFace::kTop ? strand.lattice.counts[2] : 0;
  for (std::size_t c = 0; c < patch.cells.corner_count(); ++c) {
    const auto [i, j] = patch.cells.place_of_corner(c);
    patch.corner.push_back(strand.lattice.between_corners(
        at_corners, Vec<3>(i * patch.points_per_cell[0], j * patch.points_per_cell[1], through)));
  }
  patch.normal.assign(patch.corner.size(), Vec<3>::Zero());
  const double sense = face == StrandFace::kTop ? 1 : -1;
  for (std::size_t f = 0; f < patch.cells.size(); ++f) {
    const auto around = patch.cells.cell(f);
    const Vec<3> outward =
        sense *
        (patch.corner[around[2]] - patch.corner[around[0]]).cross(patch.corner[around[3]] - patch.corner[around[1]]);
    for (const auto c : around) patch.normal[c] += outward;
  }
  for (auto& normal : patch.normal) normal.normalize();
  return patch;
}

// Where the normal of a face at a place meets another face, seen as planes near there: coordinates on the other face
// and the gap along the normal, linear in the coordinates on the face itself.
struct Meeting {
  Vec<2> place;              // on the other face
  Eigen::Matrix2d by_place;  // its derivatives by the place on this one
  double gap = 0;            // mm, positive where the other is above
  Vec<2> gap_slope;          // mm per cell
};

// `near`: from where the other face is searched, and how far beyond its edges (its cells) it matters; the other face is
// moved by `shift`.
std::optional<Meeting> meet(const Patch& a, const Vec<2>& at, const Patch& b, const Vec<3>& shift, Vec<2> near,
                            double beyond) {
  const Vec<3> p = a.position(at) - shift, n = a.normal_at(at);
  const Vec<2> most(b.cells.counts[0], b.cells.counts[1]);
  Eigen::Matrix3d across;
  Eigen::Vector3d step;
  constexpr int kSteps = 20;
  constexpr double kFound = 1e-10;  // cells
  for (int k = 0; k < kSteps; ++k) {
    across << b.tangents(near), -n;
    step = across.inverse() * (p - b.position(near));
    near += step.head<2>();
    if ((near.array() < -beyond).any() || ((near - most).array() > beyond).any()) return std::nullopt;
    if (step.head<2>().cwiseAbs().maxCoeff() < kFound) break;
  }
  if (n.dot(b.normal_at(b.clamped(near))) > kFaceToFace) return std::nullopt;
  const Eigen::Matrix<double, 3, 2> moved = across.inverse() * a.tangents(at);
  return Meeting{near, moved.topRows<2>(), step[2], moved.row(2).transpose()};
}

// A face that another may be glued to: an image of a strand's.
struct Opposite {
  const Patch* patch;
  Vec<3> shift;   // mm, of the image
  double lowest;  // mm, gap: further behind is the far side of the strand
  BoxImage image;
  Vec<2> start;  // place below the middle of the face, and how places on it follow from those on the face
  Eigen::Matrix2d by_place;
  double beyond;  // its edges by so many of its cells, a share of a corner may still reach it
};

// Half-planes, in the coordinates of a face about a corner, in which it faces another within the gaps.
std::vector<HalfPlane> bounds(const Meeting& m, const Vec<2>& at, const Opposite& other, double highest) {
  std::vector<HalfPlane> halves;
  const auto& counts = other.patch->cells.counts;
  const auto add = [&](double value, const Vec<2>& slope) { halves.push_back({value - slope.dot(at), slope}); };
  for (int k = 0; k < 2; ++k) {
    const Vec<2> slope = m.by_place.row(k).transpose();
    add(m.place[k], slope);
    add(counts[static_cast<std::size_t>(k)] - m.place[k], -slope);
  }
  add(highest - m.gap, -m.gap_slope);
  add(m.gap - other.lowest, m.gap_slope);
  return halves;
}

// Where the gap to `nearer` is less than that to `other`; of two as near, the one of the lower number counts as nearer,
// so that no place is glued twice.
HalfPlane nearer_than(const Meeting& nearer, const Meeting& other, const Vec<2>& at, bool lower_number) {
  constexpr double kAlike = 1e-9;  // mm
  const double difference = other.gap - nearer.gap;
  const Vec<2> slope = other.gap_slope - nearer.gap_slope;
  if (std::abs(difference) < kAlike && slope.cwiseAbs().maxCoeff() < kAlike) {
    return {lower_number ? 1.0 : -1.0, Vec<2>::Zero()};
  }
  return {difference - slope.dot(at), slope};
}

// The share of a corner: what lies nearer to it than to others.
Polygon share_of(const Patch& patch, const std::array<int, 2>& corner) {
  Vec<2> low, high;
  for (int a = 0; a < 2; ++a) {
    const auto k = static_cast<std::size_t>(a);
    low[a] = std::max(corner[k] - 0.5, 0.0);
    high[a] = std::min(corner[k] + 0.5, static_cast<double>(patch.cells.counts[k]));
  }
  return {low, {high[0], low[1]}, high, {low[0], high[1]}};
}

// Part of a corner's share that faces others[k], each other of `others` where it is nearer left out.
Moments facing_part(const Polygon& share, const Vec<2>& at, const std::vector<Opposite>& others,
                    const std::vector<std::optional<Meeting>>& meetings, std::size_t k, double highest) {
  auto part = share;
  for (const auto& half : bounds(*meetings[k], at, others[k], highest)) part = cut(part, half);
  std::vector<Polygon> pieces{part};
  for (std::size_t other = 0; other < others.size() && part.size() > 2; ++other) {
    if (other == k || !meetings[other]) continue;
    auto removed = bounds(*meetings[other], at, others[other], std::numeric_limits<double>::max());
    removed.push_back(nearer_than(*meetings[other], *meetings[k], at, others[other].image < others[k].image));
    std::vector<Polygon> left;
    for (const auto& piece : pieces) {
      auto covered = piece;
      for (const auto& half : removed) covered = cut(covered, half);
      if (!(moments(covered).area > 0)) {
        left.push_back(piece);
        continue;
      }
      auto rest = without(piece, removed);
      left.insert(left.end(), rest.begin(), rest.end());
    }
    pieces = std::move(left);
  }
  Moments sum;
  for (const auto& piece : pieces) {
    const auto m = moments(piece);
    sum.area += m.area;
    sum.first += m.first;
  }
  return sum;
}

FacePoint<3> point_on(const Patch& patch, const Vec<2>& at, int strand, StrandFace face) {
  FacePoint<3> point;
  point.strand = strand;
  point.face = face;
  point.place = at.cwiseProduct(patch.points_per_cell);
  point.position = patch.position(at);
  return point;
}

// Mean distance between a strand's faces, mm.
double thickness_now(const Patch& bottom, const Patch& top) {
  double sum = 0;
  for (std::size_t c = 0; c < top.corner.size(); ++c) sum += (top.corner[c] - bottom.corner[c]).norm();
  return sum / static_cast<double>(top.corner.size());
}

PlanBox plan_box(const Patch& patch) {
  PlanBox box{patch.corner.front().head<2>(), patch.corner.front().head<2>()};
  for (const auto& c : patch.corner) {
    box.low = box.low.cwiseMin(c.head<2>());
    box.high = box.high.cwiseMax(c.head<2>());
  }
  return box;
}

std::pair<double, double> heights(const Patch& patch) {
  std::pair<double, double> range{patch.corner.front()[2], patch.corner.front()[2]};
  for (const auto& c : patch.corner) {
    range.first = std::min(range.first, c[2]);
    range.second = std::max(range.second, c[2]);
  }
  return range;
}

// All faces of a panel, and which may meet.
class Patches {
 public:
  Patches(const Panel<3>& panel, const CuringOptions& options)
      : period_(panel.periodic ? Vec<2>(panel.length_mm, panel.depth_mm) : Vec<2>(Vec<2>::Zero())),
        max_gap_(options.max_gap_mm),
        grid_(make_patches(panel, options.point_spacing_mm), period_) {}

  const Patch& top(std::size_t strand) const { return tops_[strand]; }

  // Bottom faces that the top face of a strand may be glued to, or that may lie between.
  std::vector<Opposite> over(std::size_t a) const {
    std::vector<Opposite> facing;
    const auto& top = tops_[a];
    const auto [top_low, top_high] = heights(top);
    for (const auto& image : grid_.over(plan_box(top))) {
      const auto b = static_cast<std::size_t>(image.box);
      if (b == a && image.image == std::array<int, 2>{}) continue;
      const double overlap = overlap_in_contact(thickness_[a], thickness_[b]);
      const auto [low, high] = heights(bottoms_[b]);
      if (low > top_high + max_gap_ || high < top_low - overlap) continue;
      facing.push_back(face_of(top, image, overlap));
    }
    return facing;
  }

 private:
  std::vector<PlanBox> make_patches(const Panel<3>& panel, double spacing) {
    std::vector<PlanBox> boxes;
    for (const auto& strand : panel.strands) {
      bottoms_.push_back(make_patch(strand, StrandFace::kBottom, spacing));
      tops_.push_back(make_patch(strand, StrandFace::kTop, spacing));
      thickness_.push_back(thickness_now(bottoms_.back(), tops_.back()));
      boxes.push_back(plan_box(bottoms_.back()));
    }
    return boxes;
  }

  // The other face seen from the middle of this one: a guess that is exact between flat strands.
  Opposite face_of(const Patch& top, const BoxImage& image, double overlap) const {
    const auto& bottom = bottoms_[static_cast<std::size_t>(image.box)];
    Opposite f{&bottom, Vec<3>(image.image[0] * period_[0], image.image[1] * period_[1], 0), -overlap, image, {}, {},
               0};
    const Vec<2> middle_a = 0.5 * Vec<2>(top.cells.counts[0], top.cells.counts[1]),
                 middle_b = 0.5 * Vec<2>(bottom.cells.counts[0], bottom.cells.counts[1]);
    const Tangents tangents = bottom.tangents(middle_b);
    const Eigen::Matrix<double, 2, 3> back = (tangents.transpose() * tangents).inverse() * tangents.transpose();
    f.by_place = back * top.tangents(middle_a);
    f.start = middle_b + back * (top.position(middle_a) - f.shift - bottom.position(middle_b)) - f.by_place * middle_a;
    f.beyond = 1 + f.by_place.cwiseAbs().rowwise().sum().maxCoeff();
    return f;
  }

  std::vector<Patch> bottoms_, tops_;  // by strand
  std::vector<double> thickness_;      // mm, now
  Vec<2> period_;                      // mm, 0: none
  double max_gap_;
  PlanGrid grid_;
};

// Glue points of a strand's top face, by facing strand.
void append_points(const Patches& patches, std::size_t a, const CuringOptions& options,
                   std::vector<GluePoint<3>>& points) {
  constexpr double kTouch = 1e-9;  // of a corner's share: round-off, no contact
  const auto others = patches.over(a);
  const auto& top = patches.top(a);
  std::vector<std::vector<GluePoint<3>>> by_other(others.size());
  std::vector<std::optional<Meeting>> meetings(others.size());
  for (std::size_t c = 0; c < top.cells.corner_count(); ++c) {
    const auto corner = top.cells.place_of_corner(c);
    const Vec<2> at(corner[0], corner[1]);
    for (std::size_t k = 0; k < others.size(); ++k) {
      const auto& o = others[k];
      meetings[k] = meet(top, at, *o.patch, o.shift, o.start + o.by_place * at, o.beyond);
    }
    const auto share = share_of(top, corner);
    for (std::size_t k = 0; k < others.size(); ++k) {
      if (!meetings[k]) continue;
      const auto part = facing_part(share, at, others, meetings, k, options.max_gap_mm);
      if (part.area < kTouch) continue;
      const auto& m = *meetings[k];
      const auto& other = others[k];
      const Vec<2> here = part.first / part.area;
      const auto there = meet(top, here, *other.patch, other.shift, m.place + m.by_place * (here - at), other.beyond);
      if (!there) continue;
      GluePoint<3> point;
      point.a = point_on(top, here, static_cast<int>(a), StrandFace::kTop);
      const Vec<2> place = other.patch->clamped(there->place);
      point.b = point_on(*other.patch, place, other.image.box, StrandFace::kBottom);
      point.b.image = other.image.image;
      point.b.position += other.shift;
      point.normal = (top.normal_at(here) - other.patch->normal_at(place)).normalized();
      point.gap = (point.b.position - point.a.position).dot(point.normal);
      const Tangents t = top.tangents(at);
      point.area = part.area * t.col(0).cross(t.col(1)).norm();
      point.lacking = lacking(options.coverage, options.coverage.mean);
      by_other[k].push_back(point);
    }
  }
  for (const auto& line : by_other) points.insert(points.end(), line.begin(), line.end());
}

}  // namespace

std::vector<GluePoint<3>> cure(const Panel<3>& panel, const CuringOptions& options) {
  check(options);
  std::vector<GluePoint<3>> points;
  if (panel.strands.empty()) return points;
  const Patches patches(panel, options);
  for (std::size_t a = 0; a < panel.strands.size(); ++a) append_points(patches, a, options, points);
  return points;
}

}  // namespace strandlab::glue
