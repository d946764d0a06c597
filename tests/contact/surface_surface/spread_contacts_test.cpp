// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/spread_contacts.hpp"

#include "tests/support/bodies_of_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

/// Friction of sheets that lie on each other is a field.
namespace plekton::test::spread_contacts_test {
namespace {

constexpr double kRange = 0.02;
constexpr double kOverlap = 1e-4;
constexpr double kFriction = 0.5;
constexpr double kRadius = 0.3;

/// A disc in the plane z = 0: rings of 6 k nodes about its centre.
Body disc(int rings, double radius) {
  Body body;
  body.x.emplace_back(0.0, 0.0, 0.0);
  const auto first_of = [](int ring) { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1); };
  for (int ring = 1; ring <= rings; ++ring) {
    for (int i = 0; i < 6 * ring; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / (6 * ring);
      const double r = radius * ring / rings;
      body.x.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.0);
    }
  }
  for (int ring = 1; ring <= rings; ++ring) {
    const auto outer = [&](int i) { return first_of(ring) + i % (6 * ring); };
    const auto inner = [&](int i) {
      return ring == 1 ? 0 : first_of(ring - 1) + i % (6 * (ring - 1));
    };
    for (int sector = 0; sector < 6; ++sector) {
      for (int i = 0; i < ring; ++i) {
        const int o = sector * ring + i, n = sector * (ring - 1) + i;
        body.facets.push_back({inner(n), outer(o), outer(o + 1)});
        if (i + 1 < ring) body.facets.push_back({inner(n), outer(o + 1), inner(n + 1)});
      }
    }
  }
  return body;
}

struct Turned {
  double normal_force;
  Vec3 force;
  double torque;  ///< about the axis
};

/// A disc that lies flat on a sheet and is turned about an axis until all of it slips.
Turned turn(double off_centre) {
  const Body b = disc(6, kRadius);
  StructurePairUnder<contact::LinearFrictional> structure_pair(
      sheet(5, 5, 1.4, 1.4, Cut::alternating, 3), b, kRange, {}, 1.0, kFriction);
  const Vec3 axis(off_centre, 0.0, 0.0);
  const Vec3 lift(0.03, 0.02, kRange - kOverlap);
  const auto turned = [&](double angle) {
    Body placed = moved(b, Vec3::Zero(), -axis);
    return moved(placed, {0.0, 0.0, angle}, axis + lift);
  };
  structure_pair.place(turned(0.0));
  // A spring slips after friction * overlap: everything but the axis itself is far beyond that.
  for (int i = 1; i <= 200; ++i) structure_pair.slide(turned(1e-3 * i));
  return {structure_pair.force_on_b().z(), structure_pair.force_on_b(),
          structure_pair.moment_on_b(axis + lift).z()};
}

// Two thirds of the radius is the mean arm of a disc: torque 2/3 mu N R.
TEST(SpreadFriction, ResistsTheTurnOfADiscAboutItsCentre) {
  const Turned found = turn(0.0);

  const double limit = kFriction * found.normal_force;
  EXPECT_NEAR(-found.torque / (limit * kRadius), 2.0 / 3.0, 0.05 * 2.0 / 3.0);
  EXPECT_LT(found.force.head<2>().norm(), 0.02 * limit);
}

// Integrals over the disc of the unit vectors across the arms from an axis 0.3 R off: a resultant
// of 0.297 mu N, and 0.622 mu N R about the centre (numerical quadrature of 1e6 points).
TEST(SpreadFriction, ResistsTheTurnOfADiscAboutAnAxisBesideItsCentre) {
  const Turned found = turn(0.3 * kRadius);

  const double limit = kFriction * found.normal_force;
  const double resultant = found.force.head<2>().norm();
  EXPECT_NEAR(resultant / limit, 0.297, 0.05 * 0.297);
  // About the centre, at (-0.3 R, 0) from the axis: the disc is turned by 0.2 there.
  const Vec3 arm = 0.3 * kRadius * Vec3(std::cos(0.2), std::sin(0.2), 0.0);
  const double about_centre = found.torque + arm.cross(found.force).z();
  EXPECT_NEAR(-about_centre / (limit * kRadius), 0.622, 0.05 * 0.622);
}

