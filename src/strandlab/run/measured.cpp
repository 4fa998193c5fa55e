#include "strandlab/run/measured.hpp"

#include <fmt/format.h>

#include "strandlab/report/density_profiles.hpp"
#include "strandlab/run/folder.hpp"

namespace strandlab::run {
namespace {

constexpr int kBinsOfMean = 100;

profile::Specimen mean_of(const std::vector<profile::Specimen>& specimens) {
  std::vector<profile::Profile> profiles;
  profiles.reserve(specimens.size());
  for (const auto& specimen : specimens) profiles.push_back(profile::binned(specimen, kBinsOfMean));
  const auto mean = profile::mean(profiles);
  profile::Specimen shown{fmt::format("mean of {}", specimens.size()), {}, {}};
  const auto add = [&](double place, const auto& density) {
    shown.position_mm.push_back(place * mean.thickness_mm);
    shown.density_kg_m3.push_back(density.mean);
  };
  add(0, mean.density_kg_m3.front());
  for (std::size_t k = 0; k < mean.density_kg_m3.size(); ++k)
    add((static_cast<double>(k) + .5) / kBinsOfMean, mean.density_kg_m3[k]);
  add(1, mean.density_kg_m3.back());
  return shown;
}

}  // namespace

std::vector<profile::Specimen> read_specimens(const std::vector<std::filesystem::path>& files,
                                              const profile::MeasuredColumns& columns) {
  std::vector<profile::Specimen> all;
  for (const auto& file : files) {
    for (auto& specimen : profile::read_measured(file, columns)) {
      if (files.size() > 1) specimen.name = file.stem().string() + " " + specimen.name;
      all.push_back(std::move(specimen));
    }
  }
  return all;
}

void keep_measured(const std::filesystem::path& run_folder, const std::vector<std::filesystem::path>& files) {
  static_cast<void>(read_run_record(run_folder));
  auto specimens = read_specimens(files);
  if (specimens.size() > 1) specimens.push_back(mean_of(specimens));
  report::measured_table(specimens).write(run_folder / "measured.csv");
}

}  // namespace strandlab::run
