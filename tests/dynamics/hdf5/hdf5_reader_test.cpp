// SPDX-License-Identifier: GPL-3.0-or-later
// Files of this library, and of the HDF5 library as other programs use it.
#include "dynamics/hdf5/hdf5_reader.hpp"

#include "dynamics/hdf5/handle.hpp"
#include "dynamics/hdf5/hdf5_writer.hpp"
#include "tests/support/seeded_random.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace plekton::dynamics::hdf5_reader_test {
namespace {

using hdf5::Handle;
using hdf5::LibraryUse;
using test::Random;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::StrEq;
using testing::ThrowsMessage;

/// A file of another program. @param fill  (file), makes what is in it
std::string bytes_with(const std::function<void(hid_t)>& fill) {
  const LibraryUse use;
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access.get(), 65536, false);
  const Handle file(
      H5Fcreate(hdf5::name_of_file().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), H5Fclose);
  fill(file.get());
  H5Fflush(file.get(), H5F_SCOPE_GLOBAL);
  std::string bytes(static_cast<std::size_t>(H5Fget_file_image(file.get(), nullptr, 0)), '\0');
  H5Fget_file_image(file.get(), bytes.data(), bytes.size());
  return bytes;
}

/// A data set without its numbers written.
void make_set(hid_t file, const char* name, hid_t type, hid_t space) {
  const Handle of_space(space, H5Sclose);
  const Handle set(
      H5Dcreate2(file, name, type, of_space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Dclose);
}

hid_t shape(const std::vector<hsize_t>& sizes) {
  return H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr);
}

auto fails_with(const std::string& message) {
  return ThrowsMessage<Hdf5Error>(StrEq("a.h5: " + message));
}

TEST(Hdf5Reader, GivesBackEveryBitOfAnArrayInItsKindOfNumber) {
  Random random(111);
  std::vector<double> numbers;
  for (int i = 0; i < 60; ++i) numbers.push_back(random.signed_power(-300.0, 300.0));
  numbers[0] = -0.0;
  numbers[1] = std::numeric_limits<double>::denorm_min();
  numbers[2] = -std::numeric_limits<double>::infinity();
  using Limits = std::numeric_limits<std::int64_t>;
  const std::vector<geometry::StateArray> arrays = {
      {numbers, 3},
      {std::vector<std::int64_t>{Limits::min(), Limits::max(), 0}, 1},
      {std::vector<std::int32_t>{-5, 7}, 2},
      {std::vector<std::uint8_t>{255, 0, 1, 2}, 2},
      {std::vector<double>{}, 4}};
  Hdf5Writer writer;
  for (std::size_t i = 0; i < arrays.size(); ++i)
    writer.array("/a/" + std::to_string(i), arrays[i]);

  const Hdf5Reader reader(writer.bytes(), "a.h5");

  for (std::size_t i = 0; i < arrays.size(); ++i) {
    const geometry::StateArray read = reader.array("/a/" + std::to_string(i));
    EXPECT_EQ(read.columns, arrays[i].columns);
    EXPECT_EQ(read.numbers.index(), arrays[i].numbers.index());
    std::visit(
        [&]<class Numbers>(const Numbers& expected) {
          const auto& found = std::get<Numbers>(read.numbers);
          const auto bytes = std::as_bytes(std::span(expected));
          const auto read_bytes = std::as_bytes(std::span(found));
          EXPECT_TRUE(std::equal(bytes.begin(), bytes.end(), read_bytes.begin(), read_bytes.end()))
              << i;
        },
        arrays[i].numbers);
  }
}

TEST(Hdf5Reader, TakesNumbersOfAnyKindAsDoublesAndWholeOnesAlsoAsThese) {
  const std::string bytes = bytes_with([](hid_t file) {
    const float number = 0.5F;
    const std::int16_t whole = -3;
    make_set(file, "float", H5T_IEEE_F32BE, H5Screate(H5S_SCALAR));
    make_set(file, "short", H5T_STD_I16BE, H5Screate(H5S_SCALAR));
    const Handle floats(H5Dopen2(file, "float", H5P_DEFAULT), H5Dclose);
    H5Dwrite(floats.get(), H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, &number);
    const Handle shorts(H5Dopen2(file, "short", H5P_DEFAULT), H5Dclose);
    H5Dwrite(shorts.get(), H5T_NATIVE_INT16, H5S_ALL, H5S_ALL, H5P_DEFAULT, &whole);
  });
  const Hdf5Reader reader(bytes, "a.h5");

  EXPECT_THAT(reader.numbers("/float").values, ElementsAre(0.5));
  EXPECT_THAT(reader.numbers("/short").values, ElementsAre(-3.0));
  EXPECT_THAT(reader.whole_numbers("/short").values, ElementsAre(-3));
  EXPECT_EQ(reader.whole_numbers("/short").columns, 1U);
  EXPECT_THAT([&] { reader.whole_numbers("/float"); },
              fails_with("/float: expected whole numbers"));
  for (const std::string path : {"/float", "/short"})
    EXPECT_THAT([&] { reader.array(path); },
                fails_with(path + ": expected 64-bit floating point numbers or integers of 64, 32 "
                                  "or 8 bits"));
}

