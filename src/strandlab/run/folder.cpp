#include "strandlab/run/folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <initializer_list>
#include <utility>

#include "strandlab/core/error.hpp"
#include "strandlab/core/text.hpp"
#include "strandlab/core/version.hpp"
#include "strandlab/files/atomic_file.hpp"
#include "strandlab/files/json_text.hpp"

namespace strandlab::run {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::array kSteps{cases::Step::kMat, cases::Step::kPress, cases::Step::kTest, cases::Step::kPage};

const char* name_of_step(cases::Step step) {
  static constexpr std::array names{"mat", "press", "test", "page"};
  return names[static_cast<std::size_t>(step)];
}

// Files of a step that later ones and the user count on.
std::vector<std::string> tables_of(cases::Step step) {
  switch (step) {
    case cases::Step::kMat:
      return {"mat.json"};
    case cases::Step::kPress:
      return {"press.csv", "morphology.csv", "histograms.csv", "profile.csv", "profile_summary.csv"};
    case cases::Step::kTest:
      return {"moduli.csv", "theory.csv"};
    case cases::Step::kPage:
      break;
  }
  return {"report.html"};
}

// Files and folders that a step leaves.
std::vector<std::string> results_of(cases::Step step) {
  auto names = tables_of(step);
  const auto add = [&names](std::initializer_list<const char*> more) {
    names.insert(names.end(), more.begin(), more.end());
  };
  if (step == cases::Step::kPress)
    add({"hotpress.csv", "transfer_profiles.csv", "transfer_section.csv", "density_map.csv", "horizontal_density.csv",
         "checkpoint.h5", "checkpoint.previous.h5", "panels", "frames", "paraview", "pictures"});
  if (step == cases::Step::kTest) add({"abd.csv", "plots", "glue_lines"});
  return names;
}

// The nearest folder above that exists: where a new folder would be made.
fs::path existing_part(fs::path folder) {
  std::error_code error;
  while (!folder.empty() && !fs::exists(folder, error) && folder != folder.parent_path()) folder = folder.parent_path();
  return folder;
}

void refuse_unwritable(const fs::path& folder, double needed_bytes) {
  std::error_code error;
  if (fs::status(folder, error).type() == fs::file_type::none) {  // neither there nor not: a loop, or too long a name
    throw InputError(
        fmt::format("{}: cannot be a run folder: {}; choose another with -o", folder.string(), error.message()));
  }
  const auto existing = existing_part(fs::absolute(folder));
  if (!fs::is_directory(existing)) {
    throw InputError(
        fmt::format("{}: cannot make this run folder: {} is not a folder", folder.string(), existing.string()));
  }
  if (::faccessat(AT_FDCWD, existing.c_str(), W_OK | X_OK, AT_EACCESS) != 0) {
    throw InputError(fmt::format("{}: cannot write to {}: {}; choose another run folder with -o", folder.string(),
                                 existing.string(), std::strerror(errno)));
  }
  const auto space = fs::space(existing, error);
  if (!error && static_cast<double>(space.available) < needed_bytes) {
    throw InputError(fmt::format("{}: the run needs about {:.0f} MB of disk space, {:.0f} MB are free", folder.string(),
                                 needed_bytes / 1e6, static_cast<double>(space.available) / 1e6));
  }
}

// Holds as long as the descriptor is open, also over a kill -9. `operation` is LOCK_EX, or LOCK_SH for what several may
// do at once.
int lock_folder(const fs::path& folder, int operation) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor >= 0 && ::flock(descriptor, operation | LOCK_NB) == 0) return descriptor;
  const int reason = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (reason == EWOULDBLOCK)
    throw InputError(fmt::format("{}: another strandlab is running in this folder", folder.string()));
  throw InputError(fmt::format("{}: cannot open this run folder: {}", folder.string(), std::strerror(reason)));
}

bool is_step(const Json& step) {
  const auto plots = step.is_object() ? step.value("plots", Json::array()) : Json();
  return step.is_object() && (!step.contains("finished") || step["finished"].is_boolean()) && plots.is_array() &&
         std::all_of(plots.begin(), plots.end(), [](const Json& name) { return name.is_string(); });
}

// Older records have none.
bool has_states(const Json& record) {
  if (!record.contains("states")) return true;
  const auto& states = record["states"];
  return states.is_array() && std::all_of(states.begin(), states.end(), [](const Json& state) {
           return state.is_object() && state.contains("compaction") && state["compaction"].is_number() &&
                  state.contains("density_kg_m3") && state["density_kg_m3"].is_number();
         });
}

bool is_record(const Json& record) {
  return record.is_object() && record.contains("strandlab") && record.contains("case") && record["case"].is_array() &&
         std::all_of(record["case"].begin(), record["case"].end(), [](const Json& line) { return line.is_string(); }) &&
         has_states(record) && record.contains("steps") && record["steps"].is_object() &&
         std::all_of(record["steps"].begin(), record["steps"].end(), is_step);
}

