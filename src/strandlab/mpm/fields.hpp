// The velocity fields of all bodies: where their nodes are and what these hold.
#pragma once

#include <functional>
#include <vector>

#include "strandlab/mpm/aligned.hpp"
#include "strandlab/mpm/particles.hpp"
#include "strandlab/mpm/patches.hpp"

namespace strandlab::mpm {

inline constexpr double kPatchDrift = 0.5;  // cells a point may move before it leaves its patches

struct Fields {
  std::vector<BodyPatches> patches;  // by body
  PencilTable table;
  AlignedArray nodes, surface;  // records of the fields and of the bodies' faces: see kernels.hpp
};

// Throws RunError for a particle whose faces lie so far from its middle that it is no part of a strand any more.
template <int Dim>
void check_stretch(const std::vector<Particles<Dim>>& bodies, const EngineState& state);

// Nodes that may become a point's nearest before the patches are laid again: first and last, as {lateral axes, row}.
template <int Dim>
std::array<std::array<int, 3>, 2> nearest_nodes(const Vec<Dim>& x, const Step<Dim>& step);

// Patches around the particles, their mirror images in the platens and the face points where these are now; all records
// become zero. `periods` as for tabulate(). Throws RunError where a face point is further from its particle than any
// wood bears.
template <int Dim>
void lay_patches(const std::vector<Particles<Dim>>& bodies, const Step<Dim>& step, const std::array<int, 2>& periods,
                 const EngineState& state, Fields& fields);

// What the kernels see of each body; valid until the patches are laid again.
template <int Dim>
std::vector<BodyView<Dim>> views_of(std::vector<Particles<Dim>>& bodies, Fields& fields);

// In place of the grid update: all nodes take their velocity (mm/s at a point in mm) from outside.
template <int Dim>
void impose_velocity(const Step<Dim>& step, const std::function<Vec<Dim>(const Vec<Dim>&)>& velocity, Fields& fields);

// Calls visit(record) for all nodes of the bodies, their mirror images in platens left out.
template <class Visit>
void each_body_node(const Fields& fields, Visit visit) {
  for (const auto& body : fields.patches) {
    const PatchStore& w = body.field;
    for (int p = 0; p < w.pencils(); ++p) {
      for (int row = w.lo[p]; row <= w.hi[p]; ++row)
        visit(fields.nodes.data() + static_cast<std::size_t>(w.base[p] + row) * kRecord);
    }
  }
}

// t, on the bodies' nodes after a grid update (mirror images in platens left out).
double grid_mass(const Fields& fields);

// Mean number of fields at nodes that carry mass, after a grid update.
double fields_per_node(const Fields& fields);

std::size_t bytes(const Fields& fields);

}  // namespace strandlab::mpm
