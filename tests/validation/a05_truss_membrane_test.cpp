// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/beam_bonds.hpp"
#include "geometry/mesh/generate/generators.hpp"
#include "tests/support/beam_structure.hpp"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

namespace plekton::test::a05_truss_membrane_test {
namespace {

using dynamics::Held;
using geometry::index_of;
using geometry::Mat3;

constexpr double kRadius = 0.01;            // m
constexpr double kModulus = 1e7;            // Pa
constexpr double kLoad = 50.0;              // N, downward on the node in the middle
constexpr double kReference = -0.06961598;  // m, minimised energy of the same lattice (y11)
constexpr std::size_t kMiddle = 40;

/// Square membrane of 1 m, 8 x 8 cells of two facets, cut the other way by turns; bars along all
/// edges, nodes at the sides fixed, no node turns.
Scene truss_membrane() {
  Scene scene;
  const geometry::Mesh mesh = geometry::plane_sheet({1.0, 1.0, 8, 8});
  for (const Vec3& x : mesh.points) {
    const bool fixed = x.head<2>().cwiseAbs().maxCoeff() > 0.5 - 1e-9;
    scene.add_node(x, fixed ? Held::everything : Held::rotation);
  }
  std::set<std::pair<NodeId, NodeId>> edges;
  for (const auto& facet : mesh.facets) {
    for (std::size_t i = 0; i < 3; ++i) edges.insert(std::minmax(facet[i], facet[(i + 1) % 3]));
  }
  for (const auto& [a, b] : edges)
    scene.add_beam(a, b, dynamics::bar_section(kRadius, kModulus), 1000.0);
  return scene;
}

/// - d force / d position (N/m) of all bars, without what slack bars would take off it.
Eigen::MatrixXd stiffness_of(const Scene& scene) {
  const auto size = static_cast<Eigen::Index>(3 * scene.state.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  for (const dynamics::BeamBond& bar : scene.bonds) {
    const auto a = static_cast<Eigen::Index>(3 * index_of(bar.nodes[0]));
    const auto b = static_cast<Eigen::Index>(3 * index_of(bar.nodes[1]));
    const Vec3 chord =
        scene.state.position[index_of(bar.nodes[1])] - scene.state.position[index_of(bar.nodes[0])];
    const double length = chord.norm();
    const Vec3 n = chord / length;
    const double stiffness = bar.section.young_modulus * bar.section.area / bar.length;
    const double across = std::max(0.0, stiffness * (length - bar.length) / length);
    const Mat3 k = across * Mat3::Identity() + ((stiffness - across) * n) * n.transpose();
    matrix.block<3, 3>(a, a) += k;
    matrix.block<3, 3>(b, b) += k;
    matrix.block<3, 3>(a, b) -= k;
    matrix.block<3, 3>(b, a) -= k;
  }
  return matrix;
}

/// Newton's method with the forces of the library; a flat membrane has no stiffness across itself,
/// so the first steps have some put on the diagonal.
void balance_truss(Scene& scene) {
  dynamics::BeamBonds bonds(scene.bonds, scene.state.size());
  for (int iteration = 0; iteration < 300; ++iteration) {
    const Eigen::VectorXd all = bond_forces(bonds, scene.state);
    Eigen::MatrixXd matrix = stiffness_of(scene);
    Eigen::VectorXd force(matrix.rows());
    for (std::size_t i = 0; i < scene.state.size(); ++i)
      force.segment<3>(static_cast<Eigen::Index>(3 * i)) = all.segment<3>(first_entry(i));
    force[3 * kMiddle + 2] -= kLoad;
    matrix.diagonal().array() += iteration < 30 ? 100.0 : 1e-6;  // N/m; a bar has 25 000
    for (std::size_t i = 0; i < scene.state.size(); ++i) {
      if (!holds_translation(scene.properties.held[i])) continue;
      const auto k = static_cast<Eigen::Index>(3 * i);
      matrix.middleRows<3>(k).setZero();
      matrix.middleCols<3>(k).setZero();
      matrix.block<3, 3>(k, k).setIdentity();
      force.segment<3>(k).setZero();
    }
    const Eigen::VectorXd change = matrix.ldlt().solve(force);
    const double share = std::min(1.0, 0.01 / change.lpNorm<Eigen::Infinity>());
    for (std::size_t i = 0; i < scene.state.size(); ++i)
      scene.state.position[i] += share * change.segment<3>(static_cast<Eigen::Index>(3 * i));
    if (change.lpNorm<Eigen::Infinity>() < 1e-12) return;
  }
  FAIL() << "the truss does not come to rest";
}

/// The same membrane without anything of the library: its bars, energies and their least sum are of
/// this test alone.
class LeastEnergy {
 public:
  LeastEnergy() {
    for (int j = 0; j <= kCells; ++j) {
      for (int i = 0; i <= kCells; ++i) {
        x_.emplace_back(static_cast<double>(i) / kCells - 0.5,
                        static_cast<double>(j) / kCells - 0.5, 0.0);
        is_free_.push_back(i > 0 && i < kCells && j > 0 && j < kCells);
      }
    }
    for (int j = 0; j <= kCells; ++j) {
      for (int i = 0; i <= kCells; ++i) {
        if (i < kCells) add_bar(i, j, i + 1, j);
        if (j < kCells) add_bar(i, j, i, j + 1);
        if (i == kCells || j == kCells) continue;
        if ((i + j) % 2 == 0) add_bar(i, j, i + 1, j + 1);
        if ((i + j) % 2 == 1) add_bar(i + 1, j, i, j + 1);
      }
    }
  }

  const std::vector<Vec3>& nodes() const { return x_; }

  /// J: sum of k (L - L0)² / 2 with k = E A / L0, and the load's.
  double energy(const std::vector<Vec3>& x) const {
    double sum = kLoad * x[kMiddle].z();
    for (const Bar& bar : bars_) {
      const double longer = (x[bar.b] - x[bar.a]).norm() - bar.length;
      sum += 0.5 * bar.stiffness * longer * longer;
    }
    return sum;
  }

  /// Newton's method on the energy, with what makes its second derivatives positive on the
  /// diagonal, less after every step that lowers it and more after one that does not (Levenberg,
  /// Marquardt).
  void minimise() {
    // Off the plane, where all second derivatives across it are 0.
    for (std::size_t i = 0; i < x_.size(); ++i)
      if (is_free_[i]) x_[i].z() = -0.01;
    double damping = 100.0;  // N/m
    for (int iteration = 0; iteration < 1000; ++iteration) {
      const auto [gradient, second] = derivatives();
      // 1e-9 N over the softest way the net has to move, some 100 N/m: 1e-11 m.
      if (gradient.lpNorm<Eigen::Infinity>() < 1e-9) return;
      Eigen::MatrixXd damped = second;
      damped.diagonal().array() += damping;
      const Eigen::LLT<Eigen::MatrixXd> factors(damped);
      std::vector<Vec3> there = x_;
      if (factors.info() == Eigen::Success) {
        const Eigen::VectorXd change = -factors.solve(gradient);
        for (std::size_t i = 0; i < x_.size(); ++i) there[i] += change.segment<3>(entry(i));
      }
      const double now = energy(x_);
      // Near the least the energy falls by less than it is rounded by.
      const bool is_lower = energy(there) <= now + 1e-14 * std::abs(now);
      if (factors.info() == Eigen::Success && is_lower) {
        x_ = there;
        damping *= 0.3;
      } else {
        damping *= 4.0;
      }
    }
    FAIL() << "the least energy is not found";
  }

 private:
  static constexpr int kCells = 8;
  struct Bar {
    std::size_t a;
    std::size_t b;
    double length;     ///< m, at rest
    double stiffness;  ///< N/m
  };

  void add_bar(int i0, int j0, int i1, int j1) {
    const auto node = [](int i, int j) { return static_cast<std::size_t>(j * (kCells + 1) + i); };
    const std::size_t a = node(i0, j0), b = node(i1, j1);
    const double length = (x_[b] - x_[a]).norm();
    bars_.push_back({a, b, length, kModulus * std::numbers::pi * kRadius * kRadius / length});
  }
  static Eigen::Index entry(std::size_t node) { return static_cast<Eigen::Index>(3 * node); }

  /// Of the energy; where a node is fixed 0, and 1 on the diagonal.
  std::pair<Eigen::VectorXd, Eigen::MatrixXd> derivatives() const {
    const Eigen::Index size = entry(x_.size());
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(size);
    Eigen::MatrixXd second = Eigen::MatrixXd::Zero(size, size);
    gradient[entry(kMiddle) + 2] = kLoad;
    for (const Bar& bar : bars_) {
      const Vec3 chord = x_[bar.b] - x_[bar.a];
      const double length = chord.norm();
      const Vec3 n = chord / length;
      const double across = bar.stiffness * (1.0 - bar.length / length);
      const Mat3 k = across * Mat3::Identity() + ((bar.stiffness - across) * n) * n.transpose();
      const Vec3 pull = bar.stiffness * (length - bar.length) * n;
      const std::array<std::pair<std::size_t, double>, 2> ends{{{bar.a, -1.0}, {bar.b, 1.0}}};
      for (const auto& [p, sign_p] : ends) {
        if (!is_free_[p]) continue;
        gradient.segment<3>(entry(p)) += sign_p * pull;
        for (const auto& [q, sign_q] : ends)
          if (is_free_[q]) second.block<3, 3>(entry(p), entry(q)) += sign_p * sign_q * k;
      }
    }
    for (std::size_t i = 0; i < x_.size(); ++i)
      if (!is_free_[i]) second.block<3, 3>(entry(i), entry(i)).setIdentity();
    return {gradient, second};
  }

  std::vector<Vec3> x_;
  std::vector<char> is_free_;
  std::vector<Bar> bars_;
};

TEST(A05TrussMembrane, SagsUnderALoadAsItsLeastEnergySays) {
  Scene scene = truss_membrane();
  LeastEnergy least;
  // Both have their nodes row by row.
  ASSERT_EQ(scene.state.size(), least.nodes().size());
  for (std::size_t i = 0; i < least.nodes().size(); ++i)
    ASSERT_LT((scene.state.position[i] - least.nodes()[i]).norm(), 1e-15) << i;

  balance_truss(scene);
  least.minimise();

  double error = 0.0;
  for (std::size_t i = 0; i < least.nodes().size(); ++i) {
    error = std::max(error, (scene.state.position[i] - least.nodes()[i]).norm());
    EXPECT_LT((scene.state.position[i] - least.nodes()[i]).norm(), 1e-6) << i;
  }
  std::printf("truss membrane: z = %.9f m, reference %.8f m; nodes within %.1e m\n",
              scene.state.position[kMiddle].z(), kReference, error);
  EXPECT_NEAR(scene.state.position[kMiddle].z(), kReference, 1e-6);
  EXPECT_NEAR(least.nodes()[kMiddle].z(), kReference, 1e-6);
}

}  // namespace
}  // namespace plekton::test::a05_truss_membrane_test
