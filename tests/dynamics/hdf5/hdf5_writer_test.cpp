// SPDX-License-Identifier: GPL-3.0-or-later
// What the HDF5 library itself finds in the files.
#include "dynamics/hdf5/hdf5_writer.hpp"

#include "dynamics/hdf5/handle.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace plekton::dynamics::hdf5_writer_test {
namespace {

using hdf5::Handle;
using hdf5::LibraryUse;
using testing::ElementsAre;
using testing::IsEmpty;

/// A file in memory as the library opens it.
class OpenFile {
 public:
  explicit OpenFile(std::string bytes) : bytes_(std::move(bytes)) {}

  hid_t id() const { return file_.get(); }

  struct Set {
    std::vector<hsize_t> shape;
    bool has_type = false;
  };
  /// @param type  that is expected
  Set set(const char* path, hid_t type) const {
    const Handle found(H5Dopen2(id(), path, H5P_DEFAULT), H5Dclose);
    const Handle space(H5Dget_space(found.get()), H5Sclose);
    const Handle own(H5Dget_type(found.get()), H5Tclose);
    Set set{std::vector<hsize_t>(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space.get()))),
            H5Tequal(own.get(), type) > 0};
    H5Sget_simple_extent_dims(space.get(), set.shape.data(), nullptr);
    return set;
  }
  template <class Number>
  std::vector<Number> values(const char* path, hid_t type, std::size_t count) const {
    const Handle found(H5Dopen2(id(), path, H5P_DEFAULT), H5Dclose);
    std::vector<Number> values(count);
    H5Dread(found.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    return values;
  }
  std::vector<std::string> in_order_of_creation(const char* group) const {
    const Handle found(H5Gopen2(id(), group, H5P_DEFAULT), H5Gclose);
    std::vector<std::string> names;
    const auto add = [](hid_t, const char* name, const H5L_info_t*, void* to) -> herr_t {
      static_cast<std::vector<std::string>*>(to)->emplace_back(name);
      return 0;
    };
    H5Literate(found.get(), H5_INDEX_CRT_ORDER, H5_ITER_INC, nullptr, add, &names);
    return names;
  }
  H5O_info_t info(const char* path) const {
    H5O_info_t info{};
    H5Oget_info_by_name2(id(), path, &info, H5O_INFO_ALL, H5P_DEFAULT);
    return info;
  }

 private:
  LibraryUse use_;
  std::string bytes_;
  Handle access_{H5Pcreate(H5P_FILE_ACCESS), H5Pclose};
  Handle file_{open(), H5Fclose};

  hid_t open() {
    H5Pset_fapl_core(access_.get(), 4096, false);
    H5Pset_file_image(access_.get(), bytes_.data(), bytes_.size());
    return H5Fopen(hdf5::name_of_file().c_str(), H5F_ACC_RDONLY, access_.get());
  }
};

