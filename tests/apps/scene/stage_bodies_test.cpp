// SPDX-License-Identifier: GPL-3.0-or-later
// Rigid bodies and membranes in stages: they go on to the last bit, come, go, are held and freed.
#include "apps/scene/stage_bodies.hpp"

#include "apps/run/checkpoints.hpp"
#include "tests/apps/command_line/program_fixture.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace plekton::apps::stage_bodies_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

/// Grains and a stone of three spheres that fall into a tray.
constexpr const char* kTray = R"([simulation]
damping = 0.2
time_step = "5 us"
[materials.sand]
density = "2650 kg/m3"
young_modulus = "10 MPa"
friction_angle = "30 deg"
[[rigid_bodies]]
name = "tray"
shape = { kind = "box", size = ["60 mm", "60 mm", "30 mm"], open = ["z_max"] }
translate = ["-30 mm", "-30 mm", 0]
thickness = "2 mm"
material = "sand"
density = "2000 kg/m3"
hold = "xyz"
hold_rotation = "xyz"
[[rigid_bodies]]
name = "stone"
material = "sand"
density = "2650 kg/m3"
spheres = [
  { centre = [0, 0, "45 mm"], radius = "5 mm" },
  { centre = ["6 mm", 0, "45 mm"], radius = "4 mm" },
  { centre = ["2 mm", "5 mm", "45 mm"], radius = "3 mm" },
]
velocity = [0, 0, "-0.5 m/s"]
angular_velocity = ["20 rad/s", "30 rad/s", "-10 rad/s"]
[[grains]]
name = "grit"
material = "sand"
count = 40
radius = "4 mm"
velocity = [0, 0, "-0.5 m/s"]
box = { min = ["-27 mm", "-27 mm", "2 mm"], max = ["27 mm", "27 mm", "36 mm"] }
[output]
interval = "5 ms"
history_interval = "1 ms"
hash_interval = 50
)";

/// All that may change.
constexpr const char* kStages = R"([[stages]]
name = "pour"
end = { duration = "10 ms" }
[[stages]]
name = "press"
end = { duration = "8 ms" }
fix = [{ rigid_body = "stone" }]
[[stages.rigid_bodies]]
name = "lid"
shape = { kind = "box", size = ["50 mm", "50 mm", "4 mm"] }
translate = ["-25 mm", "-25 mm", "60 mm"]
thickness = "2 mm"
material = "sand"
mass = "50 g"
hold_rotation = "xyz"
velocity = [0, 0, "-2 m/s"]
[[stages.membranes]]
name = "cloth"
shape = { kind = "sheet", width = "60 mm", length = "60 mm", cells = [4, 4] }
translate = [0, 0, "70 mm"]
thickness = "2 mm"
material = "sand"
young_modulus = "50 MPa"
areal_mass = "300 g/m2"
hold = "rim"
[[stages]]
name = "lift"
end = { duration = "6 ms" }
free = [{ rigid_body = "stone" }]
remove = [{ rigid_body = "lid" }]
[[stages.rigid_bodies]]
name = "tray"
hold = "xy"
[[stages.loads]]
name = "lift"
kind = "motion"
rigid_body = "tray"
components = "z"
velocity = [0, 0, "0.2 m/s"]
[[stages]]
name = "rest"
end = { duration = "3 ms" }
remove = [{ membrane = "cloth" }, { load = "lift" }]
fix = [{ rigid_body = "tray" }]
)";

/// Columns of a CSV file by their names.
class Columns {
 public:
  explicit Columns(const fs::path& file) {
    std::istringstream text(test::bytes_of(file));
    std::string line, cell;
    std::getline(text, line);
    std::istringstream head(line);
    while (std::getline(head, cell, ',')) names_.push_back(cell);
    while (std::getline(text, line)) {
      std::istringstream row(line);
      rows_.emplace_back();
      while (std::getline(row, cell, ',')) rows_.back().push_back(std::stod(cell));
    }
  }
  std::vector<double> of(const std::string& name) const {
    const auto place = std::find(names_.begin(), names_.end(), name) - names_.begin();
    std::vector<double> values;
    for (const auto& row : rows_) values.push_back(row.at(static_cast<std::size_t>(place)));
    return values;
  }
  /// The value in the last row that is not after a time.
  double at(const std::string& name, double time) const {
    const std::vector<double> times = of("time (s)"), values = of(name);
    double value = NAN;
    for (std::size_t i = 0; i < times.size() && times[i] <= time; ++i) value = values[i];
    return value;
  }

