// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/pictures/plot.hpp"

#include "apps/scenario/problems.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace plekton::apps::plot_test {
namespace {

using testing::HasSubstr;
using testing::Not;

std::vector<RecordedHistory> histories() {
  RecordedHistory energy{"energy.csv",
                         {{"time", "s", {0, 1}},
                          {"kinetic", "J", {0, 2}},
                          {"friction", "J", {0, 0}},
                          {"gravity", "J", {0, -1}},
                          {"contacts", "", {0, 5}},
                          {"time_step", "s", {1e-5, 1e-5}}}};
  RecordedHistory reactions{"reactions.csv",
                            {{"time", "s", {0, 1}}, {"floor's.force_z", "N", {0, 3}}}};
  return {energy, reactions};
}

std::vector<std::string> names_of(const PlotPanel& panel) {
  std::vector<std::string> names;
  for (const RecordedHistory::Column* column : panel.columns) names.push_back(column->name);
  return names;
}

TEST(PlotPanels, HoldWhatIsNotZeroByFileAndUnit) {
  const auto all = histories();
  const auto panels = panels_of(all, {});

  ASSERT_EQ(panels.size(), 3U);
  EXPECT_THAT(names_of(panels[0]), testing::ElementsAre("kinetic", "gravity"));
  EXPECT_EQ(panels[0].quantity, "energy (J)");
  EXPECT_THAT(names_of(panels[1]), testing::ElementsAre("contacts"));
  EXPECT_EQ(panels[1].quantity, "number");
  EXPECT_THAT(names_of(panels[2]), testing::ElementsAre("floor's.force_z"));
  EXPECT_EQ(panels[2].quantity, "force (N)");
}

TEST(PlotPanels, HoldWhatHasNoUnitByWhatItIs) {
  const std::vector<RecordedHistory> all = {{"measures/core.csv",
                                             {{"time", "s", {0, 1}},
                                              {"porosity", "", {0.4, 0.5}},
                                              {"grains", "", {7, 8}},
                                              {"rattlers", "", {0, 1}},
                                              {"fabric_xx", "", {0.3, 0.4}},
                                              {"fabric_xy", "", {0, 0.1}},
                                              {"fabric_xz", "", {0, 0}}}}};

  const auto panels = panels_of(all, {});

  ASSERT_EQ(panels.size(), 3U);
  EXPECT_EQ(panels[0].quantity, "porosity");
  EXPECT_THAT(names_of(panels[1]), testing::ElementsAre("grains", "rattlers"));
  EXPECT_EQ(panels[1].quantity, "number");
  EXPECT_THAT(names_of(panels[2]), testing::ElementsAre("fabric_xx", "fabric_xy"));
  EXPECT_EQ(panels[2].quantity, "fabric");
}

// A slip was a position, and a velocity a value.
TEST(PlotPanels, HoldWhatHasAUnitByWhatItIs) {
  const std::vector<RecordedHistory> all = {{"ties.csv",
                                             {{"time", "s", {0, 1}},
                                              {"slip.position_x", "m", {1, 2}},
                                              {"net.largest_slip", "m", {0, 1}},
                                              {"net[0].slip", "m", {0, 1}},
                                              {"drum.radius", "m", {1, 2}},
                                              {"ball.velocity_z", "m/s", {0, 1}},
                                              {"ball.angular_velocity_z", "rad/s", {0, 1}},
                                              {"core.stress_zz", "Pa", {0, 1}},
                                              {"gas.pressure", "Pa", {0, 1}}}}};

  std::vector<std::string> quantities;
  for (const PlotPanel& panel : panels_of(all, {})) quantities.push_back(panel.quantity);

  EXPECT_THAT(quantities,
              testing::ElementsAre("position (m)", "slip (m)", "radius (m)", "velocity (m/s)",
                                   "angular velocity (rad/s)", "stress (Pa)", "pressure (Pa)"));
}

TEST(PlotPanels, HoldOfPlanesWhatChanges) {
  const double none = std::nan("");
  const std::vector<RecordedHistory> all = {{"planes.csv",
                                             {{"time", "s", {0, 1, 2}},
                                              {"floor.point_z", "m", {-1, -1, -1}},
                                              {"late.point_z", "m", {none, -1, -1}},
                                              {"side.normal_z", "", {1, 1, 1}},
                                              {"side.radius", "m", {0.5, 0.5, 0.4}}}}};
  const std::vector<std::string> names = {"floor.point_z"};

  ASSERT_EQ(panels_of(all, {}).size(), 1U);
  EXPECT_THAT(names_of(panels_of(all, {})[0]), testing::ElementsAre("side.radius"));
  EXPECT_THAT(names_of(panels_of(all, names)[0]), testing::ElementsAre("floor.point_z"));
}

// "x" was taken of the first file that has it, and the columns of the second refused.
TEST(PlotPanels, AreOfTheFileThatHasThePlaceAndTheForce) {
  const std::vector<RecordedHistory> all = {
      {"reactions.csv", {{"time", "s", {0, 1}}, {"x", "m", {0, 1}}}},
      {"bodies.csv", {{"time", "s", {0, 1}}, {"x", "m", {0, 2}}, {"force", "N", {3, 4}}}}};
  const std::vector<std::string> names = {"force"};

  const auto panels = panels_of(all, names, "x");

  ASSERT_EQ(panels.size(), 1U);
  EXPECT_EQ(panels[0].file, "bodies.csv");
  EXPECT_THAT(panels[0].x, testing::ElementsAre(0, 2));
}

// As measures of several regions.
TEST(PlotPanels, AreOfEachFileThatHasThePlaceAndTheForce) {
  const std::vector<RecordedHistory> all = {
      {"measures/low.csv",
       {{"time", "s", {0, 1}}, {"porosity", "", {0.4, 0.3}}, {"stress_zz", "Pa", {1, 2}}}},
      {"measures/top.csv",
       {{"time", "s", {0, 1}}, {"porosity", "", {0.5, 0.4}}, {"stress_zz", "Pa", {2, 3}}}}};
  const std::vector<std::string> names = {"stress_zz"};

  const auto panels = panels_of(all, names, "porosity");

  ASSERT_EQ(panels.size(), 2U);
  EXPECT_EQ(panels[0].file, "measures/low.csv");
  EXPECT_EQ(panels[1].file, "measures/top.csv");
}

TEST(PlotPanels, OfOneFileLeaveOutItsNamesakesInOthers) {
  const std::vector<RecordedHistory> all = {
      {"bodies.csv", {{"time", "s", {0, 1}}, {"x", "m", {0, 2}}, {"force", "N", {3, 4}}}},
      {"reactions.csv", {{"time", "s", {0, 1}}, {"force", "N", {5, 6}}}}};
  const std::vector<std::string> names = {"force"};

  const auto panels = panels_of(all, names, "x");

  ASSERT_EQ(panels.size(), 1U);
  EXPECT_EQ(panels[0].file, "bodies.csv");
}

// gnuplot refuses the whole picture for a panel without a point.
TEST(PlotPanels, HaveNoColumnsWithoutAFiniteValue) {
  const double none = std::nan("");
  const std::vector<RecordedHistory> all = {
      {"measures/top.csv",
       {{"time", "s", {0, 1}}, {"porosity", "", {0.4, 0.4}}, {"fabric_xx", "", {none, none}}}},
      {"measures/low.csv", {{"time", "s", {0, 1}}, {"fabric_xx", "", {none, 0.3}}}}};
  const std::vector<std::string> of_both = {"fabric_xx"};
  const std::vector<RecordedHistory> top = {all.front()};

  EXPECT_EQ(panels_of(all, of_both).size(), 1U);
  EXPECT_THAT([&] { panels_of(top, of_both); },
              testing::ThrowsMessage<InputError>(
                  "--columns: \"fabric_xx\" has no finite value to draw; leave it out"));
}

TEST(GnuplotScript, OfVeryManyPanelsIsNoHigherThanAPictureCanBe) {
  std::vector<RecordedHistory> all;
  for (int i = 0; i < 100; ++i)
    all.push_back({"measures/" + std::to_string(i) + ".csv",
                   {{"time", "s", {0, 1}}, {"porosity", "", {0.4, 0.5}}}});

  EXPECT_THAT(gnuplot_script(panels_of(all, {}), "run", PictureKind::png, "/tmp/picture"),
              HasSubstr("size 900,32000 "));
}

TEST(PlotPanels, HoldTheColumnsThatAreNamed) {
  const auto all = histories();
  const std::vector<std::string> names = {"contacts", "friction"};
  const auto panels = panels_of(all, names);

  ASSERT_EQ(panels.size(), 2U);
  EXPECT_EQ(panels[0].quantity, "energy (J)");
  EXPECT_EQ(panels[1].quantity, "number");
}

// A column of a plane "drum, left" could not be named.
TEST(PlotColumns, MayHaveCommasInTheirNames) {
  auto all = histories();
  for (const char* const name : {"drum, left.force_x", "drum"})
    all[1].columns.push_back({name, "N", {0, 1}});
  const std::vector<std::string> texts = {"kinetic,drum, left.force_x,drum,none,friction",
                                          "contacts"};

  EXPECT_THAT(column_names_in(texts, all),
              testing::ElementsAre("kinetic", "drum, left.force_x", "drum", "none", "friction",
                                   "contacts"));
}

TEST(PlotPanels, RefuseAColumnThatIsNotThere) {
  const auto all = histories();
  const std::vector<std::string> names = {"kinetik"};
  try {
    panels_of(all, names);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("did you mean \"kinetic\"?"));
  }
}

