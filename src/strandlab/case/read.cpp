#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <utility>

#include "strandlab/bondline/analysis.hpp"
#include "strandlab/case/case.hpp"
#include "strandlab/case/keys.hpp"
#include "strandlab/case/plate_mat.hpp"
#include "strandlab/case/write.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/core/input_errors.hpp"
#include "strandlab/core/nearest.hpp"
#include "strandlab/core/text.hpp"
#include "strandlab/glue/bond.hpp"
#include "strandlab/glue/measured.hpp"
#include "strandlab/transfer/cure.hpp"

namespace strandlab::cases {
namespace {

namespace fs = std::filesystem;
using Path = std::vector<std::string>;  // of a key, its parts between dots

const Path kPlateWidth{"mat", "width_mm"};  // the key that makes a case one of a plate

// A value or a section as it was given, and where.
struct Given {
  Path path;
  const toml::node* node = nullptr;
  std::string where;  // opens messages: "panel.toml:12", "--set press.speed_m_s=..."
  bool in_file = false;
};

struct Source {
  toml::table table;
  std::string name;  // of the file, or "--set ..."
  bool in_file = false, has_lines = false;
  fs::path folder;  // relative file names count from here
};

// ---- Text to tables -------------------------------------------------------------------------------------------------

constexpr std::size_t kLongestReason = 200;  // characters of a library's sentence

std::string line_at(const std::string& text, std::size_t number) {
  std::istringstream lines(text);
  std::string line;
  for (std::size_t i = 0; i < number; ++i) std::getline(lines, line);
  return line;
}

// "1,5" and "-0,25" with a decimal point; nothing for another text.
std::optional<std::string> with_decimal_point(const std::string& value) {
  static const std::regex kDecimalComma(R"(\s*([-+]?[0-9]{1,18}),([0-9]{1,18})\s*)");
  std::smatch part;
  if (value.size() > 50 || !std::regex_match(value, part, kDecimalComma)) return std::nullopt;
  return fmt::format("{}.{}", part[1].str(), part[2].str());
}

// What most likely is meant by a value that is not TOML, to end the message; empty where nothing is known.
std::string hint(const std::string& value) {
  if (const auto number = with_decimal_point(value.substr(0, value.find('#'))))
    return fmt::format("; numbers have a decimal point: {}", *number);
  if (value.find('\\') != std::string::npos)
    return "; \\ has a meaning of its own in TOML: write / in file names, or single quotes: 'C:\\mats\\a.json'";
  return {};
}

toml::table parse_toml(const std::string& text, const std::string& source) {
  refuse_other_than_utf8(text, source);
  try {
    return toml::parse(text, source);
  } catch (const toml::parse_error& e) {
    const auto line = line_at(text, e.source().begin.line);
    const auto equals = line.find('=');
    throw InputError(fmt::format("{}:{}: not valid TOML: {}{}", source, e.source().begin.line,
                                 shortened(e.description(), kLongestReason),
                                 equals == std::string::npos ? "" : hint(line.substr(equals + 1))));
  }
}

// A list of bare words, [a, b], with its words quoted; nothing where it is not one.
std::optional<std::string> quote_bare_words(const std::string& value) {
  const auto plain = [](const std::string& text) { return text.find_first_of("\"'[]{}\\,=#") == std::string::npos; };
  const auto trimmed = [](const std::string& text) {
    const auto first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
    return first == std::string::npos ? std::string() : text.substr(first, last - first + 1);
  };
  if (plain(value)) return fmt::format("\"{}\"", value);
  if (value.size() < 2 || value.front() != '[' || value.back() != ']') return std::nullopt;
  std::string list;
  std::istringstream items(value.substr(1, value.size() - 2));
  for (std::string item; std::getline(items, item, ',');) {
    item = trimmed(item);
    if (item.empty() || !plain(item)) return std::nullopt;
    list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", item);
  }
  return "[" + list + "]";
}

// Numbers written .5 or -.5 as TOML wants them, 0.5; anything else as it is.
std::string complete_numbers(const std::string& value) {
  std::string result;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const bool opens = i == 0 || std::string("[, \t+-").find(value[i - 1]) != std::string::npos;
    if (value[i] == '.' && opens && i + 1 < value.size() && value[i + 1] >= '0' && value[i + 1] <= '9') result += '0';
    result += value[i];
  }
  return result;
}

// One "key.path=value"; `name` opens messages.
Source parse_override(const std::string& text, std::string name) {
  Source source;
  source.name = std::move(name);
  if (!is_utf8(text) || text.find('\0') != std::string::npos)
    throw InputError(fmt::format("{}: holds bytes that are no text in UTF-8", printable(source.name)));
  source.folder = fs::current_path();
  const auto equals = text.find('=');
  const bool one_line = text.find_first_of("\n\r") == std::string::npos;
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size() || !one_line) {
    throw InputError(fmt::format("{}: expected key.path=value, as in --set press.speed_m_s=8", source.name));
  }
  const auto key = text.substr(0, equals), value = text.substr(equals + 1);
  for (const auto& candidate : {value, complete_numbers(value)}) {
    try {
      source.table = toml::parse(fmt::format("{} = {}", key, candidate));
      return source;
    } catch (const toml::parse_error&) {
      // A word without quotes is not TOML; the shell eats quotes, so it is accepted below.
    }
  }
  const auto words = quote_bare_words(value);
  try {
    if (words) {
      source.table = toml::parse(key + " = " + *words);
      return source;
    }
  } catch (const toml::parse_error&) {
    // Then the key itself is malformed.
  }
  throw InputError(
      fmt::format("{}: expected key.path=value with a TOML value or a bare word, as in "
                  "--set press.compactions=[0,0.2]{}",
                  source.name, hint(value)));
}

