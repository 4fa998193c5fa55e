// What the page's words mean, told where they first stand.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace strandlab::report {

struct Meaning {
  std::string word, means;  // as docs/glossary.md has it
};

const std::vector<Meaning>& glossary();

// HTML in which each word of the glossary that is not in `told` yet carries its meaning (<abbr title>), where it first
// stands; `told` grows by those. `html` is escaped text without elements.
std::string with_meanings(std::string html, std::set<std::string>& told);

}  // namespace strandlab::report
