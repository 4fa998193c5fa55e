// Rectangles in the plane of a plate, and which of them overlap: on a torus, where each has images, or in the plane.
// The same bits on every machine.
#pragma once

#include <optional>

namespace strandlab::mat {

struct Rectangle {
  double cx = 0, cy = 0;                   // centre, mm
  double half_length = 0, half_width = 0;  // mm
  double cos = 1, sin = 0;                 // of the direction of its length, counter-clockwise from x
};
Rectangle rectangle(double cx_mm, double cy_mm, double length_mm, double width_mm, double angle_deg);

// The window 0..x by 0..y, mm. Periodic: whatever lies in it lies also at all whole numbers of windows from there.
struct Window {
  double x = 0, y = 0;
  bool periodic = true;
};
// Whole numbers of windows along x and y; {0, 0} is the thing itself.
struct Image {
  int i = 0, j = 0;
};

// How far apart (mm) two rectangles are, b moved by (dx, dy): the largest distance between their projections on the
// four directions of their sides (separating axes); negative, the depth of their overlap. Never more than their true
// distance.
double distance_apart(const Rectangle& a, const Rectangle& b, double dx = 0, double dy = 0);

// The first image of b that is less than `clearance` mm apart from a; none where all are further. Images are those
// whose circumscribed circle reaches that of a: their number grows as the square of a size over the window's.
std::optional<Image> image_within(double clearance, const Rectangle& a, const Rectangle& b, const Window& window);
// The same of a rectangle's own images, without itself.
std::optional<Image> own_image_within(double clearance, const Rectangle& a, const Window& window);

}  // namespace strandlab::mat
