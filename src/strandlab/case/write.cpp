#include "strandlab/case/write.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>

#include "strandlab/case/keys.hpp"

namespace strandlab::cases {
namespace {

template <class Visit>
void for_each_key(const std::string& section, Visit visit) {
  for (const auto& key : keys()) {
    if (section_of(key) == section) visit(key);
  }
}

const Section& find_section(const std::string& path) {
  return *std::find_if(sections().begin(), sections().end(), [&](const Section& s) { return s.path == path; });
}

// [materials] has no entry in most cases: one is shown as a comment.
std::string example_material() {
  Case c;
  MaterialSettings settings;
  settings.material = wood::library().front();
  settings.base = settings.material.name;
  settings.material.name = "NAME";
  c.materials.push_back(settings);
  std::string text = fmt::format("# [materials.NAME]  # {}\n", find_section("materials.*").help);
  for_each_key("materials.*", [&](const Key& key) {
    text += fmt::format("# {} = {}  # {}\n", name_of(key), to_toml(key.get(c, "NAME")), meaning(key, c));
  });
  return text + "\n";
}

bool is_given(const Value& value) {
  const auto* numbers = std::get_if<std::vector<double>>(&value);
  const auto* texts = std::get_if<std::vector<std::string>>(&value);
  return !(numbers && numbers->empty()) && !(texts && texts->empty());
}

// [hotpress] and what it names.
bool of_cycle(const std::string& section) {
  return section.rfind("hotpress", 0) == 0 || section == "resins.*";
}

Step step_of(const std::string& section) {
  if (section == "press" || section == "grid" || of_cycle(section)) return Step::kPress;
  return section == "glue" || section == "test" ? Step::kTest : Step::kMat;
}

// Default of a key as the reference page shows it; kinds differ in theirs.
std::string default_text(const Key& key, const Case& defaults) {
  const auto section = section_of(key);
  if (section == "materials.*") {
    if (name_of(key) == "base") return "\"poplar\"";
    return name_of(key) == "species" ? "\"\"" : "that of the base";
  }
  if (section != "kinds.*") {
    const auto value = key.get(defaults, section == "resins.*" ? "NAME" : "");
    return is_given(value) ? to_toml(value) : "not given";
  }
  const auto surface = to_toml(key.get(defaults, "surface")), core = to_toml(key.get(defaults, "core"));
  const auto other = to_toml(key.get(defaults, "NAME"));
  if (surface == other) return surface == core ? surface : fmt::format("{}; core {}", surface, core);
  return fmt::format("{}; surface {}; core {}", other, surface, core);
}

// A | would end the table cell.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char ch : text) {
    if (ch == '|') escaped += '\\';
    escaped += ch;
  }
  return escaped;
}

std::string sentence(std::string text) {
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text + ".";
}

}  // namespace

std::string resolved_text(const Case& c) {
  std::string text;
  for (const auto& section : sections()) {
    for (const auto& name : instances(c, section.path)) {
      text += fmt::format("{}[{}]\n", text.empty() ? "" : "\n", with_name(section.path, name));
      for_each_key(section.path, [&](const Key& key) {
        if (is_foreign(key, c)) return;
        const auto value = key.get(c, name);
        if (is_given(value)) text += fmt::format("{} = {}\n", name_of(key), to_toml(value));
      });
    }
  }
  return text;
}

std::string commented_text(const Case& c, const std::string& title) {
  std::string text = "# " + title;
  for (auto end = text.find('\n'); end != std::string::npos; end = text.find('\n', end + 1)) text.insert(end + 1, "# ");
  text += "\n# Any key that is left out has the value shown by `strandlab init osb`.\n\n";
  for (const auto& section : sections()) {
    const auto names = instances(c, section.path);
    if (section.path == "materials.*" && names.empty()) text += example_material();
    for (const auto& name : names) {
      text += fmt::format("[{}]  # {}\n", with_name(section.path, name), section.help);
      for_each_key(section.path, [&](const Key& key) {
        if (is_foreign(key, c)) return;
        const auto value = key.get(c, name);
        text += fmt::format("{}{} = {}  # {}\n", is_given(value) ? "" : "# ", name_of(key), to_toml(value),
                            meaning(key, c));
      });
      text += "\n";
    }
  }
  text.pop_back();
  return text;
}

std::string reference_text() {
  Case defaults;
  defaults.resins.push_back({"NAME"});
  defaults.kinds.emplace_back().name = "NAME";
  std::string text =
      "# Keys of a case file\n\nPrinted by `strandlab init --reference`. A case file is TOML; any key may be left out, "
      "and any key can be\n"
      "overridden on the command line: `--set press.speed_m_s=8`.\n";
  for (const auto& section : sections()) {
    const auto title = with_name(section.path, "NAME");
    text += fmt::format(
        "\n## [{}]\n\n{}\n\n| key | type | unit | allowed | default | meaning |\n|---|---|---|---|---|---|\n", title,
        sentence(section.help));
    for_each_key(section.path, [&](const Key& key) {
      const auto example =
          section.path == "materials.*"
              ? (name_of(key) == "base" || name_of(key) == "species" ? Value(std::string()) : Value(0.0))
              : key.get(defaults, section.path == "kinds.*"    ? "surface"
                                  : section.path == "resins.*" ? "NAME"
                                                               : "");
      text += fmt::format("| `{}` | {} | {} | {} | `{}` | {} |\n", name_of(key), type_name(example), key.unit,
                          cell(allowed(key, defaults)), default_text(key, defaults), cell(key.help));
    });
  }
  return text;
}

std::vector<std::string> identity(const Case& c, Step last) {
  std::vector<std::string> lines;
  for (const auto& key : keys()) {
    const auto section = section_of(key);
    if (!(key.changes_results || (of_cycle(section) && presses_hot(c))) || step_of(section) > last ||
        is_foreign(key, c))
      continue;
    for (const auto& name : instances(c, section)) {
      const auto value = key.get(c, name);
      if (is_given(value)) lines.push_back(fmt::format("{} = {}", with_name(key.path, name), to_toml(value)));
    }
  }
  return lines;
}

std::string case_hash(const Case& c, Step last) {
  std::uint64_t hash = 14695981039346656037U;  // FNV-1a, 64 bits
  for (const auto& line : identity(c, last)) {
    for (const char ch : line + "\n") hash = (hash ^ static_cast<unsigned char>(ch)) * 1099511628211U;
  }
  return fmt::format("{:016x}", hash);
}

}  // namespace strandlab::cases
