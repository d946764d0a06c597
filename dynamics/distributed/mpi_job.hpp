// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/ranks.hpp"

#include <memory>
#include <string>

namespace plekton::distributed {

/// Whether mpirun, mpiexec or srun has started this process, as one of several or, with -n 1, alone,
/// so that it may join the others. Asks the environment alone.
bool is_one_of_several();

/// This process as a rank of a job of MPI, from the making of this to its end. One in a process.
///
/// For tests, PLEKTON_RANKS_TEST in the environment may hold, parted by commas: "owners", ranks by
/// chance for every piece of work of every list; "delays", every rank waits for up to a
/// millisecond by chance before it tells anything, and every message does by itself. Neither changes
/// a result.
class MpiJob {
 public:
  /// Joins the others. @throws std::runtime_error
  MpiJob();
  MpiJob(const MpiJob&) = delete;
  MpiJob& operator=(const MpiJob&) = delete;
  ~MpiJob();

  geometry::Ranks& ranks() noexcept;

  /// Waits for the others to end too. If they do not come within some seconds, this one has failed
  /// alone: it ends all of them, where that is not told yet with its message.
  /// @param is_told  whether somebody has read of the failure
  void end_failed(int exit_code, const std::string& message, bool is_told);

 private:
  class MpiRanks;
  std::unique_ptr<MpiRanks> ranks_;
};

}  // namespace plekton::distributed
