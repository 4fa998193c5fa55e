#include "strandlab/hotpress/cycle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "strandlab/core/error.hpp"

namespace strandlab::hotpress {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr double kFineStep = .05, kFineFor = 2;   // s, after the press begins to open: pressure is gone within a second
constexpr double kOpenStep = .25;                 // s, after that
constexpr double kHottest = 220, kWettest = .25;  // C and kg/kg, up to where the isotherm was measured or is trusted
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
  const auto mat = size_of(pressed);
  refuse(!(mat.dry_mass > 0), "the mat has no mass to press");
  refuse(s.cells < 2 || s.cells > 1000, fmt::format("{} cells through the mat; there must be from 2 to 1000", s.cells));
  refuse(!(s.step > 0), fmt::format("a time step of {} s; it must be greater than 0", s.step));
  if (s.log) return mat;
  check_targets(s.schedule, mat);
  if (s.mechanics == Mechanics::kColumn) return mat;
  for (const auto& phase : s.schedule)
    refuse(phase.pressure.has_value(),
           fmt::format("phase \"{}\": pressure needs mechanics = \"column\"; a uniform mat has none", phase.text));
  return mat;
}

// Where the press shall go in a step: to a height (m), or under a pressure (Pa) that may not close it below a stop.
struct Move {
  bool by_pressure = false;
  double height = 0, pressure = 0, stop = 0;
};

enum class Faces { kPlatens, kBottomPlaten, kOpen };

class Press {
 public:
  Press(const Settings& settings, const PressedMat& mat)
      : s_(settings),
        size_(checked_size(settings, mat)),
        wood_(cut(mat, size_.dry_mass, settings.cells)),
        column_(layers(), settings.rate),
        solver_(make_solver()) {
    out_.settings = s_;
    out_.mat = size_;
    cure_face_.assign(wood_.size(), 0);
    cure_core_.assign(wood_.size(), 0);
    const auto [e, g] = factors();
    column_.condition(e, g);
  }

  Cycle run() {
    if (s_.log) {
      follow_log();
    } else {
      preheat();
      for (const auto& phase : s_.schedule) follow(phase);
    }
    if (!out_.record.empty() && out_.record.back().mark.empty()) mark("opened");
    out_.thickness_unloaded = s_.mechanics == Mechanics::kColumn ? column_.height_unloaded() : height();
    const auto drift = solver_.drift();
    for (int row = 0; row < 3; ++row)
      out_.worst_balance[row] = std::max(solver_.worst_balance_error()[row], std::abs(drift[row]));
    warn_of_extremes();
    return std::move(out_);
  }

 private:
  // ---- the mat ----
  std::vector<Layer> layers() const {
    std::vector<Layer> all;
    for (const auto& cell : wood_) all.push_back(layer_of(*cell.material, cell.thickness));
    return all;
  }
  double mass_fraction(std::size_t cell) const { return (static_cast<double>(cell) + .5) / s_.cells; }
  bool is_face(std::size_t cell) const {
    const double at = mass_fraction(cell);
    return std::min(at, 1 - at) < s_.face_fraction;
  }
  // Of the cell's mass the part that lies in the faces has their moisture.
  double moisture(std::size_t cell) const {
    const double low = static_cast<double>(cell) / s_.cells, high = low + 1. / s_.cells;
    const double core = std::max(0., std::min(high, 1 - s_.face_fraction) - std::max(low, s_.face_fraction)) * s_.cells;
    return s_.moisture_face + std::clamp(core, 0., 1.) * (s_.moisture_core - s_.moisture_face);
  }
  transfer::Solver make_solver() {
    const auto& k = s_.constants;
    transfer::Grid grid;
    grid.rows = s_.cells;
    grid.dry_mass.assign(wood_.size(), size_.dry_mass / s_.cells);
    std::vector<transfer::CellState> state;
    for (std::size_t i = 0; i < wood_.size(); ++i) {
      const double T = k.ambient_temperature, M = moisture(i);
      const double vapour = transfer::relative_pressure(k, T, M) * transfer::saturation_pressure(T);
      state.push_back({T, M, k.ambient_pressure - vapour});
    }
    thickness_ = s_.mechanics == Mechanics::kColumn ? column_.thickness() : uniform(size_.solid_thickness);
    transfer::Conditions start;
    start.thickness = thickness_;
    return {k, grid, state, start};
  }
  std::vector<double> uniform(double height) const {
    return std::vector<double>(wood_.size(), height / static_cast<double>(wood_.size()));
  }
  double height() const {
    double sum = 0;
    for (const double t : thickness_) sum += t;
    return sum;
  }
  double gas(int cell) const { return solver_.cell(cell).p - s_.constants.ambient_pressure; }
  double gas_mean() const {
    double sum = 0;
    for (int i = 0; i < s_.cells; ++i) sum += thickness_[i] * gas(i);
    return sum / height();
  }
  std::pair<std::vector<double>, std::vector<double>> factors() const {
    std::vector<double> e, g;
    for (const auto& cell : solver_.state()) {
      e.push_back(stiffness_factor(s_.softening, cell.T, cell.M));
      g.push_back(yield_factor(s_.softening, cell.T, cell.M));
    }
    return {e, g};
  }

