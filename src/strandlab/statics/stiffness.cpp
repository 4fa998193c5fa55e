#include "strandlab/statics/stiffness.hpp"

#include <algorithm>

namespace strandlab::statics {
namespace {

using Dofs = Eigen::Matrix<double, 8, 1>;

Dofs gather(const std::array<int, 4>& nodes, const std::vector<double>& u) {
  Dofs d;
  for (int i = 0; i < 4; ++i) {
    d[2 * i] = u[2 * nodes[i]];
    d[2 * i + 1] = u[2 * nodes[i] + 1];
  }
  return d;
}

// Calls visit(row, column) for the node pairs of a group of four, row >= column.
template <class Visit>
void for_each_pair(const std::array<int, 4>& nodes, Visit visit) {
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      if (nodes[i] > nodes[j] || i == j) visit(nodes[i], nodes[j]);
    }
  }
}

}  // namespace

PanelStiffness::PanelStiffness(const Mesh& mesh, std::vector<Spring> springs)
    : elements_(mesh.elements), springs_(std::move(springs)) {
  make_pattern(mesh);
  element_stiffness_.reserve(elements_.size());
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const auto& n = elements_[e];
    element_stiffness_.push_back(incompatible_quadrilateral(
        {mesh.nodes[n[0]], mesh.nodes[n[1]], mesh.nodes[n[2]], mesh.nodes[n[3]]}, mesh.stiffness[e]));
    add_block(n, element_stiffness_.back(), wood_.value);
  }
}

void PanelStiffness::make_pattern(const Mesh& mesh) {
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
    for (const int second : {0, 1}) {
      for (int k = node_start_[c]; k < node_start_[c + 1]; ++k) {
        if (k > node_start_[c] || second == 0) wood_.row.push_back(2 * node_row_[k]);
        wood_.row.push_back(2 * node_row_[k] + 1);
      }
      wood_.column_start.push_back(static_cast<int>(wood_.row.size()));
    }
  }
  wood_.value.assign(wood_.row.size(), 0.0);
}

// Index of the value at (u_x of row_node, u_x or u_y of column_node); the u_y row follows. For row = column and the
// second column it is one before the diagonal.
int PanelStiffness::block_start(int row_node, int column_node, bool second_column) const {
  const auto begin = node_row_.begin() + node_start_[column_node],
             end = node_row_.begin() + node_start_[column_node + 1];
  const int k = static_cast<int>(std::lower_bound(begin, end, row_node) - begin);
  return wood_.column_start[2 * column_node + (second_column ? 1 : 0)] + 2 * k - (second_column ? 1 : 0);
}

void PanelStiffness::add_block(const std::array<int, 4>& nodes, const ElementStiffness& stiffness,
                               std::vector<double>& values) const {
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      if (nodes[i] < nodes[j]) continue;
      const bool diagonal = nodes[i] == nodes[j];
      for (const int c : {0, 1}) {
        const int start = block_start(nodes[i], nodes[j], c == 1);
        if (!(diagonal && c == 1)) values[start] += stiffness(2 * i, 2 * j + c);
        values[start + 1] += stiffness(2 * i + 1, 2 * j + c);
      }
    }
  }
}

LowerMatrix PanelStiffness::with(const glue::BondStiffness& glue) const {
  LowerMatrix sum = wood_;
  for (const auto& s : springs_) add_block(s.nodes, spring_stiffness(s, glue), sum.value);
  return sum;
}

double PanelStiffness::wood_energy(const std::vector<double>& displacement) const {
  double energy = 0;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const Dofs u = gather(elements_[e], displacement);
    energy += 0.5 * u.dot(element_stiffness_[e] * u);
  }
  return energy;
}

std::vector<Vec<2>> PanelStiffness::jumps(const std::vector<double>& displacement) const {
  std::vector<Vec<2>> result;
  result.reserve(springs_.size());
  for (const auto& s : springs_) {
    const Dofs u = gather(s.nodes, displacement);
    result.emplace_back(s.tangent.dot(u), s.normal.dot(u));
  }
  return result;
}

void PanelStiffness::add_traction_forces(const std::vector<Vec<2>>& tractions, std::vector<double>& force) const {
  for (std::size_t k = 0; k < springs_.size(); ++k) {
    const auto& s = springs_[k];
    const Dofs f = s.area * (tractions[k][0] * s.tangent + tractions[k][1] * s.normal);
    for (int i = 0; i < 4; ++i) {
      force[2 * s.nodes[i]] += f[2 * i];
      force[2 * s.nodes[i] + 1] += f[2 * i + 1];
    }
  }
}

double PanelStiffness::glue_energy(const std::vector<double>& displacement, const glue::BondStiffness& glue) const {
  auto tractions = jumps(displacement);
  for (auto& t : tractions) t = Vec<2>(glue.tangential * t[0], glue.normal * t[1]);
  return 0.5 * traction_work(tractions, displacement);
}

double PanelStiffness::traction_work(const std::vector<Vec<2>>& tractions,
                                     const std::vector<double>& displacement) const {
  const auto jump = jumps(displacement);
  double work = 0;
  for (std::size_t k = 0; k < springs_.size(); ++k) work += springs_[k].area * tractions[k].dot(jump[k]);
  return work;
}

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
