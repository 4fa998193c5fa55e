#include "strandlab/run/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "strandlab/case/case.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/core/text.hpp"
#include "strandlab/files/atomic_file.hpp"
#include "strandlab/files/json_text.hpp"
#include "strandlab/files/text_file.hpp"
#include "strandlab/glue/bond.hpp"
#include "strandlab/io/checkpoint.hpp"
#include "strandlab/report/frames.hpp"
#include "strandlab/report/html.hpp"
#include "strandlab/report/morphology.hpp"
#include "strandlab/run/folder.hpp"
#include "strandlab/run/sheet.hpp"
#include "strandlab/vtest/vtest.hpp"
#include "strandlab/wood/laws/law.hpp"

namespace strandlab::run {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::array kTables{"press.csv",      "moduli.csv",  "theory.csv",   "morphology.csv",
                             "histograms.csv", "profile.csv", "hotpress.csv", "transfer_profiles.csv",
                             "measured.csv"};

std::string needed_text(const fs::path& file) {
  auto text = files::read_text(file);
  if (!text)
    throw InputError(fmt::format("{}: cannot be read; strandlab run makes a missing result again", file.string()));
  return *text;
}

Json read_object(const fs::path& file, const std::string& what) {
  auto json = files::read_json(file, what);
  if (!json.is_object()) throw InputError(fmt::format("{}: not a JSON object", file.string()));
  return json;
}

Json describe(const wood::Material& m) {
  Json text{{"name", m.name},   {"density_kg_m3", m.density_kg_m3}, {"E_L_MPa", m.E_L}, {"E_R_MPa", m.E_R},
            {"E_T_MPa", m.E_T}, {"law", wood::name(m.law)}};
  for (const auto& [name, value] : wood::description(m.law).in_short(m)) text[name] = value;
  return text;
}

// Materials of the case's kinds, and those that strands of a mat file name beside them.
std::vector<wood::Material> materials_of(const cases::Case& c, const Json& record) {
  std::vector<wood::Material> materials, known = wood::library();
  const auto add = [&materials](const wood::Material& m) {
    const auto same = [&](const wood::Material& other) { return other.name == m.name; };
    if (std::none_of(materials.begin(), materials.end(), same)) materials.push_back(m);
  };
  for (const auto& kind : cases::strand_kinds(c)) add(kind.material);
  for (const auto& kind : cases::kinds_and_materials(c)) known.insert(known.begin(), kind.material);
  const Json::json_pointer used("/mat/weight_fraction_by_material");
  if (!record.contains(used)) return materials;
  for (const auto& [name, fraction] : record[used].items()) {
    const auto m = std::find_if(known.begin(), known.end(), [&n = name](const auto& wood) { return wood.name == n; });
    if (m != known.end()) add(*m);
  }
  return materials;
}

// Sizes are the mat's, not the case's: a mat file has its own.
Json describe(const cases::Case& c, const Json& record) {
  Json kinds = Json::array(), materials = Json::array();
  const auto strand_kinds = cases::strand_kinds(c);
  for (std::size_t i = 0; i < strand_kinds.size(); ++i) {
    const auto& kind = strand_kinds[i];
    kinds.push_back({{"name", kind.name},
                     {"material", kind.material.name},
                     {"angle_deg", kind.angle_deg},
                     {"angle_spread_deg", c.kinds[i].angle_spread_deg},
                     {"angle_sd_deg", cases::angles(c, c.kinds[i]).sd_deg},
                     {"yield_factor", kind.yield_factor},
                     {"stiffness_factor", kind.stiffness_factor}});
  }
  for (const auto& material : materials_of(c, record)) materials.push_back(describe(material));
  Json densities = Json::array();
  for (const auto& state : record.value("states", Json::array())) densities.push_back(state.at("density_kg_m3"));
  return {{"name", as_text(c.name)},
          {"mat_file", as_text(c.mat_file)},
          {"seed", std::to_string(c.seed)},  // a number of the page is exact to 2^53 only
          {"kinds", kinds},
          {"materials", materials},
          {"compactions", c.schedule.compactions},
          {"densities_kg_m3", densities},
          {"speed_m_s", c.schedule.speed_m_s},
          {"friction", c.mpm.friction},
          {"compliances_t_mm_per_MPa", c.test.compliance_t_mm_per_MPa},
          {"compliance_n_mm_per_MPa", c.test.compliance_n_mm_per_MPa},
          {"max_gap_mm", c.test.curing.max_gap_mm}};
}

bool finished(const Json& record, const char* step) {
  const auto& steps = record.at("steps");
  return steps.contains(step) && steps[step].value("finished", false);
}

// What the names in the tables are called on the page.
Json words(const cases::Case& c) {
  Json tests, quantities, glues = Json::array();
  for (const double compliance : c.test.compliance_t_mm_per_MPa) {
    const double taken = glue::taken(compliance);
    glues.push_back({{"compliance_t_mm_per_MPa", taken}, {"name", cases::name_of_glue(c, taken)}});
  }
  for (const auto& name : vtest::test_names()) tests[name] = vtest::label(vtest::test_from_name(name));
  for (const auto* name : {"grain_angle_deg", "strand_thickness_strain"}) {
    const auto w = report::words_of(name);
    quantities[name] = {{"title", w.title}, {"axis", w.axis}, {"factor", w.factor}};
  }
  return {{"tests", tests}, {"quantities", quantities}, {"glues", glues}};
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".h5") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::vector<Panel<2>> read_frames(const fs::path& run_folder) {
  std::vector<Panel<2>> frames;
  for (const auto& file : files_in(run_folder / "frames")) frames.push_back(io::read_panel<2>(file, ""));
  if (!frames.empty()) return frames;
  for (const auto& file : files_in(run_folder / "panels"))
    frames.push_back(report::frame_of(io::read_panel<2>(file, "")));
  std::sort(frames.begin(), frames.end(), [](const auto& a, const auto& b) { return a.compaction() < b.compaction(); });
  return frames;
}

namespace {

Json data_of(const cases::Case& c, const Json& record, const fs::path& run_folder) {
  Json run{{"case", describe(c, record)},
           {"case_text", needed_text(run_folder / "case.toml")},
           {"record", record},
           {"mat", nullptr},
           {"words", words(c)},
           {"tables", Json::object()},
           {"frames", report::pack_frames({}, {})}};
  if (finished(record, "mat")) run["mat"] = read_object(run_folder / "mat.json", "a mat file");
  if (finished(record, "press")) {
    std::vector<std::string> names(kTables.begin(), kTables.end());
    for (const double compaction : c.schedule.compactions) {
      names.push_back(fmt::format("glue_lines/slip_{}.csv", compaction));
    }
    for (const auto& name : names) {
      if (auto text = files::read_text(run_folder / name)) run["tables"][name] = *text;
    }
    run["frames"] = report::pack_frames(read_frames(run_folder), c.test.curing);
  }
  return {{"format", 2}, {"run", run}};
}

}  // namespace

fs::path write_report_page(const fs::path& run_folder, const fs::path& out) {
  const auto page = report::empty_page();
  auto record = run::read_run_record(run_folder);
  record["steps"].erase("page");  // whether there was a page before changes nothing in this one
  const auto c = read_run_case(run_folder);
  const auto data = data_of(c, record, run_folder);
  auto file = out.empty() ? run_folder / "report.html" : out;
  files::write_atomically(file, report::filled_page(page, sheet_of(c, record, data["run"]["mat"]), data));
  return file;
}

// The folder's own page is one of its results; a page elsewhere is the user's file.
fs::path remake_page(const fs::path& run_folder, const fs::path& out) {
  if (!out.empty()) return write_report_page(run_folder, out);
  fs::path page;
  write_page(run_folder, [&] { page = write_report_page(run_folder); });
  return page;
}

}  // namespace strandlab::run
