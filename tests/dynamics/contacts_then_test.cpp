// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/contacts_then.hpp"

#include "contact/contact_model.hpp"
#include "dynamics/model/contact_scene.hpp"
#include "geometry/base/state_archive.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <stdexcept>

namespace plekton::dynamics::contacts_then_test {
namespace {

constexpr double kRadius = 0.1;    // m
constexpr double kOverlap = 1e-3;  // m
constexpr double kTime = 1e-2;     // s

/// A grain in a floor that it flies away from. Both were deeper in each other a while ago.
class ContactsThen : public testing::Test {
 protected:
  ContactsThen() {
    scene_.materials = {{1e6, 0.3, 0.5}};
    scene_.add_sphere(Vec3(0, 0, kRadius - kOverlap), kRadius, 2600.0, contact::MaterialId{0});
    scene_.state.velocity[0] = Vec3(0, 0, 0.05);
    scene_.planes.push_back({Vec3::Zero(), Vec3::UnitZ()});
    scene_.planes[0].velocity = Vec3(0, 0, 0.02);
    surface_ = geometry::Surface({}, {}, 1);
    contacts_ = contact::linear_frictional()(contact_scene(scene_, surface_, 0.0, false));
    NodeForces forces(1);
    contacts_->advance(scene_.state.motion(), scene_.planes, 0.0, pool_, forces);
  }

  double force() const { return contacts_->on_plane(0).force.norm(); }

  std::uint64_t state_hash() {
    geometry::StateTree tree;
    contacts_->exchange(geometry::StateArchive::writer(tree), scene_.planes, pool_);
    return tree.hash();
  }

  Scene scene_;
  geometry::Surface surface_;
  geometry::ThreadPool pool_;
  std::unique_ptr<contact::Contacts> contacts_;
};

TEST_F(ContactsThen, AreThoseOfWhereNodesAndPlanesWere) {
  const double now = force();
  double then = 0.0;
  contacts_then(*contacts_, scene_, kTime, pool_, [&] { then = force(); });
  // The linear law: in proportion to the overlap.
  EXPECT_GT(now, 0.0);
  const double deeper = kTime * (0.05 - 0.02);
  EXPECT_NEAR(then / now, (kOverlap + deeper) / kOverlap, 1e-9);
}

TEST_F(ContactsThen, AreLeftAsTheyWere) {
  const std::uint64_t before = state_hash();
  contacts_then(*contacts_, scene_, kTime, pool_, [] {});
  EXPECT_EQ(state_hash(), before);
  EXPECT_THROW(
      contacts_then(*contacts_, scene_, kTime, pool_, [] { throw std::runtime_error("looked"); }),
      std::runtime_error);
  EXPECT_EQ(state_hash(), before);
}

}  // namespace
}  // namespace plekton::dynamics::contacts_then_test
