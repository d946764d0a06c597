// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/checkpoint/checkpoint_file.hpp"

#include "dynamics/hdf5/handle.hpp"
#include "dynamics/output/file.hpp"
#include "dynamics/output/sync.hpp"
#include "geometry/base/bit_hash.hpp"
#include "geometry/base/new_file.hpp"
#include "geometry/base/printable.hpp"
#include "geometry/base/regular_file.hpp"
#include "geometry/version.hpp"

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

namespace plekton::dynamics {
namespace {

using geometry::StateArray;
using geometry::StateTree;
using hdf5::Handle;
using hdf5::LibraryUse;

constexpr const char* kFormat = "plekton checkpoint";
constexpr std::size_t kHeadSize = 512;         // bytes
constexpr std::size_t kLongestRevision = 256;  // bytes, so that it leaves room for the rest

/// How numbers lie in a file and in memory.
struct NumberType {
  hid_t in_file;
  hid_t in_memory;
};
NumberType type_of(const std::vector<double>&) {
  return {H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE};
}
NumberType type_of(const std::vector<std::int64_t>&) {
  return {H5T_STD_I64LE, H5T_NATIVE_INT64};
}
NumberType type_of(const std::vector<std::int32_t>&) {
  return {H5T_STD_I32LE, H5T_NATIVE_INT32};
}
NumberType type_of(const std::vector<std::uint8_t>&) {
  return {H5T_STD_U8LE, H5T_NATIVE_UINT8};
}

/// Any call that fails ends the writing: what is written is in memory.
void require(bool done) {
  if (!done) throw std::runtime_error("the HDF5 library cannot make a file in memory");
}

// Writing.

void write_array(hid_t file, const std::string& name, const StateArray& array) {
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  require(H5Pset_create_intermediate_group(links.get(), 1) >= 0);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  require(H5Pset_obj_track_times(creation.get(), false) >= 0);
  const std::array<hsize_t, 2> size = {array.rows(), array.columns};
  const Handle space(H5Screate_simple(2, size.data(), nullptr), H5Sclose);
  std::visit(
      [&](const auto& numbers) {
        const NumberType type = type_of(numbers);
        const Handle set(H5Dcreate2(file, name.c_str(), type.in_file, space.get(), links.get(),
                                    creation.get(), H5P_DEFAULT),
                         H5Dclose);
        require(static_cast<bool>(set));
        require(numbers.empty() || H5Dwrite(set.get(), type.in_memory, H5S_ALL, H5S_ALL,
                                            H5P_DEFAULT, numbers.data()) >= 0);
      },
      array.numbers);
}

/// The bytes of an HDF5 file with a state.
std::string image_of(const StateTree& state) {
  constexpr std::size_t kGrowth = std::size_t{4} << 20U;  // bytes
  const LibraryUse use;
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  require(H5Pset_fapl_core(access.get(), kGrowth, false) >= 0);
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  require(H5Pset_userblock(creation.get(), kHeadSize) >= 0);
  const Handle file(H5Fcreate("checkpoint", H5F_ACC_TRUNC, creation.get(), access.get()), H5Fclose);
  require(static_cast<bool>(file));
  for (const auto& [name, array] : state.arrays) write_array(file.get(), name, array);
  require(H5Fflush(file.get(), H5F_SCOPE_GLOBAL) >= 0);
  const ssize_t size = H5Fget_file_image(file.get(), nullptr, 0);
  require(size > 0);
  std::string image(static_cast<std::size_t>(size), '\0');
  require(H5Fget_file_image(file.get(), image.data(), image.size()) == size);
  return image;
}

// The head of a file, before all that HDF5 reads: lines of text, then zeros.

std::string checksum_of(std::string_view image) {
  geometry::BitHash hash;
  for (std::size_t i = 0; i < image.size(); i += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, image.data() + i, std::min(sizeof word, image.size() - i));
    hash.add(word);
  }
  std::ostringstream text;
  text << std::hex << hash.value();
  return text.str();
}

std::string head_of(std::string_view image, std::string_view revision) {
  std::ostringstream text;
  text << kFormat << '\n'
       << "version " << kCheckpointVersion << '\n'
       << "writer " << kVersion << '\n'
       << "bytes " << image.size() << '\n'
       << "checksum " << checksum_of(image) << '\n'
       << "revision " << revision.substr(0, kLongestRevision) << '\n';
  std::string head = text.str();
  head.resize(kHeadSize, '\0');
  return head;
}

/// What a head says; nothing where it is none.
struct Head {
  std::string version, writer, bytes, checksum, revision;
};
std::optional<Head> parsed_head(std::string_view bytes) {
  if (bytes.size() < kHeadSize) return std::nullopt;
  std::istringstream lines{std::string(bytes.substr(0, kHeadSize))};
  std::string line;
  if (!std::getline(lines, line) || line != kFormat) return std::nullopt;
  Head head;
  const auto read = [&](std::string_view key, std::string& to) {
    if (!std::getline(lines, line) || !line.starts_with(key)) return false;
    to = line.substr(key.size());
    return true;
  };
  if (!read("version ", head.version) || !read("writer ", head.writer)) return std::nullopt;
  read("bytes ", head.bytes);
  read("checksum ", head.checksum);
  read("revision ", head.revision);
  return head;
}

// Reading.

/// @throws CheckpointError
Head known_head(std::string_view bytes, const std::filesystem::path& path) {
  const std::optional<Head> head = parsed_head(bytes);
  if (!head)
    throw CheckpointError(path,
                          "is no checkpoint of Plekton; expected a file that plekton run wrote");
  if (head->version != std::to_string(kCheckpointVersion))
    throw CheckpointError(path, "is of version " + head->version + ", written by Plekton " +
                                    head->writer + "; this is Plekton " + std::string(kVersion) +
                                    ", which reads version " + std::to_string(kCheckpointVersion) +
                                    ": go on with the one that wrote it");
  return *head;
}

/// A reader of one file that knows what to say of it.
class Reader {
 public:
  Reader(std::string bytes, std::filesystem::path path)
      : path_(std::move(path)), bytes_(std::move(bytes)) {}

