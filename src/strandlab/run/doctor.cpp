#include "strandlab/run/doctor.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <exception>
#include <iterator>
#include <thread>
#include <utility>

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

// As SelfTest has them. A change of the engine or of the defaults changes them:
// Doctor.SelfTestHoldsOnEveryInstructionSet prints the new ones.
const std::vector<double> kKept{1.4410530679463143, 0.47530817187508295, 5149.314802979683,
                                1416.7841192689536, 5117.045152995386,   1360.0773733526937};
constexpr std::pair<const char*, const char*> kKeptBits[] = {
    {"generic", "23605b78e5ee48ff"}, {"avx2", "b349e82cdc7353d6"}, {"avx512", "b349e82cdc7353d6"}};

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
    const auto test = self_test();
    const bool good = test.difference <= kSelfTestLimit;
    return {
        good ? State::kGood : State::kBad, "self-test",
        fmt::format("{} bits as pressed, numbers differ by {:.0e}, limit {:.0e}", test.same_bits ? "the same" : "other",
                    test.difference, kSelfTestLimit),
        !good ? "this build does not compute what it should: do not use it, and tell us"
        : !test.same_bits
            ? "built by another compiler than g++ 12, tuned to a machine, or another libm; results agree to the limit"
            : ""};
  } catch (const std::exception& e) {
    return {State::kBad, "self-test", "", fmt::format("did not run: {}", e.what())};
  }
}

// FNV-1a of the numbers' bytes.
class Fingerprint {
 public:
  void add(double number) {
    for (int k = 0; k < 8; ++k) {
      hash_ ^= std::bit_cast<std::uint64_t>(number) >> (8 * k) & 0xff;
      hash_ *= 0x100000001b3;
    }
  }
  std::string text() const { return fmt::format("{:016x}", hash_); }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

std::string bits_of(const Panel<2>& panel) {
  Fingerprint print;
  for (const auto& strand : panel.strands) {
    for (const auto* vectors : {&strand.points.x, &strand.points.v})
      for (const auto& v : *vectors)
        for (const double number : v) print.add(number);
    for (const auto& stress : strand.points.stress)
      for (const double number : stress) print.add(number);
  }
  return print.text();
}

}  // namespace

SelfTest self_test() {
  SelfTest result;
  Observer silent;
  const auto formed = form(cases::case_from_text(kSmallCase, "self-test"));
  const auto pressed = press(formed, silent);
  result.bits = bits_of(pressed.panels.back());
  result.same_bits = std::any_of(std::begin(kKeptBits), std::end(kKeptBits), [&](const auto& kept) {
    return kept.first == mpm::instruction_set() && kept.second == result.bits;
  });
  result.numbers = {pressed.outcome.records.back().stress_MPa, pressed.outcome.records.back().platen_work_mJ};
  for (const auto& state : test(formed, pressed.panels, silent)) {
    for (const auto& modulus : state.result.moduli) result.numbers.push_back(modulus.modulus_MPa);
  }
  if (result.numbers.size() != kKept.size())
    throw RunError(fmt::format("{} numbers, {} were expected", result.numbers.size(), kKept.size()));
  for (std::size_t i = 0; i < kKept.size(); ++i)
    result.difference = std::max(result.difference, std::abs(result.numbers[i] / kKept[i] - 1));
  return result;
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
