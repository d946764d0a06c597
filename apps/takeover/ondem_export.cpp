// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/takeover/ondem_export.hpp"

#include "apps/run/body_tables.hpp"
#include "dynamics/output/contact_fields.hpp"
#include "geometry/base/elementary.hpp"
#include "geometry/base/state_archive.hpp"
#include "geometry/version.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <utility>

namespace plekton::apps {
namespace {

using dynamics::OndemBody;
using dynamics::OndemMembrane;
using dynamics::OndemScene;
using geometry::index_of;
using geometry::NodeId;
using geometry::Vec3;

std::int64_t whole(std::size_t number) {
  return static_cast<std::int64_t>(number);
}

/// What is held of a node, without the bit of reference nodes.
std::int64_t blocked(dynamics::Held held) {
  return static_cast<std::int64_t>(held & dynamics::Held::everything);
}

/// A name of letters, digits and underscores, which neither HDF5 nor VTK has a meaning for.
std::string block_name(const std::string& name) {
  std::string block;
  for (const char c : name) block += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return block.empty() ? "grains" : block;
}

/// Of all of them, each its own.
std::vector<std::string> block_names(const std::vector<BuiltGrains>& tables) {
  std::vector<std::string> blocks;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    std::string block = block_name(tables[i].name);
    // Names that differ in signs alone, or are those of other blocks of the file.
    const bool is_taken = block == "Assembly" || block == "contacts" ||
                          block.starts_with("membrane_") ||
                          std::ranges::find(blocks, block) != blocks.end();
    blocks.push_back(is_taken ? fmt::format("{}_grains_{}", block, i) : block);
  }
  return blocks;
}

/// Makes the scene of one simulation.
class Export {
 public:
  Export(const Scenario& scenario, const PreparedRun& prepared)
      : scenario_(scenario),
        built_(prepared.built),
        simulation_(*prepared.simulation),
        tables_(scenario, prepared.built, simulation_) {}

  OndemScene scene(const geometry::StateTree& state) {
    scene_.time = simulation_.time();
    scene_.time_step = simulation_.time_step();
    scene_.iteration = simulation_.steps();
    scene_.gravity = simulation_.gravity();
    scene_.blocks = block_names(built_.grains);
    add_materials();
    add_clumps();
    add_spheres();
    scene_.has_additions = true;
    scene_.writer = fmt::format("Plekton {}", kVersion);
    double last_step = 0.0;
    geometry::StateArchive::reader(state).group("step")("last_drift", last_step);
    scene_.velocity_time = scene_.time - 0.5 * last_step;
    add_membranes();
    add_planes();
    add_contacts();
    scene_.state = state;
    return std::move(scene_);
  }

 private:
  void add_materials() {
    for (std::size_t i = 0; i < scenario_.materials.size(); ++i) {
      const MaterialSettings& material = scenario_.materials[i];
      scene_.materials.push_back(
          {whole(i), material.name, material.density.value_or(dynamics::kNoNumber),
           material.young_modulus, material.stiffness_ratio * material.young_modulus,
           elementary::tan(material.friction_angle), material.poisson_ratio});
    }
  }

  /// What a node has of a body's motion.
  OndemBody body_at(NodeId node) const {
    const dynamics::NodeState& state = simulation_.state();
    const std::size_t n = index_of(node);
    OndemBody body;
    body.position = state.position[n];
    body.velocity = state.velocity[n];
    body.angular_velocity = state.angular_velocity[n];
    body.orientation = state.orientation[n];
    body.blocked_dofs = blocked(simulation_.properties().held[n]);
    return body;
  }

  /// Rigid bodies that have spheres, numbered after the spheres.
  void add_clumps() {
    const auto& spheres = simulation_.elements().spheres;
    std::vector<char> is_sphere(simulation_.state().size(), 0);
    for (const geometry::Sphere& sphere : spheres) is_sphere[index_of(sphere.nodes[0])] = 1;
    clump_of_.assign(simulation_.state().size(), nullptr);
    for (const dynamics::RigidBody& rigid : simulation_.scene().rigid_bodies) {
      const auto member = std::ranges::find_if(
          rigid.nodes, [&](NodeId node) { return is_sphere[index_of(node)] != 0; });
      if (member == rigid.nodes.end() || !simulation_.scene().is_there(*member)) continue;
      OndemBody clump = body_at(rigid.node);
      clump.id = whole(spheres.size() + clumps_.size());
      clump.block = static_cast<std::size_t>(tables_.groups()[index_of(*member)]);
      clump.shape = dynamics::OndemShape::clump;
      clump.mass = simulation_.properties().mass[index_of(rigid.node)];
      clump.moments = rigid.moments;
      clumps_[clump.id] = clump;
      for (const NodeId node : rigid.nodes) clump_of_[index_of(node)] = &clumps_[clump.id];
    }
  }

