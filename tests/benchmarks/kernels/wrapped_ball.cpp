// SPDX-License-Identifier: GPL-3.0-or-later
// A ball wrapped in a net to beyond its equator, as a boulder is that a net has caught: what one
// contact costs that spreads over hundreds of bars (tests/validation/README.md, S1).
#include "contact/sphere_surface/surface_contacts.hpp"
#include "tests/benchmarks/kernels/run_over.hpp"
#include "tests/benchmarks/kernels/subjects.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace plekton::benchmarks {
namespace {

using contact::MaterialId;
using geometry::NodeId;
using geometry::Vec3;

constexpr double kPitch = 0.058;         // m, of the net, along great circles
constexpr double kWireRadius = 0.00135;  // m
constexpr double kOverlap = 1e-3;        // m, at the nodes
constexpr double kWay = 5e-6;            // m, of the ball in a step
constexpr int kStepsOneWay = 50;

/// A square net whose middle lines run round half of a ball about the origin: every node lies as
/// far from the bottom along a great circle as it lies from the middle of the flat net.
class WrappedBall {
 public:
  explicit WrappedBall(int meshes)
      : radius_(kPitch * meshes / std::numbers::pi), bars_(bars_of(meshes)), x_(nodes_of(meshes)) {
    const NodeId ball = geometry::id_at<NodeId>(x_.size());
    x_.push_back(Vec3::Zero());
    still_.assign(x_.size(), Vec3::Zero());
    velocity_ = still_;
    velocity_.back() = kWay * Vec3(0.6, 0.48, 0.64);
    spheres_.push_back({{ball}, radius_});
    surface_ = geometry::Surface(bars_, {}, x_.size());
    geometry::Neighbours neighbours(spheres_, surface_, 4.0 * kStepsOneWay * kWay);
    neighbours.update(x_, pool_);
    const std::vector<contact::SphereBody> balls{{ball, radius_, MaterialId{0}}};
    const std::vector<MaterialId> of_structures(surface_.structure_count(), MaterialId{0});
    contacts_.rebuild(neighbours.sphere_structures(), neighbours.near_cells(), neighbours.cells(),
                      balls, of_structures, contact::MaterialPairs({{1e6, 0.5, 0.4}}));
    forces_ = contact::NodeForces(x_.size());
  }
  WrappedBall(const WrappedBall&) = delete;
  WrappedBall& operator=(const WrappedBall&) = delete;

  std::size_t bars() const noexcept { return bars_.size(); }
  std::size_t patches() const noexcept { return contacts_.touching(); }

  /// To and fro. Forces add up over the steps; nothing follows them. A step lasts 1 s.
  void step() {
    if (steps_++ % kStepsOneWay == 0) velocity_.back() = -velocity_.back();
    x_.back() += velocity_.back();
    contacts_.advance({x_, velocity_, still_, kWay}, 1.0, pool_);
    contacts_.add_forces(forces_, pool_);
  }

 private:
  static int id(int meshes, int i, int j) { return j * (meshes + 1) + i; }

  static std::vector<geometry::Cylinder> bars_of(int meshes) {
    std::vector<geometry::Cylinder> bars;
    for (int i = 0; i <= meshes; ++i) {
      for (int j = 0; j < meshes; ++j) {
        bars.push_back({{NodeId{id(meshes, i, j)}, NodeId{id(meshes, i, j + 1)}}, kWireRadius});
        bars.push_back({{NodeId{id(meshes, j, i)}, NodeId{id(meshes, j + 1, i)}}, kWireRadius});
      }
    }
    return bars;
  }
  std::vector<Vec3> nodes_of(int meshes) const {
    std::vector<Vec3> x;
    for (int j = 0; j <= meshes; ++j) {
      for (int i = 0; i <= meshes; ++i) {
        const Vec3 flat = kPitch * Vec3(i - 0.5 * meshes, j - 0.5 * meshes, 0.0);
        const double angle = flat.norm() / radius_;
        const Vec3 aside = angle > 0.0 ? Vec3(flat.normalized()) : Vec3(Vec3::Zero());
        x.push_back((radius_ + kWireRadius - kOverlap) *
                    (std::sin(angle) * aside - std::cos(angle) * Vec3::UnitZ()));
      }
    }
    return x;
  }

  double radius_;  ///< m
  std::vector<geometry::Cylinder> bars_;
  std::vector<Vec3> x_;  ///< m, the ball is the last node
  std::vector<Vec3> still_;
  std::vector<Vec3> velocity_;
  std::vector<geometry::Sphere> spheres_;
  geometry::Surface surface_;
  contact::SurfaceContacts contacts_{surface_};
  contact::NodeForces forces_{0};
  geometry::ThreadPool pool_;
  std::int64_t steps_ = 0;
};

}  // namespace

void add_wrapped_balls() {
  for (const int meshes : {13, 27}) {
    add_benchmark("wrap/ball_in_" + std::to_string(2 * meshes * (meshes + 1)) + "_bars",
                  [meshes](benchmark::State& state) {
                    WrappedBall ball(meshes);
                    run_steps(state, ball.bars(), [&] { ball.step(); });
                    state.counters["patches"] = static_cast<double>(ball.patches());
                  });
  }
}

}  // namespace plekton::benchmarks
