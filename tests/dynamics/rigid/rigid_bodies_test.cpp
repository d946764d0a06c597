// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/rigid/rigid_bodies.hpp"

#include "dynamics/simulation.hpp"
#include "dynamics/state/rigid_nodes.hpp"
#include "dynamics/state_hash.hpp"
#include "geometry/mesh/generate/generators.hpp"
#include "tests/support/clumps.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

namespace plekton::dynamics::rigid_bodies_test {
namespace {

using geometry::NodeId;
using test::add_clump;
using test::Momenta;
using test::momenta_of;
using testing::HasSubstr;
using testing::ThrowsMessage;

const contact::MaterialId kMaterial{0};

Scene scene_of_material(double friction = 0.5) {
  Scene scene;
  scene.materials = {{1e7, 0.3, friction}};
  return scene;
}

/// A box of facets as a rigid body.
std::size_t add_box(Scene& scene, const Vec3& lower, const Vec3& size, double density,
                    Held held = Held::nothing) {
  const geometry::Mesh mesh = geometry::box_shell(size, {2, 2, 2});
  Vec3 corner = mesh.points.front();
  for (const Vec3& x : mesh.points) corner = corner.cwiseMin(x);
  std::vector<NodeId> nodes;
  std::vector<Vec3> points;
  for (const Vec3& x : mesh.points) {
    points.push_back(x - corner + lower);
    nodes.push_back(scene.add_node(points.back()));
  }
  for (const auto& [a, b, c] : mesh.facets)
    scene.add_facet(nodes[index_of(a)], nodes[index_of(b)], nodes[index_of(c)], 0.002, kMaterial);
  const auto moments = solid_moments(points, mesh.facets, lower);
  return scene.add_rigid_body(nodes, mass_of(moments, density, lower), held);
}

Simulation simulation_of(Scene scene, double time_step, const Vec3& gravity = Vec3::Zero(),
                         int threads = 1) {
  return Simulation(std::move(scene),
                    {.time_step = time_step, .motion = {.gravity = gravity}, .threads = threads});
}

// Some 0.04 rad in each step, about the middle axis but for 1e-4 of it: the body turns over several
// times. Nothing acts on it, so that what is lost is rounding.
TEST(RigidBodies, KeepEnergyAndMomentumOverAHundredThousandStepsWhileTheyTurnOver) {
  Scene scene = scene_of_material();
  const std::size_t body = add_clump(scene, Vec3(1, 2, 3), Quat::Identity(), 0.01);
  const std::size_t node = index_of(scene.rigid_bodies[body].node);
  const Mat3 axes = scene.state.orientation[node].toRotationMatrix();
  scene.state.velocity[node] = Vec3(0.3, -0.2, 0.1);
  scene.state.angular_velocity[node] = axes * Vec3(1e-3, 40.0, 2e-3);
  Simulation simulation(std::move(scene), {});
  simulation.set_time_step(1e-3);  // longer than its contacts would allow: there are none
  const double start = simulation.energy().kinetic;
  const Vec3 momentum = simulation.rigid_bodies().angular_momentum(body);
  const Vec3 linear = momenta_of(simulation).linear;
  double worst = 0.0, lowest = 1.0;

  for (int i = 0; i < 100000; ++i) {
    simulation.step();
    worst = std::max(worst, std::abs(simulation.energy().kinetic / start - 1.0));
    const Vec3 in_body = simulation.state().orientation[node].conjugate() * momentum;
    lowest = std::min(lowest, in_body.normalized().y());
  }

  EXPECT_LT(worst, 1e-9);
  RecordProperty("energy", std::to_string(worst * 1e12) + "e-12");
  EXPECT_LT(lowest, -0.99);  // it has turned over
  EXPECT_EQ(simulation.rigid_bodies().angular_momentum(body), momentum);
  EXPECT_EQ(momenta_of(simulation).linear, linear);
  // Places of the spheres on the body are those of the start.
  const auto& x = simulation.state().position;
  EXPECT_NEAR((x[0] - x[2]).norm(), 0.01 * Vec3(2.1, 0.1, 0.2).norm(), 1e-13);
}

// Equal in mass and inertia, a body of one sphere is that sphere.
TEST(RigidBodies, OfOneSphereMoveAsTheSphereDoes) {
  const auto run = [](bool is_body) {
    Scene scene = scene_of_material();
    scene.planes.push_back({Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), kMaterial});
    scene.add_sphere(Vec3(0, 0, 0.012), 0.01, 2000.0, kMaterial);
    if (is_body) {
      const double mass = scene.properties.mass[0], inertia = scene.properties.inertia[0];
      scene.add_rigid_body(std::vector{NodeId{0}},
                           {mass, scene.state.position[0], inertia * Mat3::Identity()});
      scene.state.velocity.back() = Vec3(0.4, 0, -0.5);
      scene.state.angular_velocity.back() = Vec3(5, 0, 20);
    } else {
      scene.state.velocity.back() = Vec3(0.4, 0, -0.5);
      scene.state.angular_velocity.back() = Vec3(5, 0, 20);
    }
    Simulation simulation = simulation_of(std::move(scene), 1e-6, Vec3(0, 0, -9.81));
    for (int i = 0; i < 20000; ++i) simulation.step();
    return std::pair(simulation.state().position[0], simulation.energy().friction);
  };

