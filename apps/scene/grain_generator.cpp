// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scene/grain_generator.hpp"

#include "apps/grains/random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace plekton::apps {
namespace {

constexpr int kTrials = 2000;            // for one grain
constexpr double kLatticeMargin = 1e-9;  // of the spacing, so that rounding makes no overlap

double ball_volume(double radius) {
  return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

double volume_of(std::span<const double> diameters) {
  double volume = 0.0;
  for (const double d : diameters) volume += ball_volume(0.5 * d);
  return volume;
}

FreeSpace make_space(const GrainSettings& settings, double largest,
                     const Surroundings& surroundings) {
  FreeSpace space(settings.box, largest, surroundings.planes);
  for (const Obstacle& obstacle : surroundings.obstacles) space.add(obstacle);
  return space;
}

/// Places the grains one after the other at random; fewer than asked for if one finds no room.
std::vector<PlacedGrain> place_at_random(std::span<const double> diameters, FreeSpace space,
                                         const Box& box, Random& random,
                                         const std::function<void(double)>& tell) {
  constexpr std::size_t kGrainsBetweenCalls = 64;
  std::vector<PlacedGrain> grains;
  for (const double diameter : diameters) {
    if (tell && grains.size() % kGrainsBetweenCalls == 0)
      tell(static_cast<double>(grains.size()) / static_cast<double>(diameters.size()));
    const double radius = 0.5 * diameter;
    const Vec3 lower = box.lower.array() + radius;
    const Vec3 upper = lower.cwiseMax(Vec3(box.upper.array() - radius));
    if ((lower - box.upper).maxCoeff() > (kRounding - 1.0) * radius) return grains;
    int trial = 0;
    Vec3 centre = random.in_box(lower, upper);
    while (!space.has_room(centre, radius)) {
      if (++trial == kTrials) return grains;
      centre = random.in_box(lower, upper);
    }
    space.add({{centre, centre, centre}, radius});
    grains.push_back({centre, radius});
  }
  return grains;
}

/// Sites of a face-centred cubic lattice with a distance between neighbours, in layers along z,
/// whose balls of that diameter lie in the box.
std::vector<Vec3> lattice_sites(const Box& box, double spacing) {
  const double row = 0.5 * std::numbers::sqrt3 * spacing;
  const double layer = std::sqrt(2.0 / 3.0) * spacing;
  const Vec3 lower = box.lower.array() + 0.5 * spacing;
  const Vec3 upper = box.upper.array() - 0.5 * spacing;
  std::vector<Vec3> sites;
  for (int k = 0; lower[2] + k * layer <= upper[2]; ++k) {
    const Vec3 shift((k % 3) * 0.5 * spacing, (k % 3) * row / 3.0, 0.0);
    for (int j = 0; lower[1] + shift[1] + j * row <= upper[1]; ++j) {
      const double x0 = lower[0] + std::fmod(shift[0] + (j % 2) * 0.5 * spacing, spacing);
      for (int i = 0; x0 + i * spacing <= upper[0]; ++i) {
        sites.emplace_back(x0 + i * spacing, lower[1] + shift[1] + j * row, lower[2] + k * layer);
      }
    }
  }
  return sites;
}

/// Random vector in the unit ball.
Vec3 in_ball(Random& random) {
  while (true) {
    Vec3 v = random.in_box(Vec3::Constant(-1.0), Vec3::Constant(1.0));
    if (v.squaredNorm() <= 1.0) return v;
  }
}

/// Places the grains on lattice sites; fewer than asked for if there are not enough.
std::vector<PlacedGrain> place_on_lattice(std::span<const double> diameters, const FreeSpace& space,
                                          const Box& box, Random& random) {
  const double spacing = diameters.front() * (1.0 + kLatticeMargin);
  std::vector<Vec3> sites = lattice_sites(box, spacing);
  std::erase_if(sites,
                [&](const Vec3& site) { return !space.has_room(site, 0.5 * diameters.front()); });
  random.shuffle(sites);
  std::vector<PlacedGrain> grains;
  for (std::size_t i = 0; i < std::min(sites.size(), diameters.size()); ++i) {
    // Any two neighbours keep apart when each stays within its own ball of the lattice.
    const double room = 0.5 * (diameters.front() - diameters[i]);
    grains.push_back({sites[i] + room * in_ball(random), 0.5 * diameters[i]});
  }
  return grains;
}

/// @param attained  how far it went, as in "no arrangement of balls can"
[[noreturn]] void fail(const GrainSettings& settings, std::size_t count, double volume,
                       const std::string& attained) {
  const Vec3 size = settings.box.upper - settings.box.lower;
  const bool is_random = settings.placement == GrainPlacement::random;
  throw DoesNotFit(fmt::format(
      "{}: {} grains of {:.4g} m3 in all (the largest {:.4g} m across) do not fit the "
      "box of {:.4g} m x {:.4g} m x {:.4g} m, "
      "{:.4g} m3, {:.0f} % of which they would fill; {}; make the box larger ({} filled is easy), "
      "ask for fewer grains, move the box away from membranes and planes{}",
      settings.name, count, volume, settings.sizes.largest_diameter(), size[0], size[1], size[2],
      size.prod(), 100.0 * volume / size.prod(), attained, is_random ? "a quarter" : "half",
      is_random ? ", or take a crystal, placement = \"lattice\", which is denser" : ""));
}

/// As in "placed at random, 731 of 1200 found room, filling 38 %".
std::string attained_by(const GrainSettings& settings, std::span<const PlacedGrain> grains,
                        std::size_t count) {
  double volume = 0.0;
  for (const PlacedGrain& grain : grains) volume += ball_volume(grain.radius);
  return fmt::format(
      "{}, {} of {} found room, filling {:.0f} %",
      settings.placement == GrainPlacement::random ? "placed at random, largest first"
                                                   : "on a lattice",
      grains.size(), count, 100.0 * volume / (settings.box.upper - settings.box.lower).prod());
}

std::size_t count_of(const GrainSettings& settings) {
  if (const auto* count = std::get_if<std::size_t>(&settings.amount)) return *count;
  return static_cast<std::size_t>(
      std::max(1.0, std::round(std::get<double>(settings.amount) / settings.sizes.mean_volume())));
}

}  // namespace

std::vector<PlacedGrain> generate_grains(const GrainSettings& settings,
                                         const Surroundings& surroundings,
                                         const std::function<void(double)>& tell) {
  const double room = (settings.box.upper - settings.box.lower).prod();
  const auto* solids = std::get_if<double>(&settings.amount);
  const double expected = solids ? *solids
                                 : static_cast<double>(std::get<std::size_t>(settings.amount)) *
                                       settings.sizes.mean_volume();
  // Before any grain is drawn, so that a slip in a unit does not ask for more grains than fit into
  // memory.
  if (expected > 2.0 * room) {
    fail(settings,
         static_cast<std::size_t>(std::min(1e18, expected / settings.sizes.mean_volume())),
         expected, "no arrangement of balls can");
  }
  Random random(settings.seed);
  const std::vector<double> diameters = settings.sizes.draw(count_of(settings), random);
  FreeSpace space = make_space(settings, 0.5 * diameters.front(), surroundings);

  std::vector<PlacedGrain> grains =
      settings.placement == GrainPlacement::random
          ? place_at_random(diameters, std::move(space), settings.box, random, tell)
          : place_on_lattice(diameters, space, settings.box, random);
  if (grains.size() < diameters.size()) {
    fail(settings, diameters.size(), volume_of(diameters),
         attained_by(settings, grains, diameters.size()));
  }
  return grains;
}

}  // namespace plekton::apps
