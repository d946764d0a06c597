// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/read_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plekton::apps {
namespace {

constexpr std::int64_t kMostGrains = 100'000'000;
constexpr double kWholeTolerance = 1e-9;  // of a passing share: what sums of percentages are off by

/// The rows of a sieve table; empty after a problem.
std::vector<Sieve> read_sieves(Section& section) {
  std::vector<Sieve> sieves;
  bool broken = false;
  for (Section& row : section.tables("sieves")) {
    const Sieve sieve{row.quantity("sieve", {kLength, kPositive}),
                      row.quantity("passing", {kNumber, kFraction})};
    row.finish();
    const auto complain = [&](std::string_view key, const std::string& what) {
      row.complain(key, what);
      broken = true;
    };
    if (std::isnan(sieve.size) || std::isnan(sieve.passing)) broken = true;
    if (!sieves.empty() && sieve.size <= sieves.back().size) {
      complain("sieve",
               fmt::format(
                   "{} m is not above {} m of the row before; list the sieves from small to large",
                   sieve.size, sieves.back().size));
    }
    if (!sieves.empty() && sieve.passing < sieves.back().passing) {
      complain("passing",
               fmt::format("{} is below {} of the row before; a larger sieve lets no less pass",
                           sieve.passing, sieves.back().passing));
    }
    sieves.push_back(sieve);
  }
  if (broken) return {};
  if (sieves.size() < 2) {
    section.complain("sieves", fmt::format("got {} rows; expected at least two", sieves.size()));
    return {};
  }
  if (sieves.front().passing != 0.0 || std::abs(sieves.back().passing - 1.0) > kWholeTolerance) {
    section.complain("sieves", fmt::format("passing goes from {} to {}; expected from 0 (nothing "
                                           "is smaller) to 1 (nothing is larger)",
                                           sieves.front().passing, sieves.back().passing));
    return {};
  }
  return sieves;
}

/// Each grain has a radius of its own.
/// @returns what nobody asks for
SizeCurve refuse_sizes_beside_radii(Section& section) {
  if (!section.has("centres"))
    section.complain("radii",
                     "goes with centres, a radius for each of them; give radius or sieves");
  for (const std::string_view key : {"radius", "sieves", "passing_by"}) {
    if (section.has(key))
      section.complain(key, "radii says how large each grain is; leave one of them out");
  }
  return SizeCurve(1.0);
}

/// From the keys radius, or sieves and passing_by; or none of them beside radii.
SizeCurve read_sizes(Section& section) {
  constexpr std::array<std::string_view, 2> kWords = {"mass", "number"};
  const bool has_radius = section.has("radius");
  const bool has_sieves = section.has("sieves");
  const bool has_passing_by = section.has("passing_by");
  if (section.has("radii")) return refuse_sizes_beside_radii(section);
  if (has_radius == has_sieves) {
    section.complain(has_radius ? "radius" : "sieves",
                     fmt::format("got {} of radius and sieves; expected exactly one of them",
                                 has_radius ? "both" : "none"));
  }
  double radius = 1.0;
  if (has_radius) radius = section.quantity("radius", {kLength, kPositive});
  if (has_passing_by && !has_sieves)
    section.complain("passing_by", "goes with sieves only; there are none");
  const auto by = static_cast<PassingBy>(section.choice("passing_by", kWords, 0));
  if (!has_sieves) return SizeCurve(2.0 * radius);
  const std::vector<Sieve> sieves = read_sieves(section);
  if (sieves.empty()) return SizeCurve(1.0);
  const SizeCurve curve(sieves, by);
  if (std::isnormal(curve.mean_volume())) return curve;
  section.complain("sieves", fmt::format("sizes from {} to {} m are too extreme to compute with",
                                         sieves.front().size, sieves.back().size));
  return SizeCurve(1.0);
}

/// Complains about a volume of solids (m3) that makes more grains than may be.
void require_few_enough(Section& section, std::string_view key, double volume,
                        const SizeCurve& sizes) {
  const double count = volume / sizes.mean_volume();
  if (!(count > static_cast<double>(kMostGrains))) return;
  section.complain(key, fmt::format("makes about {:.3g} grains of these sizes; expected at most {}",
                                    count, kMostGrains));
}

/// From one of the keys count, mass and volume.
std::variant<std::size_t, double> read_amount(Section& section, std::optional<double> density,
                                              const SizeCurve& sizes) {
  constexpr std::array<std::string_view, 3> kKeys = {"count", "mass", "volume"};
  const auto given = std::count_if(kKeys.begin(), kKeys.end(),
                                   [&](std::string_view key) { return section.has(key); });
  if (given != 1)
    section.complain(
        "count", fmt::format("got {} of {}; expected exactly one of them", given, listed(kKeys)));
  std::variant<std::size_t, double> amount{std::size_t{1}};
  if (section.has("mass")) {
    const double mass = section.quantity("mass", {kMass, kPositive});
    amount = mass / density.value_or(1.0);
    if (density) require_few_enough(section, "mass", mass / *density, sizes);
  }
  if (section.has("volume")) {
    const double volume = section.quantity("volume", {kVolume, kPositive});
    amount = volume;
    require_few_enough(section, "volume", volume, sizes);
  }
  if (section.has("count"))
    amount = static_cast<std::size_t>(section.integer("count", 1, kMostGrains));
  return amount;
}

/// The corners of the space in which grains are placed.
geometry::Box read_space(Section& section) {
  if (const auto box = section.table("box")) return read_box(*box);
  if (!section.has("box"))
    section.complain("box",
                     "missing; expected the corners of the space for the grains, box = { min = "
                     "[...], max = [...] }, or the place of each, centres = [[x, y, z], ...]");
  return {Vec3::Zero(), Vec3::Zero()};
}

GrainPlacement read_placement(Section& section) {
  constexpr std::array<std::string_view, 2> kWords = {"random", "lattice"};
  return static_cast<GrainPlacement>(section.choice("placement", kWords, 0));
}

std::uint64_t read_seed(Section& section, const Known& known, std::size_t number) {
  section.tell_default("seed", "that of [simulation] + N");
  const auto seed = section.integer("seed", 0, std::numeric_limits<std::int64_t>::max(),
                                    static_cast<std::int64_t>(known.seed));
  return static_cast<std::uint64_t>(seed) + (section.has("seed") ? 0 : number);
}

/// The places of all grains, without what says how they would be placed.
std::vector<Vec3> read_centres(Section& section) {
  for (const std::string_view key :
       {"count", "mass", "volume", "box", "placement", "seed", "sieves", "passing_by"}) {
    if (section.has(key))
      section.complain(key,
                       "centres says where each grain is, and how many there are; leave one "
                       "of them out");
  }
  std::vector<Vec3> centres = section.vectors("centres", {kLength}, 1);
  std::vector<Vec3> sorted = centres;
  const auto before = [](const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  };
  std::sort(sorted.begin(), sorted.end(), before);
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end())
    section.complain("centres", fmt::format("two grains are at ({}, {}, {}) m; expected a place of "
                                            "its own for each",
                                            (*twice)[0], (*twice)[1], (*twice)[2]));
  return centres;
}

}  // namespace

GrainSettings read_grains(Section section, const Known& known, std::size_t number) {
  GrainSettings grains;
  section.tell_default("name", "grains N");
  grains.name = section.name("name", fmt::format("grains {}", number));
  grains.place = section.place();
  std::optional<double> density;
  if (const auto material = read_material_of(section, known)) {
    grains.material = *material;
    density = known.materials[*material].density;
    if (!density) {
      section.complain("material", fmt::format("material \"{}\" has no density, which grains need",
                                               known.materials[*material].name));
    }
  }
  grains.sizes = read_sizes(section);
  if (section.has("centres")) {
    grains.centres = read_centres(section);
    if (section.has("radii"))
      grains.radii = section.quantities("radii", {kLength, kPositive}, grains.centres.size());
  } else {
    grains.amount = read_amount(section, density, grains.sizes);
    grains.box = read_space(section);
    grains.placement = read_placement(section);
    grains.seed = read_seed(section, known, number);
  }
  grains.velocity = section.vector("velocity", {kVelocity}, grains.velocity);
  grains.angular_velocity =
      section.vector("angular_velocity", {kAngularVelocity}, grains.angular_velocity);
  section.finish();
  return grains;
}

}  // namespace plekton::apps
