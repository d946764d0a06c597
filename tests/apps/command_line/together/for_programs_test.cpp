// SPDX-License-Identifier: GPL-3.0-or-later
// What other programs need of this one: silence, JSON and standard input.
#include "tests/apps/command_line/command_fixture.hpp"

namespace plekton::apps::for_programs_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class ForPrograms : public Command {
 protected:
  /// The program in the folder of the scenario, with that as its standard input.
  Outcome outcome_with_input(const std::vector<std::string>& arguments) const {
    return outcome_of(arguments, [this] {
      ::dup2(::open(scenario().c_str(), O_RDONLY), STDIN_FILENO);
      std::filesystem::current_path(folder_.path());
    });
  }
  nlohmann::json checked(const std::vector<std::string>& settings) const {
    std::vector<std::string> arguments = {"check", scenario(), "--json"};
    for (const std::string& setting : settings)
      arguments.insert(arguments.end(), {"--set", setting});
    return nlohmann::json::parse(outcome_of(arguments).out);
  }
};

TEST_F(ForPrograms, ARunThatIsQuietPrintsNothing) {
  const Outcome outcome = outcome_of({"run", scenario(), "--out", out(), "--quiet"});

  EXPECT_EQ(outcome.exit_code, kDone);
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_THAT(outcome.err, IsEmpty());
  expect_complete_files();
}

TEST_F(ForPrograms, ARunThatIsQuietStillWarnsAndComplains) {
  const Outcome doubtful = outcome_of({"run", scenario(), "--out", out(), "--quiet", "--set",
                                       "grains.gravel.velocity=[0, 0, \"-300 m/s\"]"});
  const Outcome refused = outcome_of({"run", scenario(), "--out", out(), "--quiet"});

  EXPECT_EQ(doubtful.exit_code, kDone);
  EXPECT_THAT(doubtful.out, IsEmpty());
  EXPECT_THAT(doubtful.err, HasSubstr("plekton: warning: the largest overlap is"));
  EXPECT_EQ(refused.exit_code, kFailed);
  EXPECT_THAT(refused.err, HasSubstr("holds results of an earlier run"));
}

TEST_F(ForPrograms, CheckSaysInJsonWhatTheSceneIs) {
  const auto before = folder_.names();

  const auto json = checked({"grains.gravel.count=10"});

  EXPECT_THAT(json["problems"], IsEmpty());
  EXPECT_THAT(json["warnings"], IsEmpty());
  EXPECT_EQ(json["scenario"], scenario());
  EXPECT_EQ(json["membranes"][0]["name"], "sheet");
  EXPECT_EQ(json["membranes"][0]["held_nodes"], 40);
  EXPECT_NEAR(json["membranes"][0]["area_m2"], 0.04, 1e-12);
  EXPECT_EQ(json["grains"][0]["count"], 10);
  EXPECT_EQ(json["planes"], 1);
  EXPECT_EQ(json["boxes"][0]["of"], "membranes.sheet");
  EXPECT_NEAR(json["boxes"][0]["lower_m"][2], -0.001, 1e-12);
  EXPECT_GT(json["time_step"]["time_step_s"], 0.0);
  EXPECT_GT(json["time_step"]["critical_s"], 0.0);
  EXPECT_THAT(json["overlaps"], IsEmpty());
  EXPECT_EQ(json["estimate"]["frames"], 5);  // at 0, 5, 10, 15 and 20 ms
  EXPECT_EQ(folder_.names(), before);
}

TEST_F(ForPrograms, CheckSaysInJsonWhatIsWrong) {
  const Outcome outcome =
      outcome_of({"check", scenario(), "--json", "--set", "simulation.duration=-1 s", "--set",
                  "planes.floor.material=x"});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("plekton: 2 problems\n"));
  const auto json = nlohmann::json::parse(outcome.out);
  ASSERT_EQ(json["problems"].size(), 2U);
  EXPECT_THAT(std::string(json["problems"][0]), HasSubstr("planes.floor.material"));
}

TEST_F(ForPrograms, StandardInputIsAScenarioWithMeshesFromTheCurrentFolder) {
  const Outcome checked = outcome_with_input({"check", "-"});
  const Outcome ran = outcome_with_input({"run", "-"});

  EXPECT_EQ(checked.exit_code, kDone) << checked.err;
  EXPECT_THAT(checked.out, HasSubstr("standard input: no problems\n"));
  EXPECT_EQ(ran.exit_code, kDone) << ran.err;
  const auto json = nlohmann::json::parse(test::bytes_of(folder_ / "out/stdin/run.json"));
  EXPECT_EQ(json["options"]["scenario"], "standard input");
  EXPECT_THAT(test::bytes_of(folder_ / "out/stdin/scenario-as-run.toml"),
              AllOf(StartsWith(std::string(kScenario)), HasSubstr("a copy of standard input")));
}

TEST_F(ForPrograms, StandardInputThatIsWrongIsNamedWithItsLine) {
  test::write_bytes(folder_ / "case.toml", "[simulation]\nduration = 3 s\n");
  EXPECT_THAT(outcome_with_input({"check", "-"}).err, HasSubstr("standard input:2:1"));

  test::write_bytes(folder_ / "case.toml", "");
  EXPECT_THAT(outcome_with_input({"run", "-"}).err, HasSubstr("standard input:1:1: "));

  const auto folder_as_input = [] { ::dup2(::open("/", O_RDONLY), STDIN_FILENO); };
  EXPECT_THAT(outcome_of({"check", "-"}, folder_as_input).err,
              HasSubstr("standard input: cannot be read: Is a directory; expected a scenario"));
}

}  // namespace
}  // namespace plekton::apps::for_programs_test
