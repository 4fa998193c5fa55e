#include "strandlab/mpm/velocity_filter.hpp"

#include <algorithm>
#include <cmath>

#include "strandlab/mpm/rollers.hpp"
#include "strandlab/mpm/shape_functions.hpp"

namespace strandlab::mpm {
namespace {

template <int Dim>
PointStencil<Dim> stencil_at(const Particles<Dim>& body, const double* d, const Vec<Dim>& x, const Step<Dim>& step) {
  PointStencil<Dim> s;
  for (int a = 0; a < Dim; ++a) {
    const double xi = (x[a] - step.origin[a]) * step.inverse_cell[a];
    s.node[a] = static_cast<int>(std::lround(xi));
    const double r = std::clamp(body.half_width(d, a) * step.inverse_cell[a], kLeastHalfWidth, kMostHalfWidth);
    s.axis[a] = gimp<double>(xi - s.node[a], r);
  }
  return s;
}

// Momentum of the projection to velocity, with the rollers' mirror images. `start`: the patch's first record.
template <int Dim>
void fold_projected(const PatchStore& w, const Step<Dim>& step, int start, std::vector<double>& mass_at,
                    AlignedArray& projected) {
  each_ghost(w, step, false, [&](int axis, int, int ghost, int mirror, int count) {
    for (int i = 0; i < count; ++i) {
      for (int a = 0; a < Dim; ++a) {
        const double g = projected[static_cast<std::size_t>(ghost + i) * Dim + a];
        projected[static_cast<std::size_t>(mirror + i) * Dim + a] += a == axis ? -g : g;
      }
      mass_at[mirror + i - start] += mass_at[ghost + i - start];
    }
  });
  for (int r = start; r < start + w.records; ++r) {
    for (int a = 0; a < Dim; ++a) {
      double& p = projected[static_cast<std::size_t>(r) * Dim + a];
      p = mass_at[r - start] > 0 ? p / mass_at[r - start] : 0;
    }
  }
  each_wall(w, step, [&](int axis, int, int first, int count) {
    for (int r = first; r < first + count; ++r) projected[static_cast<std::size_t>(r) * Dim + axis] = 0;
  });
  each_ghost(w, step, true, [&](int axis, int, int ghost, int mirror, int count) {
    for (int i = 0; i < count; ++i) {
      for (int a = 0; a < Dim; ++a) {
        const double m = projected[static_cast<std::size_t>(mirror + i) * Dim + a];
        projected[static_cast<std::size_t>(ghost + i) * Dim + a] = a == axis ? -m : m;
      }
    }
  });
}

// Positions have moved since the step's weights were made; the new ones serve for both directions.
template <int Dim>
void filter_body(const PatchStore& w, const Step<Dim>& step, const AlignedArray& nodes, AlignedArray& projected,
                 Particles<Dim>& body) {
  const double mass = body.mass();
  std::vector<double> mass_at(w.records, 0.0);
  const int start = w.patch.base[0] + w.lo[0];
  body.each([&](int, const Vec<Dim>& x, const double* d) {
    const auto s = stencil_at<Dim>(body, d, x, step);
    Vec<Dim> v = Vec<Dim>::Zero();
    each_node(w, s, [&](std::size_t record, double weight) {
      for (int a = 0; a < Dim; ++a) v[a] += weight * nodes[record * kRecord + a];
    });
    each_node(w, s, [&](std::size_t record, double weight) {
      for (int a = 0; a < Dim; ++a) projected[record * Dim + a] += weight * mass * v[a];
      mass_at[record - static_cast<std::size_t>(start)] += weight * mass;
    });
  });
  fold_projected(w, step, start, mass_at, projected);
  body.each([&](int p, const Vec<Dim>& x, const double* d) {
    const auto s = stencil_at<Dim>(body, d, x, step);
    Vec<Dim> v = Vec<Dim>::Zero();
    each_node(w, s, [&](std::size_t record, double weight) {
      for (int a = 0; a < Dim; ++a) v[a] += weight * (2 * nodes[record * kRecord + a] - projected[record * Dim + a]);
    });
    double* out = body.data.data() + body.where[p];
    for (int a = 0; a < Dim; ++a) out[(Component<Dim>::v + a) * kBlock] = v[a];
  });
}

}  // namespace

template <int Dim>
double VelocityFilter::apply(const Step<Dim>& step, const Fields& fields, std::vector<Particles<Dim>>& bodies) {
  projected_.resize(fields.nodes.size() / kRecord * Dim);
  const double before = kinetic_energy(bodies);
  for (std::size_t b = 0; b < bodies.size(); ++b)
    filter_body(fields.patches[b].field, step, fields.nodes, projected_, bodies[b]);
  return before - kinetic_energy(bodies);
}

template double VelocityFilter::apply(const Step<2>&, const Fields&, std::vector<Particles<2>>&);
template double VelocityFilter::apply(const Step<3>&, const Fields&, std::vector<Particles<3>>&);

}  // namespace strandlab::mpm
