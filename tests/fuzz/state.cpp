// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target of a forged state, as a checkpoint with a right checksum may hold one. The bytes
// are changes to a state with contacts of every kind: 12 bytes each, the place of an array, what to
// do, the place of a number, the number. The state is restored or refused with a StateMismatch;
// where no floating-point number was changed a step is taken too, which may end as a run that has
// diverged does.
#include "tests/fuzz/require.hpp"
#include "tests/support/reported_scene.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <span>
#include <stdexcept>
#include <type_traits>

namespace {

using namespace plekton;
using geometry::StateArray;
using geometry::StateTree;

constexpr std::size_t kMostChanges = 8;

struct Change {
  std::uint16_t array;
  std::uint8_t what;
  std::uint8_t power;  ///< of 2, that the number is times
  std::uint32_t place;
  std::int32_t number;
};

template <class Number>
Number number_of(const Change& change) {
  const auto wide = static_cast<std::int64_t>(
      static_cast<std::uint64_t>(std::int64_t{change.number}) << (change.power % 64U));
  if constexpr (std::is_same_v<Number, double>) {
    double number;
    std::memcpy(&number, &wide, sizeof number);
    return number;
  } else {
    return static_cast<Number>(wide);
  }
}

/// @returns whether it is one of floating-point numbers
bool change_number(StateArray& array, const Change& change) {
  return std::visit(
      [&](auto& numbers) {
        using Number = typename std::decay_t<decltype(numbers)>::value_type;
        if (!numbers.empty()) numbers[change.place % numbers.size()] = number_of<Number>(change);
        return std::is_same_v<Number, double>;
      },
      array.numbers);
}

/// @returns whether a step can be taken with what comes of it
bool apply(const Change& change, StateTree& state) {
  if (state.arrays.empty()) return true;
  const auto at = std::next(state.arrays.begin(),
                            static_cast<std::ptrdiff_t>(change.array % state.arrays.size()));
  StateArray& array = at->second;
  switch (change.what % 8U) {
    case 0:
      state.arrays.erase(at);
      return true;
    case 1:
      std::visit([&](auto& numbers) { numbers.resize(change.place % 4096U * array.columns); },
                 array.numbers);
      return array.numbers.index() != 0;
    case 2:
      array.columns = 1 + change.place % 4U;
      return true;
    default:
      return !change_number(array, change);
  }
}

const test::NamedLaw& law() {
  return test::kLaws[5];  // with bonds that yield
}

StateTree state_after_steps(const test::ReportedScene& scene) {
  dynamics::Simulation simulation = scene.simulation(law());
  for (int i = 0; i < 30; ++i) simulation.step();
  simulation.list_contacts();
  simulation.step();
  return simulation.snapshot();
}

void restore(const test::ReportedScene& scene, const StateTree& state, bool steps) {
  dynamics::Simulation simulation = scene.simulation(law());
  try {
    simulation.restore(state);
  } catch (const geometry::StateMismatch& error) {
    fuzz::require(error.what()[0] != '\0', "a refusal without a message");
    return;
  }
  if (!steps) return;
  try {
    simulation.step();
    simulation.list_contacts();
  } catch (const std::runtime_error&) {
    // Diverged: a state that was accepted may be one of too large a step.
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const test::ReportedScene scene;
  static const StateTree original = state_after_steps(scene);
  StateTree state = original;
  bool steps = true;
  std::array<Change, kMostChanges> changes{};
  const std::size_t count = std::min(size / sizeof(Change), kMostChanges);
  if (count > 0) std::memcpy(changes.data(), data, count * sizeof(Change));
  for (const Change& change : std::span(changes).first(count)) steps &= apply(change, state);
  restore(scene, state, steps);
  return 0;
}