  void add_spheres() {
    const dynamics::NodeProperties& properties = simulation_.properties();
    const auto& spheres = simulation_.elements().spheres;
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      const std::size_t node = index_of(spheres[i].nodes[0]);
      if (!simulation_.scene().is_there(spheres[i].nodes[0])) continue;
      OndemBody body = body_at(spheres[i].nodes[0]);
      body.id = whole(i);
      body.block = static_cast<std::size_t>(tables_.groups()[node]);
      body.material = tables_.materials()[node];
      body.radius = spheres[i].radius;
      body.volume = geometry::volume(spheres[i]);
      if (const OndemBody* const clump = clump_of_[node]) {
        set_place(*clump, body);
      } else {
        body.mass = properties.mass[node];
        body.moments = Vec3::Constant(properties.inertia[node]);
      }
      scene_.bodies.push_back(body);
    }
    for (const auto& [id, clump] : clumps_) scene_.bodies.push_back(clump);
  }

  /// Its mass is the clump's.
  static void set_place(const OndemBody& clump, OndemBody& member) {
    const geometry::Quat turn = clump.orientation.conjugate() * member.orientation;
    member.clump = clump.id;
    member.place_in_clump = clump.orientation.conjugate() * (member.position - clump.position);
    member.turn_in_clump = {turn.w(), turn.x(), turn.y(), turn.z()};
  }

  void add_membranes() {
    membrane_of_.assign(simulation_.state().size(), -1);
    for (std::size_t i = 0; i < built_.membranes.size(); ++i) {
      const BuiltMembrane& built = built_.membranes[i];
      if (scenario_.membranes[i].is_absent) continue;
      std::fill_n(membrane_of_.begin() + static_cast<std::ptrdiff_t>(built.first_node), built.nodes,
                  whole(scene_.membranes.size()));
      scene_.membranes.push_back(membrane(i));
    }
    for (const geometry::Facet& facet : simulation_.elements().facets) {
      OndemMembrane* const of = membrane_at(facet.nodes[0]);
      if (of == nullptr) continue;
      of->facets.push_back(nodes_in(*of, facet.nodes));
      of->facet_radius.push_back(facet.radius);
    }
    for (const geometry::Cylinder& cylinder : simulation_.elements().cylinders) {
      OndemMembrane* const of = membrane_at(cylinder.nodes[0]);
      if (of == nullptr) continue;
      of->cylinders.push_back(nodes_in(*of, cylinder.nodes));
      of->cylinder_radius.push_back(cylinder.radius);
    }
  }

  /// With its nodes.
  OndemMembrane membrane(std::size_t number) const {
    const BuiltMembrane& built = built_.membranes[number];
    OndemMembrane result;
    result.name = built.name;
    result.material = whole(scenario_.membranes[number].material);
    result.first_node = whole(built.first_node);
    result.is_rigid = built.is_rigid;
    const dynamics::NodeState& state = simulation_.state();
    for (std::size_t n = built.first_node; n < built.first_node + built.nodes; ++n) {
      result.position.push_back(state.position[n]);
      result.velocity.push_back(state.velocity[n]);
      result.angular_velocity.push_back(state.angular_velocity[n]);
      result.orientation.push_back(state.orientation[n]);
      result.mass.push_back(simulation_.properties().mass[n]);
      result.blocked_dofs.push_back(blocked(simulation_.properties().held[n]));
    }
    return result;
  }

  OndemMembrane* membrane_at(NodeId node) {
    const std::int64_t number = membrane_of_[index_of(node)];
    return number < 0 ? nullptr : &scene_.membranes[static_cast<std::size_t>(number)];
  }

