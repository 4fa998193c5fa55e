// Elastic ratios of named species: a wood of which only E_L was measured gets the other constants from them.
#pragma once

#include <string>
#include <vector>

#include "strandlab/wood/material.hpp"

namespace strandlab::wood {

// At about 12 % moisture. USDA Forest Products Laboratory, Wood Handbook (FPL-GTR-190, 2010; FPL-GTR-282, 2021), Tables
// 5-1 (moduli over E_L) and 5-2 (Poisson's ratios nu_ij = -eps_j/eps_i under load along i).
struct Species {
  std::string name;
  double E_T, E_R, G_LR, G_LT, G_RT;  // over E_L
  double nu_LR, nu_LT, nu_RT;
};

// Species with a complete line in both tables that are common in strand composites, panels and veneers.
const std::vector<Species>& species();
// Throws InputError with the nearest and all known names.
const Species& find_species(const std::string& name);

// Which of the list to take for a wood that people ask for and the tables do not have, and why: ends a message; "" for
// other names.
std::string stand_in_for(const std::string& name);

// The material with every elastic constant but E_L from the species' ratios. The measured ratios under load along the
// stiffer direction of each pair are taken; nu_RL, nu_TL and nu_TR follow by reciprocity, nu_ij/E_i = nu_ji/E_j.
Material with_ratios(Material material, const Species& species);

// The elastic constants but E_L (case key names without unit) that two materials have in common.
std::vector<std::string> constants_in_common(const Material& a, const Material& b);

// The elastic constants (case key names without unit: "E_R", "nu_TR") that are those of with_ratios(material, species).
std::vector<std::string> constants_from_ratios(const Material& material, const Species& species);

}  // namespace strandlab::wood
