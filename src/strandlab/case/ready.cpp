// The ready cases: what each changes in the defaults, which are those of OSB.
#include <fmt/format.h>

#include <string>
#include <vector>

#include "strandlab/case/case.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/core/nearest.hpp"

namespace strandlab::cases {
namespace {

constexpr const char* kFullRow = "length_mm = 0\nlength_sd_mm = 0\ngap_mm = 0\ngap_sd_mm = 0\n";

struct Ready {
  std::string name;
  std::string title;
  std::string changes;  // as a case file
};

// VTC strands are 25 mm shorter than normal ones.
constexpr const char* kVtcSurface = "material = \"vtc\"\nlength_mm = 125\n";

// The panels of Le (2010), with keys of [mat], [kinds.surface] and [kinds.core] of their own: pressed cold by Hill's
// law through even compactions.
Ready le2010(const std::string& name, const std::string& title, const std::string& mat, const std::string& surface = "",
             const std::string& core = "") {
  return {name, title,
          fmt::format("[mat]\n{}\n[kinds.surface]\nlaw = \"hill\"\nyield_factor = 1\n{}\n[kinds.core]\nlaw = "
                      "\"hill\"\nyield_factor = 1\n{}\n[press]\ncompactions = [0, 0.1, 0.2, 0.3, 0.4]\n",
                      mat, surface, core)};
}

// Panels of the experiments of Rathi (2009) as Le (2010), 3.6.4.2 models them: surface rows over a core of strands at
// any angle. Core rows keep the lengths and gaps that the core of the OSB case has in the section, whatever their
// angle.
Ready rathi(const std::string& name, const std::string& title, int surface, int core, const std::string& strands) {
  return le2010(
      name,
      title +
          "\nCore strands lie at any angle. Le (2010), section 3.6.4.2, after Rathi (2009). Core rows keep the "
          "lengths and gaps\nof the OSB case's core in the section, whatever the angles (docs/layups.md).",
      fmt::format("rows = [\"surface*{0}\", \"core*{1}\", \"surface*{0}\"]", surface, core), strands,
      "angle_deg = 0\nangle_spread_deg = 90\n");
}

Ready chapter5(int length, int gap) {
  return le2010(fmt::format("osb_length{}_gap{}", length, gap),
                fmt::format("OSB with surface strands of {} +- 20 mm and gaps of {} +- 4.95 mm between them.\n"
                            "One of the four cases of Le (2010), chapter 5, on strand length and gaps.",
                            length, gap),
                "", fmt::format("length_mm = {}\ngap_mm = {}\n", length, gap));
}

// Rows without gaps begin at 350 kg/m3: 400 is reached while the strands still swing.
constexpr const char* kFullStates = "[press]\ndensities_kg_m3 = [480, 560, 640]\n";
constexpr const char* kAlong = "rows = [\"surface*20\"]\n";

// Of the panels as a mill presses them.
std::string pressed(const std::string& what) {
  return what +
         "\nThe press is cold: softened faces and core (kinds.NAME.yield_factor) stand in for heat and moisture, which "
         "make\ndense faces over a light core (docs/crushing.md, \"Softened faces\").";
}

// Of their counterparts in the dissertation.
std::string published(const std::string& what) {
  return what +
         "\nAs Le (2010) presses it, by Hill's law to 40 %, to compare with the dissertation: pressures at the end are "
         "far beyond\nthose of a press (docs/crushing.md).";
}

const std::vector<Ready>& table() {
  static const std::vector<Ready> list{
      {"osb",
       pressed("Oriented strand board: 20 rows of hybrid poplar, pressed to 640 kg/m3 and tested with five qualities "
               "of glue."),
       ""},
      {"hot_osb",
       "Three-layer OSB of 640 kg/m3 and about 12 mm from the hot press: strands of all angles about their layer's, "
       "PF\n"
       "in the faces, pMDI in the core (docs/hotpress.md). `strandlab run` presses it strand by strand; `strandlab "
       "hotpress`\nanswers in a second how long to press, with a column of its layers.",
       "[mat]\nlength_mm = 60\nrows = [\"surface*8\", \"core*18\", \"surface*8\"]\n"
       "[kinds.surface]\nangle_sd_deg = 25\nyield_factor = 1\n[kinds.core]\nangle_sd_deg = 25\nyield_factor = 1\n"
       "[hotpress.resin]\nface_kinds = [\"surface\"]\n"},
      {"osb3d",
       "Three-layer OSB in three dimensions: 60 x 60 mm of a panel that goes on for ever, strands of 40 x 8 mm, "
       "pressed to 60 %.\n"
       "Strands yield by Hill's law, as in Le (2010): do not believe the pressures (docs/panels3d.md).",
       "[mat]\nlength_mm = 60\nwidth_mm = 60\nrows = [\"surface*2\", \"core*4\", \"surface*2\"]\n"
       "[kinds.surface]\nlength_mm = 40\nwidth_mm = 8\nyield_factor = 1\nlaw = \"hill\"\n"
       "[kinds.core]\nlength_mm = 40\nwidth_mm = 8\nyield_factor = 1\nlaw = \"hill\"\n"
       "[press]\ncompactions = [0.5, 0.6]\n[grid]\ncell_aspect = 6\n"
       "[glue]\ncompliance_t_mm_per_MPa = [0, 0.0105, 0.05]\n[test]\nelement_length_mm = 2\n"},
      {"osl", pressed("Oriented strand lumber: 20 rows of strands along the panel, pressed to 640 kg/m3."),
       fmt::format("[mat]\n{}", kAlong)},
      {"plywood", pressed("Plywood: the rows of the OSB case without gaps, pressed to 640 kg/m3."),
       fmt::format("[kinds.surface]\n{0}[kinds.core]\n{0}{1}", kFullRow, kFullStates)},
      {"lvl", pressed("Laminated veneer lumber: 20 rows along the panel without gaps, pressed to 640 kg/m3."),
       fmt::format("[mat]\n{0}[kinds.surface]\n{1}[kinds.core]\n{1}{2}", kAlong, kFullRow, kFullStates)},
      le2010("le2010_osb", published("Oriented strand board: 20 rows of hybrid poplar."), ""),
      le2010("le2010_osl", published("Oriented strand lumber: all 20 rows along the panel."), kAlong),
      le2010("le2010_plywood", published("Plywood: the rows of the OSB case without gaps."), "", kFullRow, kFullRow),
      le2010("le2010_lvl", published("Laminated veneer lumber: 20 rows along the panel without gaps."), kAlong,
             kFullRow, kFullRow),
      le2010("osb_vtc50",
             "OSB with densified surfaces: all surface rows, half of the volume, are VTC strands as long as the normal "
             "ones.\n"
             "Le (2010), section 3.6.4.1.",
             "", "material = \"vtc\"\n"),
      rathi("rathi20_control", "Control of the panel with 20 % VTC: two surface rows of normal strands on either side.",
            2, 16, ""),
      rathi("rathi20_vtc",
            "Panel with about 20 % of its weight in VTC strands: one surface row of them on either side.", 1, 19,
            kVtcSurface),
      rathi("rathi40_control",
            "Control of the panel with 40 % VTC: four surface rows of normal strands on either side.", 4, 12, ""),
      rathi("rathi40_vtc",
            "Panel with about 40 % of its weight in VTC strands: two surface rows of them on either side.", 2, 14,
            kVtcSurface),
      chapter5(75, 15),
      chapter5(75, 30),
      chapter5(150, 15),
      chapter5(150, 30)};
  return list;
}

const Ready& find(const std::string& name) {
  for (const auto& ready : table()) {
    if (ready.name == name) return ready;
  }
  const auto near = nearest(name, ready_cases());
  throw InputError(fmt::format("there is no ready case \"{}\"{} Ready cases: {}", name,
                               near.empty() ? "." : fmt::format("; did you mean \"{}\"?", near),
                               quoted_list(ready_cases())));
}

}  // namespace

const std::vector<std::string>& ready_cases() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const auto& ready : table()) list.push_back(ready.name);
    return list;
  }();
  return names;
}

std::string ready_case_title(const std::string& name) {
  return find(name).title;
}

Case ready_case(const std::string& name) {
  auto c = case_from_text(find(name).changes, name);
  c.name = name;
  return c;
}

}  // namespace strandlab::cases
