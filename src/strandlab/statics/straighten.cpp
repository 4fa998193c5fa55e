#include "strandlab/statics/straighten.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "strandlab/core/error.hpp"

namespace strandlab::statics {
namespace {

template <int Dim>
class Straightener {
 public:
  Straightener(const StrandMesh<Dim>& part, double formed_measure, std::vector<Vec<Dim>>& nodes)
      : part_(part),
        smallest_(0.1 * formed_measure),
        nodes_(nodes),
        moves_(nodes.size() - static_cast<std::size_t>(part.first_node)) {}

  int run() {
    constexpr int kSweeps = 400, kSweepsPerRing = 20;
    const int found = mark_folded(0);
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      if (mark_folded(1 + sweep / kSweepsPerRing) == 0) return found;
      for (std::size_t c = 0; c < part_.elements.corner_count(); ++c) {
        if (moves_[c]) at(c) += 0.5 * (smooth(part_.elements.place_of_corner(c)) - at(c));
      }
    }
    if (mark_folded(0) == 0) return found;
    throw RunError(fmt::format(
        "strand {} is too distorted for a virtual test: folded elements near x = {:.3f} mm, y = {:.3f} mm{}",
        part_.strand + 1, folded_[0], folded_[1], Dim == 3 ? fmt::format(", z = {:.3f} mm", folded_[Dim - 1]) : ""));
  }

 private:
  using Place = typename Lattice<Dim>::Place;

  Vec<Dim>& at(std::size_t corner) { return nodes_[static_cast<std::size_t>(part_.first_node) + corner]; }
  Vec<Dim>& at(const Place& place) { return at(part_.elements.corner(place)); }

  // Smallest measure of the boxes on the edges at an element's corners.
  double smallest_corner(const Place& element) {
    double smallest = std::numeric_limits<double>::infinity();
    for (int corner = 0; corner < 1 << Dim; ++corner) {
      Place here = element;
      for (std::size_t a = 0; a < Dim; ++a) here[a] += corner >> a & 1;
      Tensor<Dim> edges;
      for (std::size_t a = 0; a < Dim; ++a) {
        Place low = here, high = here;
        low[a] = element[a];
        high[a] = element[a] + 1;
        edges.col(static_cast<int>(a)) = at(high) - at(low);
      }
      smallest = std::min(smallest, edges.determinant());
    }
    return smallest;
  }

  // Marks the nodes within `rings` of folded elements as movable; returns the number of such elements.
  int mark_folded(int rings) {
    std::fill(moves_.begin(), moves_.end(), 0);
    int count = 0;
    for (std::size_t e = 0; e < part_.elements.size(); ++e) {
      const Place element = part_.elements.place_of_point(e);
      if (smallest_corner(element) >= smallest_) continue;
      ++count;
      folded_ = at(element);
      mark(element, rings);
    }
    return count;
  }

  void mark(const Place& element, int rings) {
    Place first, last;
    for (std::size_t a = 0; a < Dim; ++a) {
      first[a] = std::max(0, element[a] - rings);
      last[a] = std::min(part_.elements.counts[a], element[a] + 1 + rings);
    }
    for (Place place = first; place[Dim - 1] <= last[Dim - 1];) {
      moves_[part_.elements.corner(place)] = 1;
      std::size_t a = 0;
      for (; a + 1 < Dim && place[a] == last[a]; ++a) place[a] = first[a];
      ++place[a];
    }
  }

  // The mean of the neighbours along the axes between whose ends the node is; at a corner of the strand: what completes
  // the parallelogram.
  Vec<Dim> smooth(const Place& place) {
    Vec<Dim> sum = Vec<Dim>::Zero();
    Place inner = place;  // the nearest node that is on none of the node's faces
    int between = 0;
    for (std::size_t a = 0; a < Dim; ++a) {
      const bool low = place[a] == 0;
      if (low || place[a] == part_.elements.counts[a]) {
        inner[a] += low ? 1 : -1;
        continue;
      }
      for (const int step : {-1, 1}) {
        Place next = place;
        next[a] += step;
        sum += at(next);
      }
      ++between;
    }
    if (between > 0) return sum / (2 * between);
    for (std::size_t a = 0; a < Dim; ++a) {
      Place next = inner;
      next[a] = place[a];
      sum += at(next);
    }
    return sum - (Dim - 1) * at(inner);
  }

  StrandMesh<Dim> part_;
  double smallest_;
  std::vector<Vec<Dim>>& nodes_;
  std::vector<char> moves_;  // by node of the strand
  Vec<Dim> folded_ = Vec<Dim>::Zero();
};

}  // namespace

template <int Dim>
int straighten(const StrandMesh<Dim>& part, double formed_measure, std::vector<Vec<Dim>>& nodes) {
  return Straightener<Dim>(part, formed_measure, nodes).run();
}

template int straighten(const StrandMesh<2>&, double, std::vector<Vec<2>>&);
template int straighten(const StrandMesh<3>&, double, std::vector<Vec<3>>&);

}  // namespace strandlab::statics
