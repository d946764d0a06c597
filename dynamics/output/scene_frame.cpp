// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/output/scene_frame.hpp"

#include <algorithm>
#include <array>
#include <cassert>
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
DataArray scalars(std::string name, std::size_t count, Value value) {
  std::vector<float> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = static_cast<float>(value(i));
  return {std::move(name), 1, std::move(values)};
}

/// Vectors in single precision: value(i) for i in [0, count).
template <class Value>
DataArray vectors(std::string name, std::size_t count, Value value) {
  std::vector<float> values;
  values.reserve(3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3& vector = value(i);
    for (int axis = 0; axis < 3; ++axis) values.push_back(static_cast<float>(vector[axis]));
  }
  return {std::move(name), 3, std::move(values)};
}

/// The results every node has, for a choice of nodes.
std::vector<DataArray> node_results(const NodesView& nodes, std::span<const NodeId> chosen) {
  const auto results = [&](std::string name, std::span<const Vec3> values) {
    assert(values.size() == nodes.position.size() && "one value for each node");
    return vectors(std::move(name), chosen.size(),
                   [&](std::size_t i) -> const Vec3& { return values[index_of(chosen[i])]; });
  };
  std::vector<DataArray> arrays;
  arrays.push_back(results("velocity", nodes.velocity));
  arrays.push_back(results("angular_velocity", nodes.angular_velocity));
  arrays.push_back(results("force", nodes.force));
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

}  // namespace

PolyData grains_frame(const GrainsView& grains, double time) {
  const std::size_t count = grains.spheres.size();
  assert(grains.id.size() == count && "one id for each sphere");
  std::vector<NodeId> nodes(count);
  PolyData data;
  for (std::size_t i = 0; i < count; ++i) {
    nodes[i] = grains.spheres[i].nodes[0];
    data.vertices.add({static_cast<std::int32_t>(i)});
  }
  data.time = time;
  data.points = positions_of(grains.nodes, nodes);
  data.point_arrays = node_results(grains.nodes, nodes);
  data.point_arrays.insert(data.point_arrays.begin(), scalars("radius", count, [&](std::size_t i) {
                             return grains.spheres[i].radius;
                           }));
  data.point_arrays.push_back(
      {"id", 1, std::vector<std::int64_t>(grains.id.begin(), grains.id.end())});
  return data;
}

PolyData surface_frame(const SurfaceView& surface, double time) {
  assert(surface.tension.size() == surface.cylinders.size() && "one tension for each cylinder");
  const std::vector<NodeId> nodes = used_nodes(surface);
  PolyData data;
  data.time = time;
  data.points = positions_of(surface.nodes, nodes);
  add_cells(surface, nodes, data);

  data.point_arrays = node_results(surface.nodes, nodes);
  std::vector<std::int32_t> ids(nodes.size());
  std::transform(nodes.begin(), nodes.end(), ids.begin(),
                 [](NodeId node) { return static_cast<std::int32_t>(node); });
  data.point_arrays.push_back({"node", 1, std::move(ids)});

  const std::size_t lines = surface.cylinders.size();
  const SideTension side_tension(surface);
  data.cell_arrays.push_back(scalars("radius", data.cell_count(), [&](std::size_t i) {
    return i < lines ? surface.cylinders[i].radius : surface.facets[i - lines].radius;
  }));
  data.cell_arrays.push_back(scalars("tension", data.cell_count(), [&](std::size_t i) {
    return i < lines ? surface.tension[i] : side_tension.mean(surface.facets[i - lines]);
  }));
  if (surface.membrane_forces.empty()) return data;
  assert(surface.membrane_forces.size() == surface.facets.size() && "one for each facet");
  const auto add_forces = [&](std::string name, double PrincipalForces::*which) {
    data.cell_arrays.push_back(scalars(std::move(name), data.cell_count(), [&](std::size_t i) {
      return i < lines ? 0.0 : surface.membrane_forces[i - lines].*which;
    }));
  };
  add_forces("membrane_force_largest", &PrincipalForces::largest);
  add_forces("membrane_force_smallest", &PrincipalForces::smallest);
  return data;
}

PolyData contacts_frame(std::span<const ContactRow> contacts, double time) {
  const std::size_t count = contacts.size();
  PolyData data;
  data.time = time;
  data.points.reserve(2 * count);
  for (const ContactRow& contact : contacts) {
    const auto first = static_cast<std::int32_t>(data.points.size());
    data.points.push_back(contact.core_point_a);
    data.points.push_back(contact.core_point_b);
    data.lines.add({first, first + 1});
  }
  const auto add_force = [&](const std::string& name, Vec3 ContactRow::*force) {
    data.cell_arrays.push_back(
        vectors(name, count, [&](std::size_t i) -> const Vec3& { return contacts[i].*force; }));
    data.cell_arrays.push_back(scalars(name + "_magnitude", count,
                                       [&](std::size_t i) { return (contacts[i].*force).norm(); }));
  };
  add_force("normal_force", &ContactRow::normal_force);
  add_force("tangential_force", &ContactRow::tangential_force);
  data.cell_arrays.push_back(scalars("gap", count, [&](std::size_t i) { return contacts[i].gap; }));
  return data;
}

}  // namespace plekton::dynamics
