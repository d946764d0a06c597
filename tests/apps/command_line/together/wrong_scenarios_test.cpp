// SPDX-License-Identifier: GPL-3.0-or-later
// Scenarios with one mistake each: what `plekton check` says about it.
#include "tests/apps/command_line/program_fixture.hpp"
#include "tests/apps/command_line/sheet_and_ball.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace plekton::apps::wrong_scenarios_test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// A sheet, a closed ball and a lid; the mistakes are added below.
const std::string kSound = std::string(kSheetAndSphere) + std::string(kLid);

/// One mistake.
struct Mistake {
  std::string_view name;
  std::string_view text;    ///< added to the sound scenario
  std::string_view at;      ///< where in the text the message has to point; found once
  std::string_view got;     ///< in the message: the key, and what was found there
  std::string_view expect;  ///< in the message: what was expected, or the way out
};

std::ostream& operator<<(std::ostream& out, const Mistake& mistake) {
  return out << mistake.name;
}

const std::vector<Mistake>& mistakes() {
  static const std::vector<Mistake> all = {
      {"UnknownLawForAPair",
       "[[contacts]]\nbetween = \"stone\"\nand = \"stone\"\nlaw = \"hertz_mindlins\"\n",
       "\"hertz_mindlins\"", "contacts[0].law: got \"hertz_mindlins\"",
       "expected one of \"linear_frictional\", \"hertz_mindlin\", \"dmt_adhesion\", "
       "\"cohesive_frictional\"; did you mean \"hertz_mindlin\"?"},
      {"NegativePlasticLimit",
       "[[contacts]]\nbetween = \"stone\"\nand = \"stone\"\nrolling_limit = -0.1\n", "-0.1",
       "contacts[0].rolling_limit: got -0.1",
       "expected a number without unit of at least 0, or no such key for no limit"},
      {"ParameterOfAnotherLaw",
       "[[contacts]]\nbetween = \"stone\"\nand = \"stone\"\nlaw = \"hertz_mindlin\"\n"
       "tensile_strength = \"1 kPa\"\n",
       "\"1 kPa\"",
       "contacts[0].tensile_strength: goes with law = \"cohesive_frictional\", but this pair has "
       "\"hertz_mindlin\"",
       "change the law, or leave tensile_strength out"},
      {"PairOfAnUnknownMaterial", "[[contacts]]\nbetween = \"stone\"\nand = \"ston\"\n", "\"ston\"",
       "contacts[0].and: there is no material \"ston\"", "did you mean \"stone\"?"},
      {"GasInAnOpenSurface",
       "[[loads]]\nkind = \"pressure\"\nmembrane = \"sheet\"\npressure = \"1 kPa\"\ngas = {}\n",
       "{}", "loads[0].gas: \"sheet\" is open and encloses no volume",
       "expected a closed surface: close it (fill_holes), or leave gas out"},
      {"TwoPrescriptionsOnOneNode",
       "[[loads]]\nname = \"pull\"\nkind = \"motion\"\nmembrane = \"sheet\"\nnodes = \"x_max\"\n"
       "velocity = [1, 0, 0]\n[[loads]]\nname = \"lift\"\nkind = \"motion\"\n"
       "membrane = \"sheet\"\nnodes = \"y_max\"\nvelocity = [0, 0, 1]\n",
       "\"y_max\"",
       "loads.lift.nodes: in \"sheet\", the translation along x of node 24 is prescribed by "
       "loads.pull already",
       "take other nodes or components"},
      {"NodesOfTwoBodiesThatNothingConnects",
       "[[loads]]\nkind = \"force\"\nmembrane = [\"sheet\", \"ball\"]\nnodes = \"all\"\n"
       "force = [0, 0, 1]\n",
       "[\"sheet\", \"ball\"]", "loads[0].membrane: got a list",
       "expected one name in quotes; give each body a table of its own"},
      {"BondsBetweenTwoBodies", "[[bonds]]\nbetween = \"sheet\"\nand = \"ball\"\n", "bonds",
       "bonds: unknown key", "known here: \"simulation\", \"materials\", \"contacts\""},
      {"ServoWithoutATarget", "[[loads]]\nkind = \"servo\"\nplane = \"lid\"\nspeed = 1\n",
       "[[loads]]", "loads[0].force: got none of force and pressure",
       "expected exactly one of them: a servo needs a target"},
      {"SievesWhosePassingDecreases",
       "[[grains]]\nmaterial = \"stone\"\ncount = 5\n"
       "sieves = [{ sieve = \"4 mm\", passing = 0 }, { sieve = \"8 mm\", passing = \"60 %\" },\n"
       "  { sieve = \"12 mm\", passing = \"50 %\" }]\n"
       "box = { min = [-1, -1, 1], max = [1, 1, 2] }\n",
       "\"50 %\"", "grains[0].sieves[2].passing: 0.5 is below 0.6 of the row before",
       "a larger sieve lets no less pass"},
      {"SievesWhoseSizesGoBack",
       "[[grains]]\nmaterial = \"stone\"\ncount = 5\n"
       "sieves = [{ sieve = \"8 mm\", passing = 0 },\n  { sieve = \"6 mm\", passing = 1 }]\n"
       "box = { min = [-1, -1, 1], max = [1, 1, 2] }\n",
       "\"6 mm\"", "grains[0].sieves[1].sieve: 0.006 m is not above 0.008 m of the row before",
       "list the sieves from small to large"},
      {"TimesThatGoBack",
       "[[loads]]\nkind = \"gravity\"\nfactor = [[\"0 s\", 0], [\"2 ms\", 1], [\"1 ms\", 2]]\n",
       "[\"1 ms\"", "loads[0].factor[2]: 0.001 s is not above 0.002 s of the row before",
       "list the rows by increasing time"},
      {"TorqueOnNodesThatDoNotTurn",
       "[[membranes]]\nname = \"cloth\"\nthickness = \"2 mm\"\nmaterial = \"stone\"\n"
       "shape = { kind = \"sheet\", width = 1, length = 1, cells = [2, 2] }\nmode = \"truss\"\n"
       "translate = [0, 0, -1]\nyoung_modulus = \"50 MPa\"\nareal_mass = \"300 g/m2\"\n"
       "[[loads]]\nkind = \"force\"\nmembrane = \"cloth\"\nnodes = \"x_max\"\n"
       "torque = [0, 0, 2]\n",
       "[0, 0, 2]", "loads[0].torque: the nodes of \"cloth\" do not turn",
       "expected a force, or a membrane in mode lattice, or continuum with bending stiffness"},
      {"UnknownSetOfNodes",
       "[[loads]]\nkind = \"force\"\nmembrane = \"sheet\"\nnodes = \"x_mx\"\nforce = [0, 0, 1]\n",
       "\"x_mx\"", "loads[0].nodes: got \"x_mx\"",
       "expected one of \"all\", \"rim\", \"x_min\", \"x_max\", \"y_min\", \"y_max\", \"z_min\", "
       "\"z_max\"; did you mean \"x_max\"?"},
      {"SetWithoutNodes",
       "[[loads]]\nkind = \"force\"\nmembrane = \"sheet\"\nforce = [0, 0, 1]\n"
       "nodes = { min = [5, 5, 5], max = [6, 6, 6] }\n",
       "{ min", "loads[0].nodes: \"sheet\" has no node there",
       "the box counts in the scene, after scale, rotate and translate"},
      {"UnitThatDoesNotFit",
       "[[loads]]\nkind = \"force\"\nmembrane = \"sheet\"\nnodes = \"x_max\"\n"
       "force = [0, 0, \"1 kg\"]\n",
       "\"1 kg\"", "loads[0].force[2]: got \"1 kg\", a mass", "expected a force (N, kN, MN, mN)"},
      {"MeshFileThatIsMissing",
       "[[membranes]]\nname = \"net\"\nmesh = \"missing.off\"\nthickness = \"2 mm\"\n"
       "material = \"stone\"\nyoung_modulus = \"50 MPa\"\nareal_mass = \"300 g/m2\"\n",
       "\"missing.off\"", "missing.off\" does not exist",
       "expected a mesh (.off, .obj, .stl, .ply, .msh, .vtp), its path relative to the scenario"},
      {"KeyThatIsMisspelt",
       "[[planes]]\nname = \"floor\"\npoint = [0, 0, -1]\nmaterial = \"stone\"\nvelocty = [0, 0, "
       "1]\n",
       "velocty", "planes.floor.velocty: unknown key", "did you mean \"velocity\"?"},
      {"RimOfAClosedShape",
       "[[membranes]]\nname = \"shell\"\nthickness = \"2 mm\"\nmaterial = \"stone\"\n"
       "shape = { kind = \"sphere\", radius = \"3 cm\", subdivisions = 1 }\nhold = \"rim\"\n"
       "young_modulus = \"50 MPa\"\nareal_mass = \"300 g/m2\"\n",
       "\"rim\"", "membranes.shell.hold: a sphere or box is closed and has no rim",
       "hold the nodes in a box, hold = { min = [...], max = [...] }"},
      {"TwoTablesForOnePair",
       "[[contacts]]\nbetween = \"stone\"\nand = \"stone\"\n[[contacts]]\nbetween = \"stone\"\n"
       "and = 'stone'\n",
       "'stone'", "contacts[1].and: \"stone\" and \"stone\" have a table [[contacts]] already",
       "expected one for each pair of materials"}};
  return all;
}

