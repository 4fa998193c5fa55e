#include "strandlab/hotpress/cycle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <span>

#include "strandlab/core/error.hpp"

namespace strandlab::hotpress {
namespace {

constexpr double kFineStep = .05, kFineFor = 2;   // s, after the press begins to open: pressure is gone within a second
constexpr double kOpenStep = .25;                 // s, after that
constexpr double kHottest = 220, kWettest = .25;  // C and kg/kg, up to where the isotherm was measured or is trusted
constexpr double kNearTarget = 1e-4;              // of the height: a target counts as reached
constexpr double kTightest = 1e-15;               // m^2

// The wood of a cell: its thickness as formed, and the material at its middle.
struct CellWood {
  double thickness = 0;  // m
  const wood::Material* material = nullptr;
};

std::vector<CellWood> cut(const PressedMat& mat, double dry_mass, int cells) {
  std::vector<CellWood> result(static_cast<std::size_t>(cells));
  double from = 0;
  for (const auto& layer : mat.layers) {
    const double to = from + layer.dry_mass;
    for (int i = 0; i < cells; ++i) {
      const double low = dry_mass * i / cells, high = dry_mass * (i + 1) / cells, middle = .5 * (low + high);
      const double part = std::min(high, to) - std::max(low, from);
      auto& cell = result[i];
      if (part > 0) cell.thickness += part / layer.material.density_kg_m3;
      if (cell.material == nullptr && (middle < to || &layer == &mat.layers.back())) cell.material = &layer.material;
    }
    from = to;
  }
  return result;
}

void refuse(bool bad, const std::string& message) {
  if (bad) throw InputError(message);
}

// The mat's size, where it can be pressed as the settings say.
MatSize checked_size(const Settings& s, const PressedMat& pressed) {
  auto mat = size_of(pressed);
  if (s.mechanics == Mechanics::kStrands) mat.solid_thickness = mat.thickness;  // it is touched at its highest strand
  refuse(!(mat.dry_mass > 0), "the mat has no mass to press");
  refuse(s.cells < 2 || s.cells > 1000, fmt::format("{} cells through the mat; there must be from 2 to 1000", s.cells));
  refuse(s.columns < 1 || s.columns > 1000,
         fmt::format("{} columns of cells along the mat; there must be from 1 to 1000", s.columns));
  refuse(!(s.step > 0), fmt::format("a time step of {} s; it must be greater than 0", s.step));
  if (s.log) return mat;
  check_targets(s.schedule, mat);
  if (s.mechanics != Mechanics::kUniform) return mat;
  for (const auto& phase : s.schedule)
    refuse(phase.pressure.has_value(),
           fmt::format("phase \"{}\": pressure needs mechanics = \"column\"; a uniform mat has none", phase.text));
  return mat;
}

// A move as the schedule has it; the pressure is that of the platens, gas and wood together.
struct Aim {
  Move move;
  double pressure = 0;  // Pa
};

enum class Faces { kPlatens, kBottomPlaten, kOpen };

std::vector<Layer> layers_of(const std::vector<CellWood>& wood) {
  std::vector<Layer> all;
  all.reserve(wood.size());
  for (const auto& cell : wood) all.push_back(layer_of(*cell.material, cell.thickness));
  return all;
}

std::unique_ptr<MatMechanics> mechanics_of(const Settings& s, const PressedMat& mat) {
  const auto size = checked_size(s, mat);
  if (s.mechanics == Mechanics::kUniform)
    return std::make_unique<UniformMechanics>(size.solid_thickness, s.cells, s.columns);
  return std::make_unique<ColumnMechanics>(layers_of(cut(mat, size.dry_mass, s.cells)), s.rate, s.softening, s.columns);
}

class Press {
 public:
  Press(const Settings& settings, const PressedMat& mat, MatMechanics& mechanics, const Watch& watch)
      : s_(settings),
        size_(checked_size(settings, mat)),
        layers_(mat.layers),
        length_(mat.length),
        mechanics_(mechanics),
        watch_(watch),
        thickness_(mechanics.thickness()),
        solver_(make_solver()) {
    out_.settings = s_;
    out_.mat = size_;
    cure_face_.assign(thickness_.size(), 0);
    cure_core_.assign(thickness_.size(), 0);
    mechanics_.condition(solver_.state());
    list_stages();
  }

