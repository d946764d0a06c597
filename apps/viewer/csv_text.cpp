// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/viewer/csv_text.hpp"

#include "apps/scenario/byte_order_mark.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace plekton::apps {
namespace {

std::string trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(kBlanks) - first + 1));
}

class CsvParser {
 public:
  explicit CsvParser(std::string_view text) : rest_(text) {}

  std::vector<CsvRow> parse() {
    std::vector<CsvRow> rows;
    while (!rest_.empty()) {
      if (take_blank_line()) continue;
      rows.push_back(read_row());
    }
    return rows;
  }

 private:
  /// Of one that has nothing but blanks; an empty cell in quotes is a row.
  bool take_blank_line() {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    if (!trimmed(rest_.substr(0, end)).empty()) return false;
    rest_.remove_prefix(end);
    take('\n');
    return true;
  }

  CsvRow read_row() {
    CsvRow row{line_, {}};
    do {
      row.cells.push_back(read_cell());
      if (row.problem.empty() && !problem_.empty())
        row.problem = fmt::format("cell {}: {}", row.cells.size(), problem_);
      problem_.clear();
    } while (take(','));
    take('\n');
    return row;
  }

  std::string read_cell() {
    const std::size_t first = rest_.find_first_not_of(" \t");
    if (first != std::string_view::npos && rest_[first] == '"') {
      rest_.remove_prefix(first + 1);
      return read_quoted();
    }
    const std::size_t end = std::min(rest_.find_first_of(",\n"), rest_.size());
    const std::string cell = trimmed(rest_.substr(0, end));
    rest_.remove_prefix(end);
    return cell;
  }

  std::string read_quoted() {
    std::string cell;
    while (!rest_.empty()) {
      const char c = rest_[0];
      rest_.remove_prefix(1);
      if (c == '\n') ++line_;
      if (c == '"' && !take('"')) {
        pass_to_end_of_cell();
        return cell;
      }
      cell += c;
    }
    problem_ = "got a quote that is not closed; expected another one at the end of the cell";
    return cell;
  }

  /// From behind a closing quote.
  void pass_to_end_of_cell() {
    const std::size_t end = std::min(rest_.find_first_of(",\n"), rest_.size());
    if (const std::string behind = trimmed(rest_.substr(0, end)); !behind.empty())
      problem_ = fmt::format(
          "got \"{}\" behind a closing quote; expected a comma or the end of the line: put the "
          "whole cell into the quotes, and write a quote in it twice",
          behind);
    rest_.remove_prefix(end);
  }

  bool take(char c) {
    if (rest_.empty() || rest_[0] != c) return false;
    if (c == '\n') ++line_;
    rest_.remove_prefix(1);
    return true;
  }

  std::string_view rest_;
  int line_ = 1;
  std::string problem_;  ///< of the cell; empty: none
};

}  // namespace

std::vector<CsvRow> parse_csv(std::string_view text) {
  return CsvParser(without_byte_order_mark(text)).parse();
}

std::string csv_cell(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string cell = "\"";
  for (const char c : text) cell += c == '"' ? std::string("\"\"") : std::string(1, c);
  return cell + '"';
}

}  // namespace plekton::apps
