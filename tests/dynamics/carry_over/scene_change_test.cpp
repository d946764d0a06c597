// SPDX-License-Identifier: GPL-3.0-or-later
// A simulation that goes on from another one in another scene: what stays is as if nothing happened.
#include "dynamics/carry_over/scene_change.hpp"

#include "dynamics/simulation.hpp"
#include "dynamics/state_hash.hpp"
#include "tests/support/reported_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <string>

namespace plekton::dynamics::scene_change_test {
namespace {

using test::NamedLaw;
using test::ReportedScene;

constexpr std::int32_t kOmitted = -1;

void advance(Simulation& simulation, int steps) {
  for (int i = 0; i < steps; ++i) simulation.step();
}

std::vector<std::int32_t> all(std::size_t count) {
  std::vector<std::int32_t> places(count);
  std::iota(places.begin(), places.end(), 0);
  return places;
}

/// All bodies, each where it was.
SceneChange nothing_moves(const Scene& scene) {
  return {{all(scene.state.size()), all(scene.elements.spheres.size()), all(scene.planes.size())},
          {}};
}

/// Without a sphere, the nodes of which come last and in their order.
SceneChange without(const Scene& scene, std::size_t sphere) {
  SceneChange change = nothing_moves(scene);
  const std::size_t node = geometry::index_of(scene.elements.spheres[sphere].nodes[0]);
  change.places.nodes[node] = change.places.spheres[sphere] = kOmitted;
  for (std::size_t i = node + 1; i < change.places.nodes.size(); ++i) --change.places.nodes[i];
  for (std::size_t i = sphere + 1; i < change.places.spheres.size(); ++i)
    --change.places.spheres[i];
  return change;
}

void take_out(Scene& scene, std::size_t sphere) {
  const auto node = static_cast<std::ptrdiff_t>(index_of(scene.elements.spheres[sphere].nodes[0]));
  const auto erase = [&](auto& list) { list.erase(list.begin() + node); };
  erase(scene.state.position);
  erase(scene.state.velocity);
  erase(scene.state.angular_velocity);
  erase(scene.state.orientation);
  erase(scene.properties.mass);
  erase(scene.properties.inertia);
  erase(scene.properties.held);
  scene.elements.spheres.erase(scene.elements.spheres.begin() +
                               static_cast<std::ptrdiff_t>(sphere));
  scene.sphere_materials.erase(scene.sphere_materials.begin() +
                               static_cast<std::ptrdiff_t>(sphere));
  for (std::size_t i = sphere; i < scene.elements.spheres.size(); ++i) {
    NodeId& id = scene.elements.spheres[i].nodes[0];
    id = geometry::id_at<NodeId>(index_of(id) - 1);
  }
}

class SceneGoesOn : public testing::TestWithParam<NamedLaw> {
 protected:
  ReportedScene before_;
};

TEST_P(SceneGoesOn, ToTheLastBitWhereNothingChangesWithAnyThreads) {
  Simulation whole = before_.simulation(GetParam());
  advance(whole, 40);
  ReportedScene same;
  same.scene.loads.forces.push_back({{NodeId{0}}, Vec3::Zero(), Vec3::Zero(), TimeTable()});
  Simulation next = same.simulation(GetParam(), 3);
  next.go_on_from(whole, nothing_moves(same.scene));

  EXPECT_EQ(next.time(), whole.time());
  EXPECT_EQ(next.energy().contact_elastic, whole.energy().contact_elastic);
  EXPECT_EQ(next.energy().gravity, whole.energy().gravity);
  advance(whole, 60);
  advance(next, 60);
  EXPECT_EQ(state_hash(next), state_hash(whole));
  EXPECT_EQ(next.energy().friction, whole.energy().friction);
  EXPECT_EQ(next.energy().closure_error(), whole.energy().closure_error());
}

/// A plate that was moved along and across itself; its servo moves it along its normal alone.
TEST(PlateGoesOn, WithoutTheMotionAlongItselfWhereAServoTakesIt) {
  Scene scene;
  scene.materials = {{1e6, 0.5, 0.3}};
  scene.planes = {{Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), contact::MaterialId{0}}};
  scene.add_sphere(Vec3(0, 0, 1), 0.1, 2500.0, contact::MaterialId{0});
  const SimulationOptions options{.time_step = 1e-4, .motion = {.gravity = Vec3::Zero()}};
  Scene moved = scene;
  moved.loads.plane_motions = {{0, Vec3(0.1, 0, 0.2), {}}};
  Simulation before(moved, options);
  advance(before, 10);
  PlaneServo servo;
  servo.force = 1.0;
  servo.largest_speed = 0.5;
  scene.loads.servos = {servo};
  Simulation next(scene, options);
  next.go_on_from(before, nothing_moves(scene));

