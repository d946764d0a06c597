// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/units.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>

namespace plekton::apps::units_test {
namespace {

using testing::HasSubstr;

std::string error_of(std::string_view text, const Dimension& expected) {
  try {
    parse_quantity(text, expected);
  } catch (const UnitError& error) {
    return error.what();
  }
  return "";
}

TEST(Units, AreWorthTheNearestDoubleOfTheirValueInSi) {
  EXPECT_EQ(parse_quantity("5 mm", kLength), 0.005);
  EXPECT_EQ(parse_quantity("9 mm", kLength), 0.009);
  EXPECT_EQ(parse_quantity("20 kPa", kPressure), 20e3);
  EXPECT_EQ(parse_quantity("2650 kg/m3", kDensity), 2650.0);
  EXPECT_EQ(parse_quantity("1.5 s", kTime), 1.5);
  EXPECT_EQ(parse_quantity("9.81 m/s2", kAcceleration), 9.81);
  EXPECT_EQ(parse_quantity("30 %", kNumber), 0.3);
  EXPECT_EQ(parse_quantity("180 deg", kAngle), std::numbers::pi);
  EXPECT_EQ(parse_quantity("300 g/m2", kArealMass), 0.3);
  EXPECT_EQ(parse_quantity("36 km/h", kVelocity), 10.0);
  EXPECT_EQ(parse_quantity("2 min", kTime), 120.0);
}

TEST(Units, MayBeLeftOutForSi) {
  EXPECT_EQ(parse_quantity("0.005", kLength), 0.005);
  EXPECT_EQ(parse_quantity("-1e-3", kLength), -0.001);
  EXPECT_EQ(parse_quantity("+2", kLength), 2.0);
}

TEST(Units, ComeInEveryCommonSpelling) {
  for (const char* text : {"2.5 kg/m3", "2.5kg/m^3", "2.5 kg m-3", "2.5 kg*m^-3", " 2.5 kg / m³ ",
                           "2.5 kg·m-3", "0.0025 t/m3", "2.5 g/l"}) {
    EXPECT_DOUBLE_EQ(parse_quantity(text, kDensity), 2.5) << text;
  }
  EXPECT_EQ(parse_quantity("1 N/mm2", kPressure), 1e6);
  EXPECT_EQ(parse_quantity("1 kg/m/s2", kPressure), 1.0);
  for (const char* micro : {"\u00b5", "\u03bc"}) {  // micro sign and Greek letter
    EXPECT_EQ(parse_quantity(std::string("3 ") + micro + "m", kLength), 3e-6);
    EXPECT_EQ(parse_quantity(std::string("3 ") + micro + "s", kTime), 3e-6);
    EXPECT_EQ(parse_quantity(std::string("3 ") + micro + "J", kEnergy), 3e-6);
  }
  EXPECT_EQ(parse_quantity("90°", kAngle), 0.5 * std::numbers::pi);
}

TEST(Units, OfAnotherKindAreRefusedWithBothKindsNamed) {
  EXPECT_EQ(error_of("5 s", kLength),
            "got \"5 s\", a time; expected a length (m, cm, mm, um, nm, km)");
  EXPECT_THAT(error_of("35 mm", kAngle),
              HasSubstr("got \"35 mm\", a length; expected an angle (deg, rad)"));
  EXPECT_THAT(error_of("35 deg", kNumber), HasSubstr("an angle; expected a number without unit"));
  EXPECT_THAT(error_of("1 kg s", kTime), HasSubstr("a quantity in kg s"));
}

TEST(Units, ThatAreUnknownBringASuggestion) {
  EXPECT_THAT(
      error_of("5 mn", kLength),
      HasSubstr("unknown unit \"mn\"; expected a length (m, cm, mm, um, nm, km); did you mean"));
  EXPECT_THAT(error_of("5 Mpa", kPressure), HasSubstr("did you mean \"MPa\"?"));
  EXPECT_THAT(error_of("5 parsec", kLength), HasSubstr("unknown unit \"parsec\""));
}

TEST(Units, ThatCanBeReadInTwoWaysAreRefused) {
  EXPECT_THAT(error_of("1 kg/m s2", kPressure), HasSubstr("write a slash before each"));
}

TEST(Units, AroundNoNumberAreRefused) {
  EXPECT_THAT(error_of("", kLength), HasSubstr("does not begin with a number"));
  EXPECT_THAT(error_of("mm", kLength), HasSubstr("does not begin with a number"));
  EXPECT_THAT(error_of("+-5 mm", kLength), HasSubstr("does not begin with a number"));
  EXPECT_THAT(error_of("0,5 mm", kLength), HasSubstr("decimal sign must be a point"));
  EXPECT_THAT(error_of("nan mm", kLength), HasSubstr("not finite"));
  EXPECT_THAT(error_of("inf", kLength), HasSubstr("not finite"));
  EXPECT_THAT(error_of("1e400 m", kLength), HasSubstr("no double can hold"));
  EXPECT_THAT(error_of("1e308 km", kLength), HasSubstr("no double can hold"));
}

TEST(Units, CutShortAreRefused) {
  EXPECT_EQ(error_of("1 /Hz", kTime),
            "got \"1 /Hz\", where a unit is missing before \"/Hz\"; write the reciprocal of a unit "
            "with a negative power, as in \"1 s-1\"; expected a time (s, ms, us, min, h)");
  EXPECT_THAT(error_of("1 kg/", kDensity), HasSubstr("ends in the middle of a unit"));
  EXPECT_THAT(error_of("1 m^", kArea), HasSubstr("a power is not an integer"));
  EXPECT_THAT(error_of("1 m22", kArea), HasSubstr("a power is not an integer"));
}

}  // namespace
}  // namespace plekton::apps::units_test