  const auto [as_sphere, lost] = run(false);
  const auto [as_body, lost_by_body] = run(true);

  EXPECT_GT(lost, 0.0);
  EXPECT_LT((as_body - as_sphere).norm(), 1e-13);
  EXPECT_NEAR(lost_by_body, lost, 1e-11 * lost);
}

/// Where a sphere is that falls on a plate.
std::vector<Vec3> sphere_on_plate(bool is_body) {
  Scene scene = scene_of_material();
  const geometry::Mesh mesh = geometry::plane_sheet({0.1, 0.1, 3, 3});
  std::vector<NodeId> nodes;
  for (const Vec3& x : mesh.points) nodes.push_back(scene.add_node(x, Held::everything));
  for (const auto& [a, b, c] : mesh.facets)
    scene.add_facet(nodes[index_of(a)], nodes[index_of(b)], nodes[index_of(c)], 0.002, kMaterial);
  scene.add_sphere(Vec3(0.013, 0.007, 0.0121), 0.01, 2000.0, kMaterial);
  scene.state.velocity.back() = Vec3(0.2, 0.1, -0.5);
  if (is_body) scene.add_rigid_body(nodes, {}, Held::everything);
  Simulation simulation = simulation_of(std::move(scene), 1e-6, Vec3(0, 0, -9.81));
  std::vector<Vec3> places;
  for (int i = 0; i < 5000; ++i) {
    simulation.step();
    places.push_back(simulation.state().position[nodes.size()]);
  }
  EXPECT_GT(simulation.largest_overlap_ratio(), 0.0);
  return places;
}

TEST(RigidBodies, TouchASphereAsAHeldMembraneOfTheirShapeDoes) {
  EXPECT_EQ(sphere_on_plate(true), sphere_on_plate(false));
}

/// Where the corners of a free light facet are that falls on a box.
std::vector<Vec3> facet_on_box(bool is_body) {
  Scene scene = scene_of_material();
  const std::size_t body =
      add_box(scene, Vec3(-0.05, -0.05, -0.1), Vec3(0.1, 0.1, 0.1), 1000.0, Held::everything);
  if (!is_body) {
    const NodeId reference = scene.rigid_bodies[body].node;
    scene.properties.held[index_of(reference)] = Held::everything;
    scene.rigid_bodies.clear();
  }
  const std::size_t first = scene.state.size();
  for (const Vec3& x :
       {Vec3(0.005, 0, 0.0041), Vec3(0.03, 0.01, 0.0042), Vec3(0.01, 0.03, 0.005)}) {
    scene.add_node(x);
    scene.properties.mass.back() = 1e-3;
    scene.properties.inertia.back() = 1e-9;
    scene.state.velocity.back() = Vec3(0.1, 0, -0.3);
  }
  scene.add_facet(NodeId(first), NodeId(first + 1), NodeId(first + 2), 0.002, kMaterial);
  Simulation simulation = simulation_of(std::move(scene), 2e-6);
  for (int i = 0; i < 2000; ++i) simulation.step();
  EXPECT_GT(simulation.largest_overlap_ratio(), 0.0);
  const auto& x = simulation.state().position;
  return {x.begin() + static_cast<std::ptrdiff_t>(first),
          x.begin() + static_cast<std::ptrdiff_t>(first + 3)};
}

TEST(RigidBodies, TouchAFacetAsAHeldMembraneOfTheirShapeDoes) {
  EXPECT_EQ(facet_on_box(true), facet_on_box(false));
}

/// A cloud of clumps that falls together.
Scene cloud(int per_side, double speed) {
  Scene scene = scene_of_material();
  test::Random random(7);
  const double spacing = 0.05;
  for (int i = 0; i < per_side * per_side * per_side; ++i) {
    const Vec3 place(i % per_side, i / per_side % per_side, i / per_side / per_side);
    const Vec3 from_middle = place - Vec3::Constant(0.5 * (per_side - 1));
    const Quat turn = Quat(1.0 + random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                           random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0))
                          .normalized();
    const std::size_t body =
        add_clump(scene, spacing * (place + Vec3::Constant(per_side)), turn, 0.01);
    const std::size_t node = index_of(scene.rigid_bodies[body].node);
    scene.state.velocity[node] = -speed * from_middle;
    scene.state.angular_velocity[node] =
        10.0 *
        Vec3(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
  }
  return scene;
}

// Contacts push bodies with opposite forces at one point, and each body takes them up with its whole
// mass: what is lost is rounding.
TEST(RigidBodies, ThatCollideKeepLinearAndAngularMomentum) {
  Simulation simulation = simulation_of(cloud(10, 0.3), 2e-5, Vec3::Zero(), 2);
  const Momenta start = momenta_of(simulation);
  const double arm = 0.5;  // m, half of the cloud

  for (int i = 0; i < 2000; ++i) simulation.step();

  const Momenta end = momenta_of(simulation);
  EXPECT_GT(simulation.energy().friction, 0.0);
  EXPECT_LT((end.linear - start.linear).norm(), 1e-10 * start.size);
  EXPECT_LT((end.angular - start.angular).norm(), 1e-10 * arm * start.size);
  RecordProperty("linear", std::to_string(1e15 * (end.linear - start.linear).norm() / start.size));
  RecordProperty("angular",
                 std::to_string(1e15 * (end.angular - start.angular).norm() / arm / start.size));
}

// Poured on a floor: in each kick the momentum grows by what weight and floor give.
TEST(RigidBodies, PouredOnAFloorTakeUpWeightAndReactionAlone) {
  Scene scene = cloud(10, 0.0);
  scene.planes.push_back({Vec3(0, 0, 0.478), Vec3::UnitZ(), Vec3::Zero(), kMaterial});
  double mass = 0.0;
  for (const RigidBody& body : scene.rigid_bodies)
    mass += scene.properties.mass[index_of(body.node)];
  const Vec3 gravity(0, 0, -9.81);
  Simulation simulation(std::move(scene),
                        {.time_step = 2e-5, .motion = {.gravity = gravity}, .threads = 2});
  simulation.step();
  Vec3 expected = momenta_of(simulation).linear;
  double size = 0.0;
  double borne = 0.0;

  for (int i = 0; i < 4000; ++i) {
    simulation.step();
    const Vec3 floor = -simulation.contacts().on_plane(0).force;
    borne = std::max(borne, floor.z());
    expected += 2e-5 * (mass * gravity + floor);
    size = std::max(size, momenta_of(simulation).size);
  }

  EXPECT_GT(borne, 0.1 * mass * 9.81);
  EXPECT_LT((momenta_of(simulation).linear - expected).norm(), 1e-10 * size);
  EXPECT_LT(simulation.energy().closure(), 0.01);
}

TEST(RigidBodies, GiveTheSameBitsForAnyNumberOfThreads) {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 4}) {
    Simulation simulation(cloud(7, 0.3),
                          {.motion = {.gravity = Vec3(0, 0, -9.81)}, .threads = threads});
    for (int i = 0; i < 1000; ++i) simulation.step();
    EXPECT_GT(simulation.contacts().counts().sphere_sphere, 0U);
    hashes.push_back(state_hash(simulation));
  }

  EXPECT_EQ(hashes[1], hashes[0]);
  EXPECT_EQ(hashes[2], hashes[0]);
}

