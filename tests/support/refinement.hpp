// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace plekton::test {

/// A result on finer and finer meshes against what it should become, printed as a table.
class Refinement {
 public:
  Refinement(std::string title, double expected) : title_(std::move(title)), expected_(expected) {}

  /// @param cells  along a side, or whatever is inverse to the size of a facet
  void add(int cells, double value) { rows_.push_back({cells, value}); }

  double error(std::size_t row) const { return std::abs(rows_[row].value / expected_ - 1.0); }
  double last_error() const { return error(rows_.size() - 1); }
  /// Power of the size with which the error falls from a row to the next.
  double order(std::size_t row) const {
    return std::log(error(row) / error(row + 1)) /
           std::log(static_cast<double>(rows_[row + 1].cells) / rows_[row].cells);
  }
  double last_order() const { return order(rows_.size() - 2); }

  void print() const {
    std::printf("%s: expected %.6g\n%8s %14s %12s %8s\n", title_.c_str(), expected_, "cells",
                "value", "error", "order");
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      std::printf("%8d %14.6g %11.4f%%", rows_[i].cells, rows_[i].value,
                  100.0 * (rows_[i].value / expected_ - 1.0));
      if (i > 0) std::printf(" %8.2f", order(i - 1));
      std::printf("\n");
    }
  }

 private:
  struct Row {
    int cells;
    double value;
  };
  std::string title_;
  double expected_;
  std::vector<Row> rows_;
};

}  // namespace plekton::test
