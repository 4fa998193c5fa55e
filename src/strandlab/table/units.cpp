#include "strandlab/table/units.hpp"

#include <array>
#include <cctype>
#include <string_view>
#include <utility>

namespace strandlab::table {
namespace {

struct Unit {
  Dimension dimension;
  const char* name;  // lower case, no blanks
  const char* shown;
  double factor;
};

constexpr double kInch = 25.4;                   // mm, exact
constexpr double kPoundForce = 4.4482216152605;  // N, exact
constexpr double kKilopond = 9.80665;            // N, exact
constexpr double kFoot = 12 * kInch / 1000;      // m, exact
constexpr double kPound = 0.45359237;            // kg, exact
constexpr double kPoundPerCubicFoot = kPound / (kFoot * kFoot * kFoot);
constexpr double kPsi = kPoundForce / kInch / kInch;  // MPa

constexpr std::array kUnits{
    Unit{Dimension::kLength, "mm", "mm", 1},
    Unit{Dimension::kLength, "cm", "cm", 10},
    Unit{Dimension::kLength, "m", "m", 1000},
    Unit{Dimension::kLength, "um", "um", 1e-3},
    Unit{Dimension::kLength, "in", "in", kInch},
    Unit{Dimension::kLength, "inch", "", kInch},
    Unit{Dimension::kLength, "inches", "", kInch},
    Unit{Dimension::kLength, "mil", "mil", kInch / 1000},
    Unit{Dimension::kModulus, "mpa", "MPa", 1},
    Unit{Dimension::kModulus, "n/mm2", "N/mm2", 1},
    Unit{Dimension::kModulus, "gpa", "GPa", 1000},
    Unit{Dimension::kModulus, "kn/mm2", "kN/mm2", 1000},
    Unit{Dimension::kModulus, "kpa", "kPa", 1e-3},
    Unit{Dimension::kModulus, "pa", "Pa", 1e-6},
    Unit{Dimension::kModulus, "psi", "psi", kPsi},
    Unit{Dimension::kModulus, "ksi", "ksi", 1e3 * kPsi},
    Unit{Dimension::kModulus, "msi", "Msi", 1e6 * kPsi},
    Unit{Dimension::kForce, "n", "N", 1},
    Unit{Dimension::kForce, "kn", "kN", 1000},
    Unit{Dimension::kForce, "lbf", "lbf", kPoundForce},
    Unit{Dimension::kForce, "lb", "", kPoundForce},
    Unit{Dimension::kForce, "kgf", "kgf", kKilopond},
    Unit{Dimension::kStiffness, "n/mm", "N/mm", 1},
    Unit{Dimension::kStiffness, "kn/mm", "kN/mm", 1000},
    Unit{Dimension::kStiffness, "n/m", "N/m", 1e-3},
    Unit{Dimension::kStiffness, "kn/m", "kN/m", 1},
    Unit{Dimension::kStiffness, "mn/m", "MN/m", 1000},
    Unit{Dimension::kStiffness, "n/um", "N/um", 1000},
    Unit{Dimension::kStiffness, "lbf/in", "lbf/in", kPoundForce / kInch},
    Unit{Dimension::kStiffness, "lb/in", "", kPoundForce / kInch},
    Unit{Dimension::kDensity, "kg/m3", "kg/m3", 1},
    Unit{Dimension::kDensity, "kg_m3", "", 1},
    Unit{Dimension::kDensity, "g/cm3", "g/cm3", 1000},
    Unit{Dimension::kDensity, "g_cm3", "", 1000},
    Unit{Dimension::kDensity, "kgm-3", "", 1},
    Unit{Dimension::kDensity, "gcm-3", "", 1000},
    Unit{Dimension::kDensity, "g/cc", "", 1000},
    Unit{Dimension::kDensity, "lb/ft3", "lb/ft3", kPoundPerCubicFoot},
    Unit{Dimension::kDensity, "lb_ft3", "", kPoundPerCubicFoot},
    Unit{Dimension::kDensity, "lbs/ft3", "", kPoundPerCubicFoot},
    Unit{Dimension::kDensity, "lbm/ft3", "", kPoundPerCubicFoot},
    Unit{Dimension::kDensity, "lb/cuft", "", kPoundPerCubicFoot},
    Unit{Dimension::kDensity, "lbs/cuft", "", kPoundPerCubicFoot},
    Unit{Dimension::kDensity, "lbm/cuft", "", kPoundPerCubicFoot},
    Unit{Dimension::kDensity, "pcf", "pcf", kPoundPerCubicFoot},
    Unit{Dimension::kPressure, "mpa", "MPa", 1},
    Unit{Dimension::kPressure, "n/mm2", "N/mm2", 1},
    Unit{Dimension::kPressure, "bar", "bar", 0.1},
    Unit{Dimension::kPressure, "kpa", "kPa", 1e-3},
    Unit{Dimension::kPressure, "kgf/cm2", "kgf/cm2", kKilopond / 100},
    Unit{Dimension::kPressure, "kg/cm2", "", kKilopond / 100},
    Unit{Dimension::kPressure, "psi", "psi", kPsi},
    Unit{Dimension::kTime, "s", "s", 1},
    Unit{Dimension::kTime, "sec", "", 1},
    Unit{Dimension::kTime, "seconds", "", 1},
    Unit{Dimension::kTime, "ms", "ms", 1e-3},
    Unit{Dimension::kTime, "min", "min", 60},
    Unit{Dimension::kTemperature, "c", "C", 1},
    Unit{Dimension::kTemperature, "°c", "", 1},
    Unit{Dimension::kTemperature, "degc", "", 1},
};

void replace_all(std::string& text, std::string_view what, std::string_view with) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size()))
    text.replace(at, what.size(), with);
}

std::string normal_form(const std::string& unit) {
  std::string text;
  for (char c : unit)
    if (!std::isspace(static_cast<unsigned char>(c)))
      text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const auto& [what, with] :
       {std::pair{"_per_", "/"}, std::pair{"per", "/"}, std::pair{"\xC2\xB2", "2"}, std::pair{"^2", "2"},
        std::pair{"\xE2\x81\xBB\xC2\xB3", "-3"}, std::pair{"\xC2\xB3", "3"}, std::pair{"^3", "3"},
        std::pair{"cu.ft", "cuft"}, std::pair{"\xC2\xB5", "u"}, std::pair{"\xCE\xBC", "u"}, std::pair{"\"", "in"}})
    replace_all(text, what, with);
  return text;
}

}  // namespace

std::optional<double> unit_factor(Dimension dimension, const std::string& unit) {
  const std::string wanted = normal_form(unit);
  for (const auto& known : kUnits)
    if (known.dimension == dimension && wanted == known.name) return known.factor;
  return std::nullopt;
}

std::string known_units(Dimension dimension) {
  std::string list;
  for (const auto& known : kUnits)
    if (known.dimension == dimension && *known.shown != '\0')
      list += (list.empty() ? "" : ", ") + std::string(known.shown);
  return list;
}

}  // namespace strandlab::table
