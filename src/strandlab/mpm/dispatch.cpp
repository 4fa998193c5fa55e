// Chooses the build of the kernels: the best one the processor can run, or the one that STRANDLAB_ISA names.
#include "strandlab/mpm/dispatch.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>

#include "strandlab/core/error.hpp"
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

std::vector<std::string> instruction_sets() {
  std::vector<std::string> sets;
#ifdef STRANDLAB_X86_BUILDS
  if (has_avx512()) sets.emplace_back("avx512");
  if (has_avx2()) sets.emplace_back("avx2");
#endif
  sets.emplace_back("generic");
  return sets;
}

std::string instruction_set() {
  const auto sets = instruction_sets();
  const char* asked = std::getenv(kInstructionSetVariable);
  if (asked == nullptr || *asked == '\0') return sets.front();
  if (std::find(sets.begin(), sets.end(), asked) == sets.end()) {
    throw InputError(
        fmt::format("{} is \"{}\"; this machine has {}", kInstructionSetVariable, asked, fmt::join(sets, ", ")));
  }
  return asked;
}

template <int Dim>
const Kernels<Dim>& kernels() {
  [[maybe_unused]] const auto set = instruction_set();
#ifdef STRANDLAB_X86_BUILDS
  if (set == "avx512") return avx512::build<Dim>();
  if (set == "avx2") return avx2::build<Dim>();
#endif
  return generic::build<Dim>();
}
template const Kernels<2>& kernels<2>();
template const Kernels<3>& kernels<3>();

}  // namespace strandlab::mpm
