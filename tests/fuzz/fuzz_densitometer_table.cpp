// Tables of densitometers: any text gives increasing positions, each with a density, or is refused.
#include <algorithm>

#include "harness.hpp"
#include "strandlab/profile/measured.hpp"

using namespace strandlab;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(fuzz::text_of(data, size));
  std::vector<profile::Specimen> specimens;
  if (!fuzz::takes([&] { specimens = profile::measured_from_text(text, "profile.csv"); })) return 0;
  for (const auto& specimen : specimens) {
    const auto& x = specimen.position_mm;
    fuzz::require(x.size() == specimen.density_kg_m3.size(), "each position has a density");
    fuzz::require(std::adjacent_find(x.begin(), x.end(), std::greater_equal<>()) == x.end(), "positions increase");
    profile::summarise(profile::binned(specimen, 20));
  }
  return 0;
}
