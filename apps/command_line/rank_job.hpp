// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/ranks.hpp"

#include <memory>
#include <string>

namespace plekton::apps {

/// What mpirun started beside this process, if it did: all of them compute one run. The first rank
/// speaks; what others print goes nowhere.
class RankJob {
 public:
  /// Joins the others, where there are any and this program can.
  /// @throws std::runtime_error if there are others and it cannot
  RankJob();
  RankJob(const RankJob&) = delete;
  RankJob& operator=(const RankJob&) = delete;
  ~RankJob();

  /// None: this process computes alone.
  geometry::Ranks* ranks() noexcept;

  /// To be called where the program has failed, after the first rank has said why. Ends the others
  /// too if they have not failed likewise.
  void end_failed(int exit_code, const std::string& message);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace plekton::apps
