// The folder of a run: its files, which steps of the journey are done, and whose results they are.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "strandlab/case/case.hpp"
#include "strandlab/case/write.hpp"

namespace strandlab::run {

// Where results go.
struct Place {
  std::filesystem::path folder;
  bool force = false;  // results of the steps taken that are there already are replaced
};

class RunFolder {
 public:
  // Opens the folder of a case, made where it is missing; with `force` the steps from `first` on, or from the first
  // that another case changes, start again. Results of the same case are kept and built upon. Throws InputError, with
  // nothing written, for a folder that holds something else or another case's results (without `force`), that may not
  // be written, whose panels a command that starts at the test would need but does not find pressed, has less than
  // `needed_bytes` of space, or is in use by another run.
  RunFolder(std::filesystem::path folder, const cases::Case& c, cases::Step first, bool force, double needed_bytes);
  ~RunFolder();
  RunFolder(RunFolder&& other) noexcept;
  RunFolder& operator=(RunFolder&&) = delete;
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  const std::filesystem::path& path() const { return folder_; }
  std::filesystem::path file(const std::string& name) const { return folder_ / name; }
  // File of the panel at a compaction: "panels/panel_0.1.h5", "paraview/panel_0.1.vtu", "pictures/grain_angle_0.1.png".
  std::filesystem::path panel_file(double compaction) const;
  std::filesystem::path paraview_file(double compaction) const;
  std::filesystem::path frame_file(int index) const;              // "frames/frame_07.h5"
  std::filesystem::path slip_file(double compaction) const;       // "glue_lines/slip_0.1.csv"
  std::filesystem::path glue_line_file(double compaction) const;  // "glue_lines/glue_0.1.vtu"
  std::filesystem::path picture_file(const std::string& what, double compaction) const;

  // run.json: what is known of the run; save() replaces the file atomically.
  nlohmann::json& record() { return record_; }
  nlohmann::json& record(cases::Step step);
  void save() const;

  bool finished(cases::Step step) const;
  void set_finished(cases::Step step);
  // Files of the folder that were drawn in a step: missed like its tables where they have gone.
  void add_plots(cases::Step step, const std::vector<std::filesystem::path>& files);
  // Tables, panels, pictures and plots of a finished step of this case that are no longer in the folder, by name.
  std::vector<std::string> missing(cases::Step step, const cases::Case& c) const;
  // The steps from `first` on are undone and what they left is removed. A step does this to the page before it changes
  // what the page shows, so that no page is ever taken for that of other results.
  void forget(cases::Step first);

 private:
  void refuse_foreign_folder() const;
  void refuse_other_case(const cases::Case& c) const;
  void refuse_unpressed(bool exists, const cases::Case& c) const;
  void erase_steps(cases::Step first);
  std::set<std::string> plots_of(cases::Step step) const;
  void remove_leftovers() const;
  void write_case(const cases::Case& c);

  std::filesystem::path folder_;
  nlohmann::json record_;
  int lock_ = -1;  // descriptor of the locked folder
};

// run.json of a run folder. Throws InputError, naming it, for a folder without one and for one that is no record of a
// run.
nlohmann::json read_run_record(const std::filesystem::path& folder);

// case.toml of a run folder with the states that were solved for its mat, as run.json has them. The bond-line result
// it came from may have gone since: its number is in the case. Throws InputError for files that are no case and no
// record of a run.
cases::Case read_run_case(const std::filesystem::path& folder);

// Lets `write` make the page of a run folder and records that it shows the results that are there; no run changes them
// meanwhile. Throws InputError for a folder that holds no run, or where a run is under way; what `write` throws passes
// through.
void write_page(const std::filesystem::path& folder, const std::function<void()>& write);

}  // namespace strandlab::run
