// SPDX-License-Identifier: GPL-3.0-or-later
// The keys of a scenario that repair the mesh of a membrane.
#include "apps/scenario/scenario_reader.hpp"
#include "apps/scene/build_scene.hpp"
#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/io/mesh_file.hpp"
#include "tests/apps/command_line/program_fixture.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace plekton::apps::mesh_keys_test {
namespace {

using testing::HasSubstr;

/// A scenario of a membrane from box.off, written in mm unless told; its keys begin in line 14.
std::string scenario_with(std::string_view keys, double scale = 0.001) {
  return fmt::format(R"([simulation]
duration = "30 ms"
[materials.stone]
young_modulus = "20 MPa"
friction_angle = "35 deg"
[[membranes]]
name = "m"
scale = {}
mesh = "box.off"
thickness = "1 mm"
material = "stone"
young_modulus = "500 MPa"
areal_mass = "300 g/m2"
{}
)",
                     scale, keys);
}

/// A box of 120 mm x 120 mm x 120 mm, each side in 3 x 3 cells, with two holes: a facet in the
/// middle of the bottom (perimeter 40 (2 + sqrt 2) = 136.6 mm), and the whole top (480 mm).
class MeshKeys : public testing::Test {
 protected:
  MeshKeys() {
    geometry::Mesh box = geometry::box_shell(Vec3::Constant(120.0), {3, 3, 3});
    std::erase_if(box.facets, [&](const auto& facet) {
      return height(box, facet[0]) == 120.0 && height(box, facet[1]) == 120.0 &&
             height(box, facet[2]) == 120.0;
    });
    const auto in_the_middle = [&](const auto& facet) {
      Vec3 middle = Vec3::Zero();
      for (const auto node : facet) middle += box.points[geometry::index_of(node)] / 3.0;
      return middle[2] == 0.0 && (middle.head<2>().array() > 40.0).all() &&
             (middle.head<2>().array() < 80.0).all();
    };
    box.facets.erase(std::find_if(box.facets.begin(), box.facets.end(), in_the_middle));
    geometry::write_mesh_file(folder_ / "box.off", box);
  }
  static double height(const geometry::Mesh& mesh, geometry::NodeId node) {
    return mesh.points[geometry::index_of(node)][2];
  }
  Outcome checked(std::string_view keys) const {
    test::write_bytes(folder_ / "case.toml", scenario_with(keys));
    return outcome_of({"check", (folder_ / "case.toml").string()});
  }
  std::string error_of(std::string_view keys) const {
    const Outcome outcome = checked(keys);
    EXPECT_EQ(outcome.exit_code, kFailed) << outcome.out;
    return outcome.err;
  }
  BuiltMembrane built(std::string_view keys, double scale = 0.001) const {
    const std::string text = scenario_with(keys, scale);
    return build_scene(parse_scenario(text, folder_ / "case.toml")).membranes.at(0);
  }

  test::TemporaryFolder folder_;
};

TEST_F(MeshKeys, LeaveTheMeshOpenUnlessAsked) {
  EXPECT_EQ(built("").facets, 5U * 18U - 1U);
  EXPECT_FALSE(built("").report->reshaped);
}

TEST_F(MeshKeys, FillHolesUpToALengthThatCountsAfterScaling) {
  const BuiltMembrane small = built("longest_hole = \"14 cm\"");
  const BuiltMembrane none = built("fill_holes = true\nlongest_hole = \"13 cm\"");
  const BuiltMembrane all = built("fill_holes = true");

  EXPECT_EQ(small.facets, 5U * 18U);
  EXPECT_EQ(small.report->reshaped->holes_filled, 1U);
  EXPECT_EQ(none.facets, 5U * 18U - 1U);
  EXPECT_EQ(all.report->reshaped->holes_filled, 2U);
  EXPECT_DOUBLE_EQ(all.area, 6 * 0.12 * 0.12);
}

TEST_F(MeshKeys, WrapClosesTheSurfaceWithDetailsThatCountAfterScaling) {
  const BuiltMembrane coarse = built("wrap = true\nwrap_detail = \"20 mm\"");
  const BuiltMembrane fine = built("wrap_detail = \"10 mm\"");

  EXPECT_DOUBLE_EQ(fine.report->reshaped->wrap_detail, 0.01);  // m, not mm as the file
  EXPECT_GT(fine.facets, coarse.facets);
  // Closed: every facet has three edges, each shared by two.
  EXPECT_EQ(2 * fine.beams, 3 * fine.facets);
}

TEST_F(MeshKeys, TargetEdgeCountsAfterScaling) {
  const BuiltMembrane remeshed = built("target_edge = \"10 mm\"");

  // Equilateral facets of that edge are sqrt(3) / 4 edge² each; isotropic remeshing settles within
  // edges of 4/5 to 4/3 of the target, so the number of facets is within the squares of these.
  const double expected = remeshed.area / (std::sqrt(3.0) / 4.0 * 0.01 * 0.01);
  EXPECT_GT(static_cast<double>(remeshed.facets), expected * 9.0 / 16.0);
  EXPECT_LT(static_cast<double>(remeshed.facets), expected * 25.0 / 16.0);
}

