// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/output/scene_frame.hpp"

#include "dynamics/output/frame_fields.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace plekton::dynamics {
namespace {

using geometry::Cylinder;
using geometry::Facet;
using geometry::index_of;
using geometry::NodeId;
using geometry::Vec3;

/// Scalars in single precision: value(i) for i in [0, count).
template <class Value>
DataArray scalars(const OutputField& field, std::size_t count, Value value) {
  std::vector<float> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = static_cast<float>(value(i));
  return {std::string(field.name), 1, std::move(values)};
}

/// Vectors in single precision: value(i) for i in [0, count).
template <class Value>
DataArray vectors(const OutputField& field, std::size_t count, Value value) {
  std::vector<float> values;
  values.reserve(3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3& vector = value(i);
    for (int axis = 0; axis < 3; ++axis) values.push_back(static_cast<float>(vector[axis]));
  }
  return {std::string(field.name), 3, std::move(values)};
}

DataArray labels(const OutputField& field, std::vector<std::int32_t> values) {
  return {std::string(field.name), 1, std::move(values)};
}

void require_one_each(std::string_view what, std::size_t got, std::size_t count,
                      std::string_view bodies) {
  if (got == count) return;
  std::ostringstream text;
  text << "frame: " << got << ' ' << what << " for " << count << ' ' << bodies
       << "; give one for each";
  throw std::invalid_argument(text.str());
}

/// The results every node has, for a choice of nodes.
std::vector<DataArray> node_results(const NodesView& nodes, std::span<const NodeId> chosen) {
  const auto results = [&](const OutputField& field, std::span<const Vec3> values) {
    require_one_each(field.name, values.size(), nodes.position.size(), "nodes");
    return vectors(field, chosen.size(),
                   [&](std::size_t i) -> const Vec3& { return values[index_of(chosen[i])]; });
  };
  std::vector<DataArray> arrays;
  arrays.push_back(results(frame_fields::kVelocity, nodes.velocity));
  arrays.push_back(results(frame_fields::kSpin, nodes.angular_velocity));
  arrays.push_back(results(frame_fields::kForce, nodes.force));
  return arrays;
}

std::vector<Vec3> positions_of(const NodesView& nodes, std::span<const NodeId> chosen) {
  std::vector<Vec3> positions;
  positions.reserve(chosen.size());
  for (const NodeId node : chosen) positions.push_back(nodes.position[index_of(node)]);
  return positions;
}

/// The nodes of the elements, ascending, each once.
std::vector<NodeId> used_nodes(const SurfaceView& surface) {
  std::vector<char> used(surface.nodes.position.size(), 0);
  for (const Cylinder& cylinder : surface.cylinders) {
    for (const NodeId node : cylinder.nodes) used[index_of(node)] = 1;
  }
  for (const Facet& facet : surface.facets) {
    for (const NodeId node : facet.nodes) used[index_of(node)] = 1;
  }
  std::vector<NodeId> nodes;
  for (std::size_t node = 0; node < used.size(); ++node) {
    if (used[node]) nodes.push_back(geometry::id_at<NodeId>(node));
  }
  return nodes;
}

/// Tension (N) of the cylinder between two nodes.
class SideTension {
 public:
  explicit SideTension(const SurfaceView& surface) {
    sides_.reserve(surface.cylinders.size());
    for (std::size_t i = 0; i < surface.cylinders.size(); ++i) {
      const auto& nodes = surface.cylinders[i].nodes;
      sides_.push_back({std::minmax(nodes[0], nodes[1]), surface.tension[i]});
    }
    std::sort(sides_.begin(), sides_.end());
  }

  /// Mean over the sides that are cylinders; 0 if none is.
  double mean(const Facet& facet) const {
    double sum = 0.0;
    int count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Pair nodes = std::minmax(facet.nodes[k], facet.nodes[(k + 1) % 3]);
      const auto side = std::lower_bound(sides_.begin(), sides_.end(), nodes,
                                         [](const auto& a, const Pair& b) { return a.first < b; });
      if (side == sides_.end() || side->first != nodes) continue;
      sum += side->second;
      ++count;
    }
    return count > 0 ? sum / count : 0.0;
  }

 private:
  using Pair = std::pair<NodeId, NodeId>;  // lower node first
  std::vector<std::pair<Pair, double>> sides_;
};