 private:
  std::vector<std::string> names_;
  std::vector<std::vector<double>> rows_;
};

class StageBodies : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    test::write_bytes(folder_ / name, text);
    return (folder_ / name).string();
  }
  std::string in(const std::string& name) const { return (folder_ / name).string(); }
  std::string bytes(const std::string& name) const { return test::bytes_of(folder_ / name); }

  Outcome run(const std::string& scenario, const std::string& out,
              const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"run", scenario, "--quiet", "--out", in(out)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = Program(arguments).wait();
    return outcome;
  }
  void run_well(const std::string& scenario, const std::string& out,
                const std::vector<std::string>& more = {}) const {
    const Outcome outcome = run(scenario, out, more);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  std::string all_stages() const { return write("all.toml", std::string(kTray) + kStages); }
  json report(const std::string& out) const { return json::parse(bytes(out + "/run.json")); }
  Columns motions(const std::string& out) const {
    return Columns(folder_ / (out + "/rigid_bodies.csv"));
  }
  std::string refusal_of(const std::string& stages) const {
    const Outcome outcome =
        Program({"check", write("wrong.toml", std::string(kTray) + stages)}).wait();
    EXPECT_EQ(outcome.exit_code, 1);
    return outcome.err;
  }

  test::TemporaryFolder folder_;
};

/// The second run goes through Simulation::go_on_from: the plane is far away, the load pulls with
/// nothing.
TEST_F(StageBodies, GoOnToTheLastBitWhereAStageChangesNothingOfThem) {
  const std::string stages = R"([[stages]]
name = "a"
end = { duration = "7 ms" }
[[stages]]
name = "b"
end = { duration = "9 ms" }
)";
  const std::string changes = R"([[stages.loads]]
kind = "force"
rigid_body = "stone"
force = [0, 0, 0]
[[stages.planes]]
name = "far"
point = [0, 0, "-1 m"]
material = "sand"
)";
  run_well(write("same.toml", kTray + stages), "same");
  run_well(write("other.toml", kTray + stages + changes), "other");

  EXPECT_GT(bytes("same/rigid_bodies.csv").size(), 1000U);
  EXPECT_EQ(bytes("other/rigid_bodies.csv"), bytes("same/rigid_bodies.csv"));
  EXPECT_EQ(bytes("other/energy.csv"), bytes("same/energy.csv"));
}

/// A flag above the stone, which tumbles with it. What is far away does nothing to it: the places on
/// the stone go on as they were at the first start, also before grains that come.
TEST_F(StageBodies, HoldWhatIsTiedToThemWhereItWasAtTheStartOfTheRun) {
  const std::string flag = R"([[membranes]]
name = "flag"
shape = { kind = "sheet", width = "12 mm", length = "12 mm", cells = [2, 2] }
translate = [0, 0, "55 mm"]
mode = "truss"
thickness = "1 mm"
material = "sand"
young_modulus = "1 MPa"
density = "1000 kg/m3"
[[ties]]
name = "pole"
from = { membrane = "flag", nodes = "x_min" }
to = { kind = "body", rigid_body = "stone" }
stiffness = "100 N/m"
)";
  const std::string stages = R"([[stages]]
name = "a"
end = { duration = "7 ms" }
[[stages]]
name = "b"
end = { duration = "9 ms" }
)";
  const std::string far = R"([[stages.grains]]
