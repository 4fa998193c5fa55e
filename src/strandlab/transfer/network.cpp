#include "strandlab/transfer/network.hpp"

#include <cmath>

namespace strandlab::transfer {
namespace {

constexpr int kUnknowns = 3;

// The scalars of a cell and of a face between two of them: derivatives by 3 and by 6 unknowns, or none.
struct Values {
  using OfCell = double;
  using OfFace = double;
  static std::array<double, 3> unknowns(const CellState& s) { return {s.T, s.M, s.p_a}; }
  static double lifted(double x, int) { return x; }
};
struct Derivatives {
  using OfCell = Dual<kUnknowns>;
  using OfFace = Dual<2 * kUnknowns>;
  static std::array<OfCell, 3> unknowns(const CellState& s) {
    return {OfCell::unknown(s.T, 0), OfCell::unknown(s.M, 1), OfCell::unknown(s.p_a, 2)};
  }
  // As one of a face's two cells: 0 is a, 1 is b.
  static OfFace lifted(const OfCell& x, int which) {
    OfFace y(x.v);
    for (int i = 0; i < kUnknowns; ++i) y.d[static_cast<std::size_t>(which * kUnknowns + i)] = x.d[i];
    return y;
  }
};

template <class Mode>
Side<typename Mode::OfFace> lifted(const Side<typename Mode::OfCell>& s, int which) {
  const auto lift = [which](const typename Mode::OfCell& x) { return Mode::lifted(x, which); };
  return {lift(s.T),    lift(s.p),         lift(s.y), lift(s.c), lift(s.vapour_enthalpy), lift(s.air_enthalpy),
          lift(s.heat), lift(s.diffusion), s.flow};
}

template <class Mode>
class Assembly {
 public:
  using S = typename Mode::OfCell;

  Assembly(const Constants& constants, const Grid& grid, const std::vector<CellState>& state,
           const Conditions& conditions)
      : k_(constants), grid_(grid), conditions_(conditions), n_(grid.cells()) {
    out_.holds = Eigen::VectorXd::Zero(kUnknowns * n_);
    out_.receives = Eigen::VectorXd::Zero(kUnknowns * n_);
    if constexpr (std::is_same_v<Mode, Derivatives>) {
      out_.holds_by_own.assign(static_cast<std::size_t>(n_), Block::Zero());
      out_.receives_by_own.assign(static_cast<std::size_t>(n_), Block::Zero());
    }
    cells_.reserve(static_cast<std::size_t>(n_));
    for (int i = 0; i < n_; ++i) add_cell(i, state[i]);
  }

  Equations assemble() {
    for (const auto& face : faces_of(grid_)) add_face(face);
    const bool whole_width =
        conditions_.left.kind == Boundary::Kind::kOpen || conditions_.right.kind == Boundary::Kind::kOpen;
    for (int i = 0; i < n_; ++i) {
      const int row = i % grid_.rows, column = i / grid_.rows;
      if (row == 0) add_boundary(i, conditions_.bottom, false);
      if (row == grid_.rows - 1) add_boundary(i, conditions_.top, false);
      if (column == 0) add_boundary(i, conditions_.left, true);
      if (column == grid_.columns - 1) add_boundary(i, conditions_.right, true);
      // A section with open ends is the panel's whole width: no ways to the edges but those along it.
      if (!whole_width) add_crossing(i, edge_flux(k_, cells_[i], conditions_.thickness[i]), -1);
    }
    for (double& x : out_.crossing) x /= grid_.columns;
    return std::move(out_);
  }

 private:
  void add_cell(int i, const CellState& state) {
    const auto [T, M, p_a] = Mode::unknowns(state);
    cells_.push_back(cell_at<S>(k_, grid_.dry_mass[i], conditions_.thickness[i], T, M, p_a));
    for (int row = 0; row < kUnknowns; ++row) {
      const S& held = cells_.back().holds[row];
      out_.holds[kUnknowns * i + row] = value_of(held);
      if constexpr (std::is_same_v<Mode, Derivatives>) {
        for (int j = 0; j < kUnknowns; ++j) out_.holds_by_own[i](row, j) = held.d[j];
      }
    }
  }

