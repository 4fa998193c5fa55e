// Material points and the table of their fields: the one place that names them. Files, specimens, lumped frames,
// ParaView and colourings go through the table.
#pragma once

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <vector>

#include "strandlab/lattice/lattice.hpp"

namespace strandlab {

// State of the material points of a strand, in the order of its lattice. Every list is as long as x, but those of an
// optional field may be empty, in all strands of a panel alike: wood that has not been in a hot press.
template <int Dim>
struct Points {
  std::vector<Vec<Dim>> x;      // mm, positions now
  std::vector<Vec<Dim>> v;      // mm/s
  std::vector<Tensor<Dim>> F;   // deformation gradient since formation, from the lattice's axes
  std::vector<Voigt> stress;    // MPa, Kirchhoff, strand axes convected with the strand (along = F a0)
  std::vector<double> plastic;  // history of yielding: alpha, accumulated plastic strain, or x where the wood crushes

  // Optional.
  std::vector<double> stiffness_factor, yield_factor;  // over those at 20 C and 12 % moisture content
  std::vector<double> temperature, moisture;           // C, kg/kg
  std::vector<double> gas, cure;                       // kPa above the room's; degree of cure of the strand's resin
  std::vector<double> bond_quality;                    // strength of its bond over that fully cured

  std::size_t size() const { return x.size(); }
};

// A strand cut by the ends of a specimen takes its points anew along itself: linear between the old ones, and beyond
// the last of them on the same line, or as the last one is.
enum class Resampled { kExtrapolated, kHeld };

// A coarse point of a lumped panel: what its corners make of it, the mean of the wood it covers, or nothing.
enum class Lumped { kFromCorners, kMean, kZero };

// One row of the table.
template <int Dim, class Value>
struct PointField {
  std::vector<Value> Points<Dim>::*values;
  const char* name;  // in files, with its unit
  const char* unit;
  const char* description;
  Resampled resampled;
  Lumped lumped;
  bool kept;              // in checkpoints and panel files; else it is zero when one is read
  bool shown;             // a scalar: in ParaView files and the report's colourings
  bool optional = false;  // its lists may be empty

