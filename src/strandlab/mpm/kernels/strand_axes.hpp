// The axes of the strand: stress from them to the axes of the panel, deformation to them.
#pragma once

#include "strandlab/mpm/kernels/pack.hpp"

namespace strandlab::mpm::STRANDLAB_ISA {
namespace {

// The strand's axes in the current state: along = F a0/|F a0|, thickness perpendicular to it (in 3D: also to the
// material line across), across completes the right-handed axes. F is row-major. axes[k] are the directions 1 = along,
// 2 = across, 3 = thickness.
STRANDLAB_INLINE void strand_axes(const Pack (&F)[4], Pack (&along)[2]) {
  const Pack s = 1.0 / square_root(F[0] * F[0] + F[2] * F[2]);
  along[0] = F[0] * s;
  along[1] = F[2] * s;
}
STRANDLAB_INLINE void strand_axes(const Pack (&F)[9], Pack (&e)[3][3]) {
  const Pack s = 1.0 / square_root(F[0] * F[0] + F[3] * F[3] + F[6] * F[6]);
  for (int a = 0; a < 3; ++a) e[0][a] = F[3 * a] * s;
  // thickness ~ along x (F across); across = thickness x along
  const Pack c[3] = {F[1], F[4], F[7]};
  Pack t[3] = {e[0][1] * c[2] - e[0][2] * c[1], e[0][2] * c[0] - e[0][0] * c[2], e[0][0] * c[1] - e[0][1] * c[0]};
  const Pack u = 1.0 / square_root(t[0] * t[0] + t[1] * t[1] + t[2] * t[2]);
  for (int a = 0; a < 3; ++a) e[2][a] = t[a] * u;
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3, d = (a + 2) % 3;
    e[1][a] = e[2][b] * e[0][d] - e[2][d] * e[0][b];
  }
}

// Kirchhoff stress in panel axes, times volume: (xx, xy, yy) or (xx, yy, zz, yz, xz, xy).
STRANDLAB_INLINE void panel_stress(const Pack (&F)[4], const Pack* tau, double volume, Pack (&s)[3]) {
  Pack a[2];
  strand_axes(F, a);
  const Pack cc = a[0] * a[0], ss = a[1] * a[1], cs = a[0] * a[1];
  const Pack t11 = tau[0] * volume, t33 = tau[2] * volume, t13 = tau[3] * volume;
  s[0] = cc * t11 + ss * t33 - 2.0 * cs * t13;
  s[1] = cs * (t11 - t33) + (cc - ss) * t13;
  s[2] = ss * t11 + cc * t33 + 2.0 * cs * t13;
}
STRANDLAB_INLINE void panel_stress(const Pack (&F)[9], const Pack* tau, double volume, Pack (&s)[6]) {
  Pack e[3][3];
  strand_axes(F, e);
  // tau components: 11, 22, 33, 13, 23, 12
  const Pack T[3][3] = {{tau[0] * volume, tau[5] * volume, tau[3] * volume},
                        {tau[5] * volume, tau[1] * volume, tau[4] * volume},
                        {tau[3] * volume, tau[4] * volume, tau[2] * volume}};
  Pack half[3][3];  // T e
  for (int k = 0; k < 3; ++k) {
    for (int b = 0; b < 3; ++b) half[k][b] = T[k][0] * e[0][b] + T[k][1] * e[1][b] + T[k][2] * e[2][b];
  }
  const auto component = [&](int a, int b) {
    return e[0][a] * half[0][b] + e[1][a] * half[1][b] + e[2][a] * half[2][b];
  };
  s[0] = component(0, 0);
  s[1] = component(1, 1);
  s[2] = component(2, 2);
  s[3] = component(1, 2);
  s[4] = component(0, 2);
  s[5] = component(0, 1);
}

// Rate of deformation times dt in the strand's axes of mid-step: (11, 22, 33, 13, 23, 12), shears engineering.
STRANDLAB_INLINE void strain_increment(const Pack (&A)[4], const Pack (&middle)[4], Pack (&e)[6]) {
  Pack a[2];
  strand_axes(middle, a);
  const Pack cc = a[0] * a[0], ss = a[1] * a[1], cs = a[0] * a[1];
  const Pack shear = A[1] + A[2];
  e[0] = cc * A[0] + ss * A[3] + cs * shear;
  e[2] = ss * A[0] + cc * A[3] - cs * shear;
  e[3] = 2.0 * cs * (A[3] - A[0]) + (cc - ss) * shear;
  e[1] = e[4] = e[5] = Pack{};
}
STRANDLAB_INLINE void strain_increment(const Pack (&A)[9], const Pack (&middle)[9], Pack (&e)[6]) {
  Pack ax[3][3];
  strand_axes(middle, ax);
  Pack half[3][3];  // A e_k
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 3; ++i) half[k][i] = A[3 * i] * ax[k][0] + A[3 * i + 1] * ax[k][1] + A[3 * i + 2] * ax[k][2];
  }
  const auto component = [&](int j, int k) {
    return ax[j][0] * half[k][0] + ax[j][1] * half[k][1] + ax[j][2] * half[k][2];
  };
  e[0] = component(0, 0);
  e[1] = component(1, 1);
  e[2] = component(2, 2);
  e[3] = component(0, 2) + component(2, 0);
  e[4] = component(1, 2) + component(2, 1);
  e[5] = component(0, 1) + component(1, 0);
}

}  // namespace
}  // namespace strandlab::mpm::STRANDLAB_ISA
