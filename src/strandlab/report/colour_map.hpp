// Colour maps that are even to the eye and safe for the colour-blind.
#pragma once

namespace strandlab::report {

struct Colour {
  double red = 0, green = 0, blue = 0;  // 0..1, sRGB
};

// Sequential: light yellow, green, blue, dark violet (viridis, Smith & van der Walt 2015, from its light end). `t` in
// 0..1, values outside take the end colours, NaN a middle grey.
Colour sequential(double t);

// Diverging: dark blue, white at t = 1/2, dark red (RdBu, Brewer 2003, from its blue end). `t` as above.
Colour diverging(double t);

}  // namespace strandlab::report
