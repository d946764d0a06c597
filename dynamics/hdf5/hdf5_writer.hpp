// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/state_tree.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace plekton::dynamics {

/// Makes an HDF5 file in memory. Paths begin with a slash; groups above a data set are made with
/// it. Links are kept in the order in which they are made, as VTK wants it. The same calls make the
/// same bytes: there are no times in the file.
class Hdf5Writer {
 public:
  Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;
  ~Hdf5Writer();

  void group(const std::string& path);

  /// So many numbers side by side in each row; with 0 columns a plain list of numbers, and without
  /// rows either a single number.
  void numbers(const std::string& path, std::span<const double> values, std::size_t columns = 0);
  void numbers(const std::string& path, std::span<const std::int64_t> values,
               std::size_t columns = 0);
  /// The same of any kind of number that a state has, in rows and columns.
  void array(const std::string& path, const geometry::StateArray& array);
  void number(const std::string& path, double value);
  void number(const std::string& path, std::int64_t value);
  /// UTF-8, of one length that all of them share, filled up with zeros.
  void texts(const std::string& path, const std::vector<std::string>& values);
  void text(const std::string& path, const std::string& value);

  /// Of a group or data set that is there.
  void attribute(const std::string& path, const std::string& name, const std::string& value);
  void attribute(const std::string& path, const std::string& name, double value);
  void attribute(const std::string& path, const std::string& name,
                 std::span<const std::int64_t> values);
  void attribute(const std::string& path, const std::string& name, std::int64_t value);

  void soft_link(const std::string& path, const std::string& target);
  /// A second name of a data set that is there.
  void same_as(const std::string& path, const std::string& target);

  /// Of the whole file.
  std::string bytes() const;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace plekton::dynamics
