// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/output/vtk_writer.hpp"
#include "geometry/mesh/io/mesh_file.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plekton::dynamics::vtp_read_back_test {
namespace {

using ::testing::ElementsAre;

TEST(VtkWriter, WritesFilesThatTheMeshImportReads) {
  const test::TemporaryFolder folder;
  PolyData data;
  data.points = {{0.1, 0, 0}, {1, 1e-9, 0}, {1, 1, 1.0 / 3.0}, {0, 1, 0}};
  data.vertices.add({3});
  data.lines.add({0, 1});
  data.polygons.add({0, 1, 2});
  data.polygons.add({0, 2, 3});
  data.point_arrays.push_back({"mass <kg>", 1, std::vector<double>{1, 2, 3, 4}});
  data.cell_arrays.push_back({"force", 1, std::vector<float>{1, 2, 3, 4}});

  write_vtp(folder / "membrane.vtp", data);
  const geometry::PolygonSoup soup = geometry::read_mesh_file(folder / "membrane.vtp");

  EXPECT_EQ(soup.points, data.points);
  EXPECT_THAT(soup.polygons, ElementsAre(ElementsAre(0, 1, 2), ElementsAre(0, 2, 3)));
  EXPECT_EQ(soup.skipped_elements, 2u);
}

TEST(VtkWriter, WritesEmptyFilesThatTheMeshImportReads) {
  const test::TemporaryFolder folder;

  write_vtp(folder / "empty.vtp", {});

  EXPECT_TRUE(geometry::read_mesh_file(folder / "empty.vtp").polygons.empty());
}

}  // namespace
}  // namespace plekton::dynamics::vtp_read_back_test
