// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Dense>

#include <array>
#include <cmath>

namespace plekton::test {

/// Deflection w / t of the middle of a clamped circular plate, its rim immovable, under a load q:
/// von Karman's plate by Ritz's method, w = (1 - r²)² sum a_k r^2k, u = r (1 - r²) sum b_k r^2k,
/// with the lengths over a and t. Eight terms each agree with ten to 1e-6 up to w = 3 t.
/// @param load  q a⁴ / (D t); small loads give load / 64
class ClampedPlate {
 public:
  explicit ClampedPlate(double poisson_ratio) : nu_(poisson_ratio) {
    constexpr auto kPoints = static_cast<int>(std::tuple_size_v<decltype(points_)>);
    for (int i = 0; i < kPoints; ++i) {
      // Midpoints: the integrands are polynomials of degree below 80, error below 1e-5.
      const double r = (i + 0.5) / kPoints;
      Point& p = points_[static_cast<std::size_t>(i)];
      p.weight = r / kPoints;
      p.r = r;
      const double s = 1.0 - r * r;
      for (int k = 0; k < kTerms; ++k) {
        const double power = std::pow(r, 2 * k);
        const int n = 2 * k;
        p.w[k] = s * s * power;
        // (1 - r²)² r^n = r^n - 2 r^(n+2) + r^(n+4), and r (1 - r²) r^n = r^(n+1) - r^(n+3)
        p.dw[k] = n * power / r - 2.0 * (n + 2) * power * r + (n + 4) * power * r * r * r;
        p.ddw[k] = n * (n - 1) * power / (r * r) - 2.0 * (n + 2) * (n + 1) * power +
                   (n + 4) * (n + 3) * power * r * r;
        p.u[k] = r * s * power;
        p.du[k] = (n + 1) * power - (n + 3) * power * r * r;
      }
    }
  }

  double middle(double load) const {
    Vector c = Vector::Zero();
    for (int step = 1; step <= 20; ++step) {
      for (int iteration = 0; iteration < 30; ++iteration) {
        Matrix hessian = Matrix::Zero();
        const Vector gradient = add(c, load * step / 20, hessian);
        const Vector change = hessian.completeOrthogonalDecomposition().solve(-gradient);
        c += change;
        if (change.norm() < 1e-12) break;
      }
    }
    return c[0];
  }

 private:
  static constexpr int kTerms = 8;
  using Shape = Eigen::Matrix<double, kTerms, 1>;
  using Vector = Eigen::Matrix<double, 2 * kTerms, 1>;
  using Matrix = Eigen::Matrix<double, 2 * kTerms, 2 * kTerms>;
  struct Point {
    double r, weight;
    Shape w, dw, ddw, u, du;
  };

  /// Gradient of the energy; D = t = a = 1, so E t / (1 - nu²) = 12.
  Vector add(const Vector& c, double load, Matrix& hessian) const {
    Vector gradient = Vector::Zero();
    for (const Point& p : points_) {
      const Shape a = c.head<kTerms>(), b = c.tail<kTerms>();
      const double slope = p.dw.dot(a);
      Eigen::Matrix<double, 2 * kTerms, 4> rows;  // two strains, two curvatures
      rows << slope * p.dw, Shape::Zero(), p.ddw, p.dw / p.r, p.du, p.u / p.r, Shape::Zero(),
          Shape::Zero();
      const Eigen::Vector4d measures(p.du.dot(b) + 0.5 * slope * slope, p.u.dot(b) / p.r,
                                     p.ddw.dot(a), p.dw.dot(a) / p.r);
      Eigen::Matrix4d elastic = Eigen::Matrix4d::Zero();
      elastic.topLeftCorner<2, 2>() << 12.0, 12.0 * nu_, 12.0 * nu_, 12.0;
      elastic.bottomRightCorner<2, 2>() << 1.0, nu_, nu_, 1.0;
      const Eigen::Vector4d forces = elastic * measures;
      gradient += p.weight * (rows * forces);
      gradient.head<kTerms>() -= p.weight * load * p.w;
      hessian += p.weight * (rows * elastic * rows.transpose());
      hessian.topLeftCorner<kTerms, kTerms>() += p.weight * forces[0] * (p.dw * p.dw.transpose());
    }
    return gradient;
  }

  double nu_;
  std::array<Point, 400> points_;
};

}  // namespace plekton::test
