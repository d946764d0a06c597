// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/time_step/exact_step.hpp"

#include "dynamics/loads/applied_loads.hpp"
#include "dynamics/state/rigid_nodes.hpp"
#include "dynamics/state/rotation_step.hpp"
#include "dynamics/structure/beam_bonds.hpp"
#include "dynamics/structure/sheet_facets.hpp"
#include "dynamics/time_step/largest_eigenvalue.hpp"

#include <algorithm>
#include <cmath>

namespace plekton::dynamics {
namespace {

using Eigen::VectorXd;

/// Of omega², of the residual. A vector that belongs to the second largest eigenvalue by all but a
/// part e of the largest one, d above it, has the residual e d: with 1e-3 Lanczos' method ended
/// there for one of 100 frames, with a step 0.26 % too long. With 1e-5, e would have to be below
/// 1e-2 where d is worth 0.05 % of the step; it grows with every product.
constexpr double kLargestResidual = 1e-5;
constexpr int kMostProducts = 1000;
/// Of the shortest length, and rad: central differences are off by its square, and rounding by eps
/// over it.
constexpr double kDifference = 1e-6;

/// m, of bonds and sides of sheets at rest, and of cylinders and facets as they are.
double shortest_length(const Scene& scene) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const BeamBond& bond : scene.bonds) shortest = std::min(shortest, bond.length);
  for (const SheetFacet& facet : scene.sheet_facets) {
    for (std::size_t i = 0; i < 3; ++i)
      shortest = std::min(shortest, (facet.corners[(i + 1) % 3] - facet.corners[i]).norm());
  }
  const auto consider = [&](NodeId a, NodeId b) {
    const Vec3 side = scene.state.position[index_of(b)] - scene.state.position[index_of(a)];
    if (side.norm() > 0.0) shortest = std::min(shortest, side.norm());
  };
  for (const geometry::Cylinder& cylinder : scene.elements.cylinders)
    consider(cylinder.nodes[0], cylinder.nodes[1]);
  for (const geometry::Facet& facet : scene.elements.facets) {
    for (std::size_t i = 0; i < 3; ++i) consider(facet.nodes[i], facet.nodes[(i + 1) % 3]);
  }
  return std::isfinite(shortest) ? shortest : 1.0;
}

/// M^(-1/2) K M^(-1/2) of the free motions, by its products.
class ScaledStiffness {
 public:
  ScaledStiffness(const Scene& scene, const Structures& structures, const AppliedLoads& loads,
                  const ContactSprings& contacts, double time, const ForcesOfPlaces& normal)
      : scene_(scene),
        loads_(loads),
        contacts_(contacts),
        normal_(normal),
        time_(time),
        bonds_(structures.bonds),
        sheets_(structures.sheets),
        ties_(structures.ties),
        rigid_(scene.rigid_bodies, scene.state, scene.properties),
        moved_(scene.state),
        shift_(scene.state.size(), Vec3::Zero()),
        turn_(scene.state.size(), Vec3::Zero()),
        forces_(scene.state.size()),
        length_(shortest_length(scene)) {
    scale_.resize(size());
    for (std::size_t i = 0; i < scene.state.size(); ++i) {
      const Held held = scene.properties.held[i];
      const auto per_root = [](double mass) { return mass > 0.0 ? 1.0 / std::sqrt(mass) : 0.0; };
      scale_.segment<6>(entry(i)) << per_root(scene.properties.mass[i]) * free_axes(held),
          per_root(scene.properties.inertia[i]) * free_turns(held);
    }
    for (std::size_t b = 0; b < rigid_.size(); ++b)
      turn_roots_.push_back(rigid_.turn_root(static_cast<std::int32_t>(b)));
    find_structure_forces(0.0);
    torque_ = forces_.torque;
  }

  Eigen::Index size() const noexcept { return entry(scene_.state.size()); }

  /// @param y  set to the matrix times x
  void multiply(const VectorXd& x, VectorXd& y) {
    double largest = 0.0;  // of the motion, in parts of the shortest length and rad
    for (std::size_t i = 0; i < shift_.size(); ++i) {
      shift_[i] = scale_.segment<3>(entry(i)).cwiseProduct(x.segment<3>(entry(i)));
      turn_[i] = scaled_turn(i, x.segment<3>(entry(i) + 3), false);
      largest = std::max({largest, shift_[i].norm() / length_, turn_[i].norm()});
    }
    forces_.set_zero();
    contacts_.resist(shift_, turn_, forces_);
    y.setZero();
    take_forces(-1.0, y);
    if (largest > 0.0) {
      const double step = kDifference / largest;
      for (const double sign : {1.0, -1.0}) {
        find_structure_forces(sign * step);
        take_forces(-0.5 * sign / step, y);
      }
    }
    // A rotation t turns torques: -dT = H t - t x T / 2, H the second derivative of the energy.
    for (std::size_t i = 0; i < turn_.size(); ++i)
      y.segment<3>(entry(i) + 3) += 0.5 * turn_[i].cross(torque_[i]);
    for (std::size_t i = 0; i < turn_.size(); ++i) {
      y.segment<3>(entry(i)) = scale_.segment<3>(entry(i)).cwiseProduct(y.segment<3>(entry(i)));
      y.segment<3>(entry(i) + 3) = scaled_turn(i, y.segment<3>(entry(i) + 3), true);
    }
  }

