// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/hdf5/hdf5_writer.hpp"

#include "dynamics/hdf5/handle.hpp"

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <variant>

namespace plekton::dynamics {
namespace {

using hdf5::Handle;
using hdf5::LibraryUse;

/// Any call that fails ends the writing: what is written is in memory.
void require(bool done) {
  if (!done) throw std::runtime_error("the HDF5 library cannot make a file in memory");
}

constexpr unsigned kInOrder = H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED;

/// How numbers lie in a file and in memory.
struct NumberType {
  hid_t in_file;
  hid_t in_memory;
};
NumberType type_of(double) {
  return {H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE};
}
NumberType type_of(std::int64_t) {
  return {H5T_STD_I64LE, H5T_NATIVE_INT64};
}
NumberType type_of(std::int32_t) {
  return {H5T_STD_I32LE, H5T_NATIVE_INT32};
}
NumberType type_of(std::uint8_t) {
  return {H5T_STD_U8LE, H5T_NATIVE_UINT8};
}

/// Texts of one length (at least 1, which the library wants), filled up with zeros.
struct PaddedTexts {
  explicit PaddedTexts(std::span<const std::string> values) {
    for (const std::string& value : values) length = std::max(length, value.size());
    for (const std::string& value : values)
      bytes += value + std::string(length - value.size(), '\0');
  }
  std::size_t length = 1;
  std::string bytes;
};

/// A text of so many bytes, as a handle that is to be closed.
hid_t text_type(std::size_t length, H5T_cset_t characters) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  require(type >= 0 && H5Tset_size(type, length) >= 0 &&
          H5Tset_strpad(type, H5T_STR_NULLPAD) >= 0 && H5Tset_cset(type, characters) >= 0);
  return type;
}

/// Likewise; a single value without a shape.
hid_t space_of(std::span<const hsize_t> shape) {
  return shape.empty() ? H5Screate(H5S_SCALAR)
                       : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
}

}  // namespace

struct Hdf5Writer::File {
  /// In order too.
  void make_groups_above(const std::string& path) const {
    for (std::size_t slash = path.find('/', 1); slash != std::string::npos;
         slash = path.find('/', slash + 1)) {
      const std::string above = path.substr(0, slash);
      if (H5Lexists(id.get(), above.c_str(), H5P_DEFAULT) <= 0) make_group(above);
    }
  }