class WrongScenario : public testing::TestWithParam<Mistake> {
 protected:
  std::string file() const { return (folder_ / "case.toml").string(); }

  /// As in "case.toml:31:7".
  std::string place(std::string_view text) const {
    const std::size_t at = kSound.size() + text.find(GetParam().at);
    const std::string before = (kSound + std::string(text)).substr(0, at);
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    return file() + ':' + std::to_string(line) + ':' +
           std::to_string(before.size() - before.rfind('\n'));
  }

  test::TemporaryFolder folder_;
};

TEST_P(WrongScenario, IsRefusedWithPlaceFindingAndRemedy) {
  const Mistake& mistake = GetParam();
  ASSERT_EQ(mistake.text.find(mistake.at), mistake.text.rfind(mistake.at));
  test::write_bytes(folder_ / "case.toml", kSound + std::string(mistake.text));

  const Outcome outcome = outcome_of({"check", file()});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, StartsWith("plekton: " + place(mistake.text) + ": "));
  EXPECT_THAT(outcome.err, HasSubstr(std::string(mistake.got)));
  EXPECT_THAT(outcome.err, HasSubstr(std::string(mistake.expect)));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1);
  EXPECT_EQ(folder_.names(), std::vector<std::string>{"case.toml"});
}

INSTANTIATE_TEST_SUITE_P(Each, WrongScenario, testing::ValuesIn(mistakes()),
                         [](const auto& mistake) { return std::string(mistake.param.name); });

