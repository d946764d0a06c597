// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/contact_rule_reference.hpp"
#include "tests/support/contact_surfaces.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

/// The reference in C++ against the contact rule's reference in Python, if that and numpy are at
/// hand.
namespace plekton::test::contact_rule_oracle_test {
namespace {

const std::filesystem::path kOracle =
    std::filesystem::path(PLEKTON_SOURCE_DIR) / "../shared/oracle/contact_rule.py";
constexpr const char* kPython = "/usr/bin/python3 -B";

struct Case {
  Vec3 centre;
  double range;
  Complex complex;
};

std::vector<Case> random_cases() {
  Random random(7);
  std::vector<Case> cases;
  while (cases.size() < 200) {
    // Not on a lattice: of seams that tie on a ring the two references may take different ones.
    Complex complex =
        random.coin() ? roughened(sheet(3), 1.0, 0.1, random) : random_complex(random, false);
    const Surface surface = complex.surface();
    if (surface.cell_count() == 0) continue;
    const Vec3 centre = random_point(random, complex);
    const auto nodes = cell_nodes(surface);
    const double nearest =
        reference_contact(centre, 0.0, nodes, complex.x, [](double u) { return u; }).nearest;
    if (nearest < 1e-3) continue;
    cases.push_back({centre, nearest * random.uniform(1.0, 1.5), std::move(complex)});
  }
  return cases;
}

/// A script that reads the cases as literals and prints force and number of components, one case a
/// line.
void write_script(const std::filesystem::path& script, const std::vector<Case>& cases) {
  std::ofstream out(script);
  out.precision(17);
  const auto vector = [&](const Vec3& v) {
    out << '(' << v[0] << ',' << v[1] << ',' << v[2] << "),";
  };
  out << "import sys\nsys.path.insert(0, sys.argv[1])\nimport numpy as np\nfrom contact_rule "
         "import force\ncases = [\n";
  for (const Case& item : cases) {
    out << "([";
    vector(item.centre);
    out << "], [";
    for (const Vec3& x : item.complex.x) vector(x);
    out << "], [";
    for (const auto& nodes : cell_nodes(item.complex.surface())) {
      out << '(';
      for (const int node : nodes) out << node << ',';
      out << "),";
    }
    out << "], " << item.range << "),\n";
  }
  out << "]\nfor a, x, cells, r in cases:\n"
         "    F, n, _ = force(np.array(a), [(0,)], np.array(x), cells, r)\n"
         "    print('%.17g %.17g %.17g %d' % (*F, n))\n";
}

bool can_run_oracle() {
  return std::filesystem::exists(kOracle) &&
         std::system((std::string(kPython) + " -c 'import numpy' > /dev/null 2>&1").c_str()) == 0;
}

TEST(ContactRuleReference, AgreesWithTheReferenceInPython) {
  if (!can_run_oracle()) {
    GTEST_SKIP() << "needs " << kOracle << " and numpy for " << kPython
                 << "; a valley is worked out by hand in its place";
  }
  const TemporaryFolder folder;
  const auto script = folder.path() / "cases.py";
  const auto answers = folder.path() / "answers.txt";
  const auto cases = random_cases();
  write_script(script, cases);

  const std::string command = std::string(kPython) + " '" + script.string() + "' '" +
                              kOracle.parent_path().string() + "' > '" + answers.string() + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);

  std::ifstream in(answers);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Case& item = cases[i];
    Vec3 force;
    int components = 0;
    ASSERT_TRUE(in >> force[0] >> force[1] >> force[2] >> components);
    const auto result =
        reference_contact(item.centre, item.range, cell_nodes(item.complex.surface()),
                          item.complex.x, [](double u) { return u; });
    EXPECT_EQ(result.components, components) << "case " << i;
    EXPECT_NEAR((result.force - force).norm(), 0.0, 1e-12 * item.range * result.cells)
        << "case " << i;
  }
}

/// A ball over the floor of a valley of two facets, each at 45 degrees, with their common edge
/// along y: over a height of 1 m the facets are sqrt(1/2) m away, each with a normal that is up by
/// that part, and the edge is 1 m away. Out of reach of the edge the ball has two contacts; within
/// it they hang together, and the edge is taken away once.
TEST(ContactRuleReference, GivesTheForcesOfAValleyAsTheyAreWorkedOutByHand) {
  const std::vector<Vec3> x = {Vec3(0, -5, 0), Vec3(0, 5, 0), Vec3(-5, 0, 5), Vec3(5, 0, 5)};
  const std::vector<std::vector<int>> cells = {{0, 1, 2}, {0, 1, 3}};
  const auto over = [&](double range) {
    return reference_contact(Vec3(0, 0, 1), range, cells, x, [](double u) { return u; });
  };
  const double away = std::sqrt(0.5);

  EXPECT_EQ(over(0.7).components, 0);
  EXPECT_EQ(over(0.9).components, 2);
  EXPECT_EQ(over(1.1).components, 1);

  const double two = 2.0 * (0.9 - away) * away;
  const double one = 2.0 * (1.1 - away) * away - (1.1 - 1.0);
  EXPECT_NEAR((over(0.9).force - Vec3(0, 0, two)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((over(1.1).force - Vec3(0, 0, one)).norm(), 0.0, 1e-15);
}

/// Over the edge of a ridge, or of a flat sheet, both facets and their seam are the edge: one
/// contact.
TEST(ContactRuleReference, CountsOneContactOnAnEdgeOfAFlatSheet) {
  const std::vector<Vec3> x = {Vec3(0, -5, 0), Vec3(0, 5, 0), Vec3(-5, 0, 0), Vec3(5, 0, 0)};
  const auto result = reference_contact(Vec3(0, 0, 0.8), 1.0, {{0, 1, 2}, {0, 1, 3}}, x,
                                        [](double u) { return u; });

  EXPECT_EQ(result.cells, 2);
  EXPECT_EQ(result.components, 1);
  EXPECT_NEAR((result.force - Vec3(0, 0, 0.2)).norm(), 0.0, 1e-15);
}

}  // namespace
}  // namespace plekton::test::contact_rule_oracle_test
