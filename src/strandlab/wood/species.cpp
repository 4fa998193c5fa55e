#include "strandlab/wood/species.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "strandlab/core/error.hpp"
#include "strandlab/core/nearest.hpp"

namespace strandlab::wood {

const std::vector<Species>& species() {
  //                                     E_T   E_R   G_LR  G_LT  G_RT  nu_LR nu_LT nu_RT
  static const std::vector<Species> list{{"yellow-poplar", .043, .092, .075, .069, .011, .318, .392, .703},
                                         {"sweetgum", .050, .115, .089, .061, .021, .325, .403, .682},
                                         {"yellow-birch", .050, .078, .074, .068, .017, .426, .451, .697},
                                         {"douglas-fir", .050, .068, .064, .078, .007, .292, .449, .390},
                                         {"loblolly-pine", .078, .113, .082, .081, .013, .328, .292, .382},
                                         {"longleaf-pine", .055, .102, .071, .060, .012, .332, .365, .384},
                                         {"lodgepole-pine", .068, .102, .049, .046, .005, .316, .347, .469},
                                         {"ponderosa-pine", .083, .122, .138, .115, .017, .337, .400, .426},
                                         {"sitka-spruce", .043, .078, .064, .061, .003, .372, .467, .435}};
  return list;
}

const Species& find_species(const std::string& name) {
  const auto& list = species();
  const auto found = std::find_if(list.begin(), list.end(), [&](const Species& s) { return s.name == name; });
  if (found != list.end()) return *found;
  std::vector<std::string> names(list.size());
  std::transform(list.begin(), list.end(), names.begin(), [](const Species& s) { return s.name; });
  const auto near = nearest(name, names);
  throw InputError(fmt::format("there are no elastic ratios of a species \"{}\"{} Species: {}", name,
                               near.empty() ? "." : fmt::format("; did you mean \"{}\"?", near), quoted_list(names)));
}

std::string stand_in_for(const std::string& name) {
  std::string small = name;
  std::transform(small.begin(), small.end(), small.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  for (const char* populus : {"aspen", "poplar", "cottonwood", "populus"}) {
    if (small.find(populus) != std::string::npos)
      return "; the tables of the Wood Handbook have no aspen: yellow-poplar stands in for it, a light hardwood with "
             "fine pores all through its rings too, with E_L_MPa and density_kg_m3 of your own";
  }
  return {};
}

Material with_ratios(Material m, const Species& s) {
  m.E_T = s.E_T * m.E_L;
  m.E_R = s.E_R * m.E_L;
  m.G_RL = s.G_LR * m.E_L;
  m.G_TL = s.G_LT * m.E_L;
  m.G_RT = s.G_RT * m.E_L;
  m.nu_RL = s.nu_LR * s.E_R;
  m.nu_TL = s.nu_LT * s.E_T;
  m.nu_TR = s.nu_RT * s.E_T / s.E_R;
  return m;
}

std::vector<std::string> constants_in_common(const Material& a, const Material& b) {
  static constexpr std::array<std::pair<const char*, double Material::*>, 8> kConstants{{{"E_R", &Material::E_R},
                                                                                         {"E_T", &Material::E_T},
                                                                                         {"G_RL", &Material::G_RL},
                                                                                         {"G_TL", &Material::G_TL},
                                                                                         {"G_RT", &Material::G_RT},
                                                                                         {"nu_RL", &Material::nu_RL},
                                                                                         {"nu_TL", &Material::nu_TL},
                                                                                         {"nu_TR", &Material::nu_TR}}};
  std::vector<std::string> names;
  for (const auto& [name, constant] : kConstants) {
    if (a.*constant == b.*constant) names.emplace_back(name);
  }
  return names;
}

std::vector<std::string> constants_from_ratios(const Material& material, const Species& s) {
  return constants_in_common(material, with_ratios(material, s));
}

}  // namespace strandlab::wood
