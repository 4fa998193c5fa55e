#include "strandlab/report/morphology.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "strandlab/panel/point_fields.hpp"

namespace strandlab::report {
namespace {

using Point = Vec<2>;
using Polygon = std::vector<Point>;
using Triangle = std::array<Point, 3>;  // anticlockwise

double cross(const Point& a, const Point& b) {
  return a[0] * b[1] - a[1] * b[0];
}

// Shoelace formula, positive anticlockwise.
double area(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return twice / 2;
}

// The part of a convex polygon to the left of the line a -> b (Sutherland and Hodgman 1974).
void clip(Polygon& polygon, const Point& a, const Point& b, Polygon& scratch) {
  scratch.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& p = polygon[i];
    const Point& q = polygon[(i + 1) % polygon.size()];
    const double dp = cross(b - a, p - a), dq = cross(b - a, q - a);
    if (dp >= 0) scratch.push_back(p);
    if ((dp > 0 && dq < 0) || (dp < 0 && dq > 0)) scratch.push_back(p + (q - p) * (dp / (dp - dq)));
  }
  polygon.swap(scratch);
}

double common_area(const Triangle& a, const Triangle& b) {
  Polygon polygon(a.begin(), a.end()), scratch;
  for (std::size_t i = 0; i < 3 && !polygon.empty(); ++i) clip(polygon, b[i], b[(i + 1) % 3], scratch);
  return area(polygon);
}

double area_in_box(const Triangle& t, const Point& lo, const Point& hi) {
  Polygon polygon(t.begin(), t.end()), scratch;
  const std::array<Point, 4> box{lo, Point(hi[0], lo[1]), hi, Point(lo[0], hi[1])};
  for (std::size_t i = 0; i < 4 && !polygon.empty(); ++i) clip(polygon, box[i], box[(i + 1) % 4], scratch);
  return area(polygon);
}

// A strand's elements, two triangles each: exact for every quadrilateral that does not cross itself.
void add_triangles(const Strand<2>& strand, std::vector<Triangle>& triangles) {
  const auto c = corners(strand);
  for (std::size_t p = 0; p < strand.size(); ++p) {
    const auto [a, b, e, d] = strand.lattice.cell(p);
    // The diagonal that leaves both halves anticlockwise, where the element is not convex.
    const bool along_ae = std::min(cross(c[b] - c[a], c[e] - c[a]), cross(c[e] - c[a], c[d] - c[a])) >=
                          std::min(cross(c[b] - c[a], c[d] - c[a]), cross(c[d] - c[e], c[b] - c[e]));
    if (along_ae) {
      triangles.push_back({c[a], c[b], c[e]});
      triangles.push_back({c[a], c[e], c[d]});
    } else {
      triangles.push_back({c[a], c[b], c[d]});
      triangles.push_back({c[b], c[e], c[d]});
    }
  }
}

struct Box {
  Point lo, hi;
};

Box box_of(const Triangle& t) {
  return {t[0].cwiseMin(t[1]).cwiseMin(t[2]), t[0].cwiseMax(t[1]).cwiseMax(t[2])};
}

// Square bins over the plane; a triangle is listed in every bin that its box touches.
class Bins {
 public:
  explicit Bins(double size) : size_(size) {}
  std::int64_t column(double x) const { return static_cast<std::int64_t>(std::floor(x / size_)); }
  static std::int64_t key(std::int64_t i, std::int64_t j) { return i * (std::int64_t{1} << 32) + j; }
  template <class Visit>
  void visit(const Box& box, const Visit& visit) const {
    for (auto i = column(box.lo[0]); i <= column(box.hi[0]); ++i) {
      for (auto j = column(box.lo[1]); j <= column(box.hi[1]); ++j) visit(i, j);
    }
  }
  std::vector<int>& operator()(std::int64_t i, std::int64_t j) { return bins_[key(i, j)]; }