// ---- Tables to keys -------------------------------------------------------------------------------------------------

Path split(const std::string& dotted) {
  Path parts;
  std::istringstream stream(dotted);
  for (std::string part; std::getline(stream, part, '.');) parts.push_back(part);
  return parts;
}

bool fits(const Path& pattern, const Path& path) {
  return pattern.size() == path.size() && std::equal(pattern.begin(), pattern.end(), path.begin(),
                                                     [](const auto& a, const auto& b) { return a == "*" || a == b; });
}

const Key* find_key(const Path& path) {
  const auto it = std::find_if(keys().begin(), keys().end(), [&](const Key& k) { return fits(split(k.path), path); });
  return it == keys().end() ? nullptr : &*it;
}

// The name that stands for the * of the key's path.
std::string instance_of(const Path& path) {
  return path.size() == 3 ? path[1] : std::string();
}

bool is_section(const Path& path) {
  return std::any_of(sections().begin(), sections().end(), [&](const Section& s) {
    const auto pattern = split(s.path);
    return fits(pattern, path) || (pattern.size() == 2 && path.size() == 1 && pattern[0] == path[0]);
  });
}

// Ends a sentence about an unknown name.
std::string did_you_mean(const std::string& given, const std::vector<std::string>& known) {
  const auto near = nearest(given, known);
  return near.empty() ? "." : fmt::format("; did you mean {}?", near);
}

// As messages name a key or a section.
std::string name_of(const Path& path) {
  return shortened(fmt::format("{}", fmt::join(path, ".")));
}

[[noreturn]] void throw_unknown_section(const Given& given) {
  std::vector<std::string> known;
  for (const auto& s : sections()) {
    const auto first = split(s.path)[0];
    if (std::find(known.begin(), known.end(), first) == known.end()) known.push_back(first);
  }
  const auto name = name_of(given.path);
  throw InputError(fmt::format("{}: unknown section [{}]{} Sections: {}", given.where, name,
                               did_you_mean(given.path[0], known), fmt::join(known, ", ")));
}

// The nearest key of the same section, else the same name in another section, else the nearest of all.
std::string nearest_key(const Path& path, const std::vector<std::string>& same_section) {
  if (const auto near = nearest(path.back(), same_section); !near.empty())
    return did_you_mean(path.back(), same_section);
  std::vector<std::string> everywhere;
  for (const auto& key : keys()) {
    if (name_of(key) == path.back()) return fmt::format("; did you mean {}?", key.path);
    everywhere.push_back(key.path);
  }
  return did_you_mean(fmt::format("{}", fmt::join(path, ".")), everywhere);
}

[[noreturn]] void throw_unknown_key(const Given& given) {
  const auto name = name_of(given.path);
  const Path section(given.path.begin(), given.path.end() - 1);
  if (is_section(given.path)) {
    throw InputError(fmt::format("{}: {} is a section: its keys follow a line [{}]", given.where, name, name));
  }
  std::vector<std::string> here;
  for (const auto& key : keys()) {
    if (fits(split(section_of(key)), section)) here.push_back(name_of(key));
  }
  if (here.empty() && !section.empty()) throw_unknown_section({section, nullptr, given.where});
  std::string known = "Sections:";
  for (const auto& s : sections()) known += " [" + s.path + "]";
  if (!here.empty()) known = fmt::format("Keys of [{}]: {}", name_of(section), fmt::join(here, ", "));
  throw InputError(fmt::format("{}: unknown key {}{} {}", given.where, name, nearest_key(given.path, here), known));
}

// A part of a case that rules between keys look at: "kinds.core", "materials.fir", "press".
std::string part_of(const Path& path) {
  const bool named = std::any_of(sections().begin(), sections().end(),
                                 [&](const Section& s) { return !path.empty() && s.path == path[0] + ".*"; });
  return named && path.size() > 1 ? path[0] + "." + path[1] : path[0];
}

// The mistakes of a case, told together. Rules between keys are not held against parts in which one was found: they
// would speak of values that nobody gave.
class Mistakes {
 public:
  // Notes what `act` throws as InputError, a mistake in `part`.
  template <class Act>
  void note(const std::string& part, const Act& act) {
    try {
      act();
    } catch (const InputError& e) {
      messages_.emplace_back(e.what());
      spoilt_.insert(part);
    }
  }
  bool none_in(const std::string& part) const { return spoilt_.count(part) == 0; }
  // Of all parts that begin so: "kinds.".
  bool none_below(const std::string& parts) const {
    const auto first = spoilt_.lower_bound(parts);
    return first == spoilt_.end() || first->rfind(parts, 0) != 0;
  }
  // Throws InputError for one, InputErrors for several.
  void refuse() const {
    if (messages_.empty()) return;
    if (messages_.size() == 1) throw InputError(messages_.front());
    auto shown = messages_;
    constexpr std::size_t kShown = 20;
    if (shown.size() > kShown) {
      shown.resize(kShown);
      shown.push_back(fmt::format("... and {} more", messages_.size() - kShown));
    }
    throw InputErrors(std::move(shown));
  }

