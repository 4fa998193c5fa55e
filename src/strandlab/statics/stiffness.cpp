#include "strandlab/statics/stiffness.hpp"

#include <algorithm>

namespace strandlab::statics {
namespace {

template <int Dim>
ElementDofs<Dim> gather(const std::array<int, kCorners<Dim>>& nodes, const std::vector<double>& u) {
  ElementDofs<Dim> d;
  for (int i = 0; i < kCorners<Dim>; ++i) {
    for (int a = 0; a < Dim; ++a) d[Dim * i + a] = u[Dim * nodes[i] + a];
  }
  return d;
}

// Calls visit(row, column) for the node pairs of a group, row >= column.
template <class Nodes, class Visit>
void for_each_pair(const Nodes& nodes, Visit visit) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      if (nodes[i] > nodes[j] || i == j) visit(nodes[i], nodes[j]);
    }
  }
}

}  // namespace

template <int Dim>
PanelStiffness<Dim>::PanelStiffness(const Mesh<Dim>& mesh, std::vector<Spring<Dim>> springs)
    : elements_(mesh.elements), springs_(std::move(springs)) {
  make_pattern(mesh);
  element_stiffness_.reserve(elements_.size());
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    element_stiffness_.push_back(incompatible_element<Dim>(mesh.corners(e), mesh.stiffness[e]));
    add_block(elements_[e], element_stiffness_.back(), wood_.value);
  }
}

template <int Dim>
void PanelStiffness<Dim>::make_pattern(const Mesh<Dim>& mesh) {
  const auto nodes = mesh.nodes.size();
  std::vector<int> count(nodes + 1, 0);
  const auto for_all = [&](auto visit) {
    for (const auto& e : elements_) for_each_pair(e, visit);
    for (const auto& s : springs_) for_each_pair(s.nodes, visit);
  };
  for_all([&](int, int column) { ++count[column + 1]; });
  for (std::size_t c = 0; c < nodes; ++c) count[c + 1] += count[c];
  std::vector<int> rows(static_cast<std::size_t>(count[nodes])), next(count.begin(), count.end() - 1);
  for_all([&](int row, int column) { rows[next[column]++] = row; });

  node_start_.assign(1, 0);
  wood_.column_start.assign(1, 0);
  for (std::size_t c = 0; c < nodes; ++c) {
    const auto begin = rows.begin() + count[c], end = rows.begin() + count[c + 1];
    std::sort(begin, end);
    node_row_.insert(node_row_.end(), begin, std::unique(begin, end));
    node_start_.push_back(static_cast<int>(node_row_.size()));
    for (int component = 0; component < Dim; ++component) {
      for (int k = node_start_[c]; k < node_start_[c + 1]; ++k) {
        for (int a = k > node_start_[c] ? 0 : component; a < Dim; ++a) wood_.row.push_back(Dim * node_row_[k] + a);
      }
      wood_.column_start.push_back(static_cast<int>(wood_.row.size()));
    }
  }
  wood_.value.assign(wood_.row.size(), 0.0);
}

// Index of the value at (u_x of row_node, a component of column_node); the rows of the other components follow. In the
// diagonal block those above the diagonal do not exist: their indices would be before the column's first.
template <int Dim>
int PanelStiffness<Dim>::block_start(int row_node, int column_node, int component) const {
  const auto begin = node_row_.begin() + node_start_[column_node],
             end = node_row_.begin() + node_start_[column_node + 1];
  const int k = static_cast<int>(std::lower_bound(begin, end, row_node) - begin);
  return wood_.column_start[Dim * column_node + component] + Dim * k - component;
}

template <int Dim>
void PanelStiffness<Dim>::add_block(const Nodes& nodes, const ElementStiffness<Dim>& stiffness,
                                    std::vector<double>& values) const {
  for (int i = 0; i < kCorners<Dim>; ++i) {
    for (int j = 0; j < kCorners<Dim>; ++j) {
      if (nodes[i] < nodes[j]) continue;
      const bool diagonal = nodes[i] == nodes[j];
      for (int c = 0; c < Dim; ++c) {
        const int start = block_start(nodes[i], nodes[j], c);
        for (int a = diagonal ? c : 0; a < Dim; ++a) values[start + a] += stiffness(Dim * i + a, Dim * j + c);
      }
    }
  }
}