TEST_F(MeshKeys, RefuseIntersectionsOnlyWhenAsked) {
  // Two triangles through each other.
  test::write_bytes(folder_ / "box.off",
                    "OFF\n6 2 0\n0 0 0\n100 0 0\n0 100 0\n20 20 -50\n30 20 50\n20 30 50\n"
                    "3 0 1 2\n3 3 4 5\n");

  EXPECT_EQ(checked("").exit_code, kDone);
  EXPECT_THAT(error_of("refuse_intersections = true"),
              HasSubstr("case.toml:9:8: membranes.m: box.off: 1 pairs of facets intersect"));
}

TEST_F(MeshKeys, RefuseLengthsOfStepsThatAreTurnedOff) {
  EXPECT_THAT(error_of("fill_holes = false\nlongest_hole = \"1 m\""),
              HasSubstr("case.toml:15:16: membranes.m.longest_hole: goes with fill_holes, which is "
                        "false; leave longest_hole out, or fill_holes"));
  EXPECT_THAT(
      error_of("wrap = false\nwrap_detail = \"1 m\""),
      HasSubstr("case.toml:15:15: membranes.m.wrap_detail: goes with wrap, which is false"));
}

TEST_F(MeshKeys, RefuseToHoldTheRimOfWhatTheyClose) {
  EXPECT_THAT(
      error_of("wrap = true\nhold = \"rim\""),
      HasSubstr("case.toml:15:8: membranes.m.hold: a wrapped mesh is closed and has no rim; "
                "hold the nodes in a box"));
  EXPECT_THAT(error_of("fill_holes = true\nhold = \"rim\""),
              HasSubstr("\"m\" has no rim to hold: its mesh is closed; hold the nodes in a box, or "
                        "fill no hole as long as the rim (longest_hole)"));
  EXPECT_EQ(checked("longest_hole = \"14 cm\"\nhold = \"rim\"").exit_code, kDone);
}

TEST_F(MeshKeys, RefuseValuesThatAreNoLengths) {
  for (const std::string key : {"longest_hole", "wrap_detail", "target_edge"}) {
    EXPECT_THAT(error_of(key + " = \"0 mm\""),
                HasSubstr("membranes.m." + key + ": got \"0 mm\"; expected a length above 0"));
    EXPECT_THAT(error_of(key + " = \"1 kg\""),
                HasSubstr("membranes.m." + key + ": got \"1 kg\", a mass; expected a length"));
  }
  EXPECT_THAT(error_of("fill_holes = \"yes\""),
              HasSubstr("membranes.m.fill_holes: got \"yes\"; expected true or false"));
  EXPECT_THAT(error_of("fill_hole = true"),
              HasSubstr("membranes.m.fill_hole: unknown key; did you mean \"fill_holes\"?"));
}

TEST_F(MeshKeys, SayThatLengthsInTheMessageOfAnImportAreThoseOfTheFile) {
  EXPECT_THAT(error_of("target_edge = \"1 um\""),
              HasSubstr("(lengths here are before scaling by 0.001)"));
}

TEST_F(MeshKeys, NameTheKeyOfTheStepThatCannotBeDone) {
  EXPECT_THAT(error_of("target_edge = \"1 um\""),
              HasSubstr("case.toml:14:15: membranes.m.target_edge: box.off: a target edge of"));
  EXPECT_THAT(error_of("wrap = true\nwrap_detail = \"1 um\""),
              HasSubstr("case.toml:15:15: membranes.m.wrap_detail: box.off: a wrap of"));
}

TEST_F(MeshKeys, CloseTheBagOfTheExampleAndRemeshIt) {
  std::filesystem::copy_file(PLEKTON_SOURCE_DIR "/apps/examples/import/bag.off",
                             folder_ / "box.off",
                             std::filesystem::copy_options::overwrite_existing);

  const BuiltMembrane open = built("", 1.0);
  const BuiltMembrane closed = built("weld = \"1 um\"\nfill_holes = true", 1.0);
  const BuiltMembrane even =
      built("weld = \"1 um\"\nfill_holes = true\ntarget_edge = \"25 mm\"", 1.0);

  EXPECT_EQ(open.report->changed.flipped_facets, 59U);
  EXPECT_FALSE(open.report->after.volume);
  EXPECT_EQ(closed.report->reshaped->holes_filled, 2U);
  EXPECT_EQ(2 * closed.beams, 3 * closed.facets);
  EXPECT_GT(closed.report->after.volume.value(), 0.0);
  EXPECT_GT(even.facets, closed.facets);
  EXPECT_EQ(2 * even.beams, 3 * even.facets);
}

}  // namespace
}  // namespace plekton::apps::mesh_keys_test
