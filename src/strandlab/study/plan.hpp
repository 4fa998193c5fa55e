// The plan of a study: which keys of a case vary, over which values, how often. As the plan file says it; items.hpp
// makes cases of it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace strandlab::study {

// A key of the case with its value as TOML, "press.speed_m_s" and "4".
struct Setting {
  std::string key, value;
  std::string where;  // opens messages: "plan.toml:5"
};

// Values that change together, row by row; the cells of a study are all combinations of one row of each block.
struct Block {
  enum class Kind {
    kValues,      // an axis, or a [[zip]] table of several keys
    kOneAtATime,  // the base case, then each value of each key alone
    kLatinHypercube
  };
  Kind kind = Kind::kValues;
  std::vector<std::string> keys;
  std::vector<std::pair<double, double>> intervals{};  // of a Latin hypercube: from and to of each key
  std::vector<std::vector<std::string>> rows;  // by row the value of each key as TOML; "": as the base case has it
  std::string where;
};

// A difference that the plan asks for: `key` at `value` minus the same at `against`.
struct Contrast {
  std::string key, value, against;
  std::string where;
};

struct Plan {
  std::string text;                        // of the file, as it is
  std::string source;                      // the file, as messages name it
  std::string base;                        // a ready case's name or a file beside the plan
  std::filesystem::path folder;            // of the plan: file names count from it
  int replicates = 1;                      // of each cell; replicate r has the seed base_seed + r - 1
  std::optional<std::uint64_t> base_seed;  // none: run.seed of the base case
  std::vector<Setting> settings;           // [set]: of all cells
  std::vector<Block> blocks;
  std::vector<Contrast> contrasts;
};

inline constexpr std::size_t kMostItems = 100000;

// Throws InputError (file, line, what was given, what is allowed) for text that is no TOML and for anything that no
// study can be made of; what only the case can judge, names and values of its keys, is left to items_of().
Plan plan_from_text(const std::string& text, const std::string& source, const std::filesystem::path& folder);
// The same of a file. Throws InputError also for one that cannot be read.
Plan read_plan(const std::filesystem::path& file);

// The keys that vary, in the order of the plan: columns of the tables.
std::vector<std::string> varied_keys(const Plan& plan);

// Combinations of rows, the row of each block; those of the last block change fastest.
std::vector<std::vector<std::size_t>> cells_of(const Plan& plan);

// The values of a cell, one per varied key.
std::vector<std::string> values_of(const Plan& plan, const std::vector<std::size_t>& cell);

// A value as tables show it: texts without their quotes.
std::string shown(const std::string& value);

}  // namespace strandlab::study
