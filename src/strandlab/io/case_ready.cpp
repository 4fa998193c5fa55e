// The ready cases: what each changes in the defaults, which are those of OSB.
#include <fmt/format.h>

#include <string>
#include <vector>

#include "strandlab/core/error.hpp"
#include "strandlab/core/nearest.hpp"
#include "strandlab/io/case.hpp"

namespace strandlab::io {
namespace {

constexpr const char* kFullRows =
    "[kinds.surface]\nlength_mm = 0\nlength_sd_mm = 0\ngap_mm = 0\ngap_sd_mm = 0\n"
    "[kinds.core]\nlength_mm = 0\nlength_sd_mm = 0\ngap_mm = 0\ngap_sd_mm = 0\n";

struct Ready {
  std::string name;
  std::string title;
  std::string changes;  // as a case file
};

const std::vector<Ready>& table() {
  static const std::vector<Ready> list{
      {"osb",
       "Oriented strand board: 20 rows of hybrid poplar, pressed to 40 % and tested with five qualities of glue.", ""},
      {"osl", "Oriented strand lumber: all 20 rows along the panel.", "[mat]\nrows = [\"surface*20\"]\n"},
      {"plywood", "Plywood: the rows of the OSB case without gaps.", kFullRows},
      {"lvl", "Laminated veneer lumber: 20 rows along the panel without gaps.",
       fmt::format("[mat]\nrows = [\"surface*20\"]\n{}", kFullRows)}};
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

}  // namespace strandlab::io
