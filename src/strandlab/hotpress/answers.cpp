#include "strandlab/hotpress/answers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace strandlab::hotpress {
namespace {

constexpr double kFlat = .1;         // K/s
constexpr double kLeastBond = .05;   // of the strength fully cured: below it there is no bond
constexpr double kMuchPrecure = .5;  // of the face layers: the outermost ones gel while any press closes

using Records = std::vector<Instant>;

const CellReading& core(const Instant& i) {
  return i.cells[i.cells.size() / 2];
}

// When a quantity first reaches a value, straight between steps.
template <class Of>
std::optional<double> first_time(const Records& record, double value, Of of) {
  for (std::size_t i = 0; i < record.size(); ++i) {
    const double after = of(record[i]);
    if (!(after >= value)) continue;
    if (i == 0) return record[0].time;
    const double before = of(record[i - 1]), t0 = record[i - 1].time;
    return t0 + (record[i].time - t0) * (value - before) / (after - before);
  }
  return std::nullopt;
}

// The instant at which the press begins to open: the end of the last hold or closing.
const Instant& before_opening(const Records& record) {
  const Instant* last = nullptr;
  for (const auto& i : record) {
    if (i.mark == "held" || i.mark == "closed") last = &i;
  }
  return last == nullptr ? record.back() : *last;
}

template <class Cure>
double least(const Instant& i, bool all, bool face, Cure cure) {
  double value = 1;
  for (const auto& cell : i.cells)
    if (all || cell.face == face) value = std::min(value, cure(cell));
  return value;
}

ResinAnswer resin_answer(const Records& record, const Instant& opening, bool face, const transfer::Resin& resin) {
  const auto cure = [face](const CellReading& cell) { return face ? cell.cure_face : cell.cure_core; };
  ResinAnswer answer{resin.name, face ? "face" : "core", {}, {}, least(opening, false, face, cure)};
  answer.cured_at = first_time(record, kCured, [&](const Instant& i) { return least(i, false, face, cure); });
  answer.all_cured_at = first_time(record, kCured, [&](const Instant& i) { return least(i, true, face, cure); });
  return answer;
}

// After 100 C, from where the core rises by less than kFlat on.
void find_plateau(const Records& record, double opening, Answers& a) {
  if (!a.core_100C) return;
  double length = 0, integral = 0;
  for (std::size_t i = 1; i < record.size() && record[i].time <= opening + 1e-9; ++i) {
    const double dt = record[i].time - record[i - 1].time, T0 = core(record[i - 1]).T, T1 = core(record[i]).T;
    if (record[i - 1].time < *a.core_100C) continue;
    if ((T1 - T0) / dt >= kFlat) {
      if (a.plateau_start) break;
      continue;
    }
    if (!a.plateau_start) a.plateau_start = record[i - 1].time;
    length += dt;
    integral += dt * .5 * (T0 + T1);
  }
  if (!a.plateau_start) return;
  a.plateau_length = length;
  a.plateau_mean = integral / length;
}

DensityAnswer density_of(const Instant& i, const MatSize& mat) {
  DensityAnswer d;
  d.mean = mat.dry_mass / i.thickness;
  for (const auto& cell : i.cells) {
    if (cell.density <= d.peak) continue;
    d.peak = cell.density;
    d.peak_depth = std::min(cell.depth, i.thickness - cell.depth);
  }
  d.skin = .5 * (i.cells.front().density + i.cells.back().density);
  d.core = core(i).density;
  return d;
}

double blow_of(const Instant& i, const Settings& s) {
  double worst = 0;
  for (const auto& cell : i.all()) {
    const auto& resin = cell.face ? s.resin_face : s.resin_core;
    const double bond = std::max(kLeastBond, transfer::bond_strength(resin, cell.cure()));
    worst = std::max(worst, cell.gas / (s.bond_strength * bond));
  }
  return worst;
}

// Part of the face layers whose resin has gelled when the press has last closed.
double precured_part(const Records& record, const transfer::Resin& resin) {
  const auto closed = std::find_if(record.rbegin(), record.rend(), [](const Instant& i) { return i.mark == "closed"; });
  if (closed == record.rend()) return 0;
  double faces = 0, gelled = 0;
  for (const auto& cell : closed->cells) {
    if (!cell.face) continue;
    ++faces;
    if (cell.cure_face > resin.gel) ++gelled;
  }
  return faces > 0 ? gelled / faces : 0;
}

}  // namespace

