// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/run_report.hpp"

#include "geometry/version.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace plekton::apps::run_report_test {
namespace {

RunReport example() {
  RunReport report;
  report.status = RunStatus::interrupted;
  report.scenario = "catch.toml";
  report.overrides = {"simulation.duration=1 s"};
  report.names = {{"gravel", "steel"}, {"sand"}, {"net", "sheet"}, {""}};
  report.grains = 1000;
  report.steps = 200;
  report.wall_time = 0.1;
  report.start_up_time = 0.02;
  report.output_time = 0.003;
  report.largest_overlap_ratio = 0.012;
  report.dt_over_critical = 0.5;
  report.energy.kinetic = 3.0;
  report.energy.friction = 1.0;
  report.energy.gravity = -3.9;
  report.energy_closure = 0.025;
  report.lost_grains = 2;
  return report;
}

TEST(RunReport, SaysInJsonWhatTheRunWas) {
  const auto json = nlohmann::json::parse(to_json(example()));

  EXPECT_EQ(json["plekton"], kVersion);
  EXPECT_EQ(json["status"], "interrupted");
  EXPECT_TRUE(json["interrupted"]);
  EXPECT_EQ(json["options"]["set"][0], "simulation.duration=1 s");
  EXPECT_EQ(json["names"]["materials"][1], "steel");
  EXPECT_EQ(json["names"]["grains"][0], "sand");
  EXPECT_EQ(json["names"]["membranes"][1], "sheet");
  EXPECT_EQ(json["names"]["planes"][0], "");
  EXPECT_EQ(json["counts"]["grains"], 1000);
  EXPECT_DOUBLE_EQ(json["timing"]["ms_per_step"], 0.5);
  EXPECT_EQ(json["timing"]["start_up_s"], 0.02);
  EXPECT_EQ(json["timing"]["output_s"], 0.003);
  EXPECT_EQ(json["largest_overlap_ratio"], 0.012);
  EXPECT_EQ(json["dt_over_critical"], 0.5);
  EXPECT_EQ(json["energy_closure"], 0.025);
  EXPECT_EQ(json["lost_grains"], 2);
  EXPECT_FALSE(json.contains("message"));
}

TEST(RunReport, StaysJsonWithAPathThatIsNotUtf8AndNumbersThatAreNotFinite) {
  RunReport report = example();
  report.scenario = "caf\xe9.toml";
  report.energy.kinetic = std::numeric_limits<double>::quiet_NaN();

  EXPECT_TRUE(nlohmann::json::accept(to_json(report)));
}

TEST(RunReport, IsWrittenUnderItsName) {
  const test::TemporaryFolder folder;

  write_run_report(folder.path(), example());

  EXPECT_EQ(test::bytes_of(folder / "run.json"), to_json(example()));
  EXPECT_EQ(folder.names(), std::vector<std::string>{"run.json"});
}

}  // namespace
}  // namespace plekton::apps::run_report_test
