// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace plekton::contact {

/// What one contact stores at a distance, for code that does not know the law. Refers to a function
/// object, which must live as long.
class NormalEnergy {
 public:
  /// @param energy  distance (m) of the centre from the core -> energy (J)
  template <class Energy>
  explicit NormalEnergy(const Energy& energy) noexcept
      : energy_(&energy), call_([](const void* object, double distance) {
          return static_cast<double>((*static_cast<const Energy*>(object))(distance));
        }) {}

  double operator()(double distance) const { return call_(energy_, distance); }

 private:
  const void* energy_;
  double (*call_)(const void*, double);
};

}  // namespace plekton::contact
