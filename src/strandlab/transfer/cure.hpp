// Cure of a resin by heat, and what it is worth as a bond.
#pragma once

#include <string>
#include <vector>

namespace strandlab::transfer {

// d alpha/dt = A exp(-E/(R T_K)) (1 - alpha)^n, alpha the degree of cure.
struct Resin {
  std::string name;
  double activation_J_mol = 0;  // E
  double rate_1_s = 0;          // A
  double order = 1;             // n
  double gel = .5;              // degree of cure from which on there is strength
};

// "pf" (phenol-formaldehyde, surface) and "pmdi": constants chosen so that they cure in the times that presses need;
// order of magnitude of Lei & Wu (2006, PF) and Harper, Wolcott & Rials (2001, pMDI), to be replaced by your resin's.
const std::vector<Resin>& resins();

double cure_rate(const Resin& resin, double T);  // 1/s at alpha = 0, T in C

// Degree of cure after `seconds` at temperature T (C), exact; from `alpha`.
double cured(const Resin& resin, double alpha, double T, double seconds);

// Part of the strength of a line that is fully cured: 0 up to the gel point, then linear.
double bond_strength(const Resin& resin, double alpha);

}  // namespace strandlab::transfer
