// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/wrap.hpp"

#include "contact/patch.hpp"

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plekton::contact {
namespace {

/// Ten points on a stretch from a to 3 a, or from 0 to twice the least of the lengths y: atan(y /
/// tau) is regular around it in an ellipse whose half axes add up to at least 2.9 times half the
/// stretch, so the integral is off by less than 2.9^-20 = 6e-10 of it.
using Rule = boost::math::quadrature::gauss<double, 10>;
constexpr double kStretch = 3.0;

/// Of the width of the contact: what is turned less is far below the last digit of the energy.
constexpr double kLeastTurn = 1e-9;

template <class Visit>
void for_each_point(double from, double to, Visit visit) {
  const double middle = 0.5 * (from + to);
  const double half = 0.5 * (to - from);
  for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
    for (const double sign : {-1.0, 1.0})
      visit(middle + sign * half * Rule::abscissa()[i], half * Rule::weights()[i]);
  }
}

}  // namespace

bool Wrap::turns_at(const geometry::Surface& surface, Feature feature, int branches) noexcept {
  if (feature.kind != geometry::FeatureKind::node || branches < 2) return false;
  const auto node = static_cast<NodeId>(feature.id);
  return surface.faces_of(node).empty() &&
         surface.edges_of(node).size() == static_cast<std::size_t>(branches);
}

bool Wrap::find_arms(const geometry::Surface& surface, NodeId node, const Vec3& centre,
                     Positions x) {
  arms_.clear();
  const Vec3& at = x[index_of(node)];
  const Vec3 to_centre = centre - at;
  for (const geometry::EdgeId edge : surface.edges_of(node)) {
    const auto& ends = surface.nodes_of(edge);
    const NodeId other = ends[0] == node ? ends[1] : ends[0];
    const Vec3 bar = x[index_of(other)] - at;
    const double length = bar.norm();
    const double along = to_centre.dot(bar) / length;
    if (!(along > 0.0)) return false;
    const double part = along / length;
    const Vec3 to_foot = part * bar - to_centre;
    const double height = to_foot.norm();
    arms_.push_back({{{node, other, node}, Vec3(1.0 - part, part, 0.0), Feature(edge)},
                     height > 0.0 ? Vec3(to_foot / height) : Vec3(Vec3::Zero()),
                     height,
                     along,
                     0.0});
  }
  return true;
}

/// What is given back at a level, with its slopes.
double Wrap::part_at(double tau, double& by_tau) {
  constexpr double kQuarter = 2.0 * std::numbers::inv_pi;
  const auto count = static_cast<double>(arms_.size());
  double sum = 0.0;
  for (const Arm& arm : arms_) sum += 1.0 / (kQuarter * std::atan2(arm.along, tau));
  const double mean = count / sum;
  constexpr double kSquare = kTurn * kTurn;
  const double square = mean * mean;
  const double below = square + kSquare;
  const double by_mean =
      0.5 * count * (1.0 + kSquare) * square * (square + 3.0 * kSquare) / (below * below);
  slopes_.clear();
  by_tau = 0.0;
  for (const Arm& arm : arms_) {
    const double seen = kQuarter * std::atan2(arm.along, tau);
    const double turn = kQuarter / (tau * tau + arm.along * arm.along);
    const double by_seen = by_mean * square / (count * seen * seen);
    slopes_.push_back(by_seen * turn * tau);
    by_tau -= by_seen * turn * arm.along;
  }
  return 0.5 * count * (1.0 + kSquare) * square * mean / below;
}

void Wrap::add_terms(const geometry::Surface& surface, NodeId node, const Vec3& centre,
                     double range, Positions x, const NormalLaw& law,
                     std::vector<PatchTerm>& terms) {
  const Vec3 to_node = x[index_of(node)] - centre;
  const double distance = to_node.norm();
  if (!(distance < range) || !find_arms(surface, node, centre, x)) return;
  const double width = std::sqrt((range - distance) * (range + distance));
  const double least = std::min_element(arms_.begin(), arms_.end(), [](const Arm& a, const Arm& b) {
                         return a.along < b.along;
                       })->along;
  if (!(least > kLeastTurn * width)) return;

  double by_tau = 0.0;
  double energy = 0.0;
  double of_spring = 0.0;  // energy for a spring of 1 N/m
  // By the distance of the node: of level by level, what is not under the integral first.
  double push = 0.5 * static_cast<double>(arms_.size()) * law.force(distance) -
                part_at(width, by_tau) * law.force(range) * distance / range;
  for (double from = 0.0, to = std::min(width, 2.0 * least); from < width;
       from = to, to = std::min(width, kStretch * to)) {
    for_each_point(from, to, [&](double tau, double weight) {
      const double level = std::sqrt(distance * distance + tau * tau);
      const double force = weight * law.force(level) / level;
      const double part = part_at(tau, by_tau);
      energy += part * force * tau;
      of_spring += part * weight * (range - level) / level * tau;
      push += by_tau * force * distance;
      for (std::size_t i = 0; i < arms_.size(); ++i)
        arms_[i].energy_by_along += slopes_[i] * force * tau;
    });
  }
  // A force along a bar is one from the centre through the node and one through the foot.
  for (const Arm& arm : arms_) {
    push -= distance * arm.energy_by_along / arm.along;
    if (arm.height > 0.0) {
      terms.push_back({arm.foot, arm.normal, arm.height, 0.0,
                       arm.energy_by_along * arm.height / arm.along, 0.0, false});
    }
  }
  const double depth = range - distance;
  const double count = 2.0 * of_spring / (depth * depth);
  terms.push_back({geometry::core_point(node), to_node / distance, distance, count,
                   push - count * law.force(distance), energy - count * law.energy(distance),
                   false});
}

}  // namespace plekton::contact
