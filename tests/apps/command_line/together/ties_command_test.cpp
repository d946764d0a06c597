// SPDX-License-Identifier: GPL-3.0-or-later
// Ties of a scenario, as the user of the program meets them.
#include "tests/apps/command_line/command_fixture.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <string>

namespace plekton::apps::ties_command_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

/// A sheet 30 mm below a cable along x, which moves down and along the cable.
constexpr std::string_view kBodies = R"([simulation]
gravity = [0, "-9.81 m/s2", 0]
time_step = "10 us"
[materials.stuff]
density = "1000 kg/m3"
young_modulus = "10 MPa"
friction_angle = "20 deg"
[[membranes]]
name = "cable"
shape = { kind = "chain", points = [["-0.5 m", 0, 0], ["0.5 m", 0, 0]], divisions = 10 }
mode = "truss"
thickness = "10 mm"
material = "stuff"
young_modulus = "100 MPa"
density = "1000 kg/m3"
hold = "rim"
[[membranes]]
name = "sheet"
shape = { kind = "sheet", width = "0.4 m", length = "0.4 m", cells = [4, 4] }
translate = [0, "-0.23 m", 0]
thickness = "2 mm"
material = "stuff"
young_modulus = "10 MPa"
density = "1000 kg/m3"
initial_velocity = ["0.5 m/s", "-1 m/s", 0]
[output]
interval = "50 ms"
history_interval = "1 ms"
hash_interval = 50
)";

constexpr std::string_view kTies = R"([[ties]]
name = "hang"
from = { membrane = "sheet", nodes = "y_max" }
to = { kind = "cable", membrane = "cable", friction = 0.2 }
[[ties]]
name = "foot"
from = { membrane = "sheet", nodes = "y_min" }
to = { kind = "ground" }
brake = { force = "0.2 N", stroke = "5 mm" }
each = true
)";

/// A sphere beside the sheet, tied to it.
constexpr std::string_view kWeight = R"([[rigid_bodies]]
name = "weight"
material = "stuff"
density = "1000 kg/m3"
spheres = [{ centre = ["1 m", 0, 0], radius = "20 mm" }]
[[ties]]
name = "load"
from = { rigid_body = "weight" }
to = { kind = "surface", membrane = "sheet" }
within = "2 m"
only_pulls = true
)";

class TiesCommand : public Command {
 protected:
  std::string write(const std::string& name, const std::string& more) const {
    test::write_bytes(folder_ / name, std::string(kBodies) + more);
    return (folder_ / name).string();
  }
  /// With the ties and a duration.
  std::string with_ties(const std::string& more = "") const {
    std::string text = std::string(kBodies) + std::string(kTies) + more;
    text.replace(text.find("gravity"), 0, "duration = \"60 ms\"\n");
    test::write_bytes(folder_ / "ties.toml", text);
    return (folder_ / "ties.toml").string();
  }
  Outcome run(const std::string& file, const std::string& out,
              const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"run", file, "--quiet", "--out",
                                          (folder_ / out).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return outcome_of(arguments);
  }
  json report_of(const std::string& out) const {
    return json::parse(test::bytes_of(folder_ / (out + "/run.json")));
  }
  std::string ties_of(const std::string& out) const {
    return test::bytes_of(folder_ / (out + "/ties.csv"));
  }

  static std::string last_row(const std::string& csv) {
    return csv.substr(csv.rfind('\n', csv.size() - 2) + 1);
  }

  void expect_problem(const std::string& tie, const std::string& problem) const {
    std::string text =
        std::string(kBodies) + std::string(kWeight) + "[[ties]]\nname = \"a\"\n" + tie;
    text.replace(text.find("gravity"), 0, "duration = \"60 ms\"\n");
    test::write_bytes(folder_ / "wrong.toml", text);
    const Outcome outcome = outcome_of({"check", (folder_ / "wrong.toml").string()});
    EXPECT_EQ(outcome.exit_code, kFailed) << tie;
    EXPECT_THAT(outcome.err, HasSubstr(problem)) << tie;
    EXPECT_THAT(outcome.err, HasSubstr("wrong.toml:")) << tie;
  }
};

TEST_F(TiesCommand, AreListedByCheck) {
  const Outcome outcome = outcome_of({"check", with_ties(std::string(kWeight))});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("ties hang: 5, longest gap at the start 0.03 m, "));
  EXPECT_THAT(outcome.out, HasSubstr("ties foot: 5, longest gap at the start 0 m, "));
  EXPECT_THAT(outcome.out, HasSubstr("ties load: 1, longest gap at the start 0.8"));
  const json ties =
      json::parse(outcome_of({"check", with_ties(std::string(kWeight)), "--json"}).out)["ties"];
  ASSERT_EQ(ties.size(), 3U);
  EXPECT_EQ(ties[0]["count"], 5);
  EXPECT_NEAR(ties[0]["longest_gap_m"].get<double>(), 0.03, 1e-15);
}

