#include "strandlab/study/plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <sstream>
#include <system_error>
#include <utility>

#include "strandlab/core/error.hpp"
#include "strandlab/core/nearest.hpp"
#include "strandlab/core/text.hpp"
#include "strandlab/files/text_file.hpp"
#include "strandlab/study/sampling.hpp"

namespace strandlab::study {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kTopKeys{"base", "replicates",      "base_seed",     "set",      "axes",
                                        "zip",  "latin_hypercube", "one_at_a_time", "contrasts"};
const std::string kValuesHelp = "a list, {from, to, step} or {from, to, count}";

std::string place(const toml::node& node, const std::string& source) {
  return fmt::format("{}:{}", source, node.source().begin.line);
}

[[noreturn]] void fail(const std::string& where, const std::string& message) {
  throw InputError(fmt::format("{}: {}", where, message));
}

// ---- Values ---------------------------------------------------------------------------------------------------------

// 4.0 is written 4: keys of whole numbers take it, and one value has one name.
std::string toml_of(double value) {
  return fmt::format("{}", value + 0.0);
}

// As TOML, on one line; empty for what no key takes.
std::string toml_of(const toml::node& node) {
  if (const auto* whole = node.as_integer()) return fmt::format("{}", whole->get());
  if (const auto* real = node.as_floating_point()) return toml_of(real->get());
  if (const auto* array = node.as_array()) {
    std::vector<std::string> items;
    for (const auto& item : *array) items.push_back(toml_of(item));
    if (std::find(items.begin(), items.end(), "") != items.end()) return {};
    return fmt::format("[{}]", fmt::join(items, ", "));
  }
  if (!node.is_string() && !node.is_boolean()) return {};
  std::ostringstream text;
  node.visit([&](const auto& n) { text << n; });
  return text.str();
}

std::string value_of(const toml::node& node, const std::string& key, const std::string& where) {
  auto value = toml_of(node);
  if (value.empty() || value.find('\n') != std::string::npos)
    fail(where, fmt::format("{}: a value is a number, a text on one line, true, false or a list of these", key));
  return value;
}

double number_in(const toml::table& table, const char* name, const std::string& key, const std::string& where) {
  const auto* node = table.get(name);
  const auto value = node && node->is_number() ? node->value<double>() : std::nullopt;
  if (value && std::isfinite(*value)) return *value;
  fail(where, fmt::format("{}: a range needs \"{}\", a number; values are {}", key, name, kValuesHelp));
}

std::int64_t whole_in(const toml::table& table, const char* name, std::int64_t least, std::int64_t most,
                      const std::string& key, const std::string& where) {
  const auto* node = table.get(name);
  const auto* value = node ? node->as_integer() : nullptr;
  if (value && value->get() >= least && value->get() <= most) return value->get();
  fail(where, fmt::format("{}: \"{}\" must be a whole number from {} to {}{}", key, name, least, most,
                          node ? ", not " + shortened(toml_of(*node)) : ", and is missing"));
}

void refuse_other_names(const toml::table& table, const std::vector<std::string>& allowed, const std::string& what,
                        const std::string& source) {
  for (const auto& [name, node] : table) {
    const std::string given(name.str());
    if (std::find(allowed.begin(), allowed.end(), given) != allowed.end()) continue;
    const auto near = nearest(given, allowed);
    fail(place(node, source),
         fmt::format("{}: unknown key \"{}\"{} Allowed: {}", what, shortened(given),
                     near.empty() ? "." : fmt::format("; did you mean \"{}\"?", near), quoted_list(allowed)));
  }
}

std::vector<std::string> range_of(const toml::table& table, const std::string& key, const std::string& source) {
  const auto where = place(table, source);
  refuse_other_names(table, {"from", "to", "step", "count"}, key, source);
  const double from = number_in(table, "from", key, where), to = number_in(table, "to", key, where);
  if (table.contains("step") == table.contains("count"))
    fail(where, fmt::format("{}: a range has a \"step\" or a \"count\", one of them", key));
  std::vector<double> values;
  if (table.contains("count")) {
    values = spaced(from, to, static_cast<int>(whole_in(table, "count", 2, kMostItems, key, where)));
  } else {
    const double step = number_in(table, "step", key, where);
    if (!(step * (to - from) > 0))
      fail(where, fmt::format("{}: steps of {} do not lead from {} to {}", key, step, from, to));
    if ((to - from) / step > static_cast<double>(kMostItems))
      fail(where, fmt::format("{}: more than {} values; lengthen the step", key, kMostItems));
    values = stepped(from, to, step);
  }
  std::vector<std::string> texts;
  texts.reserve(values.size());
  for (const double value : values) texts.push_back(toml_of(value));
  return texts;
}

std::vector<std::string> values_at(const toml::node& node, const std::string& key, const std::string& source) {
  const auto where = place(node, source);
  if (const auto* table = node.as_table()) return range_of(*table, key, source);
  const auto* list = node.as_array();
  if (!list) fail(where, fmt::format("{}: values are {}, not {}", key, kValuesHelp, shortened(toml_of(node))));
  std::vector<std::string> values;
  for (const auto& item : *list) {
    auto value = value_of(item, key, where);
    if (std::find(values.begin(), values.end(), value) != values.end())
      fail(where, fmt::format("{}: {} stands there twice", key, shortened(value)));
    values.push_back(std::move(value));
  }
  if (values.empty()) fail(where, fmt::format("{}: no values; an axis needs at least one", key));
  return values;
}

// ---- Tables of keys -------------------------------------------------------------------------------------------------

using Visit = std::function<void(const std::string& key, const toml::node& node)>;

// Keys of the case in a table, "press.speed_m_s" in quotes or as tables within each other, in the order of the file.
void visit_case_keys(const toml::table& table, const std::string& prefix, const Visit& visit) {
  std::vector<std::pair<std::string, const toml::node*>> entries;
  for (const auto& [name, node] : table) entries.emplace_back(prefix + std::string(name.str()), &node);
  std::stable_sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
    const auto at = [](const toml::node& node) {
      return std::pair(node.source().begin.line, node.source().begin.column);
    };
    return at(*a.second) < at(*b.second);
  });
  for (const auto& [key, node] : entries) {
    const auto* inner = node->as_table();
    const bool range = inner && (inner->empty() || inner->contains("from") || inner->contains("to"));
    if (inner && !range)
      visit_case_keys(*inner, key + ".", visit);
    else
      visit(key, *node);
  }
}

