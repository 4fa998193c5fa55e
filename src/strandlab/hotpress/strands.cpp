#include "strandlab/hotpress/strands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <numeric>

#include "strandlab/core/error.hpp"
#include "strandlab/profile/profile.hpp"

namespace strandlab::hotpress {
namespace {

constexpr double kMPa = 1e6;             // Pa
constexpr double kMm = 1e-3;             // m
constexpr int kBinsPerCell = 10;         // of the profile that tells which mass lies below a point
constexpr int kRampStages = 8;           // in which factors go from old to new
constexpr double kSpeedUp = .05;         // of the way in which the platens gain their speed
constexpr double kSlowDown = .05;        // and lose it: a sudden stop sends a wave through the mat
constexpr double kSlowest = .005;        // of the speed
constexpr double kLongestClosing = .01;  // of the gap in one exchange
constexpr double kSettling = 2;          // transits of a wave through the mat, in which a mat settles. Judgement
constexpr double kDamping = .6;          // of the thickness mode's angular frequency; of critical damping .3
constexpr int kDampedSteps = 4;          // steps between dampings
constexpr double kRead = .5;             // part of the settling, its end, from which forces are read
// Control of pressure: the time in transits in which it aims to be there, and the modulus that it expects of the mat,
// MPa: what it last felt while closing within bounds, the upper one while opening.
constexpr double kServoTransits = 1.5, kSoftest = 20;
constexpr double kReached = .02;      // of the pressure wanted: near enough. Judgement
constexpr double kLeastRest = .1;     // of an exchange's time, in which it is held: yield would feel it pass too fast
constexpr double kTouches = .01;      // of the stress last held: what an open press no longer feels
constexpr double kFiltered = .3;      // transits over which the pressure that it sees is averaged
constexpr double kServoSpeed = .25;   // of the platens' speed, at most, under control of pressure
constexpr double kDuePressure = .2;   // of the stress held: its change for which the mat is settled anew
constexpr double kMuchPrecure = .05;  // strength lost, of which a warning tells. Judgement
constexpr double kMuchMoved = .01;    // of a column's mass, of which a warning tells. Judgement
constexpr double kJudged = .5;        // of the largest stress: from where the mat bears it a pressing is judged

double change(const std::vector<double>& before, const std::vector<double>& now) {
  double largest = 0;
  for (std::size_t i = 0; i < now.size(); ++i) largest = std::max(largest, std::abs(std::log(now[i] / before[i])));
  return largest;
}

}  // namespace

StrandMechanics::StrandMechanics(const Panel<2>& mat, const StrandPress& how) : how_(how), panel_(mat) {
  for (const auto& strand : panel_.strands) {
    if (strand.stiffness_factor == 1) continue;
    throw InputError(
        fmt::format("strands of kind {} are softened already (stiffness_factor = {}); a hot press softens "
                    "them by heat and moisture: leave it at 1",
                    strand.kind, strand.stiffness_factor));
  }
  read();
}

StrandMechanics::StrandMechanics(const press::Checkpoint<2>& checkpoint, const StrandPress& how)
    : how_(how), panel_(checkpoint.panel), conditioned_(true), records_(checkpoint.records) {
  start();
  engine_->set_platens(checkpoint.engine.bottom, checkpoint.engine.top);
  engine_->resume(checkpoint.engine);
  read();
}

void StrandMechanics::start() {
  std::vector<mpm::Body<2>> bodies;
  for (const auto& strand : panel_.strands) bodies.push_back(mpm::body_of(strand));
  engine_.emplace(bodies, how_.setup.grid, how_.setup.engine);
  engine_->set_platens({panel_.bottom_mm, 0}, {panel_.top_mm, 0});
}

void StrandMechanics::condition(const std::vector<transfer::CellState>& state) {
  if (conditioned_) return;
  conditioned_ = true;
  from_ = to_ = factors_of_points(state);
  for (std::size_t s = 0; s < panel_.strands.size(); ++s) {
    panel_.strands[s].points.stiffness_factor = to_.stiffness[s];
    panel_.strands[s].points.yield_factor = to_.yield[s];
  }
  start();
}

double StrandMechanics::gap() const {
  return engine_ ? engine_->state().top.position - engine_->state().bottom.position : panel_.thickness_mm();
}

double StrandMechanics::height_unloaded() const {
  return kMm * gap();
}

// Of the softest wood there may be, so that settling is never too short.
double StrandMechanics::transit() const {
  double slowest = 0;
  for (const auto& strand : panel_.strands)
    slowest = std::max(slowest, std::sqrt(strand.material.density / strand.material.stiffness(2, 2)));
  double solid = 0;  // mm of wood
  for (const auto& strand : panel_.strands)
    solid += strand.lattice.point_volume() * static_cast<double>(strand.size()) / panel_.length_mm;
  return slowest * solid / std::sqrt(how_.softening.floor);
}

double StrandMechanics::longest_step(double closing) const {
  return closing > 0 ? kLongestClosing * kMm * gap() / closing : MatMechanics::longest_step(closing);
}

// The panel as the engine has it, and the heights between which each cell's mass lies.
void StrandMechanics::read() {
  if (engine_) engine_->write(panel_);
  const int bins = kBinsPerCell * how_.cells;
  const auto profiles = profile::density_profiles(panel_, bins, how_.columns);
  thickness_.assign(static_cast<std::size_t>(how_.cells) * profiles.size(), 0);
  std::vector<double> masses;
  for (std::size_t column = 0; column < profiles.size(); ++column) {
    const auto& profile = profiles[column];
    double total = 0;
    for (const double density : profile.density_kg_m3) total += density;
    masses.push_back(total);
    double* const thickness = &thickness_[column * static_cast<std::size_t>(how_.cells)];
    double below = 0, from = 0;
    int cell = 1;
    for (int k = 0; k < bins; ++k) {
      const double here = profile.density_kg_m3[static_cast<std::size_t>(k)];
      while (cell < how_.cells && below + here >= total * cell / how_.cells) {
        const double to = k + (total * cell / how_.cells - below) / here;
        thickness[cell - 1] = kMm * profile.bin_height_mm() * (to - from);
        from = to;
        ++cell;
      }
      below += here;
    }
    thickness[how_.cells - 1] = kMm * profile.bin_height_mm() * (bins - from);
  }
  watch_columns(masses);
}

// How much of a column's mass has moved into another since the mat was formed.
void StrandMechanics::watch_columns(const std::vector<double>& masses) {
  const double mean = std::accumulate(masses.begin(), masses.end(), 0.) / static_cast<double>(masses.size());
  if (masses_.empty()) {
    for (std::size_t i = 0; i < masses.size(); ++i) {
      if (!(masses[i] > 0))
        throw InputError(fmt::format("column {} of {} along the mat has no wood in it: hotpress.columns must be less",
                                     i + 1, masses.size()));
      masses_.push_back(masses[i] / mean);
    }
  }
  for (std::size_t i = 0; i < masses.size(); ++i)
    moved_ = std::max(moved_, std::abs(masses[i] / mean / masses_[i] - 1));
}

std::vector<double> StrandMechanics::dry_mass(double of_mat, int cells) const {
  std::vector<double> all;
  for (const double mass : masses_) all.insert(all.end(), static_cast<std::size_t>(cells), mass * of_mat / cells);
  return all;
}

std::vector<StrandMechanics::Place> StrandMechanics::places() const {
  const auto rows = static_cast<std::ptrdiff_t>(how_.cells);
  std::vector<std::vector<double>> faces;  // of the cells, mm, by column
  for (auto first = thickness_.begin(); first != thickness_.end(); first += rows) {
    faces.push_back({panel_.bottom_mm});
    std::for_each(first, first + rows, [&](double t) { faces.back().push_back(faces.back().back() + t / kMm); });
  }
  const auto within = [&](std::size_t column, double height) {
    const auto& own = faces[column];
    const auto above = std::upper_bound(own.begin() + 1, own.end() - 1, height);
    const double part = (height - *(above - 1)) / (*above - *(above - 1));
    return static_cast<double>(above - own.begin() - 1) + std::clamp(part, 0., 1.);
  };
  const double width = panel_.length_mm / how_.columns;
  std::vector<Place> all;
  for (const auto& strand : panel_.strands) {
    for (const auto& x : strand.points.x) {
      const double at = std::clamp(x[0] / width - .5, 0., how_.columns - 1.);
      Place place;
      place.column = static_cast<std::size_t>(at);
      place.next = at - std::floor(at);
      place.here = within(place.column, x[1]);
      if (place.next > 0) place.there = within(place.column + 1, x[1]);
      all.push_back(place);
    }
  }
  return all;
}

// `of` a cell: between the middles of cells, constant beyond the outermost.
template <class Of>
double StrandMechanics::between_cells(const Place& place, const Of& of) const {
  const auto cells = static_cast<std::size_t>(how_.cells);
  const auto within = [&](std::size_t column, double height) {
    const double at = std::clamp(height - .5, 0., static_cast<double>(cells) - 1);
    const auto i = std::min(static_cast<std::size_t>(at), cells - 2);
    const double part = at - static_cast<double>(i);
    return (1 - part) * of(column * cells + i) + part * of(column * cells + i + 1);
  };
  const double here = within(place.column, place.here);
  return place.next > 0 ? (1 - place.next) * here + place.next * within(place.column + 1, place.there) : here;
}

StrandMechanics::Factors StrandMechanics::factors_of_points(const std::vector<transfer::CellState>& state) const {
  Factors factors;
  const auto place = places();
  std::size_t n = 0;
  for (const auto& strand : panel_.strands) {
    auto& e = factors.stiffness.emplace_back();
    auto& g = factors.yield.emplace_back();
    for (std::size_t p = 0; p < strand.size(); ++p, ++n) {
      const double T = between_cells(place[n], [&](std::size_t i) { return state[i].T; });
      const double M = between_cells(place[n], [&](std::size_t i) { return state[i].M; });
      e.push_back(stiffness_factor(how_.softening, T, M));
      g.push_back(yield_factor(how_.softening, T, M));
    }
  }
  return factors;
}

void StrandMechanics::soften(double part) {
  for (std::size_t s = 0; s < panel_.strands.size(); ++s) {
    auto e = from_.stiffness[s], g = from_.yield[s];
    for (std::size_t p = 0; p < e.size(); ++p) {
      e[p] += part * (to_.stiffness[s][p] - e[p]);
      g[p] += part * (to_.yield[s][p] - g[p]);
    }
    engine_->soften(static_cast<int>(s), e, g);
  }
}

bool StrandMechanics::due(const Move& move, const std::vector<transfer::CellState>& state) const {
  if (move.last || last_.stiffness.empty()) return true;
  if (move.by_pressure) {
    const bool closing = !at_stop_ && move.stop > 0;
    if (closing || std::abs(std::max(0., move.stress) - wanted_) > kDuePressure * held_) return true;
  } else if (kMm * gap() - move.height > 1e-9 * move.height || follows(move)) {
    return true;
  }
  const auto now = factors_of(how_.softening, state);
  return std::max(change(last_.stiffness, now.stiffness), change(last_.yield, now.yield)) > how_.due;
}

// Whether the platens, moved by position, go away from the mat; and whether it still follows them.
bool StrandMechanics::opens(const Move& move) const {
  return !move.by_pressure && move.height > kMm * gap() * (1 + 1e-9);
}
bool StrandMechanics::follows(const Move& move) const {
  return opens(move) && stress_ > kTouches * held_;
}

Moved StrandMechanics::move(const Move& move, const std::vector<transfer::CellState>& state, double seconds) {
  waiting_ += seconds;
  if (!due(move, state)) return {!opens(move) || follows(move), limited_, at_stop_};
  last_ = factors_of(how_.softening, state);
  from_ = {};
  for (const auto& strand : panel_.strands) {
    from_.stiffness.push_back(strand.points.stiffness_factor);
    from_.yield.push_back(strand.points.yield_factor);
  }
  to_ = factors_of_points(state);
  stage_ = 0;
  sum_s_ = sum_top_ = sum_bottom_ = 0;
  const double held = held_, gap_before = gap(), stress_before = stress_;
  if (move.by_pressure) {
    press(move, waiting_);
  } else if (kMm * gap() - move.height > 1e-9 * move.height) {
    close(move.height / kMm, move.final_height / kMm, waiting_);
    by_pressure_ = limited_ = at_stop_ = false;
  } else {
    settle(move, waiting_);
  }
  waiting_ = 0;
  read();
  record();
  if (move.by_pressure) judge(move, gap_before, stress_before);
  if (opens(move)) held_ = held;  // what it was before the press began to open
  return {!opens(move) || follows(move), limited_, at_stop_};
}

// Under a pressure: where the last exchange has not reached it the platens close first as if by position, at most as
// far as they may; then the servo holds it.
void StrandMechanics::press(const Move& move, double seconds) {
  const double from = gap();
  const double least =
      std::max({move.stop, kMm * from - move.fastest * seconds, (1 - kLongestClosing) * kMm * from}) / kMm;
  const double wanted = std::max(0., move.stress) / kMPa;
  double rest = seconds;
  if (limited_ && from > least && stress_ < kMPa * wanted) {
    close(least, move.stop / kMm, seconds, wanted);
    rest *= std::max(kLeastRest, (gap() - least) / (from - least));
    if (gap() <= least * (1 + 1e-9)) {
      wanted_ = kMPa * wanted;
      by_pressure_ = true;
      return;
    }
    sum_s_ = sum_top_ = sum_bottom_ = 0;
  }
  settle(move, rest, least);
}

// What came of it: the mat's modulus while it gave way, and whether the pressure was reached.
void StrandMechanics::judge(const Move& move, double gap_before, double stress_before) {
  const double strain = 1 - gap() / gap_before, more = (stress_ - stress_before) / kMPa;
  if (strain > .1 * kLongestClosing && more > 0) modulus_ = std::clamp(more / strain, kSoftest, kStiffest);
  at_stop_ = move.stop > 0 && gap() * kMm <= move.stop * (1 + 1e-9);
  limited_ = at_stop_ || stress_ < (1 - kReached) * wanted_;
}

void StrandMechanics::step(double closing_mm_s, double seconds_per_second) {
  if (how_.before_step) how_.before_step();
  engine_->set_rate_effect(how_.rate, seconds_per_second);
  if (how_.symmetric) {
    engine_->set_platen_velocities(.5 * closing_mm_s, -.5 * closing_mm_s);
  } else {
    engine_->set_platen_velocities(0, -closing_mm_s);
  }
  engine_->step();
}

// Part of an exchange that is done: the points' factors have come to the next over its first half.
void StrandMechanics::soften_by(double done) {
  const int reached = std::min(static_cast<int>(2 * kRampStages * done), kRampStages);
  if (reached <= stage_) return;
  stage_ = reached;
  soften(static_cast<double>(stage_) / kRampStages);
}

void StrandMechanics::feel(double seconds) {
  sum_s_ += seconds;
  sum_top_ += engine_->top_force() * seconds;
  sum_bottom_ += engine_->bottom_force() * seconds;
}

// The platens go on at their speed from one exchange to the next, and come to rest at the final gap; or before, where
// they feel a pressure (MPa).
void StrandMechanics::close(double to, double final_gap, double seconds, double pressure) {
  const double from = gap();
  const double full = how_.speed_m_s / kMm, way = panel_.initial_thickness_mm - final_gap;
  const double gain = full * full / (2 * kSpeedUp * way), loss = full * full / (2 * kSlowDown * way);
  const double wave = transit(), area = panel_.length_mm * panel_.depth_mm;
  const bool watches = pressure < std::numeric_limits<double>::infinity();
  while (gap() > to && !(watches && filtered_ >= pressure)) {
    const double dt = engine_->state().time_step_s;
    velocity_ = std::min(full, velocity_ + gain * dt);
    if (watches) velocity_ = std::min(velocity_, gap() * (pressure - filtered_) / (modulus_ * kServoTransits * wave));
    velocity_ = std::min(velocity_, std::sqrt(2 * loss * std::max(0., gap() - final_gap)));
    velocity_ = std::max(velocity_, kSlowest * full);
    if (to <= final_gap) velocity_ = std::min(velocity_, (gap() - to) / dt * (1 + 1e-12));
    step(velocity_, seconds * velocity_ / (from - to));
    feel(dt);
    if (watches) listen(dt, area, wave);
    soften_by((from - gap()) / (from - to));
  }
  if (gap() <= to) soften_by(1);
  if (to <= final_gap) velocity_ = 0;
}

// To what the platens feel now, and its mean over a part of a transit.
void StrandMechanics::listen(double dt, double area, double wave) {
  now_ = .5 * (engine_->top_force() + engine_->bottom_force()) / area;
  filtered_ += (now_ - filtered_) * std::min(1., dt / (kFiltered * wave));
}

// At rest, or under a pressure and no closer than the least gap (mm), until the mat is: damped.
void StrandMechanics::settle(const Move& move, double seconds, double least) {
  const double wave = transit(), time = kSettling * wave, begin = engine_->state().time_s;
  const double damping = kDamping * std::numbers::pi / wave;
  const double full = how_.speed_m_s / kMm;
  const double wanted = std::max(0., move.stress) / kMPa;
  const double area = panel_.length_mm * panel_.depth_mm;
  for (int n = 1;; ++n) {
    const double passed = engine_->state().time_s - begin, dt = engine_->state().time_step_s;
    if (passed >= time) break;
    double closing = 0;
    if (move.by_pressure) {
      // The mean lags behind the mat: where the platens feel no more than wanted now, they do not open further.
      const double felt = std::min(filtered_, std::max(wanted, now_));
      const double modulus = filtered_ < wanted ? modulus_ : kStiffest;
      closing = -gap() * ((filtered_ > wanted ? felt : filtered_) - wanted) / (modulus * kServoTransits * wave);
      closing = std::clamp(closing, -kServoSpeed * full, kServoSpeed * full);
      closing = std::min(closing, std::max(0., gap() - least) / dt);
    } else if (move.height / kMm > gap()) {  // as far as the mat follows
      const double way = gap() * std::max(0., std::min(filtered_, now_)) / (kStiffest * kServoTransits * wave);
      closing = -std::min({kServoSpeed * full, (move.height / kMm - gap()) / dt, way});
    }
    step(closing, seconds / time);
    listen(dt, area, wave);
    if (n % kDampedSteps == 0) engine_->scale_velocities(std::exp(-damping * kDampedSteps * dt));
    if (passed > (1 - kRead) * time) feel(dt);
    soften_by(passed / time);
  }
  velocity_ = 0;
  wanted_ = kMPa * wanted;
  by_pressure_ = move.by_pressure;
  if (!by_pressure_) limited_ = at_stop_ = false;
}

void StrandMechanics::record() {
  press::Record r;
  r.compaction = 1 - gap() / panel_.initial_thickness_mm;
  r.time_ms = 1e3 * engine_->state().time_s;
  r.force_top_N = sum_s_ > 0 ? sum_top_ / sum_s_ : 0;
  r.force_bottom_N = sum_s_ > 0 ? sum_bottom_ / sum_s_ : 0;
  const double mean = .5 * (r.force_top_N + r.force_bottom_N);
  r.stress_MPa = mean / (panel_.length_mm * panel_.depth_mm);
  stress_ = kMPa * r.stress_MPa;
  if (!by_pressure_) held_ = wanted_ = stress_;
  press::set_energies(r, engine_->energies());

  records_.push_back(r);
}

double StrandMechanics::of_resin(std::size_t strand, const Place& place, const std::vector<Reading>& cells,
                                 double Resin::*value) const {
  const auto carried = how_.resin.empty() ? Carried::kOfItsLayer : how_.resin[strand];
  return between_cells(place, [&](std::size_t i) {
    const bool face = carried == Carried::kFace || (carried == Carried::kOfItsLayer && cells[i].is_face);
    return (face ? cells[i].face : cells[i].core).*value;
  });
}

std::vector<std::size_t> StrandMechanics::face_points() const {
  std::vector<std::size_t> points;
  std::size_t first = 0;
  for (const auto& strand : panel_.strands) {
    for (const int row : {0, strand.lattice.counts[1] - 1})
      for (int i = 0; i < strand.lattice.counts[0]; ++i) points.push_back(first + strand.lattice.point({i, row}));
    first += strand.size();
  }
  return points;
}

std::vector<double> StrandMechanics::strength_of_faces(const std::vector<Reading>& cells) const {
  std::vector<double> strength;
  const auto place = places();
  const auto points = face_points();
  auto point = points.begin();
  for (std::size_t s = 0; s < panel_.strands.size(); ++s)
    for (int k = 0; k < 2 * panel_.strands[s].lattice.counts[0]; ++k, ++point)
      strength.push_back(of_resin(s, place[*point], cells, &Resin::strength));
  return strength;
}

// While no resin has any strength nothing is lost. In the first exchange after which one has, all faces that touch are
// found, those too that met long before: they have lost nothing.
void StrandMechanics::meet(const std::vector<Reading>& cells) {
  const bool any = std::any_of(cells.begin(), cells.end(),
                               [](const Reading& cell) { return cell.face.strength > 0 || cell.core.strength > 0; });
  if (!any) return;
  auto now = strength_of_faces(cells);
  if (met_.empty()) {
    strength_.assign(now.size(), 0);
    met_.assign(now.size(), kApart);
  }
  std::vector<std::size_t> first;  // of a strand in these lists
  std::size_t size = 0;
  double finest = panel_.strands.front().lattice.spacing[0];
  for (const auto& strand : panel_.strands) {
    first.push_back(size);
    size += 2 * static_cast<std::size_t>(strand.lattice.counts[0]);
    finest = std::min(finest, strand.lattice.spacing[0]);
  }
  auto curing = how_.curing;
  curing.point_spacing_mm = .5 * finest;  // so that no point of either face is passed over
  for (const auto& point : glue::cure(panel_, curing)) {
    for (const auto* face : {&point.a, &point.b}) {
      const auto s = static_cast<std::size_t>(face->strand);
      const int columns = panel_.strands[s].lattice.counts[0];
      const auto at =
          first[s] + static_cast<std::size_t>(face->segment + (face->face == glue::StrandFace::kTop ? columns : 0));
      if (met_[at] == kApart) met_[at] = strength_[at];
    }
  }
  strength_ = std::move(now);
}

double StrandMechanics::precured() const {
  double sum = 0, faces = 0;
  for (const double strength : met_) {
    if (strength == kApart) continue;
    sum += strength;
    ++faces;
  }
  return faces > 0 ? sum / faces : 0;
}

Panel<2> StrandMechanics::panel(const std::vector<Reading>& cells) const {
  Panel<2> panel = panel_;
  const auto place = places();
  std::vector<double> quality;
  std::size_t n = 0;
  for (std::size_t s = 0; s < panel.strands.size(); ++s) {
    auto& points = panel.strands[s].points;
    const auto fill = [&](std::vector<double>& values, double Reading::*member) {
      values.clear();
      for (std::size_t p = n; p < n + points.size(); ++p)
        values.push_back(between_cells(place[p], [&](std::size_t i) { return cells[i].*member; }));
    };
    fill(points.temperature, &Reading::T);
    fill(points.moisture, &Reading::M);
    fill(points.gas, &Reading::gas);
    points.cure.clear();
    for (std::size_t p = n; p < n + points.size(); ++p) {
      points.cure.push_back(of_resin(s, place[p], cells, &Resin::cure));
      quality.push_back(of_resin(s, place[p], cells, &Resin::strength));
    }
    n += points.size();
  }
  const auto faces = face_points();
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const bool met = !met_.empty() && met_[i] != kApart;
    quality[faces[i]] = met ? std::max(0., quality[faces[i]] - met_[i]) : 0;
  }
  auto next = quality.begin();
  for (auto& strand : panel.strands) {
    const auto end = next + static_cast<std::ptrdiff_t>(strand.size());
    strand.points.bond_quality.assign(next, end);
    next = end;
  }
  return panel;
}

