// What the texts of cells say: numbers, marks of missing values, names and units in headers.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "strandlab/table/units.hpp"

namespace strandlab::table {

// Without blanks at its ends.
std::string trimmed(std::string_view text);
// In small letters, of ASCII.
std::string lower(std::string text);
// The text itself where it is UTF-8; else taken as Latin-1, which older spreadsheets write.
std::string as_utf8(std::string_view text);

// --- numbers ---
// Empty, -, NA, nan and the like.
bool is_missing_mark(const std::string& cell);
// Digits without what is only there for the eye: blanks, no-break and thin spaces, apostrophes; a typographic minus
// becomes a hyphen.
std::string bare_number(const std::string& cell);
// Does it start like a number: is it meant to be one? And does it consist of what numbers consist of?
bool looks_like_number(const std::string& cell);
bool is_number(const std::string& cell);
// What the marks in a bare number say about the file it stands in; kThreeDigits: 9.936 or 9,936, a decimal or a
// thousand.
enum class Mark { kNone, kPoint, kComma, kThreeDigits };
Mark mark_of(const std::string& number);

// --- headers ---
// The text a header or units cell holds between brackets and separators: "_mm", " (mm)", "[mm]", ", in mm" -> "mm".
std::string unit_text(std::string_view rest);
// What follows `name` in a header, nothing when the header does not start with that name as a word of its own.
std::optional<std::string> after_name(const std::string& header, const std::string& name);
// What stands around `name` in a header that holds it as a word of its own, be it behind others: "S1 Density (kg/m3)".
// Nothing for a name of one letter.
std::optional<std::string> around_name(const std::string& header, const std::string& name);
// Unit and other words of a header behind its name: the longest run of whole words that is a known unit. The words
// before and after it are the label: " 3 (kg/m3)" -> kg/m3, 3. Without a known unit all is label.
struct UnitAndLabel {
  std::string unit, label;
};
UnitAndLabel unit_and_label(Dimension dimension, const std::string& rest);

}  // namespace strandlab::table
