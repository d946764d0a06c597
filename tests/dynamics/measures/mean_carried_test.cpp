// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/mean_carried.hpp"

#include "contact/contact_model.hpp"
#include "dynamics/model/contact_scene.hpp"
#include "dynamics/state/rigid_nodes.hpp"
#include "dynamics/structure/beam_bonds.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace plekton::dynamics::mean_carried_test {
namespace {

constexpr double kRadius = 0.1;  // m

TEST(MeanMagnitude, IsZeroOfNone) {
  EXPECT_EQ(MeanMagnitude().value(), 0.0);
}

/// Two bars of length 1 m, stretched by 1 and 3 mm, of EA/L = 1e5 N/m, and a grain that presses on a
/// floor.
class MeanCarried : public testing::Test {
 protected:
  MeanCarried() {
    scene_.materials = {{1e6, 0.3, 0.5}};
    for (int i = 0; i < 4; ++i) scene_.add_node(Vec3(i, 0, 5), Held::rotation);
    const BeamSection bar{1e8, 5e7, 1e-3, 0.0, 0.0};
    scene_.add_beam(NodeId{0}, NodeId{1}, bar, 1000.0);
    scene_.add_beam(NodeId{2}, NodeId{3}, bar, 1000.0);
    scene_.state.position[1].x() += 1e-3;
    scene_.state.position[3].x() += 3e-3;
    scene_.add_sphere(Vec3(0, 0, 0.99 * kRadius), kRadius, 2600.0, contact::MaterialId{0});
    scene_.planes.push_back({Vec3::Zero(), Vec3::UnitZ()});
  }

  double mean(bool is_first_broken) {
    BeamBonds bonds(scene_.bonds, scene_.state.size());
    if (is_first_broken) bonds.break_bond(0);
    const YieldingBonds yielding({}, scene_.bonds);
    const SheetFacets sheets({}, scene_.state.size());
    const Ties ties(scene_);
    const AppliedLoads loads(scene_);
    const RigidNodes rigid;
    const geometry::Surface surface({}, {}, scene_.state.size());
    const std::unique_ptr<contact::Contacts> contacts =
        contact::linear_frictional()(contact_scene(scene_, surface, 0.0, false));
    geometry::ThreadPool pool;
    NodeForces forces(scene_.state.size());
    contacts->advance(scene_.state.motion(), scene_.planes, 0.0, pool, forces);
    push_ = contacts->on_plane(0).force.norm();
    return mean_carried({scene_, surface, *contacts, bonds, yielding, sheets, ties, loads, rigid},
                        scene_.state);
  }

  Scene scene_;
  double push_ = 0.0;  ///< N, of the grain
};

TEST_F(MeanCarried, IsOfContactsAndBondsAlike) {
  const double carried = mean(false);
  EXPECT_GT(push_, 0.0);
  EXPECT_NEAR(carried, (100.0 + 300.0 + push_) / 3.0, 1e-9 * carried);
}

TEST_F(MeanCarried, LeavesOutWhatBroke) {
  const double carried = mean(true);
  EXPECT_NEAR(carried, (300.0 + push_) / 2.0, 1e-9 * carried);
}

TEST_F(MeanCarried, LeavesOutWhatIsNotThere) {
  scene_.is_absent.assign(scene_.state.size(), false);
  scene_.is_absent[2] = scene_.is_absent[3] = true;
  const double carried = mean(false);
  EXPECT_NEAR(carried, (100.0 + push_) / 2.0, 1e-9 * carried);
}

}  // namespace
}  // namespace plekton::dynamics::mean_carried_test
