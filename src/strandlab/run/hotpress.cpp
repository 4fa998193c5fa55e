#include "strandlab/run/hotpress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>

#include "strandlab/case/hotpress.hpp"
#include "strandlab/case/write.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/core/version.hpp"
#include "strandlab/files/atomic_file.hpp"
#include "strandlab/files/json_text.hpp"
#include "strandlab/report/hotpress_results.hpp"
#include "strandlab/run/commit.hpp"

namespace strandlab::run {
namespace {

namespace fs = std::filesystem;

constexpr std::array kFiles{"case.toml", "hotpress.csv", "transfer_profiles.csv", "transfer_section.csv", "run.json"};

// Results of `strandlab run` are no hot press of ours to replace: their run.json knows of panels.
void refuse_folder(const fs::path& folder, bool force) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw InputError(fmt::format("{}: this is a file, not a folder; choose another with -o", folder.string()));
  const auto there = [&](const char* name) { return fs::exists(folder / name, error); };
  if (std::none_of(kFiles.begin(), kFiles.end(), there)) return;
  if (there("run.json")) {
    const auto record = files::read_json(folder / "run.json", "the record of a hot press");
    if (!record.is_object() || record.contains("steps"))
      throw InputError(
          fmt::format("{}: holds the panels of strandlab run; choose another folder with -o", folder.string()));
  }
  if (!force)
    throw InputError(
        fmt::format("{}: has results already; --force replaces them, -o chooses another folder", folder.string()));
}

std::vector<std::string> remarks_on(const cases::Case& c) {
  std::vector<std::string> list;
  if (!c.hotpress.given) list.push_back("the case has no [hotpress]: the default cycle is pressed (docs/hotpress.md)");
  for (const auto& kind : c.kinds) {
    if (kind.law != wood::Law::kHill) continue;
    list.push_back(
        fmt::format("kinds.{} has law = \"hill\", under which no density profile emerges; the column takes the "
                    "crushing constants of its material",
                    kind.name));
  }
  return list;
}

void write(const HotPressed& pressed, cases::Case c, const fs::path& folder) {
  files::make_folder(folder);
  fs::remove(folder / "run.json");  // written last again: a kill in between leaves no record beside other results
  c.hotpress.given = true;          // the file shows all keys that were used
  files::write_atomically(folder / "case.toml", cases::resolved_text(c));
  report::write_hotpress_tables(pressed.band.cycle, folder);
  const nlohmann::json record{{"strandlab", version()},
                              {"git", git_commit()},
                              {"hotpress", report::to_json(pressed.band)},
                              {"warnings", pressed.notes}};
  files::write_atomically(folder / "run.json", record.dump(2) + "\n");
}

}  // namespace

HotPressed hotpress(const cases::Case& c, Observer& observer) {
  HotPressed pressed;
  pressed.notes = remarks_on(c);
  const auto settings = cases::hotpress_settings(c);
  const double whole = std::max(1., hotpress::duration(settings));
  const auto told = [&](int cycle, const hotpress::Instant& now) {
    stop_if_cancelled(observer);
    observer.progress({"hotpress", (cycle + std::clamp(now.time / whole, 0., 1.)) / hotpress::kCyclesOfBand,
                       fmt::format("cycle {} of {}, {:.0f} s", cycle + 1, hotpress::kCyclesOfBand, now.time)});
  };
  pressed.band = hotpress::press_in_band(settings, cases::pressed_mat(c, cases::make_mat(c)), told);
  const auto& warnings = pressed.band.cycle.warnings;
  pressed.notes.insert(pressed.notes.end(), warnings.begin(), warnings.end());
  for (const auto& remark : hotpress::remarks(pressed.band.cycle, pressed.band.answers))
    pressed.notes.push_back(remark);
  return pressed;
}

HotPressed hotpress(const cases::Case& c, const Place& place, Observer& observer) {
  refuse_folder(place.folder, place.force);
  auto pressed = hotpress(c, observer);
  write(pressed, c, place.folder);
  return pressed;
}

}  // namespace strandlab::run
