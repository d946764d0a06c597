// SPDX-License-Identifier: GPL-3.0-or-later
#include <plekton/dynamics/output/csv_writer.hpp>

#include <array>
#include <filesystem>
#include <iostream>

int main() {
  const std::filesystem::path file = "history.csv";
  const std::array<plekton::dynamics::CsvColumn, 2> columns{{{"time", "s"}, {"height", "m"}}};

  plekton::dynamics::CsvWriter history(file, columns);
  history.add({0.0, 1.0});
  history.close();

  const auto size = std::filesystem::file_size(file);
  std::filesystem::remove(file);
  std::cout << size << " bytes of history written\n";
  return size > 0 ? 0 : 1;
}