 private:
  static Eigen::Index entry(std::size_t node) { return static_cast<Eigen::Index>(6 * node); }

  /// By the root of the inverse inertia of a node, or by its transpose.
  Vec3 scaled_turn(std::size_t node, const Vec3& turn, bool transposed) const {
    const std::int32_t body = rigid_.body_at(geometry::id_at<NodeId>(node));
    if (body < 0) return scale_.segment<3>(entry(node) + 3).cwiseProduct(turn);
    const Mat3& root = turn_roots_[static_cast<std::size_t>(body)];
    return transposed ? Vec3(root.transpose() * turn) : Vec3(root * turn);
  }

  /// Calls visit(node, its reference node) for all that follow rigid bodies.
  template <class Visit>
  void for_each_follower(const Visit& visit) const {
    for (const RigidBody& body : scene_.rigid_bodies)
      for (const NodeId node : body.nodes) visit(index_of(node), index_of(body.node));
  }

  void move_followers(double factor) {
    for_each_follower([&](std::size_t node, std::size_t reference) {
      const Vec3 lever = scene_.state.position[node] - scene_.state.position[reference];
      const Quat turn = turned(Quat::Identity(), turn_[reference], factor);
      moved_.position[node] = moved_.position[reference] + turn * lever;
      moved_.orientation[node] = turn * scene_.state.orientation[node];
    });
  }

  void gather_on_bodies() {
    for_each_follower([&](std::size_t node, std::size_t reference) {
      const Vec3 lever = moved_.position[node] - moved_.position[reference];
      forces_.force[reference] += forces_.force[node];
      forces_.torque[reference] += lever.cross(forces_.force[node]) + forces_.torque[node];
    });
  }

  /// Of the state after the motion times a factor.
  void find_structure_forces(double factor) {
    for (std::size_t i = 0; i < shift_.size(); ++i) {
      moved_.position[i] = scene_.state.position[i] + factor * shift_[i];
      moved_.orientation[i] = turned(scene_.state.orientation[i], turn_[i], factor);
    }
    move_followers(factor);
    forces_.set_zero();
    bonds_.advance(moved_, pool_);
    bonds_.add_forces(forces_, pool_);
    sheets_.advance(moved_, 0.0, pool_);
    sheets_.add_forces(forces_, pool_);
    ties_.add_forces_at(moved_.position, forces_);
    loads_.add_elastic_forces(time_, moved_, forces_, pool_);
    if (normal_) normal_(moved_.position, forces_);
    gather_on_bodies();
  }

  void take_forces(double factor, VectorXd& y) const {
    for (std::size_t i = 0; i < shift_.size(); ++i) {
      y.segment<3>(entry(i)) += factor * forces_.force[i];
      y.segment<3>(entry(i) + 3) += factor * forces_.torque[i];
    }
  }

  const Scene& scene_;
  AppliedLoads loads_;
  const ContactSprings& contacts_;
  const ForcesOfPlaces& normal_;
  double time_;
  BeamBonds bonds_;
  SheetFacets sheets_;
  const Ties& ties_;
  RigidNodes rigid_;
  std::vector<Mat3> turn_roots_;  // 1/sqrt(kg m²), by body
  geometry::ThreadPool pool_;
  NodeState moved_;
  std::vector<Vec3> shift_;  // m
  std::vector<Vec3> turn_;   // rad
  NodeForces forces_;
  std::vector<Vec3> torque_;  // N m, of the structures in the state of the scene
  double length_;             // m
  VectorXd scale_;            // 1/sqrt(kg) and 1/sqrt(kg m²); 0 where held
};

}  // namespace

ExactStep exact_critical_step(const Scene& scene, const Structures& structures,
                              const AppliedLoads& loads, const ContactSprings& contacts,
                              double time, const ForcesOfPlaces& normal) {
  ScaledStiffness stiffness(scene, structures, loads, contacts, time, normal);
  const LargestEigenvalue largest = largest_eigenvalue(
      {stiffness.size(), [&](const VectorXd& x, VectorXd& y) { stiffness.multiply(x, y); }},
      kLargestResidual, kMostProducts);
  ExactStep step;
  step.products = largest.products;
  step.contacts = contacts.size();
  const bool is_stiff = largest.value > 0.0;
  step.dt = loads.damped_step(is_stiff ? 2.0 / std::sqrt(largest.value) : step.dt,
                              structures.critical_step);
  if (is_stiff) step.error = 0.5 * largest.residual / largest.value;
  return step;
}

}  // namespace plekton::dynamics
