// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/viewer/run_folder.hpp"

#include "apps/viewer/view_error.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace plekton::apps::run_folder_test {
namespace {

using testing::HasSubstr;

std::string complaint_about(const std::filesystem::path& folder) {
  try {
    open_run_folder(folder);
  } catch (const ViewError& error) {
    return error.what();
  }
  return "";
}

TEST(RunFolder, SaysWhatIsNoFolderOfARun) {
  const test::TemporaryFolder folder;
  EXPECT_THAT(complaint_about(folder / "none"), HasSubstr("there is no such folder"));
  EXPECT_THAT(complaint_about(folder.path()), HasSubstr("holds no run"));
  test::write_bytes(folder / "file", "");
  EXPECT_THAT(complaint_about(folder / "file"), HasSubstr("is no folder"));
  test::write_bytes(folder / "run.json", "{\"name\": \"else\"}");
  EXPECT_THAT(complaint_about(folder.path()), HasSubstr("is no report of a run"));
  test::write_bytes(folder / "run.json", "{\"plekton\": \"0.1.0\"");
  EXPECT_THAT(complaint_about(folder.path()), HasSubstr("is no report of a run"));
}

TEST(RunFolder, SaysWhatIsNoSeries) {
  const test::TemporaryFolder folder;
  for (const std::string bytes : {"", "time (s),x\n", "<VTKFile><Collection>",
                                  "<VTKFile><DataSet timestep=\"1 s\" file=\"a\"/></VTKFile>",
                                  "<VTKFile><DataSet timestep=\"nan\" file=\"a\"/></VTKFile>"}) {
    test::write_bytes(folder / "grains.pvd", bytes);
    EXPECT_THAT(complaint_about(folder.path()), HasSubstr("grains.pvd: ")) << bytes;
  }
}

TEST(RunFolder, PutsTogetherWhatSeriesHaveOfAMoment) {
  const test::TemporaryFolder folder;
  const std::string head = "<VTKFile><Collection>", tail = "</Collection></VTKFile>";
  const auto set = [](const std::string& time, const std::string& file) {
    return "<DataSet timestep=\"" + time + "\" part=\"0\" file=\"" + file + "\"/>";
  };
  test::write_bytes(folder / "grains.pvd", head + set("0", "g0") + set("0.5", "g1") + tail);
  test::write_bytes(folder / "contacts.pvd", head + set("0", "c0") + tail);

  const RunFolder run = open_run_folder(folder.path());

  ASSERT_EQ(run.frames.size(), 2U);
  EXPECT_EQ(run.frames[0].of[0], folder / "g0");
  EXPECT_EQ(run.frames[0].of[2], folder / "c0");
  EXPECT_EQ(run.frames[1].time, 0.5);
  EXPECT_TRUE(run.frames[1].of[2].empty());
  EXPECT_FALSE(run.report);
}

TEST(RunFolder, ReadsHistoriesWithUnitsAndWithoutARowThatIsBeingWritten) {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "energy.csv", "time (s),kinetic (J),ratio\n0,1.5,inf\n1,2,3\n2,4");

  const RecordedHistory history = read_history(folder / "energy.csv");

  ASSERT_EQ(history.columns.size(), 3U);
  EXPECT_EQ(history.columns[1].name, "kinetic");
  EXPECT_EQ(history.columns[1].unit, "J");
  EXPECT_EQ(history.columns[2].unit, "");
  EXPECT_EQ(history.rows(), 2U);
  EXPECT_TRUE(std::isinf(history.columns[2].values[0]));
}

TEST(RunFolder, ReadsNamesOfColumnsWithCommasAndQuotes) {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "reactions.csv",
                    "time (s),\"a, \"\"b\"\".force (N)\",plain\n0,1,2\n3,4,5\n");

  const RecordedHistory history = read_history(folder / "reactions.csv");

  ASSERT_EQ(history.columns.size(), 3U);
  EXPECT_EQ(history.columns[1].name, "a, \"b\".force");
  EXPECT_EQ(history.columns[1].unit, "N");
  EXPECT_EQ(history.columns[2].name, "plain");
  EXPECT_EQ(history.columns[2].values, (std::vector<double>{2.0, 5.0}));
}

