// SPDX-License-Identifier: GPL-3.0-or-later
// Membranes that stand under a pressure as they are drawn, as the user of the program meets them.
#include "tests/apps/command_line/command_fixture.hpp"
#include "tests/support/shells_of_revolution.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>
#include <string>

namespace plekton::apps::rest_pressure_test {
namespace {

using testing::HasSubstr;
using testing::Not;

class RestPressure : public Command {
 protected:
  RestPressure() {
    geometry::write_mesh_file(folder_ / "torus.off", test::torus(0.1, 0.03, 16, 52));
    geometry::write_mesh_file(folder_ / "tube.off", test::capsule(0.05, 0.2, 6, 12, 30));
    geometry::write_mesh_file(folder_ / "cushion.off", test::cap(0.1, 0.08, 6, 24));
  }

  /// A membrane alone. @param more  keys of it, then other tables
  void write(const std::string& more) const {
    test::write_bytes(scenario(), R"([simulation]
gravity = [0, 0, 0]
duration = "10 ms"
[materials.rubber]
young_modulus = "1 MPa"
friction_angle = 0
[output]
history_interval = "0.1 ms"
[[membranes]]
name = "body"
thickness = "1 mm"
density = "1000 kg/m3"
young_modulus = "2 MPa"
material = "rubber"
)" + more);
  }

  static std::string pressure(const std::string& pascals, const std::string& more = "") {
    return "[[loads]]\nkind = \"pressure\"\nmembrane = \"body\"\npressure = " + pascals + "\n" +
           more;
  }

  /// The largest kinetic energy over the largest one stored, in a run or in the rest of one.
  double most_kinetic(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"run", scenario(), "--out", out(), "--overwrite"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = outcome_of(arguments);
    EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
    std::istringstream rows(test::bytes_of(folder_ / "out/energy.csv"));
    std::string row, name, cell;
    std::getline(rows, row);
    std::vector<std::string> names;
    for (std::istringstream cells(row); std::getline(cells, name, ',');) names.push_back(name);
    double kinetic = 0.0, stored = 0.0;
    while (std::getline(rows, row)) {
      std::istringstream cells(row);
      for (const std::string& column : names) {
        std::getline(cells, cell, ',');
        if (column == "kinetic (J)") kinetic = std::max(kinetic, std::stod(cell));
        if (column == "sheet_elastic (J)" || column == "bond_elastic (J)")
          stored = std::max(stored, std::stod(cell));
      }
    }
    EXPECT_GT(stored, 0.0);
    return kinetic / stored;
  }

  void expect_refused(const std::string& membrane, const std::string& problem) const {
    write(membrane);
    const Outcome outcome = outcome_of({"check", scenario()});
    EXPECT_EQ(outcome.exit_code, kFailed) << membrane;
    EXPECT_THAT(outcome.err, HasSubstr(problem)) << membrane;
    EXPECT_THAT(outcome.err, HasSubstr("case.toml:")) << membrane;
  }
};

/// Strains of 8 and 9 %, of which a prestrain that is the same all ways would leave most.
TEST_F(RestPressure, KeepsShapesFullOfGasAtRestThatBreatheWithout) {
  for (const std::string shape : {"torus", "tube"}) {
    for (const std::string& load : {pressure("4500", "gas = {}\n"), pressure("4500")}) {
      const auto run = [&](const std::string& rest) {
        write("mesh = \"" + shape + ".off\"\nmode = \"continuum\"\npoisson_ratio = 0.4\n" + rest +
              load);
        return most_kinetic();
      };
      EXPECT_LT(run("rest_pressure = \"4.5 kPa\"\n"), 1e-12) << shape;
      EXPECT_LT(report()["energy_closure"], 1e-9) << shape;
      EXPECT_GT(run(""), 0.1) << shape;
    }
  }
}

TEST_F(RestPressure, KeepsLatticesAndTrussesAtRestToo) {
  for (const std::string mode : {"lattice", "truss"}) {
    write("mesh = \"torus.off\"\nmode = \"" + mode + "\"\nrest_pressure = 200\n" +
          pressure("200", "gas = {}\n"));
    EXPECT_LT(most_kinetic(), 1e-12) << mode;
  }
}

/// A stage builds the membrane anew, as the run did before it, and a run that goes on from a stage.
TEST_F(RestPressure, IsTheSameInEveryStage) {
  write(R"(mesh = "cushion.off"
mode = "continuum"
hold = "rim"
rest_pressure = 2000
)" + pressure("2000") +
        R"([[stages]]
name = "first"
[stages.end]
duration = "2 ms"
[[stages]]
name = "second"
[stages.end]
duration = "2 ms"
)");
  std::string text = test::bytes_of(scenario());
  const std::string duration = "duration = \"10 ms\"\n";
  test::write_bytes(scenario(), text.erase(text.find(duration), duration.size()));

