// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/closest_word.hpp"
#include "apps/scenario/grain_table.hpp"
#include "apps/scenario/read_measure.hpp"
#include "apps/scenario/read_ondem_source.hpp"
#include "apps/scenario/read_sections.hpp"
#include "geometry/base/lexicographic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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

/// From one of the keys count, mass, volume and porosity; or none of them with a stress.
std::variant<std::size_t, double> read_amount(Section& section, std::optional<double> density,
                                              const SizeCurve& sizes) {
  constexpr std::array<std::string_view, 4> kKeys = {"count", "mass", "volume", "porosity"};
  const auto given = std::count_if(kKeys.begin(), kKeys.end(),
                                   [&](std::string_view key) { return section.has(key); });
  const bool may_be_missing = section.has("stress");
  if (given > 1 || (given == 0 && !may_be_missing))
    section.complain(
        "count", fmt::format("got {} of {}; expected exactly one of them", given, listed(kKeys)));
  std::variant<std::size_t, double> amount{std::size_t{given == 0 ? 0U : 1U}};
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

/// The space in which grains are placed.
void read_space(Section& section, GrainSettings& grains) {
  constexpr std::array<std::string_view, 3> kKeys = {"box", "cylinder", "inside"};
  const auto given = std::count_if(kKeys.begin(), kKeys.end(),
                                   [&](std::string_view key) { return section.has(key); });
  if (given == 0)
    section.complain("box",
                     "missing; expected the corners of the space for the grains, box = { min = "
                     "[...], max = [...] }, or a cylinder, a closed membrane to be inside of, the "
                     "place of each, centres = [[x, y, z], ...], or a table of them");
  if (given > 1)
    section.complain(
        section.has("inside") ? "inside" : "cylinder",
        fmt::format("got {} of {}; expected exactly one of them", given, listed(kKeys)));
  if (const auto box = section.optional_table("box")) grains.box = read_box(*box);
  if (const auto cylinder = section.optional_table("cylinder"))
    grains.cylinder = read_cylinder(*cylinder);
  if (section.has("inside")) grains.inside = section.text("inside");
}

void read_porosity(Section& section, GrainSettings& grains) {
  // What spheres leave at least: of equal ones in a crystal 1 - pi / sqrt(18) (Kepler; Hales), in
  // a random packing 0.35, whichever way it is made; 0.36 is common.
  constexpr double kDensestCrystal = 0.2595;
  constexpr double kDensestRandom = 0.35;
  constexpr Range kPorosity{0.0, 1.0, false, false, " above 0 and below 1"};
  if (!section.has("porosity")) return;
  const double porosity = section.quantity("porosity", {kNumber, kPorosity});
  grains.porosity = porosity;
  const bool are_equal = grains.sizes.diameter_at(0.0) == grains.sizes.largest_diameter();
  const double least =
      grains.placement == GrainPlacement::lattice ? kDensestCrystal : kDensestRandom;
  if (are_equal && porosity < least)
    section.complain(
        "porosity",
        fmt::format(
            "got {}; expected at least {} of equal grains, which no {} of spheres goes "
            "below; ask for more, or for sieves of several sizes",
            porosity, least,
            grains.placement == GrainPlacement::lattice ? "arrangement" : "random packing"));
}

void read_stress(Section& section, GrainSettings& grains) {
  if (!section.has("stress")) return;
  grains.stress = section.quantity("stress", {kPressure, kPositive});
  if (grains.placement != GrainPlacement::packed)
    section.complain("stress", "goes with placement = \"packed\": other grains do not touch");
  if (section.has("porosity"))
    section.complain("stress",
                     "got porosity too; without friction one follows from the other: leave one of "
                     "them out (a looser sample comes to a stress by a servo, in a stage)");
}

GrainPlacement read_grain_placement(Section& section) {
  constexpr std::array<std::string_view, 3> kWords = {"random", "lattice", "packed"};
  return static_cast<GrainPlacement>(section.choice("placement", kWords, 0));
}

std::uint64_t read_seed(Section& section, const Known& known, std::size_t number) {
  section.tell_default("seed", "that of [simulation] + N");
  const auto seed = section.integer("seed", 0, std::numeric_limits<std::int64_t>::max(),
                                    static_cast<std::int64_t>(known.seed));
  return static_cast<std::uint64_t>(seed) + (section.has("seed") ? 0 : number);
}

/// Complains about what says how grains would be placed.
/// @param says  the key that tells their places
void refuse_placement(Section& section, std::string_view says) {
  for (const std::string_view key :
       {"count", "mass", "volume", "porosity", "stress", "box", "cylinder", "inside", "placement",
        "seed", "sieves", "passing_by"}) {
    if (section.has(key))
      section.complain(key, fmt::format("{} says where each grain is, and how many there are; "
                                        "leave one of them out",
                                        says));
  }
}

void refuse_equal(Section& section, std::string_view says, const std::vector<Vec3>& centres) {
  std::vector<Vec3> sorted = centres;
  std::sort(sorted.begin(), sorted.end(), geometry::lexicographically_less);
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end())
    section.complain(says, fmt::format("two grains are at ({}, {}, {}) m; expected a place of "
                                       "its own for each",
                                       (*twice)[0], (*twice)[1], (*twice)[2]));
}