press::Checkpoint<2> StrandMechanics::checkpoint() const {
  press::Checkpoint<2> checkpoint;
  checkpoint.panel = panel_;
  checkpoint.engine = engine_->state();
  checkpoint.engine.energies = engine_->energies();
  checkpoint.records = records_;
  return checkpoint;
}

void StrandMechanics::visit(Numbers& numbers) {
  numbers(thickness_);
  numbers(last_.stiffness);
  numbers(last_.yield);
  numbers(strength_);
  numbers(met_);
  for (auto* number : {&stress_, &waiting_, &velocity_, &wanted_, &held_, &filtered_, &now_, &modulus_})
    numbers(*number);
  numbers(by_pressure_);
  numbers(limited_);
  numbers(at_stop_);
  if (how_.columns > 1) {
    numbers(masses_);
    numbers(moved_);
  }
}

// While gaps close, at little stress, inertia leaves no trace.
std::vector<std::string> StrandMechanics::warnings() const {
  std::vector<std::string> list;
  double most = 0, kinetic = 0, imbalance = 0;
  for (const auto& r : records_) most = std::max(most, r.stress_MPa);
  const auto bears = [&](const press::Record& r) { return r.stress_MPa >= kJudged * most; };
  const auto peak = std::find_if(records_.begin(), records_.end(), [&](const auto& r) { return r.stress_MPa == most; });
  const auto loose = std::find_if_not(std::make_reverse_iterator(peak), records_.rend(), bears);
  for (auto r = loose.base(); r != records_.end() && bears(*r); ++r) {
    kinetic = std::max(kinetic, r->kinetic_mJ / r->internal_mJ());
    imbalance =
        std::max(imbalance, std::abs(r->force_top_N - r->force_bottom_N) / (.5 * (r->force_top_N + r->force_bottom_N)));
  }
  if (kinetic > press::kKineticLimit) {
    list.push_back(
        fmt::format("The press closed too fast: the energy of the strands' motion reached {:.1f} % of the "
                    "internal energy (limit {:.0f} %). Lower press.speed_m_s.",
                    100 * kinetic, 100 * press::kKineticLimit));
  }
  if (imbalance > press::kForceLimit) {
    list.push_back(
        fmt::format("The two platens felt forces that differed by up to {:.0f} % (limit {:.0f} %): the mat "
                    "was not pressed evenly. Lower press.speed_m_s.",
                    100 * imbalance, 100 * press::kForceLimit));
  }
  if (how_.columns > 1 && moved_ > kMuchMoved) {
    list.push_back(
        fmt::format("{:.1f} % of a column's mass has moved into or out of it (limit {:.0f} %), while heat and moisture "
                    "are computed as if it stayed. Fewer hotpress.columns are wider.",
                    100 * moved_, 100 * kMuchMoved));
  }
  if (precured() > kMuchPrecure) {
    list.push_back(fmt::format(
        "precure: resin had set before strands met, and their bonds have lost {:.0f} % of their strength on "
        "average. Close faster, or take a slower resin.",
        100 * precured()));
  }
  if (!records_.empty() && std::abs(records_.back().balance_error()) > press::kBalanceLimit) {
    list.push_back(fmt::format("The energy balance is off by {:.1f} % of the platens' work.",
                               100 * records_.back().balance_error()));
  }
  return list;
}

}  // namespace strandlab::hotpress
