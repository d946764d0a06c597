// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/surface_surface/tilt_share.hpp"

#include <algorithm>

namespace plekton::contact::structure {

/// The elastic normal part of any contact law, or its attraction, seen from code that is compiled
/// once for all.
class NormalSpring {
 public:
  /// @param parameters  of the pair; must outlive this
  /// @param range       m, sum of both radii
  /// @param attraction  N, see LawDefaults; must outlive this
  template <class Law>
  static NormalSpring of(const typename Law::Parameters& parameters, double range,
                         const double* attraction = nullptr) {
    NormalSpring spring;
    spring.attraction_ = attraction;
    spring.parameters_ = &parameters;
    spring.range_ = range;
    spring.energy_ = [](const void* p, double gap) {
      return Law::elastic_normal_energy(*static_cast<const typename Law::Parameters*>(p), gap);
    };
    spring.force_ = [](const void* p, double gap) {
      return static_cast<double>(
          Law::elastic_normal_force(*static_cast<const typename Law::Parameters*>(p), gap));
    };
    return spring;
  }

  /// Whether bodies in range attract each other besides.
  bool attracts() const noexcept { return attraction_ != nullptr && *attraction_ > 0.0; }
  /// What attracts them: a constant force in range, and its energy, 0 at the range.
  NormalSpring attraction() const {
    NormalSpring spring;
    spring.parameters_ = attraction_;
    spring.range_ = range_;
    spring.energy_ = [](const void* force, double gap) {
      return *static_cast<const double*>(force) * std::min(gap, 0.0);
    };
    spring.force_ = [](const void* force, double gap) {
      return gap < 0.0 ? -*static_cast<const double*>(force) : 0.0;
    };
    return spring;
  }

  double range() const noexcept { return range_; }
  /// J, at a distance (m) of the cores; 0 out of range.
  double energy(double distance) const { return energy_(parameters_, distance - range_); }
  /// N, > 0 pushes apart.
  double force(double distance) const { return force_(parameters_, distance - range_); }

  Real energy(const Real& distance) const {
    return geometry::chain(distance, energy(distance.value), -force(distance.value));
  }

 private:
  NormalSpring() = default;

  const void* parameters_ = nullptr;
  const double* attraction_ = nullptr;
  double range_ = 0.0;
  double (*energy_)(const void*, double) = nullptr;
  double (*force_)(const void*, double) = nullptr;
};

}  // namespace plekton::contact::structure
