#include "strandlab/mpm/rollers.hpp"

namespace strandlab::mpm {
namespace {

template <int Dim>
void fold_nodes(const PatchStore& w, const Step<Dim>& step, AlignedArray& nodes) {
  each_ghost(w, step, false, [&](int axis, int, int ghost, int mirror, int count) {
    for (int i = 0; i < count; ++i) {
      double* g = nodes.data() + static_cast<std::size_t>(ghost + i) * kRecord;
      double* m = nodes.data() + static_cast<std::size_t>(mirror + i) * kRecord;
      for (int k = 0; k < 1 + 2 * Dim; ++k) {
        const bool odd = k == 1 + axis || k == 1 + Dim + axis;
        m[k] += odd ? -g[k] : g[k];
      }
    }
  });
}

template <int Dim>
void fold_face(const PatchStore& w, const Step<Dim>& step, AlignedArray& surface) {
  each_ghost(w, step, false, [&](int axis, int side, int ghost, int mirror, int count) {
    const double plane = step.origin[axis] + step.wall[axis][side] * step.cell[axis];
    for (int i = 0; i < count; ++i) {
      double* g = surface.data() + static_cast<std::size_t>(ghost + i) * kSurfaceRecord<Dim>;
      double* m = surface.data() + static_cast<std::size_t>(mirror + i) * kSurfaceRecord<Dim>;
      for (int k = 0; k < Dim; ++k) m[k] += k == axis ? -g[k] : g[k];
      m[Dim] += g[Dim];
      m[Dim + 1] += g[Dim + 1] - 2 * plane * g[axis];  // x.n of the mirrored point
    }
  });
  // On the plane itself a face and its image have no normal component across it; the distance to the face stays.
  each_wall(w, step, [&](int axis, int side, int first, int count) {
    const double plane = step.origin[axis] + step.wall[axis][side] * step.cell[axis];
    for (int i = first; i < first + count; ++i) {
      double* s = surface.data() + static_cast<std::size_t>(i) * kSurfaceRecord<Dim>;
      s[Dim + 1] -= plane * s[axis];
      s[axis] = 0;
    }
  });
}

}  // namespace

template <int Dim>
void fold(const Step<Dim>& step, Fields& fields) {
  for (const auto& body : fields.patches) {
    fold_nodes(body.field, step, fields.nodes);
    for (const auto& image : body.mirrors) fold_nodes(image, step, fields.nodes);
    for (const auto& face : body.faces) fold_face(face, step, fields.surface);
  }
}

template <int Dim>
void unfold(const Step<Dim>& step, Fields& fields) {
  for (const auto& body : fields.patches) {
    each_ghost(body.field, step, true, [&](int axis, int, int ghost, int mirror, int count) {
      for (int i = 0; i < count; ++i) {
        double* g = fields.nodes.data() + static_cast<std::size_t>(ghost + i) * kRecord;
        const double* m = fields.nodes.data() + static_cast<std::size_t>(mirror + i) * kRecord;
        for (int k = 0; k < 2 * Dim; ++k) g[k] = k == axis || k == Dim + axis ? -m[k] : m[k];
      }
    });
  }
}

template void fold(const Step<2>&, Fields&);
template void fold(const Step<3>&, Fields&);
template void unfold(const Step<2>&, Fields&);
template void unfold(const Step<3>&, Fields&);

}  // namespace strandlab::mpm