Answers answers(const Cycle& cycle) {
  const auto& record = cycle.record;
  if (record.empty()) throw std::invalid_argument("a press cycle without a step has no answers");
  const auto& s = cycle.settings;
  const auto& end = before_opening(record);
  Answers a;
  a.opening = end.time;
  a.core_100C = first_time(record, 100, [](const Instant& i) { return core(i).T; });
  find_plateau(record, a.opening, a);
  a.pressure_peak = a.stress_peak = s.mechanics == Mechanics::kUniform ? NAN : 0;
  for (const auto& i : record) {
    if (core(i).gas > a.gas_peak) {
      a.gas_peak = core(i).gas;
      a.gas_peak_time = i.time;
    }
    if (i.pressure > a.pressure_peak) {
      a.pressure_peak = i.pressure;
      a.pressure_peak_time = i.time;
    }
    if (i.stress > a.stress_peak) a.stress_peak = i.stress;
    if (i.time >= a.opening - 1e-9) a.blow = std::max(a.blow, blow_of(i, s));
  }
  for (const auto& cell : end.all()) a.gas_at_opening = std::max(a.gas_at_opening, cell.gas);
  a.press_time = record.front().time;
  for (const bool face : {true, false}) {
    const auto carries = [face](const CellReading& cell) { return cell.face == face; };
    if (std::none_of(end.cells.begin(), end.cells.end(), carries)) continue;
    a.resins.push_back(resin_answer(record, end, face, face ? s.resin_face : s.resin_core));
    const auto& cured_at = a.resins.back().cured_at;
    a.press_time = a.press_time && cured_at ? std::optional(std::max(*a.press_time, *cured_at)) : std::nullopt;
  }
  a.thickness_closed = end.thickness;
  a.thickness_opened = record.back().mark == "opened" ? record.back().thickness : cycle.thickness_unloaded;
  if (a.press_time) a.press_factor = *a.press_time / a.thickness_closed;
  a.density = density_of(end, cycle.mat);
  a.M_face = .5 * (end.cells.front().M + end.cells.back().M);
  a.M_core = core(end).M;
  for (const auto& cell : end.cells) a.M_mean += cell.M / static_cast<double>(end.cells.size());
  a.precured = precured_part(record, s.resin_face);
  a.heat = end.heat;
  a.water_out = end.water_out;
  return a;
}

namespace {

Settings with_permeability(Settings s, double factor) {
  s.constants.permeability_400 *= factor;
  s.constants.permeability_floor *= factor;
  for (auto& point : s.constants.permeabilities) point.permeability *= factor;
  return s;
}

// The mat of a cycle that is there, its thicknesses and stresses step by step.
class Replay final : public MatMechanics {
 public:
  explicit Replay(const Cycle& cycle) : cycle_(cycle) {}
  void condition(const std::vector<transfer::CellState>& /*state*/) override {}
  Moved move(const Move& /*move*/, const std::vector<transfer::CellState>& /*state*/, double /*seconds*/) override {
    moves_ = std::min(moves_ + 1, cycle_.record.size());
    const auto& now = this->now();
    const bool closes = now.phase == "close", ends = !now.mark.empty();
    return {now.phase != "open" || now.pressure > 0, closes && !ends, closes && ends};
  }
  std::vector<double> thickness() const override {
    std::vector<double> all;
    const auto& cells = now().all();
    all.reserve(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) all.push_back(cycle_.dry_mass[i] / cells[i].density);
    return all;
  }
  std::vector<double> dry_mass(double /*of_mat*/, int /*cells*/) const override { return cycle_.dry_mass; }
  double stress() const override { return now().stress; }
  double height_unloaded() const override { return cycle_.thickness_unloaded; }
  double longest_step(double /*closing*/) const override {
    const auto next = std::min(moves_, cycle_.record.size() - 1);
    const double time = cycle_.record[next].time - (next == 0 ? 0 : cycle_.record[next - 1].time);
    return time > 0 ? time : MatMechanics::longest_step(0);
  }
  void visit(Numbers& numbers) override { numbers(moves_); }

 private:
  // After the last move; before the first one the mat is as after it.
  const Instant& now() const { return cycle_.record[moves_ == 0 ? 0 : moves_ - 1]; }

  const Cycle& cycle_;
  std::size_t moves_ = 0;
};

}  // namespace

Band press_in_band(const Settings& settings, const PressedMat& mat, const Told& told) {
  int number = 0;
  const auto pressed = [&](const Settings& s) {
    const Watch watch{[&](const Instant& now, const auto& /*state*/) {
                        if (told) told(number, now);
                      },
                      nullptr};
    auto cycle = press_hot(s, mat, watch);
    ++number;
    return cycle;
  };
  auto cycle = pressed(settings);
  const auto own = answers(cycle), permeable = answers(pressed(with_permeability(settings, 3)));
  const auto tight = answers(pressed(with_permeability(settings, 1. / 3)));
  return {std::move(cycle), own, permeable, tight};
}

Band in_band(Cycle cycle, const PressedMat& mat) {
  const auto with = [&](double factor) {
    Replay replay(cycle);
    return answers(press_hot(with_permeability(cycle.settings, factor), mat, replay, {}));
  };
  const auto own = answers(cycle), permeable = with(3), tight = with(1. / 3);
  return {std::move(cycle), own, permeable, tight};
}

const char* risk(double blow) {
  if (blow < .5) return "low";
  return blow <= 1 ? "watch" : "blow likely";
}

std::vector<std::string> remarks(const Cycle& cycle, const Answers& a) {
  std::vector<std::string> list;
  for (const auto& r : a.resins) {
    if (r.least_cure >= kCured) continue;
    list.push_back(
        fmt::format("{} in the {} layers is cured to {:.2f} only (in the least cured layer) when the press opens "
                    "at {:g} s; {}",
                    r.resin, r.layers, r.least_cure, a.opening,
                    r.cured_at ? "hold longer" : "hold longer, or press hotter or drier"));
  }
  if (a.gas_at_opening > kRiskyGas) {
    list.push_back(
        fmt::format("gas pressure of {:.0f} kPa when the press opens: MDF delaminated above {:.0f} kPa (Cai, Muehl "
                    "& Winandy)",
                    1e-3 * a.gas_at_opening, 1e-3 * kRiskyGas));
  }
  if (a.precured > kMuchPrecure) {
    list.push_back(
        fmt::format("precure: {} has gelled in {:.0f} % of the face layers before the press has closed; close "
                    "faster, or expect weak faces",
                    cycle.settings.resin_face.name, 100 * a.precured));
  }
  return list;
}

}  // namespace strandlab::hotpress
