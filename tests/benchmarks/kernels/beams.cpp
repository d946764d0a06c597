// SPDX-License-Identifier: GPL-3.0-or-later
// Forces of beams between nodes: dynamics/structure/beam_bonds.hpp.
#include "dynamics/structure/beam_bonds.hpp"
#include "geometry/mesh/generate/lattice.hpp"
#include "tests/benchmarks/kernels/run_over.hpp"
#include "tests/benchmarks/kernels/subjects.hpp"
#include "tests/support/seeded_random.hpp"

#include <string>

namespace plekton::benchmarks {
namespace {

using dynamics::BeamBond;
using geometry::Quat;
using geometry::Vec3;

/// A geogrid of 10 cm, its bars 1 mm thick, that was bent at random.
class BentGrid {
 public:
  /// @param apertures  along either side
  /// @param strain     by what part of a bar's length each node is off its place, and by what angle
  ///                   (rad) it is turned
  BentGrid(int apertures, double strain)
      : state_(at_rest(apertures)),
        bonds_(bonds_of(apertures, state_), state_.size()),
        forces_(state_.size()) {
    test::Random random(1);
    const double length = 0.1 / apertures / kDivisions;
    for (std::size_t i = 0; i < state_.size(); ++i) {
      state_.position[i] += strain * length * random.in_cube(1.0);
      const Vec3 axis = random.direction();
      state_.orientation[i] = Eigen::AngleAxisd(random.uniform(-strain, strain), axis);
    }
  }

  std::size_t bond_count() const { return bonds_.size(); }

  void step() {
    bonds_.advance(state_, pool_);
    bonds_.add_forces(forces_, pool_);
  }

 private:
  static constexpr int kDivisions = 4;

  static geometry::Lattice grid(int apertures) {
    const double pitch = 0.1 / apertures;
    return geometry::biaxial_geogrid({pitch, pitch, apertures, apertures, kDivisions});
  }
  static dynamics::NodeState at_rest(int apertures) {
    dynamics::NodeState state;
    state.position = grid(apertures).points;
    state.velocity.assign(state.position.size(), Vec3::Zero());
    state.angular_velocity.assign(state.position.size(), Vec3::Zero());
    state.orientation.assign(state.position.size(), Quat::Identity());
    return state;
  }
  static std::vector<BeamBond> bonds_of(int apertures, const dynamics::NodeState& state) {
    const auto section = dynamics::circular_section(5e-4, 1e9, 0.3);
    std::vector<BeamBond> bonds;
    for (const auto& edge : grid(apertures).edges)
      bonds.push_back(dynamics::make_beam(edge.nodes[0], edge.nodes[1], state, section));
    return bonds;
  }

  dynamics::NodeState state_;
  dynamics::BeamBonds bonds_;
  contact::NodeForces forces_;
  geometry::ThreadPool pool_;
};

}  // namespace

void add_beams() {
  for (const int apertures : {10, 100}) {
    for (const bool far_bent : {false, true}) {
      const std::string name = far_bent ? "beam/far_bent/" : "beam/little_bent/";
      const double strain = far_bent ? 0.5 : 1e-3;
      // Ribs and bars, each of as many parts between junctions.
      const int bonds = 2 * 4 * apertures * (apertures + 1);
      add_benchmark(name + std::to_string(bonds), [=](benchmark::State& state) {
        BentGrid bent(apertures, strain);
        run_steps(state, bent.bond_count(), [&] { bent.step(); });
      });
    }
  }
}

}  // namespace plekton::benchmarks
