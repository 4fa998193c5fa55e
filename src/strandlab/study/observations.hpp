// Moduli of many panels: what groups of them say on their own, and how groups differ panel by panel.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "strandlab/statistics/statistics.hpp"

namespace strandlab::study {

// What is compared between panels: a test of a kept state with a quality of glue. States and glues count by their
// place in the lists of their cases, as their numbers may be what differs: the compaction at which a mat has 640 kg/m3.
struct Measure {
  int state = 0;  // from 1
  std::string test;
  int glue = 0;                                      // from 1
  auto operator<=>(const Measure&) const = default;  // NOLINT(modernize-use-nullptr): clang-tidy 14 reads <=> so
};

struct Observation {
  std::size_t cell = 0;         // panels that differ by chance alone
  std::uint64_t replicate = 0;  // pairs panels of different cells
  Measure measure;
  double compaction = 0, density_kg_m3 = 0, compliance_t_mm_per_MPa = 0, modulus_MPa = 0;
};

// A measure of a cell, or its difference between cells. Numbers that are not those of all panels are their means; the
// compliance, which is a choice, is NaN instead.
struct Finding {
  Measure measure;
  double compaction = 0, density_kg_m3 = 0, compliance_t_mm_per_MPa = 0;
  statistics::Summary modulus_MPa;
  double reference_MPa = 0;  // of a difference: the mean of what is subtracted
};

class Observations {
 public:
  void add(const Observation& observation);

  // By measure.
  std::vector<Finding> of_cell(std::size_t cell) const;

  // Of all panels together.
  std::vector<Finding> all() const;

  // Mean of the cells `first` minus mean of the cells `second`, replicate by replicate, of replicates measured in all
  // of them; then the t-statistics over replicates. Paired: what panels of one replicate share, a mat above all, falls
  // out of their difference, and the interval is that of what is left. By measure; those that no replicate has in all
  // cells are left out. Needs a cell in each list.
  std::vector<Finding> difference(const std::vector<std::size_t>& first, const std::vector<std::size_t>& second) const;

  // By cell, then by replicate.
  std::vector<Observation> of_measure(const Measure& measure) const;

 private:
  using Replicates = std::map<std::uint64_t, Observation>;
  using Cells = std::map<std::size_t, Replicates>;
  static std::vector<const Observation*> panels_of(const Cells& cells, const std::vector<std::size_t>& wanted,
                                                   std::uint64_t replicate);
  std::map<Measure, Cells> by_measure_;
};

}  // namespace strandlab::study