 private:
  std::vector<std::string> messages_;
  std::set<std::string> spoilt_;
};

void flatten(const Source& source, const toml::table& table, const Path& prefix, std::vector<Given>& out,
             Mistakes& mistakes) {
  for (auto&& [key, node] : table) {
    Given given{prefix, &node, source.name, source.in_file};
    given.path.emplace_back(key.str());
    if (source.has_lines) given.where += fmt::format(":{}", node.source().begin.line);
    const auto* section = node.as_table();
    if (find_key(given.path) != nullptr) {
      out.push_back(std::move(given));
    } else if (!section) {
      mistakes.note(part_of(given.path), [&] { throw_unknown_key(given); });
    } else if (!is_section(given.path)) {
      mistakes.note(part_of(given.path), [&] { throw_unknown_section(given); });
    } else {
      out.push_back({given.path, nullptr, given.where, given.in_file});
      flatten(source, *section, given.path, out, mistakes);
    }
  }
}

// ---- Values ---------------------------------------------------------------------------------------------------------

std::string type_of(const toml::node& node) {
  if (node.is_table()) return "a table";
  if (node.is_array()) return "a list";
  if (node.is_string()) return "a text";
  if (node.is_integer()) return "a whole number";
  if (node.is_floating_point()) return "a number";
  if (node.is_boolean()) return "true or false";
  return "a date or time";
}

// A value as the user may have written it, on one line; 3.0 is no whole number and must not look like one.
std::string as_given(const toml::node& node) {
  if (const auto* array = node.as_array()) {
    std::vector<std::string> items;
    for (const auto& item : *array) items.push_back(as_given(item));
    return fmt::format("[{}]", fmt::join(items, ", "));
  }
  if (const auto* text = node.as_string()) return fmt::format("\"{}\"", text->get());
  if (const auto* real = node.as_floating_point()) {
    const auto text = fmt::format("{}", real->get());
    return text.find_first_not_of("-0123456789") == std::string::npos ? text + ".0" : text;
  }
  std::ostringstream text;
  node.visit([&](const auto& n) { text << n; });
  return text.str();
}

// Minus zero is zero: the resolved case would say -0, which is a whole number and read back as 0.
std::optional<double> number(const toml::node& node) {
  if (!node.is_integer() && !node.is_floating_point()) return std::nullopt;
  return *node.value<double>() + 0.0;
}

// The node as a value of the same type as `like`; nothing where the types differ.
std::optional<Value> convert(const toml::node& node, const Value& like) {
  if (std::holds_alternative<bool>(like) && node.is_boolean()) return Value(node.value_or(false));
  if (std::holds_alternative<std::int64_t>(like) && node.is_integer()) return Value(*node.value<std::int64_t>());
  if (std::holds_alternative<std::string>(like) && node.is_string()) return Value(*node.value<std::string>());
  if (std::holds_alternative<double>(like)) {
    const auto v = number(node);
    return v ? std::optional<Value>(*v) : std::nullopt;
  }
  const auto* array = node.as_array();
  if (!array) return std::nullopt;
  if (std::holds_alternative<std::vector<double>>(like)) {
    std::vector<double> list;
    for (const auto& item : *array) {
      const auto v = number(item);
      if (!v) return std::nullopt;
      list.push_back(*v);
    }
    return list;
  }
  if (!std::holds_alternative<std::vector<std::string>>(like)) return std::nullopt;
  std::vector<std::string> list;
  for (const auto& item : *array) {
    if (!item.is_string()) return std::nullopt;
    list.push_back(*item.value<std::string>());
  }
  return list;
}

// A number with 64 bits for its digits: whole numbers and doubles are both exact in it.
using Exact = long double;
static_assert(std::numeric_limits<Exact>::digits >= 63);

bool inside(const Range& r, Exact v) {
  if (std::isnan(v)) return false;
  if (std::isinf(v)) return r.infinite && v > 0;
  if (r.zero && v == 0) return true;
  return (r.lo_open ? v > r.lo : v >= r.lo) && (r.hi_open ? v < r.hi : v <= r.hi);
}

std::vector<Exact> numbers_of(const Value& value) {
  if (const auto* i = std::get_if<std::int64_t>(&value)) return {static_cast<Exact>(*i)};
  if (const auto* d = std::get_if<double>(&value)) return {*d};
  if (const auto* list = std::get_if<std::vector<double>>(&value)) return {list->begin(), list->end()};
  return {};
}

std::vector<std::string> texts_of(const Value& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return {*text};
  if (const auto* list = std::get_if<std::vector<std::string>>(&value)) return *list;
  return {};
}

bool empty_list(const Value& value) {
  const auto* numbers = std::get_if<std::vector<double>>(&value);
  const auto* texts = std::get_if<std::vector<std::string>>(&value);
  return (numbers && numbers->empty()) || (texts && texts->empty());
}

// 40 for 40 %, or 0,4 taken apart at its comma, where a fraction is meant: ends the sentence.
std::string fraction_hint(const Range& range, Exact v) {
  return range.hi == 1 && v > 1 && v <= 100 ? "; it is a fraction with a decimal point, as 0.4 for 40 %" : "";
}

