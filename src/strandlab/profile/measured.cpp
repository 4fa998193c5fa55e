#include "strandlab/profile/measured.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "strandlab/core/error.hpp"
#include "strandlab/table/table.hpp"

namespace strandlab::profile {
namespace {

using table::Dimension, table::Quantity, table::Table;

constexpr std::size_t kFewestReadings = 5;
constexpr double kDensest = 2000;  // kg/m^3; cell walls have 1500
constexpr double kLightest = 100;  // kg/m^3: no panel's densest layer is lighter
constexpr double kAir = 50;        // kg/m^3: readings beside the specimen, noise and all, are below

std::vector<Quantity> quantities(const MeasuredColumns& columns) {
  Quantity position{{"position", "depth", "distance", "height", "thickness", "x", "Tiefe"}, Dimension::kLength, "mm"};
  position.several = true;  // its header may hold further words: "Depth from top face (mm)"
  if (columns.position > 0) position.columns = {columns.position};
  position.stated_unit = columns.position_unit;
  position.option = "--position";
  Quantity density{{"density", "D", "Dichte", "Rohdichte"}, Dimension::kDensity, "kg_m3"};
  density.option = "--density";
  density.several = true;
  density.columns = columns.density;
  density.stated_unit = columns.density_unit;
  const Quantity specimen{{"specimen", "sample", "board"}, Dimension::kText, "", false};
  return {position, density, specimen};
}

// Readings of one specimen in the order of the file.
class Readings {
 public:
  Readings(std::string name, std::string label, int line)
      : name_(std::move(name)), label_(std::move(label)), line_(line) {}

  const std::string& name() const { return name_; }
  const std::string& label() const { return label_; }  // text of the column of specimens

  // Would this position follow on those before it?
  bool continues(double position) const {
    if (position_.size() < 2) return position_.empty() || position != position_[0];
    return (position > position_.back()) == (position_[1] > position_[0]) && position != position_.back();
  }
  // A new run of positions starts near the start of the old one.
  bool starts_again(double position) const {
    if (position_.size() < 2) return false;
    return std::abs(position - position_.front()) < 0.25 * std::abs(position_.back() - position_.front());
  }
  void add(double position, double density) {
    position_.push_back(position);
    density_.push_back(density);
  }
  double last() const { return position_.back(); }

  Specimen finish(const std::string& source) const {
    refuse_few(source, position_.size(), "");
    const double densest = *std::max_element(density_.begin(), density_.end());
    if (densest < kLightest) {
      throw InputError(
          fmt::format("{}:{}: specimen '{}' has no more than {:g} kg/m3 anywhere, less than any panel (is the unit "
                      "right? --density-unit states it where the file does not)",
                      source, line_, name_, densest));
    }
    auto specimen = without_air();
    refuse_few(source, specimen.position_mm.size(), " in wood");
    return specimen;
  }

 private:
  void refuse_few(const std::string& source, std::size_t count, const char* where) const {
    if (count >= kFewestReadings) return;
    throw InputError(fmt::format("{}:{}: specimen '{}' has {} reading{}{}; a profile needs at least {}", source, line_,
                                 name_, count, count == 1 ? "" : "s", where, kFewestReadings));
  }
  // Positions from the first reading in wood to the last one, increasing.
  Specimen without_air() const {
    const auto is_wood = [](double density) { return density >= kAir; };
    const auto from = std::find_if(density_.begin(), density_.end(), is_wood) - density_.begin();
    const auto past = density_.rend() - std::find_if(density_.rbegin(), density_.rend(), is_wood);
    Specimen specimen{name_,
                      {position_.begin() + from, position_.begin() + past},
                      {density_.begin() + from, density_.begin() + past}};
    const double start = specimen.position_mm.front(), sign = specimen.position_mm.back() > start ? 1 : -1;
    for (auto& x : specimen.position_mm) x = sign * (x - start);
    return specimen;
  }

  std::string name_, label_;
  int line_ = 0;  // of the first reading
  std::vector<double> position_, density_;
};

// Readings of the table's density column `which`, split into specimens.
class Column {
 public:
  Column(const Table& table, const std::string& source, int which) : table_(table), source_(source), which_(which) {}

  std::vector<Specimen> specimens() {
    const bool own_positions = table_.count("position") == table_.count("density");  // pairs of columns
    for (int row = 0; row < table_.rows(); ++row) {
      const auto position = table_.number(row, "position", own_positions ? which_ : 0);
      const auto density = table_.number(row, "density", which_);
      if (position && density) add(row, *position, *density);
    }
    if (found_.empty()) throw InputError(fmt::format("{}: no readings of position and density", source_));
    std::vector<Specimen> all;
    all.reserve(found_.size());
    for (const auto& readings : found_) all.push_back(readings.finish(source_));
    return all;
  }

