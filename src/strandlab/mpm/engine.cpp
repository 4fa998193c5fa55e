#include "strandlab/mpm/engine.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <chrono>
#include <cmath>

#include "strandlab/core/error.hpp"
#include "strandlab/core/thread_team.hpp"
#include "strandlab/mpm/aligned.hpp"
#include "strandlab/mpm/kernels.hpp"
#include "strandlab/mpm/windows.hpp"
#include "strandlab/wood/yield_modes.hpp"

namespace strandlab::mpm {
namespace {

constexpr int kTileColumns = 32;       // particles of a tile along the strand (2D)
constexpr int kTileColumns3 = 16;      // and along and across it (3D)
constexpr int kTimeStepInterval = 32;  // steps between updates of the time step
constexpr double kMaxDrift = 0.45;     // cells a particle may move before the windows are made again
constexpr double kWindowDrift = 0.5;   // and what the windows allow
constexpr double kFilterDrift = 0.1;   // the same before a step that filters: it looks at positions after the step
constexpr double kMaxStretch = 20;     // of a particle; far beyond what wood bears

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double ticks() {
#if defined(__x86_64__)
  return static_cast<double>(__builtin_ia32_rdtsc());
#else
  return 1e9 * seconds();
#endif
}

// Weights of the nodes around a point, for the few places outside the kernels that need them.
template <int Dim>
struct PointStencil {
  std::array<int, Dim> node;
  std::array<Gimp3, Dim> axis;
};

}  // namespace

Gimp3 gimp(double d, double r) {
  const double u1 = std::max(d + r, 0.0), u0 = std::max(d - r, 0.0);
  const double l1 = std::max(r - d, 0.0), l0 = std::max(-d - r, 0.0);
  const double wr = (u1 * u1 - u0 * u0) / (4 * r), wl = (l1 * l1 - l0 * l0) / (4 * r);
  const double gr = (u1 - u0) / (2 * r), gl = (l1 - l0) / (2 * r);
  return {{wl, 1 - wl - wr, wr}, {-gl, gl - gr, gr}};
}

template <int Dim>
struct Engine<Dim>::Impl {
  using C = Component<Dim>;

  struct BodyData {
    std::string name;
    wood::StrandMaterial material;
    int components = 4;
    wood::YieldModes<4> modes4{};
    wood::YieldModes<6> modes6{};
    Vec<Dim> spacing;
    int blocks = 0;
    AlignedArray data;                 // blocks of particles
    std::vector<unsigned char> lanes;  // real particles per block
    std::vector<int> particle;         // user's index of each lane, -1 for padding
    std::vector<int> where;            // for each user index: offset of its x in data
    struct FaceData {
      std::vector<int> where;
      AlignedArray offset, area;
    };
    std::vector<FaceData> faces;
    Vec<Dim> reach = Vec<Dim>::Zero();  // furthest offset of a face point per axis, mm at formation
    double particle_volume() const { return spacing.prod(); }
    double particle_mass() const { return material.density * spacing.prod(); }
  };

  Grid<Dim> grid;
  Options options;
  std::vector<BodyData> bodies;
  std::vector<BodyWindows> windows;
  std::vector<BodyView<Dim>> views;
  PencilTable table;
  std::vector<Tile> tiles;        // by colour
  std::vector<int> colour_begin;  // ranges of tiles that may scatter at the same time
  std::vector<TileResult> tile_results;
  std::vector<PencilResult> pencil_results;
  AlignedArray nodes, surface, filtered;
  std::vector<double> tractions;
  bool has_tractions = false;
  struct SpringData {
    Spring<Dim> spring;
    Vec<Dim> jump = Vec<Dim>::Zero();  // mm, [u]
  };
  std::vector<SpringData> springs;
  bool has_platens = false;
  Vec<Dim> gravity = Vec<Dim>::Zero();
  EngineState state;
  double first_time_step = 0;
  std::array<double, 3> drift{};
  bool windows_valid = false;
  double force[2] = {0, 0};
  Timing timing;
  double timing_ticks = 0, timing_seconds = 0;
  double yield_visits = 0;
  long long particle_steps = 0;
  std::size_t particle_count = 0;
  const Kernels<Dim>* kernel = nullptr;
  ThreadTeam team;

  Impl(const std::vector<Body<Dim>>& input, const Grid<Dim>& g, const Options& o)
      : grid(g), options(o), kernel(&kernels<Dim>()), team(o.threads) {
    check_grid();
    for (std::size_t b = 0; b < input.size(); ++b) add_body(input[b], static_cast<int>(b));
    colour_tiles();
    tile_results.resize(tiles.size());
    tractions.assign(bodies.size() * kMaxFaces * Dim, 0.0);
    for (std::size_t b = 0; b < input.size(); ++b) {
      for (std::size_t f = 0; f < input[b].faces.size(); ++f) set_traction(b, f, input[b].faces[f].traction);
    }
    state.time_step_s = first_time_step = time_step();
    check_particles_inside();
  }

  void set_traction(std::size_t b, std::size_t f, const Vec<Dim>& t) {
    for (int a = 0; a < Dim; ++a) tractions[(b * kMaxFaces + f) * Dim + a] = t[a];
    has_tractions = std::any_of(tractions.begin(), tractions.end(), [](double v) { return v != 0; });
  }

  // ------------------------------------------------------------------------------------------------ construction

  void check_grid() const {
    for (int a = 0; a < Dim; ++a) {
      if (!(grid.cell[a] > 0))
        throw InputError(fmt::format("grid: cell size {} mm on axis {}; it must be positive", grid.cell[a], a));
      if (!(grid.hi[a] > grid.lo[a])) throw InputError(fmt::format("grid: empty window on axis {}", a));
      if (a == Dim - 1) continue;
      for (int side = 0; side < 2; ++side) {
        if (grid.sides[a][side] != Side::kRoller) continue;
        const double plane = ((side == 0 ? grid.lo[a] : grid.hi[a]) - grid.origin[a]) / grid.cell[a];
        if (std::abs(plane - std::round(plane)) > 1e-6) {
          throw InputError(
              fmt::format("grid: the roller plane on axis {} must lie on a grid line, it is at {} cells", a, plane));
        }
      }
    }
  }

  // Order of a body's particles in blocks: tile by tile, within a tile row by row, eight neighbours along the strand to
  // a block.
  std::vector<std::vector<std::vector<int>>> tile_order(const Body<Dim>& body, std::vector<int>& colours) const {
    std::vector<std::vector<std::vector<int>>> result;  // tile -> block -> particle
    const auto add_run = [](std::vector<std::vector<int>>& blocks, const std::vector<int>& run) {
      for (std::size_t i = 0; i < run.size(); i += kBlock) {
        blocks.emplace_back(run.begin() + static_cast<long>(i),
                            run.begin() + static_cast<long>(std::min(run.size(), i + kBlock)));
      }
    };
    std::size_t lattice = 1;
    for (int n : body.points) lattice *= static_cast<std::size_t>(n);
    if (lattice != body.x.size()) {
      std::vector<int> all(body.x.size());
      for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
      result.emplace_back();
      add_run(result.back(), all);
      colours.push_back(0);
      return result;
    }
    const int width = Dim == 2 ? kTileColumns : kTileColumns3;
    const int nx = body.points[0], ny = body.points[1], nz = Dim == 3 ? body.points[Dim - 1] : 1;
    const int across = Dim == 3 ? width : ny;  // in 2D a tile holds all rows
    for (int j0 = 0; j0 < ny; j0 += across) {
      for (int i0 = 0; i0 < nx; i0 += width) {
        result.emplace_back();
        colours.push_back((i0 / width) % 2 + (Dim == 3 ? 2 * ((j0 / width) % 2) : 0));
        for (int k = 0; k < nz; ++k) {
          for (int j = j0; j < std::min(ny, j0 + across); ++j) {
            std::vector<int> run;
            for (int i = i0; i < std::min(nx, i0 + width); ++i) run.push_back(i + nx * (j + ny * k));
            add_run(result.back(), run);
          }
        }
      }
    }
    return result;
  }

