// A body's particles as the engine keeps them: blocks of eight, tile by tile, and the points of its faces.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "strandlab/mpm/aligned.hpp"
#include "strandlab/mpm/engine.hpp"
#include "strandlab/mpm/kernels.hpp"
#include "strandlab/mpm/tiles.hpp"
#include "strandlab/wood/yield_modes.hpp"

namespace strandlab::mpm {

template <int Dim>
struct Particles {
  using C = Component<Dim>;

  std::string name;
  wood::StrandMaterial material;
  int components = 4;  // of the stress
  wood::YieldModes<4> modes4{};
  wood::YieldModes<6> modes6{};
  Vec<Dim> spacing;  // mm, a particle's domain at formation
  int blocks = 0;
  AlignedArray data;                 // blocks of particles
  AlignedArray condition;            // per block a pack of factors of stiffness, then one of yield; empty: as measured
  double stiffest = 1;               // largest of these factors of stiffness
  std::vector<unsigned char> lanes;  // real particles per block
  std::vector<int> particle;         // number in the Body of each lane, -1 for padding
  std::vector<int> where;            // for each number in the Body: offset of its x in data
  struct FacePoints {
    std::vector<int> where;     // of the particle that a point rides on, as above
    AlignedArray offset, area;  // mm; mm (2D) or mm^2, 0 for padding: as in SurfaceView
  };
  std::vector<FacePoints> faces;
  Vec<Dim> reach = Vec<Dim>::Zero();  // furthest offset of a face point per axis, mm at formation

  // Of one particle.
  double volume() const { return spacing.prod(); }
  double mass() const { return material.density * spacing.prod(); }

  // Factors of stiffness and yield of a particle in `condition`; its x component is at `x_at` in data.
  std::size_t condition_at(int x_at) const {
    const int block = C::count(components) * kBlock;
    return static_cast<std::size_t>(x_at / block) * 2 * kBlock + static_cast<std::size_t>(x_at % block);
  }
  double stiffness_factor(const double* x) const {
    return condition.size() == 0 ? 1 : condition.data()[condition_at(static_cast<int>(x - data.data()))];
  }

  const double* block(int b) const { return data.data() + static_cast<std::size_t>(b) * C::count(components) * kBlock; }

  // From a particle's x component on; successive components are kBlock apart.
  static Vec<Dim> position(const double* d) {
    Vec<Dim> x;
    for (int a = 0; a < Dim; ++a) x[a] = d[(C::x + a) * kBlock];
    return x;
  }
  static Tensor<Dim> deformation(const double* d) {
    Tensor<Dim> F;
    for (int i = 0; i < Dim; ++i) {
      for (int j = 0; j < Dim; ++j) F(i, j) = d[(C::F + i * Dim + j) * kBlock];
    }
    return F;
  }

  // Half-width (mm) along an axis of a particle's domain, or of one with other half-edges at formation, as in the
  // kernels: that of the edge that reaches furthest along it.
  static double half_width(const double* d, int axis, const Vec<Dim>& half_edges) {
    double width = 0;
    for (int b = 0; b < Dim; ++b)
      width = std::max(width, std::abs(d[(C::F + axis * Dim + b) * kBlock]) * half_edges[b]);
    return width;
  }
  double half_width(const double* d, int axis) const { return half_width(d, axis, 0.5 * spacing); }

  template <class Visit>  // visit(number in the Body, position, its x component)
  void each(Visit visit) const {
    for (int b = 0; b < blocks; ++b) {
      for (int l = 0; l < lanes[b]; ++l) {
        const double* d = block(b) + l;
        visit(particle[b * kBlock + l], position(d), d);
      }
    }
  }
};

// Stores the particles of body `number` and appends its tiles. Throws InputError for a body of no particles or of more
// than kMaxFaces faces.
template <int Dim>
Particles<Dim> store_particles(const Body<Dim>& body, int number, std::vector<ColouredTile>& tiles);

// What the kernels need of the body's wood: the part of its view that does not change with the patches.
template <int Dim>
BodyView<Dim> view_of_wood(Particles<Dim>& body);

// Copies the particles' state out: the fields that the engine moves. Others stay as they are.
template <int Dim>
void copy_out(const Particles<Dim>& body, Points<Dim>& points);

template <int Dim>
void scale_velocities(std::vector<Particles<Dim>>& bodies, double factor);

// Engine::soften for one body. Returns the energy that the wood loses, mJ.
template <int Dim>
double soften(Particles<Dim>& body, const std::vector<double>& stiffness, const std::vector<double>& yield);

// Of all bodies now.
template <int Dim>
double kinetic_energy(const std::vector<Particles<Dim>>& bodies);  // mJ
template <int Dim>
double elastic_energy(const std::vector<Particles<Dim>>& bodies);  // mJ
template <int Dim>
double mean_motion_energy(const std::vector<Particles<Dim>>& bodies);  // mJ, of each body's mean velocity
template <int Dim>
double mean_thickness_stretch(const std::vector<Particles<Dim>>& bodies);  // over all particles
template <int Dim>
Vec<Dim> momentum(const std::vector<Particles<Dim>>& bodies);  // t mm/s
template <int Dim>
double mass(const std::vector<Particles<Dim>>& bodies);  // t
template <int Dim>
std::size_t bytes(const std::vector<Particles<Dim>>& bodies);

}  // namespace strandlab::mpm
