#include "strandlab/study/folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <sstream>
#include <system_error>
#include <utility>

#include "strandlab/case/write.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/core/text.hpp"
#include "strandlab/files/atomic_file.hpp"
#include "strandlab/files/csv.hpp"
#include "strandlab/files/text_file.hpp"

namespace strandlab::study {
namespace {

namespace fs = std::filesystem;

// Columns of plan.csv before those of the varied keys; no cell of theirs needs quotes.
const std::vector<std::string> kPlanColumns{"item", "hash",        "pressing",    "replicate",
                                            "seed", "estimated_s", "estimated_MB"};

template <class Number>
bool read_number(const std::string& text, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

bool is_hash(const std::string& text) {
  return text.size() == 16 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

// The first cells of a line; nothing where they are not what plan_text() writes.
bool read_item(const std::string& line, Item& item) {
  std::istringstream cells(line);
  std::vector<std::string> cell(kPlanColumns.size());
  for (auto& text : cell) std::getline(cells, text, ',');
  double megabytes = 0;
  item.hash = cell[1];
  item.pressing = cell[2];
  const bool valid = read_number(cell[0], item.number) && is_hash(item.hash) && is_hash(item.pressing) &&
                     read_number(cell[3], item.replicate) && read_number(cell[4], item.seed) &&
                     read_number(cell[5], item.seconds) && read_number(cell[6], megabytes);
  item.bytes = 1e6 * megabytes;
  return valid;
}

// The items of plan.csv, without their values, and their lines; up to the first line that is none.
struct Rows {
  std::vector<Item> items;
  std::vector<std::string> lines;
  bool all_read = true;
};

Rows read_rows(const std::string& table) {
  Rows rows;
  std::istringstream lines(table);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    Item item;
    rows.all_read = read_item(line, item) && item.number == static_cast<int>(rows.items.size()) + 1;
    if (!rows.all_read) break;
    rows.items.push_back(std::move(item));
    rows.lines.push_back(line);
  }
  return rows;
}

// The hashes are in plan.csv, all else follows from plan.toml.
std::vector<Item> read_items(const Plan& plan, const fs::path& file) {
  const auto text = files::read_text(file);
  if (!text) throw InputError(fmt::format("{}: missing; strandlab study plan writes it", file.string()));
  auto rows = read_rows(*text);
  const auto cells = cells_of(plan);
  const auto all = cells.size() * static_cast<std::size_t>(plan.replicates);
  if (!rows.all_read || rows.items.size() != all) {
    throw InputError(
        fmt::format("{}: not the {} items of the plan beside it, {} are read; strandlab study plan writes "
                    "this file again",
                    file.string(), all, rows.items.size()));
  }
  for (std::size_t i = 0; i < all; ++i) rows.items[i].values = values_of(plan, cells[i % cells.size()]);
  return std::move(rows.items);
}

// A study has a plan.csv. What else may be there: items and pressings of other machines, what a kill left, and this
// very plan.
void refuse_foreign_folder(const fs::path& folder, const Plan& plan) {
  std::error_code error;
  const auto status = fs::status(folder, error);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status))
    throw InputError(fmt::format("{}: this is not a folder; choose another with -o", folder.string()));
  if (fs::exists(folder / "plan.csv", error)) return;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const auto name = entry.path().filename();
    const bool ours = name == "items" || name == "pressings" || files::is_temporary(name);
    if (ours || (name == "plan.toml" && files::read_text(entry.path()) == plan.text)) continue;
    throw InputError(
        fmt::format("{}: this folder holds files but no study (no plan.csv); choose an empty or a new "
                    "one with -o",
                    folder.string()));
  }
  if (error) throw InputError(fmt::format("{}: cannot read this folder: {}", folder.string(), error.message()));
}

