// SPDX-License-Identifier: GPL-3.0-or-later
// A step of the integrator: dynamics/integrators/leapfrog.hpp.
#include "dynamics/integrators/leapfrog.hpp"

#include "tests/benchmarks/kernels/run_over.hpp"
#include "tests/benchmarks/kernels/subjects.hpp"
#include "tests/support/seeded_random.hpp"

#include <array>
#include <string>

namespace plekton::benchmarks {
namespace {

using dynamics::Held;
using dynamics::NodeForces;
using dynamics::NodeProperties;
using dynamics::NodeState;
using geometry::Quat;
using geometry::Vec3;

constexpr double kTimeStep = 4e-6;  // s

/// Nodes in free flight, some of them held; balls of about 1 mm of 2500 kg/m³.
class FlyingNodes {
 public:
  FlyingNodes(std::size_t count, double held_share) {
    test::Random random(1);
    for (std::size_t i = 0; i < count; ++i) {
      state_.position.push_back(random.in_cube(1.0));
      state_.velocity.push_back(random.in_cube(1.0));
      state_.angular_velocity.push_back(random.in_cube(1e2));
      state_.orientation.emplace_back(random.rotation());
      const double mass = random.uniform(0.5e-5, 1.5e-5);
      properties_.mass.push_back(mass);
      properties_.inertia.push_back(0.4e-6 * mass);
      properties_.held.push_back(random.unit() < held_share ? Held::everything : Held::nothing);
      // 100 g, and torques that change the spin as much in units of the radius
      const Vec3 force = mass * random.in_cube(1e3);
      const Vec3 torque = 1e-3 * mass * random.in_cube(1e3);
      for (std::size_t k = 0; k < 2; ++k) {
        forces_[k].force.push_back(k == 0 ? force : Vec3(-force));
        forces_[k].torque.push_back(k == 0 ? torque : Vec3(-torque));
      }
    }
  }

  /// The forces turn round at every step, so that velocities stay as they are however long this
  /// goes on.
  void step(const dynamics::MotionOptions& options) {
    benchmark::DoNotOptimize(
        scheme_.step(state_, forces_[turn_], properties_, options, {kTimeStep, kTimeStep}, pool_));
    turn_ = 1 - turn_;
  }

 private:
  NodeState state_;
  NodeProperties properties_;
  std::array<NodeForces, 2> forces_;
  std::size_t turn_ = 0;
  dynamics::Leapfrog scheme_;
  geometry::ThreadPool pool_;
};

void add_nodes(const std::string& name, double damping, double held_share) {
  for (const std::size_t count : {std::size_t{1000}, std::size_t{100000}}) {
    add_benchmark("leapfrog/" + name + "/" + std::to_string(count), [=](benchmark::State& state) {
      FlyingNodes nodes(count, held_share);
      const dynamics::MotionOptions options{Vec3::Zero(), damping, true};
      run_steps(state, count, [&] { nodes.step(options); });
    });
  }
}

}  // namespace

void add_leapfrog() {
  add_nodes("free", 0.0, 0.0);
  add_nodes("damped", 0.2, 0.0);
  add_nodes("one_in_ten_held", 0.0, 0.1);
}

}  // namespace plekton::benchmarks
