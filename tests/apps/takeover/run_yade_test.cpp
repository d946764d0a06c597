// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/takeover/run_yade.hpp"

#include "apps/programs/child_process.hpp"
#include "apps/scenario/problems.hpp"
#include "apps/takeover/export_script.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plekton::apps::yade::run_yade_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr std::string_view kScript = R"(from yade import qt
from yade.gridpfacet import *
O.materials.append(CohFrictMat(young=1e8, poisson=0.3, density=1000, frictionAngle=0.5,
    normalCohesion=1e40, shearCohesion=1e40, momentRotationLaw=True, label='inner'))
O.materials.append(FrictMat(young=1e7, poisson=0.3, density=2000, frictionAngle=0.5, label='outer'))
O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_GridConnection_Aabb()]),
    InteractionLoop([Ig2_GridNode_GridNode_GridNodeGeom6D()],
        [Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True)],
        [Law2_ScGeom6D_CohFrictPhys_CohesionMoment()]),
    NewtonIntegrator(gravity=(0, 0, -10), damping=0)]
ids = [O.bodies.append(gridNode((x, 0, 0), 0.01, material='inner')) for x in (0, 0.5)]
O.bodies[ids[0]].state.blockedDOFs = 'xyzXYZ'
O.bodies.append(gridConnection(ids[0], ids[1], 0.01, material='outer'))
O.bodies.append(sphere((0, 0, 1), 0.1, material='outer'))
O.dt = 1e-5
qt.View().ortho = True
)";

std::string problem_of(const std::string& script, std::optional<long> iteration) {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "case.py", script);
  try {
    run_to(folder / "case.py", iteration);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(RunYade, TellsWhatAScriptHasMadeAtAnIteration) {
  if (!find_program("yade")) GTEST_SKIP() << "yade is not installed";
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "case.py", std::string(kScript));

  const Scene scene = run_to(folder / "case.py", 100);

  EXPECT_EQ(scene.iteration, 100);
  ASSERT_EQ(scene.nodes.size(), 2u);
  EXPECT_EQ(scene.nodes[0].blocked, "xyzXYZ");
  EXPECT_EQ(scene.connections.size(), 1u);
  EXPECT_EQ(scene.bonds.size(), 1u);
  ASSERT_EQ(scene.spheres.size(), 1u);
  // g t, after 100 steps of 1e-5 s
  EXPECT_NEAR(scene.spheres[0].velocity[2], -10.0 * 1e-3, 1e-12);
  EXPECT_EQ(scene.materials.at(static_cast<std::size_t>(scene.spheres[0].material)).label, "outer");
  EXPECT_TRUE(has_functor(scene, "Law2_ScGeom6D_CohFrictPhys_CohesionMoment"));
}

TEST(RunYade, TellsWhatFunctorsSetThatHasNoCounterpart) {
  if (!find_program("yade")) GTEST_SKIP() << "yade is not installed";
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "case.py", R"(
O.materials.append(FrictMat(young=1e7, poisson=0.3, density=2000, frictionAngle=0.5))
O.bodies.append([sphere((0, 0, 0), 0.1), sphere((0, 0, 1), 0.1)])
O.engines = [InteractionLoop([Ig2_Sphere_Sphere_ScGeom()],
    [Ip2_FrictMat_FrictMat_MindlinPhys(en=0.3, es=0.3, frictAngle=0.1)],
    [Law2_ScGeom_MindlinPhys_Mindlin(includeMoment=True)]),
    InteractionLoop([], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()])]
O.dt = 1e-5
)");

  const Scene scene = run_to(folder / "case.py", 0);

  EXPECT_THAT(scene.functor_settings,
              testing::ElementsAre(testing::Pair("Ip2_FrictMat_FrictMat_MindlinPhys",
                                                 testing::ElementsAre("en", "es", "frictAngle")),
                                   testing::Pair("Law2_ScGeom_MindlinPhys_Mindlin",
                                                 testing::ElementsAre("includeMoment"))));
}

TEST(RunYade, TellsWhyAScriptFails) {
  if (!find_program("yade")) GTEST_SKIP() << "yade is not installed";

  EXPECT_THAT(problem_of("no_such_name", 0), HasSubstr("no_such_name"));
  EXPECT_THAT(problem_of(std::string(kScript) + "O.run(50, True)\n", 20),
              AllOf(HasSubstr("has run to iteration 50 by itself"), HasSubstr("--iteration end")));
  EXPECT_THAT(problem_of(std::string(kScript) + "O.run()\n", std::nullopt),
              HasSubstr("leaves YADE running without an end; name an --iteration"));
}

TEST(RunYade, TakesWhatIsThereWhereAScriptEnds) {
  if (!find_program("yade")) GTEST_SKIP() << "yade is not installed";
  const test::TemporaryFolder folder;
  for (const char* const run : {"O.run(50, True)\n", "O.run(50)\n"}) {
    test::write_bytes(folder / "case.py", std::string(kScript) + run);

    EXPECT_EQ(run_to(folder / "case.py", std::nullopt).iteration, 50) << run;
  }
}

TEST(RunYade, NamesTheBodyThatIsNowhere) {
  if (!find_program("yade")) GTEST_SKIP() << "yade is not installed";

  EXPECT_THAT(
      problem_of(std::string(kScript) + "O.bodies[3].state.pos = (0, 0, float('nan'))\n", 0),
      HasSubstr("body 3: position is nan at iteration 0, expected a finite number"));
}

TEST(RunYade, NamesAScriptThatIsMissing) {
  EXPECT_THROW(run_to("/no/such/file.py", 0), InputError);
}

TEST(ExportScript, IsTheFileOfTheTree) {
  const auto file = std::filesystem::path(PLEKTON_SOURCE_DIR) / "apps/takeover/export_scene.py";

  EXPECT_EQ(export_script(), test::bytes_of(file));
}

}  // namespace
}  // namespace plekton::apps::yade::run_yade_test