/// Lines and triangles over the points that stand for the nodes.
void add_cells(const SurfaceView& surface, std::span<const NodeId> nodes, PolyData& data) {
  std::vector<std::int32_t> point_of(surface.nodes.position.size(), -1);
  for (std::size_t point = 0; point < nodes.size(); ++point) {
    point_of[index_of(nodes[point])] = static_cast<std::int32_t>(point);
  }
  const auto point = [&](NodeId node) { return point_of[index_of(node)]; };
  for (const auto& [ends, radius] : surface.cylinders)
    data.lines.add({point(ends[0]), point(ends[1])});
  for (const auto& [corners, radius] : surface.facets) {
    data.polygons.add({point(corners[0]), point(corners[1]), point(corners[2])});
  }
}

/// What a line and a facet have of something that only one of them may have.
template <class OfLine, class OfFacet>
DataArray cell_scalars(const OutputField& field, const SurfaceView& surface, OfLine of_line,
                       OfFacet of_facet) {
  const std::size_t lines = surface.cylinders.size();
  return scalars(field, lines + surface.facets.size(),
                 [&](std::size_t i) { return i < lines ? of_line(i) : of_facet(i - lines); });
}

constexpr auto kNothing = [](std::size_t) { return 0.0; };

void add_stresses(const SurfaceView& surface, PolyData& data) {
  require_one_each("stresses", surface.stresses.size(), surface.cylinders.size(), "cylinders");
  const auto add = [&](const OutputField& field, double BondStress::*which) {
    data.cell_arrays.push_back(cell_scalars(
        field, surface, [&](std::size_t i) { return surface.stresses[i].*which; }, kNothing));
  };
  add(frame_fields::kAxialStress, &BondStress::axial);
  add(frame_fields::kBendingStress, &BondStress::bending);
  add(frame_fields::kTorsionStress, &BondStress::torsion);
}

void add_membrane_forces(const SurfaceView& surface, PolyData& data) {
  require_one_each("membrane forces", surface.membrane_forces.size(), surface.facets.size(),
                   "facets");
  const auto add = [&](const OutputField& field, double PrincipalForces::*which) {
    data.cell_arrays.push_back(cell_scalars(field, surface, kNothing, [&](std::size_t i) {
      return surface.membrane_forces[i].*which;
    }));
  };
  add(frame_fields::kLargest, &PrincipalForces::largest);
  add(frame_fields::kSmallest, &PrincipalForces::smallest);
}

void add_tractions(const SurfaceView& surface, PolyData& data) {
  require_one_each("tractions", surface.tractions.size(), surface.facets.size(), "facets");
  const std::size_t lines = surface.cylinders.size();
  data.cell_arrays.push_back(
      cell_scalars(frame_fields::kPressure, surface, kNothing,
                   [&](std::size_t i) { return surface.tractions[i].pressure; }));
  data.cell_arrays.push_back(vectors(frame_fields::kShear, data.cell_count(), [&](std::size_t i) {
    return i < lines ? Vec3(Vec3::Zero()) : surface.tractions[i - lines].shear;
  }));
}

void add_labels(const SurfaceView& surface, PolyData& data) {
  const auto add = [&](const OutputField& field, std::span<const std::int32_t> of_nodes) {
    if (of_nodes.empty()) return;
    std::vector<std::int32_t> values;
    values.reserve(data.cell_count());
    for (const Cylinder& cylinder : surface.cylinders)
      values.push_back(of_nodes[index_of(cylinder.nodes[0])]);
    for (const Facet& facet : surface.facets) values.push_back(of_nodes[index_of(facet.nodes[0])]);
    data.cell_arrays.push_back(labels(field, std::move(values)));
  };
  add(frame_fields::kMembrane, surface.nodes.group);
  add(frame_fields::kMaterial, surface.nodes.material);
}

void add_cell_arrays(const SurfaceView& surface, PolyData& data) {
  const SideTension side_tension(surface);
  data.cell_arrays.push_back(cell_scalars(
      frame_fields::kRadius, surface, [&](std::size_t i) { return surface.cylinders[i].radius; },
      [&](std::size_t i) { return surface.facets[i].radius; }));
  data.cell_arrays.push_back(cell_scalars(
      frame_fields::kTension, surface, [&](std::size_t i) { return surface.tension[i]; },
      [&](std::size_t i) { return side_tension.mean(surface.facets[i]); }));
  if (!surface.stresses.empty()) add_stresses(surface, data);
  if (!surface.membrane_forces.empty()) add_membrane_forces(surface, data);
  if (!surface.tractions.empty()) add_tractions(surface, data);
  add_labels(surface, data);
}

}  // namespace

