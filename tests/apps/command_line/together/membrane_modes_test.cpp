// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/apps/command_line/command_fixture.hpp"

#include <cmath>

namespace plekton::apps::membrane_modes_test {
namespace {

using testing::HasSubstr;

class MembraneModes : public Command {};

TEST_F(MembraneModes, CatchGrainsWithTheirEnergyAccountedFor) {
  for (const std::string mode : {"lattice", "truss", "continuum"}) {
    const Outcome outcome =
        outcome_of({"run", scenario(), "--out", out(), "--overwrite", "--set",
                    "membranes.sheet.mode=" + mode, "--set", "membranes.sheet.hold_rotation=true"});

    EXPECT_EQ(outcome.exit_code, kDone) << mode << ": " << outcome.err;
    EXPECT_THAT(outcome.out,
                HasSubstr(mode == "continuum" ? "sheet of E = 5e+07 Pa" : "beams of E = 5e+07 Pa"));
    const nlohmann::json energy = report().at("energy");
    EXPECT_GT(energy.at(mode == "continuum" ? "sheet_elastic_J" : "bond_elastic_J").get<double>(),
              0.0);
    EXPECT_LT(std::abs(energy.at("closure_error_J").get<double>()),
              0.01 * energy.at("turnover_J").get<double>());
    const std::string frame = test::bytes_of(folder_ / "out/frames/membranes_00004.vtp");
    EXPECT_EQ(frame.find("membrane_force_largest") != std::string::npos, mode == "continuum");
    expect_complete_files();
  }
}

}  // namespace
}  // namespace plekton::apps::membrane_modes_test