TEST(RigidBodies, GoOnFromAStateAsIfTheyHadNotBeenStopped) {
  const auto make = [] {
    Scene scene = cloud(4, 0.5);
    add_box(scene, Vec3(0.1, 0.1, 0.05), Vec3(0.3, 0.3, 0.05), 500.0,
            Held::along_x | Held::along_y | Held::about_z);
    return Simulation(std::move(scene), {.motion = {.gravity = Vec3(0, 0, -9.81)}});
  };
  Simulation whole = make();
  for (int i = 0; i < 700; ++i) whole.step();
  const geometry::StateTree state = whole.snapshot();
  for (int i = 0; i < 700; ++i) whole.step();

  Simulation rest = make();
  rest.restore(state);
  for (int i = 0; i < 700; ++i) rest.step();

  EXPECT_EQ(state_hash(rest), state_hash(whole));
  EXPECT_EQ(rest.snapshot().hash(), whole.snapshot().hash());
}

// F = m a along the axis that is free; across it and about all axes the lid stays.
TEST(RigidBodies, FollowLoadsAlongTheirFreeAxesAlone) {
  Scene scene = scene_of_material();
  const std::size_t body = add_box(scene, Vec3::Zero(), Vec3(0.2, 0.2, 0.02), 1000.0,
                                   Held::along_x | Held::along_y | Held::rotation);
  const NodeId node = scene.rigid_bodies[body].node;
  scene.loads.forces.push_back({{node}, Vec3(3.0, 0.0, -1.6), Vec3(0.1, 0.2, 0.3), {}});
  const Vec3 start = scene.state.position[index_of(node)];
  Simulation simulation = simulation_of(std::move(scene), 1e-4);

  for (int i = 0; i < 1000; ++i) simulation.step();

  const double mass = 1000.0 * 0.2 * 0.2 * 0.02;
  const Vec3 way = simulation.state().position[index_of(node)] - start;
  EXPECT_NEAR(way.z(), -0.5 * 1.6 / mass * 0.01, 1e-14);
  EXPECT_EQ(way.x(), 0.0);
  EXPECT_EQ(simulation.state().angular_velocity[index_of(node)], Vec3(Vec3::Zero()));
  EXPECT_LT(simulation.energy().closure(), 1e-12);
}

