// SPDX-License-Identifier: GPL-3.0-or-later
// Loads of a scenario, as the user of the program meets them.
#include "tests/apps/command_line/command_fixture.hpp"
#include "tests/apps/command_line/sheet_and_ball.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>
#include <string>

namespace plekton::apps::loads_command_test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A net, grains, and planes around them and around a sheet and a ball.
constexpr std::string_view kOthers = R"([[membranes]]
name = "net"
shape = { kind = "biaxial_geogrid", rib_pitch = "2 cm", bar_pitch = "2 cm", apertures = [3, 3] }
translate = [0, 0, "-4 cm"]
thickness = "2 mm"
material = "stone"
young_modulus = "50 MPa"
density = "1000 kg/m3"
hold = "rim"
[[grains]]
name = "gravel"
material = "stone"
count = 5
radius = "5 mm"
box = { min = ["-5 cm", "-5 cm", "12 cm"], max = ["5 cm", "5 cm", "14 cm"] }
[[planes]]
name = "floor"
point = [0, 0, "-5 cm"]
material = "stone"
[[planes]]
name = "left"
point = ["-20 cm", 0, 0]
normal = [1, 0, 0]
material = "stone"
velocity = [0.01, 0, 0]
[[planes]]
name = "right"
point = ["20 cm", 0, 0]
normal = [-1, 0, 0]
material = "stone"
)";

class Loads : public Command {
 protected:
  /// The loads are added to them.
  static std::string bodies() {
    return std::string(kSheetAndSphere) + std::string(kOthers) + std::string(kLid);
  }

  /// `plekton check` of the bodies with these tables [[loads]].
  Outcome check(const std::string& loads) const {
    const std::string file = (folder_ / "loads.toml").string();
    test::write_bytes(file, bodies() + loads);
    return outcome_of({"check", file});
  }

  void expect_problem(const std::string& load, const std::string& problem) const {
    const Outcome outcome = check("[[loads]]\nname = \"a\"\n" + load);
    EXPECT_EQ(outcome.exit_code, kFailed) << load;
    EXPECT_THAT(outcome.err, HasSubstr(problem)) << load;
    EXPECT_THAT(outcome.err, HasSubstr("loads.toml:")) << load;
  }
};

/// Loads that can do nothing, which nothing told of.
TEST_F(Loads, AreAWarningWhereTheyCanDoNothing) {
  const Outcome outcome = check(
      "[[loads]]\nname = \"rim\"\nkind = \"force\"\nmembrane = \"net\"\nnodes = \"rim\"\n"
      "total_force = [0, 0, 5]\n"
      "[[loads]]\nname = \"led\"\nkind = \"force\"\nmembrane = \"sheet\"\nnodes = \"x_min\"\n"
      "force = [0, 0, 1]\n"
      "[[loads]]\nname = \"leads\"\nkind = \"motion\"\nmembrane = \"sheet\"\n"
      "nodes = \"x_min\"\ncomponents = \"z\"\nvelocity = [0, 0, 0.01]\n"
      "[[loads]]\nname = \"nil\"\nkind = \"force\"\nmembrane = \"sheet\"\nnodes = \"all\"\n"
      "force = [0, 0, 0]\n"
      "[[loads]]\nname = \"calm\"\nkind = \"pressure\"\nmembrane = \"sheet\"\npressure = 0\n");

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("warning: loads.rim: all that it acts on is held or moved"));
  EXPECT_THAT(outcome.out, HasSubstr("warning: loads.led: all that it acts on is held or moved"));
  EXPECT_THAT(outcome.out, HasSubstr("warning: loads.nil: its force and torque are 0"));
  EXPECT_THAT(outcome.out, HasSubstr("warning: loads.calm: its pressure is 0, without gas"));
}

