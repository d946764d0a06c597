// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/other_file.hpp"

#include "tests/apps/command_line/program_fixture.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <string>

namespace plekton::apps::other_file_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFalling = R"([simulation]
duration = "1 ms"
[materials.soil]
density = "2650 kg/m3"
young_modulus = "20 MPa"
friction_angle = "30 deg"
[[grains]]
material = "soil"
radius = "5 mm"
centres = [[0, 0, 0]]
)";

// The page of the earlier run stayed beside the results of another one.
TEST(OverwrittenRun, TakesAlongWhatWasDrawnOfIt) {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "a.toml", kFalling);
  const std::string out = (folder / "out").string();
  const std::vector<std::string> run = {
      "run", (folder / "a.toml").string(), "--quiet", "--out", out, "--overwrite"};
  ASSERT_EQ(Program(run).wait().exit_code, kDone);
  ASSERT_EQ(Program({"view", out}).wait().exit_code, kDone);
  test::write_bytes(folder / "out/plot.svg", "<?xml version=\"1.0\"?><desc>Produced by GNUPLOT 5");
  test::write_bytes(folder / "out/frame.png", "\x89PNG\r\n\x1a\n");
  test::write_bytes(folder / "out/mine.html", test::bytes_of(folder / "out/view.html"));
  ASSERT_EQ(Program(run).wait().exit_code, kDone);

  for (const char* const drawn : {kViewPage, kPlotDrawing, kFramePicture})
    EXPECT_FALSE(fs::exists(fs::path(out) / drawn)) << drawn;
  EXPECT_TRUE(fs::exists(folder / "out/mine.html"));
}

// A picture of somebody else was removed by the first run into its folder.
TEST(FirstRun, LeavesWhatIsInItsFolder) {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "a.toml", kFalling);
  const std::vector<std::string> others = {"plot.png", "thesis.pdf.part", "frames/mine.vtp.part"};
  fs::create_directories(folder / "out/frames");
  for (const std::string& name : others)
    test::write_bytes(folder / ("out/" + name), "\x89PNG\r\n\x1a\n");
  test::write_bytes(folder / "out/energy.csv.part", "of a run that was killed");
  test::write_bytes(folder / "out/frames/grains_00001.vtp.part", "of a run that was killed");

  const Outcome outcome =
      Program({"run", (folder / "a.toml").string(), "--quiet", "--out", (folder / "out").string()})
          .wait();

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  for (const std::string& name : others) EXPECT_TRUE(fs::exists(folder / ("out/" + name))) << name;
  EXPECT_FALSE(fs::exists(folder / "out/energy.csv.part"));
  EXPECT_FALSE(fs::exists(folder / "out/frames/grains_00001.vtp.part"));
}

TEST(RemovePictures, LeavesFilesOfOthersOfTheSameNames) {
  const test::TemporaryFolder folder;
  for (const char* const drawn : {kViewPage, kPlotDrawing, kPlotPicture, kFramePicture})
    test::write_bytes(folder / drawn, "notes");
  remove_pictures(folder.path());

  for (const char* const drawn : {kViewPage, kPlotDrawing, kPlotPicture, kFramePicture})
    EXPECT_EQ(test::bytes_of(folder / drawn), "notes") << drawn;
}

}  // namespace
}  // namespace plekton::apps::other_file_test
