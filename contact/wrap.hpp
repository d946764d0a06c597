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
/// A node is where a wire turns around the ball. Of a bar whose line is nearest to the ball's
/// centre a length y from the node (less than 0, if that is beyond the node), half the circle of
/// radius s about the centre that lies over the bar sees the part up to the node under an angle of
/// atan(y / tau), where tau^2 = s^2 - d^2 and d is the distance of the node. Two bars that go on in
/// each other turn by what X = 2 / pi of that angle adds up to, H = (X + X') / 2: nothing where the
/// wire is straight, less than nothing where it bends away from the ball, and 1 at the level of a
/// node from which both bars go down. It falls as the ball sinks in, and a bar between two such
/// nodes counts H of a contact at the level s, whatever the mesh: the additive rule (Abel's kernel,
/// which counts any straight line as one). So a node gives back
///
///     W = sum over pairs of its bars of w * integral of f(H) (-dphi), from d to the range, H > 0
///
/// with w = u^2 (3 - 2 u), u = -1 - 2 cos of the angle between the bars where that is above 120
/// degrees, else 0: how far they are one wire. So a knot of straight wires, a corner and a junction
/// of three even wires have nothing to get back beside the ball. f(H) = (1 + c^2) H^3 / (H^2 + c^2)
/// with c = kTurn: f(1) = 1, so the force stays as it is where bars begin to hang together, and f
/// is about H where a wrap has sunk in; it starts as H^3, so that forces on nodes are Lipschitz
/// where wires pass through straight. The energy is a function of positions alone and the force is
/// its gradient; the cost is that of the nodes.
///
/// Nodes of facets give nothing back.
class Wrap {
 public:
  /// c: H where half of what the additive rule counts is given back. The smaller, the less a wrap
  /// depends on its mesh, and the stiffer nodes are where wires pass through straight: by up to
  /// 2 / (pi c) (width / bar)^2 contacts, with the width tau at the range.
  static constexpr double kTurn = 0.1;

  /// Cosine of the angle between the wires of a junction of three: bars at a smaller angle are no
  /// wire that goes on.
  static constexpr double kJunction = -0.5;

  /// Finds what a node gives back: it pushes along its own normal, and beside that there are forces
  /// between it and the ends of its bars.
  ///
  /// Nothing is found out of range, where the ball's centre is the node, and of bars without
  /// length.
  /// @param node   that no facet has
  /// @param range  m, where the law's energy ends
  /// @param terms  get what is found: nothing, or those of the ends of bars, then those of the node
  void add_terms(const geometry::Surface& surface, NodeId node, const Vec3& centre, double range,
                 Positions x, const NormalLaw& law, std::vector<PatchTerm>& terms);

 private:
  /// A bar, as seen from the node where it ends.
  struct Arm {
    NodeId end;
    Vec3 direction;            ///< unit, from the node
    double length;             ///< m
    double along;              ///< m, from the node to the foot of the centre on the bar's line: y
    double seen;               ///< X at a level
    double energy_by_along;    ///< J / m
    Vec3 energy_by_direction;  ///< J
  };
  /// Two bars that turn towards the ball where they meet.
  struct Turn {
    std::size_t a, b;
    double cosine;  ///< below kJunction, of the angle between the bars
    double energy;  ///< J, for w = 1
    double weight() const noexcept { return straight() * straight() * (3.0 - 2.0 * straight()); }
    double weight_by_cosine() const noexcept { return -12.0 * straight() * (1.0 - straight()); }

   private:
    double straight() const noexcept { return -2.0 * cosine - 1.0; }
  };
  bool find_turns(const geometry::Surface& surface, NodeId node, const Vec3& to_centre,
                  Positions x);
  double least_along() const noexcept;
  void integrate(double distance, double range, const NormalLaw& law);
  void add_level(double distance, double tau, double force, double spring);
  void look_from(double tau) noexcept;
  double part_of_turns(double tau) noexcept;
  void add_slopes_of_angles() noexcept;

  std::vector<Arm> arms_;
  std::vector<Turn> turns_;
  // Of the node.
  double energy_ = 0.0;              ///< J
  double energy_of_spring_ = 0.0;    ///< m^2, for a spring of 1 N/m
  double energy_by_distance_ = 0.0;  ///< N
};

}  // namespace plekton::contact
