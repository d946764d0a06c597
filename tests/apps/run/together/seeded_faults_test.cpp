// SPDX-License-Identifier: GPL-3.0-or-later
// Mistakes that a user makes, one in each scene: `plekton check` or the certificate of the run names
// it.
#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/io/mesh_file.hpp"
#include "tests/apps/command_line/program_fixture.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace plekton::apps::seeded_faults_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A bladder of a mesh file on a floor.
constexpr std::string_view kBladder = R"([simulation]
duration = "2 ms"
[materials.rubber]
density = "1100 kg/m3"
young_modulus = "20 MPa"
friction_angle = "25 deg"
[[membranes]]
name = "bladder"
mesh = "bladder.off"
translate = [0, 0, "5.2 cm"]
mode = "continuum"
thickness = "2 mm"
material = "rubber"
young_modulus = "5 MPa"
density = "1100 kg/m3"
[[planes]]
name = "floor"
point = [0, 0, 0]
material = "rubber"
)";

constexpr std::string_view kPressure = R"([[loads]]
name = "air"
kind = "pressure"
membrane = "bladder"
pressure = "1 kPa"
)";

/// Grains that fall on a floor.
constexpr std::string_view kGrains = R"([simulation]
duration = "2 ms"
[materials.sand]
density = "2650 kg/m3"
young_modulus = "20 MPa"
friction_angle = "30 deg"
[[grains]]
name = "sand"
material = "sand"
radius = "5 mm"
centres = [[0, 0, "10 mm"], ["2 cm", 0, "10 mm"], ["4 cm", 0, "10 mm"]]
velocity = [0, 0, "-1 m/s"]
[[planes]]
name = "floor"
point = [0, 0, 0]
material = "sand"
)";

class SeededFault : public testing::Test {
 protected:
  SeededFault() { write_mesh(geometry::icosphere(0.05, 1)); }

  void write_mesh(const geometry::Mesh& mesh) const {
    geometry::write_mesh_file(folder_ / "bladder.off", mesh);
  }
  Outcome check(const std::string& scenario) const {
    test::write_bytes(folder_ / "case.toml", scenario);
    return outcome_of({"check", (folder_ / "case.toml").string()});
  }
  Outcome run(const std::string& scenario) const {
    test::write_bytes(folder_ / "case.toml", scenario);
    return outcome_of({"run", (folder_ / "case.toml").string(), "--quiet", "--strict",
                       "--overwrite", "--out", (folder_ / "out").string()});
  }
  /// Names of what is red in its certificate.
  std::vector<std::string> reds() const {
    const auto report = nlohmann::json::parse(test::bytes_of(folder_ / "out/run.json"));
    std::vector<std::string> names;
    for (const auto& row : report["certificate"])
      if (row["verdict"] == "red") names.push_back(row["name"]);
    return names;
  }

  test::TemporaryFolder folder_;
};

std::string with_setting(std::string_view scenario, const std::string& setting) {
  const std::string head = "[simulation]\n";
  return head + setting + '\n' + std::string(scenario.substr(head.size()));
}

/// Without a mistake nothing is said.
TEST_F(SeededFault, IsNotSeenWhereThereIsNone) {
  for (const std::string& scenario :
       {std::string(kBladder) + std::string(kPressure), std::string(kGrains)}) {
    const Outcome checked = check(scenario);
    EXPECT_EQ(checked.exit_code, kDone) << checked.err;
    EXPECT_THAT(checked.out, AllOf(HasSubstr("no problems"), Not(HasSubstr("warning"))));
    const Outcome ran = run(scenario);
    EXPECT_EQ(ran.exit_code, kDone) << ran.err;
    EXPECT_EQ(ran.err, "");
  }
}

TEST_F(SeededFault, ATimeStepAboveTheCriticalOneIsRefused) {
  const std::string scenario = with_setting(kGrains, "time_step = \"1 ms\"");

  EXPECT_EQ(check(scenario).exit_code, kFailed);
  const Outcome outcome = run(scenario);
  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("simulation.time_step: 0.001 s is not below 0.8 of the "
                                           "critical time step"),
                                 HasSubstr("choose less than")));
}

