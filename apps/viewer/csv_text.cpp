// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/viewer/csv_text.hpp"

#include "apps/scenario/byte_order_mark.hpp"

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
      if (c != '"') {
        cell += c;
      } else if (rest_.empty() || rest_[0] != '"') {
        break;
      } else {
        cell += c;
        rest_.remove_prefix(1);
      }
    }
    // What stands between the quote and the next comma is blank, or a slip that is left out.
    rest_.remove_prefix(std::min(rest_.find_first_of(",\n"), rest_.size()));
    return cell;
  }

  bool take(char c) {
    if (rest_.empty() || rest_[0] != c) return false;
    if (c == '\n') ++line_;
    rest_.remove_prefix(1);
    return true;
  }

  std::string_view rest_;
  int line_ = 1;
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
