#include "strandlab/io/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <span>
#include <string_view>
#include <system_error>
#include <tuple>
#include <type_traits>
#include <utility>

#include "strandlab/core/error.hpp"
#include "strandlab/core/version.hpp"
#include "strandlab/files/atomic_file.hpp"
#include "strandlab/files/hdf5.hpp"

namespace strandlab::io {
namespace {

using files::hdf5::Label;
using files::hdf5::Reader;
using files::hdf5::Shape;
using files::hdf5::Writer;

static_assert(std::numeric_limits<double>::is_iec559 && std::endian::native == std::endian::little,
              "files hold little-endian IEEE doubles; elsewhere HDF5 would convert, which is untested");

constexpr std::int64_t kFormatVersion = 2;
constexpr const char* kCheckpointFormat = "strandlab checkpoint";
constexpr const char* kPanelFormat = "strandlab panel";

// The tables below name every field once, for writing and for reading. The structured bindings stop compiling when a
// struct gains a field that a checkpoint would then lose.

struct RecordField {
  const char* name;
  Label label;
  double press::Record::*value;
};

constexpr std::array kRecordFields{
    RecordField{"compaction", {"1", "1 - gap/gap as formed"}, &press::Record::compaction},
    RecordField{"time_ms", {"ms", "time since the start"}, &press::Record::time_ms},
    RecordField{"stress_MPa", {"MPa", "mean of both platens"}, &press::Record::stress_MPa},
    RecordField{"force_top_N", {"N", "on the top platen"}, &press::Record::force_top_N},
    RecordField{"force_bottom_N", {"N", "on the bottom platen"}, &press::Record::force_bottom_N},
    RecordField{"kinetic_mJ", {"mJ", "kinetic energy"}, &press::Record::kinetic_mJ},
    RecordField{"elastic_mJ", {"mJ", "elastic energy"}, &press::Record::elastic_mJ},
    RecordField{"plastic_mJ", {"mJ", "dissipated by yielding"}, &press::Record::plastic_mJ},
    RecordField{"friction_mJ", {"mJ", "dissipated by friction"}, &press::Record::friction_mJ},
    RecordField{"contact_mJ", {"mJ", "lost in inelastic contact"}, &press::Record::contact_mJ},
    RecordField{"filter_mJ", {"mJ", "lost to the velocity filter"}, &press::Record::filter_mJ},
    RecordField{
        "softening_mJ", {"mJ", "lost as wood under stress got softer or stiffer"}, &press::Record::softening_mJ},
    RecordField{"damping_mJ", {"mJ", "taken by damping"}, &press::Record::damping_mJ},
    RecordField{"platen_work_mJ", {"mJ", "work of the platens"}, &press::Record::platen_work_mJ},
};
static_assert(sizeof(press::Record) == kRecordFields.size() * sizeof(double), "a field of Record is missing above");

template <class State, class Visit>
void visit_engine(State& state, const Visit& visit) {
  auto& [step, time, time_step, bottom, top, energies, unconverged_contacts, most_fields, cell_stretch] = state;
  auto& [bottom_position, bottom_velocity] = bottom;
  auto& [top_position, top_velocity] = top;
  auto& [kinetic, elastic, plastic, friction, contact, filter, softening, damping, platen_work, external_work] =
      energies;
  visit("step", Label{"1", "steps taken"}, step);
  visit("time_s", Label{"s", "time since the start"}, time);
  visit("time_step_s", Label{"s", "last time step"}, time_step);
  visit("bottom_platen_mm", Label{"mm", "height of the bottom platen's face"}, bottom_position);
  visit("bottom_platen_mm_s", Label{"mm/s", "velocity of the bottom platen"}, bottom_velocity);
  visit("top_platen_mm", Label{"mm", "height of the top platen's face"}, top_position);
  visit("top_platen_mm_s", Label{"mm/s", "velocity of the top platen"}, top_velocity);
  visit("kinetic_mJ", Label{"mJ", "kinetic energy"}, kinetic);
  visit("elastic_mJ", Label{"mJ", "elastic energy"}, elastic);
  visit("plastic_mJ", Label{"mJ", "dissipated by yielding"}, plastic);
  visit("friction_mJ", Label{"mJ", "dissipated by friction"}, friction);
  visit("contact_mJ", Label{"mJ", "lost in inelastic contact"}, contact);
  visit("filter_mJ", Label{"mJ", "lost to the velocity filter"}, filter);
  visit("softening_mJ", Label{"mJ", "lost as wood under stress got softer or stiffer"}, softening);
  visit("damping_mJ", Label{"mJ", "taken by damping"}, damping);
  visit("platen_work_mJ", Label{"mJ", "work of the platens"}, platen_work);
  visit("external_work_mJ", Label{"mJ", "work of tractions and gravity"}, external_work);
  visit("unconverged_contacts", Label{"1", "nodes whose contact still changed after the last pass, over all steps"},
        unconverged_contacts);
  visit("most_fields", Label{"1", "velocity fields that met at a node so far"}, most_fields);
  visit("cell_stretch", Label{"1", "height of the cells over that at the start, where it follows the strands"},
        cell_stretch);
}

// Where the press stands, besides its panel, engine and records.
template <class AnyCheckpoint, class Visit>
void visit_press(AnyCheckpoint& checkpoint, const Visit& visit) {
  auto& [panel, engine, records, pending, snapshots_done, balance_time, balance_top, balance_bottom, worst_imbalance,
         worst_kinetic, cycle] = checkpoint;
  static_cast<void>(std::tie(panel, engine, records, pending, cycle));  // in groups of their own
  visit("snapshots_done", Label{"1", "compactions reached so far"}, snapshots_done);
  visit("balance_time_s", Label{"s", "time over which the platens' impulses are summed"}, balance_time);
  visit("balance_top_N_s", Label{"N s", "impulse on the top platen over that time"}, balance_top);
  visit("balance_bottom_N_s", Label{"N s", "impulse on the bottom platen over that time"}, balance_bottom);
  visit("worst_imbalance", Label{"1", "largest difference of the platens' impulses so far"}, worst_imbalance);
  visit("worst_kinetic", Label{"1", "largest share of kinetic energy so far"}, worst_kinetic);
}

constexpr const char* kPeriodic = "/panel/periodic";  // of panels in 3D

template <class AnyPanel, class Visit>
void visit_panel(AnyPanel& panel, const Visit& visit) {
  auto& [length, depth, periodic, initial_thickness, bottom, top, time, strands] = panel;
  static_cast<void>(std::tie(periodic, strands));  // of their own
  visit("length_mm", Label{"mm", "length of the window along x"}, length);
  visit("depth_mm", Label{"mm", "width across; 1 for a section"}, depth);
  visit("initial_thickness_mm", Label{"mm", "platen gap of the mat as formed"}, initial_thickness);
  visit("bottom_mm", Label{"mm", "height of the bottom platen's face"}, bottom);
  visit("top_mm", Label{"mm", "height of the top platen's face"}, top);
  visit("time_s", Label{"s", "time since the start"}, time);
}

// Numbers of one strand that files keep as one dataset over all strands: visit(name, label, shape of one, first
// number).
template <class AnyStrand, class Visit>
void visit_strand(AnyStrand& strand, const Visit& visit) {
  auto& [kind, row, angle, material, stiffness_factor, lattice, points] = strand;
  auto& [counts, spacing] = lattice;
  static_cast<void>(std::tie(kind, row, counts, points));  // in datasets of their own
  auto& [density, stiffness, surface, hardening] = material;
  const auto dim = static_cast<hsize_t>(spacing.size());
  visit("angle_deg", Label{"deg", "grain against the section"}, Shape{}, &angle);
  visit("spacing_mm", Label{"mm", "of the material points at formation"}, Shape{dim}, spacing.data());
  visit("stiffness_factor", Label{"1", "elastic stiffness in the press over stiffness_MPa"}, Shape{},
        &stiffness_factor);
  visit("density_t_mm3", Label{"t/mm^3", "density at formation"}, Shape{}, &density);
  visit("stiffness_MPa", Label{"MPa", "strand axes, Voigt 11 22 33 23 13 12"}, Shape{6, 6}, stiffness.data());
  visit("yield_surface_per_MPa2", Label{"1/MPa^2", "f^2 = s^T P s, strand axes"}, Shape{6, 6}, surface.data());
  wood::for_each_law([&visit, &parts = hardening]<class L>() {
    auto& numbers = wood::part_of<L>(parts);
    std::decay_t<decltype(numbers)>::visit(numbers,
                                           [&](const char* name, const char* unit, const char* meaning, auto& number) {
                                             visit(name, Label{unit, meaning}, Shape{}, &number);
                                           });
  });
}

hsize_t product(const Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), hsize_t{1}, std::multiplies<>());
}