/// The run ends after 2 ms.
TEST_F(Loads, AreAWarningWhereTheirFactorIsZeroUntilTheRunEnds) {
  const std::string force =
      "kind = \"force\"\nmembrane = \"sheet\"\nnodes = \"all\"\nforce = [0, 0, 1]\n";
  const std::string pressure = "kind = \"pressure\"\nmembrane = \"ball\"\npressure = \"1 kPa\"\n";
  const std::string never = "factor = [[0, 0]]\n",
                    late = "factor = [[\"5 ms\", 0], [\"6 ms\", 1]]\n";
  const std::string at_once = "factor = [[0, 1], [\"1 ms\", 0]]\n";
  const std::string in_time = "factor = [[\"1 ms\", 0], [\"3 ms\", 1]]\n";
  const Outcome outcome = check(
      "[[loads]]\nname = \"never\"\n" + force + never + "[[loads]]\nname = \"late\"\n" + force +
      late + "[[loads]]\nname = \"slack\"\n" + pressure + never +
      "[[loads]]\nname = \"lid\"\nkind = \"servo\"\nplane = \"lid\"\nforce = 1\nspeed = 1\n" +
      late + "[[loads]]\nname = \"first\"\n" + force + at_once + "[[loads]]\nname = \"then\"\n" +
      force + in_time + "[[loads]]\nname = \"gas\"\n" + pressure + "gas = {}\n" + never);

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  for (const char* name : {"never", "late", "slack", "lid"})
    EXPECT_THAT(outcome.out, HasSubstr(fmt::format("warning: loads.{}: its factor is 0", name)));
  for (const char* name : {"first", "then", "gas"})
    EXPECT_THAT(outcome.out, Not(HasSubstr(fmt::format("warning: loads.{}:", name))));
}

TEST_F(Loads, AreAWarningAsGroundSpringsThatCanDoNothing) {
  const std::string springs = "kind = \"ground_springs\"\nmembrane = ";
  const Outcome outcome =
      check("[[loads]]\nname = \"held\"\n" + springs +
            "\"net\"\nnodes = \"rim\"\nstiffness = [\"1 kN/m\", 0, 0]\n"
            "[[loads]]\nname = \"soft\"\n" +
            springs +
            "\"sheet\"\nnodes = \"all\"\nstiffness = [0, 0, 0]\n"
            "[[loads]]\nname = \"firm\"\n" +
            springs + "\"net\"\nnodes = \"all\"\nstiffness = [\"1 kN/m\", 0, 0]\n");

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out,
              HasSubstr("warning: loads.held: all that it acts on is held or moved as told along "
                        "its springs"));
  EXPECT_THAT(outcome.out, HasSubstr("warning: loads.soft: its stiffness is 0"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("warning: loads.firm")));
}

TEST_F(Loads, AreAWarningAsForcesThatAServoBears) {
  const std::string force = "kind = \"force\"\nrigid_body = \"box\"\nforce = ";
  const Outcome outcome = check(
      "[[loads]]\nname = \"borne\"\n" + force + "[0, 0, 1]\n[[loads]]\nname = \"along\"\n" + force +
      "[1, 0, 1]\n[[loads]]\nname = \"press\"\nkind = \"servo\"\nrigid_body = \"box\"\n"
      "direction = \"-z\"\nforce = 1\nspeed = 1\n[[rigid_bodies]]\nname = \"box\"\n"
      "shape = { kind = \"box\", size = [0.04, 0.04, 0.02] }\ntranslate = [0.12, 0, 0]\n"
      "thickness = \"2 mm\"\nmaterial = \"stone\"\nmass = 1\n");

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("warning: loads.borne: all that it acts on is held or moved"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("warning: loads.along")));
}

TEST_F(Loads, AreNoWarningWhereTheyMoveSomething) {
  const Outcome outcome = check(
      "[[loads]]\nkind = \"force\"\nmembrane = \"net\"\nnodes = \"all\"\nforce = [0, 0, 1]\n"
      "[[loads]]\nkind = \"force\"\nmembrane = \"sheet\"\nnodes = \"x_min\"\n"
      "force = [1, 0, 1]\n"
      "[[loads]]\nkind = \"motion\"\nmembrane = \"sheet\"\n"
      "nodes = \"x_min\"\ncomponents = \"z\"\nvelocity = [0, 0, 0.01]\n"
      "[[loads]]\nkind = \"pressure\"\nmembrane = \"ball\"\npressure = 0\ngas = {}\n");

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out, Not(HasSubstr("warning: loads")));
}

