#include "strandlab/run/form_plate.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "strandlab/case/plate.hpp"
#include "strandlab/case/write.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/files/atomic_file.hpp"
#include "strandlab/mat/drape.hpp"
#include "strandlab/report/layer_picture.hpp"
#include "strandlab/run/composition.hpp"

namespace strandlab::run {
namespace {

namespace fs = std::filesystem;

constexpr double kCellOverThickness = 4.0 / 3;  // of the lattice on which heights are computed, in the plane

struct LayerRow {
  std::string role;
  std::size_t strands = 0;
  double coverage = 0;
  double drawn_deg = 0, placed_deg = 0;  // mean |angle - that of the kind|
  bool drawn = false;                    // not of a mat file
};

std::vector<LayerRow> layer_rows(const cases::Case& c, const mat::FormedPlate& formed) {
  const auto roles = cases::role_angles(c);
  std::vector<LayerRow> rows;
  for (std::size_t i = 0; i < formed.mat.layers.size(); ++i) {
    const auto& layer = formed.mat.layers[i];
    LayerRow row{layer.role, layer.strands.size(), mat::coverage(formed.mat, i)};
    const double kind_angle = mat::angle_deg({}, layer.role, roles);
    for (const auto& strand : layer.strands)
      row.placed_deg += mat::off_angle(mat::angle_deg(strand, layer.role, roles), kind_angle) /
                        static_cast<double>(layer.strands.size());
    row.drawn = i < formed.drawn.size();
    if (row.drawn) row.drawn_deg = formed.drawn[i].mean_off_mean_deg();
    rows.push_back(row);
  }
  return rows;
}

std::string layers_csv(const std::vector<LayerRow>& rows) {
  std::string text = "layer,kind,strands,coverage,mean_angle_off_drawn_deg,mean_angle_off_placed_deg\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& row = rows[i];
    text += fmt::format("{},{},{},{:.6g},{},{:.6g}\n", i + 1, row.role, row.strands, row.coverage,
                        row.drawn ? fmt::format("{:.6g}", row.drawn_deg) : "", row.placed_deg);
  }
  return text;
}

// A folder of another command's results is not ours to write into.
void refuse_folder_of_others(const fs::path& folder, bool force) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw InputError(fmt::format("{}: this is a file, not a folder; choose another with -o", folder.string()));
  if (fs::exists(folder / "run.json", error))
    throw InputError(
        fmt::format("{}: holds the results of another command; choose another folder with -o", folder.string()));
  if (!force && fs::exists(folder / "mat.json", error))
    throw InputError(
        fmt::format("{}: has a mat already; --force replaces it, -o chooses another folder", folder.string()));
}

std::string height_of(const cases::Case& c, const mat::PlateMat& mat) {
  const auto drape = mat::drape(mat, cases::role_angles(c), kCellOverThickness * mat.layer_thickness_mm);
  double wood = 0;
  for (std::size_t i = 0; i < mat.layers.size(); ++i) wood += mat::coverage(mat, i) * mat.thickness_of(i);
  return fmt::format(
      "draped: {:.4g} mm of wood lie {:.4g} mm high in the mean and {:.4g} mm at the highest point; {:.0f} % of the "
      "faces touch what is below",
      wood, drape.mean_top_mm, drape.highest_mm, 100 * drape.touching);
}

}  // namespace

std::vector<std::string> describe_plate(const cases::Case& c, const mat::FormedPlate& formed) {
  const auto& mat = formed.mat;
  std::vector<std::string> lines;
  std::size_t strands = 0;
  const auto rows = layer_rows(c, formed);
  for (const auto& row : rows) strands += row.strands;
  lines.push_back(
      fmt::format("mat: {} layers, {} strands, {:g} x {:g} mm", rows.size(), strands, mat.length_mm, mat.width_mm));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& row = rows[i];
    lines.push_back(fmt::format(
        "layer {}: {} of {}, coverage {:.3f}, mean angle off its kind's {}placed {:.1f} degrees", i + 1, row.strands,
        row.role, row.coverage, row.drawn ? fmt::format("drawn {:.1f}, ", row.drawn_deg) : "", row.placed_deg));
  }
  for (const auto& line : composition(cases::weigh(c, mat))) lines.push_back("mat: " + line);
  if (mat.stack == mat::Stack::kDraped) lines.push_back(height_of(c, mat));
  return lines;
}

std::vector<std::string> form_plate_mat(const cases::Case& c, const Place& place) {
  const auto formed = cases::make_plate(c);
  const auto roles = cases::role_angles(c);
  auto lines = describe_plate(c, formed);
  refuse_folder_of_others(place.folder, place.force);
  const auto pictures = place.folder / "pictures";
  std::error_code error;
  fs::remove_all(pictures, error);  // of a mat with more layers
  files::make_folder(place.folder);
  files::make_folder(pictures);
  files::write_atomically(place.folder / "case.toml", cases::resolved_text(c));
  for (std::size_t i = 0; i < formed.mat.layers.size(); ++i)
    files::write_atomically(pictures / fmt::format("layer_{:02}.svg", i + 1),
                            report::layer_picture(formed.mat, i, roles));
  files::write_atomically(place.folder / "layers.csv", layers_csv(layer_rows(c, formed)));
  mat::write(formed.mat, roles, place.folder / "mat.json");
  return lines;
}

}  // namespace strandlab::run
