#include "strandlab/run/record.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/utsname.h>

#include <ctime>
#include <fstream>
#include <string>
#include <thread>

#include "strandlab/core/version.hpp"
#include "strandlab/run/commit.hpp"

namespace strandlab::run {
namespace {

using Json = nlohmann::json;

std::string cpu_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.rfind("model name", 0) == 0 && line.find(": ") != std::string::npos)
      return line.substr(line.find(": ") + 2);
  }
  return "unknown";
}

Json machine() {
  utsname system{};
  ::uname(&system);
  return {{"host", system.nodename},
          {"cpu", cpu_name()},
          {"cores", std::thread::hardware_concurrency()},
          {"system", fmt::format("{} {} {}", system.sysname, system.release, system.machine)}};
}

// The states at which the panel is kept, as they were solved for this mat.
Json states_of(const Formed& formed) {
  auto list = Json::array();
  for (const auto& state : kept_states(formed))
    list.push_back({{"compaction", state.compaction},
                    {"thickness_mm", state.thickness_mm},
                    {"density_kg_m3", state.density_kg_m3}});
  return list;
}

Json fractions(const std::vector<WeightShare>& shares) {
  Json object = Json::object();
  for (const auto& share : shares) object[share.name] = share.fraction;
  return object;
}

Json to_json(const Weight& weight) {
  return {{"kg_per_m2", weight.kg_per_m2},
          {"weight_fraction_by_kind", fractions(weight.by_kind)},
          {"weight_fraction_by_material", fractions(weight.by_material)}};
}

// Nanoseconds of one thread per particle-step, by phase.
Json to_json(const mpm::Phases& t, double particle_steps) {
  const auto ns = [particle_steps](double seconds) { return particle_steps > 0 ? 1e9 * seconds / particle_steps : 0; };
  return {{"weights", ns(t.weights)}, {"surface", ns(t.surface)}, {"scatter", ns(t.scatter)},  {"grid", ns(t.grid)},
          {"contact", ns(t.contact)}, {"gather", ns(t.gather)},   {"material", ns(t.material)}};
}

Json to_json(const vtest::Modulus& m) {
  Json json{{"test", vtest::name(m.kind)},
            {"compliance_t_mm_per_MPa", m.compliance_t_mm_per_MPa},
            {"modulus_MPa", m.modulus_MPa},
            {"reaction_modulus_MPa", m.reaction_modulus_MPa}};
  if (m.shear_free_modulus_MPa) json["shear_free_modulus_MPa"] = *m.shear_free_modulus_MPa;
  return json;
}

vtest::Modulus modulus_from(const Json& json) {
  vtest::Modulus m;
  m.kind = vtest::test_from_name(json.at("test"));
  m.compliance_t_mm_per_MPa = json.at("compliance_t_mm_per_MPa");
  m.modulus_MPa = json.at("modulus_MPa");
  m.reaction_modulus_MPa = json.at("reaction_modulus_MPa");
  if (json.contains("shear_free_modulus_MPa")) m.shear_free_modulus_MPa = json["shear_free_modulus_MPa"].get<double>();
  return m;
}

Json to_json(const GapSensitivity& s) {
  return {{"compliance_t_mm_per_MPa", s.compliance_t_mm_per_MPa},
          {"gap_halved", s.change.halved},
          {"gap_doubled", s.change.doubled}};
}

Json to_json(const TestedState& state) {
  const auto& r = state.result;
  Json moduli = Json::array();
  for (const auto& m : r.moduli) moduli.push_back(to_json(m));
  Json json{{"compaction", state.compaction},
            {"moduli", moduli},
            {"strands", r.strands},
            {"floating_strands", r.floating_strands},
            {"glued_fraction", r.glued_fraction},
            {"unknowns", r.unknowns},
            {"wall_s", state.wall_s},
            {"assemble_s", r.assemble_s},
            {"analyse_s", r.analyse_s},
            {"factor_s", r.factor_s},
            {"solve_s", r.solve_s},
            {"warnings", r.warnings}};
  if (state.not_testable) {
    json["not_testable"] = state.not_testable->reason;
    json["failed"] = state.not_testable->failed;
  } else {
    json["gap_sensitivity"] = state.gap_sensitivity ? to_json(*state.gap_sensitivity) : Json();
  }
  return json;
}

TestedState state_from(const Json& json) {
  TestedState state;
  state.compaction = json.at("compaction");
  auto& r = state.result;
  for (const auto& m : json.at("moduli")) r.moduli.push_back(modulus_from(m));
  r.strands = json.at("strands");
  r.floating_strands = json.at("floating_strands");
  r.glued_fraction = json.at("glued_fraction");
  r.unknowns = json.at("unknowns");
  state.wall_s = json.at("wall_s");
  r.assemble_s = json.at("assemble_s");
  r.analyse_s = json.at("analyse_s");
  r.factor_s = json.at("factor_s");
  r.solve_s = json.at("solve_s");
  r.warnings = json.at("warnings").get<std::vector<std::string>>();
  if (json.contains("not_testable")) {
    state.not_testable = {json["not_testable"].get<std::string>(), json.at("failed").get<bool>()};
  } else if (const auto& s = json.at("gap_sensitivity"); !s.is_null()) {
    state.gap_sensitivity = {s.at("compliance_t_mm_per_MPa"), {s.at("gap_halved"), s.at("gap_doubled")}};
  }
  return state;
}

