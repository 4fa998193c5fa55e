#include <fmt/format.h>

#include <array>
#include <map>
#include <utility>

#include "strandlab/bondline/analysis.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/table/table.hpp"

namespace strandlab::bondline {
namespace {

using table::Dimension, table::Quantity, table::Table;

std::vector<Quantity> columns(bool from_records) {
  const auto length = [](const char* name, const char* alias) {
    return Quantity{{name, alias}, Dimension::kLength, "mm", true};
  };
  const auto modulus = [](const char* name, bool required) {
    return Quantity{{name}, Dimension::kModulus, "MPa", required};
  };
  return {{{"id", "specimen", "sample"}, Dimension::kText, "", true},
          {{"group"}, Dimension::kText, "", true},
          modulus("E1", true),
          modulus("E2", true),
          modulus("G1", false),
          modulus("G2", false),
          length("t1", "thickness1"),
          length("t2", "thickness2"),
          length("W", "width"),
          length("l", "overlap"),
          length("L1", "tab1"),
          length("L2", "tab2"),
          {{"k", "stiffness"}, Dimension::kStiffness, "N_per_mm", !from_records},
          {{"u_k"}, Dimension::kStiffness, "N_per_mm", false},
          {{"record"}, Dimension::kText, "", false}};
}

// Fills what the table gives of the geometry; the name of the first empty cell, if any, becomes the specimen's problem.
void read_geometry(const Table& table, int row, Specimen& specimen) {
  Geometry& g = specimen.geometry;
  using Field = std::pair<const char*, double*>;
  for (const auto& [name, value] :
       {Field{"E1", &g.E1_MPa}, Field{"E2", &g.E2_MPa}, Field{"t1", &g.t1_mm}, Field{"t2", &g.t2_mm},
        Field{"W", &g.W_mm}, Field{"l", &g.l_mm}, Field{"L1", &g.L1_mm}, Field{"L2", &g.L2_mm}}) {
    const auto given = table.number(row, name);
    if (given) *value = *given;
    if (!given && specimen.problem.empty()) specimen.problem = fmt::format("no value for {}", name);
  }
  g.G1_MPa = table.number(row, "G1");
  g.G2_MPa = table.number(row, "G2");
  if (auto wrong = fault(g); !wrong.empty()) throw InputError(fmt::format("{}: {}", table.where(row), wrong));
}

void read_stiffness(const Table& table, int row, const std::optional<Records>& records, Specimen& specimen) {
  specimen.k_error_N_per_mm = table.number(row, "u_k");
  if (specimen.k_error_N_per_mm && !(*specimen.k_error_N_per_mm >= 0))
    throw InputError(
        fmt::format("{}: u_k = {:g} N/mm must not be negative", table.where(row), *specimen.k_error_N_per_mm));
  if (records) {
    std::string file = table.text(row, "record");
    if (file.empty()) file = specimen.id + ".csv";
    specimen.slope = fit_stiffness(read_record(records->folder / file), records->window);
    if (!specimen.slope->problem.empty()) {
      if (specimen.problem.empty()) specimen.problem = file + ": " + specimen.slope->problem;
      return;
    }
    specimen.k_N_per_mm = specimen.slope->stiffness_N_per_mm;
    if (!specimen.k_error_N_per_mm) specimen.k_error_N_per_mm = specimen.slope->standard_error;
    return;
  }
  specimen.k_N_per_mm = table.number(row, "k");
  if (!specimen.k_N_per_mm && specimen.problem.empty()) specimen.problem = "no value for k";
}

}  // namespace

SpecimenTable read_specimens(const std::filesystem::path& file, const std::optional<Records>& records) {
  if (records) validate(records->window);
  const Table table(file, columns(records.has_value()));
  SpecimenTable result;
  result.factors = table.other_columns();
  std::map<std::pair<std::string, std::string>, int> seen;
  for (int row = 0; row < table.rows(); ++row) {
    Specimen specimen;
    specimen.id = table.text(row, "id");
    specimen.group = table.text(row, "group");
    specimen.source = table.where(row);
    if (specimen.id.empty()) throw InputError(fmt::format("{}: the specimen has no id", specimen.source));
    const auto [first, fresh] = seen.try_emplace({specimen.group, specimen.id}, row);
    if (!fresh)
      throw InputError(fmt::format("{}: specimen '{}' of group '{}' stands on line {} already", specimen.source,
                                   specimen.id, specimen.group, table.line(first->second)));
    read_geometry(table, row, specimen);
    read_stiffness(table, row, records, specimen);
    for (int i = 0; i < static_cast<int>(result.factors.size()); ++i) specimen.factors.push_back(table.other(row, i));
    result.specimens.push_back(std::move(specimen));
  }
  if (result.specimens.empty()) throw InputError(fmt::format("{}: has no specimens below its header", file.string()));
  return result;
}

}  // namespace strandlab::bondline
