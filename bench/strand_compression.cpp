// One strand under transverse compression, free and confined, by Hill's law and by crushing: curves and tables of
// docs/crushing.md. Prints the tables; with --curves the curves, for gnuplot (bench/crushing).
#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <string>
#include <vector>

#include "strandlab/wood/return_map.hpp"
#include "strandlab/wood/yield_modes.hpp"

namespace {

using namespace strandlab;
using Stress = Eigen::Vector4d;  // 11, 22, 33, 13

constexpr int kThrough = 2;
constexpr double kStep = 2e-4;

// A point of a strand, deformed through its thickness.
struct Point {
  wood::Law law;
  wood::YieldModes<4> modes;
  Stress tau = Stress::Zero();
  double ln_J = 0, history = 0, radius = 1;

  explicit Point(const wood::Material& material)
      : law(material.law), modes(wood::yield_modes<4>(wood::in_strand_axes(material, 0))) {}
  void advance(const Stress& strain) {
    ln_J += strain.head<3>().sum();
    const double J = std::exp(ln_J);
    double t[4];
    for (int i = 0; i < 4; ++i) {
      t[i] = tau[i];
      for (int j = 0; j < 4; ++j) t[i] += modes.stiffness[i][j] * strain[j];
    }
    wood::with_law(law, [&]<class L>() { wood::return_map<L, wood::ScalarOps, 4>(modes, t, J, history, radius); });
    for (int i = 0; i < 4; ++i) tau[i] = t[i];
  }

  // Advances by a strain through the thickness with the other two normal stresses at zero (free) or their strains
  // (confined): Newton's method with differences.
  void squeeze(double strain, bool free) {
    Stress e = Stress::Zero();
    e[kThrough] = strain;
    for (int iteration = 0; free && iteration < 30; ++iteration) {
      const auto sideways = [&](const Stress& trial) {
        Point copy = *this;
        copy.advance(trial);
        return Eigen::Vector2d(copy.tau[0], copy.tau[1]);
      };
      const Eigen::Vector2d s = sideways(e);
      if (s.cwiseAbs().maxCoeff() < 1e-9) break;
      Eigen::Matrix2d slope;
      for (int k = 0; k < 2; ++k) {
        Stress nudged = e;
        nudged[k] += 1e-9;
        slope.col(k) = (sideways(nudged) - s) / 1e-9;
      }
      e.head<2>() -= slope.inverse() * s;
    }
    advance(e);
  }
  double pressure() const { return -tau[kThrough] / std::exp(ln_J); }  // MPa, Cauchy
};

struct State {
  double compaction, pressure;
};

// 1 - h/h0 and pressure, every `every` steps, up to a compaction or a pressure.
std::vector<State> loading(const wood::Material& material, bool free, double compaction, double pressure,
                           double* kept = nullptr) {
  Point point(material);
  std::vector<State> curve{{0, 0}};
  double strain = 0;
  while (curve.back().compaction < compaction && curve.back().pressure < pressure) {
    point.squeeze(-kStep, free);
    strain -= kStep;
    curve.push_back({1 - std::exp(strain), point.pressure()});
  }
  if (kept != nullptr) {
    while (point.pressure() > 0) {
      point.squeeze(kStep, free);
      strain += kStep;
    }
    *kept = 1 - std::exp(strain);
  }
  return curve;
}

wood::Material poplar(wood::Law law, double density_kg_m3) {
  wood::Material m = wood::library()[0];
  m.law = law;
  m.density_kg_m3 = density_kg_m3;
  return m;
}

// Linear between the steps.
double pressure_at(const std::vector<State>& curve, double compaction) {
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const auto &before = curve[i - 1], &after = curve[i];
    if (after.compaction < compaction) continue;
    const double part = (compaction - before.compaction) / (after.compaction - before.compaction);
    return before.pressure + part * (after.pressure - before.pressure);
  }
  return curve.back().pressure;
}

void print_curves() {
  for (const wood::Law law : {wood::Law::kHill, wood::Law::kCrushing}) {
    for (const bool free : {true, false}) {
      fmt::print("# {} {}\n", wood::name(law), free ? "free" : "confined");
      const auto curve = loading(poplar(law, 350), free, 0.7, 130);
      for (std::size_t i = 0; i < curve.size(); i += 10)
        fmt::print("{:.5f} {:.5f}\n", curve[i].compaction, curve[i].pressure);
      fmt::print("\n\n");
    }
  }
}

void print_tables() {
  fmt::print("pressure through the thickness, MPa, poplar of 350 kg/m3\n{:<24}", "compaction, %");
  const std::vector<double> compactions{.05, .1, .2, .3, .4, .5, .6, .65};
  for (const double C : compactions) fmt::print("{:>9.0f}", 100 * C);
  fmt::print("\n");
  for (const wood::Law law : {wood::Law::kHill, wood::Law::kCrushing}) {
    for (const bool free : {true, false}) {
      const auto curve = loading(poplar(law, 350), free, 0.66, 1e9);
      fmt::print("{:<24}", fmt::format("{}, {}", wood::name(law), free ? "free" : "confined"));
      for (const double C : compactions) fmt::print("{:>9.2f}", pressure_at(curve, C));
      fmt::print("\n");
    }
  }
  fmt::print("\ncompaction kept after release, %, poplar of 450 kg/m3\n{:<24}", "pressure, MPa");
  const std::vector<double> pressures{25, 50, 75, 100, 125};
  for (const double p : pressures) fmt::print("{:>9.0f}", p);
  fmt::print("\n{:<24}{:>9}{:>9}{:>9}{:>9}{:>9}\n", "measured", 36.8, 40.7, 44.8, 46.7, 51.9);
  for (const wood::Law law : {wood::Law::kHill, wood::Law::kCrushing}) {
    for (const bool free : {true, false}) {
      fmt::print("{:<24}", fmt::format("{}, {}", wood::name(law), free ? "free" : "confined"));
      for (const double p : pressures) {
        double kept = 0;
        loading(poplar(law, 450), free, 0.9, p, &kept);
        fmt::print("{:>9.1f}", 100 * kept);
      }
      fmt::print("\n");
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::string(argv[1]) == "--curves") {
    print_curves();
  } else {
    print_tables();
  }
}
