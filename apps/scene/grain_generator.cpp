// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scene/grain_generator.hpp"

#include "apps/grains/random.hpp"
#include "apps/grains/sphere_packing.hpp"
#include "geometry/base/elementary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace plekton::apps {
namespace {

constexpr int kTrials = 2000;            // for one grain
constexpr double kLatticeMargin = 1e-9;  // of the spacing, so that rounding makes no overlap
// Of the space that grains to be packed fill before they grow: what chance allows at ease.
constexpr std::array<double, 3> kSparse = {0.2, 0.1, 0.03};
// Solids in the space with which a packing to a stress begins to count, where no amount is given.
constexpr double kUsualSolids = 0.63;

double ball_volume(double radius) {
  return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

double volume_of(std::span<const double> diameters) {
  double volume = 0.0;
  for (const double d : diameters) volume += ball_volume(0.5 * d);
  return volume;
}

FreeSpace make_space(const Container& container, double largest, const Surroundings& surroundings) {
  FreeSpace space(container.bounds, largest, surroundings.planes);
  for (const Obstacle& obstacle : surroundings.obstacles) space.add(obstacle);
  return space;
}

/// Places the grains one after the other at random; fewer than asked for if one finds no room.
std::vector<PlacedGrain> place_at_random(std::span<const double> diameters, FreeSpace space,
                                         const Container& container, Random& random,
                                         const std::function<void(double)>& tell) {
  const Box& box = container.bounds;
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
    while (!space.has_room(centre, radius) || !container.holds(centre, radius)) {
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

std::string_view kind_of_space(const GrainSettings& settings) {
  if (!settings.inside.empty()) return "membrane";
  return settings.cylinder ? "cylinder" : "box";
}

/// "box of 1 m x 2 m x 3 m", or as in "cylinder of 0.1 m radius"
std::string name_of_space(const GrainSettings& settings) {
  if (!settings.inside.empty()) return fmt::format("inside of \"{}\"", settings.inside);
  if (settings.cylinder)
    return fmt::format("cylinder of {:.4g} m radius", settings.cylinder->radius);
  const Vec3 size = settings.box.upper - settings.box.lower;
  return fmt::format("box of {:.4g} m x {:.4g} m x {:.4g} m", size[0], size[1], size[2]);
}

/// Grains that are to be placed, and where.
struct Task {
  const GrainSettings& settings;
  const Container& container;
  std::size_t count;
  double volume;  ///< m³, of all of them
};

/// Random vector in the unit ball.
Vec3 in_ball(Random& random) {
  while (true) {
    Vec3 v = random.in_box(Vec3::Constant(-1.0), Vec3::Constant(1.0));
    if (v.squaredNorm() <= 1.0) return v;
  }
}

/// Before they are listed, so that few small grains in a large space do not take all memory.
void refuse_too_many_sites(const GrainSettings& settings, const Box& box, double spacing) {
  constexpr double kMostSites = 1e8;  // 2.4 GB
  const Vec3 size = (box.upper - box.lower).cwiseMax(0.0);
  // Of a face-centred cubic lattice there are sqrt(2) in the cube of the spacing, less at the sides.
  const double sites = std::numbers::sqrt2 * (size / spacing).prod();
  if (!(sites > kMostSites)) return;
  throw InputError(fmt::format(
      "{}: placement = \"lattice\" would list about {:.3g} sites, in a box of "
      "{:.4g} m x {:.4g} m x {:.4g} m for a largest radius of {:.4g} m; expected at most {:.0e}; "
      "make the {} smaller, or take placement = \"random\"",
      settings.name, sites, size[0], size[1], size[2], 0.5 * spacing, kMostSites,
      kind_of_space(settings)));
}

/// Places the grains on lattice sites; fewer than asked for if there are not enough.
std::vector<PlacedGrain> place_on_lattice(std::span<const double> diameters, const FreeSpace& space,
                                          const Task& task, Random& random) {
  const Container& container = task.container;
  const double spacing = diameters.front() * (1.0 + kLatticeMargin);
  refuse_too_many_sites(task.settings, container.bounds, spacing);
  std::vector<Vec3> sites = lattice_sites(container.bounds, spacing);
  std::erase_if(sites, [&](const Vec3& site) {
    const double radius = 0.5 * diameters.front();
    return !space.has_room(site, radius) || !container.holds(site, radius);
  });
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
[[noreturn]] void fail(const Task& task, const std::string& attained) {
  const GrainPlacement placement = task.settings.placement;
  const std::string_view easy = placement == GrainPlacement::random ? "a quarter" : "half";
  const std::string_view denser =
      placement == GrainPlacement::random
          ? ", or take placement = \"packed\" or a crystal, placement = \"lattice\", which are "
            "denser"
      : placement == GrainPlacement::packed ? ", or take sieves of more sizes, which are denser"
                                            : "";
  throw DoesNotFit(fmt::format(
      "{}: {} grains of {:.4g} m3 in all (the largest {:.4g} m across) do not fit the {}, "
      "{:.4g} m3, {:.0f} % of which they would fill; {}; make the {} larger ({} filled is easy), "
      "ask for fewer grains, move it away from membranes and planes{}",
      task.settings.name, task.count, task.volume, task.settings.sizes.largest_diameter(),
      name_of_space(task.settings), task.container.volume,
      100.0 * task.volume / task.container.volume, attained, kind_of_space(task.settings), easy,
      denser));
}

/// As in "placed at random, 731 of 1200 found room, filling 38 %".
std::string attained_by(const Task& task, std::span<const PlacedGrain> grains) {
  double volume = 0.0;
  for (const PlacedGrain& grain : grains) volume += ball_volume(grain.radius);
  return fmt::format("{}, {} of {} found room, filling {:.0f} %",
                     task.settings.placement == GrainPlacement::lattice
                         ? "on a lattice"
                         : "placed at random, largest first",
                     grains.size(), task.count, 100.0 * volume / task.container.volume);
}

/// m³, of solids that are asked for.
double expected_volume(const GrainSettings& settings, const Container& container) {
  if (settings.porosity) return (1.0 - *settings.porosity) * container.volume;
  if (const auto* solids = std::get_if<double>(&settings.amount)) return *solids;
  const auto count = static_cast<double>(std::get<std::size_t>(settings.amount));
  // Nothing but a stress is asked for.
  if (count == 0.0) return kUsualSolids * container.volume;
  return count * settings.sizes.mean_volume();
}

/// As many grains as have a volume (m³): chance makes that of few grains of many sizes another than
/// the mean says.
std::vector<double> draw_for(double volume, const SizeCurve& sizes, Random& random) {
  constexpr int kDraws = 8;
  double wanted = volume / sizes.mean_volume();
  std::vector<double> best;
  double least = std::numeric_limits<double>::infinity();
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<double> diameters =
        sizes.draw(static_cast<std::size_t>(std::max(1.0, std::round(wanted))), random);
    const double drawn = volume_of(diameters);
    wanted *= volume / drawn;
    if (std::abs(drawn - volume) >= least) continue;
    least = std::abs(drawn - volume);
    best = std::move(diameters);
  }
  return best;
}

/// As many as are asked for, or of the volume (m³) that is: where a mass or volume is, anew only if
/// the usual number misses it by more than half of the smallest grain.
std::vector<double> draw_sizes(const GrainSettings& settings, double volume, std::size_t count,
                               Random& random) {
  if (settings.porosity) return draw_for(volume, settings.sizes, random);
  std::vector<double> diameters = settings.sizes.draw(count, random);
  const bool is_volume = std::holds_alternative<double>(settings.amount);
  const double half = 0.5 * volume_of(std::span(&diameters.back(), 1));
  if (!is_volume || std::abs(volume_of(diameters) - volume) <= half) return diameters;
  return draw_for(volume, settings.sizes, random);
}

/// Smaller, at random, and then grown.
std::vector<PlacedGrain> pack(const Task& task, std::span<const double> diameters,
                              const Surroundings& surroundings, Random& random,
                              const std::function<void(double)>& tell) {
  std::vector<PlacedGrain> sparse;
  double factor = 1.0;
  for (const double solids : kSparse) {
    factor =
        std::min(1.0, elementary::pow(solids * task.container.volume / task.volume, 1.0 / 3.0));
    std::vector<double> smaller(diameters.begin(), diameters.end());
    for (double& diameter : smaller) diameter *= factor;
    sparse =
        place_at_random(smaller, make_space(task.container, 0.5 * smaller.front(), surroundings),
                        task.container, random, {});
    if (sparse.size() == diameters.size()) break;
  }
  if (sparse.size() < diameters.size()) fail(task, attained_by(task, sparse));
  std::vector<Vec3> centres;
  std::vector<double> radii;
  for (std::size_t i = 0; i < sparse.size(); ++i) {
    centres.push_back(sparse[i].centre);
    radii.push_back(0.5 * diameters[i]);
  }
  SpherePacking packing(std::move(centres), radii, factor, task.container,
                        {surroundings.obstacles, surroundings.planes, surroundings.plane_moduli});
  constexpr double kAnySize = 4.0;  // where the growth ends by itself
  const bool has_grown = packing.grow_to(task.settings.stress ? kAnySize : 1.0, tell);
  if (!has_grown && !task.settings.stress) {
    const double f = packing.factor();
    fail(task,
         fmt::format("packed without friction they jam at a porosity of {:.3f}, with {:.2f} of "
                     "these diameters",
                     1.0 - f * f * f * task.volume / task.container.volume, f));
  }
  if (task.settings.stress &&
      !packing.press_to(*task.settings.stress / surroundings.young_modulus, tell))
    fail(task, fmt::format("packed, they came to {:.4g} Pa instead of {:.4g} Pa",
                           packing.pressure() * surroundings.young_modulus, *task.settings.stress));
  std::vector<PlacedGrain> grains;
  for (std::size_t i = 0; i < radii.size(); ++i)
    grains.push_back(
        {packing.centres()[i], task.settings.stress ? packing.factor() * radii[i] : radii[i]});
  const bool are_in = std::all_of(grains.begin(), grains.end(), [&](const PlacedGrain& grain) {
    return !task.container.is_inside || task.container.is_inside(grain.centre);
  });
  if (!are_in) fail(task, "packed, grains went out through the facets");
  return grains;
}

}  // namespace

std::vector<PlacedGrain> generate_grains(const GrainSettings& settings,
                                         const Surroundings& surroundings,
                                         const std::function<void(double)>& tell) {
  const Container own =
      settings.cylinder ? container_of(*settings.cylinder) : container_of(settings.box);
  const Container& container = surroundings.container ? *surroundings.container : own;
  const double expected = expected_volume(settings, container);
  const double mean = settings.sizes.mean_volume();
  // Before any grain is drawn, so that a slip in a unit does not ask for more grains than fit into
  // memory.
  if (expected > 2.0 * container.volume)
    fail({settings, container, static_cast<std::size_t>(std::min(1e18, expected / mean)), expected},
         "no arrangement of balls can");
  constexpr double kMostGrains = 1e8;
  if (expected > kMostGrains * mean)
    throw InputError(
        fmt::format("{}: the {} would take about {:.3g} grains of these sizes; "
                    "expected at most {:.0e}",
                    settings.name, name_of_space(settings), expected / mean, kMostGrains));
  const auto* given = std::get_if<std::size_t>(&settings.amount);
  const std::size_t count =
      given != nullptr && *given > 0
          ? *given
          : static_cast<std::size_t>(std::max(1.0, std::round(expected / mean)));
  Random random(settings.seed);
  const std::vector<double> diameters = draw_sizes(settings, expected, count, random);
  const Task task{settings, container, diameters.size(), volume_of(diameters)};
  if (settings.placement == GrainPlacement::packed)
    return pack(task, diameters, surroundings, random, tell);
  FreeSpace space = make_space(container, 0.5 * diameters.front(), surroundings);
  std::vector<PlacedGrain> grains =
      settings.placement == GrainPlacement::random
          ? place_at_random(diameters, std::move(space), container, random, tell)
          : place_on_lattice(diameters, space, task, random);
  if (grains.size() < diameters.size()) fail(task, attained_by(task, grains));
  return grains;
}

}  // namespace plekton::apps