/// Below the critical one, but the grains move by a third of their radius in a step.
TEST_F(SeededFault, ATimeStepTooLongForTheMotionIsRedInTheCertificate) {
  std::string scenario = with_setting(kGrains, "time_step = \"16 us\"");
  scenario.replace(scenario.find("-1 m/s"), 6, "-99 m/s");
  const Outcome outcome = run(scenario);

  EXPECT_EQ(outcome.exit_code, kRed);
  EXPECT_THAT(reds(), testing::Contains("largest_motion_ratio"));
  EXPECT_THAT(outcome.err, HasSubstr("of the smallest radius in one step, above 10 %"));
}

/// One node 0.01 mm beside the middle of an edge: a facet of 0.03 degrees.
TEST_F(SeededFault, ASliverFacetIsNamedByItsAngleAndAsWhatLimitsTheStep) {
  geometry::Mesh mesh = geometry::plane_sheet({0.1, 0.1, 4, 4});
  const auto [a, b, c] = mesh.facets.front();
  const geometry::Vec3& xa = mesh.points[geometry::index_of(a)];
  const geometry::Vec3& xb = mesh.points[geometry::index_of(b)];
  const geometry::Vec3& xc = mesh.points[geometry::index_of(c)];
  const auto apex = geometry::id_at<geometry::NodeId>(mesh.points.size());
  const geometry::Vec3 middle = 0.5 * (xa + xb);
  const geometry::Vec3 along = (xb - xa).normalized();
  const geometry::Vec3 height = xc - middle - (xc - middle).dot(along) * along;
  mesh.points.push_back(middle + 1e-5 * height.normalized());
  mesh.facets.front() = {a, b, apex};
  mesh.facets.push_back({b, c, apex});
  mesh.facets.push_back({c, a, apex});
  write_mesh(mesh);
  const Outcome outcome = check(std::string(kBladder));

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("warning: bladder: the smallest angle of a facet is 0.0"),
                    HasSubstr("needles make small time steps"),
                    HasSubstr("half of the facets of bladder are larger than"),
                    HasSubstr("this one is 0.01 mm")));
  EXPECT_THAT(run(std::string(kBladder)).err, HasSubstr("the smallest angle of a facet"));
}

TEST_F(SeededFault, AnOverlapAtTheStartIsListedAndRefusedWhereItIsDeep) {
  std::string grains(kGrains);
  grains.replace(grains.find("[\"2 cm\", 0, "), 12, "[\"9 mm\", 0, ");
  const Outcome shallow = check(grains);

  EXPECT_EQ(shallow.exit_code, kDone);
  EXPECT_THAT(shallow.out, AllOf(HasSubstr("1 mm (20 % of the radius) of grain 0 and grain 1"),
                                 HasSubstr("warning: 1 contact begins with an overlap above 5 %")));

  grains.replace(grains.find("[\"9 mm\", 0, "), 12, "[\"1 mm\", 0, ");
  EXPECT_THAT(check(grains).err, HasSubstr("deeper than both radii, by 9 mm"));
  EXPECT_EQ(run(grains).exit_code, kFailed);
}

/// Nothing of its surface touches that of the other: it is hidden in it.
TEST_F(SeededFault, AGrainInsideOfAnotherIsNamed) {
  const std::string hidden = std::string(kGrains) +
                             "[[grains]]\nname = \"boulder\"\nmaterial = \"sand\"\nradius = \"4 "
                             "cm\"\ncentres = [[\"2 cm\", 0, \"4.1 cm\"]]\n";
  const Outcome outcome = check(hidden);

  EXPECT_THAT(outcome.out + outcome.err,
              HasSubstr("overlaps at the start of grains.sand with grains.boulder"));
  EXPECT_THAT(outcome.out, HasSubstr("warning: 3 contacts begin with an overlap above 5 %"));
}