  StateTree read() {
    check_head();
    const LibraryUse use;
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    if (H5Pset_fapl_core(access.get(), kHeadSize, false) < 0 ||
        H5Pset_file_image(access.get(), bytes_.data(), bytes_.size()) < 0)
      throw damaged();
    const Handle file(H5Fopen("checkpoint", H5F_ACC_RDONLY, access.get()), H5Fclose);
    if (!file) throw damaged();
    std::vector<std::string> names;
    // A soft or an external link would lead elsewhere, to another file even.
    const auto add_name = [](hid_t at, const char* name, const H5L_info_t* link,
                             void* to) -> herr_t {
      H5O_info_t info;
      if (link->type != H5L_TYPE_HARD ||
          H5Oget_info_by_name2(at, name, &info, H5O_INFO_BASIC, H5P_DEFAULT) < 0)
        return -1;
      if (info.type == H5O_TYPE_DATASET)
        static_cast<std::vector<std::string>*>(to)->emplace_back(name);
      return 0;
    };
    if (H5Lvisit(file.get(), H5_INDEX_NAME, H5_ITER_INC, add_name, &names) < 0) throw damaged();
    StateTree state;
    for (const std::string& name : names) state.arrays[name] = read_array(file.get(), name);
    return state;
  }

 private:
  /// Nothing that is damaged gets to the library, whose readers are not made for it.
  void check_head() const {
    const Head head = known_head(bytes_, path_);
    const std::string_view image = std::string_view(bytes_).substr(kHeadSize);
    if (head.bytes != std::to_string(image.size()) || head.checksum != checksum_of(image))
      throw damaged();
  }

