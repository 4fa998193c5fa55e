// JSON from files that anyone may have written: nothing in them may exhaust the stack or the memory.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace strandlab::files {

inline constexpr int kDeepestJson = 100;  // lists and objects within each other

// The value of a JSON text. Throws InputError ("source: line N: not <what>: ...") for a text that is not UTF-8 or
// valid JSON or is nested more than kDeepestJson deep: what reads, copies or writes JSON calls itself for every level.
nlohmann::json json_from_text(const std::string& text, const std::string& source, const std::string& what);

// The same of a file of at most 2 GiB. `what` says what the file should be ("a mat file"). Throws InputError also
// for a folder, and a file that cannot be read or is larger.
nlohmann::json read_json(const std::filesystem::path& file, const std::string& what);

}  // namespace strandlab::files