Shape with_count(hsize_t count, Shape shape) {
  shape.insert(shape.begin(), count);
  return shape;
}

template <class Field>
Shape shape_of(const Field& field) {
  const auto shape = field.shape();
  return {shape.begin(), shape.end()};
}

// A point's numbers, whatever Eigen calls them.
inline const double* numbers(const double& value) {
  return &value;
}
inline double* numbers(double& value) {
  return &value;
}
template <class Matrix>
const double* numbers(const Matrix& value) {
  return value.data();
}
template <class Matrix>
double* numbers(Matrix& value) {
  return value.data();
}

// Integers are kept as int64, the rest as doubles.
template <class Number>
using Stored = std::conditional_t<std::is_integral_v<Number>, std::int64_t, double>;

template <class Number>
void write_scalar(Writer& out, const std::string& path, Number value, const Label& label) {
  const Stored<Number> stored = value;
  out.write(path, {1}, std::span(&stored, 1), label);
}

template <class Number>
void read_scalar(const Reader& in, const std::string& path, Number& value) {
  if constexpr (std::is_integral_v<Number>) {
    value = static_cast<Number>(in.integers(path, {1})[0]);
  } else {
    value = in.doubles(path, {1})[0];
  }
}

template <int Dim>
std::string describe_lattice(const Strand<Dim>& strand) {
  std::string text = fmt::format("{}", strand.lattice.counts[0]);
  for (int d = 1; d < Dim; ++d) text += fmt::format(" x {}", strand.lattice.counts[d]);
  return text;
}

