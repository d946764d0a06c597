// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/structure/tilt_share.hpp"

namespace plekton::contact::structure {

/// The elastic normal part of any contact law, seen from code that is compiled once for all.
class NormalSpring {
 public:
  /// @param parameters  of the pair; must outlive this
  /// @param range       m, sum of both radii
  template <class Law>
  static NormalSpring of(const typename Law::Parameters& parameters, double range) {
    NormalSpring spring;
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
  double range_ = 0.0;
  double (*energy_)(const void*, double) = nullptr;
  double (*force_)(const void*, double) = nullptr;
};

}  // namespace plekton::contact::structure
