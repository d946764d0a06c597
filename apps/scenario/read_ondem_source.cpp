// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/read_ondem_source.hpp"

#include "apps/scenario/closest_word.hpp"
#include "dynamics/ondem/read_ondem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plekton::apps {
namespace {

using dynamics::OndemBody;
using dynamics::OndemMembrane;
using dynamics::OndemScene;
using geometry::NodeId;

/// Nothing after a problem, and where keys are only listed.
std::optional<OndemScene> read_scene(Section& section, const Known& known) {
  const std::string name = section.text("ondem");
  if (name.empty()) return std::nullopt;
  try {
    return dynamics::read_ondem(known.folder / name);
  } catch (const dynamics::OndemError& error) {
    section.complain("ondem", error.what());
    return std::nullopt;
  }
}

/// Position of a name that a key may give; nothing if it gives none, or after a problem.
/// @param what   as in "block"
/// @param known_names  those that there are; nothing where the file could not be read
std::optional<std::size_t> chosen(Section& section, std::string_view key, std::string_view what,
                                  const std::optional<std::vector<std::string>>& known_names) {
  if (!section.has(key)) return std::nullopt;
  const std::string name = section.text(key);
  if (!known_names) return std::nullopt;
  const std::vector<std::string>& names = *known_names;
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  const std::vector<std::string_view> known(names.begin(), names.end());
  if (!name.empty())
    section.complain(key,
                     fmt::format("there is no {} \"{}\" in the file; {}", what, name,
                                 known.empty() ? "it has none" : "there are " + listed(known)));
  return std::nullopt;
}

/// What materials of a file are called: by their labels, or, of other programs, by their numbers.
std::vector<std::string> material_names(const OndemScene& scene) {
  std::vector<std::string> names;
  for (const dynamics::OndemMaterial& material : scene.materials)
    names.push_back(material.label.empty() ? fmt::format("{}", material.id) : material.label);
  return names;
}

/// Of a unit quaternion as another program has it, which drifts off one by rounding.
geometry::Quat unit(const geometry::Quat& q) {
  constexpr double kRounding = 1e-12;
  if (std::abs(q.norm() - 1.0) <= kRounding) return q;
  return q.normalized();
}

void add(const OndemBody& body, GrainSettings& grains) {
  grains.centres.push_back(body.position);
  grains.radii.push_back(body.radius);
  grains.velocities.push_back(body.velocity);
  grains.angular_velocities.push_back(body.angular_velocity);
  grains.orientations.push_back(unit(body.orientation));
}

const OndemMembrane* chosen_membrane(Section& section, const OndemScene& scene) {
  std::vector<std::string> names;
  for (const OndemMembrane& membrane : scene.membranes) names.push_back(membrane.name);
  const auto number = chosen(section, "ondem_membrane", "membrane", names);
  if (number) return &scene.membranes[*number];
  if (section.has("ondem_membrane")) return nullptr;
  if (scene.membranes.size() == 1) return &scene.membranes.front();
  const std::vector<std::string_view> known(names.begin(), names.end());
  section.complain(
      "ondem", names.empty()
                   ? "the file has no membranes; expected one that plekton export-ondem wrote"
                   : fmt::format("the file has {} membranes, {}; say which one with ondem_membrane",
                                 names.size(), listed(known)));
  return nullptr;
}

/// The nodes that still have elements, renamed without gaps.
class UsedNodes {
 public:
  explicit UsedNodes(const OndemMembrane& membrane) : places_(membrane.position.size(), -1) {
    for (const auto& nodes : membrane.facets) use(nodes);
    for (const auto& nodes : membrane.cylinders) use(nodes);
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (places_[i] < 0) continue;
      places_[i] = static_cast<std::int32_t>(nodes_.size());
      nodes_.push_back(i);
    }
  }
  const std::vector<std::size_t>& all() const noexcept { return nodes_; }
  NodeId operator[](std::int64_t node) const {
    return NodeId{places_[static_cast<std::size_t>(node)]};
  }

