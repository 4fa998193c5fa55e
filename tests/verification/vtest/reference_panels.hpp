// Panels of the reference mats, and the moduli an independent finite-element program gave for them.
#pragma once

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "strandlab/vtest/vtest.hpp"

namespace strandlab::vtest {

inline std::vector<StrandKind> kinds_of_poplar() {
  const wood::Material poplar;  // unmodified hybrid poplar
  return {{"surface", poplar, 0}, {"core", poplar, 90}};
}

inline mat::Mat reference_mat(const std::string& name) {
  return mat::read(std::string(STRANDLAB_TEST_DATA) + "/reference/" + name + ".json", {"surface", "core"});
}

// The default lattice: six material points through a strand, as far apart along it.
inline Panel<2> panel_of(const mat::Mat& mat, double spacing_along_mm = 0.8 / 6) {
  return make_panel(mat, kinds_of_poplar(), spacing_along_mm, 6);
}

// All heights times 1 - compaction; lengths unchanged.
inline Panel<2> flattened(Panel<2> panel, double compaction) {
  const double f = 1 - compaction;
  for (auto& strand : panel.strands) {
    for (auto& x : strand.points.x) x[1] *= f;
    for (auto& F : strand.points.F) F.row(1) *= f;
  }
  panel.top_mm *= f;
  return panel;
}

// Laminate of strands as long as the panel, y -> y + A sin(2 pi x/w).
inline Panel<2> undulated_laminate(int rows, double length_mm, double amplitude_mm, double wave_mm) {
  mat::Mat mat;
  mat.length_mm = length_mm;
  mat.layer_thickness_mm = 0.8;
  for (int row = 0; row < rows; ++row) {
    mat::Layer layer;
    layer.role = "surface";
    mat::Strand strand;
    strand.x1_mm = length_mm;
    layer.strands.push_back(strand);
    mat.layers.push_back(layer);
  }
  auto panel = panel_of(mat);
  const double k = 2 * M_PI / wave_mm;
  for (auto& strand : panel.strands) {
    for (std::size_t p = 0; p < strand.size(); ++p) {
      const double x = strand.points.x[p][0];
      strand.points.x[p][1] += amplitude_mm * std::sin(k * x);
      strand.points.F[p](1, 0) = amplitude_mm * k * std::cos(k * x);
    }
  }
  return panel;
}

inline const std::vector<TestKind>& kinds_on_end_planes() {
  static const std::vector<TestKind> kinds{TestKind::kTension, TestKind::kBendingEndRotation,
                                           TestKind::kBendingEndCouple};
  return kinds;
}

struct ReferenceModulus {
  TestKind kind;
  double compliance_t_mm_per_MPa;
  double modulus_MPa;
};

// Moduli of a mat from fe_moduli.json; `variant` ends the load case's name there ("", "_fine", "_flat_compacted_0.2").
inline std::vector<ReferenceModulus> reference_moduli(const std::string& name, const std::string& variant) {
  nlohmann::json file;
  std::ifstream(std::string(STRANDLAB_TEST_DATA) + "/reference/fe_moduli.json") >> file;
  std::vector<ReferenceModulus> moduli;
  for (const TestKind kind : kinds_on_end_planes()) {
    for (const auto& [compliance, modulus] : file.at(name).at(vtest::name(kind) + variant).items()) {
      moduli.push_back({kind, std::stod(compliance), modulus.get<double>()});
    }
  }
  return moduli;
}

inline Modulus find(const Result& result, TestKind kind, double compliance_t) {
  for (const auto& m : result.moduli) {
    if (m.kind == kind && m.compliance_t_mm_per_MPa == compliance_t) return m;
  }
  throw std::runtime_error("modulus not measured");
}

}  // namespace strandlab::vtest
