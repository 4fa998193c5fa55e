// Text that users, files and file names bring: whether it is UTF-8, and how messages and results show it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace strandlab {

// Bytes of the UTF-8 character that opens a text; 0 where there is none, and for an empty text.
std::size_t utf8_length(std::string_view text);
bool is_utf8(std::string_view text);

// Valid UTF-8: the text itself where it is; else each byte that belongs to no character is written \xfc. For the names
// of files in results: a file name is any bytes, run.json, case.toml, the log and the report are UTF-8, and two names
// must stay two.
std::string as_text(std::string_view bytes);

// as_text() on one line that no terminal obeys: control characters are written \x1b, \x0a, \u009b.
std::string printable(std::string_view text);

// A value as a message shows it: where it is longer than `characters` by more than its length takes to tell, its
// beginning and its length.
std::string shortened(std::string_view text, std::size_t characters = 60);

// A message on one line of a terminal, whatever the user's bytes in it; of one longer than 4000 bytes the middle is
// left out.
std::string one_line(const std::string& message);

// Throws InputError for bytes that no text file of ours holds: UTF-16 (with a byte-order mark or without), a NUL byte.
// `source` names the file.
void refuse_binary(std::string_view bytes, const std::string& source);
// The same, and for bytes that are not UTF-8.
void refuse_other_than_utf8(std::string_view bytes, const std::string& source);

}  // namespace strandlab
