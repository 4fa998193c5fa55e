// What the engine is given of a line of glue.
#pragma once

#include "strandlab/core/types.hpp"

namespace strandlab::mpm {

// A line of glue as springs: one between a point of body a and a point of body b, each of which rides on a particle p
// at x_p + F_p offset. With [u] = u_b - u_a since the springs were set, body a is pulled by
// area (stiffness_n [u_n] + stiffness_t [u_t]) and body b by its opposite.
template <int Dim>
struct Spring {
  struct End {
    int body = 0, particle = 0;
    Vec<Dim> offset = Vec<Dim>::Zero();  // mm, at formation
  };
  End a, b;
  Vec<Dim> normal;                          // unit
  double area = 0;                          // mm (2D, per mm depth) or mm^2
  double stiffness_t = 0, stiffness_n = 0;  // MPa/mm
};

}  // namespace strandlab::mpm
