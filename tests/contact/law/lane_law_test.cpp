// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/law/lane_law.hpp"

#include "geometry/base/rows.hpp"
#include "tests/support/contact_laws.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

/// Every law side by side against one contact after the other: the same bits in every lane, also
/// beside lanes whose numbers are none.
namespace plekton::contact::lane_law_test {
namespace {

using geometry::RowsOf;
using test::Random;

template <class Law>
class LaneLawOf : public testing::Test {
 protected:
  using Parameters = typename Law::Parameters;
  using History = typename Law::History;
  static constexpr std::size_t kLanes = 8;
  static constexpr double kStep = 1e-5;  // s

  struct Contact {
    Parameters parameters;
    RelativeMotion motion;
    FrameRotation rotation;
    History history{};
  };

  Body random_body() {
    return {{random_.uniform(1e6, 3e6), random_.uniform(0.1, 1.0), random_.uniform(0.0, 1.0),
             random_.uniform(0.0, 0.45)},
            random_.uniform(5e-4, 2e-3),
            random_.coin() ? random_.uniform(1e-6, 1e-4) : std::numeric_limits<double>::infinity()};
  }
  RelativeMotion random_motion(const Parameters& p, const Vec3& normal) {
    const double gap = 1e-5 * random_.uniform(-1.0, 0.5);
    return relative_motion(normal, gap, Law::elastic_normal_force(p, gap), random_.in_cube(1.0),
                           random_.in_cube(500.0));
  }
  Contact random_contact() {
    Contact c;
    // Without properties limits may be infinite.
    const auto properties =
        random_.unit() < 0.2 ? PropertiesOf<Law>{} : test::random_properties<Law>(random_);
    c.parameters = combine<Law>(properties, random_body(), random_body());
    const Vec3 last = random_.direction();
    for (int k = static_cast<int>(random_.index(4)); k > 0; --k)
      Law::force(c.parameters, random_motion(c.parameters, last), c.history, kStep);
    const Vec3 normal = (last + 0.01 * random_.in_cube(1.0)).normalized();
    c.motion = random_motion(c.parameters, normal);
    c.rotation = {last, normal, 1e-3 * random_.uniform(-1.0, 1.0)};
    return c;
  }

  /// What a law makes of a contact, number by number.
  template <class Real, class Contacts>
  PLEKTON_INLINE static auto outcome(Contacts c) {
    struct Outcome {
      typename Law::template HistoryOf<Real> history;
      ContactForceOf<Real> answer;
      Real elastic, energy_before, energy_after, hold, reach;
    } out;
    Law::rotate(c.history, c.rotation);
    out.energy_before = Law::history_energy(c.parameters, c.history);
    out.elastic = Law::elastic_normal_force(c.parameters, c.motion.gap);
    out.answer = Law::force(c.parameters, c.motion, c.history, kStep);
    out.energy_after = Law::history_energy(c.parameters, c.history);
    out.history = c.history;
    out.hold = out.reach = Real(0.0);
    if constexpr (HasInteractionRange<Law>) {
      out.hold = Law::hold(c.history);
      out.reach = Law::interaction_range(c.parameters);
    }
    return out;
  }

  template <int W>
  void expect_the_same_bits(const std::array<Contact, kLanes>& contacts) {
    using Real = Pack<W>;
    struct Packs {
      typename Law::template ParametersOf<Real> parameters;
      RelativeMotionOf<Real> motion;
      FrameRotationOf<Real> rotation;
      typename Law::template HistoryOf<Real> history;
    };
    RowsOf<Contact, kLanes> rows;
    for (std::size_t lane = 0; lane < kLanes; ++lane) rows.set(lane, contacts[lane]);
    for (std::size_t first = 0; first < kLanes; first += std::size_t{W}) {
      const auto found = outcome<Real>(rows.template load<Packs>(first));
      for (std::size_t lane = 0; lane < std::size_t{W}; ++lane) {
        const auto one = outcome<double>(contacts[first + lane]);
        std::array<double, sizeof(one) / sizeof(double)> expected;
        std::memcpy(expected.data(), &one, sizeof(one));
        for (std::size_t n = 0; n < expected.size(); ++n) {
          std::array<double, std::size_t{W}> row;
          std::memcpy(row.data(), reinterpret_cast<const char*>(&found) + n * sizeof(row),
                      sizeof(row));
          if (std::isnan(expected[n])) {
            ASSERT_TRUE(std::isnan(row[lane])) << "number " << n;
          } else {
            ASSERT_EQ(row[lane], expected[n]) << "number " << n;
          }
        }
      }
    }
  }

  Random random_{11};
};

TYPED_TEST_SUITE(LaneLawOf, test::LaneLaws);

TYPED_TEST(LaneLawOf, HasTheBitsOfOneContactAfterTheOther) {
  static_assert(LaneLaw<TypeParam>);
  for (int trial = 0; trial < 300; ++trial) {
    std::array<typename TestFixture::Contact, TestFixture::kLanes> contacts;
    for (auto& contact : contacts) contact = this->random_contact();
    // A lane without a pair.
    if (trial % 3 == 0)
      contacts[this->random_.index(TestFixture::kLanes)].motion.normal.setConstant(
          std::numeric_limits<double>::quiet_NaN());

    this->template expect_the_same_bits<2>(contacts);
    this->template expect_the_same_bits<4>(contacts);
    this->template expect_the_same_bits<8>(contacts);
  }
}

}  // namespace
}  // namespace plekton::contact::lane_law_test
