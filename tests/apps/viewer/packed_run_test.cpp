// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of the program, packed and read again, against the frames as they were written.
#include "apps/viewer/packed_run.hpp"

#include "apps/viewer/live_run.hpp"
#include "apps/viewer/page.hpp"
#include "apps/viewer/view_error.hpp"
#include "tests/apps/command_line/command_fixture.hpp"
#include "tests/apps/viewer/unpacked.hpp"

#include <algorithm>

namespace plekton::apps::packed_run_test {
namespace {

using testing::HasSubstr;

class PackedRunOf : public Command {
 protected:
  PackedRunOf() {
    EXPECT_EQ(outcome_of({"run", scenario(), "--out", out(), "--quiet"}).exit_code, kDone);
    run_ = open_run_folder(out());
  }

  PackedRun packed() {
    PackedRun packed;
    for (const FrameFiles& frame : run_.frames) packed.add(frame, planes_at(run_, frame.time));
    for (const auto& [name, text] : packed.blocks()) blocks_.add(name, text);
    return packed;
  }

  std::vector<double> values(const std::string& block, const std::string& series,
                             const std::string& on, const std::string& name) const {
    return blocks_.values(blocks_.record(block, series, on, name));
  }

  std::string frame(const std::string& series, int number) const {
    return out() + "/frames/" + series + "_0000" + std::to_string(number) + ".vtp";
  }