TEST(Hdf5Reader, RefusesShapesThatAreNoRowsAndColumns) {
  const std::string bytes = bytes_with([](hid_t file) {
    make_set(file, "cube", H5T_IEEE_F64LE, shape({1, 1, 1}));
    make_set(file, "null", H5T_IEEE_F64LE, H5Screate(H5S_NULL));
    make_set(file, "no_columns", H5T_IEEE_F64LE, shape({2, 0}));
    make_set(file, "unwritten", H5T_IEEE_F64LE, shape({4, 3}));
  });
  const Hdf5Reader reader(bytes, "a.h5");

  EXPECT_THAT([&] { reader.numbers("/cube"); },
              fails_with("/cube: expected a data set of at most two dimensions, within the file"));
  EXPECT_THAT([&] { reader.numbers("/null"); },
              fails_with("/null: expected a data set with a shape"));
  EXPECT_THAT([&] { reader.numbers("/no_columns"); },
              fails_with("/no_columns: says that it is 2 x 0, more than the file holds of it; it "
                         "is damaged"));
  EXPECT_THAT([&] { reader.numbers("/unwritten"); },
              fails_with("/unwritten: says that it is 4 x 3, more than the file holds of it; it is "
                         "damaged"));
}

TEST(Hdf5Reader, KnowsWhatIsInTheFileByPathsWithoutLinksThatLeadElsewhere) {
  Hdf5Writer writer;
  writer.number("/b/z", 1.0);
  writer.number("/b/a", 2.0);
  writer.same_as("/b/m", "/b/a");
  writer.soft_link("/soft", "/b");
  const Hdf5Reader reader(writer.bytes(), "a.h5");

  EXPECT_TRUE(reader.is_group("/b"));
  EXPECT_TRUE(reader.has("/b/z"));
  EXPECT_FALSE(reader.is_group("/b/z"));
  EXPECT_THAT(reader.names_in("/b"), ElementsAre("a", "m", "z"));
  EXPECT_THAT(reader.numbers("/b/m").values, ElementsAre(2.0));
  for (const char* path : {"/soft", "/soft/z", "/b/z/deeper", "/c", "/c/d"})
    EXPECT_FALSE(reader.has(path)) << path;
  EXPECT_THAT([&] { reader.names_in("/b/z"); }, fails_with("/b/z: there is no such group"));
  EXPECT_THAT([&] { reader.numbers("/soft/z"); }, fails_with("/soft/z: there is no such data set"));
  EXPECT_THAT([&] { reader.numbers("/b"); }, fails_with("/b: there is no such data set"));
}

TEST(Hdf5Reader, ReadsTextsUpToTheirFirstZero) {
  Hdf5Writer writer;
  writer.texts("/texts", {"long", "m³", std::string("cut\0off", 7), ""});
  writer.texts("/none", {});
  writer.number("/number", 1.0);
  const Hdf5Reader reader(writer.bytes(), "a.h5");

  EXPECT_THAT(reader.texts("/texts"), ElementsAre("long", "m³", "cut", ""));
  EXPECT_THAT(reader.texts("/none"), IsEmpty());
  EXPECT_THAT([&] { reader.texts("/number"); }, fails_with("/number: expected texts"));
  EXPECT_THAT([&] { reader.numbers("/texts"); }, fails_with("/texts: expected numbers"));
}

TEST(Hdf5Reader, TellsAnAttributeThatIsNotThereFromOneOfAnotherKind) {
  Hdf5Writer writer;
  writer.group("/g");
  writer.attribute("/g", "text", std::string("words"));
  writer.attribute("/g", "number", 2.5);
  writer.attribute("/g", "whole", std::int64_t{7});
  writer.attribute("/g", "list", std::vector<std::int64_t>{1, 2});
  const Hdf5Reader reader(writer.bytes(), "a.h5");

  EXPECT_EQ(reader.text_attribute("/g", "text"), "words");
  EXPECT_EQ(reader.number_attribute("/g", "number"), 2.5);
  EXPECT_EQ(reader.number_attribute("/g", "whole"), 7.0);
  for (const auto& [path, name] :
       {std::pair{"/g", "other"}, std::pair{"/h", "text"}, std::pair{"/h/i", "number"}}) {
    EXPECT_EQ(reader.text_attribute(path, name), std::nullopt);
    EXPECT_EQ(reader.number_attribute(path, name), std::nullopt);
  }
  EXPECT_THAT([&] { reader.number_attribute("/g", "text"); },
              fails_with("/g: attribute text: expected a number"));
  EXPECT_THAT([&] { reader.number_attribute("/g", "list"); },
              fails_with("/g: attribute list: expected a number"));
  EXPECT_THAT([&] { reader.text_attribute("/g", "number"); },
              fails_with("/g: attribute number: expected a text"));
}

}  // namespace
}  // namespace plekton::dynamics::hdf5_reader_test
