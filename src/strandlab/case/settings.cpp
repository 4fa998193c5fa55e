#include "strandlab/case/settings.hpp"

#include "strandlab/mat/mat.hpp"
#include "strandlab/mpm/options.hpp"

namespace strandlab::cases {
namespace {

const Range kSize{.lo = mat::kSmallestSize_mm, .hi = mat::kLargestSize_mm};
const Range kSizeOrZero{.lo = mat::kSmallestSize_mm, .hi = mat::kLargestSize_mm, .zero = true};
const Range kSoftening{.lo = 0, .hi = 1, .lo_open = true};
constexpr double kDensest_kg_m3 = 1500;  // wood without pores

const char* off_axis_name(wood::OffAxis choice) {
  return wood::name(choice);
}
const char* law_name(wood::Law law) {
  return wood::name(law);
}
const char* side_name(mpm::Side side) {
  return mpm::name(side);
}

// Schedule, platens and how the mat closes.
std::vector<Declaration<HotPressSettings>> cycle_settings() {
  using H = HotPressSettings;
  auto mechanics = declare("mechanics", "", kAny,
                           "how the mat resists in `strandlab run`: strand by strand; with column or uniform "
                           "`strandlab run` presses cold. `strandlab hotpress` takes a column of the mat's layers "
                           "without gaps, with uniform no resistance and the same density everywhere",
                           &H::mechanics);
  mechanics.choices = {"strands", "column", "uniform"};
  auto kept =
      declare("kept", "", kAny,
              "panel of `strandlab run` that is kept and tested: as opened, or closed, as held at last", &H::kept);
  kept.choices = {"opened", "closed"};
  return {std::move(mechanics),
          std::move(kept),
          declare("platen_C", "C", {.lo = 20, .hi = 300}, "temperature of the platens; above 220 with a warning",
                  &H::platen_C),
          declare("platen_program", "", kAny,
                  "platen temperature against seconds since first contact in place of platen_C, as in \"0 200, 60 "
                  "190\"; \"\": platen_C",
                  &H::platen_program),
          declare("platen_bottom_program", "", kAny, "the same for the bottom platen; \"\": as the top one",
                  &H::platen_bottom_program),
          declare("bottom_lead_s", "s", {.lo = 0, .hi = 600},
                  "the mat lies on the hot bottom platen so long before the press touches it", &H::bottom_lead_s),
          declare("schedule", "", kAny,
                  "phases: close (by position or pressure), hold, vent, open; mm, kg/m3 (oven-dry), % compaction, s, "
                  "mm/s, MPa (docs/hotpress.md)",
                  &H::schedule),
          declare("max_mm_per_s", "mm/s", kPositive, "fastest closing under pressure", &H::max_mm_per_s)};
}

// Moisture, size and how finely the mat is computed.
std::vector<Declaration<HotPressSettings>> hot_mat_settings() {
  using H = HotPressSettings;
  const Range moisture{.lo = 0, .hi = 0.3}, fraction{.lo = 0, .hi = 0.5};
  return {declare("moisture_face", "kg/kg", moisture, "moisture content of the faces; above 0.25 with a warning",
                  &H::moisture_face),
          declare("moisture_core", "kg/kg", moisture, "moisture content of the core", &H::moisture_core),
          declare("face_fraction", "", fraction, "part of the mat's mass that each face is", &H::face_fraction),
          declare("panel_width_mm", "mm", kPositiveOrInfinite,
                  "width of the panel, along which gas escapes to the edges; inf: sealed edges", &H::panel_width_mm),
          declare("cells", "", {.lo = 4, .hi = 400}, "cells of equal mass through the mat", &H::cells),
          declare("columns", "", {.lo = 1, .hi = 200},
                  "columns of such cells along the section; of several, heat and gas also pass between them, and with "
                  "press.sides = \"free\" out of its ends, as the panel's whole width",
                  &H::columns),
          declare("step_s", "s", {.lo = 0.001, .hi = 2}, "time step to 30 s; twice that to 90 s, then four times",
                  &H::step_s),
          declare("rate_exponent", "", {.lo = 0, .hi = 0.5}, "stress grows as this power of the rate of crushing",
                  &H::rate_exponent)};
}

}  // namespace

std::vector<Declaration<Case>> mat_settings() {
  return {declare("length_mm", "mm", {.lo = mat::kSmallestSize_mm, .hi = 1e5}, "length of the specimen along the panel",
                  &Case::length_mm),
          declare("layer_thickness_mm", "mm", kSize, "thickness of strands whose kind has none of its own",
                  &Case::layer_thickness_mm),
          declare("rows", "", kAny, "rows of strands, bottom to top: \"kind\" or \"kind*count\"", &Case::rows),
          declare("file", "", kAny,
                  "mat file to press in place of a random mat (its length, thickness and rows hold); \"\" for random",
                  &Case::mat_file),
          declare_choice("offaxis",
                         "rows whose grain lies neither along nor across: held by the section in every "
                         "direction, or free to shear across (docs/theory.md)",
                         &Case::off_axis, {wood::name(wood::OffAxis::kExact), wood::name(wood::OffAxis::kUncoupled)},
                         off_axis_name, wood::off_axis_from_name)};
}

std::vector<Declaration<KindSettings>> kind_settings() {
  using K = KindSettings;
  return {
      declare("material", "", kAny, "material of the strands: built in or one of [materials]", &K::material),
      declare("angle_deg", "degrees", {.lo = -180, .hi = 180}, "grain against the section, 0 along the panel",
              &K::angle_deg),
      declare("angle_spread_deg", "degrees", {.lo = 0, .hi = 90},
              "each strand has its own angle, uniform within angle_deg +- this; 90: any angle", &K::angle_spread_deg),
      declare("angle_kappa", "", {.lo = 0, .hi = mat::kMostConcentrated},
              "3D: each strand has its own angle, von Mises in the doubled angle, density exp(kappa cos 2(angle - "
              "angle_deg)); in place of angle_sd_deg",
              &K::angle_kappa),
      declare("thickness_mm", "mm", kSizeOrZero, "thickness of the strands; 0: mat.layer_thickness_mm",
              &K::thickness_mm),
      declare("yield_factor", "", kSoftening,
              "softening by heat and moisture in a cold pressing: yield stresses and hardening_K over the material's; "
              "a case with [hotpress] takes 1 and finds it by itself",
              &K::yield_factor),
      declare("stiffness_factor", "", kSoftening,
              "the same of elastic moduli; virtual tests are cold and take the "
              "material's",
              &K::stiffness_factor),
      declare_choice("law",
                     "how the strands yield: hill (no change of volume) or crushing (cells collapse); see "
                     "docs/crushing.md",
                     &K::law, wood::law_names(), law_name, wood::law_from_name)};
}

std::vector<Declaration<KeptStates>> state_settings() {
  using S = KeptStates;
  return {
      declare("densities_kg_m3", "kg/m3",
              {.lo = 0, .hi = kDensest_kg_m3, .lo_open = true, .hi_open = true, .increasing = true},
              "densities of the panel at which it is kept, solved for the weight of each mat; this key or one of the "
              "next two",
              &S::densities_kg_m3),
      declare("thicknesses_mm", "mm", {.lo = 0, .lo_open = true, .decreasing = true},
              "thicknesses of the panel at which it is kept, in place of densities", &S::thicknesses_mm),
      declare("compactions", "", {.lo = 0, .hi = 1, .hi_open = true, .increasing = true},
              "compactions (1 - thickness/initial thickness) at which the panel is kept, in place of densities",
              &S::compactions)};
}

std::vector<Declaration<Case>> side_settings() {
  return {declare_choice("sides", "vertical sides of the mat: on rollers (symmetry) or free", &Case::sides,
                         mpm::side_names(), side_name, mpm::side_from_name)};
}

std::vector<Declaration<Case>> half_settings() {
  static const std::vector<std::string> names{"no", "mirror", "keep"};
  return {declare_choice(
      "half",
      "3D: mat.rows are the upper half of a symmetric plate, from its middle plane up, and are pressed against that "
      "plane; "
      "panels are kept with their mirror image (mirror) or as the half (keep)",
      &Case::half, names, [](PressedHalf half) { return names[static_cast<std::size_t>(half)]; },
      [](const std::string& text) {
        return static_cast<PressedHalf>(std::find(names.begin(), names.end(), text) - names.begin());
      })};
}

std::vector<Declaration<Case>> bondline_settings() {
  return {
      declare("from_bondline", "", kAny,
              "result of `strandlab bondline` whose group gives 1/D_t in place of compliance_t_mm_per_MPa; \"\" for "
              "none",
              &Case::bondline_file),
      declare("group", "", kAny, "group of that result", &Case::bondline_group),
      declare("groups", "", kAny, "several groups of that result, in place of one: each gives its 1/D_t and its name",
              &Case::bondline_groups)};
}

std::vector<Declaration<Case>> run_settings() {
  return {
      declare("seed", "", {.lo = 0, .hi = 9e18}, "seed of the random mat", &Case::seed),
      declare("threads", "", {.lo = 0, .hi = 1024}, "threads; 0: one per core. Results do not depend on it",
              &Case::threads),
      declare("checkpoint_interval_s", "s", {.lo = 0.01, .hi = 86400},
              "wall time between checkpoints: what a killed run can lose", &Case::checkpoint_interval_s),
      declare("pictures", "", kAny,
              "whether `strandlab run` draws pictures/ and plots/ (PNG); the page has pictures of its own. Run again "
              "with true to have them later",
              &Case::pictures)};
}

std::vector<Declaration<HotPressSettings>> hot_press_settings() {
  using H = HotPressSettings;
  auto list = cycle_settings();
  const auto add = [&list](std::vector<Declaration<H>> more) { list.insert(list.end(), more.begin(), more.end()); };
  add(hot_mat_settings());
  add({declare("resin.face", "", kAny, "resin of the faces, built in or of [resins]", &H::resin_face),
       declare("resin.core", "", kAny, "resin of the core", &H::resin_core),
       declare("resin.face_kinds", "", kAny,
               "kinds of strand that carry the resin of the faces, all others that of the core; none: what lies in "
               "face_fraction does",
               &H::face_kinds),
       declare("permeability.K400_m2", "m2", kPositive, "of a mat of 400 kg/m3, through the thickness", &H::K400_m2),
       declare("permeability.slope", "m3/kg", kNotNegative, "fall of its decimal logarithm with density", &H::slope),
       declare("permeability.in_plane_ratio", "", kPositive, "permeability along the panel over that",
               &H::in_plane_ratio),
       declare("permeability.table", "", kAny,
               "permeability (m2) against density (kg/m3) in place of the formula, as in \"400 5e-12, 640 "
               "9.4e-14\"; \"\": the formula",
               &H::permeability_table),
       declare("log.file", "", kAny,
               "record of a press's controller (CSV) to follow in place of the schedule; \"\" for none",
               &H::log_file)});
  return list;
}

std::vector<Declaration<ResinSettings>> resin_settings() {
  using R = ResinSettings;
  return {
      declare("E_kJ_mol", "kJ/mol", kNotNegative, "activation energy; must be given", &R::E_kJ_mol),
      declare("A_1_s", "1/s", kNotNegative, "rate of cure is A exp(-E/(R T)) (1 - cure)^n; must be given", &R::A_1_s),
      declare("n", "", {.lo = 0, .hi = 5, .lo_open = true}, "order of the cure", &R::n),
      declare("gel", "", {.lo = 0, .hi = 1, .hi_open = true}, "degree of cure from which on it has strength", &R::gel)};
}

}  // namespace strandlab::cases
