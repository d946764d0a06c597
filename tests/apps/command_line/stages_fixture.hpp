// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/apps/command_line/program_fixture.hpp"
#include "tests/support/temporary_folder.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace plekton::apps {

/// Grains that fall on a sheet in a box.
inline constexpr const char* kBodies = R"([simulation]
damping = 0.2
[materials.sand]
density = "2650 kg/m3"
young_modulus = "10 MPa"
friction_angle = "30 deg"
[[membranes]]
name = "sheet"
shape = { kind = "sheet", width = "60 mm", length = "60 mm", cells = [6, 6] }
thickness = "2 mm"
material = "sand"
young_modulus = "50 MPa"
areal_mass = "300 g/m2"
hold = "rim"
[[grains]]
name = "first"
material = "sand"
count = 60
radius = "4 mm"
velocity = [0, 0, "-0.5 m/s"]
box = { min = ["-28 mm", "-28 mm", "2 mm"], max = ["28 mm", "28 mm", "36 mm"] }
[[planes]]
name = "left"
point = ["-30 mm", 0, 0]
normal = [1, 0, 0]
material = "sand"
[[planes]]
name = "right"
point = ["30 mm", 0, 0]
normal = [-1, 0, 0]
material = "sand"
[[planes]]
name = "front"
point = [0, "-30 mm", 0]
normal = [0, 1, 0]
material = "sand"
[[planes]]
name = "back"
point = [0, "30 mm", 0]
normal = [0, -1, 0]
material = "sand"
[output]
interval = "5 ms"
history_interval = "1 ms"
hash_interval = 50
)";

/// All that may change, after kBodies.
inline constexpr const char* kStages = R"([[stages]]
name = "pour"
end = { duration = "12 ms" }
materials.sand.friction_angle = "5 deg"
[[stages]]
name = "level"
end = { duration = "6 ms" }
materials.sand.friction_angle = "30 deg"
remove = [{ grains = "first", above = "20 mm" }]
fix = [{ grains = "first", nodes = "z_min" }]
[[stages.grains]]
name = "second"
material = "sand"
count = 10
radius = "3 mm"
box = { min = ["-28 mm", "-28 mm", "30 mm"], max = ["28 mm", "28 mm", "60 mm"] }
[[stages]]
name = "press"
end = { duration = "8 ms" }
free = [{ grains = "first", nodes = "all" }]
[[stages.planes]]
name = "lid"
point = [0, 0, "62 mm"]
normal = [0, 0, -1]
material = "sand"
[[stages.loads]]
name = "push"
kind = "motion"
plane = "lid"
velocity = [0, 0, "-1 m/s"]
[[stages.output.reactions]]
name = "lid"
kind = "plane"
plane = "lid"
)";

/// The scene of kBodies with a lid that comes in the last of three stages.
inline std::string in_three(std::string_view first, std::string_view second,
                            std::string_view third) {
  std::string text = kBodies;
  for (const std::string_view name : {first, second, third})
    text += fmt::format("[[stages]]\nname = \"{}\"\nend = {{ duration = \"0.2 ms\" }}\n", name);
  return text + R"([[stages.rigid_bodies]]
name = "lid"
shape = { kind = "box", size = [0.04, 0.04, 0.005] }
translate = [-0.02, -0.02, 0.05]
thickness = "1 mm"
material = "sand"
density = "1000 kg/m3"
)";
}

/// Runs scenarios with stages, in a folder.
class Stages : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    test::write_bytes(folder_ / name, text);
    return (folder_ / name).string();
  }
  std::string all_stages() const { return write("all.toml", std::string(kBodies) + kStages); }
  std::string in(const std::string& name) const { return (folder_ / name).string(); }

  Outcome run(const std::string& scenario, const std::string& out,
              const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"run", scenario, "--quiet", "--out", in(out)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Program(arguments).wait();
  }
  nlohmann::json report(const std::string& out) const {
    return nlohmann::json::parse(test::bytes_of(folder_ / (out + "/run.json")));
  }
  nlohmann::json hashes(const std::string& out) const {
    return report(out)["states"]["step_time_hash"];
  }

  /// Those at the steps at which both have one, but for the last 64: a run without stages makes
  /// them end with its duration.
  void expect_same_states(const std::string& a, const std::string& b, std::size_t least) const {
    std::size_t common = 0;
    const nlohmann::json of_a = hashes(a);
    const nlohmann::json of_b = hashes(b);
    const int last = std::min(of_a.back()[0].get<int>(), of_b.back()[0].get<int>()) - 64;
    for (const nlohmann::json& state : of_a) {
      for (const nlohmann::json& other : of_b) {
        const int step = state[0].get<int>();
        if (other[0] != state[0] || step % 50 != 0 || step > last) continue;
        ++common;
        EXPECT_EQ(other[2], state[2]) << "step " << state[0];
      }
    }
    EXPECT_GE(common, least);
  }

  std::string failure_of(const std::string& stages) const {
    const Outcome outcome = run(write("wrong.toml", std::string(kBodies) + stages), "wrong");
    EXPECT_EQ(outcome.exit_code, 1);
    return outcome.err;
  }

  test::TemporaryFolder folder_;
};

}  // namespace plekton::apps