// Half of what would move it: nothing slips, and what is put in comes back.
TEST(SpreadFriction, GivesBackWhatIsPutInBelowItsLimit) {
  const Body b = sheet(4, 4, 0.4, 0.4);
  StructurePairUnder<contact::LinearFrictional> structure_pair(
      sheet(5, 5, 1.4, 1.4, Cut::alternating, 3), b, kRange, {}, 1.0, kFriction);
  const auto at = [&](double x) {
    return moved(b, {0.0, 0.0, 0.1}, {0.03 + x, 0.02, kRange - kOverlap});
  };
  structure_pair.place(at(0.0));
  const double energy = structure_pair.energy();
  const double contacts = 0.4 * 0.4 / (kRange * kRange);
  const double way = 0.5 * kFriction * kOverlap;
  for (int i = 1; i <= 10; ++i) structure_pair.slide(at(0.1 * i * way));
  EXPECT_NEAR(structure_pair.force_on_b().x(), -contacts * way, 1e-3 * contacts * way);
  for (int i = 9; i >= 0; --i) structure_pair.slide(at(0.1 * i * way));
  EXPECT_NEAR(structure_pair.energy(), energy, 1e-6 * energy);
  EXPECT_LT(std::abs(structure_pair.force_on_b().x()), 1e-3 * contacts * way);
}

// What becomes of the springs of a field where its mesh, or its patches, change.

/// Two bodies with friction, k = 1 N/m in all directions, whose steps are taken one by one as
/// StructureContacts does, so that what is handed from the contacts of one step to those of the
/// next is seen by itself. Of every step is asked: no spring holds more than Coulomb's limit, and
/// what springs store is booked and does not grow by the hand-over, but where patches merge.
///
/// Where points of contact merge, c_i contacts with stretches s_i become C, which are fewer: they
/// are as many as have the force and the energy of all. Their spring keeps the force, sum c_i s_i,
/// and stores (sum c_i s_i)² / C, by Cauchy and Schwarz at most (sum c_i) / C of sum c_i s_i².
class HandedOver {
 public:
  HandedOver(
      const Body& a, const Body& b, double friction,
      const contact::AnyLaw::Properties& law = contact::AnyLaw::of<contact::LinearFrictional>({}))
      : count_a_(a.x.size()),
        materials_({contact::Material{2.0 / kRange, 1.0, friction}},
                   {{{contact::MaterialId{0}, contact::MaterialId{0}}, law}}),
        friction_(friction) {
    std::vector<Facet> facets;
    std::vector<Cylinder> cylinders;
    for (const Body* body : {&a, &b}) {
      const int first = static_cast<int>(x_.size());
      const auto node = [first](int i) { return NodeId{first + i}; };
      for (const auto& f : body->facets)
        facets.push_back({{node(f[0]), node(f[1]), node(f[2])}, 0.5 * kRange});
      for (const auto& c : body->cylinders)
        cylinders.push_back({{node(c[0]), node(c[1])}, 0.5 * kRange});
      x_.insert(x_.end(), body->x.begin(), body->x.end());
    }
    surface_ = std::make_unique<geometry::Surface>(cylinders, facets, x_.size());
    patches_ = std::make_unique<contact::structure::StructurePatches>(*surface_);
    neighbours_ = std::make_unique<geometry::CellNeighbours>(*surface_, x_, 0.0, false);
    rest_.assign(x_.size(), Vec3::Zero());
  }

