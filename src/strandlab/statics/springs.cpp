#include "strandlab/statics/springs.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

namespace strandlab::statics {
namespace {

using Row = Eigen::Matrix<double, 8, 1>;

Vec<2> rotated(const Vec<2>& v) {
  return {-v[1], v[0]};
}  // by +90 degrees

// Where a glue point holds on to one of its strands: the displacement there is (1 - xi) u[first] + xi u[second], and
// the line between the two nodes gives the rotation.
struct LinePoint {
  int first, second;
  double xi;
};

// That place as a corner of an end plane, if it is (nearly) one: the line runs along the plane.
std::optional<LinePoint> end_corner(const FaceNodes& face, const std::vector<bool>& at_end) {
  constexpr double kNear = 0.1;  // of an element
  if (face.xi < kNear && at_end[face.first]) return LinePoint{face.first, face.first + face.inward, 0};
  if (face.xi > 1 - kNear && at_end[face.second]) return LinePoint{face.second, face.second + face.inward, 0};
  return std::nullopt;
}

Vec<2> position(const Mesh<2>& mesh, const LinePoint& at) {
  return (1 - at.xi) * mesh.nodes[at.first] + at.xi * mesh.nodes[at.second];
}

// Rotation of the line from node 1 to 2: omega = r . (u_2 - u_1)/|d|^2 with d from 1 to 2 and r = d turned by 90
// degrees.
void add_rotation(const Mesh<2>& mesh, const LinePoint& at, int first_dof, double factor, Row& row) {
  const Vec<2> d = mesh.nodes[at.second] - mesh.nodes[at.first];
  const Vec<2> r = factor * rotated(d) / d.squaredNorm();
  row.segment<2>(first_dof) -= r;
  row.segment<2>(first_dof + 2) += r;
}

Spring<2> make_spring(const Mesh<2>& mesh, const LinePoint& a, const LinePoint& b, const Vec<2>& normal, double area) {
  const Vec<2> arm = rotated(position(mesh, b) - position(mesh, a));
  Row rotation = Row::Zero();  // mean of the two strands
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
  Spring<2> spring;
  spring.nodes = {a.first, a.second, b.first, b.second};
  spring.jump = {jump(rotated(normal)), jump(normal)};
  spring.area = area;
  return spring;
}

// Weights of a facet's nodes at a place, and their derivatives by its two coordinates.
struct FacetShape {
  std::array<double, 4> weight{};
  std::array<Vec<2>, 4> slope;
};

FacetShape facet_shape(const Vec<2>& place) {
  constexpr std::array<std::array<double, 2>, 4> kAround{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  FacetShape shape;
  for (std::size_t i = 0; i < 4; ++i) {
    const double f = 1 + kAround[i][0] * place[0], g = 1 + kAround[i][1] * place[1];
    shape.weight[i] = 0.25 * f * g;
    shape.slope[i] = Vec<2>(0.25 * kAround[i][0] * g, 0.25 * f * kAround[i][1]);
  }
  return shape;
}

// Derivatives of the facet's functions along its surface, mm^-1: those of the inverse of its tangents.
std::array<Vec<3>, 4> surface_gradients(const Mesh<3>& mesh, const FacetNodes& facet, const FacetShape& shape) {
  Eigen::Matrix<double, 3, 2> tangents = Eigen::Matrix<double, 3, 2>::Zero();
  for (std::size_t i = 0; i < 4; ++i)
    tangents += mesh.nodes[static_cast<std::size_t>(facet.nodes[i])] * shape.slope[i].transpose();
  const Eigen::Matrix<double, 3, 2> inverse = tangents * (tangents.transpose() * tangents).inverse();
  std::array<Vec<3>, 4> gradients;
  for (std::size_t i = 0; i < 4; ++i) gradients[i] = inverse * shape.slope[i];
  return gradients;
}

constexpr double kLeastShare = 0.1;  // of an element's area, as which a perfect bond is stiff

Spring<3> make_spring(const Mesh<3>& mesh, const glue::GluePoint<3>& point) {
  Spring<3> spring;
  spring.area = point.area;
  spring.quality = point.quality;
  spring.lacking = point.lacking;
  const auto& part =
      mesh.strands[static_cast<std::size_t>(mesh.mesh_of_strand[static_cast<std::size_t>(point.a.strand)])];
  spring.stiffened = std::max(1.0, kLeastShare * part.elements.spacing[0] * part.elements.spacing[1] / point.area);
  const Vec<3>& n = point.normal;
  const Vec<3> along = n.cross(std::abs(n[0]) < 0.5 ? Vec<3>::UnitX() : Vec<3>::UnitY()).normalized();
  const std::array<Vec<3>, 3> direction{along, n.cross(along), n};
  const Vec<3> arm = point.b.position - point.a.position;
  for (auto& jump : spring.jump) jump.setZero();
  const auto add_side = [&](const glue::FacePoint<3>& side, int first, double sign) {
    const auto facet = locate(mesh, side);
    const auto shape = facet_shape(facet.place);
    const auto gradient = surface_gradients(mesh, facet, shape);
    for (int i = 0; i < 4; ++i) {
      const auto k = static_cast<std::size_t>(i);
      spring.nodes[static_cast<std::size_t>(first + i)] = facet.nodes[k];
      for (std::size_t d = 0; d < 3; ++d) {
        // A rotation moves the far end of the arm, which is along the normal, by -(arm.n) grad(u.n).
        spring.jump[d].segment<3>(3 * (first + i)) +=
            sign * shape.weight[k] * direction[d] + 0.5 * arm.dot(n) * direction[d].dot(gradient[k]) * n;
      }
    }
  };
  add_side(point.a, 0, -1);
  add_side(point.b, 4, 1);
  return spring;
}

}  // namespace

std::vector<Spring<2>> make_springs(const Mesh<2>& mesh, const std::vector<glue::GluePoint<2>>& points,
                                    const std::vector<bool>& at_end) {
  std::vector<Spring<2>> springs;
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
    springs.back().quality = point.quality;
    springs.back().lacking = point.lacking;
  }
  return springs;
}

std::vector<Spring<3>> make_springs(const Mesh<3>& mesh, const std::vector<glue::GluePoint<3>>& points) {
  std::vector<Spring<3>> springs;
  springs.reserve(points.size());
  for (const auto& point : points) springs.push_back(make_spring(mesh, point));
  return springs;
}

}  // namespace strandlab::statics
