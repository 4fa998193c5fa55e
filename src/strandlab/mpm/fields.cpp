#include "strandlab/mpm/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "strandlab/mpm/checks.hpp"

namespace strandlab::mpm {

template <int Dim>
std::array<std::array<int, 3>, 2> nearest_nodes(const Vec<Dim>& x, const Step<Dim>& step) {
  std::array<std::array<int, 3>, 2> range{};
  for (int a = 0; a < Dim; ++a) {
    const double xi = (x[a] - step.origin[a]) * step.inverse_cell[a];
    const int axis = a == Dim - 1 ? 2 : a;  // rows last, lateral axes first
    range[0][axis] = static_cast<int>(std::lround(xi - kPatchDrift));
    range[1][axis] = static_cast<int>(std::lround(xi + kPatchDrift));
  }
  return range;
}
template std::array<std::array<int, 3>, 2> nearest_nodes(const Vec<2>&, const Step<2>&);
template std::array<std::array<int, 3>, 2> nearest_nodes(const Vec<3>&, const Step<3>&);

namespace {

constexpr double kMaxStretch = 20;  // of a particle; far beyond what wood bears

template <int Dim>
Extents extents_of(const std::vector<Vec<Dim>>& points, const Step<Dim>& step) {
  auto [first3, last3] = nearest_nodes<Dim>(points[0], step);
  for (const auto& x : points) {
    const auto range = nearest_nodes<Dim>(x, step);
    for (int a = 0; a < 2; ++a) {
      first3[a] = std::min(first3[a], range[0][a]);
      last3[a] = std::max(last3[a], range[1][a]);
    }
  }
  const std::array<int, 2> first{first3[0], first3[1]}, last{last3[0], last3[1]};
  Extents extents(first, last);  // in 3D never flat across: from and to differ
  for (const auto& x : points) {
    const auto [from, to] = nearest_nodes<Dim>(x, step);
    for (int j = from[1]; j <= to[1]; ++j) {
      for (int i = from[0]; i <= to[0]; ++i) {
        extents.add({i, j}, from[2]);
        extents.add({i, j}, to[2]);
      }
    }
  }
  extents.dilate();
  return extents;
}

// A ghost pencil and its mirror image hold the same rows.
template <int Dim>
void match_ghosts(const Step<Dim>& step, Extents& extents) {
  for (int a = 0; a < Dim - 1; ++a) {
    for (int side = 0; side < 2; ++side) {
      if (step.wall[a][side] == kNoWall) continue;
      const int other = 1 - a;
      for (int k = extents.first[other]; k < extents.first[other] + extents.count[other]; ++k) {
        std::array<int, 2> ghost{}, mirror{};
        ghost[a] = step.wall[a][side] + (side == 0 ? -1 : 1);
        mirror[a] = step.wall[a][side] + (side == 0 ? 1 : -1);
        ghost[other] = mirror[other] = k;
        extents.merge(ghost, mirror);
      }
    }
  }
}

// `records` of the array are taken; those of the patch are added.
template <int Dim>
PatchStore patch_over(const std::vector<Vec<Dim>>& points, const Step<Dim>& step, int& records) {
  Extents extents = extents_of(points, step);
  match_ghosts(step, extents);
  PatchStore store;
  store.place(extents, records);
  records += store.records;
  return store;
}

// Mirror images in platen k of the points close to it: within kMirrorDepth, or so before the patches are made again.
template <int Dim>
std::vector<Vec<Dim>> images_of(const std::vector<Vec<Dim>>& points, const Step<Dim>& step, int k) {
  const double wall = step.platen[k].position;
  std::vector<Vec<Dim>> images;
  for (Vec<Dim> x : points) {
    if (std::abs(x[Dim - 1] - wall) > (kMirrorDepth + 1) * step.cell[Dim - 1]) continue;
    x[Dim - 1] = 2 * wall - x[Dim - 1];
    images.push_back(x);
  }
  return images;
}

template <int Dim>
std::vector<Vec<Dim>> points_of(const typename Particles<Dim>::FacePoints& face, const Particles<Dim>& body,
                                const EngineState& state) {
  using C = Component<Dim>;
  std::vector<Vec<Dim>> points;
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
    if ((x - body.position(d)).norm() <= kMaxStretch * body.reach.norm()) continue;
    throw RunError(fmt::format("{}: a particle of {} at ({}) is stretched out of all proportion", moment(state),
                               body.name, text<Dim>(body.position(d))));
  }
  return points;
}

}  // namespace

template <int Dim>
void check_stretch(const std::vector<Particles<Dim>>& bodies, const EngineState& state) {
  for (const auto& body : bodies) {
    for (const auto& face : body.faces) static_cast<void>(points_of<Dim>(face, body, state));
  }
}

