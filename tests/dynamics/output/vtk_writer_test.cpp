// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/output/vtk_writer.hpp"

#include "dynamics/output/file.hpp"
#include "tests/support/full_disk.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/vtp_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <random>
#include <stdexcept>

namespace plekton::dynamics::vtk_writer_test {
namespace {

using geometry::Vec3;
using test::bytes_of;
using test::TemporaryFolder;
using test::VtpReader;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::ThrowsMessage;

/// Any bits at all, so that nothing but a copy of the bytes passes.
template <class T>
std::vector<T> random_bits(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<T> values(count);
  for (T& value : values) {
    if constexpr (sizeof(T) == 8) value = std::bit_cast<T>(random());
    if constexpr (sizeof(T) == 4) value = std::bit_cast<T>(static_cast<std::uint32_t>(random()));
  }
  return values;
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

TEST(WriteVtp, ReadsBackBitForBitInEveryType) {
  const TemporaryFolder folder;
  constexpr std::size_t kPoints = 100;
  PolyData data;
  const auto coordinates = random_bits<double>(3 * kPoints, 1);
  for (std::size_t i = 0; i < kPoints; ++i) data.points.emplace_back(&coordinates[3 * i]);
  const auto f32 = random_bits<float>(kPoints, 2);
  const auto f64 = random_bits<double>(2 * kPoints, 3);
  const auto i32 = random_bits<std::int32_t>(3 * kPoints, 4);
  const auto i64 = random_bits<std::int64_t>(kPoints, 5);
  data.point_arrays = {{"f32", 1, f32}, {"f64", 2, f64}, {"i32", 3, i32}, {"i64", 1, i64}};

  write_vtp(folder / "a.vtp", data);

  const VtpReader file(bytes_of(folder / "a.vtp"));
  EXPECT_EQ(file.count("NumberOfPoints"), kPoints);
  EXPECT_TRUE(same_bits(file.values<double>("Points", "Points"), coordinates));
  EXPECT_TRUE(same_bits(file.values<float>("PointData", "f32"), f32));
  EXPECT_TRUE(same_bits(file.values<double>("PointData", "f64"), f64));
  EXPECT_TRUE(same_bits(file.values<std::int32_t>("PointData", "i32"), i32));
  EXPECT_TRUE(same_bits(file.values<std::int64_t>("PointData", "i64"), i64));
  EXPECT_EQ(file.attribute_of("PointData", "f32", "type"), "Float32");
  EXPECT_EQ(file.attribute_of("PointData", "f64", "type"), "Float64");
  EXPECT_EQ(file.attribute_of("PointData", "i32", "type"), "Int32");
  EXPECT_EQ(file.attribute_of("PointData", "i64", "type"), "Int64");
  EXPECT_EQ(file.attribute_of("PointData", "i32", "NumberOfComponents"), "3");
}

// Blocks hold 32768 doubles: no block, one partial, one full, one full and one partial, two full.
TEST(WriteVtp, ReadsBackAcrossTheBordersOfBlocks) {
  const TemporaryFolder folder;
  for (const std::size_t count : {0U, 1U, 32767U, 32768U, 32769U, 65536U}) {
    PolyData data;
    data.points.resize(count, Vec3(1.0, 2.0, 3.0));
    const auto values = random_bits<double>(count, count);
    data.point_arrays = {{"value", 1, values}};

    write_vtp(folder / "a.vtp", data);

    const VtpReader file(bytes_of(folder / "a.vtp"));
    EXPECT_TRUE(same_bits(file.values<double>("PointData", "value"), values)) << count;
    EXPECT_EQ(file.values<double>("Points", "Points").size(), 3 * count);
  }
}

TEST(WriteVtp, KeepsCellsApartByKind) {
  const TemporaryFolder folder;
  PolyData data;
  data.points.resize(4, Vec3::Zero());
  data.vertices.add({3});
  data.lines.add({0, 1});
  data.lines.add({1, 2, 3});
  data.polygons.add({0, 1, 2});
  data.polygons.add({0, 1, 2, 3});
  data.cell_arrays = {{"number", 1, std::vector<float>{0, 1, 2, 3, 4}}};

  write_vtp(folder / "a.vtp", data);

  const VtpReader file(bytes_of(folder / "a.vtp"));
  EXPECT_EQ(file.count("NumberOfVerts"), 1U);
  EXPECT_EQ(file.count("NumberOfLines"), 2U);
  EXPECT_EQ(file.count("NumberOfPolys"), 2U);
  EXPECT_THAT(file.values<std::int32_t>("Verts", "connectivity"), ElementsAre(3));
  EXPECT_THAT(file.values<std::int32_t>("Lines", "connectivity"), ElementsAre(0, 1, 1, 2, 3));
  EXPECT_THAT(file.values<std::int32_t>("Lines", "offsets"), ElementsAre(2, 5));
  EXPECT_THAT(file.values<std::int32_t>("Polys", "offsets"), ElementsAre(3, 7));
  EXPECT_THAT(file.values<float>("CellData", "number"), ElementsAre(0, 1, 2, 3, 4));
}

TEST(WriteVtp, StatesByteOrderCompressorAndTime) {
  const TemporaryFolder folder;
  PolyData data;
  data.time = 0.1;

  write_vtp(folder / "a.vtp", data);

  const VtpReader file(bytes_of(folder / "a.vtp"));
  EXPECT_NE(file.xml().find("byte_order=\"LittleEndian\" header_type=\"UInt64\""),
            std::string_view::npos);
  EXPECT_NE(file.xml().find("compressor=\"vtkZLibDataCompressor\""), std::string_view::npos);
  EXPECT_NE(file.xml().find("format=\"ascii\">0.1</DataArray>"), std::string_view::npos);
}

TEST(WriteVtp, EscapesTheNamesOfArrays) {
  const TemporaryFolder folder;
  PolyData data;
  data.point_arrays = {{"σ < \"1\" & 2", 1, std::vector<float>{}}};

  write_vtp(folder / "a.vtp", data);

  const VtpReader file(bytes_of(folder / "a.vtp"));
  EXPECT_THAT(file.names("PointData"), ElementsAre("σ &lt; &quot;1&quot; &amp; 2"));
}

TEST(WriteVtp, GivesTheSameBytesForTheSameData) {
  const TemporaryFolder folder;
  PolyData data;
  data.points.resize(1000, Vec3(0.1, 0.2, 0.3));

  write_vtp(folder / "a.vtp", data);
  write_vtp(folder / "b.vtp", data);

  EXPECT_EQ(bytes_of(folder / "a.vtp"), bytes_of(folder / "b.vtp"));
}

TEST(WriteVtp, LeavesNoFileOnAFullDisk) {
  const TemporaryFolder folder;
  std::string message;

  try {
    const test::FileSizeLimit limit(10);
    write_vtp(folder / "a.vtp", PolyData());
  } catch (const OutputError& error) {
    message = error.what();
  }

  EXPECT_THAT(message, testing::HasSubstr("a.vtp.part: cannot write: File too large"));
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(WriteVtp, RefusesArraysOfAnotherLength) {
  const TemporaryFolder folder;
  PolyData data;
  data.points = {Vec3::Zero(), Vec3::UnitX()};
  data.point_arrays.push_back({"velocity", 3, std::vector<float>(5)});

  EXPECT_THAT([&] { write_vtp(folder / "a.vtp", data); },
              ThrowsMessage<std::invalid_argument>(testing::HasSubstr(
                  "array \"velocity\": 5 numbers; expected 3 for each of 2 points or cells")));
  EXPECT_THAT(folder.names(), IsEmpty());
}

}  // namespace
}  // namespace plekton::dynamics::vtk_writer_test
