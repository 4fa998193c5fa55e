// The kernels of one build: see kernels.hpp. Compiled once per instruction set with STRANDLAB_ISA naming the build.
#include "strandlab/mpm/kernels.hpp"

#include "strandlab/mpm/kernels/gather.hpp"
#include "strandlab/mpm/kernels/grid_update.hpp"
#include "strandlab/mpm/kernels/scatter.hpp"
#include "strandlab/mpm/kernels/stress.hpp"

namespace strandlab::mpm::STRANDLAB_ISA {

template <int Dim>
const Kernels<Dim>& build() {
  static constexpr Kernels<Dim> table{&scatter<Dim>, &update_grid<Dim>, &gather<Dim>, &set_radius<Dim>};
  return table;
}
template const Kernels<2>& build<2>();
template const Kernels<3>& build<3>();

}  // namespace strandlab::mpm::STRANDLAB_ISA
