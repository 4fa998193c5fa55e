#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "strandlab/bondline/analysis.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/core/text.hpp"
#include "strandlab/files/json_text.hpp"

namespace strandlab::bondline {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "strandlab bondline 1";

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}
Json number(const std::optional<double>& value) {
  return value ? number(*value) : Json(nullptr);
}

Json specimen_json(const Evaluated& s, const std::vector<std::string>& factors) {
  Json json{{"id", s.specimen.id}, {"group", s.group}, {"source", as_text(s.specimen.source)}};
  for (std::size_t i = 0; i < factors.size(); ++i) json["factors"][factors[i]] = s.specimen.factors[i];
  json["k_N_per_mm"] = number(s.specimen.k_N_per_mm);
  json["compliance_t_mm_per_MPa"] = number(s.compliance_t);
  if (!s.excluded.empty()) json["excluded"] = s.excluded;
  if (s.compliance_t) {
    json["standard_uncertainty_mm_per_MPa"] = number(s.uncertainty.standard_mm_per_MPa);
    json["interval_mm_per_MPa"] = {number(s.uncertainty.low_mm_per_MPa), number(s.uncertainty.high_mm_per_MPa)};
    json["compliance_ratio"] = s.ratio;
    json["sensitivity"] = s.sensitivity;
  }
  if (s.specimen.slope && s.specimen.slope->problem.empty()) {
    const Slope& slope = *s.specimen.slope;
    json["record"] = {{"r_squared", slope.r_squared},
                      {"window_N", {slope.low_N, slope.high_N}},
                      {"points", slope.points},
                      {"flags", slope.flags}};
  }
  return json;
}

Json group_json(const Group& g) {
  const statistics::Summary& c = g.compliance_t;
  return {{"group", g.name},
          {"within", g.family},
          {"n", c.n},
          {"excluded", g.excluded},
          {"compliance_t_mm_per_MPa", number(c.mean)},
          {"sd_mm_per_MPa", number(c.sd)},
          {"interval_mm_per_MPa", {number(c.low), number(c.high)}},
          {"t", number(c.t)},
          {"p", number(c.p)},
          {"mean_k_N_per_mm", number(g.mean_k_N_per_mm)},
          {"compliance_t_of_mean_k_mm_per_MPa", number(g.compliance_of_mean)}};
}

Json family_json(const Analysis& analysis, const Family& family) {
  Json json{{"within", family.name}};
  if (!family.note.empty()) json["note"] = family.note;
  if (!family.anova) return json;
  const statistics::Anova& a = *family.anova;
  const statistics::WelchAnova& w = *family.welch;
  json["anova"] = {{"F", number(a.F)}, {"df", {a.df_between, a.df_within}}, {"p", number(a.p)}};
  json["welch_anova"] = {{"F", number(w.F)}, {"df", {w.df_between, w.df_within}}, {"p", number(w.p)}};
  json["pairs_test"] = "Welch's t-test, p corrected by Holm's step-down method";
  for (const statistics::Pair& pair : family.pairs)
    json["pairs"].push_back({{"first", analysis.groups[family.groups[pair.first]].name},
                             {"second", analysis.groups[family.groups[pair.second]].name},
                             {"difference_mm_per_MPa", pair.difference},
                             {"t", number(pair.t)},
                             {"df", pair.df},
                             {"p", number(pair.p)},
                             {"p_holm", number(pair.p_holm)}});
  return json;
}

}  // namespace

std::string to_json(const Analysis& analysis, const std::string& input) {
  const Uncertainty& u = analysis.options.uncertainty;
  Json json{{"format", kFormat}, {"input", as_text(input)}, {"formula", name(analysis.options.formula)}};
  json["uncertainty"] = {
      {"k_relative", u.k_relative}, {"E_relative", u.E_relative}, {"t_relative", u.t_relative}, {"l_mm", u.l_mm}};
  json["groups"] = Json::array();
  for (const auto& group : analysis.groups) json["groups"].push_back(group_json(group));
  for (const auto& family : analysis.families) json["comparisons"].push_back(family_json(analysis, family));
  for (const auto& specimen : analysis.specimens)
    json["specimens"].push_back(specimen_json(specimen, analysis.factors));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

double group_compliance(const std::filesystem::path& file, const std::string& group) {
  const nlohmann::json json = files::read_json(file, "a result of 'strandlab bondline'");
  const auto not_ours = [&] {
    return InputError(fmt::format("{}: is not a result of 'strandlab bondline'", file.string()));
  };
  try {
    if (json.at("format") != kFormat) throw not_ours();
    std::vector<std::string> names;
    for (const auto& entry : json.at("groups")) {
      names.push_back(entry.at("group"));
      if (names.back() != group) continue;
      const auto& value = entry.at("compliance_t_mm_per_MPa");
      if (value.is_null())
        throw NoSuchGroup(fmt::format("{}: group '{}' has no value", file.string(), shortened(group)));
      return value.get<double>();
    }
    throw NoSuchGroup(fmt::format("{}: has no group '{}'; it has: {}", file.string(), shortened(group),
                                  shortened(fmt::format("{}", fmt::join(names, ", ")), 400)));
  } catch (const Json::exception&) {
    throw not_ours();
  }
}

}  // namespace strandlab::bondline
