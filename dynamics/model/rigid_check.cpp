// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/model/rigid_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ostream>
#include <vector>

namespace plekton::dynamics {
namespace {

/// Collects what is wrong with the rigid bodies of a scene.
class RigidProblems {
 public:
  RigidProblems(const Scene& scene, std::ostream& text)
      : scene_(scene), text_(text), body_of_(scene.state.size(), -1) {}

  void list_all() {
    for (std::size_t b = 0; b < scene_.rigid_bodies.size(); ++b) list_nodes(b);
    for (std::size_t b = 0; b < scene_.rigid_bodies.size(); ++b) list_reference(b);
    for (std::size_t i = 0; i < scene_.bonds.size(); ++i)
      list_inner("bond", i, scene_.bonds[i].nodes);
    for (std::size_t i = 0; i < scene_.sheet_facets.size(); ++i)
      list_inner("sheet facet", i, scene_.sheet_facets[i].nodes);
  }

 private:
  std::ostream& line(std::size_t body) { return text_ << "rigid body " << body << ": "; }

  bool exists(NodeId node) const {
    return static_cast<std::int32_t>(node) >= 0 && index_of(node) < scene_.state.size();
  }

  bool expect_node(std::size_t body, NodeId node) {
    if (exists(node)) return true;
    line(body) << "there is no node " << static_cast<std::int32_t>(node) << ", only "
               << scene_.state.size() << " nodes\n";
    return false;
  }

  void list_nodes(std::size_t body) {
    if (scene_.rigid_bodies[body].nodes.empty())
      line(body) << "has no nodes; give those of its elements\n";
    for (const NodeId node : scene_.rigid_bodies[body].nodes) {
      if (!expect_node(body, node)) continue;
      std::int32_t& owner = body_of_[index_of(node)];
      if (owner >= 0)
        line(body) << "node " << index_of(node) << " follows rigid body " << owner
                   << " already; a node follows one body, and is named once\n";
      else if (scene_.properties.held[index_of(node)] != Held::everything)
        line(body) << "node " << index_of(node)
                   << " is not held; make the body with Scene::add_rigid_body\n";
      owner = static_cast<std::int32_t>(body);
    }
  }

  void list_reference(std::size_t body) {
    const RigidBody& own = scene_.rigid_bodies[body];
    if (!expect_node(body, own.node)) return;
    const std::size_t i = index_of(own.node);
    const Held held = scene_.properties.held[i];
    if (!is_reference(held) || body_of_[i] >= 0) {
      line(body) << "node " << i << " is no reference node; make the body with "
                 << "Scene::add_rigid_body\n";
      return;
    }
    const Held all = held_with_motions(scene_.properties.held, scene_.loads.motions)[i];
    expect_inertia(body, "mass", scene_.properties.mass[i], holds_translation(all));
    for (int axis = 0; axis < 3; ++axis)
      expect_inertia(body, "moment of inertia", own.moments[axis], holds_rotation(all));
  }

  void expect_inertia(std::size_t body, const char* what, double value, bool is_held) {
    if (std::isfinite(value) && (is_held ? value >= 0.0 : value > 0.0)) return;
    line(body) << "its " << what << " is " << value
               << (is_held ? "; it must be finite and not negative\n"
                           : "; give it a volume and a density, or its mass and inertia\n");
  }

  template <class Nodes>
  void list_inner(const char* kind, std::size_t id, const Nodes& nodes) {
    if (!std::all_of(nodes.begin(), nodes.end(), [&](NodeId node) { return exists(node); })) return;
    const std::int32_t body = body_of_[index_of(nodes[0])];
    const bool is_inner = body >= 0 && std::all_of(nodes.begin(), nodes.end(), [&](NodeId node) {
                            return body_of_[index_of(node)] == body;
                          });
    if (is_inner)
      text_ << kind << ' ' << id << ": lies within rigid body " << body
            << ", where nothing is strained; leave it out\n";
  }

  const Scene& scene_;
  std::ostream& text_;
  std::vector<std::int32_t> body_of_;  // by NodeId, that it follows; -1: none
};

}  // namespace

void list_rigid_problems(const Scene& scene, std::ostream& problems) {
  RigidProblems(scene, problems).list_all();
}

}  // namespace plekton::dynamics
