// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/simulation.hpp"
#include "geometry/base/elementary.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

/// A chain of links of 1.2 m between two supports 1 m apart, at rest under its weight.
namespace plekton::apps {

constexpr double kChainLength = 1.2;  // m
constexpr double kChainSpan = 1.0;    // m

struct HangingChain {
  double sag;                          ///< m, of its middle
  double pull;                         ///< N, horizontal, on either support
  std::vector<geometry::Vec3> places;  ///< m, of its nodes; empty of a closed form
};

/// Hyperbolic cosine and sine.
inline double cosh_of(double x) {
  return 0.5 * (elementary::exp(x) + elementary::exp(-x));
}
inline double sinh_of(double x) {
  return 0.5 * (elementary::exp(x) - elementary::exp(-x));
}

/// The catenary y = a cosh(x / a) of a weight per length w (N/m): length 2 a sinh(span / 2 a), sag
/// a (cosh(span / 2 a) - 1), pull w a.
inline HangingChain catenary(double weight) {
  double below = 0.05, above = 5.0;  // m; the length falls with a
  for (int i = 0; i < 100; ++i) {
    const double a = 0.5 * (below + above);
    (2.0 * a * sinh_of(0.5 * kChainSpan / a) > kChainLength ? below : above) = a;
  }
  return {below * (cosh_of(0.5 * kChainSpan / below) - 1.0), weight * below, {}};
}

/// Links of a radius of 4 mm, 1000 kg/m³ and 0.5 GPa: they get longer by less than 3e-5.
constexpr double kLinkRadius = 0.004;  // m
inline const double kChainWeight =
    1000.0 * std::numbers::pi * kLinkRadius * kLinkRadius * 9.81;  // N/m

/// Lets a chain of bars swing out of the two straight lines of its length, under numerical damping.
/// @param links  even
inline HangingChain hang_chain(int links) {
  using dynamics::Held;
  dynamics::Scene scene;
  const auto section = dynamics::bar_section(kLinkRadius, 5e8);
  for (int i = 0; i <= links; ++i) {
    const bool is_support = i == 0 || i == links;
    const auto node = scene.add_node(geometry::Vec3(kChainLength * i / links, 0.0, 0.0),
                                     is_support ? Held::everything : Held::rotation);
    if (i > 0)
      scene.add_beam(geometry::id_at<geometry::NodeId>(index_of(node) - 1), node, section, 1000.0);
  }
  constexpr double kAcross = kChainSpan / kChainLength;
  const double down = std::sqrt(1.0 - kAcross * kAcross);
  for (geometry::Vec3& x : scene.state.position) {
    const double along = x.x();
    x = geometry::Vec3(along * kAcross, 0.0, -std::min(along, kChainLength - along) * down);
  }
  dynamics::SimulationOptions options;
  options.motion.gravity = geometry::Vec3(0.0, 0.0, -9.81);
  options.motion.damping = 0.4;
  dynamics::Simulation simulation(std::move(scene), options);
  // The slowest swing takes about 1 s and loses most of its energy in it. Numerical damping is slow
  // to quiet the waves along many short links at steps near the critical one: until the resultants,
  // all in one direction, could not be more than 1e-4 of the pull of 100 links.
  constexpr double kRest = 1e-6;
  constexpr double kLongest = 60.0;  // s
  for (double end = 6.0; end < kLongest; end += 1.0) {
    while (simulation.time() < end) simulation.step();
    if (simulation.unbalanced_force_ratio() < kRest) break;
  }
  const std::size_t middle = static_cast<std::size_t>(links / 2);
  return {-simulation.state().position[middle].z(), simulation.forces().force.front().x(),
          simulation.state().position};
}

}  // namespace plekton::apps