TEST(Hdf5Writer, WritesNumbersOfEachKindInLittleEndianRowsAndColumns) {
  Hdf5Writer writer;
  writer.numbers("/list", std::vector<double>{1.5, -2.5});
  writer.numbers("/table", std::vector<std::int64_t>{1, 2, 3, 4, 5, 6}, 3);
  writer.numbers("/empty", std::vector<double>{}, 3);
  writer.number("/single", std::int64_t{1} << 62);
  writer.array("/small", {std::vector<std::int32_t>{-7, 8}, 1});
  writer.array("/flags", {std::vector<std::uint8_t>{0, 255, 1, 3}, 2});

  const OpenFile file(writer.bytes());

  const auto list = file.set("/list", H5T_IEEE_F64LE);
  EXPECT_TRUE(list.has_type);
  EXPECT_THAT(list.shape, ElementsAre(2));
  EXPECT_THAT(file.values<double>("/list", H5T_NATIVE_DOUBLE, 2), ElementsAre(1.5, -2.5));
  const auto table = file.set("/table", H5T_STD_I64LE);
  EXPECT_TRUE(table.has_type);
  EXPECT_THAT(table.shape, ElementsAre(2, 3));
  EXPECT_THAT(file.values<std::int64_t>("/table", H5T_NATIVE_INT64, 6),
              ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(file.set("/empty", H5T_IEEE_F64LE).shape, ElementsAre(0, 3));
  EXPECT_THAT(file.set("/single", H5T_STD_I64LE).shape, IsEmpty());
  EXPECT_THAT(file.values<std::int64_t>("/single", H5T_NATIVE_INT64, 1),
              ElementsAre(std::int64_t{1} << 62));
  const auto small = file.set("/small", H5T_STD_I32LE);
  EXPECT_TRUE(small.has_type);
  EXPECT_THAT(small.shape, ElementsAre(2, 1));
  EXPECT_THAT(file.values<std::int32_t>("/small", H5T_NATIVE_INT32, 2), ElementsAre(-7, 8));
  EXPECT_TRUE(file.set("/flags", H5T_STD_U8LE).has_type);
  EXPECT_THAT(file.values<std::uint8_t>("/flags", H5T_NATIVE_UINT8, 4), ElementsAre(0, 255, 1, 3));
}

TEST(Hdf5Writer, WritesTextsOfOneLengthFilledUpWithZeros) {
  Hdf5Writer writer;
  writer.texts("/names", {"a", "m³", ""});
  writer.text("/nothing", "");

  const OpenFile file(writer.bytes());

  const Handle set(H5Dopen2(file.id(), "/names", H5P_DEFAULT), H5Dclose);
  const Handle type(H5Dget_type(set.get()), H5Tclose);
  EXPECT_EQ(H5Tget_class(type.get()), H5T_STRING);
  EXPECT_EQ(H5Tis_variable_str(type.get()), 0);
  EXPECT_EQ(H5Tget_size(type.get()), 3U);  // bytes of "m³" in UTF-8
  EXPECT_EQ(H5Tget_cset(type.get()), H5T_CSET_UTF8);
  EXPECT_EQ(H5Tget_strpad(type.get()), H5T_STR_NULLPAD);
  std::array<char, 9> bytes{};
  H5Dread(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data());
  EXPECT_EQ(std::string(bytes.data(), 9), std::string("a\0\0m\xc2\xb3\0\0\0", 9));
  const Handle nothing(H5Dopen2(file.id(), "/nothing", H5P_DEFAULT), H5Dclose);
  EXPECT_EQ(H5Dget_storage_size(nothing.get()), 1U);  // the library knows no text without bytes
}

TEST(Hdf5Writer, KeepsTheOrderInWhichNamesAreMadeAndMakesGroupsAbove) {
  Hdf5Writer writer;
  writer.number("/z/y/number", 1.0);
  writer.group("/b");
  writer.number("/z/a", 2.0);
  writer.soft_link("/z/m/link", "/b");
  writer.same_as("/b/again", "/z/a");

  const OpenFile file(writer.bytes());

  EXPECT_THAT(file.in_order_of_creation("/"), ElementsAre("z", "b"));
  EXPECT_THAT(file.in_order_of_creation("/z"), ElementsAre("y", "a", "m"));
  EXPECT_EQ(file.info("/b/again").addr, file.info("/z/a").addr);
  EXPECT_EQ(file.info("/z/m/link").addr, file.info("/b").addr);
  H5L_info_t link{};
  H5Lget_info(file.id(), "/z/m/link", &link, H5P_DEFAULT);
  EXPECT_EQ(link.type, H5L_TYPE_SOFT);
}

TEST(Hdf5Writer, WritesNoTimesAndTheSameBytesForTheSameCalls) {
  const auto bytes = [] {
    Hdf5Writer writer;
    writer.numbers("/group/numbers", std::vector<double>{1.0, 2.0});
    writer.text("/group/text", "text");
    writer.attribute("/group", "name", std::string("value"));
    return writer.bytes();
  };
  EXPECT_EQ(bytes(), bytes());

  const OpenFile file(bytes());
  for (const char* path : {"/", "/group", "/group/numbers", "/group/text"}) {
    const H5O_info_t info = file.info(path);
    EXPECT_EQ(info.atime, 0) << path;
    EXPECT_EQ(info.mtime, 0) << path;
    EXPECT_EQ(info.ctime, 0) << path;
    EXPECT_EQ(info.btime, 0) << path;
  }
}

TEST(Hdf5Writer, GoesOnAfterWhatItCannotMake) {
  Hdf5Writer writer;
  writer.number("/x", 1.0);

  EXPECT_THROW(writer.number("/x", 2.0), std::runtime_error);
  EXPECT_THROW(writer.group("/x"), std::runtime_error);
  EXPECT_THROW(writer.number("/x/y", 2.0), std::runtime_error);
  EXPECT_THROW(writer.attribute("/y", "name", 1.0), std::runtime_error);
  EXPECT_THROW(writer.same_as("/y", "/z"), std::runtime_error);
  writer.attribute("/x", "list", std::vector<std::int64_t>{3, 4});

  const OpenFile file(writer.bytes());
  EXPECT_THAT(file.values<double>("/x", H5T_NATIVE_DOUBLE, 1), ElementsAre(1.0));
  const Handle attribute(H5Aopen_by_name(file.id(), "/x", "list", H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  std::array<std::int64_t, 2> list{};
  H5Aread(attribute.get(), H5T_NATIVE_INT64, list.data());
  EXPECT_THAT(list, ElementsAre(3, 4));
  EXPECT_THAT(file.in_order_of_creation("/"), ElementsAre("x"));
}

}  // namespace
}  // namespace plekton::dynamics::hdf5_writer_test
