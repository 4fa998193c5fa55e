// Presses a small mat and measures its moduli in memory: no file, no folder, no terminal but for the result.
#include <cstdio>
#include <exception>

#include "strandlab/run/form.hpp"
#include "strandlab/run/press.hpp"
#include "strandlab/run/test.hpp"

namespace {

// Two rows of poplar strands, 5 mm long, pressed to 2 %; any other key of a case as in docs/cases.md.
constexpr const char* kCase = R"(
[mat]
length_mm = 5
rows = ["surface", "core"]
[kinds.core]
length_mm = 2
length_sd_mm = 0.2
gap_mm = 1
gap_sd_mm = 0.2
[press]
speed_m_s = 8
compactions = [0.02]
[glue]
compliance_t_mm_per_MPa = [0, 0.0105]
)";

// Hears what the run says and could stop it; this one collects warnings only.
class Listener final : public strandlab::run::Observer {
 public:
  void warn(const std::string& /*line*/) override { ++warnings; }
  int warnings = 0;
};

}  // namespace

int main() {
  using namespace strandlab;
  try {
    Listener listener;
    const auto formed = run::form(cases::case_from_text(kCase, "press_and_test"));
    const auto pressed = run::press(formed, listener);
    for (const auto& state : run::test(formed, pressed.panels, listener)) {
      for (const auto& m : state.result.moduli) {
        std::printf("compaction %.2f, %s, 1/D_t = %g mm/MPa: %.0f MPa\n", state.compaction, vtest::name(m.kind),
                    m.compliance_t_mm_per_MPa, m.modulus_MPa);
      }
    }
    std::printf("%.2f MPa at the end of the pressing, %d warnings\n", pressed.outcome.records.back().stress_MPa,
                listener.warnings);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  return 0;
}