  StateArray read_array(hid_t file, const std::string& name) const {
    const Handle set(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
    if (!set) throw damaged();
    const Handle type(H5Dget_type(set.get()), H5Tclose);
    const Handle space(H5Dget_space(set.get()), H5Sclose);
    if (!is_in_one_piece(set.get())) throw damaged();
    std::array<hsize_t, 2> size{};
    if (H5Sget_simple_extent_ndims(space.get()) != 2 ||
        H5Sget_simple_extent_dims(space.get(), size.data(), nullptr) != 2 || size[1] == 0)
      throw damaged();
    if (H5Tequal(type.get(), H5T_IEEE_F64LE) > 0) return read_numbers<double>(set.get(), size);
    if (H5Tequal(type.get(), H5T_STD_I64LE) > 0) return read_numbers<std::int64_t>(set.get(), size);
    if (H5Tequal(type.get(), H5T_STD_I32LE) > 0) return read_numbers<std::int32_t>(set.get(), size);
    if (H5Tequal(type.get(), H5T_STD_U8LE) > 0) return read_numbers<std::uint8_t>(set.get(), size);
    throw damaged();
  }

  /// Whether the numbers of a set lie in this file one after the other: not packed, in other files,
  /// or put together from other sets.
  static bool is_in_one_piece(hid_t set) {
    const Handle how(H5Dget_create_plist(set), H5Pclose);
    return how && H5Pget_layout(how.get()) == H5D_CONTIGUOUS &&
           H5Pget_external_count(how.get()) == 0 && H5Pget_nfilters(how.get()) == 0;
  }

  /// Only what lies in the file as it is: a size that is said and not there takes no memory.
  template <class Number>
  StateArray read_numbers(hid_t set, const std::array<hsize_t, 2>& size) const {
    const hsize_t kept = H5Dget_storage_size(set) / sizeof(Number);
    const hsize_t rows = kept / size[1];
    if (rows != size[0] || rows * size[1] != kept || kept > bytes_.size() / sizeof(Number))
      throw damaged();
    std::vector<Number> numbers(kept);
    if (!numbers.empty() &&
        H5Dread(set, type_of(numbers).in_memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()) < 0)
      throw damaged();
    return {std::move(numbers), size[1]};
  }

  CheckpointError damaged() const {
    return {path_, "is damaged: it is not as it was written; go on from an earlier one"};
  }

  std::filesystem::path path_;
  std::string bytes_;
};

}  // namespace

CheckpointError::CheckpointError(const std::filesystem::path& file, const std::string& problem)
    : CheckpointError(geometry::printable(file.string()) + ": " + geometry::printable(problem)) {}

void write_checkpoint(const std::filesystem::path& file, const StateTree& state,
                      std::string_view revision) {
  if (goes_nowhere(file)) return;
  const std::string image = image_of(state);
  OutputFile out(file);
  out.write(head_of(image, revision));
  out.write(image);
  // Its bytes before its name: a name alone would be a damaged checkpoint in place of a whole one.
  sync_file(geometry::part_of(file));
  out.commit();
  sync_folder(file.parent_path());
}

bool is_checkpoint(std::string_view head) {
  return parsed_head(head).has_value();
}

CheckpointWriter writer_of_checkpoint(const std::filesystem::path& file) {
  std::string bytes(kHeadSize, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  const Head head = known_head(bytes, file);
  return {head.writer, head.revision};
}

StateTree read_checkpoint(const std::filesystem::path& file) {
  try {
    return parse_checkpoint(geometry::read_regular_file(file, "a checkpoint (.h5)"), file);
  } catch (const geometry::UnreadableFile& error) {
    throw CheckpointError(error.what());
  }
}

StateTree parse_checkpoint(std::string bytes, const std::filesystem::path& name) {
  return Reader(std::move(bytes), name).read();
}

}  // namespace plekton::dynamics