// What is the same for every mat.
void begin(Json& record, const cases::Case& c) {
  record["strandlab"] = version();
  record["git"] = git_commit();
  if (!record.contains("date")) record["date"] = fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::time(nullptr)));
  record["seed"] = c.seed;
  record["machine"] = machine();
  record["derived_constants"] = cases::derived_constants(c);
}

Json rows_of(const statics::PlateStiffness& m) {
  auto rows = Json::array();
  for (int i = 0; i < 6; ++i) {
    auto& row = rows.emplace_back(Json::array());
    for (int j = 0; j < 6; ++j) row.push_back(m(i, j));
  }
  return rows;
}

Json to_json(const TestedPlateState& state) {
  const auto& r = state.result;
  auto moduli = Json::array(), tensors = Json::array();
  for (const auto& m : r.moduli) {
    moduli.push_back({{"test", m.test},
                      {"compliance_t_mm_per_MPa", m.compliance_t_mm_per_MPa},
                      {"modulus_MPa", m.modulus_MPa},
                      {"reaction_modulus_MPa", m.reaction_modulus_MPa}});
  }
  for (const auto& t : r.tensors)
    tensors.push_back({{"compliance_t_mm_per_MPa", t.compliance_t_mm_per_MPa}, {"ABD", rows_of(t.abd)}});
  Json json{{"compaction", state.compaction},
            {"wall_s", state.wall_s},
            {"moduli", moduli},
            {"plate_stiffness", tensors},
            {"strands", r.strands},
            {"floating_strands", r.floating_strands},
            {"glued_area_mm2", r.glued_area_mm2},
            {"glued_fraction", r.glued_fraction},
            {"unknowns", r.unknowns},
            {"assemble_s", r.assemble_s},
            {"analyse_s", r.analyse_s},
            {"factor_s", r.factor_s},
            {"solve_s", r.solve_s},
            {"warnings", r.warnings}};
  if (!state.not_testable.empty()) json["not_testable"] = state.not_testable;
  return json;
}

}  // namespace

void begin_record(Json& record, const Formed& formed) {
  begin(record, formed.c);
  record["mat"] = to_json(cases::weigh(formed.c, formed.mat));
  record["states"] = states_of(formed);
}

void begin_record(Json& record, const FormedPlate& formed) {
  begin(record, formed.c);
  record["mat"] = to_json(cases::weigh(formed.c, formed.mat));
  auto& states = record["states"] = Json::array();
  for (const double compaction : formed.c.schedule.compactions) {
    states.push_back({{"compaction", compaction},
                      {"thickness_mm", formed.mat.thickness_mm() * (1 - compaction)},
                      {"density_kg_m3", cases::density_kg_m3(formed.c, formed.mat, compaction)}});
  }
}

template <int Dim>
Json summary(const press::Outcome<Dim>& outcome, int threads) {
  const double particle_steps = outcome.particle_steps_per_s * outcome.wall_s;
  return {{"particles", outcome.particles},
          {"steps", outcome.steps},
          {"threads", threads},
          {"wall_s", outcome.wall_s},
          {"particle_steps_per_s", outcome.particle_steps_per_s},
          {"ns_per_particle_step", outcome.particle_steps_per_s > 0 ? 1e9 / outcome.particle_steps_per_s : 0},
          {"ns_per_particle_step_by_phase", to_json(outcome.timing.phases, particle_steps)},
          {"fields_per_node", outcome.timing.fields_per_node},
          {"most_fields", outcome.most_fields},
          {"plastic_fraction", outcome.timing.plastic_fraction},
          {"engine_bytes", outcome.bytes},
          {"warnings", outcome.warnings}};
}
template Json summary(const press::Outcome<2>&, int);
template Json summary(const press::Outcome<3>&, int);

Json to_json(const std::vector<profile::Profile>& profiles) {
  auto list = Json::array();
  for (const auto& p : profiles) {
    const auto s = profile::summarise(p);
    list.push_back({{"compaction", p.compaction},
                    {"mean_kg_m3", s.mean},
                    {"peak_kg_m3", s.peak},
                    {"peak_depth_mm", s.peak_depth_mm},
                    {"skin_kg_m3", s.skin},
                    {"surface_kg_m3", s.surface},
                    {"core_kg_m3", s.core},
                    {"surface_over_core", s.surface_over_core()}});
  }
  return list;
}

Json to_json(const Tested& tested) {
  auto list = Json::array();
  for (const auto& state : tested) list.push_back(to_json(state));
  return list;
}

Json to_json(const TestedPlate& tested) {
  auto list = Json::array();
  for (const auto& state : tested) list.push_back(to_json(state));
  return list;
}

Tested tested_from_json(const Json& states) {
  Tested tested;
  for (const auto& state : states) tested.push_back(state_from(state));
  return tested;
}

}  // namespace strandlab::run