// Points at an entry of a list, 1 the first: "entry 2, nan, "; nothing for a value that is no list.
std::string entry(const toml::node& node, std::size_t index) {
  const auto* list = node.as_array();
  return list ? fmt::format("entry {}, {}, ", index + 1, shortened(as_given(*list->get(index)))) : std::string();
}

void check_numbers(const Range& range, const std::string& rule, const Value& value, const toml::node& node,
                   const std::string& opening) {
  const auto numbers = numbers_of(value);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (inside(range, numbers[i])) continue;
    const bool never = std::isinf(numbers[i]) && !range.infinite && !rule.empty();
    throw InputError(fmt::format("{}: {}must be {}{}{}", opening, entry(node, i), never ? "a finite number, " : "",
                                 rule.empty() ? "a finite number" : rule, fraction_hint(range, numbers[i])));
  }
  if (!range.increasing && !range.decreasing) return;
  const auto stop = range.increasing ? std::adjacent_find(numbers.begin(), numbers.end(), std::greater_equal<>())
                                     : std::adjacent_find(numbers.begin(), numbers.end(), std::less_equal<>());
  if (stop == numbers.end()) return;
  const auto i = static_cast<std::size_t>(stop - numbers.begin());
  throw InputError(fmt::format("{}: {}is not {} {}but the list must be {}", opening, entry(node, i + 1),
                               range.increasing ? "above" : "below", entry(node, i), rule));
}

void check_value(const Key& key, const Case& c, const Value& value, const toml::node& node,
                 const std::string& opening) {
  if (empty_list(value)) throw InputError(opening + ": the list must not be empty");
  const auto rule = allowed(key, c);
  check_numbers(key.range, rule, value, node, opening);
  const auto texts = texts_of(value);
  if (!key.choices) return;
  const auto known = key.choices(c);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (std::find(known.begin(), known.end(), texts[i]) != known.end()) continue;
    const auto advice = key.advice ? key.advice(texts[i]) : std::string();
    throw InputError(fmt::format("{}: {}\"{}\" is not {}{}", opening,
                                 node.is_array() ? fmt::format("entry {}, ", i + 1) : std::string(),
                                 shortened(texts[i]), rule, advice.empty() ? did_you_mean(texts[i], known) : advice));
  }
}

// Key, value and unit as messages open: "panel.toml:12: press.speed_m_s = 3 m/s".
std::string opening_of(const Given& given, const Key& key) {
  return fmt::format("{}: {} = {}{}", given.where, name_of(given.path), shortened(as_given(*given.node)),
                     key.unit.empty() ? "" : " " + key.unit);
}

// The same for a file that may prove unreadable: a control character in its name most likely was a backslash.
std::string opening_of_file(const Given& given, const Key& key) {
  auto opening = opening_of(given, key);
  const auto* text = given.node->as_string();
  const auto is_control = [](unsigned char ch) { return ch < 0x20 || ch == 0x7F; };
  if (!text || std::none_of(text->get().begin(), text->get().end(), is_control)) return opening;
  return opening +
         " (in double quotes \\t is a tab and \\n a new line; write / in file names, or single quotes: "
         "'C:\\mats\\a.json')";
}

[[noreturn]] void throw_wrong_type(const Given& given, const Value& like, const std::string& opening) {
  const auto& node = *given.node;
  const auto must_be = fmt::format("{}: must be {}", opening, type_name(like));
  if (std::holds_alternative<std::int64_t>(like) && node.is_floating_point())
    throw InputError(must_be + ", such as 3: this is written with a decimal point or an exponent");
  if (const auto* list = node.as_array(); list && like.index() >= Value(std::vector<double>()).index()) {
    const bool numbers = std::holds_alternative<std::vector<double>>(like);
    for (std::size_t i = 0; i < list->size(); ++i) {
      const auto& item = *list->get(i);
      if (numbers ? number(item).has_value() : item.is_string()) continue;
      throw InputError(fmt::format("{}, {}is {}", must_be, entry(node, i), type_of(item)));
    }
  }
  const auto decimal = node.is_string() ? with_decimal_point(node.as_string()->get()) : std::nullopt;
  throw InputError(fmt::format("{}, this is {}{}", must_be, type_of(node),
                               decimal ? fmt::format("; numbers have a decimal point: {}", *decimal) : ""));
}

// A key of sections in the case of a plate, or the other way round.
[[noreturn]] void throw_foreign(const Given& given, const Case& c) {
  const auto name = name_of(given.path);
  if (!is_plate(c))
    throw InputError(
        fmt::format("{}: {} belongs to the case of a plate (3D), which mat.width_mm makes; this one is of "
                    "a section",
                    given.where, name));
  if (given.path[0] != "kinds")
    throw InputError(
        fmt::format("{}: {} belongs to the case of a section; mat.width_mm = {} makes this one of a plate "
                    "(3D)",
                    given.where, name, c.plate.width_mm));
  throw InputError(
      fmt::format("{}: {}: mat.width_mm = {} makes this the case of a plate (3D), where gaps follow from "
                  "forming, and length_mm is the length of a whole strand (150 mm unless given), not what "
                  "a section shows of it (25 mm, its width, of a core strand): leave out gap_mm and "
                  "gap_sd_mm, and give length_mm and width_mm of whole strands",
                  given.where, name, c.plate.width_mm));
}