TEST(RunFolder, RefusesHistoriesThatAreNone) {
  const test::TemporaryFolder folder;
  for (const std::string bytes : {"a,b\n1,2\n", "time (s),b\n1\n", "time (s),b\n1,x\n"}) {
    test::write_bytes(folder / "energy.csv", bytes);
    EXPECT_THROW(read_history(folder / "energy.csv"), ViewError) << bytes;
  }
}

TEST(RunFolder, FindsThePlanesAtTheTimeOfAFrame) {
  RunFolder run;
  run.planes = RecordedHistory{"planes.csv",
                               {{"time", "s", {0, 1}},
                                {"lid.point_x", "m", {0, 0}},
                                {"lid.point_y", "m", {0, 0}},
                                {"lid.point_z", "m", {3, 2}},
                                {"lid.normal_x", "", {0, 0}},
                                {"lid.normal_y", "", {0, 0}},
                                {"lid.normal_z", "", {-1, -1}}}};

  EXPECT_EQ(planes_at(run, 0.999), (std::vector<PlaneNumbers>{{0, 0, 2, 0, 0, -1, 0}}));
}

TEST(RunFolder, LeavesOutPlanesThatComeInALaterStage) {
  const double none = std::nan("");
  RunFolder run;
  run.planes = RecordedHistory{"planes.csv", {{"time", "s", {0, 1}}}};
  for (const char* name : {"floor", "lid"})
    for (const char* field : {".point_x", ".point_y", ".point_z", ".normal_x", ".normal_y"})
      run.planes->columns.push_back(
          {std::string(name) + field, "", {name[0] == 'l' ? none : 0, 0}});
  run.planes->columns.insert(run.planes->columns.begin() + 6, {"floor.normal_z", "", {1, 1}});
  run.planes->columns.push_back({"lid.normal_z", "", {none, -1}});

  EXPECT_EQ(planes_at(run, 0.0), (std::vector<PlaneNumbers>{{0, 0, 0, 0, 0, 1, 0}}));
  EXPECT_EQ(planes_at(run, 1.0),
            (std::vector<PlaneNumbers>{{0, 0, 0, 0, 0, 1, 0}, {0, 0, 0, 0, 0, -1, 0}}));
}

TEST(RunFolder, KnowsContainersByTheirRadius) {
  RunFolder run;
  run.planes = RecordedHistory{"planes.csv", {{"time", "s", {0}}}};
  const PlaneNumbers drum = {1, 2, 3, 0, 1, 0, 0.25};
  for (const char* name : {"floor", "drum"}) {
    std::size_t i = 0;
    for (const char* field : {".point_x", ".point_y", ".point_z", ".normal_x", ".normal_y",
                              ".normal_z", ".radius", ".pressing"}) {
      const double of_floor = i == 5 ? 1.0 : 0.0;
      const double of_drum = i < drum.size() ? drum[i] : 17.0;
      run.planes->columns.push_back(
          {std::string(name) + field, "", {name[0] == 'd' ? of_drum : of_floor}});
      ++i;
    }
  }

  EXPECT_EQ(planes_at(run, 0.0), (std::vector<PlaneNumbers>{{0, 0, 0, 0, 0, 1, 0}, drum}));
}

TEST(RunFolder, ReadsHistoriesOfBodiesTiesPlanesAndMeasuresInTheOrderOfTheirNames) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "measures");
  for (const char* name : {"measures/top.csv", "measures/bottom.csv", "ties.csv",
                           "rigid_bodies.csv", "energy.csv", "planes.csv"})
    test::write_bytes(folder / name, "time (s),x (m)\n0,1\n");
  test::write_bytes(folder / "measures/notes.txt", "no table\n");
  test::write_bytes(folder / "reactions.csv", "time (s),x (m)\n");

  std::vector<std::string> files;
  for (const RecordedHistory& history : read_histories(folder.path()))
    files.push_back(history.file);

  EXPECT_THAT(files, testing::ElementsAre("energy.csv", "rigid_bodies.csv", "ties.csv",
                                          "planes.csv", "measures/bottom.csv", "measures/top.csv"));
}

}  // namespace
}  // namespace plekton::apps::run_folder_test
