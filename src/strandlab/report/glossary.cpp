#include "strandlab/report/glossary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

namespace strandlab::report {
namespace {

bool is_letter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || (static_cast<unsigned char>(c) & 0x80U) != 0;
}

// Where a word stands on its own, or with the s of a plural; npos: nowhere.
std::size_t find_word(const std::string& text, const std::string& word, std::size_t from) {
  for (auto at = text.find(word, from); at != std::string::npos; at = text.find(word, at + 1)) {
    auto end = at + word.size();
    if (end < text.size() && text[end] == 's') ++end;
    if ((at == 0 || !is_letter(text[at - 1])) && (end >= text.size() || !is_letter(text[end]))) return at;
  }
  return std::string::npos;
}

}  // namespace

const std::vector<Meaning>& glossary() {
  static const std::vector<Meaning> list{
      {"compaction", "1 - thickness/initial thickness of the mat: 0 as formed, .5 at half the thickness."},
      {"1/D_t",
       "Glue-line compliance: by how many mm two strands slide on each other per MPa of shear stress in the line, "
       "mm/MPa; 0 is perfect, larger is worse."},
      {"perfect bond", "A line that does not slide at all, 1/D_t = 0."},
      {"PF", "Phenol-formaldehyde resin."},
      {"PVA", "Polyvinyl acetate, white glue."},
      {"VTC",
       "Viscoelastic thermal compression: wood densified by heat, steam and pressure, here the material `vtc` of 910 "
       "kg/m³."},
      {"platen", "One of the two stiff plates that press the mat."},
      {"undulation",
       "How strands bend around gaps and strand ends below and above them; seen as the grain angle in degrees."},
      {"density profile", "Density through the thickness, kg/m³ against mm."},
      {"EN 300", "The European standard that sorts OSB into classes by their properties; no test here."},
      {"inertia",
       "The strands' resistance to being moved quickly, which a mill's press does not show and one of 16 m/s shows a "
       "little (docs/user-guide.md)."},
      {"section",
       "What is computed: a vertical cut along the panel, 1 mm deep, in plane strain, that is without stretch across."},
      {"seed", "The number (`run.seed`) from which all chance in a mat follows: the same seed gives the same mat."}};
  return list;
}

std::string with_meanings(std::string html, std::set<std::string>& told) {
  std::size_t behind = 0;  // nothing before it is looked at again: it may be an element by now
  while (true) {
    std::pair<std::size_t, const Meaning*> first{std::string::npos, nullptr};
    for (const auto& entry : glossary()) {
      if (told.count(entry.word) > 0) continue;
      const auto at = find_word(html, entry.word, behind);
      if (at < first.first) first = {at, &entry};
    }
    if (!first.second) return html;
    const auto& [word, means] = *first.second;
    const auto marked = fmt::format("<abbr title=\"{}\">{}</abbr>", means, word);
    html.replace(first.first, word.size(), marked);
    behind = first.first + marked.size();
    told.insert(word);
  }
}

}  // namespace strandlab::report