  /// Puts b elsewhere, which its springs do not see, then moves it on by a slip (m) that they do.
  void step(const Body& b, const Vec3& slip = Vec3::Zero()) {
    for (std::size_t i = 0; i < b.x.size(); ++i) x_[count_a_ + i] = b.x[i];
    const double before = stored();
    const Vec3 force_before = force();
    contact::EnergyLoss loss = hand_over();
    const double handed = stored();
    const double growth = growth_of_merged();
    EXPECT_LE(handed, (1.0 + growth + kRounding) * before);
    EXPECT_NEAR(before - handed, loss.dissipated + loss.tracking, kRounding * before);
    EXPECT_GE(loss.dissipated, -kRounding * before);
    EXPECT_GE(loss.tracking, -(growth + kRounding) * before);
    if (before > 0.0) largest_growth_ = std::max(largest_growth_, handed / before - 1.0);

    // The limit alone, where pairs press less than they did, then the slip.
    double dissipated = apply_law(Vec3::Zero());
    EXPECT_GE(dissipated, -kRounding * handed);
    const Vec3 handed_force = force();
    largest_change_ = std::max(largest_change_, (handed_force - force_before).norm());
    const double at_limit = stored();
    dissipated = apply_law(slip);
    EXPECT_GE(dissipated, -kRounding * (at_limit + stored()));
    // Of a rigid slip: work of the mean force.
    const double work = -0.5 * (handed_force + force()).dot(slip);
    EXPECT_NEAR(stored() - at_limit, work - dissipated,
                kRounding * (stored() + at_limit + dissipated + std::abs(work)));
    expect_within_limits();
  }

  /// N, on b: of all springs.
  Vec3 force() {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < spread_.size(); ++i)
      sum += spread_[static_cast<std::int32_t>(i)].other_force;
    for (const auto& patch : patches_->patches()) sum += patch.other_force;
    return sum;
  }
  /// N, of the normal forces of all patches.
  double pressed() const {
    double sum = 0.0;
    for (const auto& patch : patches_->patches()) sum += patch.normal_force;
    return sum;
  }
  std::size_t patches() const { return patches_->patches().size(); }
  std::size_t springs() const { return spread_.size(); }
  /// J
  double stored() const {
    double energy = spread_.elastic_energy();
    for (const auto& patch : patches_->patches()) energy += patches_->history_energy(patch);
    return energy;
  }
  /// N, of the force on b by a hand-over and the limit, in any step since this was asked for.
  double largest_change() { return std::exchange(largest_change_, 0.0); }
  /// Part of what was stored that a hand-over has added to it, in any step.
  double largest_growth() const { return largest_growth_; }

 private:
  /// Sums over some hundred springs, each with some ten operations.
  static constexpr double kRounding = 1e-12;

  contact::EnergyLoss hand_over() {
    contact::EnergyLoss loss;
    if (neighbours_->update(x_, pool_)) {
      const std::vector<contact::MaterialId> of_structures(surface_->structure_count());
      loss.dissipated += patches_->rebuild(neighbours_->pairs(), {materials_, {}, of_structures});
      spread_.follow_list(*patches_);
    }
    const contact::Motion still{x_, rest_, rest_};
    counts_.clear();
    for (const auto& patch : patches_->patches()) counts_.push_back(patch.point_count());
    patches_->find(still, pool_);
    spread_.find(*patches_, x_, pool_);
    loss += patches_->transfer(still, 0.0);
    loss += spread_.carry(*patches_, still, 0.0);
    return loss;
  }
  /// Part of what is stored that patches that merge in this step may add, as derived above.
  double growth_of_merged() const {
    std::vector<double> before(patches(), 0.0);
    std::vector<int> predecessors(patches(), 0);
    for (std::uint32_t old = 0; old < counts_.size(); ++old) {
      for (const auto& successor : patches_->successors_of(old)) {
        before[successor.patch] += counts_[old];
        ++predecessors[successor.patch];
      }
    }
    double growth = 0.0;
    for (std::size_t i = 0; i < patches(); ++i) {
      const double now = patches_->patches()[i].point_count();
      if (predecessors[i] > 1 && now > 0.0) growth = std::max(growth, before[i] / now - 1.0);
    }
    return growth;
  }
  double apply_law(const Vec3& slip) {
    std::vector<Vec3> velocity = rest_;
    std::fill(velocity.begin() + static_cast<std::ptrdiff_t>(count_a_), velocity.end(), slip);
    const contact::Motion motion{x_, velocity, rest_};
    return patches_->apply_law(motion, 1.0) + spread_.apply_law(*patches_, motion, 1.0, pool_);
  }
  void expect_within_limits() {
    const auto within = [&](const Vec3& tangential, double normal_force) {
      EXPECT_LE(tangential.norm(), (1.0 + kRounding) * friction_ * normal_force);
    };
    for (std::size_t i = 0; i < spread_.size(); ++i) {
      const auto& spread = spread_[static_cast<std::int32_t>(i)];
      within(spread.other_force, spread.normal_force);
    }
    for (const auto& patch : patches_->patches())
      within(patch.other_force, patch.point_part * patch.normal_force);
  }

  std::size_t count_a_;
  contact::MaterialPairs materials_;
  double friction_;
  std::vector<Vec3> x_;
  std::vector<Vec3> rest_;
  geometry::ThreadPool pool_{1};
  std::unique_ptr<geometry::Surface> surface_;
  std::unique_ptr<contact::structure::StructurePatches> patches_;
  contact::structure::SpreadContacts spread_;
  std::unique_ptr<geometry::CellNeighbours> neighbours_;
  std::vector<double> counts_;  ///< of contacts, of the patches of the last step
  double largest_change_ = 0.0;
  double largest_growth_ = 0.0;
};

