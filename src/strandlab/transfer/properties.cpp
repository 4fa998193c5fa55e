#include "strandlab/transfer/properties.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "strandlab/core/error.hpp"

namespace strandlab::transfer {

double equilibrium_moisture(const Constants& k, double T, double vapour_pressure, double at_most) {
  const double wanted = vapour_pressure / saturation_pressure(T);
  double low = 0, high = at_most;
  if (!(wanted >= 0 && wanted <= relative_pressure(k, T, high))) {
    throw InputError(fmt::format(
        "no moisture content up to {} is in balance with {:g} of the saturation pressure at {} C", at_most, wanted, T));
  }
  for (int i = 0; i < 100 && high - low > 1e-15; ++i) {
    const double middle = 0.5 * (low + high);
    (relative_pressure(k, T, middle) < wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double permeability(const Constants& k, double dry_density) {
  const auto& table = k.permeabilities;
  if (table.empty()) {
    return k.permeability_400 * std::pow(10, -k.permeability_slope * (dry_density - 400)) + k.permeability_floor;
  }
  const auto above = std::find_if(table.begin(), table.end(), [&](const auto& p) { return p.density > dry_density; });
  if (above == table.begin()) return table.front().permeability;
  if (above == table.end()) return table.back().permeability;
  const auto below = above - 1;
  const double part = (dry_density - below->density) / (above->density - below->density);
  return below->permeability * std::pow(above->permeability / below->permeability, part);
}

}  // namespace strandlab::transfer
