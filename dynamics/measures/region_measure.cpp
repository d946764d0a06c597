// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/region_measure.hpp"

#include <cmath>
#include <limits>

namespace plekton::dynamics {
namespace {

using contact::BodyKind;
using contact::ContactBody;
using contact::ContactRecord;
using geometry::index_of;
using geometry::Region;

bool is_grain(const ContactBody& body, const SampleView& sample) {
  return body.kind == BodyKind::sphere && sample.is_grain[static_cast<std::size_t>(body.index)];
}

bool touches(const ContactRecord& contact) noexcept {
  return contact.gap < 0.0 || contact.is_bonded;
}

/// By sphere: how many it touches.
std::vector<std::size_t> contacts_of_grains(const SampleView& sample) {
  std::vector<std::size_t> counts(sample.spheres.size(), 0);
  for (const ContactRecord& contact : sample.contacts) {
    if (!touches(contact)) continue;
    for (const ContactBody& body : {contact.a, contact.b})
      if (is_grain(body, sample)) ++counts[static_cast<std::size_t>(body.index)];
  }
  return counts;
}

double mean_of(std::size_t sum, std::size_t count) noexcept {
  return count > 0 ? static_cast<double>(sum) / static_cast<double>(count)
                   : std::numeric_limits<double>::quiet_NaN();
}

void measure_grains(const Region& region, const SampleView& sample, RegionMeasure& result) {
  const std::vector<std::size_t> counts = contacts_of_grains(sample);
  double solids = 0.0;
  std::size_t ends = 0, ends_of_rattlers = 0;
  for (std::size_t i = 0; i < sample.spheres.size(); ++i) {
    if (!sample.is_grain[i]) continue;
    const Vec3& centre = sample.position[index_of(sample.spheres[i].nodes[0])];
    solids += geometry::ball_volume_in(region, centre, sample.spheres[i].radius);
    if (!geometry::contains(region, centre)) continue;
    ++result.grains;
    ends += counts[i];
    if (counts[i] > 1) continue;
    ++result.rattlers;
    ends_of_rattlers += counts[i];
  }
  result.porosity = 1.0 - solids / result.volume;
  result.coordination = mean_of(ends, result.grains);
  result.coordination_without_rattlers =
      mean_of(ends - ends_of_rattlers, result.grains - result.rattlers);
}

void measure_contacts(const Region& region, const SampleView& sample, RegionMeasure& result) {
  Mat3 moments = Mat3::Zero();  // J
  Mat3 normals = Mat3::Zero();
  for (const ContactRecord& contact : sample.contacts) {
    const bool grain_a = is_grain(contact.a, sample), grain_b = is_grain(contact.b, sample);
    if (!grain_a && !grain_b) continue;
    const Vec3& from = grain_a ? contact.point_a : contact.point;
    const Vec3& to = grain_b ? contact.point_b : contact.point;
    moments +=
        geometry::segment_part_in(region, from, to) * contact.force() * (to - from).transpose();
    if (!grain_a || !grain_b || !touches(contact) || !geometry::contains(region, contact.point))
      continue;
    normals += contact.normal * contact.normal.transpose();
    ++result.contacts;
  }
  result.stress = -moments / result.volume;
  const double count = static_cast<double>(result.contacts);
  result.fabric = result.contacts > 0
                      ? Mat3(normals / count)
                      : Mat3(Mat3::Constant(std::numeric_limits<double>::quiet_NaN()));
}

}  // namespace

double RegionMeasure::deviator_stress() const noexcept {
  const Mat3 deviator = 0.5 * (stress + stress.transpose()) + mean_pressure() * Mat3::Identity();
  return std::sqrt(1.5) * deviator.norm();
}

RegionMeasure measure_region(const geometry::Region& region, const SampleView& sample) {
  RegionMeasure result;
  result.volume = geometry::volume(region);
  measure_grains(region, sample, result);
  measure_contacts(region, sample, result);
  return result;
}

geometry::Box box_around(const SampleView& sample) noexcept {
  constexpr double kNothing = std::numeric_limits<double>::infinity();
  geometry::Box box{Vec3::Constant(kNothing), Vec3::Constant(-kNothing)};
  for (std::size_t i = 0; i < sample.spheres.size(); ++i) {
    if (!sample.is_grain[i]) continue;
    const Vec3& centre = sample.position[index_of(sample.spheres[i].nodes[0])];
    box.lower = box.lower.cwiseMin(Vec3(centre.array() - sample.spheres[i].radius));
    box.upper = box.upper.cwiseMax(Vec3(centre.array() + sample.spheres[i].radius));
  }
  if (box.lower[0] > box.upper[0]) return {Vec3::Zero(), Vec3::Zero()};
  return box;
}

}  // namespace plekton::dynamics
