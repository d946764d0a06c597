// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/repair/repair.hpp"
#include "geometry/mesh/repair/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <utility>

namespace plekton::geometry::report_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

MeshReport report_on(const PolygonSoup& soup, std::string source) {
  MeshReport report;
  report.source = std::move(source);
  repair(soup, {}, report);
  return report;
}

TEST(MeshReport, TellsInATableWhatWasFoundChangedAndLeft) {
  PolygonSoup soup = to_soup(box_shell({1.0, 2.0, 3.0}));
  std::swap(soup.polygons[4][0], soup.polygons[4][1]);

  const std::string text = to_text(report_on(soup, "box.stl"));

  EXPECT_THAT(text, HasSubstr("box.stl\nfound\n"));
  EXPECT_THAT(text, HasSubstr("facets turned over                      1\n"));
  EXPECT_THAT(text, HasSubstr("volume                                  6 m3\n"));
  EXPECT_THAT(text, HasSubstr("verdict: repaired\n"));
  EXPECT_THAT(text, Not(HasSubstr("duplicate"))) << "what is not there gets no line";
}

TEST(MeshReport, IsValidJsonWithNullForWhatDoesNotExist) {
  const MeshReport report =
      report_on(to_soup(plane_sheet({.width = 1.0, .length = 1.0, .cells_x = 2, .cells_y = 2})),
                "a \"sheet\"\n\\.stl");

  const auto json = nlohmann::json::parse(to_json(report));

  EXPECT_EQ(json["source"], "a \"sheet\"\n\\.stl");
  EXPECT_EQ(json["verdict"], "ok");
  EXPECT_TRUE(json["reasons"].empty());
  EXPECT_EQ(json["found"]["points"], 9);
  EXPECT_EQ(json["changed"]["flipped_facets"], 0);
  EXPECT_EQ(json["after"]["facets"], 8);
  EXPECT_EQ(json["after"]["closed"], false);
  EXPECT_TRUE(json["after"]["volume"].is_null());
  EXPECT_EQ(json["after"]["area"], 1.0);
  EXPECT_EQ(json["after"]["lower"], (std::vector<double>{-0.5, -0.5, 0.0}));
}

TEST(MeshReport, GivesTheReasonOfARefusal) {
  const MeshReport report = report_on({}, "empty.off");

  EXPECT_EQ(report.verdict, MeshVerdict::refused);
  EXPECT_THAT(to_text(report), HasSubstr("verdict: refused\n  - no facets; expected at least one"));
  EXPECT_EQ(nlohmann::json::parse(to_json(report))["reasons"].size(), 1u);
}

}  // namespace
}  // namespace plekton::geometry::report_test
