// Chooses, once, the build of the kernels that the processor can run.
#include "strandlab/mpm/kernels.hpp"

namespace strandlab::mpm {

#define STRANDLAB_DECLARE_BUILD(isa) \
  namespace isa {                    \
  template <int Dim>                 \
  const Kernels<Dim>& build();       \
  }
STRANDLAB_DECLARE_BUILD(generic)
#ifdef STRANDLAB_X86_BUILDS
STRANDLAB_DECLARE_BUILD(avx2)
STRANDLAB_DECLARE_BUILD(avx512)

namespace {
bool has_avx2() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
}
bool has_avx512() {
  return has_avx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
         __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd");
}
}  // namespace
#endif

template <int Dim>
const Kernels<Dim>& kernels() {
#ifdef STRANDLAB_X86_BUILDS
  if (has_avx512()) return avx512::build<Dim>();
  if (has_avx2()) return avx2::build<Dim>();
#endif
  return generic::build<Dim>();
}
template const Kernels<2>& kernels<2>();
template const Kernels<3>& kernels<3>();

const char* instruction_set() {
#ifdef STRANDLAB_X86_BUILDS
  if (has_avx512()) return "avx512";
  if (has_avx2()) return "avx2";
#endif
  return "generic";
}

}  // namespace strandlab::mpm
