// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/mesh.hpp"

#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/generate/membrane.hpp"
#include "geometry/mesh/io/mesh_file.hpp"
#include "geometry/mesh/repair/measures.hpp"
#include "geometry/mesh/repair/remesh.hpp"
#include "geometry/mesh/repair/reshape.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <map>
#include <string>

namespace plekton::geometry::mesh_test {
namespace {

using ::testing::EndsWith;
using ::testing::StartsWith;

/// A box of 8 points, of which a facet names another one.
Mesh box_with_corner(NodeId node) {
  Mesh mesh = box_shell({1, 1, 1});
  mesh.facets[3][1] = node;
  return mesh;
}

std::string message_of(const std::function<void()>& use) {
  try {
    use();
  } catch (const MeshError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(RequireCorners, AcceptsWhatNamesItsPoints) {
  EXPECT_NO_THROW(require_corners(box_shell({1, 1, 1})));
  EXPECT_NO_THROW(require_corners({}));
}

TEST(RequireCorners, CountsCornersBeyondAFew) {
  Mesh mesh = box_shell({1, 1, 1});
  mesh.points.clear();

  const std::string message = message_of([&] { require_corners(mesh); });

  EXPECT_THAT(message, StartsWith("facet 0 names point "));
  EXPECT_THAT(message, EndsWith("and 28 more corners like these; add the points, or leave out the "
                                "facets"));  // 12 facets
}

TEST(RequireCorners, IsAskedByEveryFunctionThatTakesAMesh) {
  const test::TemporaryFolder folder;
  std::map<std::string, std::function<void(const Mesh&)>> uses{
      {"measure", [](const Mesh& mesh) { measure(mesh, true); }},
      {"smallest_angle", [](const Mesh& mesh) { smallest_angle(mesh); }},
      {"make_membrane", [](const Mesh& mesh) { make_membrane(mesh, {.thickness = 0.1}); }},
      {"remesh", [](const Mesh& mesh) { remesh(mesh, 0.1); }},
      {"reshape",
       [](Mesh mesh) {
         MeshReport report;
         reshape(mesh, {.fill_holes = true}, report);
       }},
  };
  for (const char* ending : {"off", "obj", "stl", "ply", "msh", "vtp"}) {
    uses[ending] = [&folder, ending](const Mesh& mesh) {
      write_mesh_file(folder.path() / (std::string("mesh.") + ending), mesh);
    };
  }
  for (const int node : {8, -1, 2000000000}) {
    for (const auto& [name, use] : uses) {
      EXPECT_EQ(message_of([&, &use = use] { use(box_with_corner(NodeId{node})); }),
                "facet 3 names point " + std::to_string(node) +
                    ", but there are 8 points, counted from 0; add the points, or leave out the "
                    "facets")
          << name;
    }
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace plekton::geometry::mesh_test
