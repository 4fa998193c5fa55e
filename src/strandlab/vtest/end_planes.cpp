#include "strandlab/vtest/end_planes.hpp"

namespace strandlab::vtest {
namespace {

Resultant resultant(const std::vector<Vec<2>>& positions, const std::vector<int>& nodes, const Vec<2>& about,
                    const std::vector<double>& forces) {
  Resultant sum;
  for (const int n : nodes) {
    const Vec<2> arm = positions[n] - about;
    sum.force += forces[2 * n];
    sum.moment += arm[0] * forces[2 * n + 1] - arm[1] * forces[2 * n];
  }
  return sum;
}

}  // namespace

statics::Supports end_plane_supports(const Model& model) {
  auto supports = no_supports(model.bonded.stiffness());
  for (const int n : model.section.left) supports.fixed[2 * n] = 1;
  for (const int n : model.section.right) supports.fixed[2 * n] = 1;
  for (const int n : model.section.pins) supports.fixed[2 * n + 1] = 1;
  return supports;
}

statics::LoadCase end_displacement(const Model& model, double q, double theta) {
  const auto& section = model.section;
  statics::LoadCase load{nothing(model), nothing(model)};
  for (const int n : section.right) load.given[2 * n] = q - theta * (section.nodes[n][1] - section.middle);
  return load;
}

Resultant left_resultant(const Section& section, const std::vector<double>& forces) {
  return resultant(section.nodes, section.left, Vec<2>(0, section.middle), forces);
}

Resultant right_resultant(const Section& section, const std::vector<double>& forces) {
  return resultant(section.nodes, section.right, Vec<2>(section.length, section.middle), forces);
}

}  // namespace strandlab::vtest