constexpr std::string_view kAllLoads = R"([[loads]]
name = "start"
kind = "gravity"
factor = [[0, 0], ["1 ms", 1]]
[[loads]]
kind = "motion"
membrane = "sheet"
nodes = "x_max"
velocity = ["10 mm/s", 0, 0]
factor = [["0 s", 0], ["1 ms", 1]]
[[loads]]
kind = "motion"
membrane = "sheet"
nodes = "x_min"
components = "yz"
displacement = [0, 0, "1 mm"]
angular_velocity = [0, 0, "90 deg/s"]
factor = [["0 s", 0], ["2 ms", 1]]
[[loads]]
kind = "motion"
membrane = "net"
nodes = { min = ["-1 mm", "-2 cm", "-5 cm"], max = ["2 cm", "2 cm", "5 cm"] }
turn = { point = [0, 0, 0], axis = [0, 1, 0], angle = "2 deg" }
factor = [["0 s", 0], ["2 ms", 1]]
[[loads]]
kind = "force"
membrane = "sheet"
nodes = { min = ["-1 cm", "-1 cm", "-1 mm"], max = ["1 cm", "1 cm", "1 mm"] }
total_force = [0, 0, "-1 N"]
torque = [0, 0, "1 N mm"]
[[loads]]
kind = "force"
grains = "gravel"
force = ["1 mN", 0, 0]
[[loads]]
kind = "ground_springs"
membrane = "ball"
nodes = "z_min"
stiffness = ["1 N/mm", 0, "2 N/mm"]
[[loads]]
kind = "pressure"
membrane = "ball"
pressure = "2 kPa"
factor = [[0, 0], ["1 ms", 1]]
gas = { exponent = 1.4, outside_pressure = "1 bar" }
[[loads]]
kind = "pressure"
membrane = "sheet"
pressure = "-100 Pa"
[[loads]]
kind = "beam_damping"
membrane = "net"
ratio = 0.1
[[loads]]
kind = "mass_damping"
membrane = "ball"
nodes = "all"
rate = "10 Hz"
[[loads]]
kind = "servo"
plane = "lid"
pressure = "1 kPa"
area = "0.4 m2"
speed = "5 cm/s"
)";

TEST_F(Loads, RunAndKeepTheBooks) {
  const std::string file = (folder_ / "all.toml").string();
  test::write_bytes(file, bodies() + std::string(kAllLoads));

  const Outcome outcome = outcome_of({"run", file, "--out", out()});

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_LT(report()["energy_closure"], 0.01);
  EXPECT_NE(report()["energy"]["external_work_J"], 0.0);
  EXPECT_GT(report()["energy"]["damping_J"], 0.0);
}

TEST_F(Loads, DampSheetsInProportionToTheirStiffness) {
  const std::string shell = R"([simulation]
gravity = [0, 0, 0]
duration = "20 ms"
time_step = "2 us"
[materials.rubber]
young_modulus = "1 MPa"
friction_angle = 0
[[membranes]]
name = "shell"
shape = { kind = "sphere", radius = "5 cm", subdivisions = 1 }
mode = "continuum"
thickness = "1 mm"
young_modulus = "2 MPa"
density = "1000 kg/m3"
material = "rubber"
prestrain = "2 %"
)";
  // What the strained shell has, moving and stretched, after it was let go.
  const auto left_with = [&](const std::string& more) {
    test::write_bytes(folder_ / "shell.toml", shell + more);
    const Outcome outcome =
        outcome_of({"run", (folder_ / "shell.toml").string(), "--out", out(), "--overwrite"});
    EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
    EXPECT_LT(report()["energy_closure"], 0.01);
    return report()["energy"]["kinetic_J"].get<double>() +
           report()["energy"]["sheet_elastic_J"].get<double>();
  };
  const double breathing = left_with("");
  const double damped =
      left_with("[[loads]]\nkind = \"sheet_damping\"\nmembrane = \"shell\"\nratio = 0.5\n");
  EXPECT_LT(damped, 0.1 * breathing);
  EXPECT_GT(report()["energy"]["damping_J"], 0.8 * breathing);
  expect_problem("kind = \"sheet_damping\"\nmembrane = \"net\"\nratio = 0.1\n",
                 "\"net\" is no sheet; expected a membrane in mode continuum");
  expect_problem("kind = \"sheet_damping\"\nmembrane = \"ball\"\nratio = -1\n",
                 "loads.a.ratio: got -1");
}