Json read_record(const fs::path& file) {
  auto record = files::read_json(file, "the record of a strandlab run");
  if (!is_record(record))
    throw InputError(
        fmt::format("{}: not the record of a strandlab run; choose another folder with -o", file.string()));
  return record;
}

void save_record(const Json& record, const fs::path& folder) {
  files::write_atomically(folder / "run.json", record.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

std::vector<std::string> all_lines(const cases::Case& c) {
  return cases::identity(c, cases::Step::kTest);
}

// First lines in which two cases differ, up to three: "press.speed_m_s = 8 there, 16 here".
std::string differences(const std::vector<std::string>& there, const std::vector<std::string>& here) {
  std::vector<std::string> list;
  const auto key = [](const std::string& line) { return line.substr(0, line.find(" = ")); };
  const auto value = [](const std::string& line) { return line.substr(line.find(" = ") + 3); };
  for (const auto& line : here) {
    const auto same_key =
        std::find_if(there.begin(), there.end(), [&](const auto& other) { return key(other) == key(line); });
    if (same_key == there.end())
      list.push_back(fmt::format("{} only here", key(line)));
    else if (*same_key != line)
      list.push_back(fmt::format("{} = {} there, {} here", key(line), value(*same_key), value(line)));
  }
  for (const auto& line : there) {
    const bool known =
        std::any_of(here.begin(), here.end(), [&](const auto& other) { return key(other) == key(line); });
    if (!known) list.push_back(fmt::format("{} only there", key(line)));
  }
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, list.size()); ++i) text += (i ? "; " : "") + list[i];
  return list.size() > 3 ? text + fmt::format("; and {} more", list.size() - 3) : text;
}

// First step whose identity lines are not those of the record.
cases::Step first_changed(const std::vector<std::string>& recorded, const cases::Case& c) {
  for (const auto step : kSteps) {
    for (const auto& line : cases::identity(c, step)) {
      if (std::find(recorded.begin(), recorded.end(), line) == recorded.end()) return step;
    }
  }
  // Lines were only taken away: a kind or a material of the mat.
  return cases::Step::kMat;
}

}  // namespace

RunFolder::RunFolder(fs::path folder, const cases::Case& c, cases::Step first, bool force, double needed_bytes)
    : folder_(std::move(folder)) {
  refuse_unwritable(folder_, needed_bytes);
  refuse_foreign_folder();
  const bool exists = fs::exists(file("run.json"));
  if (exists) record_ = read_record(file("run.json"));
  if (exists && !force) refuse_other_case(c);
  if (first == cases::Step::kTest) refuse_unpressed(exists, c);
  files::make_folder(folder_);
  lock_ = lock_folder(folder_, LOCK_EX);
  if (exists && force) {
    const auto recorded = record_["case"].get<std::vector<std::string>>();
    erase_steps(recorded == all_lines(c) ? first : std::min(first, first_changed(recorded, c)));
  }
  if (!exists) record_ = {{"steps", Json::object()}};
  write_case(c);
  remove_leftovers();
}

RunFolder::~RunFolder() {
  if (lock_ >= 0) ::close(lock_);
}

RunFolder::RunFolder(RunFolder&& other) noexcept
    : folder_(std::move(other.folder_)), record_(std::move(other.record_)), lock_(std::exchange(other.lock_, -1)) {}

fs::path RunFolder::panel_file(double compaction) const {
  return folder_ / "panels" / fmt::format("panel_{}.h5", compaction);
}
fs::path RunFolder::paraview_file(double compaction) const {
  return folder_ / "paraview" / fmt::format("panel_{}.vtu", compaction);
}
fs::path RunFolder::frame_file(int index) const {
  return folder_ / "frames" / fmt::format("frame_{:02}.h5", index);
}
fs::path RunFolder::slip_file(double compaction) const {
  return folder_ / "glue_lines" / fmt::format("slip_{}.csv", compaction);
}
fs::path RunFolder::glue_line_file(double compaction) const {
  return folder_ / "glue_lines" / fmt::format("glue_{}.vtu", compaction);
}
fs::path RunFolder::picture_file(const std::string& what, double compaction) const {
  return folder_ / "pictures" / fmt::format("{}_{}.png", what, compaction);
}

Json& RunFolder::record(cases::Step step) {
  return record_["steps"][name_of_step(step)];
}

void RunFolder::save() const {
  save_record(record_, folder_);
}

bool RunFolder::finished(cases::Step step) const {
  const auto& steps = record_.at("steps");
  const auto found = steps.find(name_of_step(step));
  return found != steps.end() && found->value("finished", false);
}

void RunFolder::set_finished(cases::Step step) {
  record(step)["finished"] = true;
  save();
}

void RunFolder::add_plots(cases::Step step, const std::vector<fs::path>& files) {
  auto names = plots_of(step);
  for (const auto& file : files) names.insert(file.lexically_relative(folder_).string());
  record(step)["plots"] = names;
}

std::set<std::string> RunFolder::plots_of(cases::Step step) const {
  return record_.at("steps").value(name_of_step(step), Json::object()).value("plots", std::set<std::string>{});
}

