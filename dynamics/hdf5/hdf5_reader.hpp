// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/state_tree.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace plekton::dynamics {

/// An HDF5 file has not what is looked for. The message names the file, the path in it, what was
/// got and what was expected.
class Hdf5Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Numbers of a data set, row after row.
template <class Number>
struct Hdf5Array {
  std::vector<Number> values;
  std::size_t columns = 1;  ///< of a plain list or a single number 1

  std::size_t rows() const noexcept { return values.size() / columns; }
};

/// Reads an HDF5 file of another program. Nothing outside the file is followed, and memory is taken
/// for what lies in it alone: a size that is said and not there takes none.
class Hdf5Reader {
 public:
  /// @param name  what messages call it
  /// @throws Hdf5Error if that is no whole HDF5 file
  Hdf5Reader(std::string bytes, const std::filesystem::path& name);
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;
  ~Hdf5Reader();

  /// Whether there is a group or data set of that path, which begins with a slash.
  bool has(const std::string& path) const;
  bool is_group(const std::string& path) const;
  /// What is in a group, in the order of the alphabet. @throws Hdf5Error if it is no group
  std::vector<std::string> names_in(const std::string& group) const;

  /// A data set of at most two dimensions, whole or floating-point numbers. @throws Hdf5Error
  Hdf5Array<double> numbers(const std::string& path) const;
  /// The same of whole numbers alone.
  Hdf5Array<std::int64_t> whole_numbers(const std::string& path) const;
  /// A data set that a state has, of its own kind of number.
  geometry::StateArray array(const std::string& path) const;
  /// A data set of texts, or of one of them. @throws Hdf5Error
  std::vector<std::string> texts(const std::string& path) const;

  /// Attributes; nothing where there is none. @throws Hdf5Error if it is of another kind
  std::optional<double> number_attribute(const std::string& path, const std::string& name) const;
  std::optional<std::string> text_attribute(const std::string& path, const std::string& name) const;

  /// "FILE: path: what"
  [[noreturn]] void fail(const std::string& path, const std::string& what) const;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace plekton::dynamics