  advance(next, 10);

  EXPECT_EQ(next.planes()[0].velocity, Vec3(0, 0, 0.5));
  EXPECT_EQ(next.planes()[0].point.x(), before.planes()[0].point.x());
}

TEST_P(SceneGoesOn, ToTheLastBitWhereAPlaneComesThatNothingTouches) {
  Simulation whole = before_.simulation(GetParam());
  advance(whole, 40);
  ReportedScene other;
  other.scene.planes.insert(other.scene.planes.begin(),
                            {Vec3(0, 0, -9), Vec3(0, 0, 1), Vec3::Zero(), contact::MaterialId{0}});
  Simulation next = other.simulation(GetParam());
  SceneChange change = nothing_moves(before_.scene);
  change.places.planes = {1, 2};
  next.go_on_from(whole, change);

  advance(whole, 60);
  advance(next, 60);
  EXPECT_EQ(next.state().position, whole.state().position);
  EXPECT_EQ(next.state().angular_velocity, whole.state().angular_velocity);
}

/// The sphere that lies on nothing but the sheet at (0.05, -0.1), and its neighbour.
TEST_P(SceneGoesOn, WithTheForcesOfAllThatStaysWhereASphereIsTakenOut) {
  constexpr std::size_t kTaken = 3;
  Simulation whole = before_.simulation(GetParam());
  advance(whole, 40);
  const auto rows = whole.list_contacts();
  ReportedScene fewer;
  take_out(fewer.scene, kTaken);
  Simulation next = fewer.simulation(GetParam());
  next.go_on_from(whole, without(before_.scene, kTaken));

  std::vector<const contact::ContactRecord*> kept;
  for (const auto& row : rows) {
    const auto is_taken = [&](const contact::ContactBody& body) {
      return body.kind == contact::BodyKind::sphere && body.index == static_cast<int>(kTaken);
    };
    if (!is_taken(row.a) && !is_taken(row.b)) kept.push_back(&row);
  }
  const auto now = next.contact_rows();
  ASSERT_EQ(now.size(), kept.size());
  ASSERT_LT(now.size(), rows.size());
  for (std::size_t i = 0; i < now.size(); ++i) {
    EXPECT_EQ(now[i].force(), kept[i]->force()) << i;
    EXPECT_EQ(now[i].moment, kept[i]->moment) << i;
    EXPECT_EQ(now[i].id, kept[i]->id) << i;
  }
  const double taken_along = whole.energy().contact_elastic - next.energy().contact_elastic;
  EXPECT_GT(taken_along, 0.0);
  EXPECT_NEAR(next.energy().closure_error(), whole.energy().closure_error(),
              1e-12 * taken_along + 1e-15 * whole.energy().turnover());
  advance(next, 60);
}

/// A facet far below, on nodes of its own, which come last.
void add_far_facet(Scene& scene, bool is_there) {
  const std::size_t first = scene.state.size();
  for (const Vec3& x : {Vec3(0, 0, -9), Vec3(1, 0, -9), Vec3(0, 1, -9)})
    scene.add_node(x, Held::everything);
  const auto node = [&](std::size_t i) { return geometry::id_at<NodeId>(first + i); };
  scene.add_facet(node(0), node(1), node(2), 0.1, contact::MaterialId{0});
  if (is_there) return;
  scene.is_absent.assign(first, false);
  scene.is_absent.resize(scene.state.size(), true);
}

/// Nothing of bodies that are gone acts on planes any more.
TEST_P(SceneGoesOn, WithWhatTheContactsThatStayDoToPlanes) {
  Simulation whole = before_.simulation(GetParam());
  advance(whole, 40);
  std::vector<contact::ContactRecord> rows = whole.contact_rows();
  const auto is_of_sphere = [](const contact::ContactRecord& row) {
    return row.a.kind == contact::BodyKind::sphere && row.b.kind == contact::BodyKind::plane;
  };
  const auto first = std::ranges::find_if(rows, is_of_sphere);
  ASSERT_NE(first, rows.end());
  const auto sphere = static_cast<std::size_t>(first->a.index);
  const auto plane = static_cast<std::size_t>(first->b.index);
  ReportedScene fewer;
  const SceneChange change = without(fewer.scene, sphere);
  take_out(fewer.scene, sphere);
  Simulation next = fewer.simulation(GetParam());
  next.go_on_from(whole, change);

  ForceAndMoment left;
  rows = next.contact_rows();
  for (const contact::ContactRecord& row : rows)
    if (row.b.kind == contact::BodyKind::plane && static_cast<std::size_t>(row.b.index) == plane)
      left.add(row.point - next.force_point(plane), row.force(), row.moment);
  const ForceAndMoment acts = next.plane_reaction(plane);
  const double gone = (whole.plane_reaction(plane).force - left.force).norm();
  EXPECT_GT(gone, 0.0);
  EXPECT_LE((acts.force - left.force).norm(), 1e-12 * gone);
  // About the places after the drift, which bodies have moved on to.
  EXPECT_LE((acts.moment - left.moment).norm(), 1e-3 * (left.moment.norm() + gone));
}

/// What the facet has no part in goes on to the last bit where it comes, and where it goes.
TEST_P(SceneGoesOn, ToTheLastBitWhereAStructureComesOrGoesThatNothingTouches) {
  for (const bool comes : {true, false}) {
    ReportedScene scene_before, scene_now;
    const std::size_t nodes = before_.scene.state.size();
    add_far_facet(scene_before.scene, !comes);
    add_far_facet(scene_now.scene, comes);
    Simulation whole = scene_before.simulation(GetParam());
    advance(whole, 40);
    Simulation next = scene_now.simulation(GetParam(), 2);
    SceneChange change = nothing_moves(scene_before.scene);
    for (std::size_t i = nodes; comes && i < change.places.nodes.size(); ++i)
      change.places.nodes[i] = kOmitted;
    EXPECT_EQ(next.elements().facets.size(), before_.scene.elements.facets.size() + comes);
    next.go_on_from(whole, change);

    EXPECT_EQ(next.elements().facets.size(), before_.scene.elements.facets.size() + comes);
    // Whose lists are made, and no step with them.
    Simulation resumed = scene_now.simulation(GetParam());
    resumed.restore(next.snapshot());
    EXPECT_EQ(next.energy().contact_elastic, whole.energy().contact_elastic);
    EXPECT_EQ(next.energy().tracking, whole.energy().tracking);
    advance(whole, 60);
    advance(next, 60);
    advance(resumed, 60);
    EXPECT_EQ(state_hash(resumed), state_hash(next));
    const auto same = [&](const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
      return std::equal(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(nodes), b.begin());
    };
    EXPECT_TRUE(same(next.state().position, whole.state().position));
    EXPECT_TRUE(same(next.state().angular_velocity, whole.state().angular_velocity));
  }
}

INSTANTIATE_TEST_SUITE_P(, SceneGoesOn, testing::ValuesIn(test::kLaws),
                         [](const auto& law) { return std::string(law.param.name); });

TEST(SceneChange, StopsWhatIsHeldFromNowOn) {
  const ReportedScene before;
  Simulation whole = before.simulation(test::kLaws[0]);
  advance(whole, 10);
  ReportedScene fixed;
  const std::size_t last = fixed.scene.state.size() - 1;
  fixed.scene.properties.held[last] = Held::everything;
  Simulation next = fixed.simulation(test::kLaws[0]);
  next.go_on_from(whole, nothing_moves(fixed.scene));
  const Vec3 place = next.state().position[last];
  advance(next, 10);

  EXPECT_EQ(next.state().position[last], place);
  EXPECT_NE(whole.state().velocity[last], Vec3(Vec3::Zero()));
}

TEST(SceneChange, RefusesOtherLawsForWhatTouches) {
  const ReportedScene scene;
  Simulation whole = scene.simulation(test::kLaws[0]);
  advance(whole, 10);
  Simulation next = scene.simulation(test::kLaws[1]);

  EXPECT_THROW(next.go_on_from(whole, nothing_moves(scene.scene)), geometry::StateMismatch);
}

TEST(SceneChange, ComesBeforeTheFirstStep) {
  const ReportedScene scene;
  Simulation whole = scene.simulation(test::kLaws[0]);
  Simulation next = scene.simulation(test::kLaws[0]);
  next.step();

  EXPECT_THROW(next.go_on_from(whole, nothing_moves(scene.scene)), std::logic_error);
}

TEST(SceneChange, RefusesPlacesThatAreNone) {
  const ReportedScene scene;
  Simulation whole = scene.simulation(test::kLaws[0]);
  advance(whole, 10);
  Simulation next = scene.simulation(test::kLaws[0]);
  const std::size_t nodes = scene.scene.state.size();
  const auto refused = [&](const SceneChange& change, const std::string& text) {
    EXPECT_THAT([&] { next.go_on_from(whole, change); },
                testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr(text)));
  };