 private:
  void add(int row, double position, double density) {
    if (!(density >= -kAir && density <= kDensest)) {
      throw InputError(
          fmt::format("{}: density {:g} kg/m3; wood has between 0 and {:g} kg/m3 (is the unit right? "
                      "--density-unit states it where the file does not)",
                      table_.where(row), density, kDensest));
    }
    if (!std::isfinite(position))
      throw InputError(fmt::format("{}: position {} is not a finite number", table_.where(row), position));
    auto* readings = open(row);
    if (readings != nullptr && !readings->continues(position)) {
      if (!readings->starts_again(position)) {
        throw InputError(
            fmt::format("{}: position {:g} mm after {:g} mm; positions go one way through a specimen, and begin again "
                        "for the next one",
                        table_.where(row), position, readings->last()));
      }
      readings = nullptr;
    }
    if (readings == nullptr) readings = &start(row);
    readings->add(position, density);
  }

  // The specimen that a row goes on with: the last one of its text (rows of specimens may alternate) under the same
  // header.
  Readings* open(int row) {
    if (table_.section(row) != section_) return nullptr;
    const std::string label = table_.text(row, "specimen");
    const auto last = std::find_if(found_.rbegin(), found_.rend() - static_cast<std::ptrdiff_t>(first_of_section_),
                                   [&](const Readings& r) { return r.label() == label; });
    return last == found_.rend() - static_cast<std::ptrdiff_t>(first_of_section_) ? nullptr : &*last;
  }

  Readings& start(int row) {
    if (table_.section(row) != section_) {
      section_ = table_.section(row);
      first_of_section_ = found_.size();
    }
    const std::string label = table_.text(row, "specimen");
    return found_.emplace_back(name(label), label, table_.line(row));
  }

  // What tells the specimen from others: its own text, the words of its column, its number.
  std::string name(const std::string& text) const {
    std::string name = text.empty() ? table_.label("density", which_) : text;
    if (name.empty()) name = std::to_string(which_ + 1);
    const auto same = std::count_if(found_.begin(), found_.end(), [&](const Readings& r) {
      return r.name() == name || r.name().rfind(name + " (", 0) == 0;
    });
    return same > 0 ? fmt::format("{} ({})", name, same + 1) : name;
  }

  const Table& table_;
  const std::string& source_;
  int which_ = 0;
  std::vector<Readings> found_;
  int section_ = 0;
  std::size_t first_of_section_ = 0;  // in found_
};

std::vector<Specimen> specimens_of(const Table& table, const std::string& source) {
  const int positions = table.count("position"), densities = table.count("density");
  if (positions != 1 && positions != densities) {
    throw InputError(
        fmt::format("{}: {} columns of positions for {} of densities; give one for all, or one each "
                    "(--position-column and --density-column choose them)",
                    source, positions, densities));
  }
  std::vector<Specimen> all;
  for (int which = 0; which < densities; ++which) {
    auto found = Column(table, source, which).specimens();
    std::move(found.begin(), found.end(), std::back_inserter(all));
  }
  return all;
}

// Integral of the readings, joined by straight lines, from 0 to a position (the first and last reading go on outside).
double integral_to(const Specimen& s, double to) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < s.position_mm.size(); ++i) {
    const double x0 = s.position_mm[i], x1 = s.position_mm[i + 1];
    if (to <= x0) break;
    const double end = std::min(to, x1), slope = (s.density_kg_m3[i + 1] - s.density_kg_m3[i]) / (x1 - x0);
    sum += (end - x0) * (s.density_kg_m3[i] + 0.5 * slope * (end - x0));
  }
  return sum;
}

}  // namespace

std::vector<Specimen> measured_from_text(const std::string& text, const std::string& source,
                                         const MeasuredColumns& columns) {
  return specimens_of(Table(text, source, quantities(columns)), source);
}

std::vector<Specimen> read_measured(const std::filesystem::path& file, const MeasuredColumns& columns) {
  return specimens_of(Table(file, quantities(columns)), file.string());
}

Profile binned(const Specimen& specimen, int bins) {
  Profile profile{0, specimen.thickness_mm(), {}};
  const double height = specimen.thickness_mm() / bins;
  double before = 0;
  for (int k = 0; k < bins; ++k) {
    const double upto = integral_to(specimen, k + 1 == bins ? specimen.thickness_mm() : (k + 1) * height);
    profile.density_kg_m3.push_back((upto - before) / height);
    before = upto;
  }
  return profile;
}

}  // namespace strandlab::profile