const toml::table* table_at(const toml::table& plan, const char* name, const std::string& source) {
  const auto* node = plan.get(name);
  if (!node) return nullptr;
  if (!node->is_table())
    fail(place(*node, source), fmt::format("{} is a table: its keys follow a line [{}]", name, name));
  return node->as_table();
}

// [[name]] tables.
std::vector<const toml::table*> tables_at(const toml::table& plan, const char* name, const std::string& source) {
  std::vector<const toml::table*> tables;
  const auto* node = plan.get(name);
  if (!node) return tables;
  const auto* array = node->as_array();
  const bool all = array && !array->empty() &&
                   std::all_of(array->begin(), array->end(), [](const toml::node& item) { return item.is_table(); });
  if (!all) fail(place(*node, source), fmt::format("{} is a list of tables: each follows a line [[{}]]", name, name));
  for (const auto& item : *array) tables.push_back(item.as_table());
  return tables;
}

void add_axes(Plan& plan, const toml::table& file) {
  const auto* axes = table_at(file, "axes", plan.source);
  if (!axes) return;
  visit_case_keys(*axes, "", [&](const std::string& key, const toml::node& node) {
    Block block{Block::Kind::kValues, {key}, {}, {}, place(node, plan.source)};
    for (auto& value : values_at(node, key, plan.source)) block.rows.push_back({std::move(value)});
    plan.blocks.push_back(std::move(block));
  });
}

void add_zips(Plan& plan, const toml::table& file) {
  for (const auto* table : tables_at(file, "zip", plan.source)) {
    Block block{Block::Kind::kValues, {}, {}, {}, place(*table, plan.source)};
    visit_case_keys(*table, "", [&](const std::string& key, const toml::node& node) {
      // Rows may repeat the value of one key: values of a list, not of an axis.
      std::vector<std::string> values;
      if (const auto* list = node.as_array())
        for (const auto& item : *list) values.push_back(value_of(item, key, place(node, plan.source)));
      else
        values = values_at(node, key, plan.source);
      if (block.keys.empty()) block.rows.resize(values.size());
      if (values.size() != block.rows.size())
        fail(place(node, plan.source),
             fmt::format("{}: {} values, but {} has {}; keys of a [[zip]] change together and have as many values", key,
                         values.size(), block.keys.front(), block.rows.size()));
      block.keys.push_back(key);
      for (std::size_t i = 0; i < values.size(); ++i) block.rows[i].push_back(std::move(values[i]));
    });
    if (block.rows.empty()) fail(block.where, "zip: no values; it needs at least one of each of its keys");
    plan.blocks.push_back(std::move(block));
  }
}