// A changed plan extends a study. One that lacks its pressings is another study's, or would leave them behind.
void refuse_other_plan(const fs::path& folder, const std::vector<PlannedItem>& items) {
  const auto table = files::read_text(folder / "plan.csv");
  if (!table) return;
  std::set<std::string> here, lost;
  for (const auto& planned : items) here.insert(planned.item.pressing);
  const auto there = read_rows(*table);
  std::string first;
  for (std::size_t i = 0; i < there.items.size(); ++i) {
    if (here.contains(there.items[i].pressing)) continue;
    lost.insert(there.items[i].pressing);
    if (first.empty()) first = there.lines[i];
  }
  if (lost.empty()) return;
  throw InputError(
      fmt::format("{}: holds the study of another plan: {} of its pressings are not in this one, the first in the line "
                  "\"{}\" of plan.csv. A plan may be given more values, replicates, tests and glues; choose another "
                  "folder with -o for one that has other cases",
                  folder.string(), lost.size(), shortened(first, 120)));
}

}  // namespace

std::string plan_text(const Plan& plan, const std::vector<PlannedItem>& items) {
  auto columns = kPlanColumns;
  const auto keys = varied_keys(plan);
  columns.insert(columns.end(), keys.begin(), keys.end());
  files::CsvTable table(columns);
  for (const auto& planned : items) {
    const auto& item = planned.item;
    std::vector<files::CsvCell> row{static_cast<long long>(item.number), item.hash, item.pressing,
                                    static_cast<long long>(item.replicate), static_cast<long long>(item.seed)};
    row.emplace_back(fmt::format("{:.3g}", item.seconds));
    row.emplace_back(fmt::format("{:.0f}", item.bytes / 1e6));
    for (const auto& value : item.values) row.emplace_back(shown(value));
    table.add_row(std::move(row));
  }
  return table.text();
}

Study study_of(const Plan& plan, const std::vector<PlannedItem>& items, const fs::path& folder) {
  Study study{folder, plan, {}};
  for (const auto& planned : items) study.items.push_back(planned.item);
  return study;
}

Study write_study(const Plan& plan, const std::vector<PlannedItem>& items, const fs::path& folder) {
  refuse_foreign_folder(folder, plan);
  refuse_other_plan(folder, items);
  auto study = study_of(plan, items, folder);
  files::make_folder(folder);
  files::remove_abandoned(folder);
  for (const auto& planned : items) {
    const auto place = study.item_folder(planned.item);
    files::make_folder(place);
    files::remove_abandoned(place, "case.toml.");
    if (files::read_text(place / "case.toml") != planned.case_text)
      files::write_atomically(place / "case.toml", planned.case_text);
  }
  files::write_atomically(study.file("plan.csv"), plan_text(plan, items));
  files::write_atomically(study.file("plan.toml"), plan.text);
  return study;
}

Study open_study(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder / "plan.toml", error))
    throw InputError(
        fmt::format("{}: holds no study (no plan.toml); strandlab study plan PLAN -o DIR makes one", folder.string()));
  auto plan = read_plan(folder / "plan.toml");
  auto items = read_items(plan, folder / "plan.csv");
  return {folder, std::move(plan), std::move(items)};
}

const Item& find_item(const Study& study, const std::string& name) {
  int number = 0;
  const bool numbered = read_number(name, number);
  const auto found = std::find_if(study.items.begin(), study.items.end(), [&](const Item& item) {
    return numbered && name.size() < 16 ? item.number == number : item.hash == name;
  });
  if (found != study.items.end()) return *found;
  throw InputError(fmt::format("{}: no item \"{}\"; items are 1 to {}, or hashes of plan.csv", study.folder.string(),
                               shortened(name), study.items.size()));
}

cases::Case read_item_case(const Study& study, const Item& item) {
  const auto file = study.item_folder(item) / "case.toml";
  auto c = cases::read_case(file);
  if (cases::case_hash(c, cases::Step::kTest) == item.hash) return c;
  throw InputError(
      fmt::format("{}: not the case of item {} any more: changed by hand, or other keys of another version; "
                  "strandlab study plan writes it again",
                  file.string(), item.number));
}

}  // namespace strandlab::study
