// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/model/time_table.hpp"

#include "geometry/base/problems.hpp"

#include <algorithm>
#include <cmath>

namespace plekton::dynamics {
namespace {

using Row = TimeTable::Row;

void require_rows(const std::vector<Row>& rows) {
  std::ostringstream problems;
  if (rows.empty()) problems << "time table: has no rows; give at least one\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!std::isfinite(rows[i].time) || !std::isfinite(rows[i].value)) {
      problems << "time table: row " << i << " (" << rows[i].time << " s, " << rows[i].value
               << ") is not finite\n";
    }
    if (i > 0 && !(rows[i].time > rows[i - 1].time)) {
      problems << "time table: row " << i << " is at " << rows[i].time << " s, not after "
               << rows[i - 1].time << " s of the row before; list the rows by increasing time\n";
    }
  }
  geometry::throw_if_any(problems);
}

double slope_between(const Row& a, const Row& b) noexcept {
  return (b.value - a.value) / (b.time - a.time);
}

}  // namespace

TimeTable::TimeTable(double constant) : TimeTable(std::vector<Row>{{0.0, constant}}) {}

TimeTable::TimeTable(std::vector<Row> rows) : rows_(std::move(rows)) {
  require_rows(rows_);
  integrals_.assign(rows_.size(), 0.0);
  for (std::size_t i = 1; i < rows_.size(); ++i) {
    const double mean = 0.5 * (rows_[i - 1].value + rows_[i].value);
    integrals_[i] = integrals_[i - 1] + mean * (rows_[i].time - rows_[i - 1].time);
  }
  integral_to_zero_ = integral_from_first_row(0.0);
}

const std::vector<Row>& TimeTable::rows() const noexcept {
  static const std::vector<Row> one{{0.0, 1.0}};
  return rows_.empty() ? one : rows_;
}

void TimeTable::swap(TimeTable& other) noexcept {
  rows_.swap(other.rows_);
  integrals_.swap(other.integrals_);
  std::swap(integral_to_zero_, other.integral_to_zero_);
  std::swap(start_, other.start_);
}

TimeTable TimeTable::from(double start) const {
  TimeTable later = *this;
  later.start_ = start;
  return later;
}

/// The first row after this time; the number of rows if there is none.
std::size_t TimeTable::row_after(double time) const noexcept {
  const auto after =
      std::upper_bound(rows_.begin(), rows_.end(), time,
                       [](double searched, const Row& row) { return searched < row.time; });
  return static_cast<std::size_t>(after - rows_.begin());
}

double TimeTable::at(double time) const noexcept {
  return value(time - start_);
}

double TimeTable::value(double time) const noexcept {
  if (rows_.empty()) return 1.0;
  const std::size_t after = row_after(time);
  if (after == 0) return rows_.front().value;
  const Row& row = rows_[after - 1];
  if (after == rows_.size()) return row.value;
  return row.value + (time - row.time) * slope_between(row, rows_[after]);
}

double TimeTable::slope(double time) const noexcept {
  const std::size_t after = row_after(time - start_);
  if (after == 0 || after == rows_.size()) return 0.0;
  return slope_between(rows_[after - 1], rows_[after]);
}

double TimeTable::integral_from_first_row(double time) const noexcept {
  if (rows_.empty()) return time;
  const std::size_t after = row_after(time);
  const std::size_t row = after == 0 ? 0 : after - 1;
  return integrals_[row] + 0.5 * (rows_[row].value + value(time)) * (time - rows_[row].time);
}

double TimeTable::integral(double time) const noexcept {
  return integral_from_first_row(time - start_) - integral_to_zero_;
}

double TimeTable::lowest() const noexcept {
  return std::ranges::min(rows(), {}, &Row::value).value;
}

double TimeTable::largest(const TimeSpan& during) const noexcept {
  const double begin = during.begin - start_, end = during.end - start_;
  double largest = std::max(std::abs(value(begin)), std::abs(value(end)));
  for (const Row& row : rows_)
    if (begin < row.time && row.time < end) largest = std::max(largest, std::abs(row.value));
  return largest;
}

double TimeTable::largest_slope(const TimeSpan& during) const noexcept {
  const double begin = during.begin - start_, end = during.end - start_;
  double largest = 0.0;
  for (std::size_t i = 1; i < rows_.size(); ++i)
    if (rows_[i - 1].time <= end && begin <= rows_[i].time)
      largest = std::max(largest, std::abs(slope_between(rows_[i - 1], rows_[i])));
  return largest;
}

}  // namespace plekton::dynamics
