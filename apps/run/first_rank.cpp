// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/first_rank.hpp"

#include "dynamics/output/file.hpp"

#include <exception>
#include <stdexcept>
#include <utility>

namespace plekton::apps {

void share_among(geometry::Ranks* ranks, Scenario& scenario) {
  scenario.simulation.ranks = ranks;
  for (Scenario& stage : scenario.stages) share_among(ranks, stage);
}

std::filesystem::path folder_of_rank(const geometry::Ranks* ranks,
                                     const std::filesystem::path& folder) {
  return is_first_rank(ranks) ? folder : std::filesystem::path(dynamics::kNowhere);
}

void by_first_rank(geometry::Ranks* ranks, const std::function<void()>& action) {
  std::exception_ptr failure;
  if (is_first_rank(ranks)) {
    try {
      action();
    } catch (...) {
      failure = std::current_exception();
    }
  }
  const bool has_failed = on_any_rank(ranks, failure != nullptr);
  if (failure) std::rethrow_exception(failure);
  if (has_failed) throw std::runtime_error("the first rank has failed, and says why");
}

bool on_any_rank(geometry::Ranks* ranks, bool answer) {
  return ranks == nullptr ? answer : geometry::any_rank(*ranks, answer);
}

std::function<bool()> asked_now_and_then(geometry::Ranks* ranks, std::function<bool()> question) {
  if (ranks == nullptr) return question;
  constexpr int kSteps = 16;
  return [ranks, question = std::move(question), steps = 0]() mutable {
    return ++steps % kSteps == 0 && geometry::any_rank(*ranks, question());
  };
}

}  // namespace plekton::apps
