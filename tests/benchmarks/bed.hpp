// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace plekton::benchmarks {

/// A packing of spheres in a box, as all codes that are compared read it. Text: a line `count side
/// extent`, then one line `x y z radius vx vy vz wx wy wz` for each sphere, SI units.
struct Bed {
  struct Grain {
    geometry::Vec3 position;
    double radius;
    geometry::Vec3 velocity;
    geometry::Vec3 angular_velocity;
  };
  double side;    ///< m, of the box in y
  double extent;  ///< length of the box in x over side
  std::vector<Grain> grains;
};

/// @throws std::runtime_error naming file and line. No more memory is taken than lines need.
Bed read_bed(const std::filesystem::path& file);

/// The same from memory. @param name  what messages call it
Bed parse_bed(std::string_view text, const std::filesystem::path& name);

/// With 12 digits.
std::string text_of(const Bed& bed);

/// @throws std::runtime_error naming the file if it cannot be written
void write_bed(const Bed& bed, const std::filesystem::path& file);

}  // namespace plekton::benchmarks
