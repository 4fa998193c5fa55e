// Units that laboratories write in their tables, and their size in ours (mm, N, MPa, N/mm, kg/m3, s, C).
#pragma once

#include <optional>
#include <string>

namespace strandlab::table {

enum class Dimension { kText, kLength, kModulus, kForce, kStiffness, kDensity, kPressure, kTime, kTemperature };

// Size of a unit in mm, MPa, N, N/mm, kg/m3, s or degrees Celsius; nothing where the unit is not known for that
// dimension. Case, blanks, ^2 or the superscript, and "_per_" or "/" make no difference.
std::optional<double> unit_factor(Dimension dimension, const std::string& unit);

// The known units of a dimension, for messages: "mm, cm, m, ...".
std::string known_units(Dimension dimension);

}  // namespace strandlab::table
