#include "strandlab/wood/options.hpp"

#include "strandlab/wood/laws/law.hpp"

namespace strandlab::wood {

std::vector<Declaration<Material>> material_options() {
  using M = Material;
  std::vector<Declaration<M>> list{
      declare("density_kg_m3", "kg/m3", kPositive, "density as formed", &M::density_kg_m3),
      declare("E_L_MPa", "MPa", kPositive, "Young's modulus along the grain", &M::E_L),
      declare("E_R_MPa", "MPa", kPositive, "Young's modulus, radial (through the strand)", &M::E_R),
      declare("E_T_MPa", "MPa", kPositive, "Young's modulus, tangential", &M::E_T),
      declare("G_RL_MPa", "MPa", kPositive, "shear modulus", &M::G_RL),
      declare("G_TL_MPa", "MPa", kPositive, "shear modulus", &M::G_TL),
      declare("G_RT_MPa", "MPa", kPositive, "rolling shear modulus", &M::G_RT),
      declare("nu_RL", "", kAny, "Poisson's ratio -eps_L/eps_R under load along R", &M::nu_RL),
      declare("nu_TL", "", kAny, "Poisson's ratio -eps_L/eps_T under load along T", &M::nu_TL),
      declare("nu_TR", "", kAny, "Poisson's ratio -eps_R/eps_T under load along T", &M::nu_TR)};
  for_each_law([&]<class L>() {
    const auto& constants = L::description().constants;
    list.insert(list.end(), constants.begin(), constants.end());
  });
  return list;
}

}  // namespace strandlab::wood
