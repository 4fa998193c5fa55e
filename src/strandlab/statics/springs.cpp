#include "strandlab/statics/springs.hpp"

#include <optional>

namespace strandlab::statics {
namespace {

using Row = Eigen::Matrix<double, 8, 1>;

Vec<2> rotated(const Vec<2>& v) {
  return {-v[1], v[0]};
}  // by +90 degrees

// One side of a glue point: its displacement is (1 - xi) u[first] + xi u[second], and the line between the two nodes
// gives the rotation.
struct SidePoint {
  int first, second;
  double xi;
};

// The side of a glue point as a corner of an end plane, if it is (nearly) one: the line runs along the plane.
std::optional<SidePoint> end_corner(const FaceNodes& face, const std::vector<bool>& at_end) {
  constexpr double kNear = 0.1;  // of an element
  if (face.xi < kNear && at_end[face.first]) return SidePoint{face.first, face.first + face.inward, 0};
  if (face.xi > 1 - kNear && at_end[face.second]) return SidePoint{face.second, face.second + face.inward, 0};
  return std::nullopt;
}

Vec<2> position(const Mesh& mesh, const SidePoint& side) {
  return (1 - side.xi) * mesh.nodes[side.first] + side.xi * mesh.nodes[side.second];
}

// Rotation of the line from node 1 to 2: omega = r . (u_2 - u_1)/|d|^2 with d from 1 to 2 and r = d turned by 90
// degrees.
void add_rotation(const Mesh& mesh, const SidePoint& side, int first_dof, double factor, Row& row) {
  const Vec<2> d = mesh.nodes[side.second] - mesh.nodes[side.first];
  const Vec<2> r = factor * rotated(d) / d.squaredNorm();
  row.segment<2>(first_dof) -= r;
  row.segment<2>(first_dof + 2) += r;
}

Spring make_spring(const Mesh& mesh, const SidePoint& a, const SidePoint& b, const Vec<2>& normal, double area) {
  const Vec<2> arm = rotated(position(mesh, b) - position(mesh, a));
  Row rotation = Row::Zero();  // mean of the two sides
  add_rotation(mesh, a, 0, 0.5, rotation);
  add_rotation(mesh, b, 4, 0.5, rotation);
  const auto jump = [&](const Vec<2>& direction) {
    Row row = -arm.dot(direction) * rotation;
    row.segment<2>(0) -= (1 - a.xi) * direction;
    row.segment<2>(2) -= a.xi * direction;
    row.segment<2>(4) += (1 - b.xi) * direction;
    row.segment<2>(6) += b.xi * direction;
    return row;
  };
  Spring spring;
  spring.nodes = {a.first, a.second, b.first, b.second};
  spring.normal = jump(normal);
  spring.tangent = jump(rotated(normal));
  spring.area = area;
  return spring;
}

}  // namespace

std::vector<Spring> make_springs(const Mesh& mesh, const std::vector<glue::GluePoint<2>>& points,
                                 const std::vector<bool>& at_end) {
  std::vector<Spring> springs;
  springs.reserve(points.size());
  for (const auto& point : points) {
    const FaceNodes a = locate(mesh, point.a), b = locate(mesh, point.b);
    const auto end_a = end_corner(a, at_end), end_b = end_corner(b, at_end);
    if (end_a && end_b) {
      springs.push_back(make_spring(mesh, *end_a, *end_b, point.normal, point.area));
    } else {
      springs.push_back(
          make_spring(mesh, {a.first, a.second, a.xi}, {b.first, b.second, b.xi}, point.normal, point.area));
    }
  }
  return springs;
}

ElementStiffness spring_stiffness(const Spring& spring, const glue::BondStiffness& glue) {
  return spring.area * (glue.tangential * spring.tangent * spring.tangent.transpose() +
                        glue.normal * spring.normal * spring.normal.transpose());
}

}  // namespace strandlab::statics