/// Around a node of the sheet's side there are beams of 0.1 m and of 0.1 sqrt(2) m, of 10 MPa and
/// 1 mm radius; the cable has bars of 0.1 m of 100 MPa and 5 mm radius.
TEST_F(TiesCommand, AreAsStiffAsTheSofterOfWhatTheyTie) {
  const json ties =
      json::parse(outcome_of({"check", with_ties(std::string(kWeight)), "--json"}).out)["ties"];

  const double beam = 10e6 * 3.14159265358979 * 1e-6 / 0.1;  // N/m
  const json range = ties[0]["stiffness_N_per_m"];
  EXPECT_GT(range[0].get<double>(), 1.99 * beam);
  EXPECT_LT(range[1].get<double>(), 6.0 * beam);
}

TEST_F(TiesCommand, WarnWhereARuleTiesNothing) {
  std::string text = with_ties(
      "[[ties]]\nname = \"none\"\n"
      "from = { membrane = \"sheet\", nodes = \"y_max\" }\n"
      "to = { kind = \"cable\", membrane = \"cable\" }\n"
      "within = \"10 mm\"\n");

  const Outcome outcome = outcome_of({"check", text});

  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out + outcome.err,
              HasSubstr("ties.none: ties nothing; the nearest place to tie to is 0.03 m away, and "
                        "within is 0.01 m"));
  EXPECT_THAT(outcome.out, HasSubstr("ties none: none"));
}

TEST_F(TiesCommand, HaveAHistoryAndAreCounted) {
  ASSERT_EQ(run(with_ties(), "out").exit_code, 0);

  const std::string csv = ties_of("out");
  EXPECT_THAT(csv.substr(0, csv.find('\n')),
              HasSubstr("hang.largest_tension (N),hang.mean_tension (N),hang.largest_slip (m),"
                        "hang.elastic (J),hang.dissipated (J),hang.broken,foot.largest_tension"));
  EXPECT_THAT(csv, HasSubstr("foot[4].tension (N),foot[4].slip (m),foot[4].broken"));
  EXPECT_THAT(csv, Not(HasSubstr("hang[0]")));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 62);
  EXPECT_EQ(report_of("out")["counts"]["ties"], 10);
  EXPECT_EQ(report_of("out")["counts"]["broken_ties"], 0);
  EXPECT_LT(report_of("out")["energy_closure"].get<double>(), 0.01);

  const Outcome broken = run(with_ties(), "broken", {"--set", "ties.hang.strength=\"50 mN\""});
  ASSERT_EQ(broken.exit_code, 0) << broken.err;
  EXPECT_GE(report_of("broken")["counts"]["broken_ties"].get<int>(), 1);
}

/// The second stage changes something that nothing depends on, so that its scene is built anew; a
/// step that is chosen would be chosen anew too.
TEST_F(TiesCommand, GoOnOverStagesAndResumptionWithTheSameBits) {
  const std::string end = "end = { duration = \"30 ms\" }\n";
  const std::string second =
      "[[stages]]\nname = \"b\"\n" + end + "materials.stuff.poisson_ratio = 0.25\n";
  const std::string staged =
      write("staged.toml", std::string(kTies) + "[[stages]]\nname = \"a\"\n" + end + second);
  ASSERT_EQ(run(staged, "staged").exit_code, 0);
  ASSERT_EQ(run(with_ties(), "whole").exit_code, 0);
  ASSERT_EQ(run(with_ties(), "threads", {"--set", "simulation.threads=3"}).exit_code, 0);
  ASSERT_EQ(run(staged, "first", {"--until", "a"}).exit_code, 0);
  ASSERT_EQ(run(staged, "later", {"--from", "a", (folder_ / "first").string()}).exit_code, 0);

  const auto hashes = [&](const std::string& out) {
    return report_of(out)["states"]["step_time_hash"];
  };
  EXPECT_EQ(hashes("threads"), hashes("whole"));
  EXPECT_TRUE(ties_of("threads") == ties_of("whole"));
  // Rows of a run that begins with a stage are at other times, but for the last one.
  EXPECT_EQ(last_row(ties_of("later")), last_row(ties_of("staged")));
  std::size_t common = 0;
  for (const json& state : hashes("whole")) {
    for (const json& other : hashes("staged")) {
      if (other[0] != state[0] || state[0].get<int>() % 50 != 0) continue;
      ++common;
      EXPECT_EQ(other[2], state[2]) << "step " << state[0];
    }
  }
  EXPECT_GE(common, 50U);
}

