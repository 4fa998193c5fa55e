// Nearest known name to a misspelt one, for messages about input.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace strandlab {

// Number of single-character insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`
// (restricted Damerau-Levenshtein distance); upper and lower case count as equal.
int edit_distance(std::string_view a, std::string_view b);

// The known name that `given` most likely meant: the smallest edit distance, at most a third of the longer name's
// length and at least 1 allowed; the first of equals. Empty when nothing is near.
std::string nearest(std::string_view given, const std::vector<std::string>& known);

// The known names in a sentence: "a", "b", "c".
std::string quoted_list(const std::vector<std::string>& names);

}  // namespace strandlab
