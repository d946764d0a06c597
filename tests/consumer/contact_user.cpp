// SPDX-License-Identifier: GPL-3.0-or-later
#include <plekton/contact/law/linear_frictional.hpp>

#include <iostream>

int main() {
  const plekton::contact::Material gravel{50e9, 0.3, 0.7};
  const double radius = 0.01;

  const auto pair = plekton::contact::LinearFrictional::combine({gravel, radius}, {gravel, radius});

  std::cout << "normal stiffness " << pair.normal_stiffness << " N/m\n";
  return pair.normal_stiffness > 0.0 ? 0 : 1;
}
