#include "strandlab/statics/springs.hpp"

namespace strandlab::statics {
namespace {

using Row = Eigen::Matrix<double, 8, 1>;

Vec<2> rotated(const Vec<2>& v) {
  return {-v[1], v[0]};
}  // by +90 degrees

// Rotation of a face between two nodes: omega = r . (u_2 - u_1)/|d|^2, d from node 1 to 2 and r = d turned by 90
// degrees.
void add_rotation(const Mesh& mesh, const FaceNodes& face, int first_dof, double factor, Row& row) {
  const Vec<2> d = mesh.nodes[face.second] - mesh.nodes[face.first];
  const Vec<2> r = factor * rotated(d) / d.squaredNorm();
  row.segment<2>(first_dof) -= r;
  row.segment<2>(first_dof + 2) += r;
}

Vec<2> position(const Mesh& mesh, const FaceNodes& face) {
  return (1 - face.xi) * mesh.nodes[face.first] + face.xi * mesh.nodes[face.second];
}

}  // namespace

std::vector<Spring> make_springs(const Mesh& mesh, const std::vector<glue::GluePoint<2>>& points) {
  std::vector<Spring> springs;
  springs.reserve(points.size());
  for (const auto& point : points) {
    const FaceNodes a = locate(mesh, point.a), b = locate(mesh, point.b);
    const Vec<2> arm = rotated(position(mesh, b) - position(mesh, a));
    Row rotation = Row::Zero();  // mean of the two faces
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
    spring.normal = jump(point.normal);
    spring.tangent = jump(rotated(point.normal));
    spring.area = point.area;
    springs.push_back(spring);
  }
  return springs;
}

ElementStiffness spring_stiffness(const Spring& spring, const GlueStiffness& glue) {
  return spring.area * (glue.tangential * spring.tangent * spring.tangent.transpose() +
                        glue.normal * spring.normal * spring.normal.transpose());
}

}  // namespace strandlab::statics
