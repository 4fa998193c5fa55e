#include "strandlab/run/bondline.hpp"

#include "strandlab/bondline/plots.hpp"
#include "strandlab/files/atomic_file.hpp"
#include "strandlab/report/bondline_tables.hpp"
#include "strandlab/report/gnuplot.hpp"

namespace strandlab::run {

namespace fs = std::filesystem;

fs::path bondline_folder(const fs::path& table) {
  return fs::path("runs") / (table.stem().string() + "-bondline");
}

BondLinesWritten write(const bondline::Analysis& analysis, const fs::path& table, const fs::path& folder) {
  files::make_folder(folder);
  report::specimen_table(analysis).write(folder / "specimens.csv");
  report::group_table(analysis).write(folder / "groups.csv");
  report::comparison_table(analysis).write(folder / "comparisons.csv");
  const auto json = table.stem().string() + ".json";
  files::write_atomically(folder / json, bondline::to_json(analysis, table.filename().string()));
  std::vector<report::Script> scripts;
  for (const auto& picture : bondline::pictures(analysis))
    scripts.push_back({picture.script, folder / picture.file_name});
  const auto drawn = report::draw_scripts(scripts);
  return {{"specimens.csv", "groups.csv", "comparisons.csv", json}, drawn.pictures.size(), drawn.warnings};
}

}  // namespace strandlab::run