  void make_group(const std::string& path) const {
    make_groups_above(path);
    const Handle how(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
    require(H5Pset_link_creation_order(how.get(), kInOrder) >= 0);
    const Handle group(H5Gcreate2(id.get(), path.c_str(), H5P_DEFAULT, how.get(), H5P_DEFAULT),
                       H5Gclose);
    require(static_cast<bool>(group));
  }

  void write_set(const std::string& path, const NumberType& type, std::span<const hsize_t> shape,
                 const void* data) const {
    make_groups_above(path);
    const Handle how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    require(H5Pset_obj_track_times(how.get(), false) >= 0);
    const Handle space(space_of(shape), H5Sclose);
    const Handle set(H5Dcreate2(id.get(), path.c_str(), type.in_file, space.get(), H5P_DEFAULT,
                                how.get(), H5P_DEFAULT),
                     H5Dclose);
    require(static_cast<bool>(set));
    const bool is_empty = std::find(shape.begin(), shape.end(), hsize_t{0}) != shape.end();
    require(is_empty ||
            H5Dwrite(set.get(), type.in_memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0);
  }

  template <class Number>
  void write_numbers(const std::string& path, std::span<const Number> values,
                     std::size_t columns) const {
    std::vector<hsize_t> shape{columns > 0 ? values.size() / columns : values.size()};
    if (columns > 0) shape.push_back(columns);
    write_set(path, type_of(Number{}), shape, values.data());
  }

  void write_attribute(const std::string& path, const std::string& name, const NumberType& type,
                       std::span<const hsize_t> shape, const void* data) const {
    const Handle space(space_of(shape), H5Sclose);
    const Handle attribute(H5Acreate_by_name(id.get(), path.c_str(), name.c_str(), type.in_file,
                                             space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose);
    require(attribute && H5Awrite(attribute.get(), type.in_memory, data) >= 0);
  }

  Handle access{H5Pcreate(H5P_FILE_ACCESS), H5Pclose};
  Handle creation{H5Pcreate(H5P_FILE_CREATE), H5Pclose};
  Handle id{make(access.get(), creation.get()), H5Fclose};

  static hid_t make(hid_t access, hid_t creation) {
    constexpr std::size_t kGrowth = std::size_t{4} << 20U;  // bytes
    require(H5Pset_fapl_core(access, kGrowth, false) >= 0 &&
            H5Pset_link_creation_order(creation, kInOrder) >= 0 &&
            H5Pset_obj_track_times(creation, false) >= 0);
    const hid_t made = H5Fcreate(hdf5::name_of_file().c_str(), H5F_ACC_TRUNC, creation, access);
    require(made >= 0);
    return made;
  }
};

Hdf5Writer::Hdf5Writer() {
  const LibraryUse use;
  file_ = std::make_unique<File>();
}
Hdf5Writer::~Hdf5Writer() = default;

void Hdf5Writer::group(const std::string& path) {
  const LibraryUse use;
  file_->make_group(path);
}

void Hdf5Writer::numbers(const std::string& path, std::span<const double> values,
                         std::size_t columns) {
  const LibraryUse use;
  file_->write_numbers(path, values, columns);
}

void Hdf5Writer::numbers(const std::string& path, std::span<const std::int64_t> values,
                         std::size_t columns) {
  const LibraryUse use;
  file_->write_numbers(path, values, columns);
}

void Hdf5Writer::array(const std::string& path, const geometry::StateArray& array) {
  const LibraryUse use;
  std::visit(
      [&](const auto& numbers) { file_->write_numbers(path, std::span(numbers), array.columns); },
      array.numbers);
}

void Hdf5Writer::number(const std::string& path, double value) {
  const LibraryUse use;
  file_->write_set(path, type_of(value), {}, &value);
}

void Hdf5Writer::number(const std::string& path, std::int64_t value) {
  const LibraryUse use;
  file_->write_set(path, type_of(value), {}, &value);
}

void Hdf5Writer::texts(const std::string& path, const std::vector<std::string>& values) {
  const LibraryUse use;
  const PaddedTexts padded(values);
  const Handle type(text_type(padded.length, H5T_CSET_UTF8), H5Tclose);
  const std::array<hsize_t, 1> shape{values.size()};
  file_->write_set(path, {type.get(), type.get()}, shape, padded.bytes.data());
}

void Hdf5Writer::text(const std::string& path, const std::string& value) {
  const LibraryUse use;
  const PaddedTexts padded(std::span(&value, 1));
  const Handle type(text_type(padded.length, H5T_CSET_UTF8), H5Tclose);
  file_->write_set(path, {type.get(), type.get()}, {}, padded.bytes.data());
}

void Hdf5Writer::attribute(const std::string& path, const std::string& name,
                           const std::string& value) {
  const LibraryUse use;
  const PaddedTexts padded(std::span(&value, 1));
  const Handle type(text_type(padded.length, H5T_CSET_ASCII), H5Tclose);
  file_->write_attribute(path, name, {type.get(), type.get()}, {}, padded.bytes.data());
}

void Hdf5Writer::attribute(const std::string& path, const std::string& name, double value) {
  const LibraryUse use;
  file_->write_attribute(path, name, type_of(value), {}, &value);
}

void Hdf5Writer::attribute(const std::string& path, const std::string& name,
                           std::span<const std::int64_t> values) {
  const LibraryUse use;
  const std::array<hsize_t, 1> shape{values.size()};
  file_->write_attribute(path, name, type_of(std::int64_t{}), shape, values.data());
}

void Hdf5Writer::attribute(const std::string& path, const std::string& name, std::int64_t value) {
  const LibraryUse use;
  file_->write_attribute(path, name, type_of(value), {}, &value);
}

void Hdf5Writer::soft_link(const std::string& path, const std::string& target) {
  const LibraryUse use;
  file_->make_groups_above(path);
  require(H5Lcreate_soft(target.c_str(), file_->id.get(), path.c_str(), H5P_DEFAULT, H5P_DEFAULT) >=
          0);
}

void Hdf5Writer::same_as(const std::string& path, const std::string& target) {
  const LibraryUse use;
  file_->make_groups_above(path);
  require(H5Lcreate_hard(file_->id.get(), target.c_str(), file_->id.get(), path.c_str(),
                         H5P_DEFAULT, H5P_DEFAULT) >= 0);
}

std::string Hdf5Writer::bytes() const {
  const LibraryUse use;
  const hid_t file = file_->id.get();
  require(H5Fflush(file, H5F_SCOPE_GLOBAL) >= 0);
  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  require(size > 0);
  std::string image(static_cast<std::size_t>(size), '\0');
  require(H5Fget_file_image(file, image.data(), image.size()) == size);
  return image;
}

}  // namespace plekton::dynamics
