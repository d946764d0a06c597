// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/lost_grains.hpp"

#include "geometry/base/state_archive.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace plekton::apps {
namespace {

using geometry::index_of;
using geometry::Vec3;

/// Six times the volume between a triangle and a point; its sign is the side of the point.
double side_of(const Vec3& point, const std::array<Vec3, 3>& triangle) noexcept {
  return (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).dot(point - triangle[0]);
}

/// Whether the foot of a point in the plane of a triangle lies in it, with a margin so that none
/// slips between two triangles.
bool foot_is_inside(const Vec3& point, const std::array<Vec3, 3>& triangle) noexcept {
  constexpr double kMargin = 1e-6;  // of the area
  const Vec3 normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  const double least = -kMargin * normal.squaredNorm();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& a = triangle[k];
    const Vec3& b = triangle[(k + 1) % 3];
    if (normal.dot((b - a).cross(point - a)) < least) return false;
  }
  return true;
}

double smallest_radius(const geometry::Elements& elements) noexcept {
  double smallest = std::numeric_limits<double>::infinity();
  for (const geometry::Sphere& sphere : elements.spheres)
    smallest = std::min(smallest, sphere.radius);
  return smallest;
}

/// Of a wall the point that is nearest to a place, or of a container all around the middle there.
geometry::Box wall_beside(const contact::Plane& plane, const Vec3& place) {
  if (plane.form == contact::Plane::Form::flat) return {plane.foot(place), plane.foot(place)};
  const Vec3 axis = plane.direction();
  const Vec3 middle = plane.point + (place - plane.point).dot(axis) * axis;
  const Vec3 reach = plane.radius * (1.0 - axis.array().square()).max(0.0).sqrt().matrix();
  return {middle - reach, middle + reach};
}

/// Around nothing yet.
geometry::Box no_box() {
  return {Vec3::Constant(std::numeric_limits<double>::max()),
          Vec3::Constant(std::numeric_limits<double>::lowest())};
}

template <class Element>
void include(geometry::Box& bounds, const std::vector<Element>& list, geometry::Positions x) {
  for (const Element& element : list) {
    const geometry::Box box = geometry::box(element, x);
    bounds.lower = bounds.lower.cwiseMin(box.lower);
    bounds.upper = bounds.upper.cwiseMax(box.upper);
  }
}

/// On every side by its own longest side.
geometry::Box grown(const geometry::Box& box) {
  const double margin = (box.upper - box.lower).maxCoeff();
  return {box.lower.array() - margin, box.upper.array() + margin};
}

/// Of membranes and rigid bodies as they are.
geometry::Box box_of_structures(const geometry::Elements& elements, geometry::Positions x) {
  geometry::Box bounds = no_box();
  include(bounds, elements.cylinders, x);
  include(bounds, elements.facets, x);
  return grown(bounds);
}

bool holds(const geometry::Box& box, const Vec3& x) noexcept {
  return (x.array() >= box.lower.array()).all() && (x.array() <= box.upper.array()).all();
}

/// Whether a wall is in the way of a grain before it for good: one that ever falls (or, without
/// gravity, goes on) in a direction.
bool stops(const contact::Plane& plane, const Vec3& x, const Vec3& direction) noexcept {
  if (!(plane.height(x) > 0.0)) return false;
  constexpr double kAlong = 1e-9;  // sine of the angle below which a wall is along a direction
  const double least = kAlong * direction.norm();
  switch (plane.form) {
    case contact::Plane::Form::flat:
      return direction.dot(plane.normal) < -least;
    case contact::Plane::Form::cylinder:
      return direction.cross(plane.axis).norm() > least;
    case contact::Plane::Form::sphere:
      return true;
  }
  return false;
}

bool is_stopped(const Vec3& x, double radius, const Vec3& velocity,
                const LostGrains::Surroundings& surroundings) {
  const bool falls = !surroundings.gravity.isZero(0.0);
  if (!falls && velocity.isZero(0.0)) return true;
  const Vec3& direction = falls ? surroundings.gravity : velocity;
  return std::any_of(surroundings.planes.begin(), surroundings.planes.end(),
                     [&](const contact::Plane& plane) {
                       const bool touches = plane.height(x) > 0.0 && plane.height(x) <= radius;
                       return stops(plane, x, direction) || (!falls && touches);
                     });
}

}  // namespace

geometry::Box roaming_box(const geometry::Elements& elements, geometry::Positions x,
                          std::span<const contact::Plane> planes) {
  geometry::Box bounds = no_box();
  include(bounds, elements.spheres, x);
  include(bounds, elements.cylinders, x);
  include(bounds, elements.facets, x);
  const geometry::Box of_elements = bounds;
  for (const contact::Plane& plane : planes) {
    for (const Vec3& corner : {of_elements.lower, of_elements.upper}) {
      const geometry::Box wall = wall_beside(plane, corner);
      bounds.lower = bounds.lower.cwiseMin(wall.lower);
      bounds.upper = bounds.upper.cwiseMax(wall.upper);
    }
  }
  return grown(bounds);
}

