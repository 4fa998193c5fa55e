#include "strandlab/study/observations.hpp"

#include <algorithm>
#include <limits>

namespace strandlab::study {
namespace {

using Panels = std::vector<const Observation*>;
using Member = double Observation::*;

bool all_same(const Panels& panels, Member member) {
  return std::all_of(panels.begin(), panels.end(),
                     [&](const auto* p) { return p->*member == panels.front()->*member; });
}

// What the panels have in common, else the mean.
double common(const Panels& panels, Member member) {
  if (all_same(panels, member)) return panels.front()->*member;
  double sum = 0;
  for (const auto* panel : panels) sum += panel->*member;
  return sum / static_cast<double>(panels.size());
}

Finding finding_of(const Measure& measure, const Panels& panels, const std::vector<double>& moduli) {
  Finding finding;
  finding.measure = measure;
  finding.compaction = common(panels, &Observation::compaction);
  finding.density_kg_m3 = common(panels, &Observation::density_kg_m3);
  finding.compliance_t_mm_per_MPa = all_same(panels, &Observation::compliance_t_mm_per_MPa)
                                        ? panels.front()->compliance_t_mm_per_MPa
                                        : std::numeric_limits<double>::quiet_NaN();
  finding.modulus_MPa = statistics::summarise(moduli);
  return finding;
}

double mean_modulus(const Panels& panels) {
  double sum = 0;
  for (const auto* panel : panels) sum += panel->modulus_MPa;
  return sum / static_cast<double>(panels.size());
}

}  // namespace

void Observations::add(const Observation& observation) {
  by_measure_[observation.measure][observation.cell][observation.replicate] = observation;
}

std::vector<Finding> Observations::of_cell(std::size_t cell) const {
  std::vector<Finding> findings;
  for (const auto& [measure, cells] : by_measure_) {
    const auto found = cells.find(cell);
    if (found == cells.end()) continue;
    Panels panels;
    std::vector<double> moduli;
    for (const auto& [replicate, observation] : found->second) {
      panels.push_back(&observation);
      moduli.push_back(observation.modulus_MPa);
    }
    findings.push_back(finding_of(measure, panels, moduli));
  }
  return findings;
}

std::vector<Observation> Observations::of_measure(const Measure& measure) const {
  std::vector<Observation> list;
  const auto found = by_measure_.find(measure);
  if (found == by_measure_.end()) return list;
  for (const auto& [cell, replicates] : found->second)
    for (const auto& [replicate, observation] : replicates) list.push_back(observation);
  return list;
}

std::vector<Finding> Observations::all() const {
  std::vector<Finding> findings;
  for (const auto& [measure, cells] : by_measure_) {
    Panels panels;
    std::vector<double> moduli;
    for (const auto& [cell, replicates] : cells) {
      for (const auto& [replicate, observation] : replicates) {
        panels.push_back(&observation);
        moduli.push_back(observation.modulus_MPa);
      }
    }
    findings.push_back(finding_of(measure, panels, moduli));
  }
  return findings;
}

// The replicate's panels of these cells; none where one is missing.
std::vector<const Observation*> Observations::panels_of(const Cells& cells, const std::vector<std::size_t>& wanted,
                                                        std::uint64_t replicate) {
  Panels panels;
  for (const auto cell : wanted) {
    const auto found = cells.find(cell);
    const auto panel = found == cells.end() ? Replicates::const_iterator() : found->second.find(replicate);
    if (found == cells.end() || panel == found->second.end()) return {};
    panels.push_back(&panel->second);
  }
  return panels;
}

std::vector<Finding> Observations::difference(const std::vector<std::size_t>& first,
                                              const std::vector<std::size_t>& second) const {
  std::vector<Finding> findings;
  for (const auto& [measure, cells] : by_measure_) {
    const auto start = cells.find(first.front());
    if (start == cells.end()) continue;
    Panels all;
    std::vector<double> differences, references;
    for (const auto& [replicate, observation] : start->second) {
      const auto a = panels_of(cells, first, replicate), b = panels_of(cells, second, replicate);
      if (a.empty() || b.empty()) continue;
      differences.push_back(mean_modulus(a) - mean_modulus(b));
      references.push_back(mean_modulus(b));
      all.insert(all.end(), a.begin(), a.end());
      all.insert(all.end(), b.begin(), b.end());
    }
    if (differences.empty()) continue;
    findings.push_back(finding_of(measure, all, differences));
    findings.back().reference_MPa = statistics::summarise(references).mean;
  }
  return findings;
}

}  // namespace strandlab::study