template <int Dim>
void write_strand_lists(Writer& out, const Panel<Dim>& panel) {
  std::vector<std::string> kinds;
  std::vector<std::int64_t> rows, lattice;
  for (const auto& strand : panel.strands) {
    kinds.push_back(strand.kind);
    rows.push_back(strand.row);
    lattice.insert(lattice.end(), strand.lattice.counts.begin(), strand.lattice.counts.end());
  }
  const hsize_t count = panel.strands.size();
  out.write("/panel/strands/kind", kinds, {"", "name of the strand kind"});
  out.write("/panel/strands/row", {count}, rows, {"1", "layer of the mat, 0 at the bottom"});
  out.write("/panel/strands/points", {count, Dim}, lattice, {"1", "lattice of material points, along first"});
}

template <int Dim>
void write_strand_numbers(Writer& out, const Panel<Dim>& panel) {
  const Strand<Dim> pattern{};  // gives names and shapes also to a panel without strands
  std::size_t index = 0;
  visit_strand(pattern, [&](const char* name, const Label& label, const Shape& shape, const double*) {
    std::vector<double> values;
    for (const auto& strand : panel.strands) {
      std::size_t i = 0;
      visit_strand(strand, [&](const char*, const Label&, const Shape&, const double* first) {
        if (i++ == index) values.insert(values.end(), first, first + product(shape));
      });
    }
    out.write(std::string("/panel/strands/") + name, with_count(panel.strands.size(), shape), values, label);
    ++index;
  });
}

// Numbers of the material points, one dataset over all strands for each field that is kept, points in the order of the
// strands.
template <int Dim>
void write_points(Writer& out, const Panel<Dim>& panel) {
  hsize_t total = 0;
  for (const auto& strand : panel.strands) total += strand.lattice.size();
  for_each_field_of<Dim>(pattern_of_points(panel), [&](const auto& field) {
    if (!field.kept) return;
    const Shape shape = shape_of(field);
    std::vector<double> values;
    values.reserve(total * product(shape));
    for (const auto& strand : panel.strands) {
      for (const auto& value : strand.points.*field.values) {
        values.insert(values.end(), numbers(value), numbers(value) + product(shape));
      }
    }
    out.write(std::string("/panel/points/") + field.name, with_count(total, shape), values,
              {field.unit, field.description});
  });
}