template <int Dim>
LowerMatrix PanelStiffness<Dim>::with(const std::vector<glue::BondStiffness>& bonds) const {
  LowerMatrix sum = wood_;
  for (std::size_t k = 0; k < springs_.size(); ++k)
    add_block(springs_[k].nodes, spring_stiffness(springs_[k], bonds[k]), sum.value);
  return sum;
}

template <int Dim>
double PanelStiffness<Dim>::wood_energy(const std::vector<double>& displacement) const {
  double energy = 0;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const auto u = gather<Dim>(elements_[e], displacement);
    energy += 0.5 * u.dot(element_stiffness_[e] * u);
  }
  return energy;
}

template <int Dim>
std::vector<Vec<Dim>> PanelStiffness<Dim>::jumps(const std::vector<double>& displacement) const {
  std::vector<Vec<Dim>> result(springs_.size());
  for (std::size_t k = 0; k < springs_.size(); ++k) {
    const auto u = gather<Dim>(springs_[k].nodes, displacement);
    for (int d = 0; d < Dim; ++d) result[k][d] = springs_[k].jump[d].dot(u);
  }
  return result;
}

template <int Dim>
void PanelStiffness<Dim>::add_traction_forces(const std::vector<Vec<Dim>>& tractions,
                                              std::vector<double>& force) const {
  for (std::size_t k = 0; k < springs_.size(); ++k) {
    const auto& s = springs_[k];
    ElementDofs<Dim> f = tractions[k][0] * s.jump[0];
    for (int d = 1; d < Dim; ++d) f += tractions[k][d] * s.jump[d];
    f *= s.area;
    for (int i = 0; i < kCorners<Dim>; ++i) {
      for (int a = 0; a < Dim; ++a) force[Dim * s.nodes[i] + a] += f[Dim * i + a];
    }
  }
}

template <int Dim>
double PanelStiffness<Dim>::glue_energy(const std::vector<double>& displacement,
                                        const std::vector<glue::BondStiffness>& bonds) const {
  auto tractions = jumps(displacement);
  for (std::size_t k = 0; k < springs_.size(); ++k) {
    for (int d = 0; d < Dim - 1; ++d) tractions[k][d] *= springs_[k].tangential(bonds[k]);
    tractions[k][Dim - 1] *= springs_[k].normal(bonds[k]);
  }
  return 0.5 * traction_work(tractions, displacement);
}

template <int Dim>
double PanelStiffness<Dim>::traction_work(const std::vector<Vec<Dim>>& tractions,
                                          const std::vector<double>& displacement) const {
  const auto jump = jumps(displacement);
  double work = 0;
  for (std::size_t k = 0; k < springs_.size(); ++k) work += springs_[k].area * tractions[k].dot(jump[k]);
  return work;
}

template class PanelStiffness<2>;
template class PanelStiffness<3>;

LowerMatrix constrained(const LowerMatrix& stiffness, const Supports& supports) {
  LowerMatrix result = stiffness;
  for (int j = 0; j < result.size(); ++j) {
    for (int k = result.column_start[j]; k < result.column_start[j + 1]; ++k) {
      if (!supports.fixed[j] && !supports.fixed[result.row[k]]) continue;
      result.value[k] = result.row[k] == j ? supports.diagonal : 0.0;
    }
  }
  return result;
}

std::vector<double> right_hand_side(const LowerMatrix& stiffness, const Supports& supports,
                                    const std::vector<double>& force, const std::vector<double>& displacement) {
  std::vector<double> given(displacement.size(), 0.0);
  for (std::size_t i = 0; i < given.size(); ++i) given[i] = supports.fixed[i] ? displacement[i] : 0.0;
  auto rhs = multiply(stiffness, given);
  for (std::size_t i = 0; i < rhs.size(); ++i) {
    rhs[i] = supports.fixed[i] ? supports.diagonal * given[i] : force[i] - rhs[i];
  }
  return rhs;
}

}  // namespace strandlab::statics