  // Goes on from a state that a watch was given.
  void resume(const std::vector<double>& state) {
    Numbers numbers(state);
    visit(numbers);
    within_stage_ = true;
  }

  Cycle run() {
    for (; stage_ < stages_.size(); ++stage_) {
      if (!within_stage_) enter();
      within_stage_ = false;
      stages_[stage_].follow();
      if (stages_[stage_].mark != nullptr) mark(stages_[stage_].mark);
    }
    if (!out_.record.empty() && out_.record.back().mark.empty()) mark("opened");
    out_.thickness_unloaded = mechanics_.height_unloaded();
    out_.dry_mass = solver_.grid().dry_mass;
    out_.length = length_;
    const auto drift = solver_.drift();
    for (int row = 0; row < 3; ++row)
      out_.worst_balance[row] = std::max(solver_.worst_balance_error()[row], std::abs(drift[row]));
    warn_of_targets();
    warn_of_extremes();
    return std::move(out_);
  }

 private:
  // ---- the mat ----
  double mass_fraction(std::size_t cell) const { return (static_cast<double>(cell) + .5) / s_.cells; }
  // Whether the wood in the middle of a cell's mass carries the face resin.
  bool is_face(std::size_t cell) const {
    const double at = mass_fraction(cell);
    double below = 0;
    for (const auto& layer : layers_) {
      below += layer.dry_mass / size_.dry_mass;
      if (at < below && layer.resin != Carried::kOfItsLayer) return layer.resin == Carried::kFace;
      if (at < below) break;
    }
    return std::min(at, 1 - at) < s_.face_fraction;
  }
  // Of the cell's mass the part that lies in the faces has their moisture.
  double moisture(std::size_t cell) const {
    const double low = static_cast<double>(cell) / s_.cells, high = low + 1. / s_.cells;
    const double core = std::max(0., std::min(high, 1 - s_.face_fraction) - std::max(low, s_.face_fraction)) * s_.cells;
    return s_.moisture_face + std::clamp(core, 0., 1.) * (s_.moisture_core - s_.moisture_face);
  }
  transfer::Solver make_solver() const {
    const auto& k = s_.constants;
    transfer::Grid grid;
    grid.rows = s_.cells;
    grid.columns = s_.columns;
    grid.column_width = length_ / s_.columns;
    grid.dry_mass = mechanics_.dry_mass(size_.dry_mass, s_.cells);
    std::vector<transfer::CellState> state;
    for (std::size_t i = 0; i < thickness_.size(); ++i) {
      const double T = k.ambient_temperature, M = moisture(i % static_cast<std::size_t>(s_.cells));
      const double vapour = transfer::relative_pressure(k, T, M) * transfer::saturation_pressure(T);
      state.push_back({T, M, k.ambient_pressure - vapour});
    }
    transfer::Conditions start;
    start.thickness = thickness_;
    return {k, grid, state, start};
  }
  // Of the highest column.
  double height() const {
    double highest = 0;
    for (auto first = thickness_.begin(); first != thickness_.end(); first += s_.cells)
      highest = std::max(highest, std::accumulate(first, first + s_.cells, 0.));
    return highest;
  }
  double gas(int cell) const { return solver_.cell(cell).p - s_.constants.ambient_pressure; }
  double gas_mean() const {
    double sum = 0;
    for (std::size_t i = 0; i < thickness_.size(); ++i) sum += thickness_[i] * gas(static_cast<int>(i));
    return sum / (s_.columns * height());
  }

  // ---- one step ----
  double step_at(double since_opening) const {
    const double t = now();
    const double base = t < 30 ? s_.step : t < 90 ? 2 * s_.step : 4 * s_.step;
    if (since_opening < 0) return base;
    return std::min(base, since_opening < kFineFor - 1e-9 ? kFineStep : kOpenStep);
  }
  double now() const { return start_ + solver_.time(); }

