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

// The hashes are in plan.csv, all else follows from plan.toml. A text with a line break in a value cannot be in it.
std::vector<Item> read_items(const Plan& plan, const fs::path& file) {
  const auto text = files::read_text(file);
  if (!text) throw InputError(fmt::format("{}: missing; strandlab study plan writes it", file.string()));
  const auto cells = cells_of(plan);
  const auto all = cells.size() * static_cast<std::size_t>(plan.replicates);
  std::istringstream lines(*text);
  std::string line;
  std::getline(lines, line);
  std::vector<Item> items;
  while (std::getline(lines, line)) {
    Item item;
    if (!read_item(line, item) || items.size() == all || item.number != static_cast<int>(items.size()) + 1) {
      throw InputError(
          fmt::format("{}:{}: not an item of the plan beside it; strandlab study plan writes this file "
                      "again",
                      file.string(), items.size() + 2));
    }
    item.values = values_of(plan, cells[items.size() % cells.size()]);
    items.push_back(std::move(item));
  }
  if (items.size() == all) return items;
  throw InputError(fmt::format("{}: {} items, the plan beside it has {}; strandlab study plan writes this file again",
                               file.string(), items.size(), all));
}

void refuse_foreign_folder(const fs::path& folder) {
  std::error_code error;
  const auto status = fs::status(folder, error);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status))
    throw InputError(fmt::format("{}: this is not a folder; choose another with -o", folder.string()));
  if (fs::exists(folder / "plan.toml", error)) return;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().filename() == "items" || entry.path().filename() == "pressings" ||
        files::is_temporary(entry.path()))
      continue;
    throw InputError(
        fmt::format("{}: this folder holds files but no study (no plan.toml); choose an empty or a new "
                    "one with -o",
                    folder.string()));
  }
  if (error) throw InputError(fmt::format("{}: cannot read this folder: {}", folder.string(), error.message()));
}

// A changed plan extends a study. One that lacks its pressings is another study's, or would leave them behind.
void refuse_other_plan(const fs::path& folder, const std::vector<PlannedItem>& items) {
  std::error_code error;
  if (!fs::exists(folder / "plan.toml", error) || !fs::exists(folder / "plan.csv", error)) return;
  std::set<std::string> here;
  for (const auto& planned : items) here.insert(planned.item.pressing);
  const auto there = open_study(folder);
  const Item* lost = nullptr;
  std::set<std::string> all_lost;
  for (const auto& item : there.items) {
    if (here.contains(item.pressing)) continue;
    all_lost.insert(item.pressing);
    if (!lost) lost = &item;
  }
  if (!lost) return;
  std::string which;
  const auto keys = varied_keys(there.plan);
  for (std::size_t k = 0; k < keys.size(); ++k)
    which += fmt::format(", {} = {}", keys[k], lost->values[k].empty() ? "as the base" : shortened(lost->values[k]));
  throw InputError(
      fmt::format("{}: holds the study of another plan: {} of its pressings are not in this one, the first "
                  "of item {}{}, seed {}. A plan may be given more values, replicates, tests and glues; "
                  "choose another folder with -o for one that has other cases",
                  folder.string(), all_lost.size(), lost->number, which, lost->seed));
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

Study write_study(const Plan& plan, const std::vector<PlannedItem>& items, const fs::path& folder) {
  refuse_foreign_folder(folder);
  refuse_other_plan(folder, items);
  Study study{folder, plan, {}};
  for (const auto& planned : items) {
    study.items.push_back(planned.item);
    const auto place = study.item_folder(planned.item);
    files::make_folder(place);
    if (files::read_text(place / "case.toml") != planned.case_text)
      files::write_atomically(place / "case.toml", planned.case_text);
  }
  files::write_atomically(study.file("plan.toml"), plan.text);
  files::write_atomically(study.file("plan.csv"), plan_text(plan, items));
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
