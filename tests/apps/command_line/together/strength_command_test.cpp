// SPDX-License-Identifier: GPL-3.0-or-later
// Membranes that yield and break, as the user of the program meets them.
#include "apps/scenario/scenario_reader.hpp"
#include "apps/scene/build_scene.hpp"
#include "dynamics/scene_check.hpp"
#include "tests/apps/command_line/program_fixture.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <array>
#include <numbers>
#include <variant>

namespace plekton::apps::strength_command_test {
namespace {

using dynamics::BondStrength;
using dynamics::WireCurve;
using testing::HasSubstr;
using testing::Not;

constexpr std::string_view kHexagonal =
    R"(kind = "hexagonal_net", mesh_size = "8 cm", twist_length = "4 cm", wire_height = "3 cm", meshes = [4, 3])";
constexpr std::string_view kSheet =
    R"(kind = "sheet", width = "1 m", length = "2 m", cells = [10, 20])";

/// A scenario with a membrane of this shape; the first of more is line 13.
std::string scenario_with(std::string_view shape, std::string_view more) {
  return fmt::format(R"([simulation]
duration = "20 ms"
gravity = [0, 0, 0]
[materials.steel]
young_modulus = "1 GPa"
friction_angle = "20 deg"
[[membranes]]
name = "m"
shape = {{ {} }}
thickness = "2 mm"
material = "steel"
density = "7850 kg/m3"
{}
)",
                     shape, more);
}

class StrengthCommand : public testing::Test {
 protected:
  std::string error_of(std::string_view shape, std::string_view more) const {
    test::write_bytes(folder_ / "case.toml", scenario_with(shape, more));
    const Outcome outcome = outcome_of({"check", (folder_ / "case.toml").string()});
    EXPECT_EQ(outcome.exit_code, kFailed) << outcome.out;
    return outcome.err;
  }
  BuiltScene built(std::string_view shape, std::string_view more) const {
    return build_scene(parse_scenario(scenario_with(shape, more), folder_ / "case.toml"));
  }

  test::TemporaryFolder folder_;
};

TEST_F(StrengthCommand, AdvisesASofterWireWhereThereIsNoModulusToLower) {
  test::write_bytes(folder_ / "case.toml",
                    scenario_with(kHexagonal, "mode = \"truss\"\nwire = [[0.01, 1000]]"));

  const Outcome outcome = outcome_of({"check", (folder_ / "case.toml").string()});

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("a coarser mesh, a softer first piece of wire or a larger "
                                     "density"));
}

TEST_F(StrengthCommand, GivesBeamsTheirLimits) {
  const BuiltScene scene = built(kSheet, R"(young_modulus = "2 GPa"
yield_stress = "20 MPa"
hardening = "50 MPa"
strength = "30 MPa"
rupture_strain = "12 %")");

  ASSERT_EQ(scene.scene.bond_laws.size(), 1U);
  EXPECT_EQ(scene.scene.bond_laws[0].bonds.size(), scene.scene.bonds.size());
  const auto& strength = std::get<BondStrength>(scene.scene.bond_laws[0].law);
  EXPECT_EQ(strength.yield_stress, 20e6);
  EXPECT_EQ(strength.hardening, 50e6);
  EXPECT_EQ(strength.strength, 30e6);
  EXPECT_DOUBLE_EQ(strength.rupture_strain, 0.12);
  EXPECT_NO_THROW(dynamics::check(scene.scene));
}

TEST_F(StrengthCommand, LeavesBeamsElasticUnlessTold) {
  EXPECT_TRUE(built(kSheet, "young_modulus = \"2 GPa\"").scene.bond_laws.empty());
}

TEST_F(StrengthCommand, GivesASheetTheStressAtWhichItTears) {
  const BuiltScene scene =
      built(kSheet, "young_modulus = \"2 GPa\"\nmode = \"continuum\"\nstrength = \"3 MPa\"");

  EXPECT_TRUE(scene.scene.bond_laws.empty());
  for (const dynamics::SheetFacet& facet : scene.scene.sheet_facets)
    EXPECT_EQ(facet.section.strength, 3e6);
}

