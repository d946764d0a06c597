// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/hdf5/hdf5_reader.hpp"

#include "dynamics/hdf5/handle.hpp"
#include "geometry/base/printable.hpp"

#include <hdf5.h>

#include <algorithm>
#include <utility>

namespace plekton::dynamics {
namespace {

using hdf5::Handle;
using hdf5::LibraryUse;

/// Deflate makes a file at most about 1030 times smaller (RFC 1951: 258 bytes by two bits).
constexpr hsize_t kMostUnpacked = 1100;
constexpr std::size_t kLongestText = 4096;  // bytes, of one text

hid_t type_in_memory(double) {
  return H5T_NATIVE_DOUBLE;
}
hid_t type_in_memory(std::int64_t) {
  return H5T_NATIVE_INT64;
}
hid_t type_in_memory(std::int32_t) {
  return H5T_NATIVE_INT32;
}
hid_t type_in_memory(std::uint8_t) {
  return H5T_NATIVE_UINT8;
}

bool is_number(hid_t type) {
  const H5T_class_t kind = H5Tget_class(type);
  return kind == H5T_INTEGER || kind == H5T_FLOAT;
}

/// Whether the numbers of a set lie in this file, and not in others or put together from sets.
bool lies_in_file(hid_t set) {
  const Handle how(H5Dget_create_plist(set), H5Pclose);
  return how && H5Pget_layout(how.get()) != H5D_VIRTUAL && H5Pget_external_count(how.get()) == 0;
}

std::string words_of(const std::vector<hsize_t>& shape) {
  std::string text;
  for (const hsize_t size : shape) text += (text.empty() ? "" : " x ") + std::to_string(size);
  return text.empty() ? "a single value" : text;
}

}  // namespace

struct Hdf5Reader::File {
  File(std::string content, const std::filesystem::path& path)
      : name(geometry::printable(path.string())), bytes(std::move(content)) {}

  static hid_t open(hid_t access, std::string& bytes) {
    constexpr std::size_t kGrowth = 4096;  // bytes; nothing is written
    if (bytes.empty() || H5Pset_fapl_core(access, kGrowth, false) < 0 ||
        H5Pset_file_image(access, bytes.data(), bytes.size()) < 0)
      return -1;
    return H5Fopen(hdf5::name_of_file().c_str(), H5F_ACC_RDONLY, access);
  }

  std::string name;
  std::string bytes;
  Handle access{H5Pcreate(H5P_FILE_ACCESS), H5Pclose};
  Handle id{open(access.get(), bytes), H5Fclose};
};

namespace {

/// A data set that is open, with its shape.
class OpenSet {
 public:
  OpenSet(const Hdf5Reader& reader, hid_t file, const std::string& path)
      : set_(reader.has(path) ? H5Dopen2(file, path.c_str(), H5P_DEFAULT) : -1, H5Dclose),
        type_(set_ ? H5Dget_type(set_.get()) : -1, H5Tclose),
        space_(set_ ? H5Dget_space(set_.get()) : -1, H5Sclose) {
    if (!set_) reader.fail(path, "there is no such data set");
    constexpr int kMostDimensions = 2;
    const int dimensions = H5Sget_simple_extent_ndims(space_.get());
    if (!type_ || dimensions < 0 || dimensions > kMostDimensions || !lies_in_file(set_.get()))
      reader.fail(path, "expected a data set of at most two dimensions, within the file");
    shape_.resize(static_cast<std::size_t>(dimensions));
    if (H5Sget_simple_extent_type(space_.get()) == H5S_NULL ||
        (dimensions > 0 && H5Sget_simple_extent_dims(space_.get(), shape_.data(), nullptr) < 0))
      reader.fail(path, "expected a data set with a shape");
  }

  hid_t set() const noexcept { return set_.get(); }
  hid_t type() const noexcept { return type_.get(); }
  hid_t space() const noexcept { return space_.get(); }
  const std::vector<hsize_t>& shape() const noexcept { return shape_; }
  std::size_t columns() const noexcept {
    return shape_.size() < 2 ? 1 : static_cast<std::size_t>(shape_[1]);
  }

