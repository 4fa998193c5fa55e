// What a user may set, declared beside the struct that it fills: name, unit, range, meaning. The rooms declare their
// options; the room case makes keys of them, reads, checks and prints them.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace strandlab {

using OptionValue =
    std::variant<bool, std::int64_t, double, std::string, std::vector<double>, std::vector<std::string>>;

// Numbers that are accepted; for a list, each of its entries.
struct Range {
  double lo = -std::numeric_limits<double>::infinity(), hi = std::numeric_limits<double>::infinity();
  bool lo_open = false, hi_open = false;  // the limit itself is excluded
  bool infinite = false;                  // `inf` is accepted
  bool zero = false;                      // 0 is accepted too, below lo
  bool increasing = false;                // lists: each entry greater than the one before
  bool decreasing = false;                // lists: each entry less than the one before
};

inline constexpr Range kAny{};
inline constexpr Range kPositive{.lo = 0, .lo_open = true};
inline constexpr Range kNotNegative{.lo = 0};
inline constexpr Range kPositiveOrInfinite{.lo = 0, .lo_open = true, .infinite = true};

// One number, text, choice or list of an Owner.
template <class Owner>
struct Declaration {
  std::string name;  // with its unit where it has one: "speed_m_s"
  std::string unit;  // "" where there is none
  Range range;
  std::string help;                              // its meaning, as the reference page says it
  std::function<OptionValue(const Owner&)> get;  // its value now; of a fresh Owner, the default
  std::function<void(Owner&, const OptionValue&)>
      set;                                // expects a value of that type, within the range, of the choices
  std::vector<std::string> choices = {};  // of a text, or of each of a list; empty: any
};

// A value as a member holds it, and back: whole numbers have 64 bits on the way.
template <class Member>
OptionValue to_value(const Member& member) {
  if constexpr (std::is_integral_v<Member> && !std::is_same_v<Member, bool>) {
    return static_cast<std::int64_t>(member);
  } else {
    return member;
  }
}
template <class Member>
void from_value(const OptionValue& value, Member& member) {
  if constexpr (std::is_integral_v<Member> && !std::is_same_v<Member, bool>) {
    member = static_cast<Member>(std::get<std::int64_t>(value));
  } else {
    member = std::get<Member>(value);
  }
}

// A member of its Owner.
template <class Owner, class Member>
Declaration<Owner> declare(std::string name, std::string unit, const Range& range, std::string help,
                           Member Owner::*member) {
  return {std::move(name),
          std::move(unit),
          range,
          std::move(help),
          [member](const Owner& owner) { return to_value(owner.*member); },
          [member](Owner& owner, const OptionValue& value) { from_value(value, owner.*member); }};
}

// A member whose values have names: `name_of` and `from_name` translate.
template <class Owner, class Member, class NameOf, class FromName>
Declaration<Owner> declare_choice(std::string name, std::string help, Member Owner::*member,
                                  std::vector<std::string> choices, NameOf name_of, FromName from_name) {
  return {std::move(name),
          "",
          kAny,
          std::move(help),
          [member, name_of](const Owner& owner) { return OptionValue(std::string(name_of(owner.*member))); },
          [member, from_name](Owner& owner, const OptionValue& value) {
            owner.*member = from_name(std::get<std::string>(value));
          },
          std::move(choices)};
}

// The declaration of a part's option as one of the whole; `part_of` refers to the part of a whole, const or not.
template <class Whole, class Part, class PartOf>
Declaration<Whole> within(PartOf part_of, const Declaration<Part>& option) {
  return {option.name,
          option.unit,
          option.range,
          option.help,
          [part_of, get = option.get](const Whole& whole) { return get(part_of(whole)); },
          [part_of, set = option.set](Whole& whole, const OptionValue& value) { set(part_of(whole), value); },
          option.choices};
}

}  // namespace strandlab
