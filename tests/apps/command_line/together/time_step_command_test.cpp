// SPDX-License-Identifier: GPL-3.0-or-later
// What `plekton check` says of the critical time step.
#include "tests/apps/command_line/command_fixture.hpp"

#include <gmock/gmock.h>

#include <string>

namespace plekton::apps::time_step_command_test {
namespace {

using testing::HasSubstr;
using testing::Not;

class TimeStepAdvice : public Command {
 protected:
  std::string check(const std::vector<std::string>& settings,
                    const std::vector<std::string>& options = {}) const {
    std::vector<std::string> arguments = {"check", scenario()};
    for (const std::string& setting : settings)
      arguments.insert(arguments.end(), {"--set", setting});
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = outcome_of(arguments);
    EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
    return outcome.out;
  }

  /// A sheet of 2 cm cells in which one node comes to within 0.5 mm of the next.
  void write_uneven_sheet() const {
    geometry::Mesh mesh = geometry::plane_sheet({0.2, 0.2, 10, 10});
    mesh.points[60].x() += 0.0195;
    geometry::write_mesh_file(folder_ / "sheet.off", mesh);
  }
};

TEST_F(TimeStepAdvice, NamesTheShortBondAndWhatIsUsual) {
  write_uneven_sheet();

  const std::string out = check({"materials.gravel.young_modulus=10 kPa"});

  EXPECT_THAT(out, HasSubstr("critical step limited by node"));
  EXPECT_THAT(out, HasSubstr("of membrane sheet at ("));
  EXPECT_THAT(out, HasSubstr(", 0.5 mm long, of 1 mm radius"));
  EXPECT_THAT(out, HasSubstr("half of the bonds of sheet are larger than 20 mm, this one is 0.5 "
                             "mm: coarsen the mesh there (weld, target_edge)"));
}

TEST_F(TimeStepAdvice, NamesTheMeshWhereAllBondsAreAlike) {
  const std::string out = check({"materials.gravel.young_modulus=10 kPa"});

  EXPECT_THAT(out, HasSubstr("the bonds of sheet are all of about this size: a coarser mesh, a "
                             "lower young_modulus or a larger density"));
}

TEST_F(TimeStepAdvice, NamesTheNarrowFacetOfASheet) {
  write_uneven_sheet();

  const std::string out =
      check({"materials.gravel.young_modulus=10 kPa", "membranes.sheet.mode=continuum"});

  EXPECT_THAT(out, HasSubstr("is sheet facet "));
  EXPECT_THAT(out, HasSubstr("half of the facets of sheet are larger than 14.1 mm, this one is "));
}

TEST_F(TimeStepAdvice, NamesContactsThatMayCome) {
  const std::string out = check({"materials.gravel.young_modulus=100 GPa"});

  EXPECT_THAT(out, HasSubstr("of what holds it is contacts that may come, the stiffest with "));
  EXPECT_THAT(out, HasSubstr("a lower young_modulus of the materials that touch (gravel), or more "
                             "mass in each node of sheet"));
}

TEST_F(TimeStepAdvice, NamesTheGrainsWhereTheyAreTheStiffest) {
  const std::string out =
      check({"grains.gravel.radius=0.1 mm", "membranes.sheet.areal_mass=30 kg/m2"});

  EXPECT_THAT(out, HasSubstr("of grains gravel at ("));
  EXPECT_THAT(out, HasSubstr("or larger or heavier grains"));
}

TEST_F(TimeStepAdvice, SaysThatGasOrDampingShortensTheStep) {
  const std::string table =
      "[[loads]]\nkind = \"mass_damping\"\nmembrane = \"sheet\"\nnodes = \"all\"\n"
      "rate = \"1e6 Hz\"\n";
  test::write_bytes(folder_ / "case.toml", std::string(kScenario) + table);

  EXPECT_THAT(check({}), HasSubstr("gas and viscous damping shorten it from "));
}

TEST_F(TimeStepAdvice, SaysThatDashpotsShortenTheStep) {
  const std::string table =
      "[[contacts]]\nbetween = \"gravel\"\nand = \"gravel\"\nrestitution = 0.05\n";
  test::write_bytes(folder_ / "case.toml", std::string(kScenario) + table);

  EXPECT_THAT(check({}), HasSubstr("dashpots shorten it from "));
  EXPECT_THAT(check({"contacts.0.restitution=1"}), Not(HasSubstr("dashpots")));
}

TEST_F(TimeStepAdvice, NamesTheInertiaOfEdgesWhereATurnLimits) {
  const std::string file = (folder_ / "first.toml").string();
  ASSERT_EQ(outcome_of({"new", file}).exit_code, kDone);

  const std::string out = outcome_of({"check", file}).out;

  EXPECT_THAT(out, HasSubstr("as it turns"));
  EXPECT_THAT(out, HasSubstr("or nodal_inertia = \"length\" of sheet"));
  EXPECT_THAT(outcome_of({"check", file, "--set", "membranes.0.nodal_inertia=length"}).out,
              Not(HasSubstr("nodal_inertia")));
}

// It named 0.65 of the critical step with all contacts that may come, which is not what is chosen.
TEST_F(TimeStepAdvice, NamesForAGivenStepThatIsTooLongTheOneThatWouldBeChosen) {
  const std::string out = check({});
  const std::string begin = "time step: ";
  const std::size_t first = out.find(begin) + begin.size();
  const std::string chosen = out.substr(first, out.find(" s to begin with", first) - first);

  const Outcome outcome = outcome_of({"check", scenario(), "--set", "simulation.time_step=1 ms"});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("or \"auto\", which begins with " + chosen + " s"));
}

TEST_F(TimeStepAdvice, IsJoinedByPowerIterationIfAsked) {
  const std::string asked = check({}, {"--power-iteration"});

  EXPECT_THAT(asked, HasSubstr("critical step by power iteration: "));
  EXPECT_THAT(asked,
              HasSubstr("with its 0 contacts of grains and planes, those between membranes by "
                        "bounds at their nodes (not counted), and none that may come"));
  EXPECT_THAT(check({}), Not(HasSubstr("power iteration")));
}

}  // namespace
}  // namespace plekton::apps::time_step_command_test
