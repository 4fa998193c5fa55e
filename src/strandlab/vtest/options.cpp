#include "strandlab/vtest/options.hpp"

#include <algorithm>
#include <string>

namespace strandlab::vtest {

std::vector<Declaration<Options>> bond_options() {
  return {declare("compliance_t_mm_per_MPa", "mm/MPa", kAny,
                  "glue-line compliances 1/D_t along the strands; 0 is a perfect bond, and so is a negative one",
                  &Options::compliance_t_mm_per_MPa),
          declare("compliance_n_mm_per_MPa", "mm/MPa", kNotNegative, "glue-line compliance 1/D_n across the line",
                  &Options::compliance_n_mm_per_MPa)};
}

std::vector<Declaration<Options>> test_options() {
  Declaration<Options> kinds{"kinds",
                             "",
                             kAny,
                             "virtual tests of the panel at each compaction and glue compliance",
                             [](const Options& o) {
                               std::vector<std::string> names(o.kinds.size());
                               std::transform(o.kinds.begin(), o.kinds.end(), names.begin(), name);
                               return OptionValue(names);
                             },
                             [](Options& o, const OptionValue& value) {
                               o.kinds.clear();
                               for (const auto& text : std::get<std::vector<std::string>>(value))
                                 o.kinds.push_back(test_from_name(text));
                             },
                             test_names()};
  return {std::move(kinds),
          declare("elements_through_strand", "", {.lo = 1, .hi = kMostElements},
                  "finite elements through the thickness of a strand", &Options::elements_through_strand),
          declare("element_length_mm", "mm", {.lo = 0.05, .hi = 100},
                  "length of finite elements along and across strands, for mat files in 3D (docs/panels3d.md)",
                  &Options::element_length_mm),
          declare("span_to_thickness", "", {.lo = 8, .hi = 200},
                  "span of 3- and 4-point bending over the panel's thickness: 20 in EN 310, 24 in ASTM D1037",
                  &Options::span_to_thickness)};
}

}  // namespace strandlab::vtest