template <int Dim>
void write_panel_group(Writer& out, const Panel<Dim>& panel) {
  visit_panel(panel, [&](const char* name, const Label& label, double value) {
    write_scalar(out, std::string("/panel/") + name, value, label);
  });
  if constexpr (Dim == 3) {
    write_scalar(out, kPeriodic, panel.periodic ? 1.0 : 0.0, {"1", "1 where the window repeats in x and y, else 0"});
  }
  write_strand_lists(out, panel);
  write_strand_numbers(out, panel);
  write_points(out, panel);
}

template <int Dim>
void read_strand_lists(const Reader& in, Panel<Dim>& panel) {
  const hsize_t count = in.length("/panel/strands/row");
  const auto kinds = in.texts("/panel/strands/kind", count);
  const auto rows = in.integers("/panel/strands/row", {count});
  const auto lattice = in.integers("/panel/strands/points", {count, Dim});
  panel.strands.resize(count);
  for (std::size_t s = 0; s < count; ++s) {
    auto& strand = panel.strands[s];
    strand.kind = kinds[s];
    strand.row = static_cast<int>(rows[s]);
    for (std::size_t d = 0; d < Dim; ++d) {
      const auto extent = lattice[s * Dim + d];
      if (extent < 1 || extent > std::numeric_limits<int>::max()) {
        in.fail(fmt::format("/panel/strands/points: strand {} has {} points along axis {}", s, extent, d));
      }
      strand.lattice.counts[d] = static_cast<int>(extent);
    }
  }
}

template <int Dim>
void read_strand_numbers(const Reader& in, Panel<Dim>& panel) {
  const hsize_t count = panel.strands.size();
  const Strand<Dim> pattern{};
  std::size_t index = 0;
  visit_strand(pattern, [&](const char* name, const Label&, const Shape& shape, const double*) {
    const auto values = in.doubles(std::string("/panel/strands/") + name, with_count(count, shape));
    const double* next = values.data();
    for (auto& strand : panel.strands) {
      std::size_t i = 0;
      visit_strand(strand, [&](const char*, const Label&, const Shape&, double* first) {
        if (i++ == index) std::copy(next, next + product(shape), first);
      });
      next += product(shape);
    }
    ++index;
  });
}

// The lattices must account for exactly the stored points before anything of their size is allocated.
template <int Dim>
hsize_t checked_total(const Reader& in, const Panel<Dim>& panel) {
  const hsize_t total = in.length("/panel/points/plastic_strain");
  hsize_t sum = 0;
  for (std::size_t s = 0; s < panel.strands.size(); ++s) {
    const auto& strand = panel.strands[s];
    hsize_t size = 1;
    for (const int extent : strand.lattice.counts) size = std::min(size * static_cast<hsize_t>(extent), total + 1);
    if (size > total - sum) {
      in.fail(
          fmt::format("strand {} of {} points goes beyond the {} points stored", s, describe_lattice(strand), total));
    }
    sum += size;
  }
  if (sum != total) in.fail(fmt::format("{} points stored, but the strands have {}", total, sum));
  return total;
}

template <int Dim>
void read_points(const Reader& in, Panel<Dim>& panel) {
  const hsize_t total = checked_total(in, panel);
  for_each_field<Dim>([&](const auto& field) {
    const std::string name = std::string("/panel/points/") + field.name;
    if (field.optional && !in.has(name)) return;
    for (auto& strand : panel.strands) set_zero(strand.points.*field.values, strand.lattice.size());
    if (!field.kept) return;
    const Shape shape = shape_of(field);
    const auto values = in.doubles(name, with_count(total, shape));
    const double* next = values.data();
    for (auto& strand : panel.strands) {
      for (auto& value : strand.points.*field.values) {
        std::copy(next, next + product(shape), numbers(value));
        next += product(shape);
      }
    }
  });
}

template <int Dim>
Panel<Dim> read_panel_group(const Reader& in) {
  Panel<Dim> panel;
  visit_panel(panel, [&](const char* name, const Label&, double& value) {
    read_scalar(in, std::string("/panel/") + name, value);
  });
  if constexpr (Dim == 3) {
    double periodic = 0;
    read_scalar(in, kPeriodic, periodic);
    panel.periodic = periodic != 0;
  }
  read_strand_lists(in, panel);
  read_strand_numbers(in, panel);
  read_points(in, panel);
  return panel;
}