name = "far"
material = "sand"
radius = "1 mm"
centres = [[0, 0, 5]]
)";
  const std::string changed = write("other.toml", kTray + flag + stages + far);
  run_well(write("same.toml", kTray + flag + stages), "same");
  run_well(changed, "other");
  run_well(changed, "first", {"--until", "a"});
  run_well(changed, "later", {"--from", "a", in("first")});

  const Columns ties(folder_ / "same/ties.csv");
  EXPECT_GT(ties.at("pole.mean_tension (N)", 0.0065), 1e-4);
  EXPECT_GT(ties.at("pole.mean_tension (N)", 0.0155), 1e-4);
  EXPECT_EQ(bytes("other/ties.csv"), bytes("same/ties.csv"));
  EXPECT_EQ(bytes("other/rigid_bodies.csv"), bytes("same/rigid_bodies.csv"));
  const auto last_row = [&](const std::string& file) {
    const std::string csv = bytes(file);
    return csv.substr(csv.rfind('\n', csv.size() - 2) + 1);
  };
  EXPECT_EQ(last_row("later/ties.csv"), last_row("same/ties.csv"));
  EXPECT_LT(std::abs(report("same")["energy_closure"].get<double>()), 1e-2);
}

TEST_F(StageBodies, SpinOnFreelyWithTheirMomentumAndEnergy) {
  const std::string scene = R"([simulation]
gravity = [0, 0, 0]
time_step = "20 us"
[materials.steel]
young_modulus = "10 MPa"
friction_angle = "30 deg"
[[rigid_bodies]]
name = "top"
shape = { kind = "box", size = ["10 mm", "20 mm", "30 mm"] }
thickness = "1 mm"
material = "steel"
density = "7850 kg/m3"
velocity = ["0.1 m/s", 0, 0]
angular_velocity = ["0.1 rad/s", "50 rad/s", "0.1 rad/s"]
[output]
history_interval = "1 ms"
[[stages]]
name = "a"
end = { duration = "100 ms" }
[[stages]]
name = "b"
end = { duration = "100 ms" }
)";
  const std::string far = R"([[stages.planes]]
name = "far"
point = [0, 0, "-1 m"]
material = "steel"
)";
  run_well(write("same.toml", scene), "same");
  run_well(write("other.toml", scene + far), "other");

  EXPECT_EQ(bytes("other/rigid_bodies.csv"), bytes("same/rigid_bodies.csv"));
  const std::vector<double> energy = Columns(folder_ / "other/energy.csv").of("kinetic (J)");
  for (const double of_row : energy) EXPECT_NEAR(of_row, energy.front(), 1e-9 * energy.front());
}

TEST_F(StageBodies, HaveTheSameBitsAtOnceOneByOneAndWithAnyThreads) {
  const std::string file = all_stages();
  run_well(file, "once");
  run_well(file, "pour", {"--until", "pour", "--threads", "2"});
  run_well(file, "press", {"--from", "pour", in("pour"), "--until", "press"});
  run_well(file, "lift", {"--from", "press", in("press"), "--until", "lift", "--threads", "2"});
  run_well(file, "rest", {"--from", "lift", in("lift"), "--threads", "4"});
  run_well(file, "two", {"--threads", "2"});
  run_well(file, "four", {"--threads", "4"});

  const json once = report("once");
  EXPECT_EQ(once["stages"].size(), 4U);
  EXPECT_EQ(report("rest")["states"]["chain"], once["states"]["chain"]);
  for (const char* const out : {"two", "four"}) {
    EXPECT_EQ(report(out)["states"]["chain"], once["states"]["chain"]);
    for (const char* const name : {"/energy.csv", "/rigid_bodies.csv"})
      EXPECT_EQ(bytes(out + std::string(name)), bytes("once" + std::string(name))) << name;
  }
}