/// A sphere that holds p over the outside carries N = p R / 2 in all directions, with a strain of
/// N (1 - nu) / (E t): a shell that is strained so at the start stays as it is.
TEST_F(Loads, FindAPrestrainedShellAtRestUnderItsPressure) {
  const auto most_kinetic = [&](double prestrain) {
    test::write_bytes(folder_ / "ball.toml", fmt::format(R"([simulation]
gravity = [0, 0, 0]
duration = "10 ms"
[materials.rubber]
young_modulus = "1 MPa"
friction_angle = 0
[[membranes]]
name = "ball"
shape = {{ kind = "sphere", radius = "5 cm", subdivisions = 3 }}
mode = "continuum"
thickness = "1 mm"
young_modulus = "2 MPa"
poisson_ratio = 0.4
density = "1000 kg/m3"
material = "rubber"
prestrain = {}
[[loads]]
kind = "pressure"
membrane = "ball"
pressure = "2 kPa"
gas = {{}}
[output]
history_interval = "0.1 ms"
)",
                                                         prestrain));
    const Outcome outcome =
        outcome_of({"run", (folder_ / "ball.toml").string(), "--out", out(), "--overwrite"});
    EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
    std::istringstream rows(test::bytes_of(folder_ / "out/energy.csv"));
    std::string row;
    std::getline(rows, row);
    EXPECT_THAT(row, testing::StartsWith("time (s),kinetic (J)"));
    double most = 0.0;
    while (std::getline(rows, row)) most = std::max(most, std::stod(row.substr(row.find(',') + 1)));
    return most;
  };
  const double strain = 2e3 * 0.05 / 2.0 * (1.0 - 0.4) / (2e6 * 1e-3);
  EXPECT_LT(most_kinetic(strain), 0.01 * most_kinetic(0.0));
}

TEST_F(Loads, AreRefusedWithTheNameOfWhatIsNotThere) {
  expect_problem("kind = \"presure\"\n", "loads.a.kind: got \"presure\"; expected one of");
  expect_problem("kind = \"presure\"\n", "did you mean \"pressure\"?");
  expect_problem("", "loads.a.kind: missing; expected one of");
  expect_problem("kind = \"pressure\"\nmembrane = \"shet\"\npressure = 1\n",
                 "loads.a.membrane: there is none called \"shet\"; did you mean \"sheet\"?");
  expect_problem("kind = \"servo\"\nplane = \"top\"\nforce = 1\nspeed = 1\n",
                 "loads.a.plane: there is none called \"top\"; there are \"floor\"");
  expect_problem("kind = \"force\"\nforce = [0, 0, 1]\n",
                 "loads.a.membrane: got none of membrane and grains");
  expect_problem("kind = \"force\"\ngrains = \"gravel\"\nnodes = \"rim\"\nforce = [0, 0, 1]\n",
                 "loads.a.nodes: grains have no rim");
  expect_problem("kind = \"force\"\nmembrane = \"sheet\"\nnodes = \"all\"\nforces = [0, 0, 1]\n",
                 "loads.a.forces: unknown key; did you mean \"force\"?");
}