  transfer::Conditions conditions(double time, double begin, double end, const std::vector<double>& before,
                                  const std::vector<double>& after, Faces faces) const {
    transfer::Conditions c;
    const double part = (time - begin) / (end - begin);
    for (std::size_t i = 0; i < after.size(); ++i) c.thickness.push_back(before[i] + part * (after[i] - before[i]));
    const auto room = transfer::open_to(s_.constants, s_.room);
    const double t = start_ + time;
    c.bottom = faces == Faces::kOpen ? room : transfer::platen(interpolated(s_.platen_bottom, t), s_.contact);
    c.top = faces == Faces::kPlatens ? transfer::platen(interpolated(s_.platen_top, t), s_.contact) : room;
    if (s_.columns > 1 && s_.open_ends) c.left = c.right = room;
    return c;
  }

  void cure(const std::vector<transfer::CellState>& before, double seconds) {
    for (std::size_t i = 0; i < before.size(); ++i) {
      const double T = .5 * (before[i].T + solver_.state()[i].T);
      cure_face_[i] = transfer::cured(s_.resin_face, cure_face_[i], T, seconds);
      cure_core_[i] = transfer::cured(s_.resin_core, cure_core_[i], T, seconds);
    }
  }

  // Mechanics with the temperatures at the start of the step, then heat and moisture, then cure.
  void step(double seconds, Aim aim, Faces faces, const std::string& phase) {
    const auto before = thickness_;
    const double height_before = height();
    limited_ = stopped_ = false;
    if (faces != Faces::kBottomPlaten) {
      aim.move.gas = gas_mean();
      aim.move.stress = aim.pressure - aim.move.gas;
      aim.move.fastest = s_.fastest;
      const auto moved = mechanics_.move(aim.move, solver_.state(), seconds);
      limited_ = moved.limited;
      stopped_ = moved.at_stop;
      if (!moved.touches) faces = Faces::kOpen;
    }
    thickness_ = mechanics_.thickness();
    const auto state = solver_.state();
    const double begin = solver_.time(), end = begin + seconds;
    const auto after = thickness_;
    closing_ = (height_before - height()) / seconds;
    solver_.step(seconds, [&](double t) { return conditions(t, begin, end, before, after, faces); });
    cure(state, seconds);
    record(aim, faces, phase);
    if (watch_.step) watch_.step(out_.record.back(), [this] { return state_now(); });
  }

  void record(const Aim& aim, Faces faces, const std::string& phase) {
    Instant at;
    at.time = now();
    at.phase = phase;
    at.thickness = height();
    at.gap = faces == Faces::kOpen && !aim.move.by_pressure ? aim.move.height : at.thickness;
    at.gas_mean = gas_mean();
    at.stress = mechanics_.stress();
    at.pressure = at.stress + at.gas_mean;
    if (!std::isnan(at.stress)) {
      if (aim.move.by_pressure && !limited_) at.pressure = aim.pressure;
      if (faces == Faces::kOpen) at.pressure = 0;
    }
    at.platen_top = interpolated(s_.platen_top, at.time);
    at.platen_bottom = interpolated(s_.platen_bottom, at.time);
    at.heat = solver_.received()[transfer::kEnergy];
    at.water_out = -solver_.received()[transfer::kWater];
    at.cells = readings(s_.columns / 2, at.thickness);
    if (s_.columns > 1) {
      for (int column = 0; column < s_.columns; ++column) {
        const auto own = readings(column, at.thickness);
        at.section.insert(at.section.end(), own.begin(), own.end());
      }
      average_density(at);
    }
    out_.record.push_back(std::move(at));
  }