void write_records(Writer& out, const std::string& group, std::span<const press::Record> records) {
  for (const auto& field : kRecordFields) {
    std::vector<double> column;
    for (const auto& record : records) column.push_back(record.*field.value);
    out.write(group + "/" + field.name, {records.size()}, column, field.label);
  }
}

// Older versions did not write it; there it is as in a state at the start.
bool is_new(std::string_view name) {
  return name == "unconverged_contacts" || name == "softening_mJ" || name == "damping_mJ" || name == "most_fields" ||
         name == "cell_stretch";
}

std::vector<press::Record> read_records(const Reader& in, const std::string& group) {
  const hsize_t count = in.length(group + "/" + kRecordFields[0].name);
  std::vector<press::Record> records(count);
  for (const auto& field : kRecordFields) {
    if (is_new(field.name) && !in.has(group + "/" + field.name)) continue;
    const auto column = in.doubles(group + "/" + field.name, {count});
    for (std::size_t i = 0; i < count; ++i) records[i].*field.value = column[i];
  }
  return records;
}

void write_header(Writer& out, const char* format, int dimensions, const std::string& case_hash) {
  out.attribute("format", format);
  out.attribute("format_version", kFormatVersion);
  out.attribute("strandlab_version", version());
  out.attribute("case_hash", case_hash);
  out.attribute("dimensions", dimensions);
}

void check_header(const Reader& in, std::initializer_list<std::string_view> formats, int dimensions,
                  const std::string& case_hash) {
  if (!in.has_attribute("format")) in.fail("this HDF5 file was not written by strandlab (no attribute \"format\")");
  const std::string format = in.text_attribute("format");
  if (std::find(formats.begin(), formats.end(), format) == formats.end()) {
    in.fail(fmt::format("its format is \"{}\", expected \"{}\"", format, *formats.begin()));
  }
  const auto format_version = in.integer_attribute("format_version");
  if (format_version != kFormatVersion) {
    in.fail(fmt::format("its format version is {} (strandlab {}), this program reads version {}", format_version,
                        in.text_attribute("strandlab_version"), kFormatVersion));
  }
  const auto stored_dimensions = in.integer_attribute("dimensions");
  if (stored_dimensions != dimensions) {
    in.fail(fmt::format("it holds a {}-dimensional state, expected {} dimensions", stored_dimensions, dimensions));
  }
  const std::string stored_hash = in.text_attribute("case_hash");
  if (!case_hash.empty() && stored_hash != case_hash) {
    in.fail(fmt::format("it belongs to another case (hash {}, this case has {})", stored_hash, case_hash));
  }
}

template <int Dim>
std::string checkpoint_bytes(const press::Checkpoint<Dim>& checkpoint, const std::string& case_hash) {
  Writer out;
  write_header(out, kCheckpointFormat, Dim, case_hash);
  write_panel_group(out, checkpoint.panel);
  visit_engine(checkpoint.engine, [&](const char* name, const Label& label, auto value) {
    write_scalar(out, std::string("/engine/") + name, value, label);
  });
  write_records(out, "/records", checkpoint.records);
  write_records(out, "/pending", std::span(&checkpoint.pending, 1));
  visit_press(checkpoint, [&](const char* name, const Label& label, auto value) {
    write_scalar(out, std::string("/press/") + name, value, label);
  });
  if (!checkpoint.cycle.empty())
    out.write("/cycle", {checkpoint.cycle.size()}, checkpoint.cycle, {"1", "state of the cycle of the hot press"});
  return out.finish();
}

}  // namespace

template <int Dim>
void write_checkpoint(const press::Checkpoint<Dim>& checkpoint, const std::string& case_hash,
                      const std::filesystem::path& file) {
  files::write_atomically(file, checkpoint_bytes(checkpoint, case_hash));
}

template <int Dim>
void write_panel(const Panel<Dim>& panel, const std::string& case_hash, const std::filesystem::path& file) {
  Writer out;
  write_header(out, kPanelFormat, Dim, case_hash);
  write_panel_group(out, panel);
  files::write_atomically(file, out.finish());
}