void apply(Case& c, const Given& given) {
  const auto* key = find_key(given.path);
  const auto name = instance_of(given.path);
  const auto opening = opening_of(given, *key);
  if (is_foreign(*key, c) && given.path != kPlateWidth) throw_foreign(given, c);
  const auto like = key->get(c, name);
  const auto value = convert(*given.node, like);
  if (!value) throw_wrong_type(given, like, opening);
  check_value(*key, c, *value, *given.node, opening);
  key->set(c, name, *value);
}

// Instances stand in the order of their names, wherever they were first mentioned: a resolved case, which has them all
// in one file, reads back as itself. `first` is the place of the first that was not always there.
template <class Item, class NameOf>
void insert_by_name(std::vector<Item>& items, std::size_t first, const Item& item, NameOf name_of_item) {
  const auto later = [&](const Item& other) { return name_of_item(other) > name_of_item(item); };
  items.insert(std::find_if(items.begin() + static_cast<std::ptrdiff_t>(first), items.end(), later), item);
}

bool has_instance(const Case& c, const Path& path) {
  const auto there = instances(c, path[0] + ".*");
  return path[0] == "hotpress" || std::find(there.begin(), there.end(), path[1]) != there.end();
}

// [kinds.NAME], [materials.NAME], [resins.NAME] and [hotpress] come to be when they are first mentioned.
void make_instance(Case& c, const Given& given) {
  if (given.path[0] == "hotpress") c.hotpress.given = true;
  const bool named = std::any_of(sections().begin(), sections().end(),
                                 [&](const Section& s) { return s.path == given.path[0] + ".*"; });
  if (given.path.size() != 2 || !named) return;
  const auto& name = given.path[1];
  const auto section = given.path[0] + ".*";
  const bool plain =
      !name.empty() &&
      name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") == std::string::npos;
  if (!plain) {
    throw InputError(fmt::format("{}: [{}.{}]: a name is made of letters, digits, _ and -", given.where, given.path[0],
                                 shortened(name)));
  }
  const auto existing = instances(c, section);
  if (std::find(existing.begin(), existing.end(), name) != existing.end()) return;
  if (section == "kinds.*") {
    KindSettings kind;
    kind.name = name;
    insert_by_name(
        c.kinds, Case().kinds.size(), kind, [](const auto& k) -> const auto& { return k.name; });
    return;
  }
  if (section == "resins.*") {
    for (const auto& built_in : transfer::resins()) {
      if (built_in.name == name)
        throw InputError(
            fmt::format("{}: [resins.{}]: a built-in resin has this name, choose another", given.where, name));
    }
    insert_by_name(
        c.resins, 0, {name}, [](const auto& r) -> const auto& { return r.name; });
    return;
  }
  for (const auto& built_in : wood::library()) {
    if (built_in.name == name) {
      throw InputError(
          fmt::format("{}: [materials.{}]: a built-in material has this name, choose another", given.where, name));
    }
  }
  MaterialSettings settings;
  settings.material = wood::library().front();
  settings.base = settings.material.name;
  settings.material.name = name;
  insert_by_name(
      c.materials, 0, settings, [](const auto& m) -> const auto& { return m.material.name; });
}

// ---- Rules between keys ---------------------------------------------------------------------------------------------

// Where a key, or else anything of its section, was given last; the source itself for defaults.
std::string where_of(const std::vector<Given>& given, const std::string& source, const Path& path) {
  std::string where = source;
  for (const auto& g : given) {
    const bool same_section =
        g.path.size() >= path.size() - 1 && std::equal(path.begin(), path.end() - 1, g.path.begin());
    if (same_section && where == source) where = g.where;
  }
  for (const auto& g : given) {
    if (g.path == path) where = g.where;
  }
  return where;
}

void check_kind(const Case& c, const KindSettings& kind, const std::vector<Given>& given, const std::string& source) {
  const auto& s = kind.statistics;
  const auto fail = [&](const char* key, const std::string& message) {
    throw InputError(fmt::format("{}: kinds.{}.{} {}", where_of(given, source, {"kinds", kind.name, key}),
                                 shortened(kind.name), key, message));
  };
  const auto a = angles(c, kind);
  if ((a.spread_deg > 0) + (a.sd_deg > 0) + (a.kappa > 0) > 1) {
    fail("angle_sd_deg",
         fmt::format("= {}, angle_spread_deg = {}{}: strands have one distribution of angles; give one "
                     "of these keys",
                     a.sd_deg, a.spread_deg, is_plate(c) ? fmt::format(" and angle_kappa = {}", a.kappa) : ""));
  }
  if (is_plate(c)) return;
  if (s.length_mm == 0 && (s.length_sd_mm > 0 || s.gap_mm > 0 || s.gap_sd_mm > 0)) {
    fail("length_mm",
         fmt::format("= 0 means that one strand fills the row: length_sd_mm, gap_mm and gap_sd_mm must be 0 too, not "
                     "{}, {} and {}",
                     s.length_sd_mm, s.gap_mm, s.gap_sd_mm));
  }
  if (s.width_mm > 0 && s.length_mm == 0)
    fail("width_mm", fmt::format("= {} mm: length_mm = 0 means that one strand fills the row, which has no width; "
                                 "leave it out or give the length of whole strands",
                                 s.width_mm));
  if (s.width_sd_mm > s.width_mm)
    fail("width_sd_mm",
         fmt::format("= {} mm: must not exceed the mean, width_mm = {}: the truncated normal distribution degenerates",
                     s.width_sd_mm, s.width_mm));
  if (s.length_sd_mm > s.length_mm) {
    fail("length_sd_mm",
         fmt::format("= {} mm: must not exceed the mean, length_mm = {}: the truncated normal distribution "
                     "degenerates",
                     s.length_sd_mm, s.length_mm));
  }
  if (s.gap_sd_mm > s.gap_mm) {
    fail("gap_sd_mm",
         fmt::format("= {} mm: must not exceed the mean, gap_mm = {}: the truncated normal distribution degenerates",
                     s.gap_sd_mm, s.gap_mm));
  }
}

