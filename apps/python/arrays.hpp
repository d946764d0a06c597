// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/python/bindings.hpp"
#include "geometry/base/types.hpp"

#include <fmt/format.h>
#include <pybind11/numpy.h>

#include <array>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/// Between arrays of numpy and those of the library.
namespace plekton::python {

using geometry::Vec3;
static_assert(sizeof(Vec3) == 3 * sizeof(double), "positions are rows of an array");

/// What is handed in: numbers of any kind, copied only where they are no doubles side by side.
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Whole = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

/// Whole numbers alone: no fraction is cut off, in an array or in a list.
/// @throws std::invalid_argument
inline Whole whole_numbers(const py::object& given, const char* name,
                           const char* expected = "whole numbers") {
  const py::array array = py::array::ensure(given);
  if (!array) {
    PyErr_Clear();
    throw std::invalid_argument(
        fmt::format("{}: got what is no array; expected {}", name, expected));
  }
  const char kind = array.dtype().kind();
  if (kind != 'i' && kind != 'u' && array.size() > 0)
    throw std::invalid_argument(fmt::format("{}: got numbers of type {}; expected {}", name,
                                            std::string(py::str(array.dtype())), expected));
  return Whole(array);
}

/// A new array of rows.
template <class Row>
py::array_t<Row> array_of(const std::vector<Row>& rows) {
  return py::array_t<Row>(static_cast<py::ssize_t>(rows.size()), rows.data());
}

inline py::array_t<double> array_of(const Vec3& vector) {
  return py::array_t<double>(3, vector.data());
}

inline py::array_t<double> array_of(const std::vector<Vec3>& vectors) {
  py::array_t<double> result({static_cast<py::ssize_t>(vectors.size()), py::ssize_t{3}});
  for (std::size_t i = 0; i < vectors.size(); ++i)
    for (int k = 0; k < 3; ++k) result.mutable_at(static_cast<py::ssize_t>(i), k) = vectors[i][k];
  return result;
}

/// Nodes of elements, a row for each.
template <std::size_t N>
py::array_t<std::int32_t> array_of(const std::vector<std::array<geometry::NodeId, N>>& elements) {
  py::array_t<std::int32_t> result(
      {static_cast<py::ssize_t>(elements.size()), static_cast<py::ssize_t>(N)});
  for (std::size_t i = 0; i < elements.size(); ++i)
    for (std::size_t k = 0; k < N; ++k)
      result.mutable_at(static_cast<py::ssize_t>(i), static_cast<py::ssize_t>(k)) =
          static_cast<std::int32_t>(elements[i][k]);
  return result;
}

inline std::array<double, 3> plain(const Vec3& v) {
  return {v[0], v[1], v[2]};
}

/// @throws std::invalid_argument
inline void require_rows(const py::array& array, py::ssize_t columns, const char* name) {
  if (array.ndim() == 2 && array.shape(1) == columns) return;
  std::string shape;
  for (py::ssize_t i = 0; i < array.ndim(); ++i)
    shape += (i > 0 ? ", " : "") + std::to_string(array.shape(i));
  throw std::invalid_argument(
      fmt::format("{}: got an array of shape ({}); expected (N, {})", name, shape, columns));
}

/// Rows of three. @throws std::invalid_argument for another shape
inline std::vector<Vec3> vectors_of(const Numbers& array, const char* name) {
  require_rows(array, 3, name);
  std::vector<Vec3> vectors(static_cast<std::size_t>(array.shape(0)));
  for (std::size_t i = 0; i < vectors.size(); ++i)
    for (int k = 0; k < 3; ++k) vectors[i][k] = array.at(static_cast<py::ssize_t>(i), k);
  return vectors;
}

/// One number for each, or the same for all.
/// @throws std::invalid_argument for any other number of them
inline std::vector<double> numbers_of(const Numbers& array, std::size_t count, const char* name) {
  if (array.ndim() == 0) return std::vector<double>(count, *array.data());
  if (array.ndim() != 1 || static_cast<std::size_t>(array.size()) != count)
    throw std::invalid_argument(fmt::format(
        "{}: got {} numbers; expected one, or one for each of {}", name, array.size(), count));
  return {array.data(), array.data() + array.size()};
}

}  // namespace plekton::python
