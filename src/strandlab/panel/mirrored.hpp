// A panel with its mirror image: the whole of which only the upper half was pressed.
#pragma once

#include "strandlab/panel/panel.hpp"

namespace strandlab {

// The half panel and below it its image in the plane of its bottom platen, z -> -z: strands keep their angles, F
// becomes M F M with M = diag(1, 1, -1), and lattices count upwards again. Rows of the image come first, from its
// bottom up.
Panel<3> with_mirror_image(const Panel<3>& upper);

}  // namespace strandlab
