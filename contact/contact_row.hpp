// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/motion.hpp"

namespace plekton::contact {

/// A contact as it is reported.
struct ContactRow {
  Vec3 point_a;           ///< m, core point of body a
  Vec3 point_b;           ///< m, core point of body b
  Vec3 normal;            ///< unit, from a to b
  double gap;             ///< m
  Vec3 normal_force;      ///< N, on b
  Vec3 tangential_force;  ///< N, on b
};

/// Splits a force on b along the normal.
inline ContactRow contact_row(const Vec3& point_a, const Vec3& point_b, const Vec3& normal,
                              double gap, const Vec3& force) noexcept {
  const Vec3 normal_force = force.dot(normal) * normal;
  return {point_a, point_b, normal, gap, normal_force, force - normal_force};
}

}  // namespace plekton::contact
