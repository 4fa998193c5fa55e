// Records of a press's controller, to follow in place of a schedule.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "strandlab/hotpress/schedule.hpp"

namespace strandlab::hotpress {

// What a log says, against time in s as it counts it. Empty: the log does not say it. Position or pressure is there.
struct Log {
  std::vector<Point> position;                   // m, gap between the platens
  std::vector<Point> pressure;                   // Pa
  std::vector<Point> platen_top, platen_bottom;  // C
};

// Which column is what: its name in the header, or its number (1 the first), either with a unit where the header states
// none: "Pos mm", "3 mm". Empty: found by usual names.
struct LogColumns {
  std::string time, position, pressure, platen_top, platen_bottom;
};

// Reads a table (table/table.hpp says what it may look like). Throws InputError with the line and the reason: no such
// column, no unit, text for a number, time that does not go on, neither position nor pressure, fewer than two rows.
Log read_log(const std::filesystem::path& file, const LogColumns& columns = {});
Log log_from_text(const std::string& text, const std::string& source, const LogColumns& columns = {});

}  // namespace strandlab::hotpress