  double half_length(int i, bool in_plane) const {
    return 0.5 * (in_plane ? grid_.column_width : conditions_.thickness[i]);
  }
  // m^2 of face per m^2 of panel.
  double area(int a, int b, bool in_plane) const {
    if (!in_plane) return 1;
    return 0.5 * (conditions_.thickness[a] + conditions_.thickness[b]) / grid_.column_width;
  }

  void add_face(const Face& face) {
    const bool in_plane = face.b - face.a != 1 || grid_.rows == 1;
    const auto side = [&](int cell, int which) {
      return lifted<Mode>(side_of(k_, cells_[cell], half_length(cell, in_plane), in_plane), which);
    };
    const auto flux = face_flux(k_, side(face.a, 0), side(face.b, 1));
    const double m2 = area(face.a, face.b, in_plane);
    Block a_by_b = Block::Zero(), b_by_a = Block::Zero();
    for (int row = 0; row < kUnknowns; ++row) {
      const double passed = m2 * value_of(flux[row]);
      out_.receives[kUnknowns * face.a + row] -= passed;
      out_.receives[kUnknowns * face.b + row] += passed;
      if constexpr (std::is_same_v<Mode, Derivatives>) {
        for (int j = 0; j < kUnknowns; ++j) {
          const double by_a = m2 * flux[row].d[j], by_b = m2 * flux[row].d[kUnknowns + j];
          out_.receives_by_own[face.a](row, j) -= by_a;
          out_.receives_by_own[face.b](row, j) += by_b;
          a_by_b(row, j) = -by_b;
          b_by_a(row, j) = by_a;
        }
      }
    }
    if constexpr (std::is_same_v<Mode, Derivatives>) {
      out_.a_by_b.push_back(a_by_b);
      out_.b_by_a.push_back(b_by_a);
    }
  }

  void add_boundary(int i, const Boundary& boundary, bool in_plane) {
    if (boundary.kind == Boundary::Kind::kClosed) return;
    const auto cell = side_of(k_, cells_[i], half_length(i, in_plane), in_plane);
    if (boundary.kind == Boundary::Kind::kPlaten) {
      add_crossing(i, platen_flux(cell, boundary.T, boundary.heat_transfer), area(i, i, in_plane));
      return;
    }
    const auto room = room_side<S>(k_, boundary.T, boundary.p, boundary.humidity, boundary.heat_transfer);
    add_crossing(i, face_flux(k_, room, cell), area(i, i, in_plane));
  }

  // `sign` times the flux comes from outside.
  void add_crossing(int i, const Flux<S>& flux, double sign) {
    for (int row = 0; row < kUnknowns; ++row) {
      const double passed = sign * value_of(flux[row]);
      out_.receives[kUnknowns * i + row] += passed;
      out_.crossing[row] += passed;
      if constexpr (std::is_same_v<Mode, Derivatives>) {
        for (int j = 0; j < kUnknowns; ++j) out_.receives_by_own[i](row, j) += sign * flux[row].d[j];
      }
    }
  }

  const Constants& k_;
  const Grid& grid_;
  const Conditions& conditions_;
  int n_;
  std::vector<Cell<S>> cells_;
  Equations out_;
};

}  // namespace

std::vector<Face> faces_of(const Grid& grid) {
  std::vector<Face> faces;
  for (int i = 0; i < grid.cells(); ++i) {
    if (i % grid.rows + 1 < grid.rows) faces.push_back({i, i + 1});
  }
  for (int i = 0; i + grid.rows < grid.cells(); ++i) faces.push_back({i, i + grid.rows});
  return faces;
}

Equations values_at(const Constants& constants, const Grid& grid, const std::vector<CellState>& state,
                    const Conditions& conditions) {
  return Assembly<Values>(constants, grid, state, conditions).assemble();
}

Equations equations_at(const Constants& constants, const Grid& grid, const std::vector<CellState>& state,
                       const Conditions& conditions) {
  return Assembly<Derivatives>(constants, grid, state, conditions).assemble();
}

}  // namespace strandlab::transfer