std::vector<std::string> RunFolder::missing(cases::Step step, const cases::Case& c) const {
  auto names = tables_of(step);
  if (step == cases::Step::kPress) {
    for (const double compaction : c.schedule.compactions) {
      names.push_back(panel_file(compaction).lexically_relative(folder_).string());
      if (!c.pictures) continue;
      for (const char* what : {"grain_angle", "density"})
        names.push_back(picture_file(what, compaction).lexically_relative(folder_).string());
    }
  }
  if (c.pictures) {
    for (const auto& name : plots_of(step)) names.push_back(name);
    if (step == cases::Step::kTest && !record_.at("steps").at(name_of_step(step)).contains("plots"))
      names.emplace_back("plots");  // they were not asked for then
  }
  std::erase_if(names, [this](const std::string& name) { return fs::exists(file(name)); });
  return names;
}

// A folder with files but without run.json is not ours, whatever --force says.
void RunFolder::refuse_foreign_folder() const {
  std::error_code error;
  if (!fs::is_directory(folder_, error) || fs::exists(file("run.json"), error)) return;
  for (const auto& entry : fs::directory_iterator(folder_, error)) {
    if (entry.path().extension() != ".tmp") {
      throw InputError(
          fmt::format("{}: this folder holds files but no strandlab run (no run.json); choose an empty or a new one "
                      "with -o",
                      folder_.string()));
    }
  }
  if (error) throw InputError(fmt::format("{}: cannot read this folder: {}", folder_.string(), error.message()));
}

void RunFolder::refuse_other_case(const cases::Case& c) const {
  const auto recorded = record_["case"].get<std::vector<std::string>>();
  const auto here = all_lines(c);
  if (recorded == here) return;
  throw InputError(
      fmt::format("{}: this run folder holds the results of another case ({}); choose another folder with -o, or "
                  "--force to replace what differs",
                  folder_.string(), differences(recorded, here)));
}

// A command that only tests cannot press: it must find the panels of this case, and --force must not cost them.
void RunFolder::refuse_unpressed(bool exists, const cases::Case& c) const {
  if (!exists || !finished(cases::Step::kPress)) {
    throw InputError(
        fmt::format("{}: holds no pressed panel yet: strandlab press (or run) comes first", folder_.string()));
  }
  const auto recorded = record_["case"].get<std::vector<std::string>>();
  const auto here = all_lines(c);
  if (recorded == here || first_changed(recorded, c) == cases::Step::kTest) return;
  throw InputError(
      fmt::format("{}: holds the pressed panels of another case ({}), which strandlab test cannot press; strandlab run "
                  "--force replaces them, or choose another folder with -o",
                  folder_.string(), differences(recorded, here)));
}

void RunFolder::forget(cases::Step first) {
  erase_steps(first);
  save();
  remove_leftovers();
}

void RunFolder::erase_steps(cases::Step first) {
  for (const auto step : kSteps) {
    if (step >= first) record_["steps"].erase(name_of_step(step));
  }
}

// What a kill left half written, and files of steps that the record does not know: from before --force, or a page of
// another state. The record is saved first, so that a kill in between leaves no result without its case.
void RunFolder::remove_leftovers() const {
  for (const auto step : kSteps) {
    if (record_["steps"].contains(name_of_step(step))) continue;
    for (const auto& name : results_of(step)) fs::remove_all(file(name));
  }
  std::vector<fs::path> temporaries;
  for (const auto& entry : fs::recursive_directory_iterator(folder_, fs::directory_options::skip_permission_denied)) {
    if (files::is_temporary(entry.path())) temporaries.push_back(entry.path());
  }
  for (const auto& temporary : temporaries) fs::remove(temporary);
}

void RunFolder::write_case(const cases::Case& c) {
  record_["strandlab"] = version();
  record_["case_name"] = as_text(c.name);
  record_["case"] = all_lines(c);
  save();
  files::write_atomically(file("case.toml"), cases::resolved_text(c));
}

Json read_run_record(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder / "run.json", error))
    throw InputError(fmt::format("{}: holds no strandlab run (no run.json)", folder.string()));
  return read_record(folder / "run.json");
}

cases::Case read_run_case(const fs::path& folder) {
  auto c = cases::read_written_case(folder / "case.toml");
  c.schedule.compactions = c.states.compactions;
  if (!c.schedule.compactions.empty()) return c;
  const auto record = read_run_record(folder);
  for (const auto& state : record.value("states", Json::array())) c.schedule.compactions.push_back(state["compaction"]);
  if (c.schedule.compactions.empty())
    throw InputError(
        fmt::format("{}: has no \"states\": at which compactions the panel was kept", (folder / "run.json").string()));
  return c;
}

void write_page(const fs::path& folder, const std::function<void()>& write) {
  static_cast<void>(read_run_record(folder));
  struct Lock {
    int descriptor;
    ~Lock() { ::close(descriptor); }
  } const lock{lock_folder(folder, LOCK_SH)};
  auto record = read_record(folder / "run.json");
  write();
  record["steps"][name_of_step(cases::Step::kPage)]["finished"] = true;
  save_record(record, folder);
}

}  // namespace strandlab::run
