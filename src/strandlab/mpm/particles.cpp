#include "strandlab/mpm/particles.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "strandlab/core/error.hpp"

namespace strandlab::mpm {
namespace {

template <int Dim>
void fill(const Body<Dim>& input, Particles<Dim>& body) {
  using C = Component<Dim>;
  const auto& points = input.points;
  const int count = C::count(body.components);
  body.data.resize(static_cast<std::size_t>(body.blocks) * count * kBlock);
  body.where.resize(points.size());
  for (int b = 0; b < body.blocks; ++b) {
    for (int l = 0; l < kBlock; ++l) {
      int p = body.particle[b * kBlock + l];
      const std::size_t at = static_cast<std::size_t>(b) * count * kBlock + l;
      if (p < 0)
        p = body.particle[b * kBlock + body.lanes[b] - 1];  // padding follows the last particle
      else
        body.where[p] = static_cast<int>(at);
      double* d = body.data.data() + at;
      for (int a = 0; a < Dim; ++a) {
        d[(C::x + a) * kBlock] = points.x[p][a];
        d[(C::v + a) * kBlock] = points.v[p][a];
        for (int k = 0; k < Dim; ++k) d[(C::F + a * Dim + k) * kBlock] = points.F[p](a, k);
      }
      for (int k = 0; k < body.components; ++k) d[(C::stress + k) * kBlock] = points.stress[p][wood::kModeToVoigt[k]];
      d[C::plastic(body.components) * kBlock] = points.plastic[p];
    }
  }
}

// Factors of the points, padding as in the particles' blocks.
template <int Dim>
void set_condition(const std::vector<double>& stiffness, const std::vector<double>& yield, Particles<Dim>& body) {
  body.condition.resize(static_cast<std::size_t>(body.blocks) * 2 * kBlock);
  for (int b = 0; b < body.blocks; ++b) {
    double* factors = body.condition.data() + static_cast<std::size_t>(b) * 2 * kBlock;
    for (int l = 0; l < kBlock; ++l) {
      const int p = body.particle[b * kBlock + std::min<int>(l, body.lanes[b] - 1)];
      factors[l] = stiffness[p];
      factors[kBlock + l] = yield[p];
    }
  }
  body.stiffest = *std::max_element(stiffness.begin(), stiffness.end());
}

// The points of a face in packs of eight, tile by tile. `tiles`: of this body, in the order of tile_of.
template <int Dim>
void add_face(const Face<Dim>& face, const std::vector<int>& tile_of, ColouredTile* tiles, std::size_t tile_count,
              Particles<Dim>& body) {
  const std::size_t f = body.faces.size();
  body.faces.emplace_back();
  auto& data = body.faces.back();
  for (const auto& offset : face.offset) body.reach = body.reach.cwiseMax(offset.cwiseAbs());
  std::vector<std::vector<int>> by_tile(tile_count);
  for (std::size_t i = 0; i < face.particle.size(); ++i)
    by_tile[tile_of[face.particle[i]]].push_back(static_cast<int>(i));
  std::vector<int> order;  // -1: padding
  for (std::size_t t = 0; t < tile_count; ++t) {
    tiles[t].tile.face_begin[f] = static_cast<int>(order.size()) / kBlock;
    order.insert(order.end(), by_tile[t].begin(), by_tile[t].end());
    while (order.size() % kBlock) order.push_back(-1);
    tiles[t].tile.face_end[f] = static_cast<int>(order.size()) / kBlock;
  }
  data.offset.resize(order.size() * Dim);
  data.area.resize(order.size() * Dim);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const int k = order[i];
    const int donor = k >= 0 ? k : order[i / kBlock * kBlock];
    data.where.push_back(body.where[face.particle[donor]]);
    for (int a = 0; a < Dim; ++a) {
      const std::size_t at = (i / kBlock * Dim + a) * kBlock + i % kBlock;
      data.offset[at] = face.offset[donor][a];
      data.area[at] = k >= 0 ? face.area[k][a] : 0.0;
    }
  }
}

}  // namespace

template <int Dim>
Particles<Dim> store_particles(const Body<Dim>& input, int number, std::vector<ColouredTile>& tiles) {
  if (input.faces.size() > kMaxFaces)
    throw InputError(fmt::format("body {}: more than {} faces", input.name, kMaxFaces));
  if (input.points.size() == 0) throw InputError(fmt::format("body {}: no particles", input.name));
  Particles<Dim> body;
  body.name = input.name;
  body.material = input.material;
  body.spacing = input.lattice.spacing;
  body.components = Dim == 3 || wood::needs_six(input.material) ? 6 : 4;
  if (body.components == 4)
    body.modes4 = wood::yield_modes<4>(input.material);
  else
    body.modes6 = wood::yield_modes<6>(input.material);

  const auto order = split_into_tiles(input);
  std::vector<int> tile_of(input.points.size());
  const std::size_t first_tile = tiles.size();
  for (std::size_t t = 0; t < order.size(); ++t) {
    Tile tile{};
    tile.body = number;
    tile.block_begin = body.blocks;
    for (const auto& block : order[t].blocks) {
      body.lanes.push_back(static_cast<unsigned char>(block.size()));
      for (int l = 0; l < kBlock; ++l) body.particle.push_back(l < static_cast<int>(block.size()) ? block[l] : -1);
      for (int p : block) tile_of[p] = static_cast<int>(t);
      ++body.blocks;
    }
    tile.block_end = body.blocks;
    tiles.push_back({tile, order[t].colour});
  }
  fill(input, body);
  if (!input.points.stiffness_factor.empty())
    set_condition(input.points.stiffness_factor, input.points.yield_factor, body);
  kernels<Dim>().set_radius(view_of_wood(body), body.blocks);  // in the bits of the build that will use it
  for (const auto& face : input.faces) add_face(face, tile_of, tiles.data() + first_tile, order.size(), body);
  return body;
}

