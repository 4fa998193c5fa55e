// Plans and cases for the tests of studies.
#pragma once

#include <filesystem>
#include <string>

#include "strandlab/run/observer.hpp"
#include "strandlab/study/folder.hpp"
#include "strandlab/study/items.hpp"
#include "strandlab/study/plan.hpp"
#include "support/temporary_folder.hpp"

namespace strandlab::study {

// Two rows of 5 mm pressed to 2 %, a tenth of a second of work.
inline constexpr const char* kSmallCase =
    "[mat]\nlength_mm = 5\nrows = ['surface', 'core']\n"
    "[kinds.core]\nlength_mm = 2\nlength_sd_mm = 0.2\ngap_mm = 1\ngap_sd_mm = 0.2\n"
    "[press]\nspeed_m_s = 16\ncompactions = [0, 0.02]\n"
    "[glue]\ncompliance_t_mm_per_MPa = [0, 0.0105]\n";

inline Plan plan_of(const std::string& text, const std::filesystem::path& folder = ".") {
  return plan_from_text(text, "plan.toml", folder);
}

// The items of a plan on the small case, which is put beside it.
inline std::vector<PlannedItem> small_items(const Plan& plan) {
  test::put(plan.folder / "small.toml", kSmallCase);
  run::Observer nobody;
  return items_of(plan, nobody);
}

inline Study small_study(const std::string& text, const std::filesystem::path& folder) {
  const auto plan = plan_of("base = 'small.toml'\n" + text, folder);
  return write_study(plan, small_items(plan), folder / "study");
}

}  // namespace strandlab::study