 private:
  double size_;
  std::unordered_map<std::int64_t, std::vector<int>> bins_;
};

// Elements of all strands, and which strand each belongs to.
struct Mesh {
  std::vector<Triangle> triangles;
  std::vector<int> strand;
  std::vector<Box> boxes;
};

Mesh mesh_of(const Panel<2>& panel) {
  Mesh mesh;
  for (std::size_t s = 0; s < panel.strands.size(); ++s) {
    add_triangles(panel.strands[s], mesh.triangles);
    mesh.strand.resize(mesh.triangles.size(), static_cast<int>(s));
  }
  for (const auto& t : mesh.triangles) mesh.boxes.push_back(box_of(t));
  return mesh;
}

double bin_size(const Panel<2>& panel) {
  double size = 0;
  for (const auto& strand : panel.strands) size = std::max(size, strand.lattice.spacing.maxCoeff());
  return size;
}

// Overlap area, mm^2, of each pair of strands that overlap. A pair of triangles is taken up in the one bin that holds
// the lower left corner of what their boxes share.
std::map<std::pair<int, int>, double> overlaps(const Panel<2>& panel, const Mesh& mesh) {
  Bins bins(bin_size(panel));
  std::map<std::pair<int, int>, double> overlap;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Box& box = mesh.boxes[t];
    bins.visit(box, [&](std::int64_t i, std::int64_t j) {
      auto& others = bins(i, j);
      for (const int other : others) {
        const auto o = static_cast<std::size_t>(other);
        if (mesh.strand[o] == mesh.strand[t]) continue;
        const Point lo = box.lo.cwiseMax(mesh.boxes[o].lo), hi = box.hi.cwiseMin(mesh.boxes[o].hi);
        if ((lo.array() >= hi.array()).any() || bins.column(lo[0]) != i || bins.column(lo[1]) != j) continue;
        const double common = common_area(mesh.triangles[t], mesh.triangles[o]);
        if (common > 0) overlap[{mesh.strand[o], mesh.strand[t]}] += common;
      }
      others.push_back(static_cast<int>(t));
    });
  }
  return overlap;
}

std::vector<double> volumes(const Strand<2>& strand, std::size_t count) {
  return std::vector<double>(
      count, strand.lattice.point_volume() * static_cast<double>(strand.size()) / static_cast<double>(count));
}

void append(std::vector<double>& to, const std::vector<double>& values) {
  to.insert(to.end(), values.begin(), values.end());
}

}  // namespace

Histogram histogram(std::string quantity, const std::vector<double>& values, const std::vector<double>& weights,
                    double low, double high, int bins) {
  if (bins < 1 || !(high > low)) throw std::invalid_argument("histogram of " + quantity + " without bins");
  Histogram h;
  h.quantity = std::move(quantity);
  for (int b = 0; b <= bins; ++b) h.edges.push_back(low + (high - low) * b / bins);
  h.fraction.assign(static_cast<std::size_t>(bins), 0.0);
  double total = 0, square = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double place = std::clamp((values[i] - low) / (high - low) * bins, 0.0, bins - 1.0);
    h.fraction[static_cast<std::size_t>(place)] += weights[i];
    total += weights[i];
    h.mean += weights[i] * values[i];
    h.lowest = i == 0 ? values[i] : std::min(h.lowest, values[i]);
    h.highest = i == 0 ? values[i] : std::max(h.highest, values[i]);
  }
  if (total <= 0) return h;
  h.mean /= total;
  for (std::size_t i = 0; i < values.size(); ++i) square += weights[i] * std::pow(values[i] - h.mean, 2);
  h.sd = std::sqrt(square / total);
  for (auto& fraction : h.fraction) fraction /= total;
  return h;
}

Histogram grain_angle_histogram(const Panel<2>& panel) {
  std::vector<double> angles, weights;
  for (const auto& strand : panel.strands) {
    for (const auto& F : strand.points.F) angles.push_back(grain_angle_deg<2>(F));
    append(weights, volumes(strand, strand.size()));
  }
  return histogram("grain_angle_deg", angles, weights, -90.5, 90.5, 181);
}

