// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/structure/beam_bond.hpp"

#include <iosfwd>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>

namespace plekton::dynamics {

/// Stresses at which a beam yields and breaks. All limits are of stress: those of a bond follow
/// from its section, with pi, unlike the adhesion of YADE's cylinders, which is a stress times r².
///
/// A, I and J are those of the section, r = 2 sqrt(I / A) its radius if it is a circle, W = I / r
/// and W_t = J / r; H the hardening, p the plastic strain that each limit has seen so far, in
/// either direction (isotropic hardening, each limit for itself):
///
///     tension, compression   |N| <= A (sigma_y + H p),             p = plastic stretch / L0
///     bending at an end      |M| <= W (c sigma_y + H p),           p = r 2 |plastic turn| / L0
///     torsion                |T| <= W_t (tau_y + H/3 p),           p = r |plastic twist| / L0
///
/// with c = moment_ratio. So a bar follows the bilinear law of its material, d sigma = E H /
/// (E + H) d epsilon beyond sigma_y, and a beam in pure bending the bilinear law M(curvature) with
/// the slopes E I and E H / (E + H) I. With c = 1 it yields as soon as its outermost fibre does;
/// that is where the true curve begins to bend, and 41 % below where it ends (plastic moment of a
/// circle, 4/3 r³ sigma_y = 16 / (3 pi) W sigma_y).
///
/// The limits do not see each other: a bar that is pulled and bent may carry N = A sigma_y and
/// M = W sigma_y together, although by the theory of beams its outermost fibre would then be at
/// 2 sigma_y. A full circle that is plastic all through carries 1 / 1.32 of that (N = 2/pi (x + sin
/// x cos x) A sigma_y with M = 4/3 r³ cos³ x sigma_y): so much too strong a bond is at worst, when
/// tension and bending grow together. Where one of them prevails the error is small.
///
/// A bond breaks at once, wholly, where a stress to which tension and bending add up is above the
/// strength, or that of torsion above its own,
///
///     N / A + max(|M_a|, |M_b|) / W > strength   or   |T| / W_t > shear_strength,
///
/// (compression closes cracks, so N counts with its sign), or where a plastic strain of the
/// outermost fibre is above rupture_strain: p of tension and bending together, or p of torsion over
/// sqrt(3).
struct BondStrength {
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  double yield_stress = kNever;  ///< Pa, sigma_y > 0
  /// Pa, tau_y > 0; else sigma_y / sqrt(3) (von Mises).
  std::optional<double> shear_yield_stress = std::nullopt;
  double hardening = 0.0;     ///< Pa, H >= 0, d sigma / d (plastic strain)
  double moment_ratio = 1.0;  ///< c: 1 at first yield of a fibre, kFullyPlastic
  double strength = kNever;   ///< Pa, > 0
  std::optional<double> shear_strength = std::nullopt;  ///< Pa, > 0; else strength / sqrt(3)
  double rupture_strain = kNever;                       ///< -, > 0, plastic

  /// moment_ratio of a full circular section that is plastic all through.
  static constexpr double kFullyPlastic = 16.0 / (3.0 * std::numbers::pi);
};

/// Writes a line for everything that is wrong with a strength.
/// @param name  how the lines begin
void list_problems(const BondStrength& strength, std::string_view name, std::ostream& problems);

/// One limit of a bond, and how it grows.
struct YieldLimit {
  double at_first;   ///< N or N m
  double hardening;  ///< N/m or N m, by plastic stretch (m) or turn (rad)
  double after(double plastic) const noexcept { return at_first + hardening * plastic; }
};

/// What a strength is for the section and length of a bond.
struct BondLimits {
  YieldLimit tension, moment, torque;
  double area;             ///< m²
  double section_modulus;  ///< m³, W; 0 in a bar
  double torsion_modulus;  ///< m³, W_t; 0 in a bar
  double radius;           ///< m, of the outermost fibre; 0 in a bar
  double length;           ///< m, L0
  double strength;         ///< Pa
  double shear_strength;   ///< Pa
  double rupture_strain;   ///< -
};
BondLimits limits_of(const BondStrength& strength, const BeamBond& bond) noexcept;

}  // namespace plekton::dynamics