  std::vector<CellReading> readings(int column, double thickness) const {
    std::vector<CellReading> cells;
    double depth = thickness;
    for (int row = 0; row < s_.cells; ++row) {
      const int i = column * s_.cells + row;
      const auto& state = solver_.state()[i];
      depth -= thickness_[i];
      cells.push_back({depth + .5 * thickness_[i], state.T, state.M, gas(i), solver_.grid().dry_mass[i] / thickness_[i],
                       cure_face_[i], cure_core_[i], is_face(static_cast<std::size_t>(row))});
    }
    return cells;
  }

  // Of cells that have the same part of their columns' mass below them: mass and thickness, mean over the columns.
  void average_density(Instant& at) const {
    double depth = at.thickness;
    for (int row = 0; row < s_.cells; ++row) {
      double mass = 0, thickness = 0;
      for (int i = row; i < s_.columns * s_.cells; i += s_.cells) {
        mass += solver_.grid().dry_mass[i] / s_.columns;
        thickness += thickness_[i] / s_.columns;
      }
      depth -= thickness;
      at.cells[row].depth = depth + .5 * thickness;
      at.cells[row].density = mass / thickness;
    }
  }

  // ---- phases ----
  // Steps up to a time (since first contact), or until a stop is reached where that ends the phase.
  void march(double to, const std::string& phase, Faces faces, const std::function<Aim(double)>& aim, bool ends_at_stop,
             bool opening) {
    while (now() < to - 1e-9 && !(ends_at_stop && stopped_)) {
      double seconds = step_at(opening ? now() - begin_.time : -1);
      if (!opening) {
        const auto& ahead = aim(now() + seconds).move;
        seconds = std::min(seconds, mechanics_.longest_step(ahead.by_pressure ? closing_under_pressure()
                                                                              : (height() - ahead.height) / seconds));
      }
      const bool last = now() + seconds > to - 1e-6 * seconds;
      if (last) seconds = to - now();
      auto next = aim(now() + seconds);
      next.move.last = last;
      step(seconds, next, faces, phase);
    }
  }
  // m/s, expected of the next step: as fast as may be where the last one has not reached its pressure.
  double closing_under_pressure() const { return limited_ && !stopped_ ? s_.fastest : closing_; }
  static Aim to_height(double height, double final_height) {
    Aim aim;
    aim.move.height = height;
    aim.move.final_height = final_height;
    return aim;
  }
  static Aim under_pressure(double pressure, double stop = 0) {
    Aim aim;
    aim.move.by_pressure = true;
    aim.move.stop = stop;
    aim.pressure = pressure;
    return aim;
  }
  void mark(const char* what) {
    if (out_.record.empty()) return;
    out_.record.back().mark = what;
    if (watch_.marked) watch_.marked(out_.record.back());
  }
  double pressure_now() const { return out_.record.empty() ? 0 : out_.record.back().pressure; }

  // What a stage begins with.
  void enter() {
    stopped_ = false;
    begin_ = {now(), height(), pressure_now()};
  }

  void list_stages() {
    if (s_.log) return list_log();
    if (s_.bottom_lead > 0) {
      start_ = -s_.bottom_lead;
      stages_.push_back({[this] { preheat(); }, nullptr});
    }
    for (const auto& phase : s_.schedule) {
      const char* mark = phase.kind == Phase::Kind::kClose  ? "closed"
                         : phase.kind == Phase::Kind::kHold ? "held"
                                                            : nullptr;
      stages_.push_back({[this, phase] { follow(phase); }, mark});
    }
  }

  // The bottom platen is hot and under the mat before the press closes; the top is open to the room.
  void preheat() {
    march(
        0, "lead", Faces::kBottomPlaten, [this](double) { return to_height(begin_.height, begin_.height); }, false,
        false);
  }