Body joined(Body a, const Body& b) {
  const int first = static_cast<int>(a.x.size());
  a.x.insert(a.x.end(), b.x.begin(), b.x.end());
  for (const auto& f : b.facets) a.facets.push_back({f[0] + first, f[1] + first, f[2] + first});
  for (const auto& c : b.cylinders) a.cylinders.push_back({c[0] + first, c[1] + first});
  return a;
}

/// A sheet of 1 m x 0.6 m, of whose right half the middle is cut out: two prongs on a bridge.
Body fork() {
  Body whole = sheet(10, 6, 1.0, 0.6, Cut::alternating, 3);
  std::erase_if(whole.facets, [&](const std::array<int, 3>& f) {
    Vec3 middle = Vec3::Zero();
    for (const int node : f) middle += whole.x[static_cast<std::size_t>(node)] / 3.0;
    return middle.x() > 0.0 && std::abs(middle.y()) < 0.1;
  });
  return whole;
}

/// Where b is, from 0 to 1.
using Path = std::function<Body(double)>;

/// Pulls b where it is, then takes it along a path in so many steps. Its springs do not see it go:
/// all that happens to them is that they are handed over.
void pull_and_carry(HandedOver& pair, const Path& path, const Vec3& pull, int steps) {
  pair.step(path(0.0));
  for (int i = 0; i < 10; ++i) pair.step(path(0.0), 0.1 * pull);
  pair.largest_change();
  for (int i = 1; i <= steps; ++i) pair.step(path(static_cast<double>(i) / steps));
}

/// The force changes in proportion to the step: four times as many, a quarter of the change, to 20
/// % of that.
/// @param steps  fine enough for that
void expect_continuous_force(const Body& a, const Path& path, const Vec3& pull, int steps) {
  HandedOver coarse(a, path(0.0), kFriction), fine(a, path(0.0), kFriction);
  pull_and_carry(coarse, path, pull, steps);
  pull_and_carry(fine, path, pull, 4 * steps);
  const double change = coarse.largest_change();
  EXPECT_GT(change, 0.0);
  EXPECT_LT(fine.largest_change(), 0.3 * change);
}

constexpr double kHeight = kRange - kOverlap;
/// m, at which a spring of its stiffness in all directions slips.
constexpr double kStretch = kFriction * kOverlap;