bool passes_through(const Vec3& point0, const Vec3& point1, const std::array<Vec3, 3>& triangle0,
                    const std::array<Vec3, 3>& triangle1) noexcept {
  const double side0 = side_of(point0, triangle0);
  const double side1 = side_of(point1, triangle1);
  if ((side0 > 0.0) == (side1 > 0.0)) return false;
  const double t = side0 / (side0 - side1);  // the sides differ, so this is in [0, 1]
  std::array<Vec3, 3> triangle;
  for (std::size_t k = 0; k < 3; ++k)
    triangle[k] = triangle0[k] + t * (triangle1[k] - triangle0[k]);
  return foot_is_inside(point0 + t * (point1 - point0), triangle);
}

LostGrains::LostGrains(const geometry::Elements& elements, geometry::Positions x,
                       std::span<const contact::Plane> planes)
    : elements_(elements),
      bounds_(roaming_box(elements, x, planes)),
      smallest_radius_(smallest_radius(elements)),
      before_(x.begin(), x.end()),
      is_through_(elements.spheres.size(), false),
      is_out_(elements.spheres.size(), false) {}

void LostGrains::look_for_passing(geometry::Positions x, const geometry::Neighbours& neighbours) {
  const auto pairs = neighbours.sphere_structures();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::size_t sphere = static_cast<std::size_t>(pairs[i].a);
    if (is_through_[sphere]) continue;
    const std::size_t node = index_of(elements_.spheres[sphere].nodes[0]);
    const geometry::NearCells near = neighbours.near_cells()[i];
    for (const geometry::CellId cell : neighbours.cells().subspan(near.first, near.count)) {
      if (index_of(cell) >= elements_.facets.size()) continue;  // a free cylinder
      const geometry::Facet& facet = elements_.facets[index_of(cell)];
      if (!passes_through(before_[node], x[node], geometry::core(facet, before_),
                          geometry::core(facet, x)))
        continue;
      is_through_[sphere] = true;
      ++through_;
      break;
    }
  }
}

void LostGrains::look_for_leaving(geometry::Positions x, const Surroundings& surroundings) {
  std::optional<geometry::Box> structures;  // only where somebody is out at all
  for (std::size_t i = 0; i < elements_.spheres.size(); ++i) {
    const std::size_t node = index_of(elements_.spheres[i].nodes[0]);
    if (is_out_[i] || holds(bounds_, x[node])) continue;
    if (is_stopped(x[node], elements_.spheres[i].radius, surroundings.velocities[node],
                   surroundings))
      continue;
    if (!structures) structures = box_of_structures(elements_, x);
    if (holds(*structures, x[node])) continue;
    is_out_[i] = true;
    ++out_;
  }
}

void LostGrains::look(geometry::Positions x, const geometry::Neighbours& neighbours,
                      const Surroundings& surroundings) {
  look_for_passing(x, neighbours);
  look_for_leaving(x, surroundings);
  std::copy(x.begin(), x.end(), before_.begin());
}

std::int64_t LostGrains::steps_to_next_look(std::span<const Vec3> velocities,
                                            double time_step) const {
  double fastest_squared = 0.0;
  for (const Vec3& velocity : velocities)
    fastest_squared = std::max(fastest_squared, velocity.squaredNorm());
  // A grain and a facet may move towards each other, so each gets half of half a radius.
  const double steps = 0.25 * smallest_radius_ / (std::sqrt(fastest_squared) * time_step);
  return steps < static_cast<double>(kMostSteps) ? std::max<std::int64_t>(1, std::int64_t(steps))
                                                 : kMostSteps;
}

std::size_t LostGrains::total() const noexcept {
  std::size_t count = removed_;
  for (std::size_t i = 0; i < is_out_.size(); ++i) count += is_out_[i] || is_through_[i] ? 1U : 0U;
  return count;
}

void LostGrains::exchange(const geometry::StateArchive& archive) {
  archive("lower_bounds", bounds_.lower);
  archive("upper_bounds", bounds_.upper);
  archive.fixed("before", before_, "nodes");
  archive.fixed("is_through", is_through_, "grains");
  archive.fixed("is_out", is_out_, "grains");
  archive("through", through_);
  archive("out", out_);
  exchange_removed(archive, removed_);
}

void exchange_removed(const geometry::StateArchive& archive, std::size_t& removed) {
  constexpr const char* kName = "removed";
  if (archive.is_reading() && !archive.has(kName))
    removed = 0;
  else if (archive.is_reading() || removed > 0)
    archive(kName, removed);
}

}  // namespace plekton::apps