// The measure of the states that counts: one given by --set takes the place of the file's, that of the default's.
// Throws InputError for two beside each other.
void choose_states(Case& c, const std::vector<Given>& given, const std::string& source) {
  const std::vector<std::pair<const char*, std::vector<double>*>> measures{
      {"densities_kg_m3", &c.states.densities_kg_m3},
      {"thicknesses_mm", &c.states.thicknesses_mm},
      {"compactions", &c.states.compactions}};
  const Given* chosen = nullptr;
  for (const bool in_file : {false, true}) {
    if (chosen) break;
    for (const auto& g : given) {
      const bool measure = g.path[0] == "press" && std::any_of(measures.begin(), measures.end(),
                                                               [&](const auto& m) { return g.path.back() == m.first; });
      if (!measure || g.in_file != in_file) continue;
      if (chosen && chosen->path != g.path)
        throw InputError(
            fmt::format("{}: {} and {} ({}) contradict each other; give one of press.densities_kg_m3, "
                        "press.thicknesses_mm and press.compactions",
                        g.where, name_of(g.path), name_of(chosen->path), chosen->where));
      chosen = &g;
    }
  }
  const auto name = chosen ? chosen->path.back() : "densities_kg_m3";
  for (const auto& [key, list] : measures) {
    if (key != name) list->clear();
  }
  c.places.states = chosen ? opening_of(*chosen, *find_key(chosen->path)) : source + ": press.densities_kg_m3";
}

// A kind that no row is of is most likely the misspelt name of another, whose keys would have no effect.
void refuse_unused_kinds(const Case& c, const mat::Layup& layup, const std::vector<Given>& given,
                         const std::string& source) {
  std::vector<std::string> names{"surface", "core"};
  for (const auto& row : layup.rows) {
    if (std::find(names.begin(), names.end(), row.kind) == names.end()) names.push_back(row.kind);
  }
  for (const auto& kind : c.kinds) {
    if (std::find(names.begin(), names.end(), kind.name) != names.end()) continue;
    const auto near = nearest(kind.name, names);
    throw InputError(fmt::format("{}: [kinds.{}]: no row in mat.rows is of this kind{} Kinds of rows: {}",
                                 where_of(given, source, {"kinds", kind.name, ""}), shortened(kind.name),
                                 near.empty() ? "." : fmt::format("; did you mean {}?", near), quoted_list(names)));
  }
}

void check_materials(const Case& c, const std::vector<Given>& given, const std::string& source, Mistakes& mistakes) {
  const auto check = [&](const wood::Material& material, const Path& path, const std::string& opening) {
    if (!mistakes.none_in(part_of(path))) return;
    mistakes.note(part_of(path), [&] {
      try {
        wood::validate(material);
      } catch (const InputError& e) {
        throw InputError(fmt::format("{}: {}: {}", where_of(given, source, path), opening, e.what()));
      }
    });
  };
  for (const auto& settings : c.materials) {
    const auto& name = settings.material.name;
    check(settings.material, {"materials", name, ""}, fmt::format("[materials.{}]", shortened(name)));
  }
  if (!mistakes.none_below("materials."))
    return;  // of a kind's wood only what its law makes of a material that is right
  for (const auto& kind : strand_kinds(c)) {
    check(kind.material, {"kinds", kind.name, "law"},
          fmt::format("[kinds.{}] with law = \"{}\"", shortened(kind.name), wood::name(kind.material.law)));
  }
}

// Rows, and what their kinds make of them.
void check_mat(const Case& c, const std::vector<Given>& given, const std::string& source, Mistakes& mistakes) {
  mat::Layup rows;
  mistakes.note("mat", [&] {
    try {
      rows = layup(c);
    } catch (const InputError& e) {
      throw InputError(fmt::format("{}: mat.rows: {}", where_of(given, source, {"mat", "rows"}), e.what()));
    }
  });
  if (!c.mat_file.empty() || !mistakes.none_in("mat")) return;
  mistakes.note("kinds.", [&] { refuse_unused_kinds(c, rows, given, source); });
  if (!is_plate(c) || !mistakes.none_below("kinds.")) return;
  mistakes.note("mat", [&] {
    try {
      mat::check(plate_layup(c));
    } catch (const InputError& e) {
      throw InputError(fmt::format("{}: {}", where_of(given, source, kPlateWidth), e.what()));
    }
  });
}