/// A sheet that goes from one plate onto two that do not touch each other.
struct OntoTwoPlates {
  Body plates = joined(
      joined(moved(sheet(5, 5, 1.0, 1.0, Cut::alternating, 3), Vec3::Zero(), {-0.525, 0.0, 0.0}),
             moved(sheet(4, 4, 1.0, 0.6, Cut::alternating, 4), Vec3::Zero(), {0.525, 0.31, 0.0})),
      moved(sheet(4, 4, 1.0, 0.6, Cut::alternating, 5), Vec3::Zero(), {0.525, -0.31, 0.0}));
  static Body at(double part) {
    return moved(sheet(4, 4, 0.4, 0.4), {0.0, 0.0, 0.1}, {-0.4 + 0.6 * part, 0.02, kHeight});
  }
};

TEST(SpreadFriction, IsHandedOverWithoutAJumpOrEnergyFromOnePlateToTwo) {
  const OntoTwoPlates scene;
  for (const double pull : {0.5, 1.5})
    expect_continuous_force(scene.plates, OntoTwoPlates::at, {pull * kStretch, 0.0, 0.0}, 100);
}

// All slip goes one way, by 12 stretches a step: springs that are new in a step are at their limit
// at its end like all others. The part of its area that a pair has of the whole goes with the way,
// so its force leans, by overlap * perimeter / (2 area): 5e-3 of one of 100 pairs (1.6e-3 m², 0.15
// m). Those of all pairs cancel, but their limits are greater by half the square of that.
TEST(SpreadFriction, IsAtItsLimitWhereASheetSlidesFromOnePlateOntoTwo) {
  const OntoTwoPlates scene;
  constexpr int kSteps = 1000;
  HandedOver pair(scene.plates, OntoTwoPlates::at(0.0), kFriction);
  std::size_t most = 0;
  for (int i = 0; i <= kSteps; ++i) {
    pair.step(OntoTwoPlates::at(static_cast<double>(i) / kSteps), {0.6 / kSteps, 0.0, 0.0});
    EXPECT_NEAR(pair.force().x(), -kFriction * pair.pressed(), 1.3e-5 * pair.pressed()) << i;
    most = std::max(most, pair.patches());
  }
  EXPECT_EQ(most, 3u);
}

// One patch on the bridge, two on the prongs.
TEST(SpreadFriction, IsHandedOverWithoutAJumpOrEnergyWherePatchesSplitAndMerge) {
  const Body strip = sheet(1, 5, 0.06, 0.5);
  const auto at = [&](double x) { return moved(strip, {0.0, 0.0, 0.02}, {x, 0.01, kHeight}); };
  const Path splits = [&](double part) { return at(-0.1 + 0.25 * part); };
  const Path merges = [&](double part) { return at(0.15 - 0.25 * part); };
  const Vec3 pull(0.5 * kStretch, 0.5 * kStretch, 0.0);

  for (const auto& [path, first, last] : {std::tuple{splits, 1u, 2u}, std::tuple{merges, 2u, 1u}}) {
    HandedOver pair(fork(), path(0.0), kFriction);
    pair.step(path(0.0));
    EXPECT_EQ(pair.patches(), first);
    pull_and_carry(pair, path, pull, 100);
    EXPECT_EQ(pair.patches(), last);
    expect_continuous_force(fork(), path, pull, 100);
  }
}

// A law without strength whose springs are kept as forces is the linear one, kept as slips.
TEST(SpreadFriction, IsHandedOverAlikeWhetherSpringsAreKeptAsForcesOrAsSlips) {
  const Body strip = sheet(1, 5, 0.06, 0.5);
  const auto at = [&](double x) { return moved(strip, {0.0, 0.0, 0.02}, {x, 0.01, kHeight}); };
  const OntoTwoPlates plates;
  const Path onto_two = OntoTwoPlates::at;
  const Path splits = [&](double part) { return at(-0.1 + 0.25 * part); };
  const Path merges = [&](double part) { return at(0.15 - 0.25 * part); };
  const Vec3 pull(0.5 * kStretch, 0.5 * kStretch, 0.0);

  for (const auto& [a, path] :
       {std::pair{fork(), splits}, std::pair{fork(), merges}, std::pair{plates.plates, onto_two}}) {
    HandedOver slips(a, path(0.0), kFriction);
    HandedOver forces(a, path(0.0), kFriction,
                      contact::AnyLaw::of<contact::CohesiveFrictional>({}));
    for (HandedOver* const pair : {&slips, &forces}) pull_and_carry(*pair, path, pull, 100);
    EXPECT_GT(slips.force().norm(), 0.0);
    EXPECT_LT((forces.force() - slips.force()).norm(), 1e-9 * slips.force().norm());
  }
}

