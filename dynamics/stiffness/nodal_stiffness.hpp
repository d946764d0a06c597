// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/state/node_state.hpp"
#include "dynamics/state/rigid_nodes.hpp"
#include "geometry/primitives/proximity.hpp"

#include <array>
#include <limits>
#include <span>
#include <vector>

namespace plekton::dynamics {

/// A chosen time step is this part of the critical one.
constexpr double kSafety = 0.65;
/// A given time step must not be above this part of the critical one.
constexpr double kLargestStep = 0.8;

/// c n n + t (I - n n), n a unit vector.
Mat3 along_and_across(const Vec3& n, double along, double across) noexcept;

/// Largest time step at which the leapfrog is stable, or a little less, and who limits it.
struct CriticalStep {
  double dt =
      std::numeric_limits<double>::infinity();  ///< s; infinite if nothing is stiff and free
  NodeId node{-1};                              ///< -1 if the step is infinite
  bool rotation = false;  ///< it is the node turning that limits the step, more than moving
  /// How the node moves and turns, per root of mass and inertia; of length 1.
  Eigen::Matrix<double, 6, 1> mode = Eigen::Matrix<double, 6, 1>::Zero();
};

// Dashpots push with the speed of half a step before. Beside springs K such a damping C is stable
// in a leapfrog if dt²/4 (K + 2 C / dt) <= M: of one mode dt <= 2 / omega (sqrt(1 + xi²) - xi) with
// xi = c / (2 m omega) (Belytschko, Liu & Moran, Nonlinear Finite Elements, 2000, section 6.2). So
// where a heavy ball meets a light node, it is the mass of the node that counts, and where many
// dashpots hold a node, their sum.

/// 1/s, times a damping (N s/m) the spring (N/m) as which it counts in a step (s); 0 for an
/// infinite one.
inline double dashpot_rate(double dt) noexcept {
  return 2.0 / dt;
}

/// s, a step that is stable with dashpots, not longer than the longest one.
///
/// With f a part of the critical step of K + 2 C / tried: longer steps than the one that was tried
/// have less of C, so that f itself is not too long if it is longer; and in shorter ones K + 2 C /
/// dt is at most tried / dt times as much, so that f² / tried is not.
/// @param tried  s, > 0
/// @param found  s, the critical step, or a part of it, with dashpots as they count in the one
///           tried
inline double stable_with_dashpots(double tried, double found) noexcept {
  return found < tried ? found * (found / tried) : found;
}

/// Springs of a contact between a and b.
struct ContactStiffness {
  Vec3 normal;                  ///< unit
  double normal_stiffness;      ///< N/m
  double tangential_stiffness;  ///< N/m
  double arm_a;                 ///< m, from the core point of a to the contact point
  double arm_b;                 ///< m, likewise of b
  double overlap = 0.0;         ///< m, of now
  double weight = 1.0;      ///< of the force of one contact; the stiffness has its magnitude, at
                            ///< least 1
  double dashpot = 0.0;     ///< N/m, part of the normal stiffness that stands for a dashpot
  double wall_speed = 0.0;  ///< m/s, of a wall along the normal
  double core_force = 0.0;  ///< N, elastic, where the cores meet, if they may before the next look

  /// N/m, without what stands for a dashpot.
  double elastic_stiffness() const noexcept { return normal_stiffness - dashpot; }
};

/// How a node takes part in the spring of a contact: the contact point on b moves by weight (shift
/// + turn x (lever + arm n)), that on a by as much with a weight below 0.
struct SpringEnd {
  NodeId node;
  double weight;
  double arm;                 ///< m, along the normal
  Vec3 lever = Vec3::Zero();  ///< m, of a rigid body, from its reference node