TEST(PlotPanels, AreDrawnOverAColumnOfTheirFile) {
  const auto all = histories();
  const auto panels = panels_of(all, {}, "kinetic");

  ASSERT_EQ(panels.size(), 2U);
  EXPECT_THAT(names_of(panels[0]), testing::ElementsAre("gravity"));
  EXPECT_EQ(panels[0].x_head, "kinetic (J)");
  EXPECT_THAT(panels[0].x, testing::ElementsAre(0, 2));
  EXPECT_THAT(gnuplot_script(panels, "run", PictureKind::svg, "/tmp/picture"),
              testing::AllOf(HasSubstr("set xlabel 'kinetic (J)'"), HasSubstr("\n2 -1\n")));
  EXPECT_EQ(panels_of(all, {})[0].x_head, "time (s)");
}

TEST(PlotPanels, RefuseAnAbscissaThatIsNotThereOrOfAnotherFile) {
  const auto all = histories();
  const std::vector<std::string> names = {"kinetic"};
  for (const auto& [x, said] :
       {std::pair{"gravty", "--x: no history of the run has a column \"gravty\"; did you mean"},
        std::pair{"floor's.force_z", "\"kinetic\" is in energy.csv and cannot be drawn over"}}) {
    try {
      panels_of(all, names, x);
      ADD_FAILURE() << x;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(said));
    }
  }
}