  template <std::size_t size>
  static std::array<std::int64_t, size> nodes_in(const OndemMembrane& membrane,
                                                 const std::array<NodeId, size>& nodes) {
    std::array<std::int64_t, size> numbers;
    for (std::size_t i = 0; i < size; ++i)
      numbers[i] = whole(index_of(nodes[i])) - membrane.first_node;
    return numbers;
  }

  void add_planes() {
    for (std::size_t i = 0; i < simulation_.planes().size(); ++i) {
      const contact::Plane& plane = simulation_.planes()[i];
      scene_.planes.push_back({scenario_.planes[i].name, plane.point, plane.direction(),
                               plane.velocity, whole(scenario_.planes[i].material), plane.radius,
                               plane.turning()});
    }
  }

  using Pair = std::pair<NodeId, NodeId>;  // lower node first

  /// Of all touching spheres, by their nodes.
  std::map<Pair, contact::PairStiffness> stiffnesses() const {
    std::map<Pair, contact::PairStiffness> found;
    simulation_.contacts().for_each_sphere_pair(
        [&](NodeId a, NodeId b, const contact::PairSprings& springs, double gap) {
          found[std::minmax(a, b)] = springs.stiffness(gap);
        });
    return found;
  }

  void add_contacts() {
    const std::vector<contact::ContactRecord> records = simulation_.list_contacts();
    const auto stiffness = stiffnesses();
    for (const contact::ContactRecord& record : records) {
      scene_.contact_lines.push_back({record.point_a, record.point_b});
      if (record.a.kind != contact::BodyKind::sphere || record.b.kind != contact::BodyKind::sphere)
        continue;
      dynamics::OndemContact contact{record.a.index,
                                     record.b.index,
                                     record.normal,
                                     -record.normal_force.dot(record.normal),
                                     record.tangential_force,
                                     record.point,
                                     -record.gap};
      const auto& spheres = simulation_.elements().spheres;
      const auto found =
          stiffness.find(std::minmax(spheres[static_cast<std::size_t>(record.a.index)].nodes[0],
                                     spheres[static_cast<std::size_t>(record.b.index)].nodes[0]));
      if (found != stiffness.end()) {
        contact.normal_stiffness = found->second.normal;
        contact.shear_stiffness = found->second.tangential;
      }
      scene_.contacts.push_back(contact);
    }
    add_fields(records);
  }

  /// The columns of contacts.csv, but for the tables of the scenario.
  void add_fields(const std::vector<contact::ContactRecord>& records) {
    using Field = dynamics::ContactField;
    for (const Field& field : dynamics::contact_fields()) {
      geometry::StateArray array;
      if (const auto* const whole_number = std::get_if<Field::Whole>(&field.value)) {
        std::vector<std::int64_t> values;
        for (const auto& record : records) values.push_back((*whole_number)(record));
        array = {std::move(values), 1};
      } else if (!std::holds_alternative<Field::Label>(field.value)) {
        std::vector<double> values;
        const auto* const vector = std::get_if<Field::Vector>(&field.value);
        for (const auto& record : records) {
          if (vector == nullptr) {
            values.push_back(std::get<Field::Number>(field.value)(record));
            continue;
          }
          const Vec3 v = (*vector)(record);
          values.insert(values.end(), v.data(), v.data() + 3);
        }
        array = {std::move(values), vector == nullptr ? std::size_t{1} : std::size_t{3}};
      } else {
        continue;
      }
      scene_.contact_fields.push_back(
          {std::string(field.name), std::string(field.unit), std::move(array)});
    }
  }

  const Scenario& scenario_;
  const BuiltScene& built_;
  dynamics::Simulation& simulation_;
  BodyTables tables_;
  OndemScene scene_;
  std::map<std::int64_t, OndemBody> clumps_;  ///< by id
  std::vector<const OndemBody*> clump_of_;    ///< by node; none: it follows no clump
  std::vector<std::int64_t> membrane_of_;     ///< by node, place in the scene; -1: none
};

}  // namespace

OndemScene ondem_scene_of(const Scenario& scenario, const PreparedRun& prepared,
                          const geometry::StateTree& state) {
  return Export(scenario, prepared).scene(state);
}

}  // namespace plekton::apps
