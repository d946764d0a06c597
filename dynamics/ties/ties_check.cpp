// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/ties/ties_check.hpp"

#include "dynamics/model/scene.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>

namespace plekton::dynamics {
namespace {

/// Collects what is wrong with the ties of a scene.
class TieProblems {
 public:
  TieProblems(const Scene& scene, std::ostream& text)
      : scene_(scene), text_(text), body_of_(scene.state.size(), -1) {
    for (std::size_t b = 0; b < scene.rigid_bodies.size(); ++b) {
      const auto put = [&](NodeId node) {
        if (exists(node)) body_of_[index_of(node)] = static_cast<std::int32_t>(b);
      };
      put(scene.rigid_bodies[b].node);
      std::ranges::for_each(scene.rigid_bodies[b].nodes, put);
    }
  }

  void list_all() {
    for (std::size_t i = 0; i < scene_.cables.size(); ++i) list(scene_.cables[i], i);
    for (std::size_t i = 0; i < scene_.ties.size(); ++i) {
      name_ = "tie " + std::to_string(i);
      list(scene_.ties[i]);
    }
  }

 private:
  void list(const Cable& cable, std::size_t number) {
    name_ = "cable " + std::to_string(number);
    expect(cable.nodes.size() >= (cable.is_closed ? 3U : 2U),
           "has too few nodes; give two, or three where it is closed");
    for (const NodeId node : cable.nodes) expect_node(node);
    std::vector<NodeId> sorted = cable.nodes;
    std::sort(sorted.begin(), sorted.end());
    expect(std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end(),
           "names a node twice; name each once");
  }

  void list(const Tie& tie) {
    expect_node(tie.node);
    const auto is_size = [](double value) { return std::isfinite(value) && value >= 0.0; };
    expect(is_size(tie.stiffness) && tie.stiffness > 0.0,
           "its stiffness (N/m) must be finite and above 0");
    expect(is_size(tie.rest_length), "its rest length (m) must be finite and not negative");
    expect(tie.strength > 0.0, "its strength (N) must be above 0");
    expect(tie.brake_force > 0.0, "the force (N) of its brake must be above 0");
    expect(tie.stroke >= 0.0, "the stroke (m) of its brake must not be negative");
    expect(is_size(tie.friction) && is_size(tie.slip_force),
           "its friction and slip force (N) must be finite and not negative");
    const bool slides = std::holds_alternative<CablePlace>(tie.to);
    const bool is_brake = tie.brake_force < Tie::kNever;
    expect(!tie.pushes || (!slides && !is_brake),
           "only pulls on a cable or with a brake; set pushes to false");
    expect(!slides || !is_brake, "on a cable has no brake; give it a slip force");
    expect(slides || (tie.friction == 0.0 && tie.slip_force == 0.0),
           "slides on a cable only; leave friction and slip force out");
    std::visit([&](const auto& to) { list(to, tie); }, tie.to);
  }

  void list(const FixedPoint& to, const Tie&) {
    expect(to.place.allFinite(), "the place to which it is tied is not finite");
  }

  void list(const MaterialPoint& to, const Tie& tie) {
    constexpr double kTolerance = 1e-9;  // of the sum of weights
    for (std::size_t k = 0; k < 3; ++k) {
      expect_node(to.nodes[k]);
      expect(to.nodes[k] != tie.node || !(to.weights[static_cast<int>(k)] > 0.0),
             "ties a node to itself");
    }
    expect((to.weights.array() >= 0.0).all() && std::abs(to.weights.sum() - 1.0) < kTolerance,
           "the weights of its point must not be negative, and have the sum 1");
    expect(!are_on_one_body(tie.node, to), "ties a rigid body to itself; tie it to another one");
  }

  bool are_on_one_body(NodeId node, const MaterialPoint& point) const {
    if (!exists(node) || body_of_[index_of(node)] < 0) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(point.weights[static_cast<int>(k)] > 0.0)) continue;
      const bool is_other =
          !exists(point.nodes[k]) || body_of_[index_of(point.nodes[k])] != body_of_[index_of(node)];
      if (is_other) return false;
    }
    return true;
  }

  void list(const CablePlace& to, const Tie& tie) {
    if (to.cable >= scene_.cables.size()) {
      text_ << name_ << ": there is no cable " << to.cable << ", only " << scene_.cables.size()
            << " cables\n";
      return;
    }
    const Cable& cable = scene_.cables[to.cable];
    expect(to.segment < cable.segments(), "starts on a segment that its cable does not have");
    expect(to.along >= 0.0 && to.along <= 1.0, "starts outside of its segment: along is 0 to 1");
    expect(std::find(cable.nodes.begin(), cable.nodes.end(), tie.node) == cable.nodes.end(),
           "ties a node to a cable of its own");
  }

  bool exists(NodeId node) const {
    return static_cast<std::int32_t>(node) >= 0 && index_of(node) < scene_.state.size();
  }

  void expect_node(NodeId node) {
    if (exists(node)) return;
    text_ << name_ << ": there is no node " << static_cast<std::int32_t>(node) << ", only "
          << scene_.state.size() << " nodes\n";
  }

  void expect(bool holds, const char* problem) {
    if (!holds) text_ << name_ << ": " << problem << '\n';
  }

  const Scene& scene_;
  std::ostream& text_;
  std::vector<std::int32_t> body_of_;  // by NodeId, rigid body that it is of; -1: none
  std::string name_;                   // of the cable or tie that is looked at
};

}  // namespace

void list_tie_problems(const Scene& scene, std::ostream& problems) {
  TieProblems(scene, problems).list_all();
}

}  // namespace plekton::dynamics
