// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/rank_job.hpp"

#ifdef PLEKTON_HAS_DISTRIBUTED
#include "dynamics/distributed/mpi_job.hpp"

#include <fcntl.h>
#include <unistd.h>

namespace plekton::apps {
namespace {

/// Standard output, and standard error until somebody has to be heard.
class Silence {
 public:
  Silence() : error_(::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3)) {
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
    ::close(nowhere);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;
  ~Silence() { ::close(error_); }

  void end() const { ::dup2(error_, STDERR_FILENO); }

 private:
  int error_;
};

}  // namespace

struct RankJob::Implementation {
  distributed::MpiJob job;
  std::unique_ptr<Silence> silence;
};

RankJob::RankJob() {
  if (!distributed::is_one_of_several()) return;
  implementation_ = std::make_unique<Implementation>();
  if (ranks()->rank() != 0) implementation_->silence = std::make_unique<Silence>();
}

geometry::Ranks* RankJob::ranks() noexcept {
  return implementation_ ? &implementation_->job.ranks() : nullptr;
}

void RankJob::end_failed(int exit_code, const std::string& message) {
  if (!implementation_) return;
  const bool is_told = !implementation_->silence;
  if (!is_told) implementation_->silence->end();
  implementation_->job.end_failed(exit_code, message, is_told);
}

}  // namespace plekton::apps

#else

#include <cstdlib>
#include <stdexcept>

namespace plekton::apps {

struct RankJob::Implementation {};

RankJob::RankJob() {
  const char* const size = std::getenv("OMPI_COMM_WORLD_SIZE");
  if (size == nullptr || std::atoi(size) < 2) return;
  throw std::runtime_error(
      "mpirun has started several processes, and this program was built without MPI: each would "
      "compute the same; start one of them, or build with MPI (Debian: libopenmpi-dev "
      "openmpi-bin)");
}

geometry::Ranks* RankJob::ranks() noexcept {
  return nullptr;
}

void RankJob::end_failed(int, const std::string&) {}

}  // namespace plekton::apps

#endif

namespace plekton::apps {

RankJob::~RankJob() = default;

}  // namespace plekton::apps