template <int Dim>
BodyView<Dim> view_of_wood(Particles<Dim>& body) {
  BodyView<Dim> v{};
  v.blocks = body.data.data();
  v.components = body.components;
  v.modes4 = &body.modes4;
  v.modes6 = &body.modes6;
  v.law = body.material.law();
  v.condition = body.condition.size() > 0 ? body.condition.data() : nullptr;
  v.Y_R = 1 / std::sqrt(body.material.yield_surface(2, 2));
  return v;
}

template <int Dim>
void copy_out(const Particles<Dim>& body, Points<Dim>& points) {
  using C = Component<Dim>;
  body.each([&](int p, const Vec<Dim>& x, const double* d) {
    points.x[p] = x;
    for (int a = 0; a < Dim; ++a) points.v[p][a] = d[(C::v + a) * kBlock];
    points.F[p] = body.deformation(d);
    points.stress[p].setZero();
    for (int k = 0; k < body.components; ++k) points.stress[p][wood::kModeToVoigt[k]] = d[(C::stress + k) * kBlock];
    points.plastic[p] = d[C::plastic(body.components) * kBlock];
  });
  if (body.condition.size() == 0) return;
  for (std::size_t p = 0; p < body.where.size(); ++p) {
    const double* factors = body.condition.data() + body.condition_at(body.where[p]);
    points.stiffness_factor[p] = factors[0];
    points.yield_factor[p] = factors[kBlock];
  }
}

template <int Dim>
void scale_velocities(std::vector<Particles<Dim>>& bodies, double factor) {
  using C = Component<Dim>;
  for (auto& body : bodies) {
    const std::size_t size = static_cast<std::size_t>(C::count(body.components)) * kBlock;
    for (std::size_t block = 0; block < body.data.size(); block += size) {
      double* v = body.data.data() + block + C::v * kBlock;
      for (int i = 0; i < Dim * kBlock; ++i) v[i] *= factor;
    }
  }
}

template <int Dim>
double kinetic_energy(const std::vector<Particles<Dim>>& bodies) {
  using C = Component<Dim>;
  double total = 0;
  for (const auto& body : bodies) {
    double sum = 0;
    body.each([&](int, const Vec<Dim>&, const double* d) {
      for (int a = 0; a < Dim; ++a) sum += d[(C::v + a) * kBlock] * d[(C::v + a) * kBlock];
    });
    total += 0.5 * body.mass() * sum;
  }
  return total;
}

namespace {

// Elastic energy per reference volume of wood as measured, MPa: half the square of the stress in the modes.
template <int N>
double stored(const wood::YieldModes<N>& m, const double* stress) {
  double sum = 0;
  for (int i = 0; i < N; ++i) {
    double z = 0;
    for (int j = 0; j < N; ++j) z += m.to_modes[i][j] * stress[j * kBlock];
    sum += 0.5 * z * z;
  }
  return sum;
}

// The same of a particle, from its x component.
template <int Dim>
double stored(const Particles<Dim>& body, const double* d) {
  const double* stress = d + Component<Dim>::stress * kBlock;
  return body.components == 4 ? stored<4>(body.modes4, stress) : stored<6>(body.modes6, stress);
}

// ln J_e of wood as measured: the sum of the elastic strains along the axes.
template <int N>
double elastic_volume(const wood::YieldModes<N>& m, const double* stress) {
  double sum = 0;
  for (int i = 0; i < N; ++i) {
    double z = 0;
    for (int j = 0; j < N; ++j) z += m.to_modes[i][j] * stress[j * kBlock];
    sum += m.volume[i] * z;
  }
  return sum;
}

// The history variable of a particle whose stiffness grew under its stress.
template <int Dim>
double locked_in(const Particles<Dim>& body, const double* d, double stiffness) {
  using C = Component<Dim>;
  const double* stress = d + C::stress * kBlock;
  const auto& laws = body.components == 4 ? body.modes4.laws : body.modes6.laws;
  const double volume =
      body.components == 4 ? elastic_volume<4>(body.modes4, stress) : elastic_volume<6>(body.modes6, stress);
  return wood::with_law(body.material.law(), [&]<class L>() {
    return L::locked_in(wood::part_of<L>(laws), d[C::plastic(body.components) * kBlock],
                        body.deformation(d).determinant(), volume / stiffness);
  });
}

}  // namespace