Histogram thickness_strain_histogram(const Panel<2>& panel) {
  std::vector<double> strains, weights;
  for (const auto& strand : panel.strands) {
    const auto& lattice = strand.lattice;
    std::vector<double> sum(static_cast<std::size_t>(lattice.counts[0]), 0.0);
    for (std::size_t p = 0; p < strand.size(); ++p) {
      sum[lattice.place_of_point(p)[0]] += thickness_strain<2>(strand.points.F[p]);
    }
    for (const double s : sum) strains.push_back(s / lattice.counts[1]);
    append(weights, volumes(strand, sum.size()));
  }
  return histogram("strand_thickness_strain", strains, weights, -0.91, 1.01, 96);
}

QuantityWords words_of(const std::string& quantity) {
  if (quantity == "grain_angle_deg") return {"Grain angle", "grain angle against the panel, °", 1};
  if (quantity == "strand_thickness_strain") return {"Thickness strain of the strands", "thickness strain, %", 100};
  throw std::invalid_argument(quantity + ": no quantity of a histogram");
}

Areas areas(const Panel<2>& panel) {
  const Mesh mesh = mesh_of(panel);
  const double whole = panel.length_mm * panel.thickness_mm();
  const Point lo(0, panel.bottom_mm), hi(panel.length_mm, panel.top_mm);
  Areas a;
  for (const auto& triangle : mesh.triangles) {
    const double inside = area_in_box(triangle, lo, hi);
    a.strands += inside;
    a.outside += area({triangle.begin(), triangle.end()}) - inside;
  }
  for (const auto& [pair, overlap] : overlaps(panel, mesh)) {
    a.overlap += overlap;
    if (overlap <= a.largest_overlap) continue;
    a.largest_overlap = overlap;
    a.overlap_a = pair.first;
    a.overlap_b = pair.second;
  }
  for (double* value : {&a.strands, &a.outside, &a.overlap, &a.largest_overlap}) *value /= whole;
  return a;
}

Morphology morphology(const Panel<2>& panel, double compaction) {
  return {compaction, panel.compaction(), grain_angle_histogram(panel), thickness_strain_histogram(panel),
          areas(panel)};
}

files::CsvTable morphology_table(const std::vector<Morphology>& states) {
  files::CsvTable table({"compaction", "compaction_reached", "overlap_fraction", "largest_overlap_fraction",
                         "void_fraction", "outside_fraction", "grain_angle_mean_deg", "grain_angle_sd_deg",
                         "grain_angle_lowest_deg", "grain_angle_highest_deg", "strand_thickness_strain_mean",
                         "strand_thickness_strain_sd", "strand_thickness_strain_lowest",
                         "strand_thickness_strain_highest"});
  for (const auto& s : states) {
    std::vector<files::CsvCell> row{
        s.compaction,   s.compaction_reached, s.areas.overlap, s.areas.largest_overlap, s.areas.void_fraction(),
        s.areas.outside};
    for (const auto* h : {&s.grain_angle, &s.thickness_strain}) {
      for (const double value : {h->mean, h->sd, h->lowest, h->highest}) row.emplace_back(value);
    }
    table.add_row(row);
  }
  return table;
}

files::CsvTable histogram_table(const std::vector<Morphology>& states) {
  files::CsvTable table({"compaction", "quantity", "from", "to", "fraction"});
  for (const auto& state : states) {
    for (const auto* h : {&state.grain_angle, &state.thickness_strain}) {
      for (std::size_t b = 0; b < h->fraction.size(); ++b) {
        table.add_row({state.compaction, h->quantity, h->edges[b], h->edges[b + 1], h->fraction[b]});
      }
    }
  }
  return table;
}

}  // namespace strandlab::report
