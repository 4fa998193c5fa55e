// What a virtual test consists of, whichever it is.
#pragma once

#include <functional>
#include <vector>

#include "strandlab/vtest/model.hpp"
#include "strandlab/vtest/vtest.hpp"

namespace strandlab::vtest {

using Solutions = std::vector<const statics::Solution<2>*>;

// A test on a model: its load cases, and the modulus that their solutions (in that order) say. A load case that two
// tests on the same supports have in common is solved once.
struct Setup {
  std::vector<statics::LoadCase> loads;
  std::function<Modulus(const Solutions&)> modulus;  // refers to the model
};

struct VirtualTest {
  const char *name, *label;  // in cases: "tension"; for people: "Tension"
  ClosedForm closed_form;    // the model of the room theory that answers it

  // What holds the panel. Tests with the same function share a factor.
  statics::Supports (*supports)(const Model&);
  Setup (*set_up)(const Model&, const Options&);

  // What it needs, where it needs something.
  void (*check_mat)(const Panel<2>&) = nullptr;                    // already before pressing; throws InputError
  void (*check_panel)(const Panel<2>&, const Options&) = nullptr;  // as pressed; throws InputError
  double (*needed_length_mm)(const Options&, double thickness_mm) = nullptr;
  bool in_one_piece = false;  // glue must connect all strands that are kept

  // Slips of the glue points, of a test that shows them.
  std::vector<GlueSlip> (*slips)(const Model&, const Solutions&) = nullptr;
};

const VirtualTest& test_of(TestKind kind);
std::vector<TestKind> all_tests();  // in the order of the list

}  // namespace strandlab::vtest