TEST_F(SeededFault, AFlippedFacetUnderPressureIsNamed) {
  geometry::Mesh mesh = geometry::icosphere(0.05, 1);
  std::swap(mesh.facets[7][0], mesh.facets[7][1]);
  write_mesh(mesh);
  const Outcome outcome = check(std::string(kBladder) + std::string(kPressure));

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(
      outcome.out,
      HasSubstr("warning: loads.air: 1 of the 80 facets of \"bladder\" faced the other way"));
  EXPECT_THAT(check(std::string(kBladder)).out, Not(HasSubstr("warning")));  // no pressure
}

/// A strip whose facets cannot all face one side.
TEST_F(SeededFault, AOneSidedSurfaceUnderPressureIsRefused) {
  geometry::Mesh band;
  constexpr int kCells = 8;
  for (int i = 0; i < kCells; ++i) {
    const double turn = 6.283185307179586 * i / kCells;
    const geometry::Vec3 out(std::cos(turn), std::sin(turn), 0.0);
    const geometry::Vec3 across =
        std::cos(0.5 * turn) * geometry::Vec3::UnitZ() + std::sin(0.5 * turn) * out;
    band.points.push_back(0.05 * out - 0.01 * across);
    band.points.push_back(0.05 * out + 0.01 * across);
  }
  for (int i = 0; i < kCells; ++i) {
    const auto node = [](int number) {
      return geometry::id_at<geometry::NodeId>(static_cast<std::size_t>(number));
    };
    const int next = (i + 1) % kCells;
    const int low = next == 0 ? 1 : 2 * next;  // after a turn both sides have changed places
    const int high = next == 0 ? 0 : 2 * next + 1;
    band.facets.push_back({node(2 * i), node(low), node(high)});
    band.facets.push_back({node(2 * i), node(high), node(2 * i + 1)});
  }
  write_mesh(band);
  const std::string scenario = std::string(kBladder) + std::string(kPressure);

  EXPECT_EQ(check(scenario).exit_code, kFailed);
  EXPECT_THAT(run(scenario).err, HasSubstr("are neighbours but face opposite ways"));
}

TEST_F(SeededFault, AStiffnessAMillionTimesTheOthersIsNamed) {
  std::string scenario(kBladder);
  scenario.replace(scenario.find("5 MPa"), 5, "20 Pa ");
  const Outcome outcome = check(scenario);

  EXPECT_THAT(outcome.out,
              HasSubstr("warning: materials.rubber with E = 2e+07 Pa is 1e+06 times as stiff as "
                        "membranes.bladder with 20 Pa"));
}

TEST_F(SeededFault, AStiffnessRatioOfAMillionIsNamed) {
  std::string scenario(kGrains);
  scenario.replace(scenario.find("friction_angle"), 0, "stiffness_ratio = 1e6\n");
  const Outcome outcome = check(scenario);

  EXPECT_THAT(
      outcome.out,
      HasSubstr("warning: materials.sand.stiffness_ratio: the tangential stiffness is 1e+06 "
                "times the normal one"));
}

constexpr std::string_view kBall = R"([[membranes]]
name = "ball"
shape = { kind = "sphere", radius = "2 cm", subdivisions = 1 }
translate = [0, 0, "5.2 cm"]
mode = "continuum"
thickness = "2 mm"
material = "rubber"
young_modulus = "5 MPa"
density = "1100 kg/m3"
)";

TEST_F(SeededFault, AStructureInsideOfAnotherIsListed) {
  const Outcome outcome = check(std::string(kBladder) + std::string(kBall));

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("overlaps at the start: none"),
                    HasSubstr("inside at the start: 42 of 42 nodes of membranes.ball in "
                              "membranes.bladder")));
}

TEST_F(SeededFault, AStructureThatCrossesAnotherIsRefused) {
  std::string ball(kBall);
  ball.replace(ball.find("[0, 0,"), 6, "[0.045, 0,");
  const std::string scenario = std::string(kBladder) + ball;

  EXPECT_THAT(check(scenario).err, HasSubstr("membranes.bladder: begins in membranes.ball at"));
  EXPECT_EQ(run(scenario).exit_code, kFailed);
}

}  // namespace
}  // namespace plekton::apps::seeded_faults_test
