// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/bond_law.hpp"

#include "tests/support/beam_structure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

namespace plekton::test::bond_law_test {
namespace {

using dynamics::BondLaw;
using dynamics::BondStrength;
using dynamics::WireCurve;
using testing::HasSubstr;
using testing::IsEmpty;

const WireCurve kCurve{{{0.002, 1000.0}, {0.01, 1500.0}}};  // 5e5 N for each unit of strain

/// Three wires in a row.
Scene wires() {
  return chain(3, 1.0, dynamics::wire_section(0.001, kCurve));
}

std::string problems_of(const std::vector<BondLaw>& laws, const std::vector<BeamBond>& bonds) {
  std::ostringstream text;
  dynamics::list_problems(laws, bonds, text);
  return text.str();
}

TEST(BondLaw, MayBeOfAnyBondsInAnyOrderOrOfNone) {
  const Scene scene = wires();

  EXPECT_THAT(problems_of({{kCurve, {2, 0}}, {BondStrength{}, {1}}, {kCurve, {}}}, scene.bonds),
              IsEmpty());
  EXPECT_THAT(problems_of({}, scene.bonds), IsEmpty());
  EXPECT_THAT(problems_of({{BondStrength{}, {}}}, {}), IsEmpty());
}

TEST(BondLaw, IsOfEachBondOnceAlsoWithinItself) {
  const Scene scene = wires();

  EXPECT_EQ(problems_of({{kCurve, {1, 2, 1}}, {BondStrength{}, {0, 2}}}, scene.bonds),
            "bond law 0: bond 1 has a law already; give it one\n"
            "bond law 1: bond 2 has a law already; give it one\n");
  EXPECT_EQ(problems_of({{BondStrength{}, {3}}}, scene.bonds),
            "bond law 0: bond 3 does not exist; there are 3 bonds\n");
}

/// What is wrong with a law itself is told under its number, and its bonds are not measured by it.
TEST(BondLaw, ThatIsNoneIsNotCompared) {
  const Scene scene = chain(1, 1.0, dynamics::circular_section(0.01, 1e9, 0.3));
  BondStrength brittle;
  brittle.strength = 0.0;

  const std::string problems =
      problems_of({{kCurve, {}}, {brittle, {0}}, {WireCurve{{{0.1, -1.0}}}, {0}}}, scene.bonds);

  EXPECT_THAT(problems, HasSubstr("bond law 1: strength is 0 Pa; it must be positive\n"));
  EXPECT_THAT(problems, HasSubstr("bond law 2: "));
  EXPECT_THAT(problems, HasSubstr("bond law 2: bond 0 has a law already; give it one\n"));
  EXPECT_THAT(problems, Not(HasSubstr("use wire_section")));
}

TEST(BondLaw, OfAWireWantsABarAsStiffAsItsCurveButForRounding) {
  const std::vector<BondLaw> laws{{kCurve, {0}}};
  Scene scene = wires();
  dynamics::BeamSection& section = scene.bonds[0].section;
  const double modulus = section.young_modulus;

  section.young_modulus = modulus * (1.0 + 1e-15);
  EXPECT_THAT(problems_of(laws, scene.bonds), IsEmpty());
  for (const double factor : {1.0 - 1e-9, 1.0 + 1e-9}) {
    section.young_modulus = modulus * factor;
    EXPECT_THAT(problems_of(laws, scene.bonds),
                HasSubstr("N, but the first piece of its curve has 500000 N for each unit of "
                          "strain; use wire_section"));
  }
  section.young_modulus = modulus;
  section.torsion_constant = 1e-20;
  EXPECT_EQ(problems_of(laws, scene.bonds),
            "bond law 0: bond 0: follows the curve of a wire, which neither bends nor twists, but "
            "its section does; use wire_section\n");
}

}  // namespace
}  // namespace plekton::test::bond_law_test
