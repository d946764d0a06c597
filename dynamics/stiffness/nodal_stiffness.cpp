// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/stiffness/nodal_stiffness.hpp"

#include "dynamics/stiffness/spring_shares.hpp"
#include "geometry/base/elementary.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace plekton::dynamics {

Mat3 along_and_across(const Vec3& n, double along, double across) noexcept {
  return across * Mat3::Identity() + ((along - across) * n) * n.transpose();
}

SpringEnd on_body(const SpringEnd& end, const RigidNodes* rigid) noexcept {
  if (rigid == nullptr || rigid->body_followed_by(end.node) < 0) return end;
  return {rigid->mover_of(end.node), end.weight, end.arm, rigid->lever_of(end.node)};
}

void put_on_bodies(std::span<SpringEnd> ends, const RigidNodes* rigid) noexcept {
  if (rigid == nullptr || rigid->size() == 0) return;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (ends[i].weight == 0.0) continue;
    ends[i] = on_body(ends[i], rigid);
    if (rigid->body_at(ends[i].node) < 0) continue;
    for (std::size_t j = 0; j < i; ++j) {
      if (ends[j].node != ends[i].node || ends[j].weight == 0.0) continue;
      const double weight = ends[j].weight + ends[i].weight;
      if (weight != 0.0)  // else the body is at both ends of the spring, which does nothing to it
        ends[j].lever = (ends[j].weight * ends[j].lever + ends[i].weight * ends[i].lever) / weight;
      ends[j].weight = weight;
      ends[i].weight = 0.0;
      break;
    }
  }
}

