// The one table of case keys: from it come reading and validation, `strandlab init` and `check`, and docs/cases.md.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "strandlab/case/case.hpp"
#include "strandlab/core/declaration.hpp"

namespace strandlab::cases {

using Value = OptionValue;

struct Key {
  std::string path;  // "press.speed_m_s"; "kinds.*.angle_deg" for every [kinds.NAME]
  std::string unit;  // "" where there is none
  Range range;
  std::string help;
  std::function<std::vector<std::string>(const Case&)> choices;  // of texts; empty: any text
  std::function<std::string(const std::string&)> advice;         // ends the message on a text that is none of them
  bool names_file = false;                                       // a text: relative ones count from the case file
  int dimensions = 0;           // 2 or 3: a key of the cases of sections or of plates only; 0: of both
  bool changes_results = true;  // false: runs that differ in this key alone give the same bits
  // An empty list stands for a key that is not given, and is not written.
  // `name` is what stands for the * of the path, "" where there is none. set() expects a value that passed the checks.
  std::function<Value(const Case&, const std::string& name)> get;
  std::function<void(Case&, const std::string& name, const Value&)> set;
};

struct Section {
  std::string path;  // "press", "kinds.*"
  std::string help;
};

const std::vector<Section>& sections();
const std::vector<Key>& keys();  // by section

// A key that says nothing of this case, since it is of sections or of plates only.
bool is_foreign(const Key& key, const Case& c);

// The section of a key ("kinds.*" of "kinds.*.angle_deg") and its own name ("angle_deg").
std::string section_of(const Key& key);
std::string name_of(const Key& key);
// A path with its * replaced: "kinds.surface" of "kinds.*".
std::string with_name(std::string path, const std::string& name);
// Names that stand for the * of a section in this case; {""} for a section without one, {} for those of [hotpress] in a
// case that has none.
std::vector<std::string> instances(const Case& c, const std::string& section);

// Plain words for messages and the reference page: "a number", "greater than 0", the value as TOML.
std::string type_name(const Value& value);
std::string allowed(const Key& key, const Case& c);
std::string meaning(const Key& key, const Case& c);  // its help, unit and what is allowed
std::string to_toml(const Value& value);

}  // namespace strandlab::cases
