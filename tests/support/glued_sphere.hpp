// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/cohesive_frictional.hpp"
#include "contact/models.hpp"

#include <vector>

/// A sphere that is glued to a sheet of two facets, and pulled off it.
namespace plekton::test::glued {

using namespace contact;

inline constexpr double kSphere = 0.05;                                  // m
inline constexpr double kThickness = 0.02;                               // m, radius of the facet
inline constexpr double kModulus = 1e7;                                  // Pa
inline constexpr double kStrength = 5e4;                                 // Pa
inline constexpr double kTension = kStrength * kThickness * kThickness;  // N
inline const double kStiffness = 2.0 * kModulus * kSphere * kThickness / (kSphere + kThickness);

/// Two facets side by side, and a sphere above them.
class GluedSphere {
 public:
  GluedSphere(const CohesiveFrictional::Properties& properties, const Vec3& foot)
      : foot_(foot),
        contacts_(model_of<CohesiveFrictional>({{{MaterialId{0}, MaterialId{0}}, properties}})(
            {.spheres = spheres_,
             .surface = surface_,
             .materials = {Material{kModulus, 0.5, 0.4}},
             .of_spheres = {MaterialId{0}},
             .of_structures = {MaterialId{0}},
             .masses = {},
             .skin = 0.01,
             .meets_planes = {},
             .rest = {}})) {}

  /// Moves the sphere to a gap. @returns the forces on all nodes; the sphere is the last
  const NodeForces& move_to(double gap) {
    const double dt = 1e-3;
    const Vec3 place = foot_ + (kSphere + kThickness + gap) * Vec3::UnitZ();
    v_.back() = x_.back().isZero(0.0) ? Vec3(Vec3::Zero()) : Vec3((place - x_.back()) / dt);
    x_.back() = place;
    contacts_->advance({x_, v_, w_}, {}, dt, pool_, forces_);
    return forces_;
  }
  std::size_t touching() const { return contacts_->counts().sphere_surface; }

 private:
  std::vector<Vec3> x_{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.2, 0.9, 0), Vec3(1.1, 1, 0),
                       Vec3::Zero()};
  std::vector<Vec3> v_{5, Vec3::Zero()};
  std::vector<Vec3> w_{5, Vec3::Zero()};
  std::vector<geometry::Sphere> spheres_{{{NodeId{4}}, kSphere}};
  std::vector<geometry::Facet> facets_{{{NodeId{0}, NodeId{1}, NodeId{2}}, kThickness},
                                       {{NodeId{1}, NodeId{3}, NodeId{2}}, kThickness}};
  geometry::Surface surface_{{}, facets_, 5};
  Vec3 foot_;
  std::unique_ptr<Contacts> contacts_;
  geometry::ThreadPool pool_;
  NodeForces forces_{5};
};

}  // namespace plekton::test::glued
