#include "strandlab/mpm/tractions.hpp"

#include <algorithm>
#include <cmath>

#include "strandlab/mpm/shape_functions.hpp"

namespace strandlab::mpm {
namespace {

// The grid's own functions at a point: no width.
Gimp<double> hat(double d) {
  return {{std::max(-d, 0.0), 1 - std::abs(d), std::max(d, 0.0)},
          {d < 0 ? -1.0 : 0.0, d < 0 ? 1.0 : -1.0, d < 0 ? 0.0 : 1.0}};
}

// Grid functions averaged over the face element of a point: as wide as the particle along the face, flat across it.
// Then the nodal forces of a traction balance those of an equal stress node by node (divergence theorem), also at
// nodes that the body hardly touches.
template <int Dim>
PointStencil<Dim> face_stencil(const Particles<Dim>& body, const double* d, const Vec<Dim>& offset,
                               const Step<Dim>& step) {
  using C = Component<Dim>;
  PointStencil<Dim> s;
  for (int a = 0; a < Dim; ++a) {
    double x = d[(C::x + a) * kBlock];
    for (int b = 0; b < Dim; ++b) x += d[(C::F + a * Dim + b) * kBlock] * offset[b];
    const double xi = (x - step.origin[a]) * step.inverse_cell[a];
    s.node[a] = static_cast<int>(std::lround(xi));
    const double width = body.half_width(d, a, 0.5 * body.spacing - offset.cwiseAbs()) * step.inverse_cell[a];
    double from_node = xi - s.node[a];
    if (std::abs(from_node) < 1e-9) from_node = 0;  // a face on a grid line acts on that line alone
    s.axis[a] = width > kLeastHalfWidth ? gimp<double>(from_node, std::min(width, kMostHalfWidth)) : hat(from_node);
  }
  return s;
}

}  // namespace

template <int Dim>
Tractions<Dim>::Tractions(const std::vector<Body<Dim>>& bodies) : tractions_(bodies.size() * kMaxFaces * Dim, 0.0) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    for (std::size_t f = 0; f < bodies[b].faces.size(); ++f) set(b, f, bodies[b].faces[f].traction);
  }
}

template <int Dim>
void Tractions<Dim>::set(std::size_t body, std::size_t face, const Vec<Dim>& traction) {
  for (int a = 0; a < Dim; ++a) tractions_[(body * kMaxFaces + face) * Dim + a] = traction[a];
  any_ = std::any_of(tractions_.begin(), tractions_.end(), [](double v) { return v != 0; });
}

template <int Dim>
template <class Visit>  // visit(offset of a node's record, traction, weight times area at formation)
void Tractions<Dim>::each_node_under(const std::vector<Particles<Dim>>& bodies, const Step<Dim>& step,
                                     const Fields& fields, Visit visit) const {
  if (!any_) return;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const auto& body = bodies[b];
    for (std::size_t k = 0; k < body.faces.size(); ++k) {
      const double* t = tractions_.data() + (b * kMaxFaces + k) * Dim;
      if (std::all_of(t, t + Dim, [](double v) { return v == 0; })) continue;
      const auto& face = body.faces[k];
      for (std::size_t i = 0; i < face.where.size(); ++i) {
        Vec<Dim> offset, area;
        for (int a = 0; a < Dim; ++a) {
          const std::size_t at = (i / kBlock * Dim + a) * kBlock + i % kBlock;
          offset[a] = face.offset[at];
          area[a] = face.area[at];
        }
        const double size = area.norm();
        if (size == 0) continue;  // padding
        const auto s = face_stencil<Dim>(body, body.data.data() + face.where[i], offset, step);
        each_node(fields.patches[b].field, s, [&](std::size_t record, double w) {
          if (w > 0) visit(record * kRecord, t, w * size);
        });
      }
    }
  }
}

template <int Dim>
void Tractions<Dim>::apply(const std::vector<Particles<Dim>>& bodies, const Step<Dim>& step, Fields& fields) const {
  each_node_under(bodies, step, fields, [&](std::size_t node, const double* t, double area) {
    for (int a = 0; a < Dim; ++a) fields.nodes[node + 1 + Dim + a] += t[a] * area;
  });
}

template <int Dim>
void Tractions<Dim>::book(const std::vector<Particles<Dim>>& bodies, const Step<Dim>& step, const Fields& fields,
                          double& work) const {
  each_node_under(bodies, step, fields, [&](std::size_t node, const double* t, double area) {
    if (!(fields.nodes[node + 7] > 0)) return;
    for (int a = 0; a < Dim; ++a) work += step.dt * t[a] * area * fields.nodes[node + a];
  });
}

template class Tractions<2>;
template class Tractions<3>;

}  // namespace strandlab::mpm
