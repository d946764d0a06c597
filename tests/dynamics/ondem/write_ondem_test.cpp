// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/ondem/write_ondem.hpp"

#include "dynamics/hdf5/hdf5_reader.hpp"
#include "tests/support/ondem_scene.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plekton::dynamics::write_ondem_test {
namespace {

using testing::ElementsAre;

class WriteOndem : public testing::Test {
 protected:
  Hdf5Reader file_{ondem_file_of(test::ondem_scene()), "a.vtkhdf"};
};

// The specification of VTKHDF: a block of type PolyData has these four kinds of cells, each with
// numbers, offsets from 0 to the number of points in them, and points.
TEST_F(WriteOndem, MakesBlocksOfPolyDataAsVtkSpecifiesThem) {
  EXPECT_EQ(file_.text_attribute("/VTKHDF", "Type"), "MultiBlockDataSet");
  for (const char* const block : {"sand", "empty", "pairs", "membrane_0", "contacts"}) {
    const std::string group = std::string("/VTKHDF/") + block;
    EXPECT_EQ(file_.text_attribute(group, "Type"), "PolyData");
    const auto points = file_.numbers(group + "/Points");
    EXPECT_EQ(file_.whole_numbers(group + "/NumberOfPoints").values.at(0),
              static_cast<std::int64_t>(points.rows()));
    for (const char* const kind : {"/Vertices", "/Lines", "/Polygons", "/Strips"}) {
      const std::string cells = group + kind;
      const auto offsets = file_.whole_numbers(cells + "/Offsets").values;
      const auto connected = file_.whole_numbers(cells + "/Connectivity").values;
      EXPECT_EQ(static_cast<std::int64_t>(offsets.size()),
                file_.whole_numbers(cells + "/NumberOfCells").values.at(0) + 1);
      EXPECT_EQ(offsets.front(), 0);
      EXPECT_EQ(offsets.back(), static_cast<std::int64_t>(connected.size()));
      EXPECT_EQ(file_.whole_numbers(cells + "/NumberOfConnectivityIds").values.at(0),
                offsets.back());
      for (const std::int64_t point : connected)
        EXPECT_LT(point, static_cast<std::int64_t>(points.rows()));
    }
  }
}

TEST_F(WriteOndem, GivesEveryBlockOfBodiesTheSameArrays) {
  const auto arrays = file_.names_in("/VTKHDF/sand/PointData");

  EXPECT_EQ(file_.names_in("/VTKHDF/empty/PointData"), arrays);
  EXPECT_EQ(file_.names_in("/VTKHDF/pairs/PointData"), arrays);
  EXPECT_THAT(file_.texts("/ONDEM/Scene/display_group_names"),
              ElementsAre("sand", "empty", "pairs"));
}

TEST_F(WriteOndem, ListsAllBlocksInTheAssembly) {
  EXPECT_THAT(file_.names_in("/VTKHDF/Assembly"),
              ElementsAre("contacts", "empty", "membrane_0", "pairs", "sand"));
}

// The draft: quaternions have the scalar first; inertia is a matrix of three rows; what does not
// apply is NaN, or -1 of whole numbers.
TEST_F(WriteOndem, KeepsTheConventionsOfTheDraft) {
  const std::string data = "/VTKHDF/pairs/PointData/";

  EXPECT_EQ(file_.text_attribute(data + "orientation", "order"), "wxyz");
  EXPECT_THAT(file_.numbers("/VTKHDF/sand/PointData/orientation").values,
              ElementsAre(0.5, -0.5, 0.5, -0.5));
  const auto inertia = file_.numbers(data + "inertia");
  EXPECT_EQ(inertia.columns, 9U);
  EXPECT_EQ(std::vector<double>(inertia.values.begin() + 9, inertia.values.end()),
            (std::vector<double>{1, 0, 0, 0, 2, 0, 0, 0, 3}));
  EXPECT_THAT(file_.whole_numbers(data + "clump_id").values, ElementsAre(9, -1));
  EXPECT_TRUE(std::isnan(file_.numbers(data + "radius").values.at(1)));
}

TEST_F(WriteOndem, ShowsContactsWithAllTheirNumbers) {
  EXPECT_EQ(file_.numbers("/VTKHDF/contacts/CellData/gap").values,
            file_.numbers("/Plekton/Contacts/gap").values);
  EXPECT_EQ(file_.numbers("/VTKHDF/contacts/CellData/normal").columns, 3U);
}

TEST(WriteOndemFile, HasTheSameBytesForTheSameScene) {
  EXPECT_EQ(ondem_file_of(test::ondem_scene()), ondem_file_of(test::ondem_scene()));
}

TEST(WriteOndemFile, RefusesNamesThatGroupsCannotHave) {
  for (const char* const name : {"", "a/b", "Assembly", ".", "contacts"}) {
    OndemScene scene = test::ondem_scene();
    scene.blocks[0] = name;
    EXPECT_THROW(ondem_file_of(scene), std::invalid_argument) << name;
  }
  OndemScene twice = test::ondem_scene();
  twice.blocks[1] = twice.blocks[0];
  EXPECT_THROW(ondem_file_of(twice), std::invalid_argument);
}

TEST(WriteOndemFile, LeavesNothingButItself) {
  test::TemporaryFolder folder;
  write_ondem(folder / "a.vtkhdf", test::ondem_scene());

  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.vtkhdf"});
}

}  // namespace
}  // namespace plekton::dynamics::write_ondem_test