  RunFolder run_;
  Blocks blocks_;
};

TEST_F(PackedRunOf, HasEveryFrameWithItsTimeAndCounts) {
  const auto header = packed().header(run_, {});

  ASSERT_EQ(header["frames"].size(), 5U);  // 0, 5, 10, 15, 20 ms
  for (const auto& frame : header["frames"]) {
    EXPECT_EQ(frame["grains"], 20);
    EXPECT_EQ(frame["nodes"], 121);
    EXPECT_EQ(frame["facets"], 200);
  }
  EXPECT_NEAR(header["frames"][4]["time"], 0.02, 1e-4);
  EXPECT_EQ(header["title"], "out");
  EXPECT_EQ(header["run"]["status"], "finished");
}

TEST_F(PackedRunOf, TellsPositionsOfLaterFramesAsWays) {
  packed();

  EXPECT_FALSE(blocks_.record("0", "grains", "grains", "position").contains("key"));
  EXPECT_EQ(blocks_.record("1", "grains", "grains", "position")["key"],
            blocks_.record("0", "grains", "grains", "position")["at"]);
}

TEST_F(PackedRunOf, HasPlacesToAStepOfTheBoxAndVelocitiesToOnePartIn512) {
  packed();
  const Results written = read_results(frame("grains", 3));

  const auto places = values("3", "grains", "grains", "position");
  const auto velocities = values("3", "grains", "grains", "velocity");

  ASSERT_EQ(places.size(), written.positions.size());
  // No grain has left the box of 12 cm.
  for (std::size_t i = 0; i < places.size(); ++i)
    EXPECT_NEAR(places[i], written.positions[i], 0.12 / 65535.0);
  const auto& own =
      std::find_if(written.of_points.begin(), written.of_points.end(), [](const auto& array) {
        return array.name == "velocity";
      })->values;
  double most = 0.0;
  for (const double v : own) most = std::max(most, std::abs(v));
  // Below 2^-14 / 60000 of the largest the steps are even.
  const double step = most / 60000.0 * 0x1p-22;
  for (std::size_t i = 0; i < own.size(); ++i)
    EXPECT_NEAR(velocities[i], own[i], std::abs(own[i]) / 512.0 + step);
}

TEST_F(PackedRunOf, StoresWhatDoesNotChangeOnce) {
  packed();

  EXPECT_EQ(blocks_.record("0", "grains", "grains", "radius")["at"][0], "0");
  EXPECT_EQ(blocks_.record("4", "grains", "grains", "radius")["at"][0], "0");
  EXPECT_EQ(blocks_.record("4", "membranes", "facets", "nodes")["at"][0], "0");
  EXPECT_EQ(blocks_.record("4", "grains", "grains", "position")["at"][0], "4");
}

TEST_F(PackedRunOf, TellsWhereThePlanesAre) {
  const auto header = packed().header(run_, {});

  EXPECT_EQ(header["frames"][2]["planes"],
            (nlohmann::ordered_json{{0.0, 0.0, -0.05, 0.0, 0.0, 1.0, 0.0}}));
}

TEST_F(PackedRunOf, HasUnitsAndRangesOfFields) {
  const auto fields = packed().header(run_, {})["fields"];

  const auto velocity = std::find_if(fields["grains"].begin(), fields["grains"].end(),
                                     [](const auto& f) { return f["name"] == "velocity"; });
  ASSERT_NE(velocity, fields["grains"].end());
  EXPECT_EQ((*velocity)["unit"], "m/s");
  // They begin with 1 m/s and fall 3 to 8 cm at most: sqrt(1 + 2 g 0.08) = 1.6 m/s.
  EXPECT_GT((*velocity)["range"][1], 1.0);
  EXPECT_LT((*velocity)["range"][1], 1.6);
}

TEST_F(PackedRunOf, HasThePointsOfContactsThatAreNotBetweenSpheres) {
  packed();
  for (const std::string block : {"2", "3", "4"}) {
    const auto a = values(block, "contacts", "contacts", "kind_a");
    const auto b = values(block, "contacts", "contacts", "kind_b");
    std::size_t others = 0;
    for (std::size_t i = 0; i < a.size(); ++i) others += a[i] != 0.0 || b[i] != 0.0 ? 1U : 0U;

    EXPECT_EQ(values(block, "contacts", "places", "point").size(), 3 * others);
  }
}

TEST_F(PackedRunOf, ThinsWhatIsAboveALimitKeepsTheLastFrameAndSaysSo) {
  const PageData all = pack_run(run_, 100'000'000);
  ASSERT_EQ(all.packed.frames(), 5U);
  EXPECT_TRUE(all.notes.empty());

  // The first frame takes more than half, as later ones name what is as in it.
  const std::size_t limit = all.packed.size() * 4 / 5;
  const PageData data = pack_run(run_, limit);

  EXPECT_LT(data.packed.frames(), 5U);
  EXPECT_LE(data.packed.size(), limit);
  const auto header = data.packed.header(run_, data.notes);
  EXPECT_EQ(header["frames"].back()["time"].get<double>(), run_.frames.back().time);
  ASSERT_FALSE(data.notes.empty());
  EXPECT_THAT(data.notes[0], HasSubstr("of 5 frames are shown"));
  EXPECT_THAT(data.notes[0], testing::Not(HasSubstr("the limit of 0 MB")));
}

TEST_F(PackedRunOf, RefusesFramesThatAreCutOffOrSomethingElse) {
  const std::string whole = test::bytes_of(frame("grains", 2));
  for (const std::string& bytes :
       {whole.substr(0, whole.size() / 2), whole.substr(0, 200),
        whole.substr(0, whole.find("</VTKFile>")), whole.substr(0, whole.size() - 2),
        std::string("solid"),
        std::string("<?xml version=\"1.0\"?><VTKFile type=\"PolyData\"></VTKFile>")}) {
    test::write_bytes(frame("grains", 2), bytes);
    try {
      packed();
      FAIL() << bytes.size();
    } catch (const ViewError& error) {
      EXPECT_THAT(error.what(), HasSubstr("grains_00002.vtp: is no frame"));
    }
  }
}

TEST_F(PackedRunOf, FollowsARunThatGrows) {
  // As it was after three frames.
  const std::string series = test::bytes_of(out() + "/grains.pvd");
  std::string shorter;
  for (std::size_t at = 0, sets = 0; at < series.size();) {
    const std::size_t end = series.find('\n', at) + 1;
    const std::string line = series.substr(at, end - at);
    if (line.find("<DataSet") == std::string::npos || ++sets <= 3) shorter += line;
    at = end;
  }
  for (const char* file : {"/membranes.pvd", "/contacts.pvd", "/run.json"})
    std::filesystem::remove(out() + file);
  test::write_bytes(out() + "/grains.pvd", shorter);
  LiveRun live(out(), 1'000'000);
  live.refresh();
  const auto before = nlohmann::json::parse(live.header());
  ASSERT_EQ(before["frames"].size(), 3U);
  EXPECT_TRUE(before["run"].is_null());

  test::write_bytes(out() + "/grains.pvd", series);
  live.refresh();

  const auto after = nlohmann::json::parse(live.header());
  EXPECT_EQ(after["frames"].size(), 5U);
  EXPECT_GT(after["version"], before["version"]);
  EXPECT_EQ(after["generation"], before["generation"]);
  const auto generation = after["generation"].get<std::size_t>();
  EXPECT_TRUE(live.block(std::to_string(generation), "4"));
  EXPECT_FALSE(live.block(std::to_string(generation), "5"));
  EXPECT_FALSE(live.block(std::to_string(generation + 1), "4"));

  live.refresh();
  EXPECT_EQ(nlohmann::json::parse(live.header())["version"], after["version"]);
}

TEST_F(PackedRunOf, FollowsARunWithinALimitByLeavingFramesOut) {
  LiveRun live(out(), packed().size() * 2 / 3);
  const auto at_first = nlohmann::json::parse(live.header())["generation"].get<std::size_t>();

  live.refresh();

  const auto header = nlohmann::json::parse(live.header());
  EXPECT_LT(header["frames"].size(), 5U);
  EXPECT_GT(header["generation"].get<std::size_t>(), at_first);
  EXPECT_FALSE(header["notes"].empty());
  // The next frame that is shown lies beyond the last of the run: that is no other run.
  live.refresh();
  const auto later = nlohmann::json::parse(live.header());
  EXPECT_EQ(later["generation"], header["generation"]);
  EXPECT_EQ(later["version"], header["version"]);
}

/// Also with one that has as many frames.
TEST_F(PackedRunOf, BeginsAnewWithAnotherRunInTheSameFolder) {
  LiveRun live(out(), 1'000'000);
  live.refresh();
  auto before = nlohmann::json::parse(live.header());
  ASSERT_EQ(before["frames"].size(), 5U);
  const double whole = before["frames"].back()["time"];
  for (const double part : {0.4, 1.0, 1.0}) {
    ASSERT_EQ(outcome_of({"run", scenario(), "--out", out(), "--overwrite", "--quiet", "--set",
                          "simulation.duration=" + std::to_string(part * whole)})
                  .exit_code,
              kDone);

    live.refresh();

    const auto after = nlohmann::json::parse(live.header());
    EXPECT_EQ(after["frames"].size() == 5U, part == 1.0);
    EXPECT_GT(after["frames"].size(), 0U);
    EXPECT_NE(after["generation"], before["generation"]);
    EXPECT_FALSE(after["histories"].get<std::string>().empty());
    before = after;
  }
}

}  // namespace
}  // namespace plekton::apps::packed_run_test