  static constexpr bool kScalar = std::is_same_v<Value, double>;
  // Rank of the tensor whose numbers a value holds: 0, 1 (also six of Voigt's order) or 2.
  static constexpr int rank() {
    if constexpr (kScalar) {
      return 0;
    } else {
      return Value::ColsAtCompileTime == 1 ? 1 : 2;
    }
  }
  // Extents of one value in a file: none, rows, or rows and columns.
  static std::vector<std::size_t> shape() {
    if constexpr (kScalar) {
      return {};
    } else if constexpr (rank() == 1) {
      return {Value::RowsAtCompileTime};
    } else {
      return {Value::RowsAtCompileTime, Value::ColsAtCompileTime};
    }
  }
};

// The table. Files list the fields in this order.
template <int Dim>
constexpr auto point_fields() {
  using P = Points<Dim>;
  return std::tuple{
      PointField<Dim, Vec<Dim>>{&P::x, "position_mm", "mm", "x, [across,] through the thickness",
                                Resampled::kExtrapolated, Lumped::kFromCorners, true, false},
      PointField<Dim, Vec<Dim>>{&P::v, "velocity_mm_s", "mm/s", "velocity", Resampled::kHeld, Lumped::kZero, true,
                                false},
      PointField<Dim, Tensor<Dim>>{&P::F, "deformation_gradient", "1", "since formation, column by column",
                                   Resampled::kHeld, Lumped::kFromCorners, true, false},
      PointField<Dim, Voigt>{&P::stress, "kirchhoff_stress_MPa", "MPa",
                             "strand axes, Voigt 11 22 33 23 13 12, tension positive", Resampled::kHeld, Lumped::kMean,
                             true, false},
      PointField<Dim, double>{
          &P::plastic, "plastic_strain", "1",
          "accumulated plastic strain alpha; collapsed part of the volume x where the strand crushes", Resampled::kHeld,
          Lumped::kMean, true, true},
      PointField<Dim, double>{&P::stiffness_factor, "stiffness_factor", "1",
                              "elastic moduli over those at 20 C and 12 % moisture content", Resampled::kHeld,
                              Lumped::kMean, true, false, true},
      PointField<Dim, double>{&P::yield_factor, "yield_factor", "1",
                              "yield stresses over those at 20 C and 12 % moisture content", Resampled::kHeld,
                              Lumped::kMean, true, true, true},
      PointField<Dim, double>{&P::temperature, "temperature_C", "C", "temperature", Resampled::kHeld, Lumped::kMean,
                              true, true, true},
      PointField<Dim, double>{&P::moisture, "moisture_content", "kg/kg", "water per oven-dry wood", Resampled::kHeld,
                              Lumped::kMean, true, true, true},
      PointField<Dim, double>{&P::gas, "gas_pressure_kPa", "kPa", "gas pressure above the room's", Resampled::kHeld,
                              Lumped::kMean, true, true, true},
      PointField<Dim, double>{&P::cure, "degree_of_cure", "1", "of the resin that the strand carries", Resampled::kHeld,
                              Lumped::kMean, true, true, true},
      PointField<Dim, double>{&P::bond_quality, "bond_quality", "1", "strength of its bond over that fully cured",
                              Resampled::kHeld, Lumped::kMean, true, true, true},
  };
}

static_assert(sizeof(Points<2>) == std::tuple_size_v<decltype(point_fields<2>())> * sizeof(std::vector<double>),
              "a field of Points has no row in the table");

// visit(row) for every field, in the table's order.
template <int Dim, class Visit>
void for_each_field(const Visit& visit) {
  std::apply([&](const auto&... field) { (visit(field), ...); }, point_fields<Dim>());
}

// The same for the fields that these points have.
template <int Dim, class Visit>
void for_each_field_of(const Points<Dim>& points, const Visit& visit) {
  for_each_field<Dim>([&](const auto& field) {
    if (!field.optional || !(points.*field.values).empty()) visit(field);
  });
}

// The same for those that are shown as they are, all of them scalars.
template <int Dim, class Visit>
void for_each_shown_field(const Points<Dim>& points, const Visit& visit) {
  for_each_field_of<Dim>(points, [&](const auto& field) {
    if constexpr (std::decay_t<decltype(field)>::kScalar) {
      if (field.shown) visit(field);
    }
  });
}

// A field's values, all zero.
template <class Value>
void set_zero(std::vector<Value>& values, std::size_t size) {
  values.assign(size, zero_of<Value>());
}

// Points as formed: where the placement puts them, deformed by nothing but its turn, every other field zero.
template <int Dim>
Points<Dim> formed_points(const Lattice<Dim>& lattice, const Placement<Dim>& placement) {
  Points<Dim> points;
  for_each_field<Dim>([&](const auto& field) {
    if (!field.optional) set_zero(points.*field.values, lattice.size());
  });
  points.x = positions(lattice, placement);
  points.F.assign(lattice.size(), placement.axes);
  return points;
}

// Positions of the corners, mm: each the mean of those that the adjacent points' domains (parallelograms, in 3D
// parallelepipeds, x +- F spacing/2) put there. A strand's outline, cells and elements are made of them.
template <int Dim>
std::vector<Vec<Dim>> corners(const Lattice<Dim>& lattice, const Points<Dim>& points) {
  return corner_means(
      lattice, [&](std::size_t p, const Vec<Dim>& offset) -> Vec<Dim> { return points.x[p] + points.F[p] * offset; });
}

// Corner values of any other field: means of the adjacent points' values.
template <int Dim, class Value>
std::vector<Value> corner_values(const Lattice<Dim>& lattice, const std::vector<Value>& values) {
  return corner_means(lattice, [&](std::size_t p, const Vec<Dim>&) { return values[p]; });
}

}  // namespace strandlab