TEST(RigidBodies, TurnAboutAPrescribedAxisWithAllTheirNodes) {
  Scene scene = scene_of_material();
  const std::size_t body = add_box(scene, Vec3(0.1, 0, 0), Vec3(0.1, 0.1, 0.1), 1000.0);
  const NodeId node = scene.rigid_bodies[body].node;
  const std::vector<Vec3> start = scene.state.position;
  PrescribedMotion motion;
  motion.nodes = {node};
  motion.held = Held::everything;
  motion.factor = TimeTable({{0.0, 0.0}, {1.0, 1.0}});
  motion.turn = AxisTurn{Vec3::Zero(), Vec3::UnitZ(), 0.5 * std::numbers::pi};
  scene.loads.motions.push_back(motion);
  Simulation simulation = simulation_of(std::move(scene), 1e-3);

  while (simulation.step_until(1.0)) {
  }

  for (const NodeId of : simulation.scene().rigid_bodies[body].nodes) {
    const Vec3& x = start[index_of(of)];
    EXPECT_LT((simulation.state().position[index_of(of)] - Vec3(-x.y(), x.x(), x.z())).norm(),
              1e-13);
  }
}

/// A body of random moments that is held about one or two axes, and turns about all.
Scene turning_body(std::mt19937& random) {
  const auto number = [&](double low, double high) {
    return std::uniform_real_distribution(low, high)(random);
  };
  const auto vector = [&](double largest) {
    return Vec3(number(-largest, largest), number(-largest, largest), number(-largest, largest));
  };
  constexpr std::array kHolds = {Held::about_x, Held::about_y, Held::about_z,
                                 Held::about_x | Held::about_y, Held::about_y | Held::about_z};
  Scene scene = scene_of_material();
  const Vec3 size(number(0.05, 0.3), number(0.05, 0.3), number(0.05, 0.3));
  const std::size_t body = add_box(scene, Vec3::Zero(), size, 1000.0, kHolds[random() % 5]);
  const std::size_t node = index_of(scene.rigid_bodies[body].node);
  const Quat turn = Quat(number(-1, 1), number(-1, 1), number(-1, 1), number(-1, 1)).normalized();
  const Vec3 centre = scene.state.position[node];
  for (Vec3& x : scene.state.position) x = centre + turn * Vec3(x - centre);
  scene.state.orientation[node] = (turn * scene.state.orientation[node]).normalized();
  scene.state.angular_velocity[node] = vector(6.0);
  return scene;
}