TEST_F(Loads, AreRefusedWithoutNodesToActOn) {
  expect_problem("kind = \"force\"\nmembrane = \"ball\"\nnodes = \"rim\"\nforce = [0, 0, 1]\n",
                 "loads.a.nodes: \"ball\" is closed and has no rim");
  expect_problem(
      "kind = \"force\"\nmembrane = \"ball\"\nforce = [0, 0, 1]\n"
      "nodes = { min = [5, 5, 5], max = [6, 6, 6] }\n",
      "loads.a.nodes: \"ball\" has no node there; the box counts in the scene");
}

TEST_F(Loads, AreRefusedWithTablesWhoseTimesDoNotIncrease) {
  const std::string force =
      "kind = \"force\"\nmembrane = \"sheet\"\nnodes = \"all\"\nforce = [0, 0, 1]\n";
  expect_problem(force + "factor = [[0, 0], [\"2 ms\", 1], [\"1 ms\", 2]]\n",
                 "loads.a.factor[2]: 0.001 s is not above 0.002 s of the row before; list the rows "
                 "by increasing time");
  expect_problem(force + "factor = [[0, 0], [\"1 mm\", 1]]\n", "loads.a.factor[1][0]");
  expect_problem(force + "factor = [[0, 0], 3]\n", "loads.a.factor[1]: got 3; expected a pair");
  expect_problem(force + "factor = 2\n", "loads.a.factor: got 2; expected a list of pairs");
  expect_problem("kind = \"gravity\"\n", "loads.a.factor: missing");
}

TEST_F(Loads, AreRefusedWhereAComponentIsPrescribedTwice) {
  const std::string pull =
      "kind = \"motion\"\nmembrane = \"sheet\"\nnodes = \"x_max\"\nvelocity = [1, 0, 0]\n";
  expect_problem(pull +
                     "[[loads]]\nname = \"b\"\nkind = \"motion\"\nmembrane = \"sheet\"\n"
                     "nodes = \"y_min\"\ncomponents = \"xz\"\nvelocity = [0, 0, 1]\n",
                 "loads.b.nodes: in \"sheet\", the translation along x of node 4 is prescribed by "
                 "loads.a already");
  expect_problem("kind = \"motion\"\nmembrane = \"net\"\nnodes = \"all\"\nvelocity = [1, 0, 0]\n",
                 "is held by what its body says of hold, or by a stage already");
  EXPECT_EQ(check("[[loads]]\nname = \"a\"\ncomponents = \"x\"\n" + pull +
                  "[[loads]]\nname = \"b\"\nkind = \"motion\"\nmembrane = \"sheet\"\n"
                  "nodes = \"y_min\"\ncomponents = \"z\"\nvelocity = [0, 0, 1]\n")
                .exit_code,
            kDone);
}

TEST_F(Loads, AreRefusedAsMotionsThatDoNotSayHow) {
  const std::string motion = "kind = \"motion\"\nmembrane = \"sheet\"\nnodes = \"all\"\n";
  expect_problem(motion, "loads.a.displacement: got none of displacement and velocity");
  expect_problem(motion + "velocity = [0, 0, 1]\ndisplacement = [0, 0, 1]\n",
                 "loads.a.displacement: got both of displacement and velocity");
  expect_problem(motion + "angular_velocity = [0, 0, 1]\nhold_rotation = false\n",
                 "loads.a.hold_rotation: got false");
  expect_problem(motion + "turn = { angle = \"9 deg\" }\n", "loads.a.turn.point: missing");
  expect_problem(motion + "turn = { point = [0, 0, 0], axis = [0, 0, 0], angle = 1 }\n",
                 "loads.a.turn.axis: got a vector of no length; expected the direction");
  expect_problem(motion + "components = \"x\"\nturn = { point = [0, 0, 0], angle = 1 }\n",
                 "loads.a.components: a turn moves nodes along all axes");
}

