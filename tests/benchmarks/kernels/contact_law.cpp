// SPDX-License-Identifier: GPL-3.0-or-later
// What a law answers to a relative motion: one contact after the other, as on surfaces, and as many
// side by side as the processor's vectors hold, as between spheres.
#include "contact/law/linear_frictional.hpp"
#include "geometry/base/vector_width.hpp"
#include "tests/benchmarks/kernels/run_over.hpp"
#include "tests/benchmarks/kernels/subjects.hpp"
#include "tests/support/seeded_random.hpp"

#include <array>
#include <string>
#include <vector>

namespace plekton::benchmarks {
namespace {

using contact::RelativeMotion;
using geometry::Pack;
using geometry::Vec3;
using Law = contact::LinearFrictional;

constexpr double kTimeStep = 4e-6;         // s
constexpr std::size_t kSideBySide = 4096;  // contacts; they stay in the second cache

/// A contact before the step.
struct LawInput {
  Law::Parameters parameters;
  RelativeMotion motion;
  Law::History history;
};

/// Contacts of grains of 1 mm: overlaps up to 1 um, histories from nothing to a share of the
/// friction limit.
/// @param largest_share  below 1 every contact sticks; at 2 half of them slip
std::vector<LawInput> law_inputs(std::size_t count, double largest_share) {
  test::Random random(1);
  std::vector<LawInput> inputs;
  while (inputs.size() < count) {
    const Law::Parameters parameters{random.uniform(1e3, 3e3), random.uniform(3e2, 9e2), 0.5};
    const Vec3 normal = random.direction();
    const Vec3 tangent = random.direction().cross(normal).normalized();
    const double gap = -1e-6 * random.uniform(0.1, 1.0);
    const double force = Law::elastic_normal_force(parameters, gap);
    const double limit = parameters.friction * force / parameters.tangential_stiffness;
    const Vec3 slip = largest_share * random.unit() * limit * tangent;
    inputs.push_back(
        {parameters, contact::relative_motion(normal, gap, force, random.in_cube(1e-4)), {slip}});
  }
  return inputs;
}

void add_one_by_one(const std::string& name, double largest_share) {
  add_benchmark("law/linear_frictional/" + name, [=](benchmark::State& state) {
    run_over(state, law_inputs(kConfigurations, largest_share), [](const LawInput& input) {
      Law::History history = input.history;
      const auto answer = Law::force(input.parameters, input.motion, history, kTimeStep);
      benchmark::DoNotOptimize(history);
      return answer;
    });
  });
}

/// The same contacts, number by number.
class LawRows {
 public:
  explicit LawRows(const std::vector<LawInput>& inputs) : count_(inputs.size()) {
    for (const auto& [parameters, motion, history] : inputs) {
      append(kNormal, motion.normal);
      append(kSlipVelocity, motion.slip_velocity);
      append(kElasticSlip, history.elastic_slip);
      const std::array numbers{parameters.normal_stiffness,
                               parameters.tangential_stiffness,
                               parameters.friction,
                               motion.gap,
                               motion.gap_rate,
                               motion.elastic_normal_force};
      for (std::size_t k = 0; k < numbers.size(); ++k) given_[kNumbers + k].push_back(numbers[k]);
    }
    for (auto& row : answers_) row.resize(count_);
  }

  /// Asks the law about all contacts, W at once; histories stay as they are.
  template <int W>
  PLEKTON_INLINE void answer() {
    using Real = Pack<W>;
    for (std::size_t i = 0; i < count_; i += W) {
      const Law::ParametersOf<Real> parameters{given<W>(kNumbers, i), given<W>(kNumbers + 1, i),
                                               given<W>(kNumbers + 2, i)};
      const contact::RelativeMotionOf<Real> motion{
          vector<W>(kNormal, i), vector<W>(kSlipVelocity, i), given<W>(kNumbers + 3, i),
          given<W>(kNumbers + 4, i), given<W>(kNumbers + 5, i)};
      Law::HistoryOf<Real> history{vector<W>(kElasticSlip, i)};
      const auto answer = Law::force(parameters, motion, history, kTimeStep);
      keep<W>(0, i, answer.force);
      keep<W>(3, i, history.elastic_slip);
      answer.dissipated.store(&answers_[6][i]);
    }
  }

 private:
  // Rows of what is given; of a vector the first of three.
  static constexpr std::size_t kNormal = 0;
  static constexpr std::size_t kSlipVelocity = 3;
  static constexpr std::size_t kElasticSlip = 6;
  static constexpr std::size_t kNumbers = 9;

  void append(std::size_t row, const Vec3& v) {
    for (int axis = 0; axis < 3; ++axis) given_[row++].push_back(v[axis]);
  }
  template <int W>
  PLEKTON_INLINE Pack<W> given(std::size_t row, std::size_t i) const noexcept {
    return Pack<W>::load(&given_[row][i]);
  }
  template <int W>
  PLEKTON_INLINE geometry::PackVec3<Pack<W>> vector(std::size_t row, std::size_t i) const noexcept {
    return {given<W>(row, i), given<W>(row + 1, i), given<W>(row + 2, i)};
  }
  template <int W>
  PLEKTON_INLINE void keep(std::size_t row, std::size_t i,
                           const geometry::PackVec3<Pack<W>>& v) noexcept {
    v.x.store(&answers_[row][i]);
    v.y.store(&answers_[row + 1][i]);
    v.z.store(&answers_[row + 2][i]);
  }

  std::size_t count_;
  std::array<std::vector<double>, 15> given_;
  std::array<std::vector<double>, 7> answers_;
};

struct AllRows {
  LawRows& rows;

  template <int W>
  PLEKTON_INLINE void operator()(geometry::Width<W>) const {
    rows.answer<W>();
  }
};

void add_side_by_side(const std::string& name, double largest_share) {
  add_benchmark("law/linear_frictional_side_by_side/" + name, [=](benchmark::State& state) {
    LawRows rows(law_inputs(kSideBySide, largest_share));
    run_steps(state, kSideBySide, [&] { geometry::with_widest_vectors(AllRows{rows}); });
  });
}

}  // namespace

void add_contact_law() {
  add_one_by_one("sticking", 0.9);
  add_one_by_one("half_slipping", 2.0);
  add_side_by_side("sticking", 0.9);
  add_side_by_side("half_slipping", 2.0);
}

}  // namespace plekton::benchmarks
