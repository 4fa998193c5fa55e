#include "strandlab/run/replicates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <system_error>

#include "strandlab/case/case.hpp"
#include "strandlab/case/write.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/files/atomic_file.hpp"
#include "strandlab/io/checkpoint.hpp"
#include "strandlab/run/folder.hpp"
#include "strandlab/run/measured.hpp"
#include "strandlab/run/profile_bins.hpp"

namespace strandlab::run {
namespace {

namespace fs = std::filesystem;

struct Run {
  fs::path folder;
  cases::Case c;
};

std::string name_of_folder(const fs::path& folder) {
  const auto whole = fs::absolute(folder).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

Run open_run(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder / "case.toml", error)) {
    throw InputError(
        fmt::format("{}: not the folder of a run (no case.toml); give folders that `strandlab run` or "
                    "`strandlab press` has filled",
                    folder.string()));
  }
  return {folder, read_run_case(folder)};
}

// Replicates are runs of one case with other random mats: everything else that the pressing depends on is the same.
void refuse_other_cases(const std::vector<Run>& runs) {
  const auto lines = [](const Run& run) {
    auto all = cases::identity(run.c, cases::Step::kPress);
    std::erase_if(
        all, [](const std::string& line) { return line.rfind("run.seed", 0) == 0 || line.rfind("mat.file", 0) == 0; });
    return all;
  };
  const auto first = lines(runs.front());
  for (const auto& run : runs) {
    const auto other = lines(run);
    const auto differ = std::mismatch(first.begin(), first.end(), other.begin(), other.end());
    if (differ.first == first.end() && differ.second == other.end()) continue;
    const auto text = [](auto at, auto end) { return at == end ? std::string("nothing") : *at; };
    throw InputError(fmt::format(
        "{} and {} are no replicates of each other: {} there, {} here; replicates may differ in run.seed and "
        "mat.file only",
        runs.front().folder.string(), run.folder.string(), text(differ.first, first.end()),
        text(differ.second, other.end())));
  }
}

// The same panel twice would narrow the band of the mean without any reason.
void refuse_same_panels(const std::vector<Run>& runs) {
  for (auto a = runs.begin(); a != runs.end(); ++a) {
    for (auto b = a + 1; b != runs.end(); ++b) {
      if (a->c.mat_file != b->c.mat_file || (a->c.mat_file.empty() && a->c.seed != b->c.seed)) continue;
      const auto what =
          a->c.mat_file.empty() ? fmt::format("run.seed = {}", a->c.seed) : fmt::format("mat.file = {}", a->c.mat_file);
      throw InputError(fmt::format("{} and {} are the same panel ({}); replicates differ in run.seed or mat.file",
                                   a->folder.string(), b->folder.string(), what));
    }
  }
}

// The folders' own names, or all their paths where two have the same name.
std::vector<std::string> names_of(const std::vector<Run>& runs) {
  std::set<std::string> names;
  for (const auto& run : runs) names.insert(name_of_folder(run.folder));
  std::vector<std::string> result;
  result.reserve(runs.size());
  for (const auto& run : runs)
    result.push_back(names.size() == runs.size() ? name_of_folder(run.folder) : run.folder.string());
  return result;
}

report::Replicate profiles_of(const Run& run, const std::string& name, int bins) {
  report::Replicate replicate{name, {}};
  const auto hash = cases::case_hash(run.c, cases::Step::kPress);
  for (const double compaction : run.c.schedule.compactions) {
    const auto file = run.folder / "panels" / fmt::format("panel_{}.h5", compaction);
    if (!fs::exists(file)) {
      throw InputError(fmt::format("{}: no panel at compaction {} yet; strandlab press (or run) comes first",
                                   run.folder.string(), compaction));
    }
    const auto panel = io::read_panel<2>(file, hash);
    replicate.states.push_back(
        profile::density_profile(panel, bins > 0 ? bins : bins_of_one_cell(run.c, panel, compaction)));
    replicate.states.back().compaction = compaction;
  }
  return replicate;
}

std::vector<profile::Mean> means_of(const std::vector<report::Replicate>& replicates) {
  std::vector<profile::Mean> means;
  for (std::size_t i = 0; i < replicates.front().states.size(); ++i) {
    std::vector<profile::Profile> states;
    states.reserve(replicates.size());
    for (const auto& replicate : replicates) {
      states.push_back(replicate.states[i]);
      if (states.back().bins() == states.front().bins()) continue;
      throw InputError(
          fmt::format("{} and {} have {} and {} bins through the thickness, one cell high each; --bins gives all the "
                      "same number",
                      replicates.front().name, replicate.name, states.front().bins(), states.back().bins()));
    }
    means.push_back(profile::mean(states));
  }
  return means;
}

// ---- Measured profiles ---------------------------------------------------------------------------------------------

// The compaction to draw: the one asked for, else the one whose mean density is nearest to the measured one.
const profile::Mean& state_to_compare(const std::vector<profile::Mean>& means, const profile::Mean& measured,
                                      double compaction) {
  const auto density = [](const profile::Mean& mean) { return profile::mean_between(mean.profile(), 0, 1); };
  const auto distance = [&](const profile::Mean& mean) {
    return compaction >= 0 ? std::abs(mean.compaction - compaction) : std::abs(density(mean) - density(measured));
  };
  const auto& nearest = *std::min_element(means.begin(), means.end(),
                                          [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  if (compaction >= 0 && distance(nearest) > 0.005)
    throw InputError(fmt::format("--compaction {}: the runs keep no such panel; the nearest is {:.4g}", compaction,
                                 nearest.compaction));
  return nearest;
}

std::optional<Comparison> compare(const ProfileQuestion& a, const std::vector<profile::Mean>& means) {
  if (a.measured.empty()) return std::nullopt;
  Comparison comparison{read_specimens({a.measured.begin(), a.measured.end()}, a.columns), {}, {}};
  std::vector<profile::Profile> profiles;
  for (const auto& specimen : comparison.specimens)
    profiles.push_back(profile::binned(specimen, static_cast<int>(means.front().density_kg_m3.size())));
  comparison.measured = profile::mean(profiles);
  comparison.simulated = state_to_compare(means, comparison.measured, a.compaction);
  return comparison;
}

}  // namespace

ProfileAnswer density_profiles(const ProfileQuestion& question) {
  std::vector<Run> runs;
  runs.reserve(question.runs.size());
  for (const auto& folder : question.runs) runs.push_back(open_run(folder));
  refuse_other_cases(runs);
  refuse_same_panels(runs);
  ProfileAnswer answer;
  const auto names = names_of(runs);
  for (std::size_t i = 0; i < runs.size(); ++i)
    answer.replicates.push_back(profiles_of(runs[i], names[i], question.bins));
  answer.means = means_of(answer.replicates);
  answer.comparison = compare(question, answer.means);
  return answer;
}

fs::path profile_folder(const ProfileQuestion& question) {
  return fs::path("runs") / (name_of_folder(question.runs.front()) + "-profile");
}

std::vector<std::string> write(const ProfileAnswer& answer, const fs::path& folder) {
  files::make_folder(folder);
  const auto& means = answer.means;
  report::replicate_profile_table(answer.replicates).write(folder / "profile.csv");
  report::replicate_summary_table(answer.replicates).write(folder / "profile_summary.csv");
  report::mean_profile_table(means).write(folder / "profile_mean.csv");
  std::vector<report::Picture> plots{{report::mean_profile_plot(means), folder / "profile.png"},
                                     {report::profile_summary_plot(means), folder / "against_compaction.png"}};
  if (answer.comparison) {
    const auto& c = *answer.comparison;
    report::measured_table(c.specimens).write(folder / "measured.csv");
    report::comparison_table(means, c.measured).write(folder / "comparison.csv");
    plots.push_back({report::measured_profile_plot(c.simulated, c.measured), folder / "measured.png"});
  }
  return report::draw(plots).warnings;
}

std::string text_of(const ProfileAnswer& answer) {
  auto text = fmt::format("{:>11}{:>11}{:>10}{:>10}{:>13}{:>10}{:>10}{:>10}{:>14}\n", "compaction", "replicates",
                          "mean", "peak", "its depth mm", "skin", "surface", "core", "surface/core");
  for (const auto& mean : answer.means) {
    const auto s = profile::summarise(mean.profile());
    text += fmt::format("{:>11.4g}{:>11}{:>10.1f}{:>10.1f}{:>13.3f}{:>10.1f}{:>10.1f}{:>10.1f}{:>14.3f}\n",
                        mean.compaction, mean.density_kg_m3.front().n, s.mean, s.peak, s.peak_depth_mm, s.skin,
                        s.surface, s.core, s.surface_over_core());
  }
  text += "densities in kg/m3, of the mean profile\n";
  if (!answer.comparison) return text;
  const auto& c = *answer.comparison;
  return text +
         fmt::format(
             "measured: {} specimen(s), {:.2f} mm thick, mean {:.1f} kg/m3; simulated at compaction {:.4g} ({:.2f} "
             "mm): rms difference {:.1f} kg/m3\n",
             c.specimens.size(), c.measured.thickness_mm, profile::mean_between(c.measured.profile(), 0, 1),
             c.simulated.compaction, c.simulated.thickness_mm,
             profile::rms_difference(c.simulated.profile(), c.measured.profile()));
}

}  // namespace strandlab::run