TEST_F(Loads, AreRefusedAsMotionsAlongComponentsThatTheyLeaveFree) {
  const std::string motion = "kind = \"motion\"\nmembrane = \"sheet\"\nnodes = \"x_max\"\n";
  expect_problem(motion + "components = \"x\"\nvelocity = [0, 0, 1]\n",
                 "loads.a.velocity: is 1 along z, which components leaves free; expected 0 there, "
                 "or components that name z");
  expect_problem(motion +
                     "components = \"yz\"\ndisplacement = [\"1 mm\", 1, 0]\n"
                     "factor = [[0, 0], [1, 1]]\n",
                 "loads.a.displacement: is 0.001 along x, which components leaves free");
}

TEST_F(Loads, AreRefusedAsMotionsWhoseFactorNeverChanges) {
  const std::string motion = "kind = \"motion\"\nmembrane = \"sheet\"\nnodes = \"x_max\"\n";
  const std::string remedy =
      "nodes move as the factor changes; give factor = [[\"0 s\", 0], [\"10 ms\", 1]]";
  const std::string lift = motion + "displacement = [0, 0, \"1 mm\"]\n";
  expect_problem(lift, "loads.a.factor: missing; " + remedy);
  expect_problem(lift + "factor = [[0, 1], [\"1 ms\", 1]]\n",
                 "loads.a.factor: is 1 at all times; " + remedy);
  expect_problem(motion + "turn = { point = [0, 0, 0], angle = \"9 deg\" }\n",
                 "loads.a.factor: missing; " + remedy);
  expect_problem(motion + "velocity = [0, 0, 1]\nturn = { point = [0, 0, 0], angle = 1 }\n",
                 "loads.a.factor: missing; " + remedy);
  EXPECT_EQ(check("[[loads]]\nname = \"a\"\n" + motion + "displacement = [0, 0, 0]\n").exit_code,
            kDone);
}

TEST_F(Loads, AreRefusedAsServosWithoutATarget) {
  const std::string servo = "kind = \"servo\"\nplane = \"lid\"\nspeed = \"1 cm/s\"\n";
  expect_problem(servo,
                 "loads.a.force: got none of force and pressure; expected exactly one of "
                 "them: a servo needs a target");
  expect_problem(servo + "force = \"-3 N\"\n",
                 "loads.a.force: got \"-3 N\"; expected a force above 0");
  expect_problem(servo + "pressure = \"1 kPa\"\n",
                 "loads.a.area: got none of area and between; expected exactly one of them: a "
                 "pressure needs the area of the plate");
  expect_problem(servo + "pressure = 1\nbetween = [\"left\", \"floor\"]\n",
                 "loads.a.between: \"left\" and \"floor\" do not face each other");
  expect_problem(servo + "pressure = 1\nbetween = [\"left\"]\n", "loads.a.between: got 1 names");
  expect_problem(servo + "force = 1\narea = 1\n", "loads.a.force: is the whole force");
  expect_problem(servo + "force = 1\ngain = 2\n", "loads.a.gain: got 2; expected");
  expect_problem(servo + "force = 1\n[[loads]]\nname = \"b\"\n" + servo + "force = 2\n",
                 "loads.b.plane: \"lid\" is driven by loads.a already");
  expect_problem("kind = \"motion\"\nplane = \"left\"\nvelocity = [1, 0, 0]\n",
                 "loads.a.plane: \"left\" has a velocity of its own");
}

TEST_F(Loads, AreRefusedAsServosThatWouldPull) {
  const std::string problem = "loads.a.factor: falls to -0.5, and a servo does not pull";
  const std::string factor = "factor = [[0, 1], [\"1 ms\", -0.5], [\"2 ms\", 0]]\n";
  expect_problem("kind = \"servo\"\nplane = \"lid\"\nforce = 1\nspeed = 1\n" + factor, problem);
  const std::string body =
      "[[rigid_bodies]]\nname = \"box\"\nshape = { kind = \"box\", size = [0.1, 0.1, 0.1] }\n"
      "translate = [1, 0, 0]\nthickness = \"2 mm\"\nmaterial = \"stone\"\nmass = 1\n";
  expect_problem(
      "kind = \"servo\"\nrigid_body = \"box\"\ndirection = \"-z\"\nforce = 1\n"
      "speed = 1\n" +
          factor + body,
      problem);
  expect_problem(
      "kind = \"servo\"\nrigid_body = \"box\"\nabout = \"z\"\ntorque = 1\n"
      "angular_speed = 1\n" +
          factor + body,
      problem);
}