void check_case(const Case& c, const std::vector<Given>& given, const std::string& source, Mistakes& mistakes) {
  for (const auto& kind : c.kinds) {
    const auto part = "kinds." + kind.name;
    if (mistakes.none_in(part)) mistakes.note(part, [&] { check_kind(c, kind, given, source); });
  }
  check_materials(c, given, source, mistakes);
  if (mistakes.none_in("hotpress") && mistakes.none_below("resins.")) {
    mistakes.note("hotpress", [&] {
      check_hotpress(c, [&](const std::string& key, const std::string& message) {
        throw InputError(fmt::format("{}: {}: {}", where_of(given, source, split(key)), key, message));
      });
    });
  }
  if (mistakes.none_in("glue")) {
    mistakes.note("glue", [&] {
      try {
        glue::check(c.test.curing.coverage);
      } catch (const InputError& e) {
        throw InputError(fmt::format("{}: glue.coverage: {}", where_of(given, source, {"glue", "coverage"}), e.what()));
      }
    });
  }
  if (mistakes.none_in("mat")) check_mat(c, given, source, mistakes);
}

// The width of a plate before what depends on it. Materials after those they build on and before the kinds that name
// them; of each its base first, then E_L, the species whose ratios it scales, and the constants they give.
std::pair<int, int> order_of(const Given& given, const std::map<std::string, int>& depths) {
  if (given.path == kPlateWidth) return {-1, 0};
  if (given.path[0] != "materials") return {std::numeric_limits<int>::max(), 0};
  const auto found = depths.find(given.path[1]);
  const int depth = found == depths.end() ? 0 : found->second;
  const auto& key = given.path.back();
  if (key == "base") return {depth, 0};
  if (key == "E_L_MPa") return {depth, 1};
  return {depth, key == "species" ? 2 : 3};
}

// How many others of the case's materials each one builds on. Throws InputError for one that builds on itself.
std::map<std::string, int> depths_of_materials(const std::vector<Given>& given) {
  std::map<std::string, int> depths;
  std::map<std::string, const Given*> bases;
  for (const auto& g : given) {
    if (g.path[0] != "materials") continue;
    depths[g.path[1]] = 0;
    if (g.path.back() == "base" && g.node->is_string()) bases[g.path[1]] = &g;  // the last one holds
  }
  for (auto& [name, depth] : depths) {
    std::string chain = name;
    for (auto at = bases.find(name); at != bases.end(); ++depth) {
      const auto base = at->second->node->value_or(std::string());
      chain += " on " + base;
      if (base == name)
        throw InputError(fmt::format("{}: materials.{}.base = \"{}\": the material builds on itself ({})",
                                     bases.at(name)->where, name, bases.at(name)->node->value_or(std::string()),
                                     chain));
      if (depth > static_cast<int>(bases.size())) break;  // others build on themselves: said of them
      at = bases.find(base);
    }
  }
  return depths;
}

// A file name that counts from `folder`; an empty one stays empty.
void make_absolute(std::string& file, const fs::path& folder) {
  if (!file.empty()) file = fs::absolute(folder / file).lexically_normal().string();
}

std::vector<std::string> groups_of(const Case& c) {
  if (!c.bondline_groups.empty() || c.bondline_group.empty()) return c.bondline_groups;
  return {c.bondline_group};
}

// The glue compliance that a bond-line result gives, where the case names one.
void use_bondline(Case& c, const fs::path& file) {
  const auto fail = [](const std::string& place, const std::string& message) {
    throw InputError(fmt::format("{}: {}", place, message));
  };
  const auto groups = groups_of(c);
  if (c.bondline_file.empty()) {
    if (!groups.empty()) fail(c.places.bondline_group, "needs glue.from_bondline, the result that has the group");
    return;
  }
  if (groups.empty())
    fail(c.places.bondline_file, "needs glue.group, the group of that result to take, or glue.groups");
  if (!c.bondline_group.empty() && !c.bondline_groups.empty())
    fail(c.places.bondline_group,
         fmt::format("glue.group = \"{}\" and glue.groups = [{}] stand beside each other; give one of the two",
                     shortened(c.bondline_group), quoted_list(c.bondline_groups)));
  std::vector<double> measured;
  try {
    for (const auto& group : groups) measured.push_back(bondline::group_compliance(c.bondline_file, group));
  } catch (const bondline::NoSuchGroup& e) {
    fail(c.places.bondline_group, e.what());
  } catch (const InputError& e) {
    fail(c.places.bondline_file, e.what());
  }
  auto& given = c.test.compliance_t_mm_per_MPa;
  if (given != measured && given != Case().test.compliance_t_mm_per_MPa)
    fail(file.string(),
         fmt::format(
             "glue.compliance_t_mm_per_MPa = [{}] and glue.from_bondline ({} mm/MPa) contradict each other; give one",
             fmt::join(given, ", "), fmt::join(measured, ", ")));
  given = measured;
}