PolyData grains_frame(const GrainsView& grains, double time) {
  const std::size_t count = grains.spheres.size();
  require_one_each("ids", grains.id.size(), count, "spheres");
  std::vector<NodeId> nodes(count);
  PolyData data;
  for (std::size_t i = 0; i < count; ++i) {
    nodes[i] = grains.spheres[i].nodes[0];
    data.vertices.add({static_cast<std::int32_t>(i)});
  }
  data.time = time;
  data.points = positions_of(grains.nodes, nodes);
  data.point_arrays = node_results(grains.nodes, nodes);
  data.point_arrays.insert(data.point_arrays.begin(),
                           scalars(frame_fields::kRadius, count,
                                   [&](std::size_t i) { return grains.spheres[i].radius; }));
  data.point_arrays.push_back({std::string(frame_fields::kId.name), 1,
                               std::vector<std::int64_t>(grains.id.begin(), grains.id.end())});
  const auto add_labels = [&](const OutputField& field, std::span<const std::int32_t> of_nodes) {
    if (of_nodes.empty()) return;
    std::vector<std::int32_t> values;
    for (const NodeId node : nodes) values.push_back(of_nodes[index_of(node)]);
    data.point_arrays.push_back(labels(field, std::move(values)));
  };
  add_labels(frame_fields::kGrains, grains.nodes.group);
  add_labels(frame_fields::kMaterial, grains.nodes.material);
  return data;
}

PolyData surface_frame(const SurfaceView& surface, double time) {
  require_one_each("tensions", surface.tension.size(), surface.cylinders.size(), "cylinders");
  const std::vector<NodeId> nodes = used_nodes(surface);
  PolyData data;
  data.time = time;
  data.points = positions_of(surface.nodes, nodes);
  add_cells(surface, nodes, data);

  data.point_arrays = node_results(surface.nodes, nodes);
  std::vector<std::int32_t> ids(nodes.size());
  std::transform(nodes.begin(), nodes.end(), ids.begin(),
                 [](NodeId node) { return static_cast<std::int32_t>(node); });
  data.point_arrays.push_back({std::string(frame_fields::kNode.name), 1, std::move(ids)});
  add_cell_arrays(surface, data);
  return data;
}

PolyData contacts_frame(std::span<const contact::ContactRecord> contacts, double time,
                        std::span<const ContactLabels> labels_of) {
  const std::size_t count = contacts.size();
  PolyData data;
  data.time = time;
  data.points.reserve(2 * count);
  for (const contact::ContactRecord& contact : contacts) {
    const auto first = static_cast<std::int32_t>(data.points.size());
    data.points.push_back(contact.point_a);
    data.points.push_back(contact.point_b);
    data.lines.add({first, first + 1});
  }
  for (const ContactField& field : contact_fields()) {
    if (const auto* vector = std::get_if<ContactField::Vector>(&field.value)) {
      data.cell_arrays.push_back(
          vectors(field, count, [&](std::size_t i) { return (*vector)(contacts[i]); }));
    } else if (const auto* number = std::get_if<ContactField::Number>(&field.value)) {
      data.cell_arrays.push_back(
          scalars(field, count, [&](std::size_t i) { return (*number)(contacts[i]); }));
    } else if (const auto* label = std::get_if<ContactField::Label>(&field.value)) {
      if (labels_of.size() != count) continue;
      std::vector<std::int32_t> values(count);
      std::transform(labels_of.begin(), labels_of.end(), values.begin(),
                     [&](const ContactLabels& contact) { return contact.**label; });
      data.cell_arrays.push_back(labels(field, std::move(values)));
    } else {
      const auto whole = std::get<ContactField::Whole>(field.value);
      std::vector<std::int64_t> values(count);
      std::transform(contacts.begin(), contacts.end(), values.begin(), whole);
      data.cell_arrays.push_back({std::string(field.name), 1, std::move(values)});
    }
  }
  return data;
}

}  // namespace plekton::dynamics