  std::vector<int> tile_colours;

  void add_body(const Body<Dim>& input, int index) {
    if (input.faces.size() > kMaxFaces)
      throw InputError(fmt::format("body {}: more than {} faces", input.name, kMaxFaces));
    if (input.x.empty()) throw InputError(fmt::format("body {}: no particles", input.name));
    bodies.emplace_back();
    BodyData& body = bodies.back();
    body.name = input.name;
    body.material = input.material;
    body.spacing = input.spacing;
    body.components = Dim == 3 || wood::needs_six(input.material) ? 6 : 4;
    if (body.components == 4)
      body.modes4 = wood::yield_modes<4>(input.material);
    else
      body.modes6 = wood::yield_modes<6>(input.material);

    std::vector<int> colours;
    const auto order = tile_order(input, colours);
    std::vector<int> tile_of(input.x.size());
    const std::size_t first_tile = tiles.size();
    for (std::size_t t = 0; t < order.size(); ++t) {
      Tile tile{};
      tile.body = index;
      tile.block_begin = body.blocks;
      for (const auto& block : order[t]) {
        body.lanes.push_back(static_cast<unsigned char>(block.size()));
        for (int l = 0; l < kBlock; ++l) body.particle.push_back(l < static_cast<int>(block.size()) ? block[l] : -1);
        for (int p : block) tile_of[p] = static_cast<int>(t);
        ++body.blocks;
      }
      tile.block_end = body.blocks;
      tiles.push_back(tile);
      tile_colours.push_back(colours[t]);
    }
    fill(input, body);
    set_radius(body);
    for (const auto& face : input.faces) add_face(face, tile_of, order.size(), first_tile, body);
    particle_count += input.x.size();
  }