  // ---- one step ----
  double step_at(double since_opening) const {
    const double t = now();
    const double base = t < 30 ? s_.step : t < 90 ? 2 * s_.step : 4 * s_.step;
    if (since_opening < 0) return base;
    return std::min(base, since_opening < kFineFor - 1e-9 ? kFineStep : kOpenStep);
  }
  double now() const { return start_ + solver_.time(); }

  // Moves the column; the platens push and never pull. Returns whether they touch the mat.
  bool move_column(const Move& move, double seconds) {
    const auto [e, g] = factors();
    column_.soften(e, g);
    const double gas_pressure = gas_mean();
    const auto before = column_;
    if (move.by_pressure) {
      column_.load(move.pressure - gas_pressure, seconds);
      const double least = std::max(move.stop, before.height() - s_.fastest * seconds);
      limited_ = column_.height() < least;
      stopped_ = limited_ && least == move.stop;
      if (limited_) {
        column_ = before;
        column_.press_to(least, seconds);
      }
      return true;
    }
    limited_ = stopped_ = false;
    column_.load(-gas_pressure, seconds);
    if (column_.height() <= move.height) return false;
    column_ = before;
    column_.press_to(move.height, seconds);
    return true;
  }

  transfer::Conditions conditions(double time, double begin, double end, const std::vector<double>& before,
                                  const std::vector<double>& after, Faces faces) const {
    transfer::Conditions c;
    const double part = (time - begin) / (end - begin);
    for (std::size_t i = 0; i < after.size(); ++i) c.thickness.push_back(before[i] + part * (after[i] - before[i]));
    const auto room = transfer::open_to(s_.constants, s_.room);
    const double t = start_ + time;
    c.bottom = faces == Faces::kOpen ? room : transfer::platen(interpolated(s_.platen_bottom, t), s_.contact);
    c.top = faces == Faces::kPlatens ? transfer::platen(interpolated(s_.platen_top, t), s_.contact) : room;
    return c;
  }

  void cure(const std::vector<transfer::CellState>& before, double seconds) {
    for (std::size_t i = 0; i < wood_.size(); ++i) {
      const double T = .5 * (before[i].T + solver_.state()[i].T);
      cure_face_[i] = transfer::cured(s_.resin_face, cure_face_[i], T, seconds);
      cure_core_[i] = transfer::cured(s_.resin_core, cure_core_[i], T, seconds);
    }
  }

  // Mechanics with the temperatures at the start of the step, then heat and moisture, then cure.
  void step(double seconds, const Move& move, Faces faces, const std::string& phase) {
    const auto before = thickness_;
    if (s_.mechanics == Mechanics::kColumn) {
      if (faces != Faces::kBottomPlaten && !move_column(move, seconds)) faces = Faces::kOpen;
      thickness_ = column_.thickness();
    } else if (!move.by_pressure) {
      thickness_ = uniform(move.height);
    }
    const auto state = solver_.state();
    const double begin = solver_.time(), end = begin + seconds;
    const auto after = thickness_;
    solver_.step(seconds, [&](double t) { return conditions(t, begin, end, before, after, faces); });
    cure(state, seconds);
    record(move, faces, phase);
  }

  void record(const Move& move, Faces faces, const std::string& phase) {
    Instant at;
    at.time = now();
    at.phase = phase;
    at.thickness = height();
    at.gap = faces == Faces::kOpen && !move.by_pressure ? move.height : at.thickness;
    at.gas_mean = gas_mean();
    const bool column = s_.mechanics == Mechanics::kColumn;
    at.stress = column ? column_.stress() : kNothing;
    at.pressure = at.stress + at.gas_mean;
    if (column && move.by_pressure && !limited_) at.pressure = move.pressure;
    if (column && faces == Faces::kOpen) at.pressure = 0;
    at.platen_top = interpolated(s_.platen_top, at.time);
    at.platen_bottom = interpolated(s_.platen_bottom, at.time);
    at.heat = solver_.received()[transfer::kEnergy];
    at.water_out = -solver_.received()[transfer::kWater];
    double depth = at.thickness;
    for (int i = 0; i < s_.cells; ++i) {
      const auto& state = solver_.state()[i];
      depth -= thickness_[i];
      at.cells.push_back({depth + .5 * thickness_[i], state.T, state.M, gas(i),
                          solver_.grid().dry_mass[i] / thickness_[i], cure_face_[i], cure_core_[i],
                          is_face(static_cast<std::size_t>(i))});
    }
    out_.record.push_back(std::move(at));
  }

