// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <stdexcept>
#include <string_view>

/// Values with units, as people write them: "5 mm", "20 kPa", "2650 kg/m3", "35 deg".
namespace plekton::apps {

/// What kind of quantity a value is: the powers of kilogram, metre, second and radian in its unit.
/// An angle is kept apart from a number, so that "35 deg" is refused as a length and "35 mm" as an
/// angle.
struct Dimension {
  std::string_view name;      ///< with article, as in "expected a length"
  std::array<int, 4> powers;  ///< kg, m, s, rad
  std::string_view si_unit;   ///< empty for a number
  std::string_view units;     ///< some that people use, for messages
};

inline constexpr Dimension kNumber{"a number without unit", {0, 0, 0, 0}, "", "none, %"};
inline constexpr Dimension kStrain{"a strain", {0, 0, 0, 0}, "", "none, %"};
inline constexpr Dimension kLength{"a length", {0, 1, 0, 0}, "m", "m, cm, mm, um, nm, km"};
inline constexpr Dimension kArea{"an area", {0, 2, 0, 0}, "m2", "m2, cm2, mm2"};
inline constexpr Dimension kVolume{"a volume", {0, 3, 0, 0}, "m3", "m3, l, cm3, mm3"};
inline constexpr Dimension kTime{"a time", {0, 0, 1, 0}, "s", "s, ms, us, min, h"};
inline constexpr Dimension kMass{"a mass", {1, 0, 0, 0}, "kg", "kg, g, mg, t"};
inline constexpr Dimension kAngle{"an angle", {0, 0, 0, 1}, "rad", "deg, rad"};
inline constexpr Dimension kVelocity{"a velocity", {0, 1, -1, 0}, "m/s", "m/s, mm/s, cm/min, km/h"};
inline constexpr Dimension kAcceleration{"an acceleration", {0, 1, -2, 0}, "m/s2", "m/s2, mm/s2"};
inline constexpr Dimension kForce{"a force", {1, 1, -2, 0}, "N", "N, kN, MN, mN"};
inline constexpr Dimension kRate{"a rate", {0, 0, -1, 0}, "1/s", "Hz, s-1"};
inline constexpr Dimension kAngularVelocity{
    "an angular velocity", {0, 0, -1, 1}, "rad/s", "rad/s, deg/s"};
inline constexpr Dimension kTorque{"a torque", {1, 2, -2, 0}, "N m", "N m, kN m, N mm"};
inline constexpr Dimension kEnergy{"an energy", {1, 2, -2, 0}, "J", "J, kJ, mJ, uJ"};
inline constexpr Dimension kPressure{
    "a pressure or modulus", {1, -1, -2, 0}, "Pa", "Pa, kPa, MPa, GPa, N/mm2"};
inline constexpr Dimension kStiffness{
    "a stiffness (force per length)", {1, 0, -2, 0}, "N/m", "N/m, kN/m, N/mm"};
inline constexpr Dimension kEnergyPerArea{
    "an energy per area", {1, 0, -2, 0}, "J/m2", "J/m2, mJ/m2, N/m"};
inline constexpr Dimension kBendingStiffness{
    "a bending stiffness (moment)", {1, 2, -2, 0}, "N m", "N m, N mm, kN m"};
inline constexpr Dimension kDensity{"a density", {1, -3, 0, 0}, "kg/m3", "kg/m3, g/cm3, t/m3"};
inline constexpr Dimension kArealMass{"a mass per area", {1, -2, 0, 0}, "kg/m2", "kg/m2, g/m2"};

/// A text that is not a quantity of the expected kind. The message says what was got, what was
/// expected, and the units known for it.
struct UnitError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The value in SI units of a number with a unit. A number alone is in SI units already.
///
/// A unit is a product of symbols with integer powers: "m/s2", "kg m-3", "N/mm^2", "g/cm³". After
/// the first slash only slashes may follow, because "J/kg m" could be read in two ways.
/// @throws UnitError for anything else, for another kind of quantity, and for a value that is not
/// finite.
double parse_quantity(std::string_view text, const Dimension& expected);

}  // namespace plekton::apps