/// Of a second of a body.
struct Balance {
  double worst_closure =
      0.0;                 ///< over the largest turnover so far: under a torque it may stand still
  double most_work = 0.0;  ///< from outside, over the energy at the start
};

Balance balance_of(const Scene& scene, double dt) {
  Simulation simulation = simulation_of(scene, dt);
  Balance balance;
  double turnover = simulation.energy().turnover();
  while (simulation.step_until(1.0)) {
    const Energy energy = simulation.energy();
    turnover = std::max(turnover, energy.turnover());
    balance.worst_closure = std::max(balance.worst_closure, energy.closure(turnover));
    balance.most_work =
        std::max(balance.most_work, std::abs(energy.external_work) / energy.initial);
  }
  return balance;
}

// Nothing pushes them, and the hold speeds them up and slows them down about their free axes: what
// is missed is the error of the fourth order in 0.002 rad.
TEST(RigidBodies, KeepTheEnergyBalanceWhereWhatHoldsThemTurnsThem) {
  std::mt19937 random(1);
  double most_work = 0.0;
  for (int i = 0; i < 20; ++i) {
    const Balance balance = balance_of(turning_body(random), 2e-4);

    EXPECT_LT(balance.worst_closure, 1e-9) << i;
    most_work = std::max(most_work, balance.most_work);
  }
  EXPECT_GT(most_work, 0.5);
}

// Under a torque the balance closes with the square of the step.
TEST(RigidBodies, CloseTheEnergyBalanceToSecondOrderUnderATorqueAndAHoldThatTurnsThem) {
  std::mt19937 random(2);
  for (int i = 0; i < 10; ++i) {
    Scene scene = turning_body(random);
    const RigidBody& body = scene.rigid_bodies[0];
    const Vec3 torque = body.moments.minCoeff() * Vec3(1.0, 2.0, 3.0);  // some rad/s²
    scene.loads.forces.push_back({{body.node}, Vec3::Zero(), torque, {}});

    const double coarse = balance_of(scene, 2e-4).worst_closure;
    const double fine = balance_of(scene, 1e-4).worst_closure;

    EXPECT_LT(coarse, 1e-5) << i;
    EXPECT_LT(fine, 0.3 * coarse + 1e-9) << i;
  }
}

