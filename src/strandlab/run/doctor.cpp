#include "strandlab/run/doctor.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <thread>

#include "strandlab/case/case.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/core/free_memory.hpp"
#include "strandlab/core/version.hpp"
#include "strandlab/mpm/dispatch.hpp"
#include "strandlab/report/html.hpp"
#include "strandlab/run/commit.hpp"
#include "strandlab/run/form.hpp"
#include "strandlab/run/installed.hpp"
#include "strandlab/run/press.hpp"
#include "strandlab/run/test.hpp"

namespace strandlab::run {
namespace {

using State = Diagnosis::State;

constexpr const char* kSmallCase = R"(
[mat]
length_mm = 5
rows = ["surface", "core"]
[kinds.core]
length_mm = 2
length_sd_mm = 0.2
gap_mm = 1
gap_sd_mm = 0.2
[press]
speed_m_s = 32
compactions = [0.02]
[glue]
compliance_t_mm_per_MPa = [0, 0.0105]
[run]
threads = 1
)";

// Stress (MPa) and work (mJ) at the end of the pressing, then the moduli (MPa). A change of the engine or of the
// defaults changes them: Doctor.SelfTestHoldsOnEveryInstructionSet prints the new ones.
const std::vector<double> kKept{1.4410530679463143, 0.47530817187508295, 5149.314802979683,
                                1416.7841192689536, 5117.045152995386,   1360.0773733526937};

struct Optional {
  const char* program;
  const char* version;  // arguments that make it print its version
  const char* use;
  bool used = true;
};
// What Python has, in one line: "Python 3.11.2, numpy 1.24.2, no pandas...".
constexpr const char* kPythonModules = R"(-c 'import importlib.util, platform
from importlib.metadata import version
def told(name):
    if importlib.util.find_spec(name) is None: return "no " + name
    try: return name + " " + version(name)
    except Exception: return name
print("Python", platform.python_version() + ",", *[told(name) + "," for name in ("strandlab", "numpy", "pandas")], told("matplotlib"))')";
constexpr Optional kOptional[] = {
    {"gnuplot", "--version", "plots of a run as PNG; Debian: gnuplot-nox"},
    {"ffmpeg", "-version", "strandlab movie; Debian: ffmpeg"},
    {"python3", kPythonModules, "strandlab in Python (docs/python.md); Debian: python3"},
    {"sbatch", "--version", "studies on a cluster with Slurm (docs/studies.md)"},
    {"parallel", "--version", "studies by GNU parallel (docs/studies.md); Debian: parallel"},
    {"mpirun", "--version", "not used by this version: a panel is pressed on one machine, a study on many", false},
    {"paraview", "--version", "a look at paraview/panel.pvd of a run; Debian: paraview"},
};

Diagnosis diagnosis_of(const Optional& optional) {
  const auto file = installed(optional.program);
  if (!file) return {State::kMissing, optional.program, "", optional.use};
  const auto version = first_line_of(*file, optional.version);
  return {State::kGood, optional.program, file->string() + (version.empty() ? "" : ", " + version),
          optional.used ? "" : optional.use};
}

Diagnosis page() {
  try {
    return {State::kGood, "report page", fmt::format("{} kB", report::empty_page().size() / 1000), ""};
  } catch (const InputError& e) {
    return {State::kMissing, "report page", "", e.what()};
  }
}

Diagnosis self() {
  try {
    const double difference = self_test();
    const bool good = difference <= kSelfTestLimit;
    return {good ? State::kGood : State::kBad, "self-test",
            fmt::format("differs by {:.0e}, limit {:.0e}", difference, kSelfTestLimit),
            good ? "" : "this build does not compute what it should: do not use it, and tell us"};
  } catch (const std::exception& e) {
    return {State::kBad, "self-test", "", fmt::format("did not run: {}", e.what())};
  }
}

}  // namespace

std::vector<double> self_test_numbers() {
  Observer silent;
  const auto formed = form(cases::case_from_text(kSmallCase, "self-test"));
  const auto pressed = press(formed, silent);
  std::vector<double> found{pressed.outcome.records.back().stress_MPa, pressed.outcome.records.back().platen_work_mJ};
  for (const auto& state : test(formed, pressed.panels, silent)) {
    for (const auto& modulus : state.result.moduli) found.push_back(modulus.modulus_MPa);
  }
  return found;
}

double self_test() {
  const auto found = self_test_numbers();
  if (found.size() != kKept.size())
    throw RunError(fmt::format("{} numbers, {} were expected", found.size(), kKept.size()));
  double worst = 0;
  for (std::size_t i = 0; i < kKept.size(); ++i) worst = std::max(worst, std::abs(found[i] / kKept[i] - 1));
  return worst;
}

std::vector<Diagnosis> diagnose() {
  std::vector<Diagnosis> list;
  list.push_back({State::kGood, "strandlab", fmt::format("{} ({})", version(), git_commit()), ""});
  list.push_back({State::kGood, "instruction set",
                  fmt::format("{} (of {})", mpm::instruction_set(), fmt::join(mpm::instruction_sets(), ", ")), ""});
  list.push_back({State::kGood, "threads", fmt::format("{}", std::max(1U, std::thread::hardware_concurrency())), ""});
  list.push_back({State::kGood, "free memory", fmt::format("{:.1f} GB", 1e-9 * free_memory_bytes()), ""});
  list.push_back(page());
  for (const auto& optional : kOptional) list.push_back(diagnosis_of(optional));
  list.push_back(self());
  return list;
}

std::string text_of(const std::vector<Diagnosis>& list) {
  std::string text;
  for (const auto& line : list) {
    const char* state = line.state == State::kGood ? "ok" : line.state == State::kMissing ? "missing" : "WRONG";
    text += fmt::format("{:8}{:16} {}\n", state, line.what,
                        line.use.empty()     ? line.found
                        : line.found.empty() ? line.use
                                             : line.found + ": " + line.use);
  }
  return text;
}

}  // namespace strandlab::run