  // ---- phases ----
  // Steps up to a time (since first contact), or until a stop is reached where that ends the phase.
  void march(double to, const std::string& phase, Faces faces, const std::function<Move(double)>& move,
             bool ends_at_stop, bool opening) {
    const double begin = now();
    stopped_ = false;
    while (now() < to - 1e-9 && !(ends_at_stop && stopped_)) {
      double seconds = step_at(opening ? now() - begin : -1);
      if (now() + seconds > to - 1e-6 * seconds) seconds = to - now();
      step(seconds, move(now() + seconds), faces, phase);
    }
  }
  void mark(const char* what) {
    if (!out_.record.empty()) out_.record.back().mark = what;
  }
  double pressure_now() const { return out_.record.empty() ? 0 : out_.record.back().pressure; }

  // The bottom platen is hot and under the mat before the press closes; the top is open to the room.
  void preheat() {
    if (!(s_.bottom_lead > 0)) return;
    start_ = -s_.bottom_lead;
    const double h = height();
    march(
        0, "lead", Faces::kBottomPlaten,
        [h](double) {
          return Move{false, h};
        },
        false, false);
  }

  void follow(const Phase& phase) {
    using Kind = Phase::Kind;
    if (phase.kind == Kind::kClose) return close(phase);
    const double begin = now(), end = phase.until ? *phase.until : begin + *phase.seconds;
    if (!(end > begin)) {
      throw InputError(
          fmt::format("phase \"{}\": phases overlap: it ends at {:g} s, but the one before it took until {:g} s",
                      phase.text, end, begin));
    }
    const double height_now = height();
    if (phase.kind == Kind::kHold) {
      const double stop = phase.target ? thickness_of(*phase.target, size_) : 0;
      const double pressure = phase.pressure.value_or(0);
      march(
          end, "hold", Faces::kPlatens,
          [&](double) {
            return Move{phase.pressure.has_value(), height_now, pressure, stop};
          },
          false, false);
      return mark("held");
    }
    if (s_.mechanics == Mechanics::kUniform) {
      const auto faces = phase.kind == Kind::kVent ? Faces::kPlatens : Faces::kOpen;
      return march(
          end, phase.kind == Kind::kVent ? "vent" : "open", faces,
          [&](double) {
            return Move{false, height_now};
          },
          false, true);
    }
    if (phase.kind == Kind::kOpen)
      return march(
          end, "open", Faces::kOpen, [](double) { return Move{true}; }, false, true);
    const double from = pressure_now();
    march(
        end, "vent", Faces::kPlatens,
        [&](double t) {
          return Move{true, 0, from * std::max(0., (end - t) / (end - begin))};
        },
        false, true);
  }

  void close(const Phase& phase) {
    const double begin = now(), from = height(), to = thickness_of(*phase.target, size_);
    const double end = phase.until     ? *phase.until
                       : phase.seconds ? begin + *phase.seconds
                                       : begin + std::abs(from - to) / *phase.speed;
    if (phase.pressure) {
      march(
          end, "close", Faces::kPlatens,
          [&](double) {
            return Move{true, 0, *phase.pressure, to};
          },
          true, false);
      if (!stopped_) {
        out_.warnings.push_back(fmt::format(
            "phase \"{}\": never reached its target: {:.4g} mm at {:g} s, not {:.4g} mm; more pressure, more time or a "
            "hotter, moister mat would close it",
            phase.text, 1e3 * height(), now(), 1e3 * to));
      }
    } else {
      march(
          end, "close", Faces::kPlatens,
          [&](double t) {
            return Move{false, from + (to - from) * (t - begin) / (end - begin)};
          },
          false, false);
    }
    mark("closed");
  }

  // ---- a log ----
  void follow_log() {
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
    const auto [closed, released] = ends_of_hold(path, by_position);
    const auto move = [&](double t) {
      return by_position ? Move{false, interpolated(path, t)} : Move{true, 0, std::max(0., interpolated(path, t))};
    };
    march(closed, "close", Faces::kPlatens, move, false, false);
    mark("closed");
    march(released, "hold", Faces::kPlatens, move, false, false);
    mark("held");
    march(path.back().at, "open", Faces::kPlatens, move, false, true);
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
      for (const auto& cell : at.cells) {
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

  Settings s_;
  MatSize size_;
  std::vector<CellWood> wood_;
  Column column_;
  std::vector<double> thickness_;
  transfer::Solver solver_;
  std::vector<double> cure_face_, cure_core_;
  double start_ = 0;                        // s, of the solver's clock since first contact
  bool limited_ = false, stopped_ = false;  // a pressure that was not held: closing too fast, or at its stop
  Cycle out_;
};

}  // namespace

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

Cycle press_hot(const Settings& settings, const PressedMat& mat) {
  return Press(settings, mat).run();
}

}  // namespace strandlab::hotpress
