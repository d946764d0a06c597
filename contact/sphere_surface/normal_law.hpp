// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace plekton::contact {

/// The elastic normal part of one contact over the distance of a sphere's centre from a core, for
/// code that does not know the law. Refers to an object, which must live as long.
class NormalLaw {
 public:
  /// @param law  energy(distance) -> J and force(distance) -> N, the energy's negative slope, of a
  ///             distance in m; 0 energy at the range and beyond
  template <class Law>
  explicit NormalLaw(const Law& law) noexcept
      : law_(&law),
        energy_([](const void* object, double distance) {
          return static_cast<double>(static_cast<const Law*>(object)->energy(distance));
        }),
        force_([](const void* object, double distance) {
          return static_cast<double>(static_cast<const Law*>(object)->force(distance));
        }) {}

  double energy(double distance) const { return energy_(law_, distance); }
  double force(double distance) const { return force_(law_, distance); }

 private:
  const void* law_;
  double (*energy_)(const void*, double);
  double (*force_)(const void*, double);
};

}  // namespace plekton::contact