template <int Dim>
press::Checkpoint<Dim> read_checkpoint(const std::filesystem::path& file, const std::string& case_hash) {
  const Reader in(file);
  check_header(in, {kCheckpointFormat}, Dim, case_hash);
  press::Checkpoint<Dim> checkpoint;
  checkpoint.panel = read_panel_group<Dim>(in);
  visit_engine(checkpoint.engine, [&](const char* name, const Label&, auto& value) {
    const std::string path = std::string("/engine/") + name;
    if (is_new(name) && !in.has(path)) return;
    read_scalar(in, path, value);
  });
  checkpoint.records = read_records(in, "/records");
  const auto pending = read_records(in, "/pending");
  if (pending.size() != 1) in.fail(fmt::format("/pending holds {} records, expected 1", pending.size()));
  checkpoint.pending = pending[0];
  visit_press(checkpoint, [&](const char* name, const Label&, auto& value) {
    read_scalar(in, std::string("/press/") + name, value);
  });
  if (in.has("/cycle")) checkpoint.cycle = in.doubles("/cycle", {in.length("/cycle")});
  return checkpoint;
}

template <int Dim>
Panel<Dim> read_panel(const std::filesystem::path& file, const std::string& case_hash) {
  const Reader in(file);
  check_header(in, {kPanelFormat, kCheckpointFormat}, Dim, case_hash);
  return read_panel_group<Dim>(in);
}

CheckpointStore::CheckpointStore(std::filesystem::path folder, std::string case_hash)
    : folder_(std::move(folder)), case_hash_(std::move(case_hash)) {}

std::filesystem::path CheckpointStore::newest() const {
  return folder_ / "checkpoint.h5";
}
std::filesystem::path CheckpointStore::previous() const {
  return folder_ / "checkpoint.previous.h5";
}

bool CheckpointStore::exists() const {
  std::error_code error;
  return std::filesystem::exists(newest(), error) || std::filesystem::exists(previous(), error);
}

// Gives the newest file its second name before the next one takes its first: a kill in between leaves both names on
// whole files.
void CheckpointStore::keep_newest() const {
  std::error_code error;
  if (!std::filesystem::exists(newest(), error)) return;
  const auto link = files::temporary_name(previous());
  std::filesystem::create_hard_link(newest(), link, error);
  const bool linked = !error;  // some file systems know no hard links
  std::filesystem::rename(linked ? link : newest(), previous(), error);
  if (error) throw RunError(fmt::format("cannot write {}: {}", previous().string(), error.message()));
  std::filesystem::remove(link, error);  // renaming one name of a file over another of the same file leaves both
}

template <int Dim>
void CheckpointStore::save(const press::Checkpoint<Dim>& checkpoint) const {
  files::write_atomically(newest(), checkpoint_bytes(checkpoint, case_hash_), [this] { keep_newest(); });
}

template <int Dim>
std::optional<press::Checkpoint<Dim>> CheckpointStore::load(std::vector<std::string>* warnings) const {
  std::error_code error;
  std::string why;
  for (const auto& file : {newest(), previous()}) {
    if (!std::filesystem::exists(file, error)) continue;
    try {
      auto checkpoint = read_checkpoint<Dim>(file, case_hash_);
      if (!why.empty() && warnings != nullptr) {
        warnings->push_back(fmt::format("{}; going on from {}", why, file.string()));
      }
      return checkpoint;
    } catch (const InputError& refusal) {
      why += (why.empty() ? "" : "; ") + std::string(refusal.what());
    }
  }
  if (why.empty()) return std::nullopt;
  throw InputError(why);
}

template void write_checkpoint(const press::Checkpoint<2>&, const std::string&, const std::filesystem::path&);
template void write_panel(const Panel<2>&, const std::string&, const std::filesystem::path&);
template press::Checkpoint<2> read_checkpoint(const std::filesystem::path&, const std::string&);
template Panel<2> read_panel(const std::filesystem::path&, const std::string&);
template void CheckpointStore::save(const press::Checkpoint<2>&) const;
template std::optional<press::Checkpoint<2>> CheckpointStore::load(std::vector<std::string>*) const;
template void write_checkpoint(const press::Checkpoint<3>&, const std::string&, const std::filesystem::path&);
template void write_panel(const Panel<3>&, const std::string&, const std::filesystem::path&);
template press::Checkpoint<3> read_checkpoint(const std::filesystem::path&, const std::string&);
template Panel<3> read_panel(const std::filesystem::path&, const std::string&);
template void CheckpointStore::save(const press::Checkpoint<3>&) const;
template std::optional<press::Checkpoint<3>> CheckpointStore::load(std::vector<std::string>*) const;

}  // namespace strandlab::io