// The same of a rod, whose bars hand on to those beside them.
TEST(SpreadFriction, OfBarsIsHandedOverWithoutAJumpOrEnergyWherePatchesSplitAndMerge) {
  const Body rod = moved(chain(4, 0.5), {0.0, 0.0, 0.5 * std::numbers::pi}, Vec3::Zero());
  const auto at = [&](double x) { return moved(rod, {0.0, 0.0, 0.02}, {x, 0.01, kHeight}); };
  const Path splits = [&](double part) { return at(-0.1 + 0.25 * part); };
  const Path merges = [&](double part) { return at(0.15 - 0.25 * part); };

  for (const Path& path : {splits, merges})
    expect_continuous_force(fork(), path, {0.5 * kStretch, 0.0, 0.0}, 4000);
}

TEST(SpreadFriction, OfBarsThatCrossKeepsItsForceOverJoints) {
  const Path over_joints = [](double part) {
    return moved(chain(4, 0.4), {0.0, 0.0, 1.2}, {-0.15 + 0.3 * part, 0.01, kHeight});
  };
  HandedOver pair(chain(5, 0.5), over_joints(0.0), kFriction);
  const Vec3 pull(0.5 * kStretch, 0.0, 0.0);

  pull_and_carry(pair, over_joints, pull, 1000);

  EXPECT_LT((pair.force() + pull).norm(), 1e-12 * pull.norm());
  EXPECT_LT(pair.largest_change(), 1e-12 * pull.norm());
}

// Half of what would move it, where all mesh lines of the sheet lie on those of the one below when
// it is half way: every pair with a rim or an edge in common begins or ends there. Strips as wide
// as the way along both axes change hands along the sides and the diagonals of squares of 0.1 m: (1
// + 1 + 2) * way / side of the area. What they lose grows with the way, so it is half of that in
// all, as a part of the force. And the force of a strip narrower than the overlap goes to phi *
// length / range², not to 0, as its area goes with the way: friction times that is what strips may
// hold beside the rest.
TEST(SpreadFriction, KeepsItsForceWhereAllMeshLinesPassUnderIt) {
  const Body b = sheet(4, 4, 0.4, 0.4);
  constexpr double kWay = 0.5 * kStretch;
  constexpr int kSteps = 40;
  const auto at = [&](double way) {
    return moved(b, Vec3::Zero(), {way - 0.5 * kWay, way - 0.5 * kWay, kHeight});
  };
  constexpr double kLines = 0.4 * (5 + 5 + 4 * std::numbers::sqrt2);  // m, of the sheet's mesh
  constexpr double kStrips =
      kFriction * 0.5 * kOverlap * kOverlap * kLines / (kRange * kRange);  // N
  HandedOver pair(sheet(10, 10, 1.0, 1.0), at(0.0), kFriction);
  pair.step(at(0.0));
  const double contacts = 0.4 * 0.4 / (kRange * kRange);
  for (int i = 1; i <= kSteps; ++i) {
    const double way = kWay * i / kSteps;
    pair.step(at(way), {kWay / kSteps, kWay / kSteps, 0.0});
    const double expected = contacts * way;
    for (const double force : {-pair.force().x(), -pair.force().y()}) {
      EXPECT_GT(force, (1.0 - 2.0 * way / 0.1) * expected) << i;
      EXPECT_LT(force, expected + kStrips) << i;
    }
  }
}

