// Stress of eight particles: elastic trial stress and return map with the law of the body.
#pragma once

#include "strandlab/mpm/kernels.hpp"
#include "strandlab/mpm/kernels/pack.hpp"

namespace strandlab::mpm::STRANDLAB_ISA {
namespace {

// Elastic trial stress and plastic correction; returns the dissipation per reference volume and adds dtau : d eps.
template <class L, int N, class Condition>
STRANDLAB_INLINE Pack update_stress(const wood::YieldModes<N>& modes, const Condition& condition,
                                    const Pack (&strain)[6], const Pack& J, double* block, int stress, int plastic,
                                    Pack& stress_change, long long& yielding, Mask& finite) {
  Pack tau[N];
  Pack size{};
  for (int i = 0; i < N; ++i) {
    tau[i] = load(block + (stress + i) * kBlock);
    for (int j = 0; j < N; ++j) {
      if constexpr (Condition::kConditioned) {
        tau[i] += modes.stiffness[i][j] * (condition.e * strain[j]);
      } else {
        tau[i] += modes.stiffness[i][j] * strain[j];
      }
    }
    size += absolute(tau[i]);
  }
  finite = (size < kLargestStress) & (J > 1e-6);
  Pack history = load(block + plastic * kBlock), radius = load(block + (plastic + 1) * kBlock);
  const Pack dissipation = wood::return_map<L, PackOps, N>(modes, tau, J, history, radius, condition);
  const Mask flowing = dissipation > 0.0;
  if (any(flowing)) {
    store(block + plastic * kBlock, history);
    store(block + (plastic + 1) * kBlock, radius);
    for (int l = 0; l < kBlock; ++l) yielding -= flowing[l];
  }
  stress_change = Pack{};
  for (int i = 0; i < N; ++i) {
    stress_change += (tau[i] - load(block + (stress + i) * kBlock)) * strain[i];
    store(block + (stress + i) * kBlock, tau[i]);
  }
  return dissipation;
}

// The same with the body's law and stress components.
template <int Dim, class Condition>
STRANDLAB_INLINE Pack update_stress(const BodyView<Dim>& body, const Condition& condition, const Pack (&strain)[6],
                                    const Pack& J, double* block, Pack& stress_change, long long& yielding,
                                    Mask& finite) {
  using C = Component<Dim>;
  return wood::with_law(
      body.law, [&]<class L>() __attribute__((always_inline)) {
        const auto update = [&]<int N>(const wood::YieldModes<N>& modes) __attribute__((always_inline)) {
          return update_stress<L, N>(modes, condition, strain, J, block, C::stress, C::plastic(N), stress_change,
                                     yielding, finite);
        };
        return body.components == 4 ? update(*body.modes4) : update(*body.modes6);
      });
}

// The same with its condition. Not inlined: the loop over wood as measured stays small.
template <int Dim>
[[gnu::noinline]] Pack update_conditioned(const BodyView<Dim>& body, const Step<Dim>& step, int b,
                                          const Pack (&strain)[6], const Pack& J, double* block, Pack& stress_change,
                                          long long& yielding, Mask& finite) {
  const double* factors = body.condition + 2 * static_cast<long>(b) * kBlock;
  if (step.rate.exponent == 0 && !any((load(factors) != 1.0) | (load(factors + kBlock) != 1.0))) {
    return update_stress<Dim>(body, wood::AsMeasured<Pack>{}, strain, J, block, stress_change, yielding, finite);
  }
  Pack size{};
  for (const auto& s : strain) size = larger(size, absolute(s));
  const wood::Conditioned<Pack> condition{load(factors),   load(factors + kBlock), size,     step.rate.exponent,
                                          step.rate.floor, step.rate.least,        body.Y_R, step.rate.per_strain};
  return update_stress<Dim>(body, condition, strain, J, block, stress_change, yielding, finite);
}

template <int Dim>
void set_radius(const BodyView<Dim>& body, int blocks) {
  using C = Component<Dim>;
  const auto& laws = body.components == 4 ? body.modes4->laws : body.modes6->laws;
  for (int b = 0; b < blocks; ++b) {
    double* plastic =
        body.blocks + (static_cast<long>(b) * C::count(body.components) + C::plastic(body.components)) * kBlock;
    wood::with_law(
        body.law, [&]<class L>() __attribute__((always_inline)) {
          store(plastic + kBlock, L::template radius<PackOps>(wood::part_of<L>(laws), load(plastic)));
        });
  }
}

}  // namespace
}  // namespace strandlab::mpm::STRANDLAB_ISA
