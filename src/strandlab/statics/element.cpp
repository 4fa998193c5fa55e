#include "strandlab/statics/element.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>

#include "strandlab/core/error.hpp"

namespace strandlab::statics {
namespace {

template <int Dim>
using Gradients = Eigen::Matrix<double, Dim, kCorners<Dim>>;  // of the shape functions
template <int Dim>
using StrainColumns = Eigen::Matrix<double, kStrains<Dim>, Dim>;

// Natural coordinate of a corner on an axis: -1 or 1.
constexpr double natural(int corner, int axis) {
  constexpr std::array<std::array<int, 2>, 4> kAround{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  return axis < 2 ? kAround[static_cast<std::size_t>(corner % 4)][static_cast<std::size_t>(axis)]
                  : (corner < 4 ? -1 : 1);
}

// Derivatives with respect to the natural coordinates r of N = prod_a (1 + r_a,i r_a)/2.
template <int Dim>
Gradients<Dim> natural_gradients(const Vec<Dim>& r) {
  Gradients<Dim> d;
  for (int i = 0; i < kCorners<Dim>; ++i) {
    for (int a = 0; a < Dim; ++a) {
      d(a, i) = natural(i, a);
      for (int b = 0; b < Dim; ++b) {
        if (b != a) d(a, i) *= 1 + natural(i, b) * r[b];
      }
    }
  }
  return 1.0 / kCorners<Dim> * d;
}

// Columns of the strain matrix that belong to a function with the given gradient.
template <int Dim>
StrainColumns<Dim> strain_columns(const Vec<Dim>& g) {
  StrainColumns<Dim> b;
  if constexpr (Dim == 2) {
    b << g[0], 0, 0, g[1], g[1], g[0];
  } else {
    b << g[0], 0, 0,                   //
        0, g[1], 0,                    //
        0, 0, g[2],                    //
        0, g[2], g[1], g[2], 0, g[0],  //
        g[1], g[0], 0;
  }
  return b;
}

template <int Dim>
Eigen::Matrix<double, kCorners<Dim>, Dim> rows_of(const ElementCorners<Dim>& corners) {
  Eigen::Matrix<double, kCorners<Dim>, Dim> x;
  for (int i = 0; i < kCorners<Dim>; ++i) x.row(i) = corners[static_cast<std::size_t>(i)];
  return x;
}

// visit(r, gradients of the shape functions, determinant of the Jacobian) at the Gauss points. Throws RunError where
// the element is inverted.
template <int Dim, class Visit>
void for_each_gauss_point(const Eigen::Matrix<double, kCorners<Dim>, Dim>& x, const Visit& visit) {
  const double g = 1 / std::sqrt(3.0);
  for (int k = 0; k < kCorners<Dim>; ++k) {
    Vec<Dim> r;
    for (int a = 0; a < Dim; ++a) r[a] = (k >> a & 1) == 0 ? -g : g;
    const Gradients<Dim> along_natural = natural_gradients<Dim>(r);
    const Tensor<Dim> jacobian = along_natural * x;
    const double det = jacobian.determinant();
    if (!(det > 0)) {
      throw RunError(fmt::format("inverted element at x = {:.3f} mm, y = {:.3f} mm{}", x.col(0).mean(), x.col(1).mean(),
                                 Dim == 2 ? "" : fmt::format(", z = {:.3f} mm", x.col(Dim - 1).mean())));
    }
    visit(r, Gradients<Dim>(jacobian.inverse() * along_natural), det);
  }
}

// Strain matrix of the corners, then the incompatible modes, at a Gauss point.
template <int Dim>
class StrainMatrix {
 public:
  static constexpr int kModes = Dim * Dim;
  using Matrix = Eigen::Matrix<double, kStrains<Dim>, kElementDofs<Dim> + kModes>;

  explicit StrainMatrix(const Eigen::Matrix<double, kCorners<Dim>, Dim>& x) {
    const Tensor<Dim> j0 = natural_gradients<Dim>(Vec<Dim>::Zero()) * x;
    det0_ = j0.determinant();
    inverse0_ = j0.inverse();
  }

  Matrix at(const Vec<Dim>& r, const Gradients<Dim>& gradient, double det) const {
    Matrix b;
    for (int i = 0; i < kCorners<Dim>; ++i) b.template middleCols<Dim>(Dim * i) = strain_columns<Dim>(gradient.col(i));
    // Modes 1 - r^2 with the Jacobian of the centre, so that they do no work on a constant stress.
    for (int a = 0; a < Dim; ++a) {
      Vec<Dim> slope = Vec<Dim>::Zero();
      slope[a] = -2 * r[a];
      b.template middleCols<Dim>(kElementDofs<Dim> + Dim * a) = strain_columns<Dim>(det0_ / det * inverse0_ * slope);
    }
    return b;
  }

 private:
  double det0_;
  Tensor<Dim> inverse0_;
};

template <int Dim>
ElementStiffness<Dim> condensed(const ElementCorners<Dim>& corners, const WoodStiffness<Dim>& stiffness) {
  constexpr int kDofs = kElementDofs<Dim>, kModes = StrainMatrix<Dim>::kModes, kAll = kDofs + kModes;
  const auto x = rows_of<Dim>(corners);
  const StrainMatrix<Dim> strain(x);
  Eigen::Matrix<double, kAll, kAll> full = Eigen::Matrix<double, kAll, kAll>::Zero();
  for_each_gauss_point<Dim>(x, [&](const Vec<Dim>& r, const Gradients<Dim>& gradient, double det) {
    const auto b = strain.at(r, gradient, det);
    full.noalias() += det * b.transpose() * (stiffness * b);
  });
  const Eigen::Matrix<double, kModes, kDofs> coupling = full.template bottomLeftCorner<kModes, kDofs>();
  const Eigen::Matrix<double, kModes, kModes> modes = full.template bottomRightCorner<kModes, kModes>();
  return full.template topLeftCorner<kDofs, kDofs>() - coupling.transpose() * (modes.inverse() * coupling);
}

}  // namespace

PlaneStiffness in_section(const VoigtMatrix& strand_stiffness, const Vec<2>& grain) {
  constexpr std::array<int, 3> kept{0, 2, 4};  // 11, 33, 13
  PlaneStiffness local;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) local(i, j) = strand_stiffness(kept[i], kept[j]);
  }
  // Engineering strains in strand axes from those in panel axes.
  const double c = grain[0], s = grain[1];
  PlaneStiffness t;
  t << c * c, s * s, c * s,  //
      s * s, c * c, -c * s,  //
      -2 * c * s, 2 * c * s, c * c - s * s;
  return t.transpose() * local * t;
}

