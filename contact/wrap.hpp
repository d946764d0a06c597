// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/normal_law.hpp"
#include "geometry/elements.hpp"
#include "geometry/proximity.hpp"

#include <span>
#include <vector>

namespace plekton::contact {

using geometry::Feature;
using geometry::NodeId;
using geometry::Positions;
using geometry::Vec3;

struct PatchTerm;

/// What a wire or a net that wraps a ball gets back, because contacts are counted by pieces
/// (patch.hpp): as soon as all its bars hang together in range they would be one contact, and a
/// wrap would give way.
///
/// A node from which every bar goes down to the ball is where a wrap turns. Of a bar that runs past
/// the ball's centre at its foot, a length y from the node, half the circle of radius s about the
/// centre that lies over the bar sees the part up to the node under an angle of atan(y / tau),
/// where tau^2 = s^2 - d^2 and d is the distance of the node: with X = 2 / pi of it, 1 at the level
/// of the node and falling as the ball sinks in, a bar between two such nodes counts X of a contact
/// at the level s, whatever the mesh: the additive rule (Abel's kernel, which counts any straight
/// line as one). So the node gives back, of k / 2 contacts,
///
///     W = k / 2 * integral of f(H) (-dphi), from d to the range,
///
/// where H is the harmonic mean of X over its k bars and f(H) = (1 + c^2) H^3 / (H^2 + c^2) with
/// c = kTurn: f(1) = 1, so the force stays as it is where bars begin to hang together, and f is
/// about H where a wrap has sunk in. It starts as H^3, so that forces on nodes are Lipschitz where
/// wires pass through straight: a straight wire, a bend away from the ball, a knot beside the ball
/// and a flat net have nothing to get back. The energy is a function of positions alone and the
/// force is its gradient; the cost is that of the nodes.
///
/// Nodes of facets give nothing back.
class Wrap {
 public:
  /// c: H where half of what the additive rule counts is given back. The smaller, the less a wrap
  /// depends on its mesh, and the stiffer nodes are where wires pass through straight: by up to
  /// 2 / (pi c) (width / bar)^2 contacts, with the width tau at the range.
  static constexpr double kTurn = 0.1;

  /// Whether all that meets at a node are bars that go down from it.
  /// @param branches  of its descending link
  static bool turns_at(const geometry::Surface& surface, Feature feature, int branches) noexcept;

  /// Adds the terms of a node: it and the feet of its bars push.
  /// @param range  m, where the law's energy ends
  void add_terms(const geometry::Surface& surface, NodeId node, const Vec3& centre, double range,
                 Positions x, const NormalLaw& law, std::vector<PatchTerm>& terms);

 private:
  /// A bar, as seen from the node where it ends.
  struct Arm {
    geometry::CorePoint foot;  ///< of the centre on the bar's line
    Vec3 normal;               ///< unit, from the centre to the foot
    double height;             ///< m, of the centre over the line
    double along;              ///< m, from the node to the foot
    double energy_by_along;    ///< J / m
  };
  bool find_arms(const geometry::Surface& surface, NodeId node, const Vec3& centre, Positions x);
  double part_at(double tau, double& by_tau);

  std::vector<Arm> arms_;
  std::vector<double> slopes_;  ///< by arm: of what is given back at a level, 1 / m
};

}  // namespace plekton::contact
