// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/programs/child_process.hpp"
#include "tests/apps/command_line/command_fixture.hpp"

namespace plekton::apps::import_yade_command_test {
namespace {

using testing::HasSubstr;

class ImportYadeCommand : public Command {
 protected:
  ImportYadeCommand() {
    test::write_bytes(folder_ / "fall.py",
                      "O.materials.append(FrictMat(young=1e7, poisson=0.3, density=2000, "
                      "frictionAngle=0.5, label='rock'))\n"
                      "O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb(), "
                      "Bo1_Wall_Aabb()]), InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), "
                      "Ig2_Wall_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], "
                      "[Law2_ScGeom_FrictPhys_CundallStrack()]), "
                      "NewtonIntegrator(gravity=(0, 0, -9.81), damping=0)]\n"
                      "O.bodies.append(utils.wall(0, axis=2, material='rock'))\n"
                      "O.bodies.append(sphere((0, 0, 0.5), 0.1, material='rock'))\n"
                      "O.dt = 1e-4\n");
  }
  std::string script() const { return (folder_ / "fall.py").string(); }
  static void without_programs() { ::setenv("PATH", "/no/such/folder", 1); }
};

TEST_F(ImportYadeCommand, WritesAScenarioThatRunsAndAReport) {
  if (!find_program("yade")) GTEST_SKIP() << "yade is not installed";

  const Outcome outcome =
      outcome_of({"import-yade", script(), "--iteration", "10", "--out", out()});

  ASSERT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("grains \"spheres 0\": 1, 8.37758 kg"));
  EXPECT_THAT(outcome.out, HasSubstr("plane \"wall 0\""));
  EXPECT_THAT(outcome.out, HasSubstr(test::bytes_of(folder_ / "out/report.txt")));
  EXPECT_EQ(outcome_of({"run", out() + "/fall.toml", "--out", out() + "/run", "--quiet"}).exit_code,
            kDone);
  const Outcome again = outcome_of({"import-yade", script(), "--out", out()});
  EXPECT_EQ(again.exit_code, kFailed);
  EXPECT_THAT(again.err, HasSubstr("--overwrite"));
}

TEST_F(ImportYadeCommand, ReportsThatBodiesBeginTooDeepInEachOther) {
  if (!find_program("yade")) GTEST_SKIP() << "yade is not installed";
  test::write_bytes(folder_ / "deep.py",
                    "O.bodies.append(sphere((0, 0, 0), 0.1))\n"
                    "O.bodies.append(sphere((0, 0, 0.01), 0.15))\n"
                    "O.dt = 1e-6\n");

  const Outcome outcome =
      outcome_of({"import-yade", (folder_ / "deep.py").string(), "--out", out()});

  ASSERT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("plekton refuses the scenario as it stands"));
  EXPECT_THAT(outcome.out, HasSubstr("deeper than both radii"));
  EXPECT_EQ(outcome_of({"check", out() + "/deep.toml"}).exit_code, kFailed);
}

TEST_F(ImportYadeCommand, SaysInOneLineWhatIsMissingOrWrong) {
  const Outcome missing = outcome_of({"import-yade", script()}, without_programs);
  EXPECT_EQ(missing.exit_code, kFailed);
  EXPECT_THAT(missing.err, HasSubstr("is not installed (Debian: yade)"));
  EXPECT_EQ(std::count(missing.err.begin(), missing.err.end(), '\n'), 1) << missing.err;

  EXPECT_EQ(outcome_of({"import-yade", "/no/such.py"}).exit_code, kFailed);
  EXPECT_THAT(
      outcome_of({"import-yade", script(), "--iteration", "-1"}).err,
      HasSubstr("--iteration: got -1; expected at least 0, or end for where the script ends"));
  EXPECT_THAT(outcome_of({"import-yade", script(), "--iteration", "9x"}).err,
              HasSubstr("--iteration: got 9x; expected at least 0, or end"));
  EXPECT_EQ(outcome_of({"import-yade"}).exit_code, kUsage);
}

}  // namespace
}  // namespace plekton::apps::import_yade_command_test