VoigtMatrix in_panel(const VoigtMatrix& strand_stiffness, const Tensor<3>& axes) {
  constexpr std::array<std::array<int, 2>, 6> kPair{{{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}};
  // Engineering strains in strand axes from those in panel axes: e'_ij = a_ki a_lj e_kl.
  VoigtMatrix t;
  for (int p = 0; p < 6; ++p) {
    for (int q = 0; q < 6; ++q) {
      const auto [i, j] = kPair[static_cast<std::size_t>(p)];
      const auto [k, l] = kPair[static_cast<std::size_t>(q)];
      const double both = axes(k, i) * axes(l, j) + axes(l, i) * axes(k, j);
      t(p, q) = p < 3 ? 0.5 * both : both;
    }
  }
  return t.transpose() * strand_stiffness * t;
}

double area(const ElementCorners<2>& x) {
  const Vec<2> p = x[2] - x[0], q = x[3] - x[1];
  return 0.5 * (p[0] * q[1] - p[1] * q[0]);
}

double volume(const ElementCorners<3>& corners) {
  double volume = 0;
  for_each_gauss_point<3>(rows_of<3>(corners), [&](const auto&, const auto&, double det) { volume += det; });
  return volume;
}

template <int Dim>
ElementStiffness<Dim> incompatible_element(const ElementCorners<Dim>& corners, const WoodStiffness<Dim>& stiffness) {
  return condensed<Dim>(corners, stiffness);
}

template ElementStiffness<2> incompatible_element<2>(const ElementCorners<2>&, const WoodStiffness<2>&);
template ElementStiffness<3> incompatible_element<3>(const ElementCorners<3>&, const WoodStiffness<3>&);

PlateTerms plate_terms(const ElementCorners<3>& corners, const VoigtMatrix& stiffness, double middle) {
  constexpr int kDofs = kElementDofs<3>, kModes = StrainMatrix<3>::kModes, kAll = kDofs + kModes;
  const auto x = rows_of<3>(corners);
  const StrainMatrix<3> strain(x);
  Eigen::Matrix<double, kAll, 6> loads = Eigen::Matrix<double, kAll, 6>::Zero();  // corners, then modes
  Eigen::Matrix<double, kModes, kAll> modes = Eigen::Matrix<double, kModes, kAll>::Zero();
  PlateTerms terms;
  terms.own.setZero();
  for_each_gauss_point<3>(x, [&](const Vec<3>& r, const Gradients<3>& gradient, double det) {
    const auto b = strain.at(r, gradient, det);
    double z = -middle;
    for (int i = 0; i < kCorners<3>; ++i) {
      double shape = 1.0 / kCorners<3>;
      for (int a = 0; a < 3; ++a) shape *= 1 + natural(i, a) * r[a];
      z += shape * x(i, 2);
    }
    Eigen::Matrix<double, 6, 6> plate = Eigen::Matrix<double, 6, 6>::Zero();  // Voigt strain of the plate strains
    for (int k = 0; k < 3; ++k) {
      constexpr std::array<int, 3> kInPlane{0, 1, 5};
      plate(kInPlane[static_cast<std::size_t>(k)], k) = 1;
      plate(kInPlane[static_cast<std::size_t>(k)], k + 3) = z;
    }
    const Eigen::Matrix<double, 6, 6> stress = det * stiffness * plate;
    const Eigen::Matrix<double, 6, kModes> of_modes = b.template rightCols<kModes>();
    loads.noalias() += b.transpose() * stress;
    terms.own.noalias() += plate.transpose() * stress;
    modes.noalias() += of_modes.transpose() * (det * stiffness * b);
  });
  const Eigen::Matrix<double, kModes, kModes> own_modes = modes.template rightCols<kModes>();
  const Eigen::Matrix<double, kModes, 6> moved = own_modes.inverse() * loads.template bottomRows<kModes>();
  terms.loads = loads.template topRows<kDofs>() - modes.template leftCols<kDofs>().transpose() * moved;
  terms.own -= loads.template bottomRows<kModes>().transpose() * moved;
  return terms;
}

}  // namespace strandlab::statics