  refused({}, "go_on_from: places.nodes has 0 entries; expected " + std::to_string(nodes));
  refused({}, "go_on_from: places.planes has 0 entries; expected 2");
  SceneChange change = nothing_moves(scene.scene);
  change.places.nodes.back() = static_cast<std::int32_t>(nodes);
  refused(change, "there are " + std::to_string(nodes) + " nodes now");
  change = nothing_moves(scene.scene);
  change.places.planes[0] = -5;
  refused(change, "go_on_from: places.planes[0] is -5; there are 2 planes now");
  change = nothing_moves(scene.scene);
  change.places.spheres[2] = 1;
  refused(change, "go_on_from: places.spheres[2] is 1, as of one before");
  change = nothing_moves(scene.scene);
  change.moved_planes = {true};
  refused(change, "go_on_from: moved_planes has 1 entries; expected 2");

  // Nothing was changed by all that.
  next.go_on_from(whole, nothing_moves(scene.scene));
  EXPECT_EQ(next.steps(), whole.steps());
}

TEST(NextContactRows, LeaveTheSimulationAsItWasWhenTheyAreAskedInVain) {
  const ReportedScene scene;
  Simulation left_alone = scene.simulation(test::kLaws[0]);
  Simulation asked = scene.simulation(test::kLaws[0]);
  for (Simulation* const simulation : {&left_alone, &asked}) advance(*simulation, 10);

  const auto fail = [](const contact::ContactRecord&) -> bool { throw std::runtime_error("no"); };
  EXPECT_THROW(asked.next_contact_rows(fail), std::runtime_error);

  EXPECT_EQ(asked.snapshot().hash(), left_alone.snapshot().hash());
  for (Simulation* const simulation : {&left_alone, &asked}) advance(*simulation, 10);
  EXPECT_EQ(asked.snapshot().hash(), left_alone.snapshot().hash());
}

}  // namespace
}  // namespace plekton::dynamics::scene_change_test
