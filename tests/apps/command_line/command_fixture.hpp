// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/io/mesh_file.hpp"
#include "tests/apps/command_line/program_fixture.hpp"
#include "tests/support/vtp_reader.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <string_view>

namespace plekton::apps {

/// Twenty grains that fall on a sheet above a floor.
inline constexpr std::string_view kScenario = R"([simulation]
duration = "20 ms"
damping = 0.2
[materials.gravel]
density = "2650 kg/m3"
young_modulus = "20 MPa"
friction_angle = "35 deg"
[[membranes]]
name = "sheet"
mesh = "sheet.off"
thickness = "2 mm"
material = "gravel"
young_modulus = "50 MPa"
areal_mass = "300 g/m2"
hold = "rim"
[[grains]]
name = "gravel"
material = "gravel"
count = 20
radius = "5 mm"
velocity = [0, 0, "-1 m/s"]
box = { min = ["-5 cm", "-5 cm", "1 mm"], max = ["5 cm", "5 cm", "25 mm"] }
[[planes]]
name = "floor"
point = [0, 0, "-5 cm"]
material = "gravel"
[output]
interval = "5 ms"
)";

/// The program in a folder with a scenario, case.toml, and its mesh.
class Command : public testing::Test {
 protected:
  Command() {
    geometry::write_mesh_file(folder_ / "sheet.off", geometry::plane_sheet({0.2, 0.2, 10, 10}));
    test::write_bytes(folder_ / "case.toml", std::string(kScenario));
  }
  std::string scenario() const { return (folder_ / "case.toml").string(); }
  std::string out() const { return (folder_ / "out").string(); }
  nlohmann::json report() const {
    return nlohmann::json::parse(test::bytes_of(folder_ / "out/run.json"));
  }

  /// `plekton run` with values set; every failure must leave no output folder.
  Outcome failure_of(const std::vector<std::string>& settings) const {
    std::vector<std::string> arguments = {"run", scenario(), "--out", out()};
    for (const std::string& setting : settings)
      arguments.insert(arguments.end(), {"--set", setting});
    const Outcome outcome = outcome_of(arguments);
    EXPECT_EQ(outcome.exit_code, kFailed);
    EXPECT_FALSE(std::filesystem::exists(out()));
    return outcome;
  }

  /// Every series names only files that are there, and each of them can be read.
  void expect_complete_files() const {
    for (const std::string part : {"grains", "membranes", "contacts"}) {
      const std::string series = test::bytes_of(folder_ / ("out/" + part + ".pvd"));
      EXPECT_THAT(series, testing::HasSubstr("</VTKFile>")) << part;
      std::size_t count = 0;
      for (std::size_t at = series.find("file=\""); at != std::string::npos;
           at = series.find("file=\"", at + 1), ++count) {
        const std::string name = series.substr(at + 6, series.find('"', at + 6) - at - 6);
        const test::VtpReader frame(test::bytes_of(folder_ / ("out/" + name)));
        EXPECT_NO_THROW(frame.count("NumberOfPoints")) << name;
      }
      EXPECT_GT(count, 0U) << part;
    }
    for (const auto& entry : std::filesystem::recursive_directory_iterator(out())) {
      EXPECT_NE(entry.path().extension(), ".part") << entry.path();
    }
  }

  test::TemporaryFolder folder_;
};

}  // namespace plekton::apps