  /// m, from the node to the contact point.
  Vec3 to_contact(const Vec3& normal) const noexcept { return lever + arm * normal; }
};

/// The same end on what moves its node: the reference node of a rigid body, if it follows one.
SpringEnd on_body(const SpringEnd& end, const RigidNodes* rigid) noexcept;
/// The same of all ends; those on one body become one, and the weights of the others 0. The point
/// between them is a point of that body.
void put_on_bodies(std::span<SpringEnd> ends, const RigidNodes* rigid) noexcept;

/// How a normal force F (N) on a surface resists what turns the surface where it acts.
///
/// With d the distance from a ball's centre to the nearest point of a bar or facet, u the motion of
/// the centre less that of that point of the material, and theta = sum grad(w_i) (n . y_i) how the
/// bar or facet turns as its nodes move by y_i, the second derivative of d is
///
///     |P u|² / d - d |theta + T u / d|²,
///
/// P the projection across the normal and T that on the bar or facet: the nearest point slides. The
/// energy has -F times it. What pushes (F > 0) is stiffer by F / d |d theta + T u|², which is as
/// much as the contact itself on bars that are short beside d; a saddle (F < 0) by |F| / d |P u|².
struct SurfaceTurning {
  double force = 0.0;             ///< N, F
  double distance = 0.0;          ///< m, d
  Vec3 gradients = Vec3::Zero();  ///< 1/m, |grad(w_i)| of the weights of the core point's nodes
};

/// Of the foot of a ball on a feature of a surface. The gradients are 0 on a node, and of what has
/// no length or area.
SurfaceTurning surface_turning(const geometry::CorePoint& core, double force, double distance,
                               geometry::Positions x) noexcept;

/// Ends of a contact of a ball with a surface: the ball first, then the nodes of the core point.
std::array<SpringEnd, 4> surface_ends(NodeId ball, const geometry::CorePoint& core,
                                      const ContactStiffness& contact) noexcept;

/// What resists the turning of a surface, as one spring that is as stiff in any direction as it can
/// be in one: F / d with ends d grad(w_i) n - w_i T on the nodes, no longer than the root of the
/// sum of both squares, and T on the ball. A saddle has the weights alone, but either sign of its
/// curvature counts, so that its stiffness is twice |F| / d.
struct TurningSpring {
  ContactStiffness contact;  ///< its stiffness is 0 if nothing turns
  std::array<SpringEnd, 4> ends;
};
TurningSpring turning_spring(NodeId ball, const geometry::CorePoint& core, const Vec3& normal,
                             const SurfaceTurning& turning) noexcept;

/// Springs around a node that are the same along and about every axis.
struct IsotropicStiffness {
  double translation = 0.0;  ///< N/m
  double rotation = 0.0;     ///< N m
};

/// Contacts of a sphere as if it lay among others of its size in the densest packing: 12 contacts,
/// evenly distributed, so that a third of each acts in any direction. In a mixture it is the
/// smallest grains that limit the step. A ball among n larger ones has the stiffness n 2 / (1 +
/// size ratio) k, with n at most 12, 9, 6 and 4 for ratios down to 0.90, 0.73, 0.41 and 0.22
/// (Tammes' problem): never more than 5 % above 12 k. For a ball that is softer than its
/// neighbours, give the stiffness of its contact with the hardest.
/// @param normal, tangential  N/m, of a contact between two such spheres
/// @param radius              m, of the sphere
IsotropicStiffness in_dense_packing(double normal, double tangential, double radius) noexcept;

/// A contact of a node of a surface that may come from any side.
/// @param normal, tangential  N/m, with the factor 2 of a partner that moves already in them
/// @param radius              m, of the surface
IsotropicStiffness from_all_sides(double normal, double tangential, double radius) noexcept;

/// Sums of the stiffness around each node, for a time step that is safe.
///
/// The leapfrog is stable for dt < 2 / omega, omega² the largest eigenvalue of K x = omega² M x.
/// Each spring of K is put under springs that each hold a single node: with elongation g_a.x_a +
/// g_b.x_b, x_a and x_b the motions of two nodes (displacement and rotation), and stiffness k,
///
///     k (g_a.x_a + g_b.x_b)² <= 2 k (g_a.x_a)² + 2 k (g_b.x_b)²,
///
/// or for any number of nodes k (sum g_i.x_i)² <= k S sum (g_i.x_i)² / a_i, S = sum a_i, with any
/// a_i > 0 (Cauchy-Schwarz). Those that are held are left out: what is held does not limit a step.
/// With a_i = h_i d_i, h_i = |M_i^(-1/2) g_i|, a light node has less of a spring that it shares
/// with a heavy one the larger its d_i is; the functions for contacts take d_i = m_i^(-1/2), with
/// which the bound of a single contact between two balls is exact. SpringShares finds better ones.
///
/// With D_i the 6 x 6 sum of these around node i, omega² <= max_i largest eigenvalue of D_i, M_i,
/// and dt = 2 / omega is never above the true limit, whatever the masses, the shapes and the
/// coupling of translation and rotation. Holding nodes only lowers omega. (The diagonal of K alone
/// would not do: it misses that shear moves and turns a node at once.)
///
/// A rigid body is one node more: what holds nodes that follow it holds its reference node, with
/// the levers of now and the whole tensor of inertia.
///
/// K is that of the springs as they are now: contacts that begin later, or press harder under a
/// nonlinear law, change it. So leave a margin, and ask again as a simulation goes on.
class NodalStiffness {
 public:
  /// @param properties  of all nodes, to know which are held; must outlive this; null: none is
  /// @param rigid  rigid bodies among the nodes; must outlive this; null: none
  explicit NodalStiffness(std::size_t node_count, const NodeProperties* properties = nullptr,
                          const RigidNodes* rigid = nullptr);

  std::size_t node_count() const noexcept { return blocks_.size(); }
  /// Forgets what was added; from now on for as many nodes from this one on: what is added to
  /// others is left out. So the stiffness of many nodes can be looked at piece by piece.
  void begin_at(std::size_t first_node) noexcept;

