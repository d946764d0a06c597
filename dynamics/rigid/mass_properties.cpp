// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/rigid/mass_properties.hpp"

#include <Eigen/Eigenvalues>

namespace plekton::dynamics {
namespace {

using geometry::index_of;
using Corners = std::array<Vec3, 3>;

Corners corners_of(const std::array<geometry::NodeId, 3>& facet, geometry::Positions points,
                   const Vec3& origin) noexcept {
  return {points[index_of(facet[0])] - origin, points[index_of(facet[1])] - origin,
          points[index_of(facet[2])] - origin};
}

/// Sum of v v^T over corners, and that of their sum.
Mat3 squares_of(const Corners& x) noexcept {
  const Vec3 sum = x[0] + x[1] + x[2];
  return x[0] * x[0].transpose() + x[1] * x[1].transpose() + x[2] * x[2].transpose() +
         sum * sum.transpose();
}

/// Of second moments about the centre (m⁵ or kg m²): what turns about an axis is across it.
Mat3 inertia_of(const Mat3& second) noexcept {
  return second.trace() * Mat3::Identity() - second;
}

}  // namespace

VolumeMoments& VolumeMoments::operator+=(const VolumeMoments& other) noexcept {
  volume += other.volume;
  first += other.first;
  second += other.second;
  return *this;
}

MassProperties mass_of(const VolumeMoments& moments, double density, const Vec3& origin) noexcept {
  if (!(moments.volume > 0.0)) return {};
  const Vec3 to_centre = moments.first / moments.volume;
  const Mat3 about_centre = moments.second - moments.volume * (to_centre * to_centre.transpose());
  return {density * moments.volume, origin + to_centre, inertia_of(density * about_centre)};
}

MassProperties together(const MassProperties& a, const MassProperties& b) noexcept {
  const double mass = a.mass + b.mass;
  if (!(mass > 0.0)) return {};
  const Vec3 apart = b.centre - a.centre;
  const double reduced = a.mass * (b.mass / mass);
  return {mass, a.centre + (b.mass / mass) * apart,
          a.inertia + b.inertia + inertia_of(reduced * (apart * apart.transpose()))};
}

MassProperties scaled_to(const MassProperties& body, double mass) noexcept {
  return {mass, body.centre, (mass / body.mass) * body.inertia};
}

// The integral of x x^T over a tetrahedron of volume V is V / 20 (sum v v^T + s s^T), s the sum of
// its corners v, of which one is at the origin here.
VolumeMoments solid_moments(geometry::Positions points,
                            std::span<const std::array<geometry::NodeId, 3>> facets,
                            const Vec3& origin) noexcept {
  VolumeMoments sum;
  for (const auto& facet : facets) {
    const Corners x = corners_of(facet, points, origin);
    const double volume = x[0].dot(x[1].cross(x[2])) / 6.0;
    sum += {volume, 0.25 * volume * (x[0] + x[1] + x[2]), 0.05 * volume * squares_of(x)};
  }
  if (sum.volume < 0.0) sum = {-sum.volume, -sum.first, -sum.second};
  return sum;
}

// Over a triangle of area A it is A / 12 (sum v v^T + s s^T); across it A t³ / 12 n n^T.
VolumeMoments shell_moments(geometry::Positions points,
                            std::span<const std::array<geometry::NodeId, 3>> facets,
                            double thickness, const Vec3& origin) noexcept {
  VolumeMoments sum;
  for (const auto& facet : facets) {
    const Corners x = corners_of(facet, points, origin);
    const Vec3 twice_area = Vec3(x[1] - x[0]).cross(x[2] - x[0]);
    const double area = 0.5 * twice_area.norm();
    if (!(area > 0.0)) continue;
    const Vec3 normal = twice_area / (2.0 * area);
    const double volume = area * thickness;
    sum +=
        {volume, volume / 3.0 * (x[0] + x[1] + x[2]),
         volume / 12.0 * (squares_of(x) + thickness * thickness * (normal * normal.transpose()))};
  }
  return sum;
}

PrincipalAxes principal_axes(const Mat3& inertia) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(inertia);
  Mat3 axes = solver.eigenvectors();
  if (axes.determinant() < 0.0) axes.col(0) = -axes.col(0);
  return {solver.eigenvalues(), Quat(axes).normalized()};
}

}  // namespace plekton::dynamics
