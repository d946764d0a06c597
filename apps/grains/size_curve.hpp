// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace plekton::apps {

class Random;

/// What the share of grains that pass a sieve counts.
enum class PassingBy : std::uint8_t { mass, number };

/// A row of a sieve table.
struct Sieve {
  double size;     ///< m, > 0: opening of the sieve, the diameter of the largest grain that passes
  double passing;  ///< share of all grains that passes, 0 to 1
};

/// Distribution of grain sizes: a sieve table, straight between its rows.
///
/// Between two sieves the share that passes grows linearly with the diameter d. By number that is a
/// uniform density of d; by mass the number density is proportional to d^-3, because a grain's mass
/// is to d^3.
class SizeCurve {
 public:
  /// All grains of one diameter (m, > 0).
  explicit SizeCurve(double diameter);
  /// @param sieves  At least 2, sizes increasing and > 0, passing from 0 up to 1 without going
  /// down.
  SizeCurve(std::span<const Sieve> sieves, PassingBy by);

  /// Mean volume (m³) of a grain, each counted once.
  double mean_volume() const noexcept { return mean_volume_; }
  double largest_diameter() const noexcept;

  /// Diameter (m) that a share (0 to 1) of the grains by number is smaller than.
  double diameter_at(double share_by_number) const noexcept;

  /// Diameters (m) of a number of grains, the largest first. The curve is cut into as many parts of
  /// equal number and one diameter drawn from each, so that a small sample follows the curve as
  /// well.
  std::vector<double> draw(std::size_t count, Random& random) const;

  bool operator==(const SizeCurve&) const = default;

 private:
  /// The grains between two sieves.
  struct Bin {
    double low;    ///< m
    double high;   ///< m
    double share;  ///< by number
    bool operator==(const Bin&) const = default;
  };
  void normalise();

  std::vector<Bin> bins_;
  PassingBy by_ = PassingBy::number;
  double mean_volume_ = 0.0;
};

}  // namespace plekton::apps