  /// Forgets what was added; keeps its space, so that nothing is allocated.
  void set_zero() noexcept;

  void add(NodeId node, const IsotropicStiffness& springs) noexcept;

  /// Adds a contact between two balls.
  void add_pair(NodeId a, NodeId b, const ContactStiffness& contact);

  /// Adds a contact between a ball and a surface, whose nodes share in it by the weights of the
  /// core point.
  void add_on_surface(NodeId ball, const geometry::CorePoint& core, const ContactStiffness& contact,
                      const SurfaceTurning& turning = {});

  /// Adds a contact between a ball and a wall, which does not yield. arm_b has no meaning here.
  void add_to_wall(NodeId ball, const ContactStiffness& contact);

  /// How much of a contact's springs a node takes part in, or takes upon itself: along the normal,
  /// and across it.
  struct Shares {
    double normal = 0.0;
    double tangential = 0.0;
  };
  /// h of the class comment (1/sqrt(kg)), of a rigid body the mean of both directions across the
  /// normal; 0 where the node is held. The weight where no properties
  /// are known.
  Shares mobility_of(const SpringEnd& end, const Vec3& normal) const;
  /// d of the class comment that the functions for contacts take, 1/sqrt(kg).
  double measure_of(NodeId node) const noexcept;
  /// Adds an end of a contact.
  /// @param shares  S / a of the class comment, times the squared weight
  void add_end(const SpringEnd& end, const ContactStiffness& contact, const Shares& shares);
  /// Largest sum of magnitudes in a row of what was added to a node over its mass and inertia,
  /// 1/s²: not below its largest eigenvalue.
  double rate_of(NodeId node, const NodeProperties& properties) const;

  /// Adds stiffness that is already that of springs which each hold a single node: matrices such
  /// that the energy of a structure is at most 1/2 sum (v . T v + r . R r) over its nodes.
  /// @param translation  N/m, symmetric, T
  /// @param rotation     N m, symmetric, R
  void add_to_node(NodeId node, const Mat3& translation, const Mat3& rotation) {
    if (const std::int32_t body = body_followed_by(node); body >= 0) {
      add_to_body(body, rigid_->lever_of(node), translation, rotation);
      return;
    }
    Block* const block = block_of(node);
    if (!block) return;
    block->translation += translation;
    block->rotation += rotation;
  }

  /// Sums of the stiffness around all nodes.
  struct Total {
    double translation = 0.0;  ///< N/m, traces added up
    double rotation = 0.0;     ///< N m, likewise
  };
  Total total() const noexcept;

  /// 1/s², the share of what was added in omega² of the node and motion of a step.
  double along(const CriticalStep& step, const NodeProperties& properties) const;

  /// Complexity: linear in the number of nodes.
  CriticalStep critical_step(const NodeProperties& properties) const;

 private:
  /// The numbers of a symmetric matrix.
  struct SymmetricMat3 {
    Vec3 diagonal = Vec3::Zero();
    Vec3 others = Vec3::Zero();  ///< yz, xz, xy

    SymmetricMat3& operator+=(const Mat3& matrix) noexcept;
    Mat3 full() const noexcept;
  };

  /// Twice the stiffness around a node: [translation, coupling; coupling^T, rotation] with the
  /// coupling v -> c x v, since all contacts turn a node across their normal.
  struct Block {
    SymmetricMat3 translation;     // N/m
    SymmetricMat3 rotation;        // N m
    Vec3 coupling = Vec3::Zero();  // N
  };

  /// nullptr if it is not one of the nodes.
  Block* block_of(NodeId node) noexcept {
    const std::size_t i = index_of(node) - first_node_;  // wraps round below the first
    return i < blocks_.size() ? &blocks_[i] : nullptr;
  }
  std::int32_t body_followed_by(NodeId node) const noexcept {
    return rigid_ != nullptr ? rigid_->body_followed_by(node) : -1;
  }
  std::int32_t body_at(NodeId node) const noexcept {
    return rigid_ != nullptr ? rigid_->body_at(node) : -1;
  }
  /// Adds stiffness against the motion of a point of a body and against its turning.
  void add_to_body(std::int32_t body, const Vec3& lever, const Mat3& translation,
                   const Mat3& rotation);
  void add_spring(const ContactStiffness& contact, std::span<const SpringEnd> ends);
  using Mat6 = Eigen::Matrix<double, 6, 6>;
  Mat6 per_mass_of_body(std::int32_t body, const Mat6& stiffness,
                        const NodeProperties& properties) const;
  Mat6 per_mass(std::size_t i, const NodeProperties& properties) const;

  const NodeProperties* properties_;
  const RigidNodes* rigid_;
  std::size_t first_node_ = 0;
  std::vector<Block> blocks_;
  std::vector<Mat6> of_bodies_;  // by body, what holds the nodes that follow it
};

}  // namespace plekton::dynamics