void add_latin_hypercube(Plan& plan, const toml::table& file) {
  const auto* table = table_at(file, "latin_hypercube", plan.source);
  if (!table) return;
  const auto where = place(*table, plan.source);
  const auto samples = whole_in(*table, "samples", 2, kMostItems, "latin_hypercube", where);
  const auto seed = table->contains("seed") ? whole_in(*table, "seed", 0, INT64_MAX, "latin_hypercube", where) : 1;
  Block block{Block::Kind::kLatinHypercube, {}, {}, {}, where};
  std::vector<Interval> intervals;
  visit_case_keys(*table, "", [&](const std::string& key, const toml::node& node) {
    if (key == "samples" || key == "seed") return;
    const auto* range = node.as_table();
    if (!range) fail(place(node, plan.source), fmt::format("{}: in a Latin hypercube a key has {{from, to}}", key));
    refuse_other_names(*range, {"from", "to"}, key, plan.source);
    const auto at = place(node, plan.source);
    intervals.push_back({number_in(*range, "from", key, at), number_in(*range, "to", key, at)});
    if (!(intervals.back().from < intervals.back().to))
      fail(at, fmt::format("{}: \"from\" must be less than \"to\"", key));
    block.keys.push_back(key);
  });
  if (block.keys.empty()) fail(where, "latin_hypercube: no keys; each key has {from, to}");
  for (const auto& sample : latin_hypercube(intervals, static_cast<int>(samples), static_cast<std::uint64_t>(seed))) {
    auto& row = block.rows.emplace_back();
    for (const double value : sample) row.push_back(toml_of(value));
  }
  for (const auto& [from, to] : intervals) block.intervals.emplace_back(from, to);
  plan.blocks.push_back(std::move(block));
}

void add_one_at_a_time(Plan& plan, const toml::table& file) {
  const auto* table = table_at(file, "one_at_a_time", plan.source);
  if (!table) return;
  Block block{Block::Kind::kOneAtATime, {}, {}, {}, place(*table, plan.source)};
  std::vector<std::vector<std::string>> values;
  visit_case_keys(*table, "", [&](const std::string& key, const toml::node& node) {
    block.keys.push_back(key);
    values.push_back(values_at(node, key, plan.source));
  });
  if (block.keys.empty()) fail(block.where, "one_at_a_time: no keys; each key has " + kValuesHelp);
  block.rows.emplace_back(block.keys.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    for (auto& value : values[k]) {
      block.rows.emplace_back(block.keys.size());
      block.rows.back()[k] = std::move(value);
    }
  }
  plan.blocks.push_back(std::move(block));
}

void add_settings(Plan& plan, const toml::table& file) {
  const auto* table = table_at(file, "set", plan.source);
  if (!table) return;
  visit_case_keys(*table, "", [&](const std::string& key, const toml::node& node) {
    const auto where = place(node, plan.source);
    plan.settings.push_back({key, value_of(node, key, where), where});
  });
}

// ---- Rules between tables -------------------------------------------------------------------------------------------

void refuse_keys_twice(const Plan& plan) {
  std::map<std::string, std::string> seen;
  const auto note = [&](const std::string& key, const std::string& where) {
    if (key == "run.seed")
      fail(where,
           "run.seed is set by the replicates: replicate r has the seed base_seed + r - 1; give replicates and "
           "base_seed");
    const auto [first, is_new] = seen.emplace(key, where);
    if (!is_new)
      fail(where, fmt::format("{} is given twice, also at {}: a key is in one of [set], [axes], [[zip]], "
                              "[latin_hypercube] and [one_at_a_time]",
                              key, first->second));
  };
  for (const auto& setting : plan.settings) note(setting.key, setting.where);
  for (const auto& block : plan.blocks)
    for (const auto& key : block.keys) note(key, block.where);
}

void refuse_too_many(const Plan& plan) {
  double items = plan.replicates;
  for (const auto& block : plan.blocks) items *= static_cast<double>(block.rows.size());
  if (items > static_cast<double>(kMostItems))
    fail(plan.source, fmt::format("{:.4g} items; a study has at most {}: take fewer values or a [latin_hypercube]",
                                  items, kMostItems));
}

// The contrasted value is that of one row of an axis or a zip.
void check_contrast(const Plan& plan, const Contrast& contrast) {
  std::vector<std::string> contrastable;
  for (const auto& block : plan.blocks) {
    if (block.kind != Block::Kind::kValues) continue;
    contrastable.insert(contrastable.end(), block.keys.begin(), block.keys.end());
    const auto at = std::find(block.keys.begin(), block.keys.end(), contrast.key);
    if (at == block.keys.end()) continue;
    std::vector<std::string> values;
    for (const auto& row : block.rows) values.push_back(row[static_cast<std::size_t>(at - block.keys.begin())]);
    for (const auto& value : {contrast.value, contrast.against}) {
      const auto count = std::count(values.begin(), values.end(), value);
      if (count == 1) continue;
      fail(contrast.where, fmt::format("contrast: {} = {} {}; values of the axis: {}", contrast.key, shortened(value),
                                       count == 0 ? "is no value of the axis" : "stands in several rows of the zip",
                                       fmt::join(values, ", ")));
    }
    if (contrast.value == contrast.against) fail(contrast.where, "contrast: \"value\" and \"against\" are the same");
    return;
  }
  const auto near = nearest(contrast.key, contrastable);
  fail(contrast.where, fmt::format("contrast: {} is no axis{} Keys of [axes] and [[zip]]: {}", shortened(contrast.key),
                                   near.empty() ? "." : fmt::format("; did you mean {}?", near),
                                   contrastable.empty() ? "none" : fmt::format("{}", fmt::join(contrastable, ", "))));
}

