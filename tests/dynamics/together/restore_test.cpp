// SPDX-License-Identifier: GPL-3.0-or-later
// A simulation that goes on from a state is the one that was never stopped, to the last bit.
#include "dynamics/checkpoint/checkpoint_file.hpp"
#include "dynamics/simulation.hpp"
#include "dynamics/state_hash.hpp"
#include "tests/support/reported_scene.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>

namespace plekton::dynamics::restore_test {
namespace {

using geometry::StateMismatch;
using geometry::StateTree;
using test::NamedLaw;
using test::ReportedScene;
using testing::HasSubstr;
using testing::ThrowsMessage;

void advance(Simulation& simulation, int steps) {
  for (int i = 0; i < steps; ++i) simulation.step();
}

/// Names of the arrays that differ.
std::vector<std::string> differences(const StateTree& a, const StateTree& b) {
  std::vector<std::string> names;
  for (const auto& [name, array] : a.arrays) {
    StateTree one, other;
    one.arrays["it"] = array;
    if (const auto found = b.arrays.find(name); found != b.arrays.end())
      other.arrays["it"] = found->second;
    if (one.hash() != other.hash()) names.push_back(name);
  }
  if (a.arrays.size() != b.arrays.size()) names.emplace_back("their number");
  return names;
}

class Restore : public testing::TestWithParam<NamedLaw> {
 protected:
  ReportedScene scene_;
};

TEST_P(Restore, GoesOnToTheLastBitWithContactsOfEveryKindAndOtherThreads) {
  Simulation whole = scene_.simulation(GetParam());
  advance(whole, 40);
  whole.list_contacts();
  advance(whole, 3);
  const StateTree state = whole.snapshot();
  Simulation resumed = scene_.simulation(GetParam(), 3);
  resumed.restore(state);
  EXPECT_EQ(differences(resumed.snapshot(), state), std::vector<std::string>{});

  for (Simulation* const simulation : {&whole, &resumed}) {
    advance(*simulation, 60);
    simulation->list_contacts();
  }

  EXPECT_EQ(differences(resumed.snapshot(), whole.snapshot()), std::vector<std::string>{});
}

TEST(RestoreOfNothingStiff, TakesAStateWithoutAStepWhereNoneIsSet) {
  Scene scene;
  scene.add_node(Vec3::Zero());
  scene.properties.mass = scene.properties.inertia = {1.0};
  const SimulationOptions options{.motion = {.gravity = Vec3::Zero()}};
  Simulation one(scene, options), other(scene, options);
  ASSERT_TRUE(std::isinf(one.time_step()));

  EXPECT_NO_THROW(other.restore(one.snapshot()));

  EXPECT_TRUE(std::isinf(other.time_step()));
}

/// Before a step is taken.
TEST_P(Restore, TellsOfTheLastStepWhatItToldBefore) {
  Simulation whole = scene_.simulation(GetParam());
  advance(whole, 50);
  const std::vector<contact::ContactRecord> rows = whole.list_contacts();
  Simulation resumed = scene_.simulation(GetParam());
  resumed.restore(whole.snapshot());

  const std::vector<contact::ContactRecord> again = resumed.contact_rows();
  ASSERT_EQ(again.size(), rows.size());
  ASSERT_GT(rows.size(), 10U);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(again[i].id, rows[i].id) << i;
    EXPECT_EQ(again[i].a.feature, rows[i].a.feature) << i;
    EXPECT_EQ(again[i].b.feature, rows[i].b.feature) << i;
    EXPECT_EQ(again[i].point, rows[i].point) << i;
    EXPECT_EQ(again[i].force(), rows[i].force()) << i;
    EXPECT_EQ(again[i].moment, rows[i].moment) << i;
    EXPECT_EQ(again[i].gap, rows[i].gap) << i;
    EXPECT_EQ(again[i].is_slipping, rows[i].is_slipping) << i;
  }
  const Energy now = resumed.energy(), before = whole.energy();
  EXPECT_EQ(now.contact_elastic, before.contact_elastic);
  EXPECT_EQ(now.bond_elastic, before.bond_elastic);
  EXPECT_EQ(now.closure_error(), before.closure_error());
  EXPECT_EQ(resumed.contacts().counts().sphere_sphere, whole.contacts().counts().sphere_sphere);
  EXPECT_EQ(resumed.contacts().largest_overlap_ratio(), whole.contacts().largest_overlap_ratio());
  EXPECT_EQ(resumed.unbalanced_force_ratio(), whole.unbalanced_force_ratio());
  EXPECT_EQ(resumed.plane_reaction(0).force, whole.plane_reaction(0).force);
  EXPECT_EQ(resumed.plane_reaction(0).moment, whole.plane_reaction(0).moment);
  EXPECT_EQ(resumed.pressing_on(0), whole.pressing_on(0));
}

TEST_P(Restore, IsNotSeenByASimulationWhoseStateIsTaken) {
  Simulation left_alone = scene_.simulation(GetParam());
  Simulation looked_at = scene_.simulation(GetParam());
  for (int i = 0; i < 30; ++i) {
    left_alone.step();
    looked_at.step();
    looked_at.snapshot();
  }

  EXPECT_EQ(differences(looked_at.snapshot(), left_alone.snapshot()), std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(, Restore, testing::ValuesIn(test::kLaws),
                         [](const auto& law) { return std::string(law.param.name); });

TEST(RestoreFiles, GoOnFromAFile) {
  const ReportedScene scene;
  const test::TemporaryFolder folder;
  Simulation whole = scene.simulation(test::kLaws[0]);
  advance(whole, 20);
  whole.save(folder / "state.h5");
  Simulation resumed = scene.simulation(test::kLaws[0]);
  resumed.load(folder / "state.h5");

  EXPECT_EQ(state_hash(resumed), state_hash(whole));
}

/// Grains that slide over the facets of a held sheet, each a little deeper than the last.
Simulation sliding_grains() {
  Scene scene;
  scene.materials = {{1e7, 0.5, 0.3}};
  test::add_membrane(scene, geometry::plane_sheet({0.4, 0.4, 8, 8}));
  scene.properties.held.assign(scene.state.size(), Held::translation);
  test::Random random(7);
  for (int i = 0; i < 16; ++i) {
    const Vec3 place(-0.15 + 0.1 * (i % 4), -0.15 + 0.1 * (i / 4), 0.0219 - 1e-5 * i);
    scene.add_sphere(place, 0.02, 2650.0, contact::MaterialId{0});
    scene.state.velocity.back() = random.in_cube(2.0);
    scene.state.angular_velocity.back() = random.in_cube(50.0);
  }
  SimulationOptions options;
  options.motion.gravity = Vec3(0, 0, -9.81);
  return Simulation(std::move(scene), options);
}

/// A contact with the inside of a facet is found side by side with others, or by itself where more
/// cells may be in range; after a restart fewer are known not to be. Neither may be seen.
TEST(RestoreGrainsOnFacets, GoOnToTheLastBitFromAnyStep) {
  Simulation whole = sliding_grains();
  for (int i = 0; i < 200; ++i) {
    Simulation resumed = sliding_grains();
    resumed.restore(whole.snapshot());
    advance(resumed, 1);
    advance(whole, 1);
    ASSERT_EQ(differences(resumed.snapshot(), whole.snapshot()), std::vector<std::string>{}) << i;
  }
}

/// A pushed ball, a pressed facet, a plate and a rigid ball under servo control, and a plane that
/// nothing moves.
Scene scene_of_loads() {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.4}};
  const contact::MaterialId material{0};
  for (const double x : {0.0, 0.1}) scene.add_sphere(Vec3(x, 0, 0.01), 0.01, 2650.0, material);
  scene.add_rigid_body(std::array{NodeId{1}}, {0.01, Vec3(0.1, 0, 0.01), 1e-6 * Mat3::Identity()});
  std::array<NodeId, 3> corners;
  for (int i = 0; i < 3; ++i)
    corners[static_cast<std::size_t>(i)] = scene.add_node(Vec3(1 + (i == 1), i == 2, 0));
  scene.add_facet(corners[0], corners[1], corners[2], 0.01, material);
  for (std::size_t i = 0; i < 3; ++i)
    scene.add_beam(corners[i], corners[(i + 1) % 3], circular_section(0.01, 1e7, 0.3), 1000.0);
  for (const double height : {0.0, 0.02001, -1.0})
    scene.planes.push_back({Vec3(0, 0, height), height > 0.0 ? Vec3(-Vec3::UnitZ()) : Vec3::UnitZ(),
                            Vec3::Zero(), material});
  scene.loads.forces.emplace_back().nodes = {NodeId{0}};
  scene.loads.pressures.emplace_back().facets = {geometry::FaceId{0}};
  scene.loads.pressures[0].pressure = 1.0;
  PlaneServo& plate = scene.loads.servos.emplace_back();
  plate.plane = 1;
  plate.force = 3.0;
  plate.largest_speed = 0.1;
  BodyServo& press = scene.loads.body_servos.emplace_back();
  press.force = 2.0;
  press.axis = 2;
  press.towards = -1.0;
  press.largest_speed = 0.1;
  return scene;
}

TEST(RestoreLoads, GoOnAsTheyWereSet) {
  const auto start = [] {
    SimulationOptions options;
    options.time_step = 2e-6;
    return Simulation(scene_of_loads(), options);
  };
  Simulation whole = start(), untouched = start();
  for (Simulation* const simulation : {&whole, &untouched}) advance(*simulation, 20);
  whole.set_force(0, Vec3(0.1, 0, 0), Vec3(0, 0, 1e-3));
  whole.set_pressure(0, -5.0);
  whole.set_servo(0, 7.0, 1.0);
  whole.set_body_servo(0, 4.0);
  whole.set_plane_velocity(2, Vec3(0, 0, 1e-3));
  Simulation resumed = start();
  resumed.restore(whole.snapshot());

  for (Simulation* const simulation : {&whole, &untouched, &resumed}) advance(*simulation, 10000);

  EXPECT_EQ(differences(resumed.snapshot(), whole.snapshot()), std::vector<std::string>{});
  const NodeState &set = whole.state(), &before = untouched.state();
  for (const std::size_t node : {0U, 1U, 2U}) EXPECT_NE(set.position[node], before.position[node]);
  for (const std::size_t plane : {1U, 2U})
    EXPECT_NE(whole.planes()[plane].point.z(), untouched.planes()[plane].point.z()) << plane;
}

TEST(RestoreErrors, NameAnotherScene) {
  ReportedScene scene;
  const StateTree state = scene.simulation(test::kLaws[0]).snapshot();
  scene.scene.properties.mass[3] *= 2.0;
  Simulation other = scene.simulation(test::kLaws[0]);

  EXPECT_THAT([&] { other.restore(state); },
              ThrowsMessage<StateMismatch>(HasSubstr("another scene")));
}

TEST(RestoreErrors, NameAnotherLaw) {
  const ReportedScene scene;
  const StateTree state = scene.simulation(test::kLaws[0]).snapshot();
  Simulation other = scene.simulation(test::kLaws[2]);

  EXPECT_THAT([&] { other.restore(state); },
              ThrowsMessage<StateMismatch>(HasSubstr("other contact laws")));
}

/// A plate that a servo pushed went on with the speed of its last step for ever.
TEST(RestoreErrors, NameWhatALoadMovedAndNothingMovesHere) {
  const StateTree state = Simulation(scene_of_loads(), {}).snapshot();
  Scene without_servo = scene_of_loads(), without_press = scene_of_loads();
  without_servo.loads.servos.clear();
  without_press.loads.body_servos.clear();
  Simulation free_plane(std::move(without_servo), {}), free_body(std::move(without_press), {});

  EXPECT_THAT([&] { free_plane.restore(state); },
              ThrowsMessage<StateMismatch>(HasSubstr("plane 1 (by place) a load moves")));
  // What loads move of nodes is held there.
  EXPECT_THAT([&] { free_body.restore(state); },
              ThrowsMessage<StateMismatch>(HasSubstr("another scene")));
}

/// What drives a plane may be another load; and what moved by itself may be driven.
TEST(RestoreErrors, LetOtherLoadsMoveWhatWasMoved) {
  Scene moved = scene_of_loads();
  moved.loads.servos.clear();
  moved.loads.plane_motions.push_back({1, Vec3(0, 0, -0.1), {}, {}});
  moved.loads.plane_motions.push_back({2, Vec3(0, 0, 0.1), {}, {}});
  Simulation other(std::move(moved), {});

  EXPECT_NO_THROW(other.restore(Simulation(scene_of_loads(), {}).snapshot()));
}

TEST(RestoreErrors, TellThatASimulationHasBegun) {
  const ReportedScene scene;
  Simulation simulation = scene.simulation(test::kLaws[0]);
  const StateTree state = simulation.snapshot();
  simulation.step();

  EXPECT_THROW(simulation.restore(state), std::logic_error);
}

TEST(RestoreErrors, TellThatTheStepWasChosen) {
  const auto with_step = [](double step) {
    SimulationOptions options;
    options.time_step = step;
    return Simulation(scene_of_loads(), options);
  };
  const StateTree state = with_step(0.0).snapshot();
  Simulation given = with_step(2e-6);

  EXPECT_THAT([&] { given.restore(state); },
              ThrowsMessage<StateMismatch>(HasSubstr("chooses its time step; give none here")));
}

/// Any number of a state may be another one: the answer is a message or a simulation, no crash.
TEST(RestoreErrors, DoNotCrashOnAStateWithAWrongNumber) {
  const ReportedScene scene;
  Simulation simulation = scene.simulation(test::kLaws[1]);
  advance(simulation, 20);
  const StateTree state = simulation.snapshot();
  for (const auto& [name, array] : state.arrays) {
    if (array.size() == 0 || array.numbers.index() == 0) continue;  // ids, counts and flags
    for (const std::int64_t wrong : {std::int64_t{-7}, std::int64_t{1} << 30U}) {
      StateTree changed = state;
      std::visit(
          [&](auto& numbers) {
            using Number = typename std::decay_t<decltype(numbers)>::value_type;
            numbers[numbers.size() / 2] = static_cast<Number>(wrong);
          },
          changed.arrays[name].numbers);
      Simulation other = scene.simulation(test::kLaws[1]);
      try {
        other.restore(changed);
      } catch (const StateMismatch&) {
      }
    }
  }
}

/// The message, or that there was none.
std::string refusal_of(Simulation& simulation, const StateTree& state) {
  try {
    simulation.restore(state);
  } catch (const StateMismatch& error) {
    return error.what();
  }
  return "accepted";
}

/// Ids of nodes, features, cells, contacts, patches and materials, which places in memory are found
/// by: one that is none is refused by the name of its array.
TEST(RestoreErrors, NameTheArrayWithAnIdThatIsNone) {
  const ReportedScene scene;
  Simulation simulation = scene.simulation(test::kLaws[5]);
  advance(simulation, 20);
  const StateTree state = simulation.snapshot();
  int count = 0;
  for (const char* const name : {"elements/facets/nodes",
                                 "elements/facets/material",
                                 "contacts/spheres/order",
                                 "contacts/spheres/lists_in_order",
                                 "contacts/surfaces/contacts/minima",
                                 "contacts/surfaces/forces/contact",
                                 "contacts/surfaces/forces/core_nodes",
                                 "contacts/surfaces/forces/core_feature",
                                 "contacts/structures/patches/first_nodes",
                                 "contacts/structures/patches/deepest",
                                 "contacts/structures/spread/a_nodes",
                                 "contacts/structures/spread/patch",
                                 "contacts/structures/bonds/a_nodes",
                                 "contacts/structures/bonds/b_feature",
                                 "contacts/structures/bonds/cell_a",
                                 "contacts/structures/bonds/patch",
                                 "contacts/structures/pairs/patch",
                                 "contacts/structures/pairs/spread",
                                 "contacts/plane_neighbours/pairs/sphere",
                                 "contacts/plane_neighbours/pairs/plane",
                                 "contacts/start"}) {
    ASSERT_TRUE(state.arrays.contains(name)) << name;
    if (state.arrays.at(name).size() == 0) continue;
    ++count;
    for (const std::int64_t wrong : {std::int64_t{-7}, std::int64_t{1} << 30U}) {
      StateTree changed = state;
      std::visit(
          [&](auto& numbers) {
            using Number = typename std::decay_t<decltype(numbers)>::value_type;
            numbers.back() = static_cast<Number>(wrong);
          },
          changed.arrays[name].numbers);
      Simulation other = scene.simulation(test::kLaws[5]);
      EXPECT_THAT(refusal_of(other, changed), HasSubstr("\"" + std::string(name) + "\"")) << wrong;
    }
  }
  EXPECT_GE(count, 18);
}

}  // namespace
}  // namespace plekton::dynamics::restore_test
