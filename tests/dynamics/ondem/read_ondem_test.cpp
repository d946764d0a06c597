// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/ondem/read_ondem.hpp"

#include "dynamics/hdf5/hdf5_writer.hpp"
#include "dynamics/ondem/write_ondem.hpp"
#include "tests/support/ondem_scene.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <array>
#include <cmath>
#include <cstring>

namespace plekton::dynamics::read_ondem_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// Of every bit, also where it says nothing or has a sign alone.
template <class Value>
bool same_bits(const Value& a, const Value& b) {
  return std::memcmp(&a, &b, sizeof(Value)) == 0;
}

OndemScene read_back(const OndemScene& scene) {
  return parse_ondem(ondem_file_of(scene), "a.vtkhdf");
}

/// What a file of a scene that was changed is refused with.
template <class Change>
void expect_refused(Change change, const std::string& message) {
  OndemScene scene = test::ondem_scene();
  change(scene);
  const std::string bytes = ondem_file_of(scene);
  EXPECT_THAT([&] { parse_ondem(bytes, "a.vtkhdf"); },
              ThrowsMessage<OndemError>(AllOf(HasSubstr("a.vtkhdf: "), HasSubstr(message))));
}

/// The least file there is: no bodies.
struct LeastFile {
  LeastFile() {
    file.group("/VTKHDF");
    file.attribute("/VTKHDF", "Type", std::string("MultiBlockDataSet"));
    file.group("/ONDEM/Scene");
    file.texts("/ONDEM/Scene/display_group_names", {"Points"});
  }
  void add_points(const std::vector<double>& points, std::size_t columns) {
    file.numbers("/VTKHDF/Points/Points", points, columns);
  }
  void expect_refused(const std::string& message) const {
    EXPECT_THAT([&] { parse_ondem(file.bytes(), "a.vtkhdf"); },
                ThrowsMessage<OndemError>(HasSubstr(message)));
  }
  Hdf5Writer file;
};

TEST(ReadOndem, GivesBackEveryBitOfBodies) {
  const OndemScene scene = test::ondem_scene();
  const OndemScene read = read_back(scene);

  EXPECT_TRUE(same_bits(read.time, scene.time));
  EXPECT_TRUE(same_bits(read.time_step, scene.time_step));
  EXPECT_EQ(read.iteration, scene.iteration);
  EXPECT_TRUE(same_bits(read.gravity, scene.gravity));
  EXPECT_EQ(read.blocks, scene.blocks);
  ASSERT_EQ(read.bodies.size(), scene.bodies.size());
  for (std::size_t i = 0; i < read.bodies.size(); ++i) {
    const OndemBody& a = read.bodies[i];
    const OndemBody& b = scene.bodies[i];
    EXPECT_EQ(std::tie(a.id, a.block, a.shape, a.material, a.clump, a.blocked_dofs),
              std::tie(b.id, b.block, b.shape, b.material, b.clump, b.blocked_dofs));
    EXPECT_TRUE(same_bits(a.radius, b.radius) && same_bits(a.mass, b.mass) &&
                same_bits(a.volume, b.volume));
    EXPECT_TRUE(same_bits(a.position, b.position) && same_bits(a.velocity, b.velocity) &&
                same_bits(a.angular_velocity, b.angular_velocity));
    EXPECT_TRUE(same_bits(a.orientation.coeffs(), b.orientation.coeffs()));
    EXPECT_TRUE(same_bits(a.moments, b.moments));
  }
}

TEST(ReadOndem, GivesBackMaterialsInTheOrderOfTheirIds) {
  const OndemScene scene = test::ondem_scene();
  const OndemScene read = read_back(scene);

  ASSERT_EQ(read.materials.size(), scene.materials.size());
  for (std::size_t i = 0; i < read.materials.size(); ++i) {
    EXPECT_EQ(read.materials[i].id, scene.materials[i].id);
    EXPECT_EQ(read.materials[i].label, scene.materials[i].label);
    EXPECT_TRUE(same_bits(read.materials[i].normal_stiffness, scene.materials[i].normal_stiffness));
    EXPECT_TRUE(same_bits(read.materials[i].poisson_ratio, scene.materials[i].poisson_ratio));
  }
}