void add_contrasts(Plan& plan, const toml::table& file) {
  for (const auto* table : tables_at(file, "contrasts", plan.source)) {
    const auto where = place(*table, plan.source);
    refuse_other_names(*table, {"key", "value", "against"}, "contrast", plan.source);
    const auto* key = table->get("key");
    const auto *value = table->get("value"), *against = table->get("against");
    if (!key || !key->is_string() || !value || !against)
      fail(where,
           "contrast: needs \"key\", a key of [axes] or [[zip]] in quotes, and two of its values: \"value\" "
           "and \"against\"");
    plan.contrasts.push_back({*key->value<std::string>(), value_of(*value, "contrast", where),
                              value_of(*against, "contrast", where), where});
    check_contrast(plan, plan.contrasts.back());
  }
}

toml::table parse(const std::string& text, const std::string& source) {
  refuse_other_than_utf8(text, source);
  try {
    return toml::parse(text, source);
  } catch (const toml::parse_error& e) {
    fail(fmt::format("{}:{}", source, e.source().begin.line),
         fmt::format("not valid TOML: {}", shortened(e.description(), 200)));
  }
}

void read_head(Plan& plan, const toml::table& file) {
  const auto* base = file.get("base");
  if (!base) fail(plan.source, "no \"base\": a plan begins with base = \"osb\", a ready case or a case file beside it");
  if (!base->is_string() || base->value<std::string>()->empty())
    fail(place(*base, plan.source), "base must be a text: the name of a ready case or of a case file beside the plan");
  plan.base = *base->value<std::string>();
  if (const auto* node = file.get("replicates"))
    plan.replicates = static_cast<int>(whole_in(file, "replicates", 1, kMostItems, "plan", place(*node, plan.source)));
  if (const auto* node = file.get("base_seed"))
    plan.base_seed = static_cast<std::uint64_t>(whole_in(
        file, "base_seed", 0, INT64_MAX - static_cast<std::int64_t>(kMostItems), "plan", place(*node, plan.source)));
}

}  // namespace

Plan plan_from_text(const std::string& text, const std::string& source, const fs::path& folder) {
  const auto file = parse(text, source);
  Plan plan;
  plan.text = text;
  plan.source = source;
  plan.folder = folder;
  refuse_other_names(file, kTopKeys, "plan", source);
  read_head(plan, file);
  add_settings(plan, file);
  add_axes(plan, file);
  add_zips(plan, file);
  add_latin_hypercube(plan, file);
  add_one_at_a_time(plan, file);
  refuse_keys_twice(plan);
  refuse_too_many(plan);
  add_contrasts(plan, file);
  return plan;
}

Plan read_plan(const fs::path& file) {
  std::error_code error;
  const auto text = fs::is_directory(file, error) ? std::nullopt : files::read_text(file);
  if (!text)
    throw InputError(
        fmt::format("{}: no such plan file, or it cannot be read; docs/studies.md shows one", file.string()));
  return plan_from_text(*text, file.string(), fs::absolute(file).parent_path());
}

std::vector<std::string> varied_keys(const Plan& plan) {
  std::vector<std::string> keys;
  for (const auto& block : plan.blocks) keys.insert(keys.end(), block.keys.begin(), block.keys.end());
  return keys;
}

std::vector<std::vector<std::size_t>> cells_of(const Plan& plan) {
  std::vector<std::vector<std::size_t>> cells{{}};
  for (const auto& block : plan.blocks) {
    std::vector<std::vector<std::size_t>> longer;
    for (const auto& cell : cells) {
      for (std::size_t row = 0; row < block.rows.size(); ++row) {
        longer.push_back(cell);
        longer.back().push_back(row);
      }
    }
    cells = std::move(longer);
  }
  return cells;
}

std::vector<std::string> values_of(const Plan& plan, const std::vector<std::size_t>& cell) {
  std::vector<std::string> values;
  for (std::size_t b = 0; b < plan.blocks.size(); ++b) {
    const auto& row = plan.blocks[b].rows[cell[b]];
    values.insert(values.end(), row.begin(), row.end());
  }
  return values;
}

std::string shown(const std::string& value) {
  const bool quoted =
      value.size() >= 2 && (value.front() == '"' || value.front() == '\'') && value.back() == value.front();
  return quoted ? value.substr(1, value.size() - 2) : value;
}

}  // namespace strandlab::study
