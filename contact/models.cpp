// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/models.hpp"

#include "contact/scene_contacts.hpp"
#include "geometry/base/problems.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

namespace plekton::contact {
namespace {

/// Writes the lines of some problems, each with a beginning.
void add_lines(std::string_view beginning, const std::string& lines, std::ostream& to) {
  std::istringstream all(lines);
  for (std::string line; std::getline(all, line);) to << beginning << line << '\n';
}

/// @param whose  how lines begin
/// @returns whether there is a law
bool list_law_problems(const AnyLaw::Properties& properties, const std::string& whose,
                       std::ostream& problems) {
  if (properties.law == nullptr) {
    problems << whose << ": there is no law; AnyLaw::of<Law>() makes properties of one\n";
    return false;
  }
  std::ostringstream own;
  AnyLaw::list_problems(properties, own);
  add_lines(whose + ", law " + std::string(properties.law->name) + ": ", own.str(), problems);
  return true;
}

bool list_pair_problems(const PairProperties<AnyLaw>& properties, std::size_t materials,
                        std::ostream& problems) {
  bool has_laws = true;
  for (const auto& [pair, of_pair] : properties) {
    const auto a = static_cast<std::int64_t>(pair.first);
    const auto b = static_cast<std::int64_t>(pair.second);
    const std::string whose =
        "materials " + std::to_string(a) + " and " + std::to_string(b) + " as a pair";
    for (const std::int64_t id : {a, b}) {
      if (id >= 0 && id < static_cast<std::int64_t>(materials)) continue;
      problems << whose << ": there is no material " << id << ", only " << materials
               << " materials\n";
    }
    if (a > b && properties.contains({pair.second, pair.first}))
      problems << whose << ": given in both orders; a pair has one law, give it once\n";
    has_laws &= list_law_problems(of_pair, whose, problems);
  }
  return has_laws;
}

/// Asks for the stiffness of bodies of two materials.
void list_stiffness_problems(const MaterialPairs& pairs, std::size_t a, std::size_t b,
                             std::ostream& problems) {
  constexpr double kRadius = 1.0, kMass = 1.0;  // m, kg
  constexpr double kGap = -1e-3;                // m
  const AnyLaw::Parameters p =
      pairs.combine(BodyPart{geometry::id_at<MaterialId>(a), kRadius, kMass},
                    BodyPart{geometry::id_at<MaterialId>(b), kRadius, kMass});
  const double normal = AnyLaw::normal_stiffness(p, kGap);
  const double tangential = AnyLaw::tangential_stiffness(p, kGap);
  if (std::isfinite(normal) && std::isfinite(tangential)) return;
  problems << "materials " << a << " and " << b << ", law " << p.law->name << ": bodies of radius "
           << kRadius << " m, " << -kGap << " m deep, have the normal stiffness " << normal
           << " N/m and the tangential one " << tangential
           << " N/m; both must be finite: look at the law's functions, and at the numbers of these "
              "materials\n";
}

/// The materials with the least and the largest of each number.
std::set<std::size_t> extreme_materials(const std::vector<Material>& materials) {
  std::set<std::size_t> found;
  for (const auto number : {&Material::young_modulus, &Material::stiffness_ratio,
                            &Material::friction, &Material::poisson_ratio}) {
    const auto [least, most] = std::ranges::minmax_element(materials, {}, number);
    found.insert(static_cast<std::size_t>(least - materials.begin()));
    found.insert(static_cast<std::size_t>(most - materials.begin()));
  }
  return found;
}

/// Asks for the stiffness of bodies of each pair of materials. Of many materials each is asked for
/// with itself and with those of extreme numbers, and pairs that have a law of their own.
void list_stiffness_problems(const MaterialPairs& pairs, const std::vector<Material>& materials,
                             const PairProperties<AnyLaw>& properties, std::ostream& problems) {
  constexpr std::size_t kMany = 100;
  if (materials.size() <= kMany) {
    for (std::size_t a = 0; a < materials.size(); ++a)
      for (std::size_t b = a; b < materials.size(); ++b)
        list_stiffness_problems(pairs, a, b, problems);
    return;
  }
  const std::set<std::size_t> extremes = extreme_materials(materials);
  for (std::size_t a = 0; a < materials.size(); ++a) {
    list_stiffness_problems(pairs, a, a, problems);
    for (const std::size_t b : extremes)
      if (a != b) list_stiffness_problems(pairs, a, b, problems);
  }
  for (const auto& [pair, of_pair] : properties)
    list_stiffness_problems(pairs, index_of(pair.first), index_of(pair.second), problems);
}

/// @throws std::invalid_argument
MaterialPairs checked_pairs(const std::vector<Material>& materials,
                            const PairProperties<AnyLaw>& properties,
                            const AnyLaw::Properties& others) {
  std::ostringstream problems;
  const std::size_t count = materials.size();
  const bool pairs_have_laws = list_pair_problems(properties, count, problems);
  const bool others_have_one = list_law_problems(others, "pairs of materials", problems);
  MaterialPairs pairs(materials, properties, others);
  if (pairs_have_laws && others_have_one && problems.view().empty())
    list_stiffness_problems(pairs, materials, properties, problems);
  geometry::throw_if_any(problems);
  return pairs;
}

}  // namespace

ContactModel linear_frictional() {
  return model_of<LinearFrictional>();
}

ContactModel linear_frictional(const PairProperties<LinearFrictional>& properties) {
  return model_of<LinearFrictional>(properties);
}

ContactModel any_law(const PairProperties<AnyLaw>& properties, const AnyLaw::Properties& others) {
  return [properties, others](ContactScene scene) -> std::unique_ptr<Contacts> {
    return std::make_unique<SceneContacts>(
        scene.spheres, scene.surface,
        ContactMaterials{checked_pairs(scene.materials, properties, others),
                         std::move(scene.of_spheres), std::move(scene.of_structures),
                         std::move(scene.masses)},
        scene.skin, scene.meets_planes, scene.rest, scene.groups);
  };
}

}  // namespace plekton::contact
