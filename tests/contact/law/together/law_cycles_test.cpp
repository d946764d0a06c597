// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/contact_laws.hpp"

#include <array>
#include <cmath>
#include <numbers>

/// Tries to gain energy from a contact law: smooth random cycles of gap, slip and rotation.
namespace plekton::contact::law_cycles_test {
namespace {

constexpr double kSize = 1e-4;  ///< m, of the overlaps

/// How body b moves relative to a, over a parameter of period 2 pi.
class Cycle {
 public:
  explicit Cycle(test::Random& random) : normal_(random.direction()) {
    for (double& s : shape_) s = random.uniform(-1.0, 1.0);
  }

  const Vec3& normal() const { return normal_; }
  double gap(double t) const {
    return kSize * (-0.6 + 0.6 * shape_[0] * std::sin(t) + 0.3 * shape_[1] * std::cos(2 * t));
  }
  /// m
  Vec3 place(double t) const {
    const Vec3 u = normal_.unitOrthogonal();
    return gap(t) * normal_ + kSize * (wave(2, t) * u + wave(5, t) * normal_.cross(u));
  }
  /// rad, small
  Vec3 rotation(double t) const {
    const Vec3 u = normal_.unitOrthogonal();
    return 1e-3 * (wave(8, t) * normal_ + wave(11, t) * u + wave(14, t) * normal_.cross(u));
  }

 private:
  double wave(std::size_t k, double t) const {
    return shape_[k] * std::sin(t) + shape_[k + 1] * std::cos(2 * t) +
           shape_[k + 2] * std::sin(3 * t);
  }

  Vec3 normal_;
  std::array<double, 17> shape_;
};

template <class Law>
class LawCycles : public ::testing::Test {
 protected:
  using Parameters = typename Law::Parameters;

  Parameters random_parameters() {
    const auto body = [&] {
      return Body{{std::pow(10.0, random_.uniform(5.0, 8.0)), random_.uniform(0.1, 1.0),
                   random_.uniform(0.0, 1.0), random_.uniform(0.0, 0.45)},
                  random_.uniform(0.01, 0.1),
                  random_.uniform(0.1, 1.0)};
    };
    return combine<Law>(test::random_properties<Law>(random_), body(), body());
  }

  struct Balance {
    double excess;      ///< J, dissipated or kept, less what was put in
    double dissipated;  ///< J
  };

  /// Goes round a cycle of a given period (s) three times.
  Balance around(const Cycle& cycle, const Parameters& p, int steps, double period) {
    const double dt = period / steps;
    const auto answer = [&](double now, double last, typename Law::History& history,
                            double length) {
      const double rate = length > 0.0 ? 1.0 / length : 0.0;
      const double gap = cycle.gap(now);
      return Law::force(p,
                        relative_motion(cycle.normal(), gap, Law::elastic_normal_force(p, gap),
                                        rate * (cycle.place(now) - cycle.place(last)),
                                        rate * (cycle.rotation(now) - cycle.rotation(last))),
                        history, length);
    };
    typename Law::History history{};
    ContactForce before = answer(0.0, 0.0, history, 0.0);
    const double first =
        Law::elastic_normal_energy(p, cycle.gap(0.0)) + Law::history_energy(p, history);
    double work = 0.0, dissipated = 0.0, t = 0.0;
    for (int step = 1; step <= 3 * steps; ++step) {
      const double now = 2.0 * std::numbers::pi * step / steps;
      const ContactForce result = answer(now, t, history, dt);
      work -= 0.5 * (before.force + result.force).dot(cycle.place(now) - cycle.place(t)) +
              0.5 * (before.moment + result.moment).dot(cycle.rotation(now) - cycle.rotation(t));
      dissipated += result.dissipated;
      before = result;
      t = now;
    }
    const double last =
        Law::elastic_normal_energy(p, cycle.gap(t)) + Law::history_energy(p, history);
    return {last - first + dissipated - work, dissipated};
  }

  test::Random random_{2};
};

TYPED_TEST_SUITE(LawCycles, test::AllLaws);

/// What is put in and not stored at the end has been dissipated; the error of the sum over the
/// steps falls with their number.
TYPED_TEST(LawCycles, GainNoEnergy) {
  using Law = TypeParam;
  for (int trial = 0; trial < 60; ++trial) {
    const auto p = this->random_parameters();
    const Cycle cycle(this->random_);
    const double period = std::pow(10.0, this->random_.uniform(-3.0, 1.0));
    const double scale = Law::normal_stiffness(p, -kSize) * kSize * kSize;

    const auto coarse = this->around(cycle, p, 300, period);
    const auto fine = this->around(cycle, p, 3000, period);

    const double damped = std::max(1.0, std::abs(fine.dissipated) / scale);
    EXPECT_NEAR(coarse.excess, 0.0, 0.02 * scale * damped) << trial;
    EXPECT_NEAR(fine.excess, 0.0, 0.0002 * scale * damped) << trial;
    EXPECT_GE(coarse.dissipated, -1e-12 * scale) << trial;  // rounding
    EXPECT_GE(fine.dissipated, -1e-12 * scale) << trial;
  }
}

}  // namespace
}  // namespace plekton::contact::law_cycles_test