  void follow(const Phase& phase) {
    using Kind = Phase::Kind;
    if (phase.kind == Kind::kClose) return close(phase);
    const double begin = begin_.time, end = phase.until ? *phase.until : begin + *phase.seconds;
    if (!(end > begin)) {
      throw InputError(
          fmt::format("phase \"{}\": phases overlap: it ends at {:g} s, but the one before it took until {:g} s",
                      phase.text, end, begin));
    }
    const auto stay = [this](double) { return to_height(begin_.height, begin_.height); };
    if (phase.kind == Kind::kHold) {
      const double stop = phase.target ? thickness_of(*phase.target, size_) : 0;
      const auto press = [&](double) { return under_pressure(*phase.pressure, stop); };
      if (phase.pressure) return march(end, "hold", Faces::kPlatens, press, false, false);
      return march(end, "hold", Faces::kPlatens, stay, false, false);
    }
    if (s_.mechanics == Mechanics::kUniform) {
      const bool vents = phase.kind == Kind::kVent;
      return march(end, vents ? "vent" : "open", vents ? Faces::kPlatens : Faces::kOpen, stay, false, true);
    }
    if (phase.kind == Kind::kOpen)
      return march(
          end, "open", Faces::kOpen, [](double) { return under_pressure(0); }, false, true);
    march(
        end, "vent", Faces::kPlatens,
        [&](double t) { return under_pressure(begin_.pressure * std::max(0., (end - t) / (end - begin))); }, false,
        true);
  }

  void close(const Phase& phase) {
    const double begin = begin_.time, from = begin_.height, to = thickness_of(*phase.target, size_);
    const double end = phase.until     ? *phase.until
                       : phase.seconds ? begin + *phase.seconds
                                       : begin + std::abs(from - to) / *phase.speed;
    if (phase.pressure) {
      march(
          end, "close", Faces::kPlatens, [&](double) { return under_pressure(*phase.pressure, to); }, true, false);
    } else {
      march(
          end, "close", Faces::kPlatens,
          [&](double t) { return to_height(from + (to - from) * (t - begin) / (end - begin), to); }, false, false);
    }
  }

  // Phases of closing under pressure that ended short of their targets.
  void warn_of_targets() {
    if (s_.log) return;
    auto closed = out_.record.begin();
    for (const auto& phase : s_.schedule) {
      if (phase.kind != Phase::Kind::kClose) continue;
      closed = std::find_if(closed, out_.record.end(), [](const Instant& i) { return i.mark == "closed"; });
      if (closed == out_.record.end()) return;
      const double to = thickness_of(*phase.target, size_);
      if (phase.pressure && closed->thickness > to * (1 + kNearTarget)) {
        out_.warnings.push_back(fmt::format(
            "phase \"{}\": never reached its target: {:.4g} mm at {:g} s, not {:.4g} mm; more pressure, more time or a "
            "hotter, moister mat would close it",
            phase.text, 1e3 * closed->thickness, closed->time, 1e3 * to));
      }
      ++closed;
    }
  }

  // ---- a log ----
  void list_log() {
    const auto& log = *s_.log;
    const bool by_position = !log.position.empty();
    if (!by_position && s_.mechanics == Mechanics::kUniform)
      throw InputError("the log has no position, and pressure needs mechanics = \"column\"");
    const auto& points = by_position ? log.position : log.pressure;
    const double contact = by_position ? first_contact(points) : first_pressure(points);
    const auto shifted = [contact](std::vector<Point> p) {
      for (auto& point : p) point.at -= contact;
      return p;
    };
    const auto path = shifted(points);
    if (!log.platen_top.empty()) s_.platen_top = shifted(log.platen_top);
    if (!log.platen_bottom.empty()) s_.platen_bottom = shifted(log.platen_bottom);
    out_.log_start = contact;
    const auto ends = ends_of_hold(path, by_position);
    const auto aim = [path, by_position](double t) {
      const double value = interpolated(path, t);
      return by_position ? to_height(value, value) : under_pressure(std::max(0., value));
    };
    const auto stage = [this, aim](double end, const char* phase, bool opening, const char* mark) {
      stages_.push_back({[=, this] { march(end, phase, Faces::kPlatens, aim, false, opening); }, mark});
    };
    stage(ends.first, "close", false, "closed");
    stage(ends.second, "hold", false, "held");
    stage(path.back().at, "open", true, nullptr);
  }

