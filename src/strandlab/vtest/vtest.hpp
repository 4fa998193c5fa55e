// Virtual tests of a pressed panel: tension and bending moduli with imperfect glue lines (small strain, linear, static).
#pragma once

#include <string>
#include <vector>

#include "strandlab/glue/glue.hpp"
#include "strandlab/panel/panel.hpp"

namespace strandlab::vtest {

enum class Kind { kTension, kBendingEndRotation, kBendingEndCouple };
const char* name(Kind kind);            // "tension", "bending_end_rotation", "bending_end_couple"
Kind kind_from_name(const std::string& name);  // throws InputError with the allowed names

struct Options {
  std::vector<Kind> kinds{Kind::kTension, Kind::kBendingEndRotation};
  std::vector<double> compliance_t_mm_per_MPa{0.0};  // 1/D_t; negative is taken as perfect, with a warning
  double compliance_n_mm_per_MPa = 0;                // 1/D_n
  int elements_through_strand = 3;
  glue::CuringOptions curing;
};

struct Modulus {
  Kind kind = Kind::kTension;
  double compliance_t_mm_per_MPa = 0;
  double modulus_MPa = 0;           // from the energy
  double reaction_modulus_MPa = 0;  // from the reaction; agrees to 1e-6
};

struct Result {
  std::vector<Modulus> moduli;        // by kind within compliance
  int floating_strands = 0;           // not connected to both loaded ends, dropped
  double glued_fraction = 0;          // glued length over face length of facing rows
  int unknowns = 0;
  double assemble_s = 0, analyse_s = 0, factor_s = 0, solve_s = 0;  // wall time, all compliances together
  std::vector<std::string> warnings;  // plain sentences
};

Result measure(const Panel<2>& panel, const Options& options);

}  // namespace strandlab::vtest