/// Complains about what says where grains are and how large, beside a file that does.
/// @param file  the key that names it
void refuse_beside_file(Section& section, std::string_view file) {
  for (const std::string_view key : {"table", "centres", "radius", "radii"}) {
    if (key != file && section.has(key))
      section.complain(key, fmt::format("the file of {} has the places and radii of all grains; "
                                        "leave one of them out",
                                        file));
  }
  refuse_placement(section, file);
}

/// Places, radii and motions from an ON-DEM file.
void read_ondem(Section& section, const Known& known, GrainSettings& grains) {
  refuse_beside_file(section, "ondem");
  read_ondem_grains(section, known, grains);
  refuse_equal(section, "ondem", grains.centres);
  for (const auto& [key, of_each] : {std::pair{"velocity", &grains.velocities},
                                     std::pair{"angular_velocity", &grains.angular_velocities}})
    if (section.has(key)) of_each->clear();
  for (const std::string_view key : {"velocities", "angular_velocities"}) {
    if (section.has(key))
      section.complain(key, "ondem says that of each grain; leave one of them out");
  }
}

/// Places and radii from a file.
void read_table(Section& section, const Known& known, GrainSettings& grains) {
  refuse_beside_file(section, "table");
  const std::string name = section.text("table");
  if (name.empty()) return;
  try {
    GrainTable table = read_grain_table(known.folder / name);
    grains.centres = std::move(table.centres);
    grains.radii = std::move(table.radii);
  } catch (const InputError& error) {
    section.complain("table", error.what());
  }
  refuse_equal(section, "table", grains.centres);
}

/// A vector for each of the centres, instead of one for all; empty if it is not given.
std::vector<Vec3> read_of_each(Section& section, std::string_view each, std::string_view all,
                               const Quantity& expected, std::size_t centres) {
  if (!section.has(each)) return {};
  if (section.has(all))
    section.complain(all, fmt::format("{} says that of each grain; leave one of them out", each));
  std::vector<Vec3> vectors = section.vectors(each, expected, 1);
  if (!section.has("centres"))
    section.complain(each, "goes with centres, one for each of them");
  else if (!vectors.empty() && centres > 0 && vectors.size() != centres)
    section.complain(each, fmt::format("got a list of {}; expected one for each of the {} centres",
                                       vectors.size(), centres));
  return vectors;
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
  const bool has_ondem = section.has("ondem");
  const bool has_file = has_ondem || section.has("table");
  if (has_ondem)
    read_ondem(section, known, grains);
  else if (has_file)
    read_table(section, known, grains);
  else
    grains.sizes = read_sizes(section);
  if (section.has("centres") && !has_file) {
    refuse_placement(section, "centres");
    grains.centres = section.vectors("centres", {kLength}, 1);
    refuse_equal(section, "centres", grains.centres);
    // Of centres that are wrong it is not known how many there are.
    const auto count = grains.centres.empty() ? std::nullopt : std::optional(grains.centres.size());
    if (section.has("radii"))
      grains.radii = section.quantities("radii", {kLength, kPositive}, count);
  } else if (!has_file) {
    grains.placement = read_grain_placement(section);
    grains.amount = read_amount(section, density, grains.sizes);
    read_space(section, grains);
    read_porosity(section, grains);
    read_stress(section, grains);
    grains.seed = read_seed(section, known, number);
  }
  grains.velocity = section.vector("velocity", {kVelocity}, grains.velocity);
  grains.angular_velocity =
      section.vector("angular_velocity", {kAngularVelocity}, grains.angular_velocity);
  if (!has_ondem) {
    grains.velocities =
        read_of_each(section, "velocities", "velocity", {kVelocity}, grains.centres.size());
    grains.angular_velocities = read_of_each(section, "angular_velocities", "angular_velocity",
                                             {kAngularVelocity}, grains.centres.size());
  }
  section.finish();
  return grains;
}

}  // namespace plekton::apps
