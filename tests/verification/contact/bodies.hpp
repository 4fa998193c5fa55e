// Bodies for the contact tests: flat blocks and discs of one isotropic elastic stuff.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "strandlab/mpm/engine.hpp"
#include "support/strands.hpp"

namespace strandlab::contact_tests {

// Isotropic, never yields. Density of poplar, so that a wave needs as long as in wood.
inline wood::StrandMaterial elastic_material(double modulus_MPa, double poisson) {
  wood::Material m;
  m.name = "elastic";
  m.E_L = m.E_R = m.E_T = modulus_MPa;
  m.nu_RL = m.nu_TL = m.nu_TR = poisson;
  m.G_RL = m.G_TL = m.G_RT = modulus_MPa / (2 * (1 + poisson));
  m.hill.Y_L = m.hill.Y_R = m.hill.Y_T = 1e9;
  m.hill.S_RT = m.hill.S_RL = m.hill.S_TL = 1e9;
  return wood::in_strand_axes(m, 0);
}

// A rectangular lattice of particles from `low` to `high` with spacing near `spacing`, all faces.
template <int Dim>
mpm::Body<Dim> block(const wood::StrandMaterial& material, const Vec<Dim>& low, const Vec<Dim>& high, double spacing) {
  auto s = test::strand_between<Dim>(material, low, high, spacing);
  s.kind = "block";
  return mpm::body_of(s);
}

// Particles of a square lattice whose centres lie in the disc, and points on the true circle, each carried by the
// nearest particle. Four faces, one per quadrant about +x, +y, -x, -y, so that normals within a face do not cancel.
inline mpm::Body<2> disc(const wood::StrandMaterial& material, const Vec<2>& centre, double radius, double spacing,
                         const Vec<2>& velocity) {
  mpm::Body<2> body;
  body.name = "disc";
  body.material = material;
  body.lattice.spacing = Vec<2>(spacing, spacing);
  const int n = static_cast<int>(std::ceil(radius / spacing));
  for (int j = -n; j < n; ++j) {
    for (int i = -n; i < n; ++i) {
      const Vec<2> r((i + 0.5) * spacing, (j + 0.5) * spacing);
      if (r.norm() <= radius) body.points.x.push_back(centre + r);
    }
  }
  body.points.v.assign(body.points.size(), velocity);
  body.points.F.assign(body.points.size(), Tensor<2>::Identity());
  body.points.stress.assign(body.points.size(), Voigt::Zero());
  body.points.plastic.assign(body.points.size(), 0.0);
  body.faces.resize(4);
  const int points = 4 * static_cast<int>(std::ceil(2 * M_PI * radius / spacing / 4));
  const double step = 2 * M_PI / points;
  for (int k = 0; k < points; ++k) {
    const double angle = -M_PI / 4 + (k + 0.5) * step;
    const Vec<2> normal(std::cos(angle), std::sin(angle)), at = centre + radius * normal;
    std::size_t nearest = 0;
    for (std::size_t p = 1; p < body.points.size(); ++p) {
      if ((body.points.x[p] - at).squaredNorm() < (body.points.x[nearest] - at).squaredNorm()) nearest = p;
    }
    auto& face = body.faces[static_cast<std::size_t>(4 * k / points)];
    face.particle.push_back(static_cast<int>(nearest));
    face.offset.emplace_back(at - body.points.x[nearest]);
    face.area.emplace_back(radius * step * normal);
  }
  return body;
}

template <int Dim>
double particle_mass(const mpm::Body<Dim>& body) {
  return body.material.density * body.lattice.point_volume();
}

template <int Dim>
Vec<Dim> mean(const std::vector<Vec<Dim>>& values) {
  Vec<Dim> sum = Vec<Dim>::Zero();
  for (const auto& v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

template <int Dim>
Vec<Dim> momentum(const mpm::Body<Dim>& body) {
  return particle_mass(body) * static_cast<double>(body.points.size()) * mean<Dim>(body.points.v);
}

// Mean position of a face along an axis, mm.
template <int Dim>
double face_position(const mpm::Body<Dim>& body, std::size_t face, int axis) {
  double sum = 0;
  const auto& f = body.faces[face];
  for (std::size_t i = 0; i < f.particle.size(); ++i) {
    sum += body.points.x[f.particle[i]][axis] + (body.points.F[f.particle[i]] * f.offset[i])[axis];
  }
  return sum / static_cast<double>(f.particle.size());
}

}  // namespace strandlab::contact_tests