TEST_F(Loads, AreRefusedWithNegativeStiffnessOrDamping) {
  expect_problem(
      "kind = \"ground_springs\"\nmembrane = \"ball\"\nnodes = \"all\"\n"
      "stiffness = [1, \"-2 N/mm\", 0]\n",
      "loads.a.stiffness[1]: got \"-2 N/mm\"; expected a stiffness (force per length) of "
      "at least 0");
  expect_problem("kind = \"beam_damping\"\nmembrane = \"ball\"\nratio = -0.1\n",
                 "loads.a.ratio: got -0.1; expected");
  expect_problem("kind = \"mass_damping\"\nmembrane = \"ball\"\nnodes = \"all\"\nrate = \"3 s\"\n",
                 "loads.a.rate");
}

TEST_F(Loads, ArePressuresByVolume) {
  const std::string load = "[[loads]]\nname = \"a\"\nkind = \"pressure\"\nmembrane = \"ball\"\n";
  EXPECT_EQ(check(load + "by_volume = [[\"0.1 l\", \"2 kPa\"], [\"0.2 l\", 0]]\n").exit_code,
            kDone);
  const std::string ball = "kind = \"pressure\"\nmembrane = \"ball\"\n";
  const std::string table = "by_volume = [[\"0.1 l\", \"2 kPa\"], [\"0.2 l\", 0]]\n";
  expect_problem(ball, "loads.a.pressure: got none of pressure and by_volume");
  expect_problem(ball + table + "pressure = 1\n", "got both of pressure and by_volume");
  expect_problem(ball + table + "gas = {}\n", "loads.a.gas: by_volume says how");
  expect_problem(ball + "by_volume = [[2, 1], [1, 0]]\n",
                 "loads.a.by_volume[1]: 1 m3 is not above 2 m3 of the row before; list the rows by "
                 "increasing volume");
  expect_problem("kind = \"pressure\"\nmembrane = \"sheet\"\n" + table,
                 "loads.a.by_volume: \"sheet\" is open and encloses no volume");
}

TEST_F(Loads, AreRefusedAsGasInAnOpenSurface) {
  expect_problem(
      "kind = \"pressure\"\nmembrane = \"sheet\"\npressure = \"1 kPa\"\ngas = {}\n",
      "loads.a.gas: \"sheet\" is open and encloses no volume; expected a closed surface");
  expect_problem("kind = \"pressure\"\nmembrane = \"net\"\npressure = \"1 kPa\"\n",
                 "loads.a.membrane: \"net\" is a net without facets");
  expect_problem("kind = \"pressure\"\nmembrane = \"ball\"\npressure = 1\ngas = { exponent = 0 }\n",
                 "loads.a.gas.exponent: got 0; expected");
}

TEST_F(Loads, AreRefusedAsGasOfLessThanNoPressure) {
  const std::string ball = "kind = \"pressure\"\nmembrane = \"ball\"\n";
  expect_problem(ball + "pressure = \"-150 kPa\"\ngas = { outside_pressure = \"100 kPa\" }\n",
                 "loads.a.pressure: times its factor falls to -150000 Pa, which with the "
                 "outside_pressure of 100000 Pa leaves the gas -50000 Pa");
  expect_problem(ball +
                     "pressure = \"60 kPa\"\ngas = { outside_pressure = \"100 kPa\" }\n"
                     "factor = [[0, 1], [\"1 ms\", -2], [\"2 ms\", 0]]\n",
                 "leaves the gas -20000 Pa");
  EXPECT_EQ(check("[[loads]]\nname = \"a\"\n" + ball +
                  "pressure = \"-100 kPa\"\ngas = { outside_pressure = \"100 kPa\" }\n")
                .exit_code,
            kDone);
}

}  // namespace
}  // namespace plekton::apps::loads_command_test