  void fill(const Body<Dim>& input, BodyData& body) {
    const int count = C::count(body.components);
    body.data.resize(static_cast<std::size_t>(body.blocks) * count * kBlock);
    body.where.resize(input.x.size());
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
          d[(C::x + a) * kBlock] = input.x[p][a];
          d[(C::v + a) * kBlock] = input.v[p][a];
          for (int k = 0; k < Dim; ++k) d[(C::F + a * Dim + k) * kBlock] = input.F[p](a, k);
        }
        for (int k = 0; k < body.components; ++k) d[(C::stress + k) * kBlock] = input.stress[p][wood::kModeToVoigt[k]];
        d[C::plastic(body.components) * kBlock] = input.plastic[p];
        d[C::radius(body.components) * kBlock] =
            1 + wood::ScalarOps::hardening_slope(body.material.hardening_K / body.material.Y_R,
                                                 body.material.hardening_n, input.plastic[p]) *
                    input.plastic[p] / body.material.hardening_n;
      }
    }
  }

  // The power law's radius has the same bits in every build; that of crushing is left to the build that will use it.
  void set_radius(BodyData& body) {
    if (!body.material.crushes()) return;
    BodyView<Dim> v{};
    see_wood(body, v);
    kernel->set_radius(v, body.blocks);
  }

  static void see_wood(BodyData& body, BodyView<Dim>& v) {
    v.blocks = body.data.data();
    v.components = body.components;
    v.modes4 = &body.modes4;
    v.modes6 = &body.modes6;
    v.crushes = body.material.crushes();
  }

  void add_face(const Face<Dim>& face, const std::vector<int>& tile_of, std::size_t tile_count, std::size_t first_tile,
                BodyData& body) {
    const std::size_t f = body.faces.size();
    body.faces.emplace_back();
    auto& data = body.faces.back();
    for (const auto& offset : face.offset) body.reach = body.reach.cwiseMax(offset.cwiseAbs());
    std::vector<std::vector<int>> by_tile(tile_count);
    for (std::size_t i = 0; i < face.particle.size(); ++i)
      by_tile[tile_of[face.particle[i]]].push_back(static_cast<int>(i));
    std::vector<int> order;  // -1: padding
    for (std::size_t t = 0; t < tile_count; ++t) {
      tiles[first_tile + t].face_begin[f] = static_cast<int>(order.size()) / kBlock;
      order.insert(order.end(), by_tile[t].begin(), by_tile[t].end());
      while (order.size() % kBlock) order.push_back(-1);
      tiles[first_tile + t].face_end[f] = static_cast<int>(order.size()) / kBlock;
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

  void colour_tiles() {
    std::vector<int> order(tiles.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return tile_colours[a] < tile_colours[b]; });
    std::vector<Tile> sorted;
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (i == 0 || tile_colours[order[i]] != tile_colours[order[i - 1]]) colour_begin.push_back(static_cast<int>(i));
      sorted.push_back(tiles[order[i]]);
    }
    colour_begin.push_back(static_cast<int>(tiles.size()));
    tiles = std::move(sorted);
  }

  // ------------------------------------------------------------------------------------------------ grid geometry

  double stretch() const {  // of the cells' height against grid.cell
    if (!grid.follow_platens || !has_platens) return 1;
    return (state.top.position - state.bottom.position) / (grid.hi[Dim - 1] - grid.lo[Dim - 1]);
  }

  Frame<Dim> frame() const {
    Frame<Dim> f{};
    for (int a = 0; a < Dim; ++a) {
      f.origin[a] = grid.origin[a];
      f.cell[a] = grid.cell[a];
      f.gravity[a] = gravity[a];
      for (int side = 0; side < 2; ++side) {
        f.wall[a][side] = kNoWall;
        if (a < Dim - 1 && grid.sides[a][side] == Side::kRoller) {
          f.wall[a][side] =
              static_cast<int>(std::lround(((side == 0 ? grid.lo[a] : grid.hi[a]) - grid.origin[a]) / grid.cell[a]));
        }
      }
    }
    const int y = Dim - 1;
    if (grid.follow_platens && has_platens) {
      const double s = stretch();
      f.cell[y] = grid.cell[y] * s;
      f.origin[y] = state.bottom.position + (grid.origin[y] - grid.lo[y]) * s;
    }
    for (int a = 0; a < Dim; ++a) f.inverse_cell[a] = 1 / f.cell[a];
    f.dt = state.time_step_s;
    f.transit = state.time_step_s / options.courant;
    f.platen[0] = {has_platens, state.bottom.position, state.bottom.velocity};
    f.platen[1] = {has_platens, state.top.position, state.top.velocity};
    return f;
  }

  // Wave speeds along the panel's axes from the acoustic tensor of the rotated stiffness (bounded by its largest row
  // sum), in a sample of the particles: the grain angle varies slowly along a strand.
  double time_step(std::string* where = nullptr) const {
    const Frame<Dim> f = frame();
    double limit = 1e300;
    const BodyData* tightest = nullptr;  // and its particle
    const double* at = nullptr;
    for (const auto& body : bodies) {
      const VoigtMatrix& c = body.material.stiffness;
      const int count = C::count(body.components);
      for (int b = 0; b < body.blocks; b += (body.blocks > 32 ? 4 : 1)) {
        const double* d = body.data.data() + static_cast<std::size_t>(b) * count * kBlock;
        Tensor<Dim> F;
        for (int i = 0; i < Dim; ++i) {
          for (int j = 0; j < Dim; ++j) F(i, j) = d[(C::F + i * Dim + j) * kBlock];
        }
        Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // columns: along, across, thickness; rows: x, y, z
        if constexpr (Dim == 2) {
          const Vec<2> g = grain<2>(F);
          axes.col(0) << g[0], 0, g[1];
          axes.col(2) << -g[1], 0, g[0];
        } else {
          const Eigen::Vector3d along = F.col(0).normalized();
          const Eigen::Vector3d t = along.cross(Eigen::Vector3d(F.col(1))).normalized();
          axes << along, t.cross(along), t;
        }
        for (int a = 0; a < Dim; ++a) {
          const Eigen::Vector3d n = axes.row(Dim == 2 ? 2 * a : a);
          Eigen::Matrix<double, 6, 3> B;
          B << n[0], 0, 0, 0, n[1], 0, 0, 0, n[2], 0, n[2], n[1], n[2], 0, n[0], n[1], n[0], 0;
          const Eigen::Matrix3d acoustic = B.transpose() * c * B;
          const double stiffness = acoustic.cwiseAbs().rowwise().sum().maxCoeff();
          double pressure = 0;
          for (int k = 0; k < body.components; ++k)
            pressure = std::max(pressure, std::abs(d[(C::stress + k) * kBlock]));
          const double speed =
              std::sqrt((stiffness + pressure) / body.material.density) + std::abs(d[(C::v + a) * kBlock]);
          if (f.cell[a] / speed < limit) {
            limit = f.cell[a] / speed;
            tightest = &body;
            at = d;
          }
        }
      }
    }
    if (where) *where = tightest ? fmt::format("{} at ({})", tightest->name, text(position(at))) : "no particle";
    return options.courant * limit;
  }

  template <class Visit>  // visit(user index, position, F)
  void each_particle(const BodyData& body, Visit visit) const {
    const int count = C::count(body.components);
    for (int b = 0; b < body.blocks; ++b) {
      for (int l = 0; l < body.lanes[b]; ++l) {
        const double* d = body.data.data() + static_cast<std::size_t>(b) * count * kBlock + l;
        visit(body.particle[b * kBlock + l], position(d), d);
      }
    }
  }

  // A particle may not leave the window: behind a roller by more than a quarter cell, elsewhere by more than the
  // margin.
  void check_particles_inside() const {
    for (const auto& body : bodies) {
      each_particle(body, [&](int p, const Vec<Dim>& x, const double*) {
        for (int a = 0; a < Dim; ++a) {
          const auto allowed = [&](int side) {
            if (a < Dim - 1 && grid.sides[a][side] == Side::kRoller) return 0.25 * grid.cell[a];
            return (a == Dim - 1 && has_platens ? 1.0 : 0.25) * (grid.hi[a] - grid.lo[a]) + 2 * grid.cell[a];
          };
          if (x[a] >= grid.lo[a] - allowed(0) && x[a] <= grid.hi[a] + allowed(1)) continue;
          throw RunError(fmt::format("step {}, time {:.6g} ms: particle {} of {} left the grid at ({})", state.step,
                                     1e3 * state.time_s, p, body.name, text(x)));
        }
      });
    }
  }

  static Vec<Dim> position(const double* d) {
    Vec<Dim> x;
    for (int a = 0; a < Dim; ++a) x[a] = d[(C::x + a) * kBlock];
    return x;
  }

  static std::string text(const Vec<Dim>& x) {
    std::string s;
    for (int a = 0; a < Dim; ++a) s += fmt::format("{}{:.4f}", a ? ", " : "", x[a]);
    return s + " mm";
  }

  // Nodes that may become a point's nearest before the windows are made again: first and last per axis.
  static std::array<std::array<int, 3>, 2> nearest_nodes(const Vec<Dim>& x, const Frame<Dim>& f) {
    std::array<std::array<int, 3>, 2> range{};
    for (int a = 0; a < Dim; ++a) {
      const double xi = (x[a] - f.origin[a]) * f.inverse_cell[a];
      const int axis = a == Dim - 1 ? 2 : a;  // rows last, lateral axes first
      range[0][axis] = static_cast<int>(std::lround(xi - kWindowDrift));
      range[1][axis] = static_cast<int>(std::lround(xi + kWindowDrift));
    }
    return range;
  }

  WindowStore window_over(const std::vector<Vec<Dim>>& points, const Frame<Dim>& f, int start) const {
    auto [first3, last3] = nearest_nodes(points[0], f);
    for (const auto& x : points) {
      const auto range = nearest_nodes(x, f);
      for (int a = 0; a < 2; ++a) {
        first3[a] = std::min(first3[a], range[0][a]);
        last3[a] = std::max(last3[a], range[1][a]);
      }
    }
    const std::array<int, 2> first{first3[0], first3[1]}, last{last3[0], last3[1]};
    Extents extents(first, last);  // in 3D never flat across: from and to differ
    for (const auto& x : points) {
      const auto [from, to] = nearest_nodes(x, f);
      for (int j = from[1]; j <= to[1]; ++j) {
        for (int i = from[0]; i <= to[0]; ++i) {
          extents.add({i, j}, from[2]);
          extents.add({i, j}, to[2]);
        }
      }
    }
    extents.dilate();
    for (int a = 0; a < Dim - 1; ++a) {  // a ghost pencil and its mirror image hold the same rows
      for (int side = 0; side < 2; ++side) {
        if (f.wall[a][side] == kNoWall) continue;
        const int other = 1 - a;
        for (int k = extents.first[other]; k < extents.first[other] + extents.count[other]; ++k) {
          std::array<int, 2> ghost{}, mirror{};
          ghost[a] = f.wall[a][side] + (side == 0 ? -1 : 1);
          mirror[a] = f.wall[a][side] + (side == 0 ? 1 : -1);
          ghost[other] = mirror[other] = k;
          extents.merge(ghost, mirror);
        }
      }
    }
    WindowStore store;
    store.place(extents, start);
    return store;
  }

  bool filter_due() const { return options.filter_interval > 0 && (state.step + 1) % options.filter_interval == 0; }
  bool windows_stale() const {
    return !windows_valid || *std::max_element(drift.begin(), drift.end()) > (filter_due() ? kFilterDrift : kMaxDrift);
  }

  void make_windows() {
    check_particles_inside();
    const Frame<Dim> f = frame();
    windows.assign(bodies.size(), {});
    int node_records = 0, surface_records = 0;
    std::vector<Vec<Dim>> points;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const auto& body = bodies[b];
      points.clear();
      each_particle(body, [&](int, const Vec<Dim>& x, const double*) { points.push_back(x); });
      windows[b].field = window_over(points, f, node_records);
      node_records += windows[b].field.records;
      for (int k = 0; k < 2 && has_platens; ++k) {
        const double wall = k == 0 ? state.bottom.position : state.top.position;
        std::vector<Vec<Dim>> images;
        for (Vec<Dim> x : points) {  // kMirrorDepth, and what may come within it before the next rebuild
          if (std::abs(x[Dim - 1] - wall) > (kMirrorDepth + 1) * f.cell[Dim - 1]) continue;
          x[Dim - 1] = 2 * wall - x[Dim - 1];
          images.push_back(x);
        }
        if (images.empty()) continue;
        windows[b].mirrors[k] = window_over(images, f, node_records);
        node_records += windows[b].mirrors[k].records;
      }
      for (const auto& face : body.faces) {
        points.clear();
        for (std::size_t i = 0; i < face.where.size(); ++i) {
          const double* d = body.data.data() + face.where[i];
          Vec<Dim> x;
          for (int a = 0; a < Dim; ++a) {
            x[a] = d[(C::x + a) * kBlock];
            for (int k = 0; k < Dim; ++k) {
              x[a] += d[(C::F + a * Dim + k) * kBlock] * face.offset[(i / kBlock * Dim + k) * kBlock + i % kBlock];
            }
          }
          points.push_back(x);
          if ((x - position(d)).norm() <= kMaxStretch * body.reach.norm()) continue;
          throw RunError(
              fmt::format("step {}, time {:.6g} ms: a particle of {} at ({}) is stretched out of all proportion",
                          state.step, 1e3 * state.time_s, body.name, text(position(d))));
        }
        windows[b].faces.push_back(window_over(points, f, surface_records));
        surface_records += windows[b].faces.back().records;
      }
    }
    nodes.resize(static_cast<std::size_t>(node_records) * kRecord);
    surface.resize(static_cast<std::size_t>(surface_records) * kSurfaceRecord<Dim>);
    std::array<std::array<int, 2>, 2> walls{{{kNoWall, kNoWall}, {kNoWall, kNoWall}}};
    for (int a = 0; a < Dim - 1; ++a) walls[a] = {f.wall[a][0], f.wall[a][1]};
    table = tabulate(windows, walls);
    pencil_results.resize(table.pencils.size());
    make_views();
    drift = {};
    windows_valid = true;
  }

  void make_views() {
    views.clear();
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      auto& body = bodies[b];
      BodyView<Dim> v{};
      see_wood(body, v);
      v.mass = body.particle_mass();
      v.volume = body.particle_volume();
      for (int a = 0; a < Dim; ++a) {
        v.half_size[a] = 0.5 * body.spacing[a];
        v.reach[a] = body.reach[a];
      }
      windows[b].field.window.base = windows[b].field.base.data();
      v.window = windows[b].field.window;
      for (int k = 0; k < 2; ++k) {
        windows[b].mirrors[k].window.base = windows[b].mirrors[k].base.data();
        v.mirror[k] = windows[b].mirrors[k].window;
      }
      v.faces = static_cast<int>(body.faces.size());
      for (int f = 0; f < v.faces; ++f) {
        windows[b].faces[f].window.base = windows[b].faces[f].base.data();
        v.face[f] = {windows[b].faces[f].window, body.faces[f].where.data(), body.faces[f].offset.data(),
                     body.faces[f].area.data()};
      }
      views.push_back(v);
    }
  }

  // ------------------------------------------------------------------------------------------------ rollers

  // Calls visit(axis, side, ghost record, mirror record, records to fold) for a window's nodes one cell behind each
  // roller.
  template <class Visit>
  static void each_ghost(const WindowStore& w, const Frame<Dim>& f, bool reverse, Visit visit) {
    for (int n = 0; n < Dim - 1; ++n) {
      const int a = reverse ? Dim - 2 - n : n;
      for (int side = 0; side < 2; ++side) {
        if (f.wall[a][side] == kNoWall) continue;
        const int step = side == 0 ? -1 : 1;
        const int ghost = f.wall[a][side] + step - w.window.first[a],
                  mirror = f.wall[a][side] - step - w.window.first[a];
        if (ghost < 0 || mirror < 0 || ghost >= w.window.count[a] || mirror >= w.window.count[a]) continue;
        const int other = 1 - a;
        for (int k = 0; k < w.window.count[other]; ++k) {
          const auto pencil = [&](int i) { return a == 0 ? k * w.window.count[0] + i : i * w.window.count[0] + k; };
          const int g = pencil(ghost), m = pencil(mirror);
          if (w.hi[g] < w.lo[g]) continue;
          visit(a, side, w.base[g] + w.lo[g], w.base[m] + w.lo[g], w.hi[g] - w.lo[g] + 1);
        }
      }
    }
  }

  // Calls visit(axis, side, first record, count) for a window's nodes on each roller plane.
  template <class Visit>
  static void each_wall(const WindowStore& w, const Frame<Dim>& f, Visit visit) {
    for (int a = 0; a < Dim - 1; ++a) {
      for (int side = 0; side < 2; ++side) {
        const int at = f.wall[a][side] - w.window.first[a];
        if (f.wall[a][side] == kNoWall || at < 0 || at >= w.window.count[a]) continue;
        for (int k = 0; k < w.window.count[1 - a]; ++k) {
          const int p = a == 0 ? k * w.window.count[0] + at : at * w.window.count[0] + k;
          if (w.hi[p] >= w.lo[p]) visit(a, side, w.base[p] + w.lo[p], w.hi[p] - w.lo[p] + 1);
        }
      }
    }
  }

  // The body continues as its mirror image behind a roller: what fell on the ghost nodes is added to their mirror
  // images.
  void fold(const Frame<Dim>& f) {
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const auto add_to_mirror = [&](int axis, int, int ghost, int mirror, int count) {
        for (int i = 0; i < count; ++i) {
          double* g = nodes.data() + static_cast<std::size_t>(ghost + i) * kRecord;
          double* m = nodes.data() + static_cast<std::size_t>(mirror + i) * kRecord;
          for (int k = 0; k < 1 + 2 * Dim; ++k) {
            const bool odd = k == 1 + axis || k == 1 + Dim + axis;
            m[k] += odd ? -g[k] : g[k];
          }
        }
      };
      each_ghost(windows[b].field, f, false, add_to_mirror);
      for (const auto& image : windows[b].mirrors) each_ghost(image, f, false, add_to_mirror);
      for (const auto& face : windows[b].faces) {
        each_ghost(face, f, false, [&](int axis, int side, int ghost, int mirror, int count) {
          const double plane = f.origin[axis] + f.wall[axis][side] * f.cell[axis];
          for (int i = 0; i < count; ++i) {
            double* g = surface.data() + static_cast<std::size_t>(ghost + i) * kSurfaceRecord<Dim>;
            double* m = surface.data() + static_cast<std::size_t>(mirror + i) * kSurfaceRecord<Dim>;
            for (int k = 0; k < Dim; ++k) m[k] += k == axis ? -g[k] : g[k];
            m[Dim] += g[Dim];
            m[Dim + 1] += g[Dim + 1] - 2 * plane * g[axis];  // x.n of the mirrored point
          }
        });
        // On the plane itself a face and its image have no normal component across it; the distance to the face stays.
        each_wall(face, f, [&](int axis, int side, int first, int count) {
          const double plane = f.origin[axis] + f.wall[axis][side] * f.cell[axis];
          for (int i = first; i < first + count; ++i) {
            double* s = surface.data() + static_cast<std::size_t>(i) * kSurfaceRecord<Dim>;
            s[Dim + 1] -= plane * s[axis];
            s[axis] = 0;
          }
        });
      }
    }
  }

  void unfold(const Frame<Dim>& f) {
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      each_ghost(windows[b].field, f, true, [&](int axis, int, int ghost, int mirror, int count) {
        for (int i = 0; i < count; ++i) {
          double* g = nodes.data() + static_cast<std::size_t>(ghost + i) * kRecord;
          const double* m = nodes.data() + static_cast<std::size_t>(mirror + i) * kRecord;
          for (int k = 0; k < 2 * Dim; ++k) g[k] = k == axis || k == Dim + axis ? -m[k] : m[k];
        }
      });
    }
  }

  // ------------------------------------------------------------------------------------------------ one step

  void step() {
    const double t0 = options.profile ? seconds() : 0, c0 = options.profile ? ticks() : 0;
    if (state.step % kTimeStepInterval == 0) update_time_step();
    if (windows_stale()) make_windows();
    const Frame<Dim> f = frame();
    scatter(f);
    apply_tractions(f);
    apply_springs(f);
    fold(f);
    update_grid(f);
    unfold(f);
    book_tractions(f);
    stretch_springs(f);
    gather(f);
    if (filter_due()) filter(f);
    advance(f);
    if (options.profile) {
      timing_seconds += seconds() - t0;
      timing_ticks += ticks() - c0;
    }
  }

  // A step whose nodes take their velocity from outside.
  void impose(double dt, const std::function<Vec<Dim>(const Vec<Dim>&)>& velocity) {
    state.time_step_s = dt;
    if (windows_stale()) make_windows();
    const Frame<Dim> f = frame();
    const double filtered_before = state.energies.filter;
    scatter(f);
    for (const auto& w : windows) impose_on_nodes(w.field, f, velocity);
    gather(f);
    state.energies.filter = filtered_before;
    advance(f);
    state.time_step_s = time_step();  // for steps that follow
  }

  void impose_on_nodes(const WindowStore& w, const Frame<Dim>& f,
                       const std::function<Vec<Dim>(const Vec<Dim>&)>& velocity) {
    for (int p = 0; p < w.pencils(); ++p) {
      Vec<Dim> x;
      for (int a = 0; a < Dim - 1; ++a) {
        const int along = a == 0 ? p % w.window.count[0] : p / w.window.count[0];
        x[a] = f.origin[a] + (w.window.first[a] + along) * f.cell[a];
      }
      for (int row = w.lo[p]; row <= w.hi[p]; ++row) {
        double* r = nodes.data() + static_cast<std::size_t>(w.base[p] + row) * kRecord;
        const double mass = r[0];
        x[Dim - 1] = f.origin[Dim - 1] + row * f.cell[Dim - 1];
        const Vec<Dim> v = velocity(x);
        Vec<Dim> before = v;
        for (int a = 0; a < Dim && mass > 0; ++a) before[a] = r[1 + a] / mass;
        for (int a = 0; a < Dim; ++a) {
          r[a] = v[a];
          r[Dim + a] = v[a] - before[a];
        }
        r[7] = mass;
      }
    }
  }

  void update_time_step() {
    state.time_step_s = time_step();
    if (!(state.time_step_s > 1e-4 * first_time_step)) {
      std::string where;
      time_step(&where);
      throw RunError(fmt::format("step {}, time {:.6g} ms: the time step fell to {:.3g} s from {:.3g} s, for {}",
                                 state.step, 1e3 * state.time_s, state.time_step_s, first_time_step, where));
    }
  }

  void scatter(const Frame<Dim>& f) {
    std::fill(tile_results.begin(), tile_results.end(), TileResult{});
    clear(nodes);
    clear(surface);
    for (std::size_t colour = 0; colour + 1 < colour_begin.size(); ++colour) {
      const int begin = colour_begin[colour], end = colour_begin[colour + 1];
      team.for_each(end - begin, 2, [&](int i) {
        const int t = begin + i;
        kernel->scatter(tiles[t], views[tiles[t].body], f, nodes.data(), surface.data(),
                        bodies[tiles[t].body].lanes.data(), options.profile, tile_results[t]);
      });
    }
  }

  void clear(AlignedArray& array) {
    constexpr std::size_t kChunk = 1 << 15;
    const auto chunks = static_cast<int>((array.size() + kChunk - 1) / kChunk);
    team.for_each(chunks, 1, [&](int c) {
      const std::size_t begin = c * kChunk, end = std::min(array.size(), begin + kChunk);
      std::fill(array.data() + begin, array.data() + end, 0.0);
    });
  }

  void update_grid(const Frame<Dim>& f) {
    GridView<Dim> view{};
    view.nodes = nodes.data();
    view.surface = surface.data();
    view.fields = table.fields.data();
    view.row_start = table.row_start.data();
    view.slots = table.slots.data();
    view.friction = options.friction;
    view.platen_friction = options.platen_friction;
    const auto count = static_cast<int>(table.pencils.size());
    const double start = options.profile ? ticks() : 0;
    team.for_each(count, 8, [&](int p) {
      pencil_results[p] = PencilResult{};
      kernel->update_grid(table.pencils[p], f, view, options.profile, pencil_results[p]);
    });
    PencilResult total{};
    for (const auto& r : pencil_results) {
      total.friction += r.friction;
      total.contact += r.contact;
      total.platen_work += r.platen_work;
      total.kinetic_change += r.kinetic_change;
      total.force_change += r.force_change;
      total.external_work += r.external_work;
      total.contact_ticks += r.contact_ticks;
      total.overflow |= r.overflow;
      for (int k = 0; k < 2; ++k) total.platen_impulse[k] += r.platen_impulse[k];
    }
    if (total.overflow) {
      const auto where = std::find_if(pencil_results.begin(), pencil_results.end(), [](auto& r) { return r.overflow; });
      const int column = table.pencils[where - pencil_results.begin()].index[0];
      throw RunError(
          fmt::format("step {}, time {:.6g} ms: more than {} bodies meet at one grid node near x = {:.4f} mm",
                      state.step, 1e3 * state.time_s, kMaxFields, f.origin[0] + column * f.cell[0]));
    }
    state.energies.friction += total.friction;
    state.energies.contact += total.contact;
    state.energies.platen_work += total.platen_work;
    state.energies.external_work += total.external_work;
    state.energies.filter += total.kinetic_change + total.force_change;
    for (int k = 0; k < 2; ++k) force[k] = total.platen_impulse[k] / f.dt;
    if (options.profile) {
      const double all = (ticks() - start) * (options.threads > 1 ? options.threads : 1);
      timing.contact += total.contact_ticks;
      timing.grid += all - total.contact_ticks;
    }
  }

  void gather(const Frame<Dim>& f) {
    const auto count = static_cast<int>(tiles.size());
    team.for_each(count, 2, [&](int t) {
      kernel->gather(tiles[t], views[tiles[t].body], f, nodes.data(), bodies[tiles[t].body].lanes.data(),
                     options.profile, tile_results[t]);
    });
    long long yielding = 0;
    std::array<double, 3> moved{};
    for (int t = 0; t < count; ++t) {
      const auto& r = tile_results[t];
      state.energies.plastic += r.plastic;
      state.energies.filter -= r.kinetic_change + r.stress_change;
      yielding += r.yielding;
      for (int a = 0; a < 3; ++a) moved[a] = std::max(moved[a], r.drift[a]);
      if (r.bad) report_failure(tiles[t], r.bad - 1);
      timing.weights += r.ticks[0];
      timing.scatter += r.ticks[1];
      timing.surface += r.ticks[2];
      timing.material += r.ticks[3];
      timing.gather += r.ticks[4];
    }
    for (int a = 0; a < 3; ++a) drift[a] += moved[a];
    yield_visits += static_cast<double>(yielding);
    particle_steps += static_cast<long long>(particle_count);
  }

  [[noreturn]] void report_failure(const Tile& tile, int block) const {
    const auto& body = bodies[tile.body];
    const double* d = body.data.data() + static_cast<std::size_t>(block) * C::count(body.components) * kBlock;
    std::string what = "stress is not finite";
    int lane = 0;
    for (int l = body.lanes[block] - 1; l >= 0; --l) {
      for (int k = 0; k < body.components; ++k) {
        if (!(std::abs(d[(C::stress + k) * kBlock + l]) < kLargestStress)) lane = l;
      }
    }
    for (int l = 0; l < body.lanes[block]; ++l) {
      Tensor<Dim> F;
      for (int i = 0; i < Dim; ++i) {
        for (int j = 0; j < Dim; ++j) F(i, j) = d[(C::F + i * Dim + j) * kBlock + l];
      }
      double J = F(0, 0) * F(1, 1) - F(0, 1) * F(1, 0);
      if constexpr (Dim == 3) J = Eigen::Matrix3d(F).determinant();
      if (J <= 1e-6) {
        what = fmt::format("inverted (det F = {:.3g})", J);
        lane = l;
        break;
      }
    }
    throw RunError(fmt::format("step {}, time {:.6g} ms: particle {} of {} at ({}): {}", state.step, 1e3 * state.time_s,
                               body.particle[block * kBlock + lane], body.name, text(position(d + lane)), what));
  }

  void advance(const Frame<Dim>& f) {
    ++state.step;
    state.time_s += f.dt;
    if (!has_platens) return;
    const double before = stretch();
    state.bottom.position += state.bottom.velocity * f.dt;
    state.top.position += state.top.velocity * f.dt;
    // Grid lines that follow the platens move by at most the platens' own displacement.
    if (grid.follow_platens) {
      const double moved = std::max(std::abs(state.bottom.velocity), std::abs(state.top.velocity)) * f.dt;
      drift[Dim - 1] += moved * f.inverse_cell[Dim - 1] + (before - stretch()) / before;
    }
  }

  // ------------------------------------------------------------------------------------------------ tractions

  // Grid functions averaged over the face element of a point: as wide as the particle along the face, flat across it.
  // Then the nodal forces of a traction balance those of an equal stress node by node (divergence theorem), also at
  // nodes that the body hardly touches.
  PointStencil<Dim> face_stencil(const BodyData& body, const double* d, const Vec<Dim>& offset,
                                 const Frame<Dim>& f) const {
    PointStencil<Dim> s;
    for (int a = 0; a < Dim; ++a) {
      double x = d[(C::x + a) * kBlock];
      for (int b = 0; b < Dim; ++b) x += d[(C::F + a * Dim + b) * kBlock] * offset[b];
      const double xi = (x - f.origin[a]) * f.inverse_cell[a];
      s.node[a] = static_cast<int>(std::lround(xi));
      const double width = (0.5 * body.spacing[a] - std::abs(offset[a])) * std::abs(d[(C::F + a * Dim + a) * kBlock]) *
                           f.inverse_cell[a];
      double from_node = xi - s.node[a];
      if (std::abs(from_node) < 1e-9) from_node = 0;  // a face on a grid line acts on that line alone
      if (width > 1e-3) {
        s.axis[a] = gimp(from_node, std::min(width, 0.5));
      } else {
        s.axis[a].w = {std::max(-from_node, 0.0), 1 - std::abs(from_node), std::max(from_node, 0.0)};
      }
    }
    return s;
  }

  template <class Visit>  // visit(record, traction, weight times area at formation)
  void each_traction(const Frame<Dim>& f, Visit visit) const {
    if (!has_tractions) return;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const auto& body = bodies[b];
      for (std::size_t k = 0; k < body.faces.size(); ++k) {
        const double* t = tractions.data() + (b * kMaxFaces + k) * Dim;
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
          const auto s = face_stencil(body, body.data.data() + face.where[i], offset, f);
          each_node(windows[b].field, s, [&](std::size_t record, double w) {
            if (w > 0) visit(record * kRecord, t, w * size);
          });
        }
      }
    }
  }

  void apply_tractions(const Frame<Dim>& f) {
    each_traction(f, [&](std::size_t node, const double* t, double area) {
      for (int a = 0; a < Dim; ++a) nodes[node + 1 + Dim + a] += t[a] * area;
    });
  }

  // Their work on the displacements of the step.
  void book_tractions(const Frame<Dim>& f) {
    each_traction(f, [&](std::size_t node, const double* t, double area) {
      if (!(nodes[node + 7] > 0)) return;
      for (int a = 0; a < Dim; ++a) {
        state.energies.external_work += f.dt * t[a] * area * nodes[node + a];
      }
    });
  }

  // ------------------------------------------------------------------------------------------------ springs

  void set_springs(const std::vector<Spring<Dim>>& given) {
    for (std::size_t i = 0; i < given.size(); ++i) {
      const auto& s = given[i];
      for (const auto* end : {&s.a, &s.b}) {
        if (end->body < 0 || end->body >= static_cast<int>(bodies.size()))
          throw InputError(fmt::format("spring {}: no body {}; there are {}", i, end->body, bodies.size()));
        const auto particles = bodies[end->body].where.size();
        if (end->particle < 0 || end->particle >= static_cast<int>(particles)) {
          throw InputError(fmt::format("spring {}: no particle {} in body {}, which has {}", i, end->particle,
                                       end->body, particles));
        }
      }
      if (!(std::abs(s.normal.norm() - 1) < 1e-6))
        throw InputError(fmt::format("spring {}: its normal has length {}; it must be 1", i, s.normal.norm()));
      if (!(s.area >= 0 && s.stiffness_t >= 0 && s.stiffness_n >= 0)) {
        throw InputError(fmt::format("spring {}: area {}, stiffnesses {} and {}; none may be negative", i, s.area,
                                     s.stiffness_t, s.stiffness_n));
      }
    }
    springs.clear();
    for (const auto& s : given) springs.push_back({s, Vec<Dim>::Zero()});
  }

  static Vec<Dim> spring_traction(const SpringData& s) {  // MPa, on body a
    const double opening = s.jump.dot(s.spring.normal);
    return s.spring.stiffness_t * s.jump + (s.spring.stiffness_n - s.spring.stiffness_t) * opening * s.spring.normal;
  }

  // Nodes that a spring's end hangs on: grid functions at the point itself. A sheared particle's corner may lie outside
  // the upright domain that its mass is spread over, perhaps by a node of no mass: the end stays within that domain.
  template <class Visit>  // visit(record, weight)
  void each_spring_node(const typename Spring<Dim>::End& end, const Frame<Dim>& f, Visit visit) const {
    const double* d = bodies[end.body].data.data() + bodies[end.body].where[end.particle];
    std::array<int, Dim> node;
    std::array<double, Dim> part;
    for (int a = 0; a < Dim; ++a) {
      double ride = 0;
      for (int b = 0; b < Dim; ++b) ride += d[(C::F + a * Dim + b) * kBlock] * end.offset[b];
      const double reach = 0.5 * bodies[end.body].spacing[a] * std::abs(d[(C::F + a * Dim + a) * kBlock]);
      const double x = d[(C::x + a) * kBlock] + std::clamp(ride, -reach, reach);
      const double xi = (x - f.origin[a]) * f.inverse_cell[a];
      node[a] = static_cast<int>(std::floor(xi));
      part[a] = xi - node[a];
      if (part[a] > 1 - 1e-9) {  // a point on a grid line acts on that line alone
        ++node[a];
        part[a] = 0;
      } else if (part[a] < 1e-9) {
        part[a] = 0;
      }
    }
    const WindowStore& w = windows[end.body].field;
    for (int q = 0; q < (1 << Dim); ++q) {
      double weight = 1;
      for (int a = 0; a < Dim; ++a) weight *= (q >> a) & 1 ? part[a] : 1 - part[a];
      if (!(weight > 0)) continue;
      const int column = node[0] + (q & 1) - w.window.first[0];
      const int across = Dim == 2 ? 0 : node[Dim - 2] + ((q >> (Dim - 2)) & 1) - w.window.first[1];
      const int row = node[Dim - 1] + ((q >> (Dim - 1)) & 1);
      visit(static_cast<std::size_t>(w.base[across * w.window.count[0] + column] + row) * kRecord, weight);
    }
  }

  void apply_springs(const Frame<Dim>& f) {
    for (const auto& s : springs) {
      const Vec<Dim> on_a = s.spring.area * spring_traction(s);
      const auto pull = [&](const auto& end, double sign) {
        each_spring_node(end, f, [&](std::size_t node, double w) {
          for (int a = 0; a < Dim; ++a) nodes[node + 1 + Dim + a] += sign * w * on_a[a];
        });
      };
      pull(s.spring.a, 1);
      pull(s.spring.b, -1);
    }
  }

  // By the grid's displacements, to which their forces are conjugate.
  void stretch_springs(const Frame<Dim>& f) {
    for (auto& s : springs) {
      const auto move = [&](const auto& end, double sign) {
        each_spring_node(end, f, [&](std::size_t node, double w) {
          for (int a = 0; a < Dim; ++a) s.jump[a] += sign * w * f.dt * nodes[node + a];
        });
      };
      move(s.spring.b, 1);
      move(s.spring.a, -1);
    }
  }

  double spring_energy() const {
    double sum = 0;
    for (const auto& s : springs) sum += 0.5 * s.spring.area * spring_traction(s).dot(s.jump);
    return sum;
  }

  void scale_velocities(double factor) {
    for (auto& body : bodies) {
      const std::size_t size = static_cast<std::size_t>(C::count(body.components)) * kBlock;
      for (std::size_t block = 0; block < body.data.size(); block += size) {
        double* v = body.data.data() + block + C::v * kBlock;
        for (int i = 0; i < Dim * kBlock; ++i) v[i] *= factor;
      }
    }
  }

  // ------------------------------------------------------------------------------------------------ velocity filter

  PointStencil<Dim> stencil_at(const BodyData& body, const double* d, const Vec<Dim>& x, const Frame<Dim>& f) const {
    PointStencil<Dim> s;
    for (int a = 0; a < Dim; ++a) {
      const double xi = (x[a] - f.origin[a]) * f.inverse_cell[a];
      s.node[a] = static_cast<int>(std::lround(xi));
      const double r =
          std::clamp(0.5 * body.spacing[a] * std::abs(d[(C::F + a * Dim + a) * kBlock]) * f.inverse_cell[a], 1e-3, 0.5);
      s.axis[a] = gimp(xi - s.node[a], r);
    }
    return s;
  }

  template <class Visit>  // visit(record, weight)
  void each_node(const WindowStore& w, const PointStencil<Dim>& s, Visit visit) const {
    for (int q = 0; q < (Dim == 2 ? 3 : 9); ++q) {
      const int i = q % 3, k = q / 3;
      const int column = s.node[0] - 1 + i - w.window.first[0];
      const int across = Dim == 2 ? 0 : s.node[Dim - 2] - 1 + k - w.window.first[1];
      const double weight = s.axis[0].w[i] * (Dim == 2 ? 1.0 : s.axis[Dim - 2].w[k]);
      if (weight == 0) continue;  // the window may end here
      const int base = w.base[across * w.window.count[0] + column] + s.node[Dim - 1] - 1;
      for (int j = 0; j < 3; ++j) visit(static_cast<std::size_t>(base + j), weight * s.axis[Dim - 1].w[j]);
    }
  }

  // XPIC(2), Hammerquist & Nairn (2017): particle velocities become S (2 v - P S v), where S interpolates from the
  // grid, P projects to it and v is the grid's new velocity. Removes the part of the particle velocities that the grid
  // does not see; linear momentum is untouched. The kinetic energy it takes is booked under Energies::filter.
  void filter(const Frame<Dim>& f) {
    filtered.resize(nodes.size() / kRecord * Dim);
    const double before = kinetic();
    // Positions have moved since the weights were made; the pass uses the new ones for both directions.
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      auto& body = bodies[b];
      const double mass = body.particle_mass();
      std::vector<double> mass_at(windows[b].field.records, 0.0);
      const int start = windows[b].field.window.base[0] + windows[b].field.lo[0];
      each_particle(body, [&](int, const Vec<Dim>& x, const double* d) {
        const auto s = stencil_at(body, d, x, f);
        Vec<Dim> v = Vec<Dim>::Zero();
        each_node(windows[b].field, s, [&](std::size_t record, double w) {
          for (int a = 0; a < Dim; ++a) v[a] += w * nodes[record * kRecord + a];
        });
        each_node(windows[b].field, s, [&](std::size_t record, double w) {
          for (int a = 0; a < Dim; ++a) filtered[record * Dim + a] += w * mass * v[a];
          mass_at[record - static_cast<std::size_t>(start)] += w * mass;
        });
      });
      fold_filtered(b, f, mass_at, start);
      each_particle(body, [&](int p, const Vec<Dim>& x, const double* d) {
        const auto s = stencil_at(body, d, x, f);
        Vec<Dim> v = Vec<Dim>::Zero();
        each_node(windows[b].field, s, [&](std::size_t record, double w) {
          for (int a = 0; a < Dim; ++a) v[a] += w * (2 * nodes[record * kRecord + a] - filtered[record * Dim + a]);
        });
        double* out = body.data.data() + body.where[p];
        for (int a = 0; a < Dim; ++a) out[(C::v + a) * kBlock] = v[a];
      });
    }
    state.energies.filter += before - kinetic();
  }

  // Momentum of the second projection to velocity, with the rollers' mirror images.
  void fold_filtered(std::size_t b, const Frame<Dim>& f, std::vector<double>& mass_at, int start) {
    const WindowStore& w = windows[b].field;
    each_ghost(w, f, false, [&](int axis, int, int ghost, int mirror, int count) {
      for (int i = 0; i < count; ++i) {
        for (int a = 0; a < Dim; ++a) {
          const double g = filtered[static_cast<std::size_t>(ghost + i) * Dim + a];
          filtered[static_cast<std::size_t>(mirror + i) * Dim + a] += a == axis ? -g : g;
        }
        mass_at[mirror + i - start] += mass_at[ghost + i - start];
      }
    });
    for (int r = start; r < start + w.records; ++r) {
      for (int a = 0; a < Dim; ++a) {
        double& p = filtered[static_cast<std::size_t>(r) * Dim + a];
        p = mass_at[r - start] > 0 ? p / mass_at[r - start] : 0;
      }
    }
    each_wall(w, f, [&](int axis, int, int first, int count) {
      for (int r = first; r < first + count; ++r) filtered[static_cast<std::size_t>(r) * Dim + axis] = 0;
    });
    each_ghost(w, f, true, [&](int axis, int, int ghost, int mirror, int count) {
      for (int i = 0; i < count; ++i) {
        for (int a = 0; a < Dim; ++a) {
          const double m = filtered[static_cast<std::size_t>(mirror + i) * Dim + a];
          filtered[static_cast<std::size_t>(ghost + i) * Dim + a] = a == axis ? -m : m;
        }
      }
    });
  }

  // ------------------------------------------------------------------------------------------------ what it holds

  // Mean number of fields at nodes that carry mass.
  double fields_per_node() const {
    double all = 0, occupied = 0;
    for (const auto& pencil : table.pencils) {
      for (int row = pencil.row_lo; row < pencil.row_hi; ++row) {
        int fields = 0;
        for (int k = pencil.field_begin; k < pencil.field_end; ++k) {
          const auto& field = table.fields[k];
          if (row >= field.row_lo && row < field.row_hi)
            fields += nodes[static_cast<std::size_t>(field.base + row) * kRecord + 7] > 0;
        }
        all += fields;
        occupied += fields > 0;
      }
    }
    return occupied > 0 ? all / occupied : 0;
  }

  double kinetic() const {
    double total = 0;
    for (const auto& body : bodies) {
      double sum = 0;
      each_particle(body, [&](int, const Vec<Dim>&, const double* d) {
        for (int a = 0; a < Dim; ++a) sum += d[(C::v + a) * kBlock] * d[(C::v + a) * kBlock];
      });
      total += 0.5 * body.particle_mass() * sum;
    }
    return total;
  }

  template <int N>
  static double stored(const wood::YieldModes<N>& m, const double* stress) {
    double sum = 0;
    for (int i = 0; i < N; ++i) {
      double z = 0;
      for (int j = 0; j < N; ++j) z += m.to_modes[i][j] * stress[j * kBlock];
      sum += 0.5 * z * z;
    }
    return sum;
  }

  double elastic() const {
    double total = 0;
    for (const auto& body : bodies) {
      double sum = 0;
      each_particle(body, [&](int, const Vec<Dim>&, const double* d) {
        sum += body.components == 4 ? stored<4>(body.modes4, d + C::stress * kBlock)
                                    : stored<6>(body.modes6, d + C::stress * kBlock);
      });
      total += body.particle_volume() * sum;
    }
    return total;
  }

  template <class Target>  // Body<Dim> or Strand<Dim>
  void write(std::size_t b, Target& target) const {
    const auto& body = bodies[b];
    each_particle(body, [&](int p, const Vec<Dim>& x, const double* d) {
      target.x[p] = x;
      for (int a = 0; a < Dim; ++a) {
        target.v[p][a] = d[(C::v + a) * kBlock];
        for (int k = 0; k < Dim; ++k) target.F[p](a, k) = d[(C::F + a * Dim + k) * kBlock];
      }
      target.stress[p].setZero();
      for (int k = 0; k < body.components; ++k) target.stress[p][wood::kModeToVoigt[k]] = d[(C::stress + k) * kBlock];
      target.plastic[p] = d[C::plastic(body.components) * kBlock];
    });
  }
};

