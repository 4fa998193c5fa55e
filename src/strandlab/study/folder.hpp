// The folder of a study: the plan, its items by number, and by the hashes of their cases what was made of them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "strandlab/case/case.hpp"
#include "strandlab/study/items.hpp"
#include "strandlab/study/plan.hpp"

namespace strandlab::study {

//   plan.toml, plan.csv           what was asked for, and the items
//   items/HASH/                   case.toml, item.json: moduli, or the error; log.txt
//   pressings/HASH/               pressing.json, press.csv, profile.csv, panels/, checkpoints while it presses
// Folders of items and pressings hold nothing that depends on the plan: copied into another study's folder they are
// its results where the cases are the same.
struct Study {
  std::filesystem::path folder;
  Plan plan;
  std::vector<Item> items;

  std::filesystem::path file(const std::string& name) const { return folder / name; }
  std::filesystem::path item_folder(const Item& item) const { return folder / "items" / item.hash; }
  std::filesystem::path pressing_folder(const Item& item) const { return folder / "pressings" / item.pressing; }
};

// plan.csv as text.
std::string plan_text(const Plan& plan, const std::vector<PlannedItem>& items);

// The study that write_study() would make of the folder; nothing is written or read.
Study study_of(const Plan& plan, const std::vector<PlannedItem>& items, const std::filesystem::path& folder);

// Writes the plan into the folder, made where it is missing; a folder that holds a study is extended. Throws
// InputError, with nothing written, for a folder that holds something else, or pressings that the new plan lacks.
Study write_study(const Plan& plan, const std::vector<PlannedItem>& items, const std::filesystem::path& folder);

// The study of a folder. Throws InputError for one without a plan, and for plan.csv that is not of this plan.toml.
Study open_study(const std::filesystem::path& folder);

// An item by its number in plan.csv, or by its hash. Throws InputError for another name.
const Item& find_item(const Study& study, const std::string& name);

// The case of an item. Throws InputError for a file that is missing or not the case of that hash.
cases::Case read_item_case(const Study& study, const Item& item);

}  // namespace strandlab::study