SurfaceTurning surface_turning(const geometry::CorePoint& core, double force, double distance,
                               geometry::Positions x) noexcept {
  SurfaceTurning turning{force, distance, Vec3::Zero()};
  const auto corner = [&](std::size_t i) { return x[index_of(core.nodes[i % 3])]; };
  if (core.feature.kind == geometry::FeatureKind::edge) {
    const double length = (corner(1) - corner(0)).norm();
    if (length > 0.0) turning.gradients = Vec3(1.0 / length, 1.0 / length, 0.0);
  } else if (core.feature.kind == geometry::FeatureKind::face) {
    const double twice_area = (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
    for (std::size_t i = 0; i < 3 && twice_area > 0.0; ++i) {
      turning.gradients[static_cast<Eigen::Index>(i)] =
          (corner(i + 2) - corner(i + 1)).norm() / twice_area;
    }
  }
  return turning;
}

std::array<SpringEnd, 4> surface_ends(NodeId ball, const geometry::CorePoint& core,
                                      const ContactStiffness& contact) noexcept {
  const auto end = [&](std::size_t i) {
    return SpringEnd{core.nodes[i], core.weights[static_cast<Eigen::Index>(i)], -contact.arm_b};
  };
  return {SpringEnd{ball, -1.0, contact.arm_a}, end(0), end(1), end(2)};
}

TurningSpring turning_spring(NodeId ball, const geometry::CorePoint& core, const Vec3& normal,
                             const SurfaceTurning& turning) noexcept {
  const bool is_saddle = turning.force < 0.0;
  const bool turns = turning.distance > 0.0 && turning.force != 0.0 &&
                     (is_saddle || !turning.gradients.isZero(0.0));
  if (!turns) return {};
  const double stiffness = (is_saddle ? 2.0 : 1.0) * std::abs(turning.force) / turning.distance;
  TurningSpring spring{{normal, stiffness, stiffness, 0.0, 0.0},
                       surface_ends(ball, core, {normal, 0.0, 0.0, 0.0, 0.0})};
  for (std::size_t i = 0; i < 3; ++i) {
    double& weight = spring.ends[i + 1].weight;
    weight = elementary::hypot(turning.distance * turning.gradients[static_cast<Eigen::Index>(i)],
                               weight);
  }
  return spring;
}

NodalStiffness::NodalStiffness(std::size_t node_count, const NodeProperties* properties,
                               const RigidNodes* rigid)
    : properties_(properties),
      rigid_(rigid),
      blocks_(node_count),
      of_bodies_(rigid != nullptr ? rigid->size() : 0, Mat6::Zero()) {}

NodalStiffness::SymmetricMat3& NodalStiffness::SymmetricMat3::operator+=(
    const Mat3& matrix) noexcept {
  diagonal += matrix.diagonal();
  others += Vec3(matrix(2, 1), matrix(2, 0), matrix(1, 0));
  return *this;
}

Mat3 NodalStiffness::SymmetricMat3::full() const noexcept {
  Mat3 matrix;
  matrix << diagonal.x(), others.z(), others.y(), others.z(), diagonal.y(), others.x(), others.y(),
      others.x(), diagonal.z();
  return matrix;
}

void NodalStiffness::begin_at(std::size_t first_node) noexcept {
  first_node_ = first_node;
  set_zero();
}

void NodalStiffness::set_zero() noexcept {
  std::fill(blocks_.begin(), blocks_.end(), Block{});
  std::fill(of_bodies_.begin(), of_bodies_.end(), Mat6::Zero());
}

NodalStiffness::Shares NodalStiffness::mobility_of(const SpringEnd& end, const Vec3& normal) const {
  const double weight = std::abs(end.weight);
  if (!properties_) return {weight, weight};
  if (const std::int32_t body = body_at(end.node); body >= 0) {
    const Mat3 mobility = rigid_->point_mobility(body, end.to_contact(normal));
    // Rounding may leave it below 0, of a body that can only turn, about a point along the normal.
    const double along = std::max(0.0, normal.dot(mobility * normal));
    const double across = std::max(0.0, 0.5 * (mobility.trace() - along));
    return {weight * std::sqrt(along), weight * std::sqrt(across)};
  }
  const std::size_t i = index_of(end.node);
  const Held held = properties_->held[i];
  const double shift = holds_translation(held) ? 0.0 : 1.0 / properties_->mass[i];
  const double turn = holds_rotation(held) ? 0.0 : end.arm * end.arm / properties_->inertia[i];
  return {weight * std::sqrt(shift), weight * std::sqrt(shift + turn)};
}

double NodalStiffness::measure_of(NodeId node) const noexcept {
  const double mass = properties_ ? properties_->mass[index_of(node)] : 1.0;
  return mass > 0.0 ? 1.0 / std::sqrt(mass) : 1.0;
}

/// The normal spring has g = (n, 0), the tangential ones (t, lever x t) for both t across n.
void NodalStiffness::add_end(const SpringEnd& end, const ContactStiffness& contact,
                             const Shares& shares) {
  Block* const block = block_of(end.node);
  if (!block) return;
  const double normal = shares.normal * contact.normal_stiffness;
  const double tangential = shares.tangential * contact.tangential_stiffness;
  if (const std::int32_t body = body_at(end.node); body >= 0) {
    add_to_body(body, end.to_contact(contact.normal),
                along_and_across(contact.normal, normal, tangential), Mat3::Zero());
    return;
  }
  block->translation += along_and_across(contact.normal, normal, tangential);
  block->rotation += along_and_across(contact.normal, 0.0, end.arm * end.arm * tangential);
  block->coupling -= (end.arm * tangential) * contact.normal;
}

// The point moves by v - lever x turn.
void NodalStiffness::add_to_body(std::int32_t body, const Vec3& lever, const Mat3& translation,
                                 const Mat3& rotation) {
  if (!block_of(rigid_->reference(body))) return;
  const Mat3 turned = -cross_matrix(lever);
  const Mat3 coupling = translation * turned;
  Mat6 part;
  part << translation, coupling, coupling.transpose(), turned.transpose() * coupling + rotation;
  of_bodies_[static_cast<std::size_t>(body)] += part;
}

void NodalStiffness::add_spring(const ContactStiffness& contact, std::span<const SpringEnd> ends) {
  share_spring(
      *this, contact, ends, [&](std::size_t i) { return mobility_of(ends[i], contact.normal); },
      [&](NodeId node) { return measure_of(node); });
}

void NodalStiffness::add_pair(NodeId a, NodeId b, const ContactStiffness& contact) {
  add_spring(contact, std::array{on_body({a, -1.0, contact.arm_a}, rigid_),
                                 on_body({b, 1.0, -contact.arm_b}, rigid_)});
}

void NodalStiffness::add_on_surface(NodeId ball, const geometry::CorePoint& core,
                                    const ContactStiffness& contact,
                                    const SurfaceTurning& turning) {
  std::array ends = surface_ends(ball, core, contact);
  put_on_bodies(ends, rigid_);
  add_spring(contact, ends);
  TurningSpring spring = turning_spring(ball, core, contact.normal, turning);
  if (!(spring.contact.normal_stiffness > 0.0)) return;
  for (SpringEnd& end : spring.ends) end = on_body(end, rigid_);
  add_spring(spring.contact, spring.ends);
}

void NodalStiffness::add_to_wall(NodeId ball, const ContactStiffness& contact) {
  add_spring(contact, std::array{on_body({ball, -1.0, contact.arm_a}, rigid_)});
}

void NodalStiffness::add(NodeId node, const IsotropicStiffness& springs) noexcept {
  if (body_followed_by(node) >= 0) {
    add_to_node(node, springs.translation * Mat3::Identity(), springs.rotation * Mat3::Identity());
    return;
  }
  Block* const block = block_of(node);
  if (!block) return;
  block->translation.diagonal.array() += springs.translation;
  block->rotation.diagonal.array() += springs.rotation;
}

// 12 contacts, of which a third acts along each axis, with the factor 2 of a pair; across it their
// tangential springs. The couplings of opposite contacts cancel.
IsotropicStiffness in_dense_packing(double normal, double tangential, double radius) noexcept {
  return {8.0 * normal + 16.0 * tangential, 16.0 * (radius * radius * tangential)};
}

// Along any direction a contact has at most the larger of its stiffnesses, and about any axis the
// tangential one at the arm. The coupling of translation and rotation at most doubles either.
IsotropicStiffness from_all_sides(double normal, double tangential, double radius) noexcept {
  return {std::max(normal, 2.0 * tangential), 2.0 * radius * radius * tangential};
}

NodalStiffness::Total NodalStiffness::total() const noexcept {
  Total total;
  for (const Block& block : blocks_) {
    total.translation += block.translation.diagonal.sum();
    total.rotation += block.rotation.diagonal.sum();
  }
  for (const Mat6& body : of_bodies_) {
    total.translation += body.topLeftCorner<3, 3>().trace();
    total.rotation += body.bottomRightCorner<3, 3>().trace();
  }
  return total;
}

/// M^(-1/2) D M^(-1/2) of a node; zero where it is held.
NodalStiffness::Mat6 NodalStiffness::per_mass(std::size_t i,
                                              const NodeProperties& properties) const {
  const Block& block = blocks_[i];
  const std::size_t node = first_node_ + i;
  const Held held = properties.held[node];
  if (const std::int32_t body = body_at(geometry::id_at<NodeId>(node)); body >= 0) {
    const Mat3 coupling = cross_matrix(block.coupling);
    Mat6 own;
    own << block.translation.full(), coupling, coupling.transpose(), block.rotation.full();
    return per_mass_of_body(body, own + of_bodies_[static_cast<std::size_t>(body)], properties);
  }
  const double shift = holds_translation(held) ? 0.0 : 1.0 / std::sqrt(properties.mass[node]);
  const double turn = holds_rotation(held) ? 0.0 : 1.0 / std::sqrt(properties.inertia[node]);
  const Mat3 coupling = (shift * turn) * cross_matrix(block.coupling);
  Mat6 matrix;
  matrix << (shift * shift) * block.translation.full(), coupling, coupling.transpose(),
      (turn * turn) * block.rotation.full();
  if (held == Held::nothing) return matrix;
  Eigen::Matrix<double, 6, 1> is_free;
  is_free << free_axes(held), free_turns(held);
  return is_free.asDiagonal() * matrix * is_free.asDiagonal();
}

/// S^T D S with S S^T the inverse of mass and inertia.
NodalStiffness::Mat6 NodalStiffness::per_mass_of_body(std::int32_t body, const Mat6& stiffness,
                                                      const NodeProperties& properties) const {
  const std::size_t node = index_of(rigid_->reference(body));
  const Held held = properties.held[node];
  Mat6 root = Mat6::Zero();
  if (!holds_translation(held))
    root.diagonal().head<3>() = free_axes(held) / std::sqrt(properties.mass[node]);
  root.bottomRightCorner<3, 3>() = rigid_->turn_root(body);
  return root.transpose() * stiffness * root;
}

double NodalStiffness::along(const CriticalStep& step, const NodeProperties& properties) const {
  return step.mode.dot(per_mass(index_of(step.node) - first_node_, properties) * step.mode);
}

double NodalStiffness::rate_of(NodeId node, const NodeProperties& properties) const {
  return per_mass(index_of(node) - first_node_, properties).cwiseAbs().rowwise().sum().maxCoeff();
}

CriticalStep NodalStiffness::critical_step(const NodeProperties& properties) const {
  CriticalStep step;
  double largest = 0.0;  // omega², 1/s²
  for (std::size_t i = 0; i < blocks_.size() && first_node_ + i < properties.size(); ++i) {
    const Mat6 matrix = per_mass(i, properties);
    // Most nodes need no eigenvalues: the row sums are above them, and they are all below the
    // largest so far where that less the matrix is positive definite.
    if (matrix.cwiseAbs().rowwise().sum().maxCoeff() <= largest) continue;
    const Mat6 rest = largest * Mat6::Identity() - matrix;
    if (largest > 0.0 && Eigen::LLT<Mat6>(rest).info() == Eigen::Success) continue;
    const Eigen::SelfAdjointEigenSolver<Mat6> solver(matrix);
    if (solver.eigenvalues()[5] <= largest) continue;
    largest = solver.eigenvalues()[5];
    const bool mostly_turns = solver.eigenvectors().col(5).tail<3>().squaredNorm() > 0.5;
    step = {2.0 / std::sqrt(largest), geometry::id_at<NodeId>(first_node_ + i), mostly_turns,
            solver.eigenvectors().col(5)};
  }
  return step;
}

}  // namespace plekton::dynamics
