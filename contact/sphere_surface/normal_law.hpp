// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace plekton::contact {

/// The normal part of one contact over the distance of a sphere's centre from a core, for code that
/// does not know the law. Refers to an object, which must live as long.
class NormalLaw {
 public:
  /// @param law    energy(gap) -> J and force(gap) -> N, the energy's negative slope, of a gap in m:
  ///               the distance less the range; 0 energy where bodies do not touch
  /// @param range  m; 0 for a law that goes by the distance
  template <class Law>
  explicit NormalLaw(const Law& law, double range = 0.0) noexcept
      : law_(&law),
        range_(range),
        energy_([](const void* object, double gap) {
          return static_cast<double>(static_cast<const Law*>(object)->energy(gap));
        }),
        force_([](const void* object, double gap) {
          return static_cast<double>(static_cast<const Law*>(object)->force(gap));
        }) {}

  double energy(double distance) const { return energy_(law_, distance - range_); }
  double force(double distance) const { return force_(law_, distance - range_); }

 private:
  const void* law_;
  double range_;
  double (*energy_)(const void*, double);
  double (*force_)(const void*, double);
};

}  // namespace plekton::contact