/// A sheet with a fold along its middle so high above its rims, which lie on the one below.
Body folded(double height) {
  Body body = sheet(4, 4, 0.4, 0.4);
  for (Vec3& x : body.x) x.z() = height * (1.0 - std::abs(x.x()) / 0.2);
  return moved(body, {0.0, 0.0, 0.1}, {0.03, 0.02, kHeight});
}

// Two rims with a spring each, the springs of many pairs of facets in the end; and back.
TEST(SpreadFriction, IsHandedOverWithoutAJumpWhereAFoldFlattensAndRises) {
  const Body ground = sheet(5, 5, 1.4, 1.4, Cut::alternating, 3);
  const Path flattens = [](double part) { return folded(0.002 * (1.0 - part)); };
  const Path rises = [](double part) { return folded(0.002 * part); };

  for (const auto& [path, first, last] :
       {std::tuple{flattens, 2u, 1u}, std::tuple{rises, 1u, 2u}}) {
    HandedOver pair(ground, path(0.0), kFriction);
    pair.step(path(0.0));
    EXPECT_EQ(pair.patches(), first);
    pair.step(path(1.0));
    EXPECT_EQ(pair.patches(), last);
    expect_continuous_force(ground, path, {0.5 * kStretch, 0.0, 0.0}, 1000);
  }
}

/// A sheet with two tips so deep in the one below (m), and a saddle between them.
Body two_tips(double first, double second, double saddle) {
  Body body = sheet(2, 2, 0.04, 0.04);
  for (Vec3& x : body.x) x.z() = 0.02;
  body.x[3].z() = -first;
  body.x[5].z() = -second;
  body.x[4].z() = -saddle;
  return moved(body, {0.0, 0.0, 0.1}, {0.03, 0.02, kRange});
}

struct Tips {
  double lost;   ///< part of the force, in the one step
  double added;  ///< part of what springs stored
};

/// Two tips of depths 2 and 1 whose saddle comes into touch, or leaves, by 2e-6 of the depths. Both
/// are pulled by as much as half the limit of the less deep one.
Tips tips_join(bool merge) {
  const double out = -1e-6 * kOverlap, in = 1e-6 * kOverlap;
  const Body before = two_tips(2.0 * kOverlap, kOverlap, merge ? out : in);
  const Body after = two_tips(2.0 * kOverlap, kOverlap, merge ? in : out);
  HandedOver pair(sheet(5, 5, 1.4, 1.4, Cut::alternating, 3), before, kFriction);
  pair.step(before);
  EXPECT_EQ(pair.patches(), merge ? 2u : 1u);
  pair.step(before, {0.5 * kStretch, 0.0, 0.0});
  const double force = -pair.force().x();
  pair.step(after);
  EXPECT_EQ(pair.patches(), merge ? 1u : 2u);
  return {1.0 + pair.force().x() / force, pair.largest_growth()};
}

// Two contacts become the (2 + 1)² / (2² + 1²) = 1.8 that have their force and energy, with equal
// stretches: (1 + 1)² / 1.8 instead of 2 is stored, a ninth more, and booked as made by tracking.
TEST(SpreadFriction, KeepsItsForceWherePointsOfContactMergeAndBooksWhatThatAdds) {
  const Tips found = tips_join(true);
  EXPECT_NEAR(found.lost, 0.0, 1e-5);
  EXPECT_NEAR(found.added, 1.0 / 9.0, 1e-5);
}

// The other way, the spring of 1.8 contacts should leave 1.2 of its 1.8 s to the deep tip and 0.6
// to the other, by which force and energy stay. None gets more than its stretch: 1.6 are left, so a
// ninth of the force is lost at once.
TEST(SpreadFriction, LosesNoMoreThanANinthWherePointsOfContactTwoToOneSplit) {
  const Tips found = tips_join(false);
  EXPECT_LT(found.lost, 1.0 / 9.0 + 1e-5);
  EXPECT_GT(found.lost, -1e-5);
  EXPECT_EQ(found.added, 0.0);
}

}  // namespace
}  // namespace plekton::test::spread_contacts_test
