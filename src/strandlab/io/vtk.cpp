#include "strandlab/io/vtk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#include "strandlab/core/markup.hpp"
#include "strandlab/core/version.hpp"
#include "strandlab/files/atomic_file.hpp"
#include "strandlab/files/base64.hpp"
#include "strandlab/panel/point_fields.hpp"

namespace strandlab::io {
namespace {

// Cell types of the VTK file format.
constexpr std::uint8_t kLine = 3, kQuad = 9, kHexahedron = 12;

// VTK's "binary" array: the number of bytes as UInt64, then the values, as one base64 text.
template <class Value>
std::string encoded(const std::vector<Value>& values) {
  const std::uint64_t size = values.size() * sizeof(Value);
  std::string bytes(sizeof size + size, '\0');
  std::memcpy(bytes.data(), &size, sizeof size);
  if (size > 0) std::memcpy(bytes.data() + sizeof size, values.data(), size);
  return files::base64(bytes);
}

template <class Value>
constexpr const char* type_name() {
  if constexpr (std::is_same_v<Value, float>) return "Float32";
  if constexpr (std::is_same_v<Value, std::int32_t>) return "Int32";
  if constexpr (std::is_same_v<Value, std::int64_t>) return "Int64";
  if constexpr (std::is_same_v<Value, std::uint8_t>) return "UInt8";
}

template <class Value>
std::string array(const std::string& name, const std::vector<Value>& values,
                  const std::vector<std::string>& parts = {}) {
  std::string head = fmt::format("<DataArray type=\"{}\" Name=\"{}\"", type_name<Value>(), name);
  if (!parts.empty()) head += fmt::format(" NumberOfComponents=\"{}\"", parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) head += fmt::format(" ComponentName{}=\"{}\"", i, parts[i]);
  return fmt::format("{} format=\"binary\">{}</DataArray>\n", head, encoded(values));
}

// Texts as VTK writes them: the codes of their bytes, each text ended by 0.
std::string text_array(const std::string& name, const std::vector<std::string>& texts) {
  std::string codes;
  for (const auto& text : texts) {
    for (const char c : text) codes += fmt::format("{} ", static_cast<int>(static_cast<unsigned char>(c)));
    codes += "0 ";
  }
  return fmt::format("<DataArray type=\"String\" Name=\"{}\" NumberOfTuples=\"{}\" format=\"ascii\">{}</DataArray>\n",
                     name, texts.size(), codes);
}

std::string number_array(const std::string& name, double value) {
  return fmt::format("<DataArray type=\"Float64\" Name=\"{}\" NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n",
                     name, value);
}

// By first appearance.
template <int Dim>
std::vector<std::string> kinds_of(const Panel<Dim>& panel) {
  std::vector<std::string> kinds;
  for (const auto& strand : panel.strands) {
    if (std::find(kinds.begin(), kinds.end(), strand.kind) == kinds.end()) kinds.push_back(strand.kind);
  }
  return kinds;
}

template <int Dim>
std::string field_data(const Panel<Dim>& panel, const VtuNotes<Dim>& notes) {
  const auto kinds = kinds_of(panel);
  std::vector<std::string> materials;
  for (const auto& kind : kinds) {
    const auto found = notes.material_of_kind.find(kind);
    materials.push_back(found == notes.material_of_kind.end() ? "" : found->second);
  }
  return "<FieldData>\n" + number_array("TimeValue", panel.compaction()) +
         number_array("compaction", panel.compaction()) + number_array("thickness_mm", panel.thickness_mm()) +
         number_array("time_ms", 1e3 * panel.time_s) + text_array("kinds", kinds) + text_array("materials", materials) +
         text_array("units", {"lengths in mm; other names end in their units; stress is positive in tension"}) +
         "</FieldData>\n";
}

// Of each corner of each strand, in the order of mesh().
template <int Dim>
std::string displacements(const Panel<Dim>& panel, const Panel<Dim>& formed) {
  std::vector<float> values;
  for (std::size_t s = 0; s < panel.strands.size(); ++s) {
    const auto now = corners(panel.strands[s]), before = corners(formed.strands[s]);
    for (std::size_t c = 0; c < now.size(); ++c) {
      for (int d = 0; d < 3; ++d) values.push_back(d < Dim ? static_cast<float>(now[c][d] - before[c][d]) : 0.0F);
    }
  }
  return "<PointData>\n" + array("displacement_mm", values, {"x", "y", "z"}) + "</PointData>\n";
}

template <int Dim>
std::string mesh(const Panel<Dim>& panel) {
  std::vector<float> points;
  std::vector<std::int64_t> connectivity, offsets;
  for (const auto& strand : panel.strands) {
    const auto first = static_cast<std::int64_t>(points.size() / 3);
    for (const auto& corner : corners(strand)) {
      for (int d = 0; d < 3; ++d) points.push_back(d < Dim ? static_cast<float>(corner[d]) : 0.0F);
    }
    for (std::size_t p = 0; p < strand.size(); ++p) {
      for (const auto corner : strand.lattice.cell(p))
        connectivity.push_back(first + static_cast<std::int64_t>(corner));
      offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
    }
  }
  const std::vector<std::uint8_t> types(offsets.size(), Dim == 2 ? kQuad : kHexahedron);
  return fmt::format(
      "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<Points>\n{}</Points>\n<Cells>\n{}{}{}</Cells>\n",
      points.size() / 3, offsets.size(), array("position_mm", points, {"x", "y", "z"}),
      array("connectivity", connectivity), array("offsets", offsets), array("types", types));
}

// One value (or more) per material point of the panel: value(strand, point, out).
template <class Value, int Dim, class Function>
std::vector<Value> per_point(const Panel<Dim>& panel, const Function& value) {
  std::vector<Value> values;
  for (std::size_t s = 0; s < panel.strands.size(); ++s) {
    for (std::size_t p = 0; p < panel.strands[s].size(); ++p) value(s, panel.strands[s], p, values);
  }
  return values;
}

// A function of one number per point, as per_point() wants it.
template <class Value, class Function>
auto single(const Function& number) {
  return [number](std::size_t s, const auto& strand, std::size_t p, std::vector<Value>& out) {
    out.push_back(static_cast<Value>(number(s, strand, p)));
  };
}

template <int Dim>
std::string cell_data(const Panel<Dim>& panel) {
  const auto stress = [](std::size_t, const Strand<Dim>& strand, std::size_t p, std::vector<float>& out) {
    const Tensor<3> sigma = cauchy_stress<Dim>(strand.points.F[p], strand.points.stress[p]);
    for (const auto& [i, j] : {std::pair{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}) {
      out.push_back(static_cast<float>(sigma(i, j)));
    }
  };
  const auto velocity = [](std::size_t, const Strand<Dim>& strand, std::size_t p, std::vector<float>& out) {
    for (int d = 0; d < 3; ++d) out.push_back(d < Dim ? static_cast<float>(strand.points.v[p][d] * 1e-3) : 0.0F);
  };
  const auto density = single<float>([](auto, const auto& strand, auto p) { return density_kg_m3(strand, p); });
  const auto angle =
      single<float>([](auto, const auto& strand, auto p) { return grain_angle_deg<Dim>(strand.points.F[p]); });
  const auto in_plane = single<float>([](auto, const auto& strand, auto) { return strand.angle_deg; });
  const auto id = single<std::int32_t>([](auto s, const auto&, auto) { return s; });
  const auto kinds = kinds_of(panel);
  const auto kind = single<std::int32_t>([&kinds](auto, const auto& strand, auto) {
    return std::find(kinds.begin(), kinds.end(), strand.kind) - kinds.begin();
  });
  const auto row = single<std::int32_t>([](auto, const auto& strand, auto) { return strand.row; });
  std::string shown;
  for_each_shown_field<Dim>(pattern_of_points(panel), [&](const auto& field) {
    const auto value = [&](auto, const auto& strand, auto p) { return (strand.points.*field.values)[p]; };
    shown += array(field.name, per_point<float>(panel, single<float>(value)));
  });
  return "<CellData Scalars=\"density_kg_m3\">\n" + array("density_kg_m3", per_point<float>(panel, density)) +
         array("grain_angle_deg", per_point<float>(panel, angle)) +
         array("stress_MPa", per_point<float>(panel, stress), {"XX", "YY", "ZZ", "XY", "YZ", "XZ"}) + shown +
         array("velocity_m_s", per_point<float>(panel, velocity), {"x", "y", "z"}) +
         array("strand_id", per_point<std::int32_t>(panel, id)) + array("row", per_point<std::int32_t>(panel, row)) +
         array("kind", per_point<std::int32_t>(panel, kind)) +
         array("laid_angle_deg", per_point<float>(panel, in_plane)) + "</CellData>\n";
}

std::string vtk_file(const char* type, const std::string& body) {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n<!-- strandlab {} -->\n"
      "<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n{}</VTKFile>\n",
      version(), type, body);
}

}  // namespace

template <int Dim>
void write_annotated_vtu(const Panel<Dim>& panel, const VtuNotes<Dim>& notes, const std::filesystem::path& file) {
  const std::string grid = "<UnstructuredGrid>\n" + field_data(panel, notes) + mesh(panel) +
                           (notes.formed ? displacements(panel, *notes.formed) : "") + cell_data(panel) +
                           "</Piece>\n</UnstructuredGrid>\n";
  files::write_atomically(file, vtk_file("UnstructuredGrid", grid));
}

template <int Dim>
void write_vtu(const Panel<Dim>& panel, const std::filesystem::path& file) {
  write_annotated_vtu(panel, {}, file);
}

template void write_annotated_vtu(const Panel<2>&, const VtuNotes<2>&, const std::filesystem::path&);
template void write_vtu(const Panel<2>&, const std::filesystem::path&);
template void write_vtu(const Panel<3>&, const std::filesystem::path&);

void write_glue_vtu(const std::vector<GlueLinePoint>& points, const std::filesystem::path& file) {
  std::vector<float> positions, slips;
  std::vector<std::int64_t> connectivity, offsets;
  std::vector<std::int32_t> strand_a, strand_b;
  constexpr double kWidest = 3;  // spacings of a line's first points: beyond it the line was interrupted
  double spacing = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& p = points[i];
    for (const double x : {p.position[0], p.position[1], 0.0}) positions.push_back(static_cast<float>(x));
    slips.push_back(static_cast<float>(p.slip_mm_per_strain));
    const bool goes_on = i > 0 && points[i - 1].strand_a == p.strand_a && points[i - 1].strand_b == p.strand_b;
    const double length = goes_on ? (p.position - points[i - 1].position).norm() : 0;
    if (goes_on && spacing == 0) spacing = length;
    if (!goes_on || length > kWidest * spacing) {  // another line begins
      spacing = 0;
      continue;
    }
    for (const auto end : {i - 1, i}) connectivity.push_back(static_cast<std::int64_t>(end));
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
    strand_a.push_back(p.strand_a);
    strand_b.push_back(p.strand_b);
  }
  const auto body = fmt::format(
      "<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<Points>\n{}</Points>\n"
      "<Cells>\n{}{}{}</Cells>\n<PointData>\n{}</PointData>\n<CellData>\n{}{}</CellData>\n</Piece>\n"
      "</UnstructuredGrid>\n",
      points.size(), offsets.size(), array("position_mm", positions, {"x", "y", "z"}),
      array("connectivity", connectivity), array("offsets", offsets),
      array("types", std::vector<std::uint8_t>(offsets.size(), kLine)), array("slip_mm_per_strain", slips),
      array("strand_a", strand_a), array("strand_b", strand_b));
  files::write_atomically(file, vtk_file("UnstructuredGrid", body));
}

void write_pvd(const std::vector<PvdEntry>& entries, const std::filesystem::path& file) {
  std::string body = "<Collection>\n";
  for (const auto& entry : entries) {
    body += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", entry.compaction,
                        escaped_markup(entry.file));
  }
  files::write_atomically(file, vtk_file("Collection", body + "</Collection>\n"));
}

}  // namespace strandlab::io
