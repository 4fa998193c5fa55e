// Plates for tests: the reference mats with what an independent finite-element program gave for them, and mats made by
// hand.
#pragma once

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "strandlab/vtest/plate.hpp"

namespace strandlab::vtest {

inline const std::vector<mat::RoleAngle>& roles() {
  static const std::vector<mat::RoleAngle> kRoles{{"surface", 0}, {"core", 90}};
  return kRoles;
}

inline std::vector<StrandKind> kinds_of(const wood::Material& material) {
  return {{"surface", material, 0}, {"core", material, 90}};
}

inline mat::PlateMat reference_plate(const std::string& name) {
  return mat::read_plate(std::string(STRANDLAB_TEST_DATA) + "/mats3d/" + name + ".json", roles());
}

inline const nlohmann::json& reference_moduli() {
  static const auto kAll = nlohmann::json::parse(std::ifstream(STRANDLAB_TEST_DATA "/mats3d/fe_moduli3d.json"));
  return kAll;
}

// The elements' lattice does not depend on the points'.
inline Panel<3> panel_of(const mat::PlateMat& mat, const wood::Material& material = {}) {
  return make_panel(mat, kinds_of(material), 1, 2);
}

inline PlateOptions options(double element_length_mm, const std::vector<double>& compliances_t) {
  PlateOptions o;
  o.element_length_mm = element_length_mm;
  o.compliance_t_mm_per_MPa = compliances_t;
  o.glued_plates = false;
  return o;
}

inline double modulus(const PlateResult& result, const std::string& test, double compliance_t) {
  for (const auto& m : result.moduli) {
    if (m.test == test && m.compliance_t_mm_per_MPa == compliance_t) return m.modulus_MPa;
  }
  throw std::out_of_range(test);
}

inline statics::PlateStiffness abd(const nlohmann::json& rows) {
  statics::PlateStiffness m;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) m(i, j) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  }
  return m;
}

// Largest difference of two plate stiffnesses, each over the root of its diagonal terms.
inline double largest_difference(const statics::PlateStiffness& a, const statics::PlateStiffness& b) {
  double largest = 0;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) largest = std::max(largest, std::abs(a(i, j) - b(i, j)) / std::sqrt(b(i, i) * b(j, j)));
  }
  return largest;
}

// Plate stiffness of a plate turned by an angle from x towards y.
inline statics::PlateStiffness turned(const statics::PlateStiffness& abd, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Eigen::Matrix3d strain;         // in the plate's own axes from those in the panel's
  strain << c * c, s * s, c * s,  //
      s * s, c * c, -c * s,       //
      -2 * c * s, 2 * c * s, c * c - s * s;
  statics::PlateStiffness t = statics::PlateStiffness::Zero();
  t.topLeftCorner<3, 3>() = t.bottomRightCorner<3, 3>() = strain;
  return t.transpose() * abd * t;
}

// A periodic square mat turned by atan(q/p), p and q without a common factor, is periodic in a window sqrt(p^2 + q^2)
// times as large, which holds p^2 + q^2 copies of it: those shifted along one of its own axes.
inline mat::PlateMat turned_mat(const mat::PlateMat& mat, int p, int q) {
  const double angle = std::atan2(q, p), c = std::cos(angle), s = std::sin(angle);
  auto turned = mat;
  turned.length_mm = turned.width_mm = mat.length_mm * std::hypot(p, q);
  for (auto& layer : turned.layers) {
    const auto strands = layer.strands;
    layer.strands.clear();
    for (int copy = 0; copy < p * p + q * q; ++copy) {
      for (auto strand : strands) {
        const double x = strand.cx_mm + copy * mat.length_mm, y = strand.cy_mm;
        strand.cx_mm = c * x - s * y;
        strand.cy_mm = s * x + c * y;
        strand.angle_deg = mat::angle_deg(strand, layer.role, roles()) + angle * 180 / std::numbers::pi;
        layer.strands.push_back(strand);
      }
    }
  }
  return turned;
}

// A mat of a few short strands in three layers, not symmetric in any way, on a torus of 12 mm. With elements of 1 mm
// their nodes match.
inline mat::PlateMat small_mat() {
  struct Plank {
    double cx, cy, length, width, angle;
  };
  const std::vector<std::vector<Plank>> layers{{{4, 3, 10, 4, 0}, {7, 9, 10, 6, 0}},
                                               {{2, 5, 10, 4, 90}, {8, 9, 10, 6, 90}},
                                               {{1, 2, 10, 4, 0}, {6, 6, 10, 4, 0}, {9, 10, 10, 2, 0}}};
  mat::PlateMat mat;
  mat.length_mm = mat.width_mm = 12;
  mat.layer_thickness_mm = 0.8;
  for (const auto& planks : layers) {
    auto& layer = mat.layers.emplace_back();
    layer.role = "surface";
    for (const auto& plank : planks) {
      auto& strand = layer.strands.emplace_back();
      strand.cx_mm = plank.cx;
      strand.cy_mm = plank.cy;
      strand.length_mm = plank.length;
      strand.width_mm = plank.width;
      strand.angle_deg = plank.angle;
    }
  }
  return mat;
}

}  // namespace strandlab::vtest
