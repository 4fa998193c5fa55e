#include "strandlab/study/effects.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Core>
#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <map>
#include <utility>

#include "strandlab/statistics/statistics.hpp"

namespace strandlab::study {
namespace {

using Cell = std::vector<std::size_t>;

std::vector<std::string> shown_all(std::vector<std::string> values) {
  for (auto& value : values) value = shown(value);
  return values;
}

std::size_t number_of(const std::vector<Cell>& cells, const Cell& cell) {
  return static_cast<std::size_t>(std::find(cells.begin(), cells.end(), cell) - cells.begin());
}

// The block's row that has this value of the key; rows.size() for another block's key.
std::size_t row_with(const Block& block, const std::string& key, const std::string& value) {
  const auto at = std::find(block.keys.begin(), block.keys.end(), key) - block.keys.begin();
  if (at == static_cast<std::ptrdiff_t>(block.keys.size())) return block.rows.size();
  const auto row = std::find_if(block.rows.begin(), block.rows.end(),
                                [&](const auto& values) { return values[static_cast<std::size_t>(at)] == value; });
  return static_cast<std::size_t>(row - block.rows.begin());
}

void add_contrast(const Plan& plan, const Contrast& contrast, std::size_t b, const std::vector<Cell>& cells,
                  std::vector<ContrastedCells>& pairs) {
  const auto& block = plan.blocks[b];
  const auto first = row_with(block, contrast.key, contrast.value);
  const auto second = row_with(block, contrast.key, contrast.against);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i][b] != first) continue;
    auto other = cells[i];
    other[b] = second;
    const auto minus = shown_all(values_of(plan, other));
    ContrastedCells pair{fmt::format("{}: {} - {}", contrast.key, shown(contrast.value), shown(contrast.against)),
                         shown_all(values_of(plan, cells[i])), i, number_of(cells, other)};
    for (std::size_t k = 0; k < minus.size(); ++k)
      if (pair.values[k] != minus[k]) pair.values[k] += " - " + minus[k];
    pairs.push_back(std::move(pair));
  }
}

// Each row of the block against the first.
void add_differences(const Plan& plan, std::size_t b, const std::vector<Cell>& cells, const Observations& observations,
                     std::vector<Effect>& effects) {
  const auto& block = plan.blocks[b];
  std::vector<std::vector<std::size_t>> by_row(block.rows.size());
  for (std::size_t i = 0; i < cells.size(); ++i) by_row[cells[i][b]].push_back(i);
  const bool alone = block.kind == Block::Kind::kOneAtATime;
  for (std::size_t row = 1; row < block.rows.size(); ++row) {
    const auto& values = block.rows[row];
    const auto key = static_cast<std::size_t>(
        alone ? std::find_if(values.begin(), values.end(), [](const auto& v) { return !v.empty(); }) - values.begin()
              : 0);
    Effect effect;
    effect.factor = alone ? block.keys[key] : fmt::format("{}", fmt::join(block.keys, " + "));
    effect.value = alone ? shown(values[key]) : fmt::format("{}", fmt::join(shown_all(values), " + "));
    effect.against = alone ? "base" : fmt::format("{}", fmt::join(shown_all(block.rows[0]), " + "));
    for (auto& finding : observations.difference(by_row[row], by_row[0])) {
      effect.finding = std::move(finding);
      effects.push_back(effect);
    }
  }
}

// Samples of one replicate and one combination of the other blocks have their own mean: what is left of it is fitted.
struct Sampled {
  std::vector<const Observation*> panels;
  Eigen::MatrixXd factors;  // by panel and key, 0 at `from` and 1 at `to`, less the group's mean
  Eigen::VectorXd moduli;   // less the group's mean
  int groups = 0;
};

Sampled sampled(const Block& block, std::size_t b, const std::vector<Cell>& cells,
                const std::vector<Observation>& observations) {
  std::map<std::pair<std::uint64_t, Cell>, std::vector<const Observation*>> groups;
  for (const auto& o : observations) {
    auto others = cells[o.cell];
    others[b] = 0;
    groups[{o.replicate, others}].push_back(&o);
  }
  const auto keys = static_cast<Eigen::Index>(block.keys.size());
  Sampled result{{},
                 Eigen::MatrixXd(observations.size(), keys),
                 Eigen::VectorXd(observations.size()),
                 static_cast<int>(groups.size())};
  Eigen::Index begin = 0;
  for (const auto& [group, panels] : groups) {
    const auto n = static_cast<Eigen::Index>(panels.size());
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto& panel = *panels[static_cast<std::size_t>(i)];
      const auto& row = block.rows[cells[panel.cell][b]];
      for (Eigen::Index k = 0; k < keys; ++k) {
        const auto [from, to] = block.intervals[static_cast<std::size_t>(k)];
        result.factors(begin + i, k) =
            (std::strtod(row[static_cast<std::size_t>(k)].c_str(), nullptr) - from) / (to - from);
      }
      result.moduli[begin + i] = panel.modulus_MPa;
    }
    auto factors = result.factors.middleRows(begin, n);
    factors.rowwise() -= factors.colwise().mean().eval();
    auto moduli = result.moduli.segment(begin, n);
    moduli.array() -= moduli.mean();
    begin += n;
    result.panels.insert(result.panels.end(), panels.begin(), panels.end());
  }
  return result;
}

void add_slopes(const Plan& plan, std::size_t b, const std::vector<Cell>& cells, const Observations& observations,
                std::vector<Effect>& effects) {
  const auto& block = plan.blocks[b];
  std::vector<std::vector<Effect>> by_key(block.keys.size());
  for (const auto& finding : observations.all()) {
    const auto s = sampled(block, b, cells, observations.of_measure(finding.measure));
    const auto slopes = statistics::slopes(s.factors, s.moduli, s.groups);
    for (std::size_t k = 0; k < slopes.size(); ++k) {
      const auto [from, to] = block.intervals[k];
      Effect effect{block.keys[k], fmt::format("{}", to), fmt::format("{}", from), finding};
      effect.finding.reference_MPa = finding.modulus_MPa.mean;
      effect.finding.modulus_MPa = slopes[k];
      by_key[k].push_back(std::move(effect));
    }
  }
  for (auto& list : by_key) std::move(list.begin(), list.end(), std::back_inserter(effects));
}

}  // namespace

std::vector<ContrastedCells> contrasted_cells(const Plan& plan) {
  std::vector<ContrastedCells> pairs;
  const auto cells = cells_of(plan);
  for (const auto& contrast : plan.contrasts) {
    for (std::size_t b = 0; b < plan.blocks.size(); ++b) {
      const auto& block = plan.blocks[b];
      if (row_with(block, contrast.key, contrast.value) < block.rows.size())
        add_contrast(plan, contrast, b, cells, pairs);
    }
  }
  return pairs;
}

std::vector<Effect> main_effects(const Plan& plan, const Observations& observations) {
  std::vector<Effect> effects;
  const auto cells = cells_of(plan);
  for (std::size_t b = 0; b < plan.blocks.size(); ++b) {
    if (plan.blocks[b].kind == Block::Kind::kLatinHypercube)
      add_slopes(plan, b, cells, observations, effects);
    else
      add_differences(plan, b, cells, observations, effects);
  }
  return effects;
}

}  // namespace strandlab::study