Case case_from_sources(Case c, const std::vector<Source>& sources, Mistakes& mistakes) {
  std::vector<Given> given;
  fs::path mat_folder, bondline_folder, log_folder;
  for (const auto& source : sources) {
    const auto first = given.size();
    flatten(source, source.table, {}, given, mistakes);
    for (auto i = first; i < given.size(); ++i) {
      if (!given[i].node) continue;
      if (given[i].path == Path{"hotpress", "log", "file"}) log_folder = source.folder;
      const auto* key = find_key(given[i].path);
      if (key->path == "glue.group" || key->path == "glue.groups") c.places.bondline_group = opening_of(given[i], *key);
      if (!key->names_file) continue;
      const bool is_mat = key->path == "mat.file";
      (is_mat ? mat_folder : bondline_folder) = source.folder;
      (is_mat ? c.places.mat_file : c.places.bondline_file) = opening_of_file(given[i], *key);
    }
  }
  std::set<std::string> nameless;  // without its section a key has no place
  for (const auto& g : given) {
    if (g.node) continue;
    const auto part = part_of(g.path);
    if (mistakes.none_in(part)) mistakes.note(part, [&] { make_instance(c, g); });
    if (g.path.size() == 2 && !has_instance(c, g.path)) nameless.insert(part);
  }
  std::erase_if(given, [&](const Given& g) { return !g.node || nameless.count(part_of(g.path)) > 0; });
  auto ordered = given;
  std::map<std::string, int> depths;
  mistakes.note("materials.", [&] { depths = depths_of_materials(given); });
  std::stable_sort(ordered.begin(), ordered.end(),
                   [&depths](const auto& a, const auto& b) { return order_of(a, depths) < order_of(b, depths); });
  for (const auto& g : ordered) mistakes.note(part_of(g.path), [&] { apply(c, g); });
  mistakes.note("press", [&] { choose_states(c, given, sources.front().name); });
  make_absolute(c.mat_file, mat_folder);
  make_absolute(c.bondline_file, bondline_folder);
  make_absolute(c.hotpress.log_file, log_folder);
  c.places.rows = where_of(given, sources.front().name, {"mat", "rows"}) + ": mat.rows";
  check_case(c, given, sources.front().name, mistakes);
  return c;
}

Case case_from_sources(Case c, const std::vector<Source>& sources) {
  Mistakes mistakes;
  auto result = case_from_sources(std::move(c), sources, mistakes);
  mistakes.refuse();
  return result;
}

std::vector<Source> with_overrides(Source file, const std::vector<std::string>& overrides) {
  std::vector<Source> sources;
  sources.push_back(std::move(file));
  for (const auto& text : overrides) sources.push_back(parse_override(text, "--set " + shortened(text)));
  return sources;
}

std::string read_text(const fs::path& file) {
  if (file.empty()) throw InputError("no case file is given: its name is empty");
  std::error_code error;
  const auto status = fs::status(file, error);
  if (!fs::exists(status)) {
    const auto stem = file.stem().string();
    const auto& ready = ready_cases();
    const bool known = std::find(ready.begin(), ready.end(), stem) != ready.end();
    throw InputError(fmt::format("{}: no such case file; to make one: strandlab init {} > {}", file.string(),
                                 known ? stem : "osb", known ? stem + ".toml" : file.string()));
  }
  if (fs::is_directory(status)) throw InputError(fmt::format("{}: this is a folder, not a case file", file.string()));
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) throw InputError(fmt::format("{}: the case file cannot be read", file.string()));
  return text.str();
}

Case case_of_file(const fs::path& file, const std::vector<std::string>& overrides, Mistakes& mistakes) {
  Source source{parse_toml(read_text(file), file.string()), file.string(), true, true,
                fs::absolute(file).parent_path()};
  Case c;
  c.name = file.stem().string();
  return case_from_sources(std::move(c), with_overrides(std::move(source), overrides), mistakes);
}

}  // namespace

Case read_case(const fs::path& file, const std::vector<std::string>& overrides) {
  Mistakes mistakes;
  auto c = case_of_file(file, overrides, mistakes);
  if (mistakes.none_in("glue")) mistakes.note("glue", [&] { use_bondline(c, file); });
  mistakes.refuse();
  return c;
}

Case read_written_case(const fs::path& file) {
  Mistakes mistakes;
  auto c = case_of_file(file, {}, mistakes);
  mistakes.refuse();
  return c;
}

std::string name_of_glue(const Case& c, double compliance_t_mm_per_MPa) {
  const auto groups = groups_of(c);
  const auto& compliances = c.test.compliance_t_mm_per_MPa;
  for (std::size_t i = 0; i < std::min(groups.size(), compliances.size()); ++i) {
    if (glue::taken(compliances[i]) == glue::taken(compliance_t_mm_per_MPa)) return groups[i];
  }
  return glue::name_of_bond(compliance_t_mm_per_MPa);
}

Case case_from_text(const std::string& text, const std::string& source, const std::vector<std::string>& overrides) {
  return case_from_sources(
      Case(), with_overrides({parse_toml(text, source), source, true, true, fs::current_path()}, overrides));
}

Case changed(const Case& c, const std::vector<std::string>& assignments, const std::string& source) {
  std::vector<Source> sources{{parse_toml(resolved_text(c), source), source, true, false, fs::current_path()}};
  for (const auto& text : assignments) sources.push_back(parse_override(text, source));
  Case start;
  start.name = c.name;
  auto result = case_from_sources(std::move(start), sources);
  if (result.bondline_file == c.bondline_file && groups_of(result) == groups_of(c)) return result;
  if (result.test.compliance_t_mm_per_MPa == c.test.compliance_t_mm_per_MPa)  // that of the result before, if any
    result.test.compliance_t_mm_per_MPa = Case().test.compliance_t_mm_per_MPa;
  use_bondline(result, source);
  return result;
}

}  // namespace strandlab::cases
