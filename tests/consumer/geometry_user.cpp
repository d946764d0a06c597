// SPDX-License-Identifier: GPL-3.0-or-later
#include <plekton/geometry/primitives/box.hpp>
#include <plekton/geometry/version.hpp>

#include <array>
#include <iostream>

int main() {
  const std::array<plekton::geometry::Vec3, 2> points{plekton::geometry::Vec3(0.0, 0.0, 0.0),
                                                      plekton::geometry::Vec3(1.0, 2.0, 3.0)};
  const plekton::geometry::Box box = plekton::geometry::bounding_box(points, 0.5);

  std::cout << "plekton " << plekton::kVersion << ", box up to " << box.upper.transpose() << " m\n";
  return box.upper.z() > 3.0 ? 0 : 1;
}