TEST_F(StageBodies, GoOnFromAnyCheckpointToTheLastByteAndAreComputedAgain) {
  run_well(all_stages(), "whole", {"--set", "output.checkpoint_interval=\"3.1 ms\""});
  const auto files = checkpoints_of(folder_ / "whole");
  ASSERT_GE(files.size(), 8U);
  for (std::size_t left = 1; left < files.size(); ++left) {
    const fs::path stopped = folder_ / "stopped";
    fs::remove_all(stopped);
    fs::copy(folder_ / "whole", stopped, fs::copy_options::recursive);
    fs::remove(stopped / "run.json");
    for (std::size_t i = left; i < files.size(); ++i)
      fs::remove(stopped / kCheckpointFolder / files[i].filename());

    if (left > 1) {
      const Outcome again = Program({"verify", stopped.string()}).wait();
      EXPECT_EQ(again.exit_code, 0) << again.out << again.err << files[left - 1];
      EXPECT_THAT(again.out, HasSubstr("the same to the last bit"));
    }
    const Outcome outcome =
        Program({"run", "--resume", stopped.string(), "--quiet", "--threads", "2"}).wait();

    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(report("stopped")["states"], report("whole")["states"]) << files[left - 1];
    for (const char* const name : {"energy.csv", "rigid_bodies.csv", "membranes.pvd"})
      EXPECT_EQ(test::bytes_of(stopped / name), test::bytes_of(folder_ / "whole" / name))
          << name << " from " << files[left - 1];
  }
}

TEST_F(StageBodies, ComeStopMoveAndGo) {
  run_well(all_stages(), "once");

  const Columns columns = motions("once");
  const auto lid = [&](double time) { return columns.at("lid.position_z (m)", time); };
  EXPECT_TRUE(std::isnan(lid(0.0095)));
  EXPECT_LT(lid(0.012), 0.062);
  EXPECT_GT(lid(0.012), 0.050);
  EXPECT_TRUE(std::isnan(lid(0.0225)));
  const auto stone = [&](double time) { return columns.at("stone.position_z (m)", time); };
  EXPECT_EQ(stone(0.0125), stone(0.0175));
  EXPECT_NE(stone(0.0195), stone(0.0235));
  const auto tray = [&](double time) { return columns.at("tray.position_z (m)", time); };
  EXPECT_EQ(tray(0.005), tray(0.0175));
  // 0.2 m/s over 4 ms; it is still from the next stage on.
  EXPECT_NEAR(tray(0.023) - tray(0.019), 0.0008, 1e-12);
  EXPECT_EQ(tray(0.0252), tray(0.0267));
  EXPECT_LT(std::abs(report("once")["energy_closure"].get<double>()), 1e-3);
}

TEST_F(StageBodies, EndStagesByTheirForcesAndWays) {
  const std::string stages = R"([[stages]]
name = "lower"
end = { displacement = { rigid_body = "plate", distance = "3 mm" } }
max_duration = "1 s"
[[stages.rigid_bodies]]
name = "plate"
shape = { kind = "box", size = ["50 mm", "50 mm", "4 mm"] }
translate = ["-25 mm", "-25 mm", "60 mm"]
thickness = "2 mm"
material = "sand"
mass = "50 g"
hold_rotation = "xyz"
[[stages.loads]]
name = "down"
kind = "motion"
rigid_body = "plate"
velocity = [0, 0, "-1 m/s"]
[[stages]]
name = "near"
end = { strain = { between = ["tray", "plate"], strain = "20 %" } }
max_duration = "1 s"
[[stages]]
name = "touch"
end = { force = { reaction = "plate", component = "z", above = "2 N" } }
max_duration = "1 s"
[[stages.output.reactions]]
name = "plate"
kind = "contacts"
rigid_body = "plate"
[[stages]]
name = "hold"
end = { servo = { load = "press", tolerance = "5 %" }, after = "1 ms" }
max_duration = "1 s"
remove = [{ load = "down" }]
[[stages.loads]]
name = "press"
kind = "servo"
rigid_body = "plate"
direction = "-z"
force = "5 N"
speed = "0.1 m/s"
)";
  run_well(write("ends.toml", kTray + stages), "ends");

  const json all = report("ends")["stages"];
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[0]["ended_by"], "displacement");
  // 3 mm at 1 m/s, looked at every 16 steps of 5 us.
  EXPECT_NEAR(all[0]["end_s"].get<double>(), 0.003, 17 * 5e-6);
  EXPECT_EQ(all[1]["ended_by"], "strain");
  EXPECT_EQ(all[2]["ended_by"], "force");
  EXPECT_EQ(all[3]["ended_by"], "servo");
}