template <int Dim>
void lay_patches(const std::vector<Particles<Dim>>& bodies, const Step<Dim>& step, const std::array<int, 2>& periods,
                 const EngineState& state, Fields& fields) {
  fields.patches.assign(bodies.size(), {});
  int node_records = 0, surface_records = 0;
  std::vector<Vec<Dim>> points;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const auto& body = bodies[b];
    BodyPatches& w = fields.patches[b];
    points.clear();
    body.each([&](int, const Vec<Dim>& x, const double*) { points.push_back(x); });
    w.field = patch_over(points, step, node_records);
    for (int k = 0; k < 2 && step.platen[k].present; ++k) {
      const auto images = images_of(points, step, k);
      if (!images.empty()) w.mirrors[k] = patch_over(images, step, node_records);
    }
    for (const auto& face : body.faces)
      w.faces.push_back(patch_over(points_of<Dim>(face, body, state), step, surface_records));
  }
  fields.nodes.resize(static_cast<std::size_t>(node_records) * kRecord);
  fields.surface.resize(static_cast<std::size_t>(surface_records) * kSurfaceRecord<Dim>);
  std::array<std::array<int, 2>, 2> walls{{{kNoWall, kNoWall}, {kNoWall, kNoWall}}};
  for (int a = 0; a < Dim - 1; ++a) walls[a] = {step.wall[a][0], step.wall[a][1]};
  fields.table = tabulate(fields.patches, walls, periods);
}

template <int Dim>
std::vector<BodyView<Dim>> views_of(std::vector<Particles<Dim>>& bodies, Fields& fields) {
  const auto placed = [](PatchStore& w) {
    w.patch.base = w.base.data();
    return w.patch;
  };
  std::vector<BodyView<Dim>> views;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    auto& body = bodies[b];
    BodyPatches& w = fields.patches[b];
    BodyView<Dim> v = view_of_wood(body);
    v.mass = body.mass();
    v.volume = body.volume();
    for (int a = 0; a < Dim; ++a) {
      v.half_size[a] = 0.5 * body.spacing[a];
      v.reach[a] = body.reach[a];
    }
    v.patch = placed(w.field);
    for (int k = 0; k < 2; ++k) v.mirror[k] = placed(w.mirrors[k]);
    v.faces = static_cast<int>(body.faces.size());
    for (int f = 0; f < v.faces; ++f) {
      const auto& face = body.faces[f];
      v.face[f] = {placed(w.faces[f]), face.where.data(), face.offset.data(), face.area.data()};
    }
    views.push_back(v);
  }
  return views;
}

template <int Dim>
void impose_velocity(const Step<Dim>& step, const std::function<Vec<Dim>(const Vec<Dim>&)>& velocity, Fields& fields) {
  for (const auto& body : fields.patches) {
    const PatchStore& w = body.field;
    for (int p = 0; p < w.pencils(); ++p) {
      Vec<Dim> x;
      for (int a = 0; a < Dim - 1; ++a) {
        const int along = a == 0 ? p % w.patch.count[0] : p / w.patch.count[0];
        x[a] = step.origin[a] + (w.patch.first[a] + along) * step.cell[a];
      }
      for (int row = w.lo[p]; row <= w.hi[p]; ++row) {
        double* r = fields.nodes.data() + static_cast<std::size_t>(w.base[p] + row) * kRecord;
        const double mass = r[0];
        x[Dim - 1] = step.origin[Dim - 1] + row * step.cell[Dim - 1];
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
}

double grid_mass(const Fields& fields) {
  double sum = 0;
  each_body_node(fields, [&](const double* record) { sum += record[7]; });  // 0 behind rollers
  return sum;
}

double fields_per_node(const Fields& fields) {
  double all = 0, occupied = 0;
  for (const auto& pencil : fields.table.pencils) {
    for (int row = pencil.row_lo; row < pencil.row_hi; ++row) {
      int here = 0;
      for (int k = pencil.field_begin; k < pencil.field_end; ++k) {
        const auto& field = fields.table.fields[k];
        if (row >= field.row_lo && row < field.row_hi)
          here += fields.nodes[static_cast<std::size_t>(field.base + row) * kRecord + 7] > 0;
      }
      all += here;
      occupied += here > 0;
    }
  }
  return occupied > 0 ? all / occupied : 0;
}

std::size_t bytes(const Fields& fields) {
  const auto& t = fields.table;
  return fields.nodes.bytes() + fields.surface.bytes() + t.fields.size() * sizeof(PencilField) +
         t.pencils.size() * sizeof(Pencil) + t.row_start.size() * sizeof(int) + t.slots.size() * sizeof(RowField);
}

template void check_stretch(const std::vector<Particles<2>>&, const EngineState&);
template void check_stretch(const std::vector<Particles<3>>&, const EngineState&);
template void lay_patches(const std::vector<Particles<2>>&, const Step<2>&, const std::array<int, 2>&,
                          const EngineState&, Fields&);
template void lay_patches(const std::vector<Particles<3>>&, const Step<3>&, const std::array<int, 2>&,
                          const EngineState&, Fields&);
template std::vector<BodyView<2>> views_of(std::vector<Particles<2>>&, Fields&);
template std::vector<BodyView<3>> views_of(std::vector<Particles<3>>&, Fields&);
template void impose_velocity(const Step<2>&, const std::function<Vec<2>(const Vec<2>&)>&, Fields&);
template void impose_velocity(const Step<3>&, const std::function<Vec<3>(const Vec<3>&)>&, Fields&);

}  // namespace strandlab::mpm
