#include "strandlab/mpm/gravity.hpp"

namespace strandlab::mpm {
namespace {

// Adds the weight of a patch's nodes. Behind a roller it is that of the mirror image, which rollers fold back.
template <int Dim>
void add_weight(const PatchStore& w, const Step<Dim>& step, const Vec<Dim>& g, AlignedArray& nodes) {
  for (int p = 0; p < w.pencils(); ++p) {
    Vec<Dim> here = g;
    for (int a = 0; a < Dim - 1; ++a) {
      const int index = w.patch.first[a] + (a == 0 ? p % w.patch.count[0] : p / w.patch.count[0]);
      const bool below = step.wall[a][0] != kNoWall && index < step.wall[a][0];
      const bool above = step.wall[a][1] != kNoWall && index > step.wall[a][1];
      if (below || above) here[a] = -g[a];
    }
    for (int row = w.lo[p]; row <= w.hi[p]; ++row) {
      double* record = nodes.data() + static_cast<std::size_t>(w.base[p] + row) * kRecord;
      for (int a = 0; a < Dim; ++a) record[1 + Dim + a] += record[0] * here[a];
    }
  }
}

}  // namespace

template <int Dim>
void Gravity<Dim>::apply(const std::vector<Particles<Dim>>& /*bodies*/, const Step<Dim>& step, Fields& fields) const {
  if (g_.isZero(0)) return;
  Vec<Dim> mirrored = g_;  // what a body's image in a platen feels
  mirrored[Dim - 1] = -g_[Dim - 1];
  for (const auto& body : fields.patches) {
    add_weight<Dim>(body.field, step, g_, fields.nodes);
    for (const auto& image : body.mirrors) add_weight<Dim>(image, step, mirrored, fields.nodes);
  }
}

template <int Dim>
void Gravity<Dim>::book(const std::vector<Particles<Dim>>& /*bodies*/, const Step<Dim>& step, const Fields& fields,
                        double& work) {
  if (g_.isZero(0)) return;
  each_body_node(fields, [&](const double* record) {
    for (int a = 0; a < Dim; ++a) work += step.dt * record[7] * g_[a] * record[a];
  });
}

template class Gravity<2>;
template class Gravity<3>;

}  // namespace strandlab::mpm
