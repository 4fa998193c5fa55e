#include "strandlab/mpm/springs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "strandlab/core/error.hpp"

namespace strandlab::mpm {
namespace {

template <int Dim>
void check(std::size_t i, const Spring<Dim>& s, const std::vector<Particles<Dim>>& bodies) {
  for (const auto* end : {&s.a, &s.b}) {
    if (end->body < 0 || end->body >= static_cast<int>(bodies.size()))
      throw InputError(fmt::format("spring {}: no body {}; there are {}", i, end->body, bodies.size()));
    const auto particles = bodies[end->body].where.size();
    if (end->particle < 0 || end->particle >= static_cast<int>(particles)) {
      throw InputError(
          fmt::format("spring {}: no particle {} in body {}, which has {}", i, end->particle, end->body, particles));
    }
  }
  if (!(std::abs(s.normal.norm() - 1) < 1e-6))
    throw InputError(fmt::format("spring {}: its normal has length {}; it must be 1", i, s.normal.norm()));
  if (!(s.area >= 0 && s.stiffness_t >= 0 && s.stiffness_n >= 0)) {
    throw InputError(fmt::format("spring {}: area {}, stiffnesses {} and {}; none may be negative", i, s.area,
                                 s.stiffness_t, s.stiffness_n));
  }
}

// Nodes that a spring's end hangs on: grid functions at the point itself. A sheared particle's corner may lie outside
// the upright domain that its mass is spread over, perhaps by a node of no mass: the end stays within that domain.
template <int Dim, class Visit>  // visit(offset of a node's record, weight)
void each_spring_node(const typename Spring<Dim>::End& end, const std::vector<Particles<Dim>>& bodies,
                      const Step<Dim>& step, const Fields& fields, Visit visit) {
  using C = Component<Dim>;
  const double* d = bodies[end.body].data.data() + bodies[end.body].where[end.particle];
  std::array<int, Dim> node;
  std::array<double, Dim> part;
  for (int a = 0; a < Dim; ++a) {
    double ride = 0;
    for (int b = 0; b < Dim; ++b) ride += d[(C::F + a * Dim + b) * kBlock] * end.offset[b];
    const double reach = bodies[end.body].half_width(d, a);
    const double x = d[(C::x + a) * kBlock] + std::clamp(ride, -reach, reach);
    const double xi = (x - step.origin[a]) * step.inverse_cell[a];
    node[a] = static_cast<int>(std::floor(xi));
    part[a] = xi - node[a];
    if (part[a] > 1 - 1e-9) {  // a point on a grid line acts on that line alone
      ++node[a];
      part[a] = 0;
    } else if (part[a] < 1e-9) {
      part[a] = 0;
    }
  }
  const PatchStore& w = fields.patches[end.body].field;
  for (int q = 0; q < (1 << Dim); ++q) {
    double weight = 1;
    for (int a = 0; a < Dim; ++a) weight *= (q >> a) & 1 ? part[a] : 1 - part[a];
    if (!(weight > 0)) continue;
    const int column = node[0] + (q & 1) - w.patch.first[0];
    const int across = Dim == 2 ? 0 : node[Dim - 2] + ((q >> (Dim - 2)) & 1) - w.patch.first[1];
    const int row = node[Dim - 1] + ((q >> (Dim - 1)) & 1);
    visit(static_cast<std::size_t>(w.base[across * w.patch.count[0] + column] + row) * kRecord, weight);
  }
}

}  // namespace

template <int Dim>
void Springs<Dim>::set(const std::vector<Spring<Dim>>& springs, const std::vector<Particles<Dim>>& bodies) {
  for (std::size_t i = 0; i < springs.size(); ++i) check(i, springs[i], bodies);
  springs_.clear();
  for (const auto& s : springs) springs_.push_back({s, Vec<Dim>::Zero()});
}

template <int Dim>
Vec<Dim> Springs<Dim>::traction(const Stretched& s) {
  const double opening = s.jump.dot(s.spring.normal);
  return s.spring.stiffness_t * s.jump + (s.spring.stiffness_n - s.spring.stiffness_t) * opening * s.spring.normal;
}

template <int Dim>
void Springs<Dim>::apply(const std::vector<Particles<Dim>>& bodies, const Step<Dim>& step, Fields& fields) const {
  for (const auto& s : springs_) {
    const Vec<Dim> on_a = s.spring.area * traction(s);
    const auto pull = [&](const auto& end, double sign) {
      each_spring_node<Dim>(end, bodies, step, fields, [&](std::size_t node, double w) {
        for (int a = 0; a < Dim; ++a) fields.nodes[node + 1 + Dim + a] += sign * w * on_a[a];
      });
    };
    pull(s.spring.a, 1);
    pull(s.spring.b, -1);
  }
}

template <int Dim>
void Springs<Dim>::book(const std::vector<Particles<Dim>>& bodies, const Step<Dim>& step, const Fields& fields,
                        double& /*work*/) {
  for (auto& s : springs_) {
    const auto move = [&](const auto& end, double sign) {
      each_spring_node<Dim>(end, bodies, step, fields, [&](std::size_t node, double w) {
        for (int a = 0; a < Dim; ++a) s.jump[a] += sign * w * step.dt * fields.nodes[node + a];
      });
    };
    move(s.spring.b, 1);
    move(s.spring.a, -1);
  }
}

template <int Dim>
double Springs<Dim>::energy() const {
  double sum = 0;
  for (const auto& s : springs_) sum += 0.5 * s.spring.area * traction(s).dot(s.jump);
  return sum;
}

template class Springs<2>;
template class Springs<3>;

}  // namespace strandlab::mpm