TEST(ReadOndem, GivesBackContacts) {
  const OndemScene read = read_back(test::ondem_scene());

  ASSERT_EQ(read.contacts.size(), 1U);
  const OndemContact& contact = read.contacts.front();
  EXPECT_EQ(contact.id1, 7);
  EXPECT_EQ(contact.id2, 8);
  EXPECT_EQ(contact.normal_force, -0.1);
  EXPECT_EQ(contact.shear_force[1], 0.3);
  EXPECT_EQ(contact.overlap, 1e-6);
  EXPECT_EQ(contact.normal_stiffness, 1e5);
  EXPECT_TRUE(std::isnan(contact.shear_stiffness));
}

TEST(ReadOndem, GivesBackMembranesPlanesAndTheState) {
  const OndemScene scene = test::ondem_scene();
  const OndemScene read = read_back(scene);

  EXPECT_EQ(read.writer, scene.writer);
  EXPECT_EQ(read.velocity_time, scene.velocity_time);
  ASSERT_EQ(read.membranes.size(), 1U);
  const OndemMembrane& net = read.membranes.front();
  const OndemMembrane& expected = scene.membranes.front();
  EXPECT_EQ(net.name, expected.name);
  EXPECT_EQ(net.position, expected.position);
  EXPECT_EQ(net.velocity, expected.velocity);
  EXPECT_EQ(net.facets, expected.facets);
  EXPECT_EQ(net.cylinders, expected.cylinders);
  EXPECT_EQ(net.cylinder_radius, expected.cylinder_radius);
  EXPECT_EQ(net.blocked_dofs, expected.blocked_dofs);
  ASSERT_EQ(read.planes.size(), 1U);
  EXPECT_EQ(read.planes.front().name, "drum");
  EXPECT_EQ(read.planes.front().radius, 0.25);
  EXPECT_EQ(read.planes.front().angular_velocity, geometry::Vec3(0.0, 0.0, 3.0));
  EXPECT_EQ(read.planes.front().point, scene.planes.front().point);
  EXPECT_EQ(read.state.arrays.size(), scene.state.arrays.size());
  EXPECT_EQ(read.state.hash(), scene.state.hash());
}

TEST(ReadOndem, ReadsAFileWithoutAdditions) {
  OndemScene scene = test::ondem_scene();
  scene.has_additions = false;
  const OndemScene read = read_back(scene);

  EXPECT_EQ(read.bodies.size(), 3U);
  EXPECT_FALSE(read.has_additions);
  EXPECT_TRUE(read.membranes.empty());
}

// Files of other programs name shapes in another order, and may have ones that are not here.
TEST(ReadOndem, FindsShapesByName) {
  LeastFile least;
  least.file.texts("/ONDEM/Scene/shape_names", {"wall", "sphere"});
  least.add_points({1.0, 2.0, 3.0, 4.0, 5.0, 6.0}, 3);
  least.file.numbers("/VTKHDF/Points/PointData/body_id", std::vector<std::int64_t>{3, 4});
  least.file.numbers("/VTKHDF/Points/PointData/shape_type", std::vector<std::int64_t>{0, 1});
  least.file.numbers("/VTKHDF/Points/PointData/radius", std::vector<double>{kNoNumber, 0.5});

  const OndemScene read = parse_ondem(least.file.bytes(), "a.vtkhdf");

  ASSERT_EQ(read.bodies.size(), 2U);
  EXPECT_EQ(read.bodies[0].shape, OndemShape::other);
  EXPECT_EQ(read.bodies[1].shape, OndemShape::sphere);
  EXPECT_EQ(read.bodies[1].radius, 0.5);
  EXPECT_EQ(read.bodies[1].position, geometry::Vec3(4.0, 5.0, 6.0));
}

TEST(ReadOndem, RefusesWhatIsNoHdf5File) {
  for (const std::string bytes : {"", "x,y,z\n", "\x89HDF\r\n\x1a\n"})
    EXPECT_THAT([&] { parse_ondem(bytes, "a.vtkhdf"); },
                ThrowsMessage<OndemError>(HasSubstr("a.vtkhdf: is no whole HDF5 file")));
  EXPECT_THAT([] { read_ondem("/no/such.vtkhdf"); },
              ThrowsMessage<OndemError>(HasSubstr("/no/such.vtkhdf")));
}

