// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <utility>
#include <vector>

namespace plekton::dynamics {

/// Times (s) from one to another, both included.
struct TimeSpan {
  double begin = -std::numeric_limits<double>::infinity();
  double end = std::numeric_limits<double>::infinity();
};

/// A number that changes with time: straight lines between rows, the value of the first row before
/// it and of the last row after it. Exactly the value of a row at its time. One that was moved from is
/// as good as new: 1 at all times, from a start of 0.
class TimeTable {
 public:
  struct Row {
    double time;  ///< s
    double value;
  };

  /// 1 at all times.
  TimeTable() : TimeTable(1.0) {}
  /// The same number at all times. @throws std::invalid_argument if it is not finite
  explicit TimeTable(double constant);

  /// @param rows  at least one, finite, their times increasing
  /// @throws std::invalid_argument listing every problem of the rows
  explicit TimeTable(std::vector<Row> rows);

  TimeTable(const TimeTable&) = default;
  TimeTable& operator=(const TimeTable&) = default;
  TimeTable(TimeTable&& other) noexcept : TimeTable(Moved{}) { swap(other); }
  TimeTable& operator=(TimeTable&& other) noexcept {
    TimeTable(std::move(other)).swap(*this);
    return *this;
  }
  ~TimeTable() = default;

  /// At least one.
  const std::vector<Row>& rows() const noexcept;

  /// The same numbers later: rows count from a time (s), and so does integral().
  TimeTable from(double start) const;
  /// s, from when the rows count; 0 unless told.
  double start() const noexcept { return start_; }

  /// Logarithmic in the number of rows.
  double at(double time) const noexcept;
  /// From the start to this time (s times the value), earlier times included; exact but for
  /// rounding.
  double integral(double time) const noexcept;
  /// Right after this time (1/s).
  double slope(double time) const noexcept;

  /// Lowest value of all times.
  double lowest() const noexcept;
  /// Largest absolute value and slope (1/s) at any of these times.
  double largest(const TimeSpan& during = {}) const noexcept;
  double largest_slope(const TimeSpan& during = {}) const noexcept;

 private:
  struct Moved {};
  /// Without rows, which need memory.
  explicit TimeTable(Moved) noexcept {}
  void swap(TimeTable& other) noexcept;

  // Of times that count from the start.
  std::size_t row_after(double time) const noexcept;
  double value(double time) const noexcept;
  double integral_from_first_row(double time) const noexcept;

  std::vector<Row> rows_;          // none of one that was moved from
  std::vector<double> integrals_;  // by row, from the first one
  double integral_to_zero_ = 0.0;  // from the first row to the start
  double start_ = 0.0;             // s
};

}  // namespace plekton::dynamics