TEST_F(StageBodies, KeepFinishedStagesWhereAServoCannotReachItsForce) {
  const std::string stages = R"([[stages]]
name = "pour"
end = { duration = "2 ms" }
[[stages]]
name = "press"
end = { servo = { load = "press" } }
max_duration = "2 ms"
[[stages.rigid_bodies]]
name = "lid"
shape = { kind = "box", size = ["50 mm", "50 mm", "4 mm"] }
translate = ["-25 mm", "-25 mm", "90 mm"]
thickness = "2 mm"
material = "sand"
mass = "50 g"
hold_rotation = "xyz"
[[stages.loads]]
name = "press"
kind = "servo"
rigid_body = "lid"
direction = "-z"
force = "1 MN"
speed = "0.1 m/s"
)";
  const Outcome outcome = run(write("wrong.toml", kTray + stages), "wrong");

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("stages.press: has not ended within its max_duration of 0.002 "
                                     "s: servo \"press\" feels 0 N and wants 1e+06 N within 2 %"));
  EXPECT_EQ(report("wrong")["stages"].size(), 1U);
  EXPECT_EQ(checkpoints_of(folder_ / "wrong").size(), 1U);
}

TEST_F(StageBodies, AreRefusedByTheirNamesWhereTheyAreWrong) {
  const std::string pour = "[[stages]]\nname = \"pour\"\nend = { duration = \"2 ms\" }\n";
  const std::string next = "[[stages]]\nname = \"next\"\nend = { duration = \"2 ms\" }\n";
  EXPECT_THAT(refusal_of(pour + next + "remove = [{ rigid_body = \"ston\" }]\n"),
              HasSubstr("stages.next.remove.rigid_body: there is none called \"ston\" in the stage "
                        "before"));
  EXPECT_THAT(refusal_of(pour + next + "[[stages.rigid_bodies]]\nname = \"stone\"\n" +
                         "density = \"1 kg/m3\"\n"),
              HasSubstr("stages.next.rigid_bodies.stone.density: is the same in all stages; a "
                        "stage may change hold, hold_rotation"));
  EXPECT_THAT(refusal_of(pour + "[[stages.loads]]\nname = \"pull\"\nkind = \"force\"\n" +
                         "rigid_body = \"stone\"\nforce = [0, 0, 1]\n" + next +
                         "remove = [{ rigid_body = \"stone\" }]\n"),
              HasSubstr("rigid_body: \"stone\" is not there in this stage"));
  EXPECT_THAT(refusal_of(pour + next + "[[stages.loads]]\nkind = \"force\"\ngrains = \"stone\"\n" +
                         "nodes = \"all\"\nforce = [0, 0, 1]\n"),
              HasSubstr("\"stone\" is a rigid body, whose inner nodes bear no loads of their own; "
                        "expected rigid_body = \"stone\""));
  EXPECT_THAT(refusal_of(pour + next + "[[stages.rigid_bodies]]\nname = \"flat\"\n" + "mesh = \"" +
                         write("flat.off",
                               "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n"
                               "3 0 1 2\n3 0 2 1\n3 1 3 2\n3 1 2 3\n") +
                         "\"\nthickness = \"1 mm\"\nmaterial = \"sand\"\ndensity = \"1 "
                         "kg/m3\"\nfilling = \"solid\"\n"),
              HasSubstr("rigid_bodies.flat"));
  EXPECT_THAT(refusal_of(pour + next + "free = [{ rigid_body = \"tray\" }]\n" +
                         "[[stages.rigid_bodies]]\nname = \"sill\"\nshape = { kind = \"box\", "
                         "size = [1, 1, 1] }\nthickness = 0.1\nmaterial = \"sand\"\n"),
              HasSubstr("rigid_bodies.sill.density: got none of density and mass"));
}

}  // namespace
}  // namespace plekton::apps::stage_bodies_test
