// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/wrap.hpp"

#include "contact/patch.hpp"

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace plekton::contact {
namespace {

/// Ten points on a stretch from a to 3 a, or from 0 to 2 pi c times the least of the lengths y.
/// What is integrated has its nearest poles at tau = i y, and at i pi c y where bars with feet on
/// either side of the node turn by H = i c. So it is regular around a stretch in an ellipse whose
/// half axes add up to at least 2.9 times half the stretch, and the integral is off by less than
/// 2.9^-20 = 6e-10 of it. The last stretch ends at the range, where laws are powers of the overlap:
/// there the root of what is left is taken, which leaves 2.06 of the ellipse, and 16 points.
using Rule = boost::math::quadrature::gauss<double, 10>;
using LastRule = boost::math::quadrature::gauss<double, 16>;
constexpr double kStretch = 3.0;
constexpr double kFirstStretch = 2.0 * std::numbers::pi * Wrap::kTurn;

/// Of the width of the contact: a foot nearer to the node is at it. Its part weighs as the square.
constexpr double kLeastLength = 1e-9;

template <class Points, class Visit>
void for_each_point(double from, double to, Visit visit) {
  const double middle = 0.5 * (from + to);
  const double half = 0.5 * (to - from);
  for (std::size_t i = 0; i < Points::abscissa().size(); ++i) {
    for (const double sign : {-1.0, 1.0})
      visit(middle + sign * half * Points::abscissa()[i], half * Points::weights()[i]);
  }
}

/// @param visit  gets tau and its part of the integral
template <class Visit>
void for_each_level(double first, double width, Visit visit) {
  double from = 0.0;
  for (double to = first; to < width; from = to, to *= kStretch)
    for_each_point<Rule>(from, to, visit);
  const double left = width - from;
  for_each_point<LastRule>(0.0, 1.0, [&](double root, double part) {
    visit(width - left * root * root, 2.0 * left * root * part);
  });
}

constexpr double kSquare = Wrap::kTurn * Wrap::kTurn;

/// f and its slope.
double part_of(double turn, double& slope) noexcept {
  const double square = turn * turn;
  const double below = square + kSquare;
  slope = (1.0 + kSquare) * square * (square + 3.0 * kSquare) / (below * below);
  return (1.0 + kSquare) * square * turn / below;
}

/// A force on one node and none on anything else but the ball.
PatchTerm inner_term(NodeId node, const Vec3& force) noexcept {
  const double size = force.norm();
  return {geometry::core_point(node), Vec3(force / size), 0.0, 0.0, size, 0.0, false, true};
}

}  // namespace

bool Wrap::find_turns(const geometry::Surface& surface, NodeId node, const Vec3& to_centre,
                      Positions x) {
  arms_.clear();
  turns_.clear();
  const Vec3& at = x[index_of(node)];
  for (const geometry::EdgeId edge : surface.edges_of(node)) {
    const auto& ends = surface.nodes_of(edge);
    const NodeId end = ends[0] == node ? ends[1] : ends[0];
    const Vec3 bar = x[index_of(end)] - at;
    const double length = bar.norm();
    if (!(length > 0.0)) continue;
    const Vec3 direction = bar / length;
    arms_.push_back({end, direction, length, to_centre.dot(direction), 0.0, 0.0, Vec3::Zero()});
  }
  for (std::size_t a = 0; a < arms_.size(); ++a) {
    for (std::size_t b = a + 1; b < arms_.size(); ++b) {
      const double cosine = arms_[a].direction.dot(arms_[b].direction);
      if (cosine < kJunction && arms_[a].along + arms_[b].along > 0.0)
        turns_.push_back({a, b, cosine, 0.0});
    }
  }
  return !turns_.empty();
}

/// The least length y of a bar that turns, but for those with their feet at the node.
double Wrap::least_along() const noexcept {
  double least = std::numeric_limits<double>::infinity();
  for (const Turn& turn : turns_) {
    for (const std::size_t i : {turn.a, turn.b}) {
      if (arms_[i].along != 0.0) least = std::min(least, std::abs(arms_[i].along));
    }
  }
  return least;
}

void Wrap::look_from(double tau) noexcept {
  for (Arm& arm : arms_) arm.seen = 2.0 * std::numbers::inv_pi * std::atan2(arm.along, tau);
}

/// Adds what a level gives back.
/// @param distance  m, of the node
/// @param force     N, of the law at the level, over the level and times the part of tau
/// @param spring    m, the same for a spring of 1 N/m
void Wrap::add_level(double distance, double tau, double force, double spring) {
  look_from(tau);
  for (Turn& turn : turns_) {
    Arm& a = arms_[turn.a];
    Arm& b = arms_[turn.b];
    double slope = 0.0;
    const double part = part_of(0.5 * (a.seen + b.seen), slope);
    const double weight = turn.weight();
    turn.energy += part * force * tau;
    energy_of_spring_ += weight * part * spring * tau;
    for (Arm* const arm : {&a, &b}) {
      const double by_angle =
          weight * slope * std::numbers::inv_pi / (tau * tau + arm->along * arm->along);
      arm->energy_by_along += by_angle * tau * force * tau;
      energy_by_distance_ += by_angle * arm->along * force * distance;
    }
  }
}

/// By the distance of the node what is under the integral is integrated by parts first, so that the
/// law's force is enough.
void Wrap::integrate(double distance, double range, const NormalLaw& law) {
  energy_ = energy_of_spring_ = energy_by_distance_ = 0.0;
  const double width = std::sqrt((range - distance) * (range + distance));
  for (Arm& arm : arms_) {
    if (std::abs(arm.along) < kLeastLength * width) arm.along = 0.0;
  }
  for_each_level(kFirstStretch * least_along(), width, [&](double tau, double part) {
    const double level = std::sqrt(distance * distance + tau * tau);
    add_level(distance, tau, part * law.force(level) / level, part * (range - level) / level);
  });
  for (const Turn& turn : turns_) energy_ += turn.weight() * turn.energy;
  energy_by_distance_ += part_of_turns(width) * law.force(range) * distance / range;
  energy_by_distance_ -= part_of_turns(0.0) * law.force(distance);
}

/// Sum of w f(H) at a level.
double Wrap::part_of_turns(double tau) noexcept {
  look_from(tau);
  double sum = 0.0;
  double slope = 0.0;
  for (const Turn& turn : turns_) {
    sum += turn.weight() * part_of(0.5 * (arms_[turn.a].seen + arms_[turn.b].seen), slope);
  }
  return sum;
}

/// Of w.
void Wrap::add_slopes_of_angles() noexcept {
  for (const Turn& turn : turns_) {
    Arm& a = arms_[turn.a];
    Arm& b = arms_[turn.b];
    const double by_cosine = turn.weight_by_cosine() * turn.energy;
    a.energy_by_direction += by_cosine * b.direction;
    b.energy_by_direction += by_cosine * a.direction;
  }
}

void Wrap::add_terms(const geometry::Surface& surface, NodeId node, const Vec3& centre,
                     double range, Positions x, const NormalLaw& law,
                     std::vector<PatchTerm>& terms) {
  const Vec3 to_node = x[index_of(node)] - centre;
  const double distance = to_node.norm();
  if (!(distance > 0.0 && distance < range) || !find_turns(surface, node, -to_node, x)) return;
  integrate(distance, range, law);
  add_slopes_of_angles();

  // A bar's direction turns with its end, and the length y with both.
  const Vec3 normal = to_node / distance;
  Vec3 on_node = -energy_by_distance_ * normal;
  for (const Arm& arm : arms_) {
    const Vec3 by_direction = arm.energy_by_direction - arm.energy_by_along * to_node;
    const Vec3 on_end =
        (by_direction.dot(arm.direction) * arm.direction - by_direction) / arm.length;
    on_node += arm.energy_by_along * arm.direction - on_end;
    if (!on_end.isZero(0.0)) terms.push_back(inner_term(arm.end, on_end));
  }
  const double push = on_node.dot(normal);
  const Vec3 aside = on_node - push * normal;
  if (!aside.isZero(0.0)) terms.push_back(inner_term(node, aside));
  const double depth = range - distance;
  const double count = 2.0 * energy_of_spring_ / (depth * depth);
  terms.push_back({geometry::core_point(node), normal, distance, count,
                   push - count * law.force(distance), energy_ - count * law.energy(distance),
                   false, false});
}

}  // namespace plekton::contact