  /// How many values; nothing where that is more than what the file has of it can hold.
  std::optional<std::size_t> count() const {
    const Handle how(H5Dget_create_plist(set_.get()), H5Pclose);
    const hsize_t unpacked = H5Pget_nfilters(how.get()) > 0 ? kMostUnpacked : 1;
    const hsize_t most = H5Dget_storage_size(set_.get()) * unpacked / H5Tget_size(type_.get());
    hsize_t values = 1;
    for (const hsize_t size : shape_) {
      if (size != 0 && values > most / size) return std::nullopt;
      values *= size;
    }
    return static_cast<std::size_t>(values);
  }

 private:
  Handle set_, type_, space_;
  std::vector<hsize_t> shape_;
};

template <class Number>
Hdf5Array<Number> read_numbers(const Hdf5Reader& reader, const OpenSet& set,
                               const std::string& path) {
  const auto count = set.count();
  if (!count || set.columns() == 0)
    reader.fail(path, "says that it is " + words_of(set.shape()) +
                          ", more than the file holds of it; it is damaged");
  Hdf5Array<Number> array{std::vector<Number>(*count), set.columns()};
  if (*count > 0 && H5Dread(set.set(), type_in_memory(Number{}), H5S_ALL, H5S_ALL, H5P_DEFAULT,
                            array.values.data()) < 0)
    reader.fail(path, "cannot be read; the file is damaged");
  return array;
}

/// Up to the first zero.
std::string text_up_to_zero(const char* text, std::size_t length) {
  return {text, std::find(text, text + length, '\0')};
}

/// Texts of a data set or an attribute.
/// @param count  how many
/// @param read   (type in memory, to), whether it could be read
template <class Read>
std::optional<std::vector<std::string>> read_texts(hid_t type, hid_t space, std::size_t count,
                                                   const Read& read) {
  if (H5Tget_class(type) != H5T_STRING) return std::nullopt;
  const Handle in_memory(H5Tcopy(type), H5Tclose);
  std::vector<std::string> texts;
  if (H5Tis_variable_str(type) > 0) {
    std::vector<char*> pointers(count, nullptr);
    if (!read(in_memory.get(), pointers.data())) return std::nullopt;
    for (const char* text : pointers) texts.emplace_back(text == nullptr ? "" : text);
    H5Dvlen_reclaim(in_memory.get(), space, H5P_DEFAULT, pointers.data());
    return texts;
  }
  const std::size_t length = H5Tget_size(type);
  if (length == 0 || length > kLongestText) return std::nullopt;
  std::vector<char> bytes(count * length);
  if (!read(in_memory.get(), bytes.data())) return std::nullopt;
  for (std::size_t i = 0; i < count; ++i)
    texts.push_back(text_up_to_zero(bytes.data() + i * length, length));
  return texts;
}

}  // namespace

Hdf5Reader::Hdf5Reader(std::string bytes, const std::filesystem::path& name) {
  const LibraryUse use;
  file_ = std::make_unique<File>(std::move(bytes), name);
  if (!file_->id)
    throw Hdf5Error(file_->name +
                    ": is no whole HDF5 file; expected one that was written to its end (.vtkhdf)");
}
Hdf5Reader::~Hdf5Reader() = default;

void Hdf5Reader::fail(const std::string& path, const std::string& what) const {
  throw Hdf5Error(file_->name + ": " + geometry::printable(path) + ": " + what);
}

// Names that lie in this file, each within the one before: a soft or an external link would lead
// elsewhere, to another file even.
bool Hdf5Reader::has(const std::string& path) const {
  const LibraryUse use;
  const hid_t file = file_->id.get();
  for (std::size_t slash = path.find('/', 1);; slash = path.find('/', slash + 1)) {
    const std::string above = path.substr(0, slash);
    H5L_info_t link;
    if (H5Lexists(file, above.c_str(), H5P_DEFAULT) <= 0 ||
        H5Lget_info(file, above.c_str(), &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD)
      return false;
    if (slash == std::string::npos) return true;
  }
}

bool Hdf5Reader::is_group(const std::string& path) const {
  const LibraryUse use;
  H5O_info_t info;
  return has(path) &&
         H5Oget_info_by_name2(file_->id.get(), path.c_str(), &info, H5O_INFO_BASIC, H5P_DEFAULT) >=
             0 &&
         info.type == H5O_TYPE_GROUP;
}

std::vector<std::string> Hdf5Reader::names_in(const std::string& group) const {
  const LibraryUse use;
  const Handle opened(has(group) ? H5Gopen2(file_->id.get(), group.c_str(), H5P_DEFAULT) : -1,
                      H5Gclose);
  if (!opened) fail(group, "there is no such group");
  std::vector<std::string> names;
  const auto add_name = [](hid_t, const char* name, const H5L_info_t*, void* to) -> herr_t {
    static_cast<std::vector<std::string>*>(to)->emplace_back(name);
    return 0;
  };
  if (H5Literate(opened.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, add_name, &names) < 0)
    fail(group, "cannot be listed; the file is damaged");
  return names;
}

Hdf5Array<double> Hdf5Reader::numbers(const std::string& path) const {
  const LibraryUse use;
  const OpenSet set(*this, file_->id.get(), path);
  if (!is_number(set.type())) fail(path, "expected numbers");
  return read_numbers<double>(*this, set, path);
}

Hdf5Array<std::int64_t> Hdf5Reader::whole_numbers(const std::string& path) const {
  const LibraryUse use;
  const OpenSet set(*this, file_->id.get(), path);
  if (H5Tget_class(set.type()) != H5T_INTEGER) fail(path, "expected whole numbers");
  return read_numbers<std::int64_t>(*this, set, path);
}

geometry::StateArray Hdf5Reader::array(const std::string& path) const {
  const LibraryUse use;
  const OpenSet set(*this, file_->id.get(), path);
  const auto as = [&](auto number) -> geometry::StateArray {
    auto array = read_numbers<decltype(number)>(*this, set, path);
    return {std::move(array.values), array.columns};
  };
  if (H5Tequal(set.type(), H5T_IEEE_F64LE) > 0) return as(double{});
  if (H5Tequal(set.type(), H5T_STD_I64LE) > 0) return as(std::int64_t{});
  if (H5Tequal(set.type(), H5T_STD_I32LE) > 0) return as(std::int32_t{});
  if (H5Tequal(set.type(), H5T_STD_U8LE) > 0) return as(std::uint8_t{});
  fail(path, "expected 64-bit floating point numbers or integers of 64, 32 or 8 bits");
}

std::vector<std::string> Hdf5Reader::texts(const std::string& path) const {
  const LibraryUse use;
  const OpenSet set(*this, file_->id.get(), path);
  const auto count = set.count();
  if (!count)
    fail(path, "says that it is " + words_of(set.shape()) +
                   " texts, more than the file holds; it is damaged");
  auto texts = read_texts(set.type(), set.space(), *count, [&](hid_t type, void* to) {
    return H5Dread(set.set(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, to) >= 0;
  });
  if (!texts) fail(path, "expected texts");
  return std::move(*texts);
}

namespace {

/// An attribute with a single value.
struct OpenAttribute {
  OpenAttribute(hid_t file, const std::string& path, const std::string& name)
      : attribute(H5Aexists_by_name(file, path.c_str(), name.c_str(), H5P_DEFAULT) > 0
                      ? H5Aopen_by_name(file, path.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT)
                      : -1,
                  H5Aclose),
        type(attribute ? H5Aget_type(attribute.get()) : -1, H5Tclose),
        space(attribute ? H5Aget_space(attribute.get()) : -1, H5Sclose) {}
  bool is_single() const { return space && H5Sget_simple_extent_npoints(space.get()) == 1; }
  Handle attribute, type, space;
};

}  // namespace

std::optional<double> Hdf5Reader::number_attribute(const std::string& path,
                                                   const std::string& name) const {
  const LibraryUse use;
  if (!has(path)) return std::nullopt;
  const OpenAttribute found(file_->id.get(), path, name);
  if (!found.attribute) return std::nullopt;
  double value = 0.0;
  if (!found.is_single() || !is_number(found.type.get()) ||
      H5Aread(found.attribute.get(), H5T_NATIVE_DOUBLE, &value) < 0)
    fail(path, "attribute " + name + ": expected a number");
  return value;
}

std::optional<std::string> Hdf5Reader::text_attribute(const std::string& path,
                                                      const std::string& name) const {
  const LibraryUse use;
  if (!has(path)) return std::nullopt;
  const OpenAttribute found(file_->id.get(), path, name);
  if (!found.attribute) return std::nullopt;
  std::optional<std::vector<std::string>> texts;
  if (found.is_single())
    texts = read_texts(found.type.get(), found.space.get(), 1, [&](hid_t type, void* to) {
      return H5Aread(found.attribute.get(), type, to) >= 0;
    });
  if (!texts) fail(path, "attribute " + name + ": expected a text");
  return texts->front();
}

}  // namespace plekton::dynamics