 private:
  template <class Nodes>
  void use(const Nodes& nodes) {
    for (const std::int64_t node : nodes) places_[static_cast<std::size_t>(node)] = 0;
  }
  std::vector<std::int32_t> places_;
  std::vector<std::size_t> nodes_;
};

using Bar = std::array<NodeId, 2>;

/// Lower node first, ascending, each once.
std::vector<Bar> bars_of(const OndemMembrane& membrane, const UsedNodes& nodes) {
  std::vector<Bar> bars;
  for (const auto& [a, b] : membrane.cylinders)
    bars.push_back({std::min(nodes[a], nodes[b]), std::max(nodes[a], nodes[b])});
  std::ranges::sort(bars);
  bars.erase(std::unique(bars.begin(), bars.end()), bars.end());
  return bars;
}

/// Facets with the bars beside them: their sides are bars anyway.
FacetShape facets_of(const OndemMembrane& membrane, const UsedNodes& nodes) {
  FacetShape shape;
  std::vector<Bar> sides;
  for (const auto& [a, b, c] : membrane.facets) {
    const std::array<NodeId, 3> facet{nodes[a], nodes[b], nodes[c]};
    shape.mesh.facets.push_back(facet);
    for (std::size_t k = 0; k < 3; ++k)
      sides.push_back(
          {std::min(facet[k], facet[(k + 1) % 3]), std::max(facet[k], facet[(k + 1) % 3])});
  }
  std::ranges::sort(sides);
  for (const Bar& bar : bars_of(membrane, nodes))
    if (!std::ranges::binary_search(sides, bar)) shape.bars.push_back(bar);
  for (const std::size_t node : nodes.all()) shape.mesh.points.push_back(membrane.position[node]);
  return shape;
}

geometry::Lattice lattice_of(const OndemMembrane& membrane, const UsedNodes& nodes) {
  geometry::Lattice lattice;
  for (const Bar& bar : bars_of(membrane, nodes))
    lattice.edges.push_back({bar, geometry::LatticePart::link});
  for (const std::size_t node : nodes.all()) lattice.points.push_back(membrane.position[node]);
  return lattice;
}

}  // namespace

void read_ondem_grains(Section& section, const Known& known, GrainSettings& grains) {
  const std::optional<OndemScene> scene = read_scene(section, known);
  // Also without a scene, so that the keys are known.
  const auto block =
      chosen(section, "ondem_block", "block", scene ? std::optional(scene->blocks) : std::nullopt);
  const auto material = chosen(section, "ondem_material", "material",
                               scene ? std::optional(material_names(*scene)) : std::nullopt);
  if (!scene) return;
  std::size_t others = 0;
  for (const OndemBody& body : scene->bodies) {
    if (block && body.block != *block) continue;
    if (material && body.material != scene->materials[*material].id) continue;
    if (body.shape == dynamics::OndemShape::sphere && body.clump == dynamics::kNone)
      add(body, grains);
    else
      ++others;
  }
  if (grains.centres.empty())
    section.complain("ondem",
                     fmt::format("there are no free spheres there, but {} bodies of other shapes "
                                 "and members of clumps, which are left out",
                                 others));
}

void read_ondem_membrane(Section& section, const Known& known, MembraneSettings& membrane) {
  const std::optional<OndemScene> scene = read_scene(section, known);
  if (!scene) {
    chosen(section, "ondem_membrane", "membrane", std::nullopt);
    return;
  }
  const OndemMembrane* const source = chosen_membrane(section, *scene);
  if (source == nullptr) return;
  const UsedNodes nodes(*source);
  if (nodes.all().empty()) {
    section.complain("ondem", fmt::format("nothing is left of membrane \"{}\"", source->name));
    return;
  }
  if (source->facets.empty())
    membrane.shape = lattice_of(*source, nodes);
  else
    membrane.shape = facets_of(*source, nodes);
  for (const std::size_t node : nodes.all())
    membrane.initial_velocities.push_back(source->velocity[node]);
}

}  // namespace plekton::apps