// One half is moved off at 1 m/s: two rows of facets between are strained by 10 % in 20 ms, and
// tear at 5 %, one of them or both.
TEST_F(StrengthCommand, RunTearsASheetAndCountsItsFacets) {
  test::write_bytes(folder_ / "case.toml", scenario_with(kSheet, R"(young_modulus = "2 MPa"
mode = "continuum"
strength = "100 kPa"
bending_stiffness = 0
hold = { min = [-1, -1, -1], max = [1, -0.05, 1] }
[[loads]]
kind = "motion"
membrane = "m"
nodes = { min = [-1, 0.05, -1], max = [1, 1, 1] }
velocity = [0, "1 m/s", 0]
)"));

  const Outcome outcome =
      outcome_of({"run", (folder_ / "case.toml").string(), "--out", (folder_ / "out").string()});

  ASSERT_EQ(outcome.exit_code, kDone) << outcome.err;
  const auto report = nlohmann::json::parse(test::bytes_of(folder_ / "out/run.json"));
  EXPECT_GE(report["counts"]["torn_facets"], 20);
  EXPECT_GT(report["energy"]["bond_dissipated_J"], 0.0);
  EXPECT_LT(report["energy_closure"], 0.01);
}

TEST_F(StrengthCommand, GivesWiresAndTwistsTheirCurves) {
  const BuiltScene scene = built(kHexagonal, R"(mode = "truss"
wire = [["1 %", "1 kN"], ["10 %", "2 kN"]]
twist_wire = [["1 %", "3 kN"]])");

  ASSERT_EQ(scene.scene.bond_laws.size(), 2U);
  const auto& [wire, wires] = scene.scene.bond_laws[0];
  const auto& [twist, twists] = scene.scene.bond_laws[1];
  EXPECT_EQ(wires.size() + twists.size(), scene.scene.bonds.size());
  EXPECT_EQ(twists.size(), 5U + 4U + 5U);
  EXPECT_EQ(std::get<WireCurve>(wire).points[1].force, 2000.0);
  EXPECT_EQ(std::get<WireCurve>(twist).points.size(), 1U);
  for (const std::size_t bond : twists)
    EXPECT_NEAR(scene.scene.bonds[bond].length, 0.04, 1e-12);  // of twist_length
  EXPECT_NEAR(scene.membranes[0].young_modulus, 1e5 / (std::numbers::pi * 1e-6), 1.0);
  EXPECT_NO_THROW(dynamics::check(scene.scene));
}

TEST_F(StrengthCommand, NamesWhatIsWrongWithItsLineAndARemedy) {
  struct Case {
    std::string_view shape, more, message;
  };
  const std::array<Case, 15> cases{{
      {kSheet, "young_modulus = \"2 GPa\"\nyield_stress = \"-1 MPa\"",
       "case.toml:14:16: membranes.m.yield_stress: got \"-1 MPa\""},
      {kSheet, "young_modulus = \"2 GPa\"\nyield_stress = \"1 MPa\"\nhardening = \"-1 MPa\"",
       "case.toml:15:13: membranes.m.hardening: got \"-1 MPa\""},
      {kSheet, "young_modulus = \"2 GPa\"\nhardening = \"1 MPa\"",
       "case.toml:14:13: membranes.m.hardening: says how a bar goes on beyond its yield stress; "
       "give yield_stress"},
      {kSheet, "young_modulus = \"2 GPa\"\nrupture_strain = 0.1",
       "membranes.m.rupture_strain: says how a bar goes on beyond its yield stress"},
      {kSheet, "young_modulus = \"2 GPa\"\nmode = \"continuum\"\nyield_stress = \"1 MPa\"",
       "case.toml:15:16: membranes.m.yield_stress: is of beams and bars; a continuum stays elastic "
       "until it tears at its strength"},
      {kHexagonal, "wire = [[0.01, 1000]]",
       "case.toml:13:8: membranes.m.wire: a wire is pulled and nothing else; use mode = \"truss\""},
      {kHexagonal, "mode = \"truss\"\nwire = [[0.02, 1000], [0.01, 2000]]",
       "case.toml:14:23: membranes.m.wire[1]: 0.01 is not above 0.02 of the row before; list the "
       "rows by "
       "increasing strain"},
      {kHexagonal, "mode = \"truss\"\nwire = [[0.01, 1000], [0.02, \"-1 N\"]]",
       "case.toml:14:30: membranes.m.wire[1][1]: got \"-1 N\"; expected a force of at least 0"},
      {kSheet, "young_modulus = 1e9\nyield_stress = \"20 MPa\"\nstrength = \"10 MPa\"",
       "case.toml:15:12: membranes.m.strength: 1e+07 Pa is below the yield_stress of 2e+07 Pa: it "
       "breaks before it yields; leave yield_stress out"},
      {kHexagonal, "mode = \"truss\"\nwire = [[0.01, 1000], [0.02, 3000]]",
       "membranes.m.wire: the curve, point 2: the piece before it is steeper"},
      {kHexagonal, "mode = \"truss\"\nwire = [[0.01, \"1 MPa\"]]", "expected a force"},
      {kHexagonal, "mode = \"truss\"\nwire = []", "membranes.m.wire: got"},
      {kHexagonal, "mode = \"truss\"\nwire = [[0.01, 1000]]\nyoung_modulus = \"1 GPa\"",
       "case.toml:15:17: membranes.m.young_modulus: the stiffness of wires follows from the first "
       "row of wire; leave it out"},
      {kHexagonal, "mode = \"truss\"\nwire = [[0.01, 1000]]\nstrength = \"1 GPa\"",
       "membranes.m.strength: the curve of wire says where it yields and breaks; leave it out"},
      {kSheet, "mode = \"truss\"\nwire = [[0.01, 1000]]\ntwist_wire = [[0.01, 1000]]",
       "case.toml:15:14: membranes.m.twist_wire: only a hexagonal_net has twists; use wire alone"},
  }};
  for (const Case& c : cases)
    EXPECT_THAT(error_of(c.shape, c.more), HasSubstr(std::string(c.message))) << c.more;
  EXPECT_THAT(error_of(kHexagonal, "mode = \"truss\"\nwire = [[0.01, -1000], [0.02, 3000]]"),
              Not(HasSubstr("problems")));
  EXPECT_THAT(error_of(kHexagonal, "mode = \"truss\"\ntwist_wire = [[0.01, 1000]]"),
              HasSubstr("twist_wire: goes with wire, the curve of the single wires; give both"));
}

/// Two held sides that are pulled apart.
constexpr std::string_view kPulled = R"(
[[loads]]
kind = "motion"
membrane = "m"
nodes = "y_min"
displacement = [0, 0, 0]
[[loads]]
kind = "motion"
membrane = "m"
nodes = "y_max"
velocity = [0, "5 m/s", 0]
)";

TEST_F(StrengthCommand, AccountsForWhatATornNetHasLost) {
  test::write_bytes(folder_ / "case.toml", scenario_with(kHexagonal, fmt::format(R"(mode = "truss"
wire = [["1 %", "1 kN"], ["6 %", "1.5 kN"]]
{})",
                                                                                 kPulled)));
  const std::string out = (folder_ / "out").string();

  const Outcome outcome = outcome_of({"run", (folder_ / "case.toml").string(), "--out", out});

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  const nlohmann::json energy =
      nlohmann::json::parse(test::bytes_of(folder_ / "out/run.json")).at("energy");
  EXPECT_GT(energy.at("bond_dissipated_J").get<double>(),
            0.5 * energy.at("turnover_J").get<double>());
  EXPECT_LT(std::abs(energy.at("closure_error_J").get<double>()),
            5e-3 * energy.at("turnover_J").get<double>());
  EXPECT_THAT(test::bytes_of(folder_ / "out/energy.csv"), HasSubstr("bond_dissipated"));
  EXPECT_THAT(outcome.out, HasSubstr("broken bonds: "));
}

}  // namespace
}  // namespace plekton::apps::strength_command_test
