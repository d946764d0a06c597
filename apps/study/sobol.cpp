// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/study/sobol.hpp"

#include <boost/random/sobol.hpp>

#include <cstdint>

namespace plekton::apps {

std::vector<std::vector<double>> sobol_points(std::size_t count, std::size_t parameters) {
  // Numbers of 32 bits, so that a coordinate is exact as a double.
  constexpr unsigned kBits = 32;
  boost::random::sobol_engine<std::uint32_t, kBits> engine(parameters);
  std::vector<std::vector<double>> points;
  if (count > 0) points.emplace_back(parameters, 0.0);  // which Boost leaves out
  while (points.size() < count) {
    std::vector<double>& point = points.emplace_back();
    for (std::size_t i = 0; i < parameters; ++i)
      point.push_back(0x1p-32 * static_cast<double>(engine()));
  }
  return points;
}

}  // namespace plekton::apps
