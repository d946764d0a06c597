// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/seeded_random.hpp"

#include <array>
#include <cmath>

/// Families of point-triangle queries that are hard for floating-point arithmetic.
namespace plekton::test {

struct PointTriangle {
  Vec3 p;
  std::array<Vec3, 3> x;
};

enum class Family {
  generic,
  near_edge_plane,     ///< 1e-17 to 1e-8 off the plane between a side and the face
  above_a_vertex,      ///< over a corner, coordinates off by 1e-16
  coplanar_near_edge,  ///< in the plane of the triangle, 1e-17 to 1e-8 off a side
  needle,              ///< one side 1e-9 to 1e-3 of the others
  cap,                 ///< one corner 1e-9 to 1e-3 off the opposite side
  far_from_origin,     ///< size 1e-3 to 1 at 1e6
  tiny,                ///< size 1e-9
  rotated_flat_grid,   ///< over the sides of a rotated integer grid
  on_an_edge,          ///< on a side, many exactly
  integer_grid,
  degenerate,  ///< collinear or coincident corners
};
inline constexpr std::array kFamilies{Family::generic,
                                      Family::near_edge_plane,
                                      Family::above_a_vertex,
                                      Family::coplanar_near_edge,
                                      Family::needle,
                                      Family::cap,
                                      Family::far_from_origin,
                                      Family::tiny,
                                      Family::rotated_flat_grid,
                                      Family::on_an_edge,
                                      Family::integer_grid,
                                      Family::degenerate};
inline constexpr std::array kFamilyNames{
    "generic",      "near edge plane", "above a vertex", "coplanar near edge", "needle",
    "cap",          "far from origin", "tiny",           "rotated flat grid",  "on an edge",
    "integer grid", "degenerate"};

class PointTriangleFamilies {
 public:
  explicit PointTriangleFamilies(std::uint64_t seed) : random_(seed) {}

  PointTriangle draw(Family family) {
    switch (family) {
      case Family::generic:
        return {random_.in_cube(2.0), random_triangle()};
      case Family::near_edge_plane:
        return near_side(random_.uniform(-2.0, 2.0));
      case Family::above_a_vertex:
        return above_a_vertex();
      case Family::coplanar_near_edge:
        return near_side(0.0);
      case Family::needle:
        return sliver({random_.unit(), 0.0}, 1.0);
      case Family::cap:
        return sliver({0.0, 1.0}, random_.unit());
      case Family::far_from_origin:
        return far_from_origin();
      case Family::tiny:
        return tiny();
      case Family::rotated_flat_grid:
        return rotated_flat_grid();
      case Family::on_an_edge:
        return on_an_edge();
      case Family::integer_grid:
        return {random_.on_lattice(-4, 4),
                {random_.on_lattice(-4, 4), random_.on_lattice(-4, 4), random_.on_lattice(-4, 4)}};
      case Family::degenerate:
        break;
    }
    return degenerate();
  }

 private:
  std::array<Vec3, 3> random_triangle() {
    return {random_.in_cube(1.0), random_.in_cube(1.0), random_.in_cube(1.0)};
  }

  /// Over a side, moved across it by a very small step.
  PointTriangle near_side(double height) {
    const auto x = random_triangle();
    const std::size_t k = random_.index(3);
    const Vec3 u = x[(k + 1) % 3] - x[k];
    const Vec3 normal = u.cross(x[(k + 2) % 3] - x[k]).normalized();
    const Vec3 across = normal.cross(u).normalized();
    const double t = random_.uniform(-0.2, 1.2);
    return {x[k] + t * u + height * normal + random_.signed_power(-17.0, -8.0) * across, x};
  }

  PointTriangle above_a_vertex() {
    const auto x = random_triangle();
    const Vec3 normal = (x[1] - x[0]).cross(x[2] - x[0]).normalized();
    const Vec3 jitter(random_.integer(-1, 1), random_.integer(-1, 1), random_.integer(-1, 1));
    return {x[random_.index(3)] + random_.uniform(-2.0, 2.0) * normal + 1e-16 * jitter, x};
  }

  /// A triangle of height 1e-9 to 1e-3 over the side from 0 to 1, turned at random; the point is
  /// near its plane.
  PointTriangle sliver(const std::array<double, 2>& foot_of_corner, double blend) {
    const double height = std::pow(10.0, random_.uniform(-9.0, -3.0));
    const Mat3 turn = random_.rotation();
    const double along = foot_of_corner[0] * (1.0 - blend) + foot_of_corner[1] * blend;
    const std::array<Vec3, 3> flat{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(along, height, 0)};
    const double s = random_.uniform(-0.1, 1.1);
    const double t = random_.uniform(-0.5, 1.5) * height;
    const Vec3 point(s, t,
                     random_.coin() ? random_.uniform(-1.0, 1.0) : random_.signed_power(-9.0, 0.0));
    return {turn * point, {turn * flat[0], turn * flat[1], turn * flat[2]}};
  }

  PointTriangle far_from_origin() {
    const Vec3 offset = 1e6 * random_.direction();
    const double size = std::pow(10.0, random_.uniform(-3.0, 0.0));
    PointTriangle query{offset + size * random_.in_cube(2.0), random_triangle()};
    for (Vec3& corner : query.x) corner = offset + size * corner;
    return query;
  }

  PointTriangle tiny() {
    PointTriangle query = random_.coin() ? near_side(random_.uniform(-2.0, 2.0)) : above_a_vertex();
    query.p *= 1e-9;
    for (Vec3& corner : query.x) corner *= 1e-9;
    return query;
  }

  PointTriangle rotated_flat_grid() {
    const Mat3 turn = random_.rotation();
    const Vec3 corner(random_.integer(-8, 8), random_.integer(-8, 8), 0.0);
    const std::array<Vec3, 3> flat{corner, corner + Vec3(1, 0, 0),
                                   corner + Vec3(random_.coin() ? 1 : 0, 1, 0)};
    const std::size_t k = random_.index(3);
    const double t = random_.coin() ? random_.unit() : 0.25 * random_.integer(0, 4);
    const Vec3 point =
        (1.0 - t) * flat[k] + t * flat[(k + 1) % 3] + Vec3(0, 0, random_.uniform(-1.0, 1.0));
    return {turn * point, {turn * flat[0], turn * flat[1], turn * flat[2]}};
  }

  /// Half with few bits in corners and parameter, so that the point is on the side to the last bit.
  PointTriangle on_an_edge() {
    auto x = random_triangle();
    double t = random_.unit();
    if (random_.coin()) {
      for (Vec3& corner : x) corner = (corner * 0x1p20).array().round().matrix() * 0x1p-20;
      t = random_.integer(0, 1024) * 0x1p-10;
    }
    const std::size_t k = random_.index(3);
    return {x[k] + t * (x[(k + 1) % 3] - x[k]), x};
  }

  PointTriangle degenerate() {
    const Vec3 start = random_.on_lattice(-4, 4);
    const Vec3 step = random_.integer(0, 3) == 0 ? Vec3::Zero().eval() : random_.on_lattice(-2, 2);
    std::array<Vec3, 3> x;
    for (Vec3& corner : x) corner = start + random_.integer(-3, 3) * step;
    Vec3 point = random_.coin() ? random_.on_lattice(-8, 8)
                                : Vec3(start + random_.uniform(-4.0, 4.0) * step);
    if (random_.coin()) {  // collinear up to rounding
      const Mat3 turn = random_.rotation();
      for (Vec3& corner : x) corner = turn * corner;
      point = turn * point;
    }
    return {point, x};
  }

  Random random_;
};

}  // namespace plekton::test