  EXPECT_LT(most_kinetic(), 1e-12);
  const auto at_once = test::bytes_of(folder_ / "out/energy.csv");
  const Outcome outcome = outcome_of(
      {"run", scenario(), "--from", "first", out(), "--out", (folder_ / "again").string()});
  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  const auto again = test::bytes_of(folder_ / "again/energy.csv");
  EXPECT_EQ(again.substr(again.rfind('\n', again.size() - 2)),
            at_once.substr(at_once.rfind('\n', at_once.size() - 2)));
}

TEST_F(RestPressure, WarnsOfWhatIsPushedTogether) {
  write("mesh = \"torus.off\"\nmode = \"continuum\"\nrest_pressure = -200\n");
  const Outcome outcome = outcome_of({"check", scenario()});
  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out + outcome.err,
              HasSubstr("body: under its rest_pressure 100 % of its area is pushed together"));

  write("mesh = \"torus.off\"\nmode = \"continuum\"\nrest_pressure = 200\n");
  const Outcome pulled = outcome_of({"check", scenario()});
  EXPECT_THAT(pulled.out + pulled.err, Not(HasSubstr("pushed together")));
}

TEST_F(RestPressure, IsRefusedWhereItCannotBe) {
  const std::string rest = "rest_pressure = \"2 kPa\"\n";
  expect_refused("mesh = \"torus.off\"\nprestrain = 0.01\n" + rest,
                 "membranes.body.rest_pressure: prestrain says already how it is stretched");
  expect_refused(
      "shape = { kind = \"biaxial_geogrid\", rib_pitch = \"2 cm\", bar_pitch = \"2 cm\", "
      "apertures = [3, 3] }\n" +
          rest,
      "membranes.body.rest_pressure: a net has no facets for a pressure to act on");
  expect_refused(
      "shape = { kind = \"box\", size = [1, 1, 1], cells = [4, 4, 4] }\n" + rest,
      "membranes.body: rest_pressure: it cannot stand under this pressure as it is drawn");
  expect_refused(
      "shape = { kind = \"sheet\", width = 1, length = 1, cells = [4, 4] }\nhold = "
      "\"rim\"\n" +
          rest,
      "membranes.body: rest_pressure: it cannot stand under this pressure as it is drawn");
  expect_refused("mesh = \"cushion.off\"\n" + rest,
                 "its surface is open and none of its nodes is held");
  expect_refused("mesh = \"torus.off\"\nmode = \"continuum\"\nrest_pressure = \"1 MPa\"\n",
                 "it would be strained by more than 50 %");
}

TEST_F(RestPressure, IsNoKeyOfRigidBodies) {
  write(
      "mesh = \"torus.off\"\n"
      "[[rigid_bodies]]\nname = \"stone\"\nmesh = \"tube.off\"\nmaterial = \"rubber\"\n"
      "density = \"1000 kg/m3\"\nrest_pressure = 1000\n");

  const Outcome outcome = outcome_of({"check", scenario()});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("rigid_bodies.stone.rest_pressure: unknown key"));
}

}  // namespace
}  // namespace plekton::apps::rest_pressure_test
