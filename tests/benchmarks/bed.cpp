// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/bed.hpp"

#include "geometry/base/regular_file.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <span>
#include <sstream>
#include <stdexcept>

namespace plekton::benchmarks {
namespace {

constexpr std::size_t kNumbersOfSphere = 10;
constexpr std::size_t kLeastLine =
    2 * kNumbersOfSphere;  // bytes: each number a digit and what ends it

/// Lines of a text, as numbers.
class Lines {
 public:
  Lines(std::string_view text, const std::filesystem::path& name) : rest_(text), name_(name) {}

  std::size_t bytes_left() const noexcept { return rest_.size(); }

  /// The next line. @throws std::runtime_error unless it has these numbers, all finite, and no more
  void read(std::span<double> numbers, const char* expected) {
    ++line_;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    for (double& number : numbers) {
      line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
      const auto [after, error] = std::from_chars(line.data(), line.data() + line.size(), number);
      if (error != std::errc() || !std::isfinite(number)) fail(expected);
      line.remove_prefix(static_cast<std::size_t>(after - line.data()));
    }
    if (line.find_first_not_of(" \t\r") != std::string_view::npos) fail(expected);
  }

  [[noreturn]] void fail(const std::string& expected) const {
    throw std::runtime_error(name_.string() + ": line " + std::to_string(line_) + ": expected " +
                             expected);
  }

 private:
  std::string_view rest_;
  const std::filesystem::path& name_;
  std::size_t line_ = 0;
};

Bed::Grain read_grain(Lines& lines) {
  std::array<double, kNumbersOfSphere> n;
  lines.read(n, "10 finite numbers, those of a sphere");
  if (!(n[3] > 0.0)) lines.fail("a radius (m) above 0, the fourth number");
  return {{n[0], n[1], n[2]}, n[3], {n[4], n[5], n[6]}, {n[7], n[8], n[9]}};
}

}  // namespace

Bed parse_bed(std::string_view text, const std::filesystem::path& name) {
  Lines lines(text, name);
  std::array<double, 3> head;
  lines.read(head, "number of spheres, side (m), extent");
  const auto [count, side, extent] = head;
  if (!(side > 0.0 && extent > 0.0)) lines.fail("a side (m) and an extent above 0");
  // Before memory is taken for them.
  const double most = static_cast<double>((lines.bytes_left() + 1) / kLeastLine);
  if (!(count >= 0.0 && count <= most) || count != std::floor(count))
    lines.fail("a number of spheres, each with a line of its own in this file");
  Bed bed{side, extent, {}};
  bed.grains.reserve(static_cast<std::size_t>(count));
  while (bed.grains.size() < static_cast<std::size_t>(count))
    bed.grains.push_back(read_grain(lines));
  return bed;
}

Bed read_bed(const std::filesystem::path& file) {
  return parse_bed(geometry::read_regular_file(file, "a bed of spheres (.txt)"), file);
}

std::string text_of(const Bed& bed) {
  std::ostringstream out;
  out << std::setprecision(12) << bed.grains.size() << ' ' << bed.side << ' ' << bed.extent << '\n';
  for (const auto& [x, r, v, w] : bed.grains) {
    out << x[0] << ' ' << x[1] << ' ' << x[2] << ' ' << r << ' ' << v[0] << ' ' << v[1] << ' '
        << v[2] << ' ' << w[0] << ' ' << w[1] << ' ' << w[2] << '\n';
  }
  return out.str();
}

void write_bed(const Bed& bed, const std::filesystem::path& file) {
  std::ofstream out(file);
  out << text_of(bed);
  out.close();
  if (!out) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace plekton::benchmarks
