#include "strandlab/study/item.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <new>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "strandlab/case/estimate.hpp"
#include "strandlab/case/write.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/core/text.hpp"
#include "strandlab/core/version.hpp"
#include "strandlab/files/atomic_file.hpp"
#include "strandlab/files/json_text.hpp"
#include "strandlab/io/checkpoint.hpp"
#include "strandlab/report/density_profiles.hpp"
#include "strandlab/report/result_tables.hpp"
#include "strandlab/run/log.hpp"
#include "strandlab/run/press.hpp"
#include "strandlab/run/profile_bins.hpp"
#include "strandlab/run/record.hpp"

namespace strandlab::study {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

fs::path record_file(const Study& study, const Item& item) {
  return study.item_folder(item) / "item.json";
}

void write_json(const Json& json, const fs::path& file) {
  files::write_atomically(file, json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

Json to_json(const std::vector<run::KeptState>& states) {
  auto list = Json::array();
  for (const auto& s : states)
    list.push_back(
        {{"compaction", s.compaction}, {"thickness_mm", s.thickness_mm}, {"density_kg_m3", s.density_kg_m3}});
  return list;
}

void write_record(const ItemRecord& record, const Study& study, const Item& item) {
  Json json{{"strandlab", version()},           {"hash", item.hash},
            {"pressing", item.pressing},        {"whole", record.whole},
            {"states", to_json(record.states)}, {"tested", run::to_json(record.tested)}};
  if (!record.error.empty()) json["error"] = as_text(record.error);
  write_json(json, record_file(study, item));
}

// ---- The pressing ---------------------------------------------------------------------------------------------------

// A folder of pressings/: the panels of a case, whoever tests them.
class Pressing {
 public:
  Pressing(fs::path folder, const run::Formed& formed)
      : folder_(std::move(folder)),
        formed_(formed),
        hash_(cases::case_hash(formed.c, cases::Step::kPress)),
        store_(folder_, hash_) {}

  bool is_whole() const {
    std::error_code error;
    return fs::exists(folder_ / "pressing.json", error) &&
           std::all_of(compactions().begin(), compactions().end(),
                       [&](double compaction) { return fs::exists(panel_file(compaction), error); });
  }

  void press(run::Observer& observer) const {
    const auto resume = newest_checkpoint(observer);
    files::make_folder(folder_ / "panels");
    const auto outcome = run::press(formed_, keep(), resume, observer);
    write_tables(outcome);
    write_json({{"strandlab", version()},
                {"hash", hash_},
                {"compactions", compactions()},
                {"steps", outcome.steps},
                {"wall_s", outcome.wall_s},
                {"warnings", outcome.warnings}},
               folder_ / "pressing.json");
    remove_checkpoints();
  }

  // Throws InputError for a file that cannot be used.
  Panel<2> panel(double compaction) const { return io::read_panel<2>(panel_file(compaction), hash_); }

  // What the next press() starts from is the mat.
  void forget() const {
    fs::remove(folder_ / "pressing.json");
    remove_checkpoints();
  }

 private:
  const std::vector<double>& compactions() const { return formed_.c.schedule.compactions; }
  fs::path panel_file(double compaction) const { return folder_ / "panels" / fmt::format("panel_{}.h5", compaction); }

  void remove_checkpoints() const {
    fs::remove(store_.newest());
    fs::remove(store_.previous());
  }

  // A kill may leave none that is whole only where a disk lies; then the item begins again, and no other is touched.
  std::optional<press::Checkpoint<2>> newest_checkpoint(run::Observer& observer) const {
    std::vector<std::string> warnings;
    std::optional<press::Checkpoint<2>> resume;
    try {
      resume = store_.load<2>(&warnings);
    } catch (const InputError& e) {
      warnings.push_back(fmt::format("{}; the pressing begins again", e.what()));
      remove_checkpoints();
    }
    for (const auto& warning : warnings) observer.warn(warning);
    return resume;
  }

  press::Sink<2> keep() const {
    press::Sink<2> sink;
    sink.snapshot = [this](const Panel<2>& panel, int index) {
      io::write_panel(panel, hash_, panel_file(compactions()[static_cast<std::size_t>(index)]));
    };
    sink.checkpoint = [this](const press::Checkpoint<2>& checkpoint) { store_.save(checkpoint); };
    sink.checkpoint_interval_s = formed_.c.checkpoint_interval_s;
    return sink;
  }

  void write_tables(const press::Outcome<2>& outcome) const {
    report::press_table(outcome.records).write(folder_ / "press.csv");
    std::vector<profile::Profile> profiles;
    for (const double compaction : compactions()) {
      const auto kept = panel(compaction);
      profiles.push_back(profile::density_profile(kept, run::bins_of_one_cell(formed_.c, kept, compaction)));
      profiles.back().compaction = compaction;
    }
    report::profile_table(profiles).write(folder_ / "profile.csv");
  }

  fs::path folder_;
  const run::Formed& formed_;
  std::string hash_;
  io::CheckpointStore store_;
};

// What a kill left half written.
void remove_temporaries(const fs::path& folder) {
  std::vector<fs::path> temporaries;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (files::is_temporary(entry.path())) temporaries.push_back(entry.path());
  for (const auto& file : temporaries) fs::remove(file);
}

void press_if_needed(const Pressing& pressing, const fs::path& folder, std::optional<Claim> claim,
                     run::Observer& observer) {
  if (pressing.is_whole()) return;
  if (!claim) claim.emplace(Claim::wait(folder));
  if (pressing.is_whole()) return;  // who was waited for has done it
  remove_temporaries(folder);
  pressing.press(observer);
}

// A panel that cannot be read any more is pressed again: the results are the same bits.
Panel<2> panel_of(const Pressing& pressing, const fs::path& folder, double compaction, run::Observer& observer) {
  try {
    return pressing.panel(compaction);
  } catch (const InputError& e) {
    observer.warn(fmt::format("{}; the item is pressed again", e.what()));
  }
  {
    const auto claim = Claim::wait(folder);
    pressing.forget();
  }
  press_if_needed(pressing, folder, std::nullopt, observer);
  return pressing.panel(compaction);
}

// ---- The item -------------------------------------------------------------------------------------------------------

void test_states(const Study& study, const Item& item, const run::Formed& formed, const Pressing& pressing,
                 ItemRecord& record, run::Observer& observer) {
  const auto& compactions = formed.c.schedule.compactions;
  record.states = run::kept_states(formed);
  for (auto i = record.tested.size(); i < compactions.size(); ++i) {
    run::tell_progress(formed.c, i, observer);
    const auto panel = panel_of(pressing, study.pressing_folder(item), compactions[i], observer);
    record.tested.push_back(run::test(formed.c, panel, compactions[i], observer));
    record.tested.back().result.slips.clear();
    if (i + 1 < compactions.size()) write_record(record, study, item);
  }
  run::refuse_if_none_is_testable(record.tested);
  record.whole = true;
  write_record(record, study, item);
}

// The panels of a pressing that no item of the plan needs any more.
void drop_panels(const Study& study, const Item& item) {
  for (const auto& other : study.items)
    if (other.pressing == item.pressing && !read_record(study, other).whole) return;
  const auto folder = study.pressing_folder(item);
  const auto claim = Claim::wait(folder);
  fs::remove_all(folder / "panels");
}

void run_claimed(const Study& study, const Item& item, const Work& work, std::optional<Claim> claim,
                 run::Observer& observer) {
  auto record = read_record(study, item);
  if (!record.whole) {
    record.error.clear();
    remove_temporaries(study.item_folder(item));
    auto c = read_item_case(study, item);
    c.threads = work.threads;
    const auto formed = run::form(std::move(c));
    run::refuse_untestable(formed);
    const auto folder = study.pressing_folder(item);
    files::make_folder(folder);
    const Pressing pressing(folder, formed);
    if (record.tested.size() < formed.c.schedule.compactions.size())
      press_if_needed(pressing, folder, std::exchange(claim, std::nullopt), observer);
    test_states(study, item, formed, pressing, record, observer);
  }
  claim.reset();
  if (work.keep == Keep::kModuli) drop_panels(study, item);
}

std::vector<run::KeptState> states_from(const Json& list) {
  std::vector<run::KeptState> states;
  for (const auto& s : list) states.push_back({s.at("compaction"), s.at("thickness_mm"), s.at("density_kg_m3")});
  return states;
}

}  // namespace

ItemRecord read_record(const Study& study, const Item& item) {
  const auto file = record_file(study, item);
  std::error_code error;
  if (!fs::exists(file, error)) return {};
  ItemRecord record;
  try {
    const auto json = files::read_json(file, "the record of a study's item");
    record.tested = run::tested_from_json(json.at("tested"));
    record.states = states_from(json.at("states"));
    record.error = json.value("error", "");
    record.whole = json.at("whole").get<bool>();
    if (json.at("hash") == item.hash && (!record.whole || record.tested.size() == record.states.size())) return record;
    record.error = fmt::format("{}: the record of another item", file.string());
  } catch (const InputError& e) {
    record.error = e.what();
  } catch (const Json::exception& e) {
    record.error = fmt::format("{}: not the record of a study's item ({})", file.string(), e.what());
  }
  return {false, record.error, {}, {}};
}

void record_failure(const Study& study, const Item& item, const std::string& error) {
  auto record = read_record(study, item);
  record.whole = false;
  record.error = error;
  write_record(record, study, item);
}

void try_to_record_failure(const Study& study, const Item& item, const std::string& error, run::Observer& observer) {
  try {
    record_failure(study, item, error);
  } catch (const std::exception& e) {
    observer.warn(fmt::format("item {}: the error cannot be recorded: {}", item.number, e.what()));
  }
}

void run_item(const Study& study, const Item& item, const Work& work, std::optional<Claim> pressing,
              run::Observer& observer) {
  files::make_folder(study.item_folder(item));
  run::Log log(observer);
  try {
    log.open(study.item_folder(item) / "log.txt");
    run_claimed(study, item, work, std::move(pressing), log);
  } catch (const Cancelled&) {
    throw;
  } catch (const std::exception& e) {
    log.keep_error(e.what());
    try_to_record_failure(study, item, dynamic_cast<const std::bad_alloc*>(&e) ? "out of memory" : e.what(), log);
    throw;
  }
}

}  // namespace strandlab::study