TEST(GnuplotScript, KeepsTextsInQuotesThatNothingGetsOutOf) {
  auto all = histories();
  all[1].columns[1].name = "a'; system('x')\n`id`";
  const auto script =
      gnuplot_script(panels_of(all, {}), "it's\n!rm", PictureKind::svg, "/tmp/picture");

  EXPECT_THAT(script, HasSubstr("title 'a''; system(''x'') `id`'"));
  EXPECT_THAT(script, HasSubstr("title 'it''s !rm' noenhanced"));
  EXPECT_THAT(script, Not(HasSubstr("\n!rm")));
}

TEST(GnuplotScript, KeepsPeaksOfLongHistories) {
  std::vector<double> times(100'000);
  std::vector<double> values(times.size(), 1.0);
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = static_cast<double>(i);
  values[77'777] = 9.0;
  values[12'345] = -9.0;
  const std::vector<RecordedHistory> all = {
      {"energy.csv", {{"time", "s", times}, {"kinetic", "J", values}}}};

  const auto script = gnuplot_script(panels_of(all, {}), "run", PictureKind::png, "/tmp/picture");

  EXPECT_THAT(script, HasSubstr("\n77777 9\n"));
  EXPECT_THAT(script, HasSubstr("\n12345 -9\n"));
  EXPECT_LT(std::count(script.begin(), script.end(), '\n'), 5000);
}

}  // namespace
}  // namespace plekton::apps::plot_test