template <int Dim>
Engine<Dim>::Engine(const std::vector<Body<Dim>>& bodies, const Grid<Dim>& grid, const Options& options)
    : impl_(std::make_unique<Impl>(bodies, grid, options)) {}
template <int Dim>
Engine<Dim>::~Engine() = default;
template <int Dim>
Engine<Dim>::Engine(Engine&&) noexcept = default;
template <int Dim>
Engine<Dim>& Engine<Dim>::operator=(Engine&&) noexcept = default;

template <int Dim>
void Engine<Dim>::set_platens(const Platen& bottom, const Platen& top) {
  impl_->state.bottom = bottom;
  impl_->state.top = top;
  impl_->has_platens = true;
  impl_->windows_valid = false;
}
template <int Dim>
void Engine<Dim>::set_platen_velocities(double bottom, double top) {
  impl_->state.bottom.velocity = bottom;
  impl_->state.top.velocity = top;
}
template <int Dim>
void Engine<Dim>::set_gravity(const Vec<Dim>& g) {
  impl_->gravity = g;
}
template <int Dim>
void Engine<Dim>::set_traction(int body, int face, const Vec<Dim>& traction) {
  impl_->set_traction(static_cast<std::size_t>(body), static_cast<std::size_t>(face), traction);
}
template <int Dim>
void Engine<Dim>::set_springs(const std::vector<Spring<Dim>>& springs) {
  impl_->set_springs(springs);
}
template <int Dim>
void Engine<Dim>::scale_velocities(double factor) {
  impl_->scale_velocities(factor);
}
template <int Dim>
void Engine<Dim>::resume(const EngineState& state) {
  impl_->state = state;
  impl_->windows_valid = false;
}
template <int Dim>
void Engine<Dim>::step() {
  impl_->step();
}
template <int Dim>
void Engine<Dim>::impose(double time_step_s, const std::function<Vec<Dim>(const Vec<Dim>&)>& velocity) {
  impl_->impose(time_step_s, velocity);
}
template <int Dim>
const EngineState& Engine<Dim>::state() const {
  return impl_->state;
}
template <int Dim>
Energies Engine<Dim>::energies() const {
  Energies e = impl_->state.energies;
  e.kinetic = impl_->kinetic();
  e.elastic = impl_->elastic();
  return e;
}
template <int Dim>
double Engine<Dim>::spring_energy() const {
  return impl_->spring_energy();
}
template <int Dim>
double Engine<Dim>::mean_motion_energy() const {
  double total = 0;
  for (const auto& body : impl_->bodies) {
    Vec<Dim> p = Vec<Dim>::Zero();
    double n = 0;
    impl_->each_particle(body, [&](int, const Vec<Dim>&, const double* d) {
      for (int a = 0; a < Dim; ++a) p[a] += d[(Component<Dim>::v + a) * kBlock];
      n += 1;
    });
    total += 0.5 * body.particle_mass() * p.squaredNorm() / n;
  }
  return total;
}
template <int Dim>
Vec<Dim> Engine<Dim>::momentum() const {
  Vec<Dim> total = Vec<Dim>::Zero();
  for (const auto& body : impl_->bodies) {
    Vec<Dim> p = Vec<Dim>::Zero();
    impl_->each_particle(body, [&](int, const Vec<Dim>&, const double* d) {
      for (int a = 0; a < Dim; ++a) p[a] += d[(Component<Dim>::v + a) * kBlock];
    });
    total += body.particle_mass() * p;
  }
  return total;
}
template <int Dim>
double Engine<Dim>::mass() const {
  double total = 0;
  for (const auto& body : impl_->bodies) total += body.particle_mass() * static_cast<double>(body.where.size());
  return total;
}
template <int Dim>
double Engine<Dim>::bottom_force() const {
  return impl_->force[0];
}
template <int Dim>
double Engine<Dim>::top_force() const {
  return impl_->force[1];
}
template <int Dim>
Timing Engine<Dim>::timing() const {
  Timing t = impl_->timing;
  const double scale = impl_->timing_ticks > 0 ? impl_->timing_seconds / impl_->timing_ticks : 0;
  for (double* v : {&t.weights, &t.surface, &t.scatter, &t.grid, &t.contact, &t.gather, &t.material}) *v *= scale;
  if (impl_->particle_steps > 0) t.plastic_fraction = impl_->yield_visits / static_cast<double>(impl_->particle_steps);
  t.fields_per_node = impl_->fields_per_node();
  return t;
}
template <int Dim>
long long Engine<Dim>::particle_steps() const {
  return impl_->particle_steps;
}
template <int Dim>
std::size_t Engine<Dim>::particles() const {
  return impl_->particle_count;
}
template <int Dim>
std::size_t Engine<Dim>::stored_nodes() const {
  return impl_->nodes.size() / kRecord;
}
template <int Dim>
std::size_t Engine<Dim>::bytes() const {
  std::size_t total = impl_->nodes.bytes() + impl_->surface.bytes() + impl_->filtered.bytes();
  for (const auto& body : impl_->bodies) {
    total += body.data.bytes() + body.lanes.size() + (body.particle.size() + body.where.size()) * sizeof(int);
    for (const auto& face : body.faces)
      total += face.where.size() * sizeof(int) + face.offset.bytes() + face.area.bytes();
  }
  const auto& t = impl_->table;
  return total + t.fields.size() * sizeof(PencilField) + t.pencils.size() * sizeof(Pencil) +
         t.row_start.size() * sizeof(int) + t.slots.size() * sizeof(RowField);
}
template <int Dim>
void Engine<Dim>::write(std::vector<Body<Dim>>& bodies) const {
  for (std::size_t b = 0; b < bodies.size(); ++b) impl_->write(b, bodies[b]);
}
template <int Dim>
void Engine<Dim>::write(Panel<Dim>& panel) const {
  for (std::size_t b = 0; b < panel.strands.size(); ++b) impl_->write(b, panel.strands[b]);
  panel.time_s = impl_->state.time_s;
  if (impl_->has_platens) {
    panel.bottom_mm = impl_->state.bottom.position;
    panel.top_mm = impl_->state.top.position;
  }
}

template class Engine<2>;
template class Engine<3>;

}  // namespace strandlab::mpm