// A sphere that strikes the end of a free bar off its centre and flies off: energy and both momenta
// are shared out.
TEST(RigidBodies, ShareEnergyWithWhatStrikesThemOffTheirCentre) {
  Scene scene = scene_of_material(0.0);
  const std::size_t body = add_box(scene, Vec3(-0.2, -0.02, -0.02), Vec3(0.4, 0.04, 0.04), 500.0);
  scene.add_sphere(Vec3(0.15, 0.0, 0.05), 0.02, 2000.0, kMaterial);
  scene.state.velocity.back() = Vec3(0, 0, -2);
  const std::size_t sphere = scene.state.size() - 1;
  const double mass = scene.properties.mass[sphere];
  const std::size_t node = index_of(scene.rigid_bodies[body].node);
  const double of_bar = scene.properties.mass[node];
  Simulation simulation = simulation_of(std::move(scene), 1e-6);
  const Momenta start = momenta_of(simulation);

  for (int i = 0; i < 20000; ++i) simulation.step();

  // Elastic impact along z at x = 0.15 m: J = 2 v / (1 / m + 1 / M + x² / I).
  const double inertia = of_bar / 12.0 * (0.4 * 0.4 + 0.04 * 0.04);
  const double push = 2.0 * 2.0 / (1.0 / mass + 1.0 / of_bar + 0.15 * 0.15 / inertia);
  EXPECT_EQ(simulation.contacts().counts().sphere_surface, 0U);
  EXPECT_NEAR(simulation.state().velocity[node].z(), -push / of_bar, 0.005 * push / of_bar);
  EXPECT_NEAR(simulation.state().angular_velocity[node].y(), push * 0.15 / inertia,
              0.005 * push * 0.15 / inertia);
  const Momenta end = momenta_of(simulation);
  EXPECT_LT((end.linear - start.linear).norm(), 1e-13 * start.size);
  EXPECT_LT((end.angular - start.angular).norm(), 1e-13 * start.size);
  EXPECT_LT(simulation.energy().closure(), 1e-4);
}

TEST(RigidBodies, DoNotTouchThemselves) {
  Scene scene = scene_of_material();
  add_clump(scene, Vec3::Zero(), Quat::Identity(), 0.01);
  Simulation simulation = simulation_of(std::move(scene), 1e-5);

  for (int i = 0; i < 10; ++i) simulation.step();

  EXPECT_EQ(simulation.contacts().counts().sphere_sphere, 0U);
  EXPECT_EQ(simulation.energy().contact_elastic, 0.0);
  EXPECT_EQ(simulation.largest_overlap_ratio(), 0.0);
}

// The limit of a body on a spring is that of a sphere of its mass; on its end it yields more easily.
TEST(RigidBodies, LimitTheStepByTheirMassAndInertia) {
  const auto critical = [](double x, double density) {
    Scene scene = scene_of_material(0.0);
    scene.materials[0].stiffness_ratio = 0.0;
    add_box(scene, Vec3(-0.2, -0.02, -0.02), Vec3(0.4, 0.04, 0.04), density);
    scene.add_sphere(Vec3(x, 0.0, 0.0415), 0.02, 2000.0, kMaterial);
    scene.properties.held[scene.state.size() - 1] = Held::everything;
    Simulation simulation = simulation_of(std::move(scene), 1e-6);
    simulation.step();
    EXPECT_EQ(simulation.contacts().counts().sphere_surface, 1U);
    EXPECT_LT(simulation.present_critical_step().dt,
              (1.0 + 1e-3) * simulation.exact_critical_step().dt);
    return simulation.present_critical_step().dt;
  };

  const double at_centre = critical(0.05, 500.0);
  EXPECT_NEAR(critical(0.05, 2000.0) / at_centre, 2.0, 0.05);
  EXPECT_LT(critical(0.18, 500.0), 0.8 * at_centre);
}

TEST(RigidBodies, RefuseAVelocityForANodeThatFollows) {
  Scene scene = scene_of_material();
  add_clump(scene, Vec3::Zero(), Quat::Identity(), 0.01);
  Simulation simulation = simulation_of(std::move(scene), 1e-5);

  EXPECT_THAT([&] { simulation.set_velocity(NodeId{1}, Vec3::Zero()); },
              ThrowsMessage<std::invalid_argument>(HasSubstr(
                  "node 1 follows rigid body 0; set the velocity of its reference node, 3")));
}

}  // namespace
}  // namespace plekton::dynamics::rigid_bodies_test
