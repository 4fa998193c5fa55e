#include "strandlab/hotpress/schedule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "strandlab/core/error.hpp"
#include "strandlab/core/nearest.hpp"

namespace strandlab::hotpress {
namespace {

constexpr const char* kExamples =
    "as in \"close to 12 mm in 25 s\", \"close at 4 MPa to 640 kg/m3 within 60 s\", \"hold until 240 s\", \"vent 10 "
    "s\", "
    "\"open 60 s\"";

const std::vector<std::string>& verbs() {
  static const std::vector<std::string> names{"close", "hold", "vent", "open"};
  return names;
}

// Words and numbers; a number is parted from a unit written right behind it.
std::vector<std::string> tokens_of(const std::string& text) {
  std::vector<std::string> tokens;
  std::istringstream stream(text);
  for (std::string word; stream >> word;) {
    if (word.back() == ',' && word.size() > 1) word.pop_back();
    char* end = nullptr;
    static_cast<void>(std::strtod(word.c_str(), &end));
    const auto length = static_cast<std::size_t>(end - word.c_str());
    const bool number = length > 0 && std::isalpha(static_cast<unsigned char>(word[0])) == 0;
    if (number) tokens.push_back(word.substr(0, length));
    if (!number || length < word.size()) tokens.push_back(number ? word.substr(length) : word);
  }
  return tokens;
}

std::optional<double> number(const std::string& token) {
  if (std::isalpha(static_cast<unsigned char>(token[0])) != 0) return std::nullopt;
  char* end = nullptr;
  const double value = std::strtod(token.c_str(), &end);
  return *end == '\0' && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

template <class T>
void set_once(std::optional<T>& place, const T& value, const char* what) {
  if (place) throw InputError(fmt::format("two {}", what));
  place = value;
}

void set_time(Phase& phase, double seconds, const std::string& word) {
  if (word == "until") return set_once(phase.until, seconds, "times to end at");
  if (word == "from") return set_once(phase.from, seconds, "times to begin at");
  if (!(seconds > 0)) throw InputError("a time must be greater than 0");
  set_once(phase.seconds, seconds, "durations");
}

void set_quantity(Phase& phase, double value, const std::string& unit, const std::string& word) {
  const bool time = unit == "s" || unit == "min";
  if (time) return set_time(phase, unit == "min" ? 60 * value : value, word);
  if (!(value > 0)) throw InputError(fmt::format("{} {} must be greater than 0", value, unit));
  if (unit == "mm") return set_once(phase.target, {Target::Kind::kThickness, 1e-3 * value}, "targets");
  if (unit == "kg/m3") return set_once(phase.target, {Target::Kind::kDensity, value}, "targets");
  if (unit == "%") return set_once(phase.target, {Target::Kind::kCompaction, 1e-2 * value}, "targets");
  if (unit == "MPa") return set_once(phase.pressure, 1e6 * value, "pressures");
  if (unit == "mm/s") return set_once(phase.speed, 1e-3 * value, "speeds");
  throw InputError(fmt::format("\"{}\" is no unit of a schedule: s, min, mm, kg/m3, % (compaction), MPa, mm/s", unit));
}

void check_phase(const Phase& p) {
  const bool timed = p.seconds || p.until;
  if (p.seconds && p.until) throw InputError("both a duration and a time to end at; give one");
  if (p.kind == Phase::Kind::kClose) {
    if (!p.target) throw InputError("closing needs a target: mm, kg/m3 (oven-dry) or % compaction");
    if (p.pressure && p.speed) throw InputError("closing is by pressure or by position; a speed is of the latter");
    if (!timed && !p.speed)
      throw InputError(p.pressure ? "closing under pressure needs a time it may take at most, in s"
                                  : "closing by position needs a time in s or a speed in mm/s");
    if (timed && p.speed) throw InputError("both a time and a speed; give one");
    return;
  }
  if (!timed) throw InputError("needs a time in s");
  if (p.speed) throw InputError("only closing has a speed");
  if (p.target && !(p.kind == Phase::Kind::kHold && p.pressure))
    throw InputError("only closing, or holding a pressure, has a target");
  if (p.pressure && p.kind != Phase::Kind::kHold) throw InputError("only closing and holding have a pressure");
}

Phase parse_words(const std::string& text) {
  Phase phase;
  phase.text = text;
  const auto tokens = tokens_of(text);
  const auto verb = tokens.empty() ? verbs().end() : std::find(verbs().begin(), verbs().end(), tokens[0]);
  if (verb == verbs().end()) {
    const auto near = tokens.empty() ? std::string() : nearest(tokens[0], verbs());
    throw InputError(fmt::format("a phase begins with close, hold, vent or open{}",
                                 near.empty() ? "" : fmt::format("; did you mean {}?", near)));
  }
  phase.kind = static_cast<Phase::Kind>(verb - verbs().begin());
  static const std::vector<std::string> fillers{"to", "in", "at", "for", "within", "with", "until", "from", "and"};
  for (std::size_t i = 1; i < tokens.size(); ++i) {
    const auto value = number(tokens[i]);
    if (!value) {
      if (std::find(fillers.begin(), fillers.end(), tokens[i]) == fillers.end())
        throw InputError(fmt::format("\"{}\" is not understood", tokens[i]));
      continue;
    }
    if (i + 1 == tokens.size()) throw InputError(fmt::format("{} has no unit", tokens[i]));
    set_quantity(phase, *value, tokens[i + 1], tokens[i - 1]);
    ++i;
  }
  check_phase(phase);
  return phase;
}

[[noreturn]] void reject(const Phase& phase, const std::string& why) {
  throw InputError(fmt::format("phase \"{}\": {}", phase.text, why));
}

void check_order(const std::vector<Phase>& phases) {
  using Kind = Phase::Kind;
  if (phases.empty() || phases.front().kind != Kind::kClose)
    throw InputError(fmt::format("a schedule begins with closing, {}", kExamples));
  for (std::size_t i = 1; i < phases.size(); ++i) {
    const auto before = phases[i - 1].kind, now = phases[i].kind;
    if (before == Kind::kOpen) reject(phases[i], "comes after opening, which is the last phase");
    if (before == Kind::kVent && now != Kind::kOpen) reject(phases[i], "after venting only opening follows");
  }
}

// Where a phase's end is known (closing by speed or under pressure may end sooner), the next may not begin before it.
void check_times(const std::vector<Phase>& phases) {
  std::optional<double> end = 0;
  for (const auto& p : phases) {
    if (p.from && end && std::abs(*p.from - *end) > 1e-9) {
      reject(p,
             *p.from < *end
                 ? fmt::format("phases overlap: it begins at {:g} s, the one before it ends at {:g} s", *p.from, *end)
                 : fmt::format("it begins at {:g} s, but the one before it ends at {:g} s", *p.from, *end));
    }
    if (p.until) {
      if (end && *p.until <= *end)
        reject(p, fmt::format("phases overlap: it ends at {:g} s, the one before it at {:g} s", *p.until, *end));
      end = p.until;
    } else if (p.seconds && end && !(p.kind == Phase::Kind::kClose && p.pressure)) {
      *end += *p.seconds;
    } else {
      end = std::nullopt;
    }
  }
}

}  // namespace

Phase parse_phase(const std::string& text) {
  try {
    return parse_words(text);
  } catch (const InputError& e) {
    throw InputError(fmt::format("phase \"{}\": {}, {}", text, e.what(), kExamples));
  }
}

std::vector<Phase> parse_schedule(const std::vector<std::string>& texts) {
  std::vector<Phase> phases;
  phases.reserve(texts.size());
  for (const auto& text : texts) phases.push_back(parse_phase(text));
  check_order(phases);
  check_times(phases);
  return phases;
}

std::vector<std::string> default_schedule() {
  return {"close to 640 kg/m3 in 25 s", "hold until 240 s", "vent 10 s", "open 60 s"};
}

double thickness_of(const Target& target, const MatSize& mat) {
  if (target.kind == Target::Kind::kDensity) return mat.dry_mass / target.value;
  return target.kind == Target::Kind::kCompaction ? mat.thickness * (1 - target.value) : target.value;
}

void check_targets(const std::vector<Phase>& phases, const MatSize& mat) {
  double thickness = mat.solid_thickness;
  for (const auto& p : phases) {
    if (!p.target) continue;
    const double to = thickness_of(*p.target, mat);
    if (to <= mat.full_thickness) {
      reject(p,
             fmt::format("{:.4g} mm is never reached: the cell walls of this mat ({:.4g} kg/m2 of dry wood) alone are "
                         "{:.4g} mm",
                         1e3 * to, mat.dry_mass, 1e3 * mat.full_thickness));
    }
    if (p.kind != Phase::Kind::kClose) continue;
    if (to >= thickness) {
      reject(p, fmt::format("{:.4g} mm is never reached by closing: the mat is {:.4g} mm before it", 1e3 * to,
                            1e3 * thickness));
    }
    thickness = to;
  }
}

double interpolated(const std::vector<Point>& points, double at) {
  const auto above = std::find_if(points.begin(), points.end(), [at](const Point& p) { return p.at > at; });
  if (above == points.begin()) return points.front().value;
  if (above == points.end()) return points.back().value;
  const auto below = above - 1;
  return below->value + (above->value - below->value) * (at - below->at) / (above->at - below->at);
}

std::vector<Point> parse_points(const std::string& text) {
  constexpr const char* rule = "must be pairs of numbers, the first of each increasing, as in \"0 200, 60 190\"";
  std::vector<Point> points;
  std::istringstream pairs(text);
  for (std::string pair; std::getline(pairs, pair, ',');) {
    std::replace(pair.begin(), pair.end(), ':', ' ');
    std::istringstream numbers(pair);
    std::string first, second, more;
    numbers >> first >> second;
    const auto at = first.empty() ? std::nullopt : number(first),
               value = second.empty() ? std::nullopt : number(second);
    if (!at || !value || numbers >> more) throw InputError(fmt::format("\"{}\" {}", text, rule));
    if (!points.empty() && *at <= points.back().at) throw InputError(fmt::format("\"{}\" {}", text, rule));
    points.push_back({*at, *value});
  }
  if (points.empty()) throw InputError(fmt::format("\"{}\" {}", text, rule));
  return points;
}

}  // namespace strandlab::hotpress
