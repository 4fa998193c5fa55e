#include "journey.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <ctime>
#include <exception>
#include <fstream>
#include <sstream>
#include <thread>

#include "composition.hpp"
#include "git_hash.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/core/version.hpp"
#include "strandlab/io/case_estimate.hpp"
#include "strandlab/vtest/vtest.hpp"

namespace strandlab::app {
namespace {

std::string cpu_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.rfind("model name", 0) == 0 && line.find(": ") != std::string::npos)
      return line.substr(line.find(": ") + 2);
  }
  return "unknown";
}

nlohmann::json machine() {
  utsname system{};
  ::uname(&system);
  return {{"host", system.nodename},
          {"cpu", cpu_name()},
          {"cores", std::thread::hardware_concurrency()},
          {"system", fmt::format("{} {} {}", system.sysname, system.release, system.machine)}};
}

// The states at which the panel is kept, as they were solved for this mat.
nlohmann::json states(const io::Case& c, const mat::Mat& mat) {
  auto list = nlohmann::json::array();
  for (const double compaction : c.schedule.compactions)
    list.push_back({{"compaction", compaction},
                    {"thickness_mm", mat.thickness_mm() * (1 - compaction)},
                    {"density_kg_m3", io::density_kg_m3(c, mat, compaction)}});
  return list;
}

std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

Journey start(const CaseArguments& arguments, io::Step first, io::Step last) {
  auto c = arguments.read();
  auto mat = io::make_mat(c);
  io::settle_states(c, mat);
  auto panel = io::make_panel(c, mat);
  vtest::check(panel, c.test);
  if (last >= io::Step::kTest && c.sides == mpm::Side::kRoller) vtest::check_ends(panel, c.schedule.compactions.back());
  const double disk_bytes = io::estimate(c, panel).disk_bytes;
  io::RunFolder folder(arguments.run_folder(c), c, first, arguments.force, disk_bytes);
  folder.record()["strandlab"] = version();
  folder.record()["git"] = kGitHash;
  if (!folder.record().contains("date"))
    folder.record()["date"] = fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::time(nullptr)));
  folder.record()["seed"] = c.seed;
  folder.record()["machine"] = machine();
  folder.record()["mat"] = to_json(io::weigh(c, mat));
  folder.record()["states"] = states(c, mat);
  folder.record()["derived_constants"] = io::derived_constants(c);
  return {std::move(c), std::move(mat), std::move(panel), std::move(folder)};
}

}  // namespace

void travel(const CaseArguments& arguments, io::Step first, io::Step last,
            const std::function<void(Journey&, Console&)>& steps) {
  auto journey = start(arguments, first, last);
  Console console;
  try {
    steps(journey, console);
  } catch (const std::exception& e) {
    console.log_error(e.what());
    throw;
  }
}

void refuse_missing_panels(const Journey& journey) {
  auto missing = journey.folder.missing(io::Step::kPress, journey.c);
  std::erase_if(missing, [](const std::string& name) { return name.rfind("panels/", 0) != 0; });
  if (missing.empty()) return;
  throw InputError(fmt::format(
      "{}: missing: {}; only pressing again can make a panel: put it back, or press again with strandlab press --force",
      journey.folder.path().string(), fmt::join(missing, ", ")));
}

void do_mat(Journey& journey, Console& console) {
  auto& folder = journey.folder;
  const auto file = folder.file("mat.json");
  const auto text = mat::to_text(journey.mat);
  if (folder.finished(io::Step::kMat) && folder.missing(io::Step::kMat, journey.c).empty()) {
    if (read_text(file) != text) {
      throw InputError(
          fmt::format("{}: not the mat of this case (changed by hand, or the mat file has changed since); choose "
                      "another run folder with -o, or --force",
                      file.string()));
    }
    return;
  }
  folder.forget(io::Step::kPage);
  mat::write(journey.mat, file);
  folder.set_finished(io::Step::kMat);
  console.say(fmt::format("mat: {} rows, {} strands -> {}", journey.mat.layers.size(), journey.panel.strands.size(),
                          file.string()));
  for (const auto& line : composition(io::weigh(journey.c, journey.mat))) console.say("mat: " + line);
}

}  // namespace strandlab::app