template <int Dim>
double soften(Particles<Dim>& body, const std::vector<double>& stiffness, const std::vector<double>& yield) {
  using C = Component<Dim>;
  double lost = 0;
  bool hardened = false;
  for (std::size_t p = 0; p < body.where.size(); ++p) {
    double* d = body.data.data() + body.where[p];
    const double before = body.condition.data()[body.condition_at(body.where[p])], now = stiffness[p];
    if (now == before) continue;
    const double ratio = now < before ? now / before : before / now;
    lost += stored(body, d) / before * (1 - ratio);
    if (now < before) {
      for (int k = 0; k < body.components; ++k) d[(C::stress + k) * kBlock] *= ratio;
    } else {
      d[C::plastic(body.components) * kBlock] = locked_in(body, d, now);
      hardened = true;
    }
  }
  set_condition(stiffness, yield, body);
  if (hardened) kernels<Dim>().set_radius(view_of_wood(body), body.blocks);
  return body.volume() * lost;
}

template <int Dim>
double elastic_energy(const std::vector<Particles<Dim>>& bodies) {
  double total = 0;
  for (const auto& body : bodies) {
    double sum = 0;
    body.each([&](int, const Vec<Dim>&, const double* d) { sum += stored(body, d) / body.stiffness_factor(d); });
    total += body.volume() * sum;
  }
  return total;
}

template <int Dim>
double mean_motion_energy(const std::vector<Particles<Dim>>& bodies) {
  double total = 0;
  for (const auto& body : bodies) {
    Vec<Dim> p = Vec<Dim>::Zero();
    double n = 0;
    body.each([&](int, const Vec<Dim>&, const double* d) {
      for (int a = 0; a < Dim; ++a) p[a] += d[(Component<Dim>::v + a) * kBlock];
      n += 1;
    });
    total += 0.5 * body.mass() * p.squaredNorm() / n;
  }
  return total;
}

template <int Dim>
double mean_thickness_stretch(const std::vector<Particles<Dim>>& bodies) {
  double sum = 0;
  std::size_t count = 0;
  for (const auto& body : bodies) {
    body.each([&](int, const Vec<Dim>&, const double* d) { sum += body.deformation(d).col(Dim - 1).norm(); });
    count += body.where.size();
  }
  return count > 0 ? sum / static_cast<double>(count) : 1;
}

template <int Dim>
Vec<Dim> momentum(const std::vector<Particles<Dim>>& bodies) {
  Vec<Dim> total = Vec<Dim>::Zero();
  for (const auto& body : bodies) {
    Vec<Dim> p = Vec<Dim>::Zero();
    body.each([&](int, const Vec<Dim>&, const double* d) {
      for (int a = 0; a < Dim; ++a) p[a] += d[(Component<Dim>::v + a) * kBlock];
    });
    total += body.mass() * p;
  }
  return total;
}

template <int Dim>
double mass(const std::vector<Particles<Dim>>& bodies) {
  double total = 0;
  for (const auto& body : bodies) total += body.mass() * static_cast<double>(body.where.size());
  return total;
}

template <int Dim>
std::size_t bytes(const std::vector<Particles<Dim>>& bodies) {
  std::size_t total = 0;
  for (const auto& body : bodies) {
    total += body.data.bytes() + body.condition.bytes() + body.lanes.size() +
             (body.particle.size() + body.where.size()) * sizeof(int);
    for (const auto& face : body.faces)
      total += face.where.size() * sizeof(int) + face.offset.bytes() + face.area.bytes();
  }
  return total;
}

template Particles<2> store_particles(const Body<2>&, int, std::vector<ColouredTile>&);
template BodyView<2> view_of_wood(Particles<2>&);
template void copy_out(const Particles<2>&, Points<2>&);
template void scale_velocities(std::vector<Particles<2>>&, double);
template double soften(Particles<2>&, const std::vector<double>&, const std::vector<double>&);
template double kinetic_energy(const std::vector<Particles<2>>&);
template double elastic_energy(const std::vector<Particles<2>>&);
template double mean_motion_energy(const std::vector<Particles<2>>&);
template double mean_thickness_stretch(const std::vector<Particles<2>>&);
template Vec<2> momentum(const std::vector<Particles<2>>&);
template double mass(const std::vector<Particles<2>>&);
template std::size_t bytes(const std::vector<Particles<2>>&);
template Particles<3> store_particles(const Body<3>&, int, std::vector<ColouredTile>&);
template BodyView<3> view_of_wood(Particles<3>&);
template void copy_out(const Particles<3>&, Points<3>&);
template void scale_velocities(std::vector<Particles<3>>&, double);
template double soften(Particles<3>&, const std::vector<double>&, const std::vector<double>&);
template double kinetic_energy(const std::vector<Particles<3>>&);
template double elastic_energy(const std::vector<Particles<3>>&);
template double mean_motion_energy(const std::vector<Particles<3>>&);
template double mean_thickness_stretch(const std::vector<Particles<3>>&);
template Vec<3> momentum(const std::vector<Particles<3>>&);
template double mass(const std::vector<Particles<3>>&);
template std::size_t bytes(const std::vector<Particles<3>>&);

}  // namespace strandlab::mpm
