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

#include "git_hash.hpp"
#include "strandlab/case/estimate.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/core/version.hpp"
#include "strandlab/run/composition.hpp"
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

std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

Journey start(const CaseArguments& arguments, cases::Step first, cases::Step last) {
  auto c = arguments.read();
  auto mat = cases::make_mat(c);
  auto panel = cases::make_panel(c, mat);
  vtest::check(panel, c.test);
  if (last >= cases::Step::kTest && c.sides == mpm::Side::kRoller)
    vtest::check_ends(panel, c.schedule.compactions.back());
  const double disk_bytes = cases::estimate(c, panel).disk_bytes;
  run::RunFolder folder(arguments.run_folder(c), c, first, arguments.force, disk_bytes);
  folder.record()["strandlab"] = version();
  folder.record()["git"] = kGitHash;
  if (!folder.record().contains("date"))
    folder.record()["date"] = fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::time(nullptr)));
  folder.record()["seed"] = c.seed;
  folder.record()["machine"] = machine();
  folder.record()["mat"] = to_json(cases::weigh(c, mat));
  folder.record()["derived_constants"] = cases::derived_constants(c);
  return {std::move(c), std::move(mat), std::move(panel), std::move(folder)};
}

}  // namespace

void travel(const CaseArguments& arguments, cases::Step first, cases::Step last,
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
  auto missing = journey.folder.missing(cases::Step::kPress, journey.c);
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
  if (folder.finished(cases::Step::kMat) && folder.missing(cases::Step::kMat, journey.c).empty()) {
    if (read_text(file) != text) {
      throw InputError(
          fmt::format("{}: not the mat of this case (changed by hand, or the mat file has changed since); choose "
                      "another run folder with -o, or --force",
                      file.string()));
    }
    return;
  }
  folder.forget(cases::Step::kPage);
  mat::write(journey.mat, file);
  folder.set_finished(cases::Step::kMat);
  console.say(fmt::format("mat: {} rows, {} strands -> {}", journey.mat.layers.size(), journey.panel.strands.size(),
                          file.string()));
  for (const auto& line : composition(cases::weigh(journey.c, journey.mat))) console.say("mat: " + line);
}

}  // namespace strandlab::app