TEST(ReadOndem, RefusesAnHdf5FileOfOtherThings) {
  Hdf5Writer other;
  other.number("/answer", 42.0);

  EXPECT_THAT([&] { parse_ondem(other.bytes(), "a.h5"); },
              ThrowsMessage<OndemError>(HasSubstr("expected an ON-DEM file")));
}

TEST(ReadOndem, RefusesFilesThatLackDataSets) {
  LeastFile least;
  least.expect_refused("/ONDEM/Scene/shape_names: there is no such data set");
  least.file.texts("/ONDEM/Scene/shape_names", {"sphere"});
  least.expect_refused("/VTKHDF/Points/Points: there is no such data set");
  least.add_points({1.0, 2.0, 3.0}, 3);
  least.expect_refused("PointData/body_id: there is no such data set");
}

TEST(ReadOndem, RefusesWrongShapes) {
  LeastFile least;
  least.file.texts("/ONDEM/Scene/shape_names", {"sphere"});
  least.add_points({1.0, 2.0, 3.0}, 3);
  least.file.numbers("/VTKHDF/Points/PointData/body_id", std::vector<std::int64_t>{3, 4});

  least.expect_refused("body_id: got 2 rows of 1; expected 1 of 1");
}

TEST(ReadOndem, RefusesPointsWithoutThreeCoordinates) {
  LeastFile least;
  least.file.texts("/ONDEM/Scene/shape_names", {"sphere"});
  least.add_points({1.0, 2.0, 3.0, 4.0}, 2);

  least.expect_refused("got rows of 2; expected three coordinates");
}

TEST(ReadOndem, RefusesNumbersOfAnotherKind) {
  LeastFile least;
  least.file.texts("/ONDEM/Scene/shape_names", {"sphere"});
  least.add_points({1.0, 2.0, 3.0}, 3);
  least.file.numbers("/VTKHDF/Points/PointData/body_id", std::vector<double>{3.0});

  least.expect_refused("body_id: expected whole numbers");
}

TEST(ReadOndem, RefusesBodiesThatCannotBe) {
  expect_refused([](OndemScene& s) { s.bodies[0].radius = 0.0; }, "radius: of sphere 7");
  expect_refused([](OndemScene& s) { s.bodies[0].radius = kNoNumber; },
                 "expected a length above 0");
  expect_refused([](OndemScene& s) { s.bodies[0].position[1] = kNoNumber; },
                 "Points: is not finite");
  expect_refused([](OndemScene& s) { s.bodies[1].velocity[0] = kNoNumber; },
                 "velocity: of body 8 is not finite");
  expect_refused([](OndemScene& s) { s.bodies[0].orientation.w() = 3.0; }, "no unit quaternion");
  expect_refused([](OndemScene& s) { s.bodies[1].id = 7; }, "body 7 is there twice");
  expect_refused([](OndemScene& s) { s.contacts[0].id2 = 70; }, "with body 70, which is not there");
  expect_refused([](OndemScene& s) { s.time = kNoNumber; }, "attribute time: is not finite");
}

TEST(ReadOndem, RefusesMembranesThatCannotBe) {
  expect_refused([](OndemScene& s) { s.membranes[0].facets[0][1] = 4; },
                 "facets: got node 4; there are 4");
  expect_refused([](OndemScene& s) { s.membranes[0].cylinders[1][0] = -1; }, "got node -1");
  expect_refused([](OndemScene& s) { s.membranes[0].mass.pop_back(); },
                 "mass: got 3 rows of 1; expected 4 of 1");
}

// A data set may say that it has any number of rows without holding them.
TEST(ReadOndem, TakesNoMemoryForSizesThatAreOnlySaid) {
  test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "a.vtkhdf";
  write_ondem(path, test::ondem_scene());
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  H5Ldelete(file, "/VTKHDF/sand/Points", H5P_DEFAULT);
  const hsize_t size[2] = {hsize_t{1} << 40U, 3};
  const hsize_t chunk[2] = {1024, 3};
  const hid_t space = H5Screate_simple(2, size, nullptr);
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_chunk(creation, 2, chunk);
  H5Pset_deflate(creation, 6);
  const hid_t set = H5Dcreate2(file, "/VTKHDF/sand/Points", H5T_IEEE_F64LE, space, H5P_DEFAULT,
                               creation, H5P_DEFAULT);
  ASSERT_GE(set, 0);
  H5Dclose(set);
  H5Pclose(creation);
  H5Sclose(space);
  H5Fclose(file);

  EXPECT_THAT([&] { read_ondem(path); },
              ThrowsMessage<OndemError>(HasSubstr("more than the file holds of it")));
}