TEST(SoundScenario, OfTheMistakesHasNone) {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "case.toml", kSound);

  EXPECT_EQ(outcome_of({"check", (folder / "case.toml").string()}).exit_code, kDone);
}

TEST(WrongScenarios, OfKeysWithoutEndAreRefusedByTheirLine) {
  const test::TemporaryFolder folder;
  std::string key = "a";
  for (int i = 0; i < 200'000; ++i) key += ".a";
  const std::vector<std::string> texts = {"\n\n" + key + " = 1\n", "\n\n[" + key + "]\n",
                                          "\n\n[[" + key + "]]\n",
                                          "text = \"\"\"\n\"\"\"\nx = { " + key + " = 1 }\n",
                                          "# [a\ntext = '[\"'\nx = [ { " + key + " = 1 } ]\n"};
  for (const std::string& text : texts) {
    test::write_bytes(folder / "case.toml", text);

    const Outcome outcome = outcome_of({"check", (folder / "case.toml").string()});

    EXPECT_EQ(outcome.exit_code, kFailed) << text.substr(0, 40);
    EXPECT_THAT(outcome.err, testing::HasSubstr("case.toml:3:")) << text.substr(0, 40);
    EXPECT_THAT(outcome.err, testing::HasSubstr("more than 32 deep"));
  }
}

TEST(WrongScenarios, WithAnOverrideOfKeysWithoutEndAreRefused) {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "case.toml", "");
  std::string key = "a";
  for (int i = 0; i < 50'000; ++i) key += ".a";

  const Outcome outcome =
      outcome_of({"check", (folder / "case.toml").string(), "--set", "x={" + key + "=1}"});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, testing::HasSubstr("more than 32 deep"));
}

TEST(WrongScenarios, ThatAreNoFilesOfADiskAreRefused) {
  const test::TemporaryFolder folder;
  std::filesystem::create_symlink("/proc/self/maps", folder / "case.toml");

  const Outcome outcome = outcome_of({"check", (folder / "case.toml").string()});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, testing::HasSubstr("case.toml: not a file on a disk"));
}

}  // namespace
}  // namespace plekton::apps::wrong_scenarios_test