TEST_F(TiesCommand, AreRefusedInAStage) {
  const Outcome outcome =
      outcome_of({"check", write("stage.toml",
                                 "[[stages]]\nname = \"a\"\nend = { duration = 1 }\n"
                                 "[[stages.ties]]\nname = \"b\"\n")});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("stages.a.ties: ties are there from the first stage on; write "
                                     "them outside of the stages"));
}

TEST_F(TiesCommand, OfWhatComesLaterAreRefused) {
  const std::string end = "end = { duration = \"5 ms\" }\n";
  const std::string late =
      "[[ties]]\nname = \"t\"\nfrom = { membrane = \"sheet\", nodes = \"y_max\" }\n"
      "to = { kind = \"surface\", membrane = \"late\" }\n[[stages]]\nname = \"a\"\n" +
      end + "[[stages]]\nname = \"b\"\n" + end +
      "[[stages.membranes]]\nname = \"late\"\nshape = { kind = \"sheet\", width = \"0.1 m\", "
      "length = \"0.1 m\", cells = [1, 1] }\nthickness = \"2 mm\"\nmaterial = \"stuff\"\n"
      "young_modulus = \"10 MPa\"\ndensity = \"1000 kg/m3\"\n";

  const Outcome outcome = outcome_of({"check", write("late.toml", late)});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("\"late\" is not there in this stage"));
}

TEST_F(TiesCommand, BetweenWhatIsNotThereAreErrorsThatNameTheKey) {
  const std::string from = "from = { membrane = \"sheet\", nodes = \"y_max\" }\n";
  const std::string ground = "to = { kind = \"ground\" }\n";
  expect_problem(ground, "ties.a.from: missing; expected whose nodes are tied");
  expect_problem(from, "ties.a.to: missing; expected to what they are tied");
  expect_problem("from = { membrane = \"shet\", nodes = \"all\" }\n" + ground,
                 "ties.a.from.membrane: there is none called \"shet\"; did you mean \"sheet\"?");
  expect_problem(from + "to = { kind = \"cabel\", membrane = \"cable\" }\n",
                 "ties.a.to.kind: got \"cabel\"; expected one of");
  expect_problem(from + "to = { kind = \"cable\", membrane = \"rope\" }\n",
                 "ties.a.to.membrane: there is none called \"rope\"");
  expect_problem(from + "to = { kind = \"cable\", membrane = \"sheet\" }\n",
                 "ties.a.to.membrane: \"sheet\" is no cable; expected a membrane of bars");
  expect_problem(
      "from = { membrane = \"sheet\", nodes = { min = [5, 5, 5], max = [6, 6, 6] } }\n" + ground,
      "ties.a.from.nodes: \"sheet\" has no node there");
  expect_problem(from + "to = { kind = \"surface\", rigid_body = \"weight\" }\n",
                 "ties.a.to: \"weight\" is of spheres and has no surface of facets");
  expect_problem("from = { rigid_body = \"weight\", nodes = \"all\" }\n" + ground,
                 "ties.a.from.nodes: of a rigid body its centre is tied; leave nodes out");
}

TEST_F(TiesCommand, WithNumbersThatCannotBeAreErrors) {
  const std::string from = "from = { membrane = \"sheet\", nodes = \"y_max\" }\n";
  const std::string ground = from + "to = { kind = \"ground\" }\n";
  expect_problem(ground + "stiffness = \"-1 N/m\"\n", "ties.a.stiffness: ");
  expect_problem(ground + "strength = \"0 N\"\n", "ties.a.strength: ");
  expect_problem(ground + "within = \"5 s\"\n", "ties.a.within: ");
  expect_problem(ground + "friction = 0.1\n", "ties.a.friction: unknown key");
  expect_problem(ground + "brake = { force = \"1 N\" }\n", "ties.a.brake.stroke: missing");
  expect_problem(ground + "brake = { force = \"1 N\", stroke = \"1 m\" }\nonly_pulls = false\n",
                 "ties.a.only_pulls: got false, but on a cable and with a brake a tie only pulls");
  expect_problem(from + "to = { kind = \"cable\", membrane = \"cable\", friction = -1 }\n",
                 "ties.a.to.friction: ");
  expect_problem(from +
                     "to = { kind = \"cable\", membrane = \"cable\" }\n"
                     "brake = { force = \"1 N\", stroke = \"1 m\" }\n",
                 "a tie that slides on a cable has no brake of its own; expected slip_force");
  expect_problem("from = { rigid_body = \"weight\" }\nto = { kind = \"ground\" }\n",
                 "ties.a.stiffness: missing; what it ties is rigid or has no bars");
}

}  // namespace
}  // namespace plekton::apps::ties_command_test
