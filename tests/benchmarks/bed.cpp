// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/bed.hpp"

#include <fstream>
#include <iomanip>
#include <stdexcept>

namespace plekton::benchmarks {

Bed read_bed(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file.string() + ": cannot be opened");
  std::size_t count = 0;
  Bed bed{};
  if (!(in >> count >> bed.side >> bed.extent)) {
    throw std::runtime_error(file.string() +
                             ": line 1 must be: number of spheres, side (m), extent");
  }
  bed.grains.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    auto& [x, r, v, w] = bed.grains[i];
    if (!(in >> x[0] >> x[1] >> x[2] >> r >> v[0] >> v[1] >> v[2] >> w[0] >> w[1] >> w[2])) {
      throw std::runtime_error(file.string() + ": line " + std::to_string(i + 2) +
                               " must have 10 numbers");
    }
  }
  return bed;
}

void write_bed(const Bed& bed, const std::filesystem::path& file) {
  std::ofstream out(file);
  out << std::setprecision(12) << bed.grains.size() << ' ' << bed.side << ' ' << bed.extent << '\n';
  for (const auto& [x, r, v, w] : bed.grains) {
    out << x[0] << ' ' << x[1] << ' ' << x[2] << ' ' << r << ' ' << v[0] << ' ' << v[1] << ' '
        << v[2] << ' ' << w[0] << ' ' << w[1] << ' ' << w[2] << '\n';
  }
  out.close();
  if (!out) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace plekton::benchmarks