  // When the gap is first that of the mat's wood.
  double first_contact(const std::vector<Point>& position) const {
    const double h = size_.solid_thickness;
    const auto at = std::find_if(position.begin(), position.end(), [h](const Point& p) { return p.value <= h; });
    if (at == position.end() || at->value <= size_.full_thickness) {
      const auto least = std::min_element(position.begin(), position.end(),
                                          [](const Point& a, const Point& b) { return a.value < b.value; });
      throw InputError(fmt::format(
          "the log's smallest gap is {:.4g} mm; this mat is {:.4g} mm of wood, {:.4g} mm of cell walls alone",
          1e3 * least->value, 1e3 * h, 1e3 * size_.full_thickness));
    }
    if (at == position.begin()) return at->at;
    const auto before = at - 1;
    return before->at + (at->at - before->at) * (before->value - h) / (before->value - at->value);
  }
  static double first_pressure(const std::vector<Point>& pressure) {
    const auto at = std::find_if(pressure.begin(), pressure.end(), [](const Point& p) { return p.value > 0; });
    if (at == pressure.end()) throw InputError("the log's pressure is nowhere greater than 0");
    return at == pressure.begin() ? at->at : (at - 1)->at;
  }
  // The smallest gap within 1 %, first and last; of a log of pressure: its largest, and where it last is a tenth of it.
  static std::pair<double, double> ends_of_hold(const std::vector<Point>& path, bool by_position) {
    const auto by_value = [](const Point& a, const Point& b) { return a.value < b.value; };
    const auto extreme = by_position ? std::min_element(path.begin(), path.end(), by_value)
                                     : std::max_element(path.begin(), path.end(), by_value);
    const auto closed = [&](const Point& p) {
      return by_position ? p.value <= 1.01 * extreme->value : p.value >= extreme->value;
    };
    const auto held = [&](const Point& p) { return by_position ? closed(p) : p.value >= .1 * extreme->value; };
    return {std::find_if(path.begin(), path.end(), closed)->at, std::find_if(path.rbegin(), path.rend(), held)->at};
  }

  // ---- what to be told ----
  void warn_of_extremes() {
    const auto hottest = [](const std::vector<Point>& points) {
      double most = points.front().value;
      for (const auto& p : points) most = std::max(most, p.value);
      return most;
    };
    const double platens = std::max(hottest(s_.platen_top), hottest(s_.platen_bottom));
    if (platens > kHottest)
      out_.warnings.push_back(
          fmt::format("platens of {:g} C: above {:g} C sorption is extrapolated too far", platens, kHottest));
    double wettest = 0, densest = 0;
    bool full = false;
    const auto& k = s_.constants;
    for (const auto& at : out_.record) {
      for (const auto& cell : at.all()) {
        wettest = std::max(wettest, cell.M);
        densest = std::max(densest, cell.density);
        full = full || transfer::porosity(k, cell.density, cell.M) <= k.porosity_floor;
      }
    }
    if (wettest > kWettest) {
      out_.warnings.push_back(
          fmt::format("moisture content reaches {:.3g}: above {:g} sorption is extrapolated", wettest, kWettest));
    }
    if (full) out_.warnings.push_back("a layer has hardly any pores left: its gas space is held at 5 % of its volume");
    if (transfer::permeability(k, densest) < kTightest) {
      out_.warnings.push_back(
          fmt::format("the densest layer ({:.0f} kg/m3) has a permeability of {:.2g} m2: below {:g} m2 "
                      "the formula is a guess",
                      densest, transfer::permeability(k, densest), kTightest));
    }
  }

