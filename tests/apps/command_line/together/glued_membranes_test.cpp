// SPDX-License-Identifier: GPL-3.0-or-later
// The law cohesive_frictional between membranes.
#include "tests/apps/command_line/program_fixture.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace plekton::apps::glued_membranes_test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Two sheets that overlap by a tenth of their thickness; the keys of their contact come last.
constexpr std::string_view kTwoSheets = R"([simulation]
duration = "50 us"
gravity = [0, 0, 0]
[materials.rubber]
young_modulus = "10 MPa"
friction_angle = "20 deg"
[[membranes]]
name = "lower"
shape = { kind = "sheet", width = "4 cm", length = "4 cm", cells = [2, 2] }
thickness = "2 mm"
young_modulus = "10 MPa"
density = "1000 kg/m3"
material = "rubber"
[[membranes]]
name = "upper"
shape = { kind = "sheet", width = "3 cm", length = "3 cm", cells = [2, 2] }
translate = [0, 0, "1.8 mm"]
thickness = "2 mm"
young_modulus = "10 MPa"
density = "1000 kg/m3"
material = "rubber"
[output]
interval = "50 us"
contact_list = true
[[contacts]]
between = "rubber"
and = "rubber"
law = "cohesive_frictional"
)";

class GluedMembranes : public testing::Test {
 protected:
  Outcome run(const std::string& keys) const {
    test::write_bytes(folder_ / "case.toml", std::string(kTwoSheets) + keys);
    Outcome outcome = outcome_of({"run", (folder_ / "case.toml").string(), "--out",
                                  (folder_ / "out").string(), "--overwrite"});
    EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
    return outcome;
  }

  test::TemporaryFolder folder_;
};

/// How many rows of contacts.csv have a bond, and how many not.
struct Rows {
  int bonded = 0;
  int others = 0;
};

Rows rows_of(const std::filesystem::path& file) {
  std::istringstream table(test::bytes_of(file));
  const auto parts_of = [](const std::string& row) {
    std::vector<std::string> parts;
    std::istringstream in(row);
    for (std::string part; std::getline(in, part, ',');) parts.push_back(part);
    return parts;
  };
  std::string line;
  std::getline(table, line);
  const auto names = parts_of(line);
  const auto column =
      static_cast<std::size_t>(std::find(names.begin(), names.end(), "is_bonded") - names.begin());
  Rows rows;
  while (std::getline(table, line))
    ++(std::stod(parts_of(line).at(column)) == 1.0 ? rows.bonded : rows.others);
  return rows;
}

TEST_F(GluedMembranes, HaveBondsInTheListOfContactsBesideWhatPushes) {
  for (const char* const bonds : {"", "bonds = \"start\"\n", "bonds = \"new\"\n"}) {
    const Outcome outcome = run("tensile_strength = \"1 MPa\"\n" + std::string(bonds));
    EXPECT_THAT(outcome.out, Not(HasSubstr("warning: contacts of")));
    const Rows rows = rows_of(folder_ / "out/contacts.csv");
    EXPECT_GT(rows.bonded, 1) << bonds;
    EXPECT_GT(rows.others, 0) << bonds;
  }
}

TEST_F(GluedMembranes, HaveNoBondsWithoutStrength) {
  run("");
  EXPECT_EQ(rows_of(folder_ / "out/contacts.csv").bonded, 0);
}

}  // namespace
}  // namespace plekton::apps::glued_membranes_test
