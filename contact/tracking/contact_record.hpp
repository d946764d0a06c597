// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/motion.hpp"
#include "geometry/base/function_ref.hpp"
#include "geometry/primitives/feature.hpp"

#include <cstdint>

namespace plekton::contact {

enum class BodyKind : std::uint8_t { sphere, structure, plane };

/// One side of a contact as it is reported.
struct ContactBody {
  BodyKind kind = BodyKind::sphere;
  std::int32_t index = -1;    ///< SphereId, StructureId, or number of the plane
  geometry::Feature feature;  ///< node of a sphere; of a structure the feature that is deepest; of
                              ///< a plane nothing (id -1)

  friend bool operator==(const ContactBody&, const ContactBody&) = default;
};

/// A contact as it is reported: what body a and body b do to each other, of a patch all together.
struct ContactRecord {
  std::int64_t id = 0;  ///< 0: not numbered yet (Contacts::assign_ids)
  ContactBody a;
  ContactBody b;
  Vec3 point_a;                ///< m, core point of body a
  Vec3 point_b;                ///< m, core point of body b
  Vec3 point;                  ///< m, contact point, where the forces act
  Vec3 normal;                 ///< unit, from a to b
  double gap;                  ///< m
  double deepest = 0.0;        ///< m, how far structures are in each other where they are furthest;
                               ///< 0 of other bodies
  Vec3 normal_force;           ///< N, on b
  Vec3 tangential_force;       ///< N, on b
  Vec3 moment = Vec3::Zero();  ///< N m, on b about the contact point
  double elastic_force = 0.0;  ///< N, magnitude of the elastic normal force
  bool is_bonded =
      false;  ///< the bodies stick to each other (HasInteractionRange); between structures
              ///< a bond has a row of its own, without the elastic normal force
  bool is_slipping = false;  ///< the tangential force is at its limit (tangential_limit())

  Vec3 force() const noexcept { return normal_force + tangential_force; }
};

/// Splits a force on b along the normal.
inline void set_force(ContactRecord& row, const Vec3& force) noexcept {
  row.normal_force = force.dot(row.normal) * row.normal;
  row.tangential_force = force - row.normal_force;
}

using VisitRecord = geometry::FunctionRef<void(const ContactRecord&)>;

}  // namespace plekton::contact