  // ---- its state ----
  std::vector<double> state_now() {
    Numbers numbers;
    visit(numbers);
    return numbers.list();
  }
  void visit(Numbers& numbers) {
    solver_.visit(numbers);
    mechanics_.visit(numbers);
    numbers(thickness_);
    numbers(cure_face_);
    numbers(cure_core_);
    numbers(stage_);
    numbers(begin_.time);
    numbers(begin_.height);
    numbers(begin_.pressure);
    numbers(closing_);
    numbers(limited_);
    numbers(stopped_);
    numbers.each(out_.record, [&](Instant& at) { visit_instant(numbers, at); });
  }
  static void visit_word(Numbers& numbers, std::string& word, std::span<const char* const> words) {
    auto index = std::find(words.begin(), words.end(), word) - words.begin();
    numbers(index);
    if (!numbers.reads()) return;
    if (index < 0 || index >= std::ssize(words)) throw InputError("a stored cycle names no phase of a press");
    word = words[static_cast<std::size_t>(index)];
  }
  void visit_instant(Numbers& numbers, Instant& at) const {
    static constexpr std::array kPhases{"lead", "close", "hold", "vent", "open"};
    static constexpr std::array kMarks{"", "closed", "held", "opened"};
    visit_word(numbers, at.phase, kPhases);
    visit_word(numbers, at.mark, kMarks);
    for (auto* number : {&at.time, &at.thickness, &at.gap, &at.pressure, &at.stress, &at.platen_top, &at.platen_bottom,
                         &at.gas_mean, &at.heat, &at.water_out})
      numbers(*number);
    for (auto* cells : {&at.cells, &at.section}) {
      if (cells == &at.section && s_.columns == 1) continue;
      numbers.each(*cells, [&numbers](CellReading& cell) {
        for (auto* number : {&cell.depth, &cell.T, &cell.M, &cell.gas, &cell.density, &cell.cure_face, &cell.cure_core})
          numbers(*number);
        numbers(cell.face);
      });
    }
  }

  struct Stage {
    std::function<void()> follow;
    const char* mark;  // at its end
  };

  Settings s_;
  MatSize size_;
  std::vector<MatLayer> layers_;
  double length_;  // m
  MatMechanics& mechanics_;
  Watch watch_;
  std::vector<double> thickness_;
  transfer::Solver solver_;
  std::vector<double> cure_face_, cure_core_;
  std::vector<Stage> stages_;
  std::size_t stage_ = 0;
  bool within_stage_ = false;  // going on in the middle of one
  struct {
    double time = 0, height = 0, pressure = 0;
  } begin_;                                 // of the stage
  double start_ = 0;                        // s, of the solver's clock since first contact
  double closing_ = 0;                      // m/s, in the last step
  bool limited_ = false, stopped_ = false;  // a pressure that was not held: closing too fast, or at its stop
  Cycle out_;
};

}  // namespace

const char* name(Mechanics mechanics) {
  switch (mechanics) {
    case Mechanics::kColumn:
      return "column";
    case Mechanics::kUniform:
      return "uniform";
    case Mechanics::kStrands:
      break;
  }
  return "strands";
}

MatSize size_of(const PressedMat& mat) {
  MatSize size;
  size.thickness = mat.thickness;
  for (const auto& layer : mat.layers) {
    size.dry_mass += layer.dry_mass;
    size.solid_thickness += layer.dry_mass / layer.material.density_kg_m3;
  }
  size.full_thickness = size.dry_mass / transfer::Constants{}.cell_wall_density;
  return size;
}

Cycle press_hot(const Settings& settings, const PressedMat& mat, const Watch& watch) {
  const auto mechanics = mechanics_of(settings, mat);
  return press_hot(settings, mat, *mechanics, watch, {});
}

double duration(const Settings& settings) {
  if (settings.log) {
    const auto& points = settings.log->position.empty() ? settings.log->pressure : settings.log->position;
    return points.back().at - points.front().at;
  }
  double end = 0;
  for (const auto& phase : settings.schedule) end = phase.until ? *phase.until : end + phase.seconds.value_or(0);
  return end;
}

Cycle press_hot(const Settings& settings, const PressedMat& mat, MatMechanics& mechanics, const Watch& watch,
                const std::vector<double>& resume) {
  Press press(settings, mat, mechanics, watch);
  if (!resume.empty()) press.resume(resume);
  return press.run();
}

}  // namespace strandlab::hotpress