// As h5py writes them: texts each of its own length, numbers in packed pieces.
TEST(ReadOndem, ReadsTextsAndPackedNumbersOfOtherPrograms) {
  test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "a.vtkhdf";
  write_ondem(path, test::ondem_scene());
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  const char* const names[3] = {"sphere", "clump", "polyhedron of many corners"};
  const hsize_t three = 3;
  const hid_t space = H5Screate_simple(1, &three, nullptr);
  H5Ldelete(file, "/ONDEM/Scene/shape_names", H5P_DEFAULT);
  const hid_t texts = H5Dcreate2(file, "/ONDEM/Scene/shape_names", type, space, H5P_DEFAULT,
                                 H5P_DEFAULT, H5P_DEFAULT);
  ASSERT_GE(H5Dwrite(texts, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, names), 0);
  H5Dclose(texts);
  H5Sclose(space);
  H5Tclose(type);
  const hsize_t size[2] = {2, 3};
  const hid_t points_space = H5Screate_simple(2, size, nullptr);
  const hid_t packed = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_chunk(packed, 2, size);
  H5Pset_deflate(packed, 6);
  H5Ldelete(file, "/VTKHDF/pairs/Points", H5P_DEFAULT);
  const hid_t points = H5Dcreate2(file, "/VTKHDF/pairs/Points", H5T_IEEE_F32BE, points_space,
                                  H5P_DEFAULT, packed, H5P_DEFAULT);
  const std::array<double, 6> places{1.0, 2.0, 3.0, 4.0, 5.0, 0.5};
  ASSERT_GE(H5Dwrite(points, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, places.data()), 0);
  H5Dclose(points);
  H5Pclose(packed);
  H5Sclose(points_space);
  H5Fclose(file);

  const OndemScene read = read_ondem(path);

  EXPECT_EQ(read.bodies[1].shape, OndemShape::sphere);
  EXPECT_EQ(read.bodies[2].position, geometry::Vec3(4.0, 5.0, 0.5));
}

// Whatever bytes there are: read, or refused.
TEST(ReadOndem, EndsWellWhateverBytesAreChanged) {
  const std::string whole = ondem_file_of(test::ondem_scene());
  std::uint32_t random = 12345;
  const auto next = [&] { return (random = random * 1664525U + 1013904223U) >> 8U; };
  for (int trial = 0; trial < 60; ++trial) {
    std::string changed = whole;
    for (int k = 0; k < 3; ++k) changed[next() % changed.size()] = static_cast<char>(next());
    try {
      parse_ondem(changed, "a.vtkhdf");
    } catch (const OndemError& error) {
      EXPECT_THAT(error.what(), HasSubstr("a.vtkhdf: "));
    }
  }
}

// What leads out of the file is as if it were not there.
TEST(ReadOndem, FollowsNoLinkToAnotherFile) {
  test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "a.vtkhdf";
  write_ondem(folder / "other.vtkhdf", test::ondem_scene());
  write_ondem(path, test::ondem_scene());
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  H5Ldelete(file, "/VTKHDF/sand", H5P_DEFAULT);
  H5Lcreate_external((folder / "other.vtkhdf").c_str(), "/VTKHDF/sand", file, "/VTKHDF/sand",
                     H5P_DEFAULT, H5P_DEFAULT);
  H5Fclose(file);

  EXPECT_THAT([&] { read_ondem(path); },
              ThrowsMessage<OndemError>(HasSubstr("/VTKHDF/sand/Points: there is no such")));
}

TEST(ReadOndem, RefusesEveryFileThatIsCutOff) {
  const std::string whole = ondem_file_of(test::ondem_scene());
  for (std::size_t size = 0; size < whole.size(); size += 997)
    EXPECT_THROW(parse_ondem(whole.substr(0, size), "a.vtkhdf"), OndemError) << size;
}

}  // namespace
}  // namespace plekton::dynamics::read_ondem_test
