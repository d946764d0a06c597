// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/distributed/mpi_job.hpp"

#include <mpi.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <random>
#include <stdexcept>
#include <string_view>
#include <thread>

namespace plekton::distributed {
namespace {

/// So long (s) the other ranks may take to end where one has failed: what fails on all of them
/// fails at the same place.
constexpr double kWaitAfterFailure = 3.0;

/// In units of Ranks, as MPI counts.
int units(std::size_t bytes) {
  const std::size_t count = bytes / geometry::Ranks::kUnit;
  if (count > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw std::length_error(
        "a message between ranks is longer than MPI can count (16 GiB); use fewer grains or more "
        "machines with a run each");
  return static_cast<int>(count);
}

/// @throws std::runtime_error with what MPI says
void require(int result, const char* what) {
  if (result == MPI_SUCCESS) return;
  std::string text(MPI_MAX_ERROR_STRING, '\0');
  int length = 0;
  MPI_Error_string(result, text.data(), &length);
  text.resize(static_cast<std::size_t>(length));
  throw std::runtime_error(std::string("MPI: ") + what + " failed: " + text);
}

bool test_asks_for(std::string_view what) {
  const char* const asked = std::getenv("PLEKTON_RANKS_TEST");
  return asked != nullptr && std::string_view(asked).find(what) != std::string_view::npos;
}

}  // namespace

bool is_one_of_several() {
  for (const char* const name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MPI_LOCALNRANKS"}) {
    const char* const value = std::getenv(name);
    if (value != nullptr && std::atoi(value) > 0) return true;
  }
  return std::getenv("PMIX_RANK") != nullptr;
}

class MpiJob::MpiRanks final : public geometry::Ranks {
  static constexpr int kTag = 1;

 public:
  MpiRanks() : owners_by_chance_(test_asks_for("owners")), delays_(test_asks_for("delays")) {
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &count_);
    waits_.seed(static_cast<unsigned>(rank_));
    MPI_Comm_dup(MPI_COMM_WORLD, &ending_);
  }
  ~MpiRanks() override { MPI_Comm_free(&ending_); }

  int rank() const noexcept override { return rank_; }
  int count() const noexcept override { return count_; }

  /// Of its own, so that a rank that has failed is not taken to answer what others still ask.
  MPI_Comm ending() const noexcept { return ending_; }

  std::vector<int> owners(std::span<const std::uint64_t> work) override {
    if (!owners_by_chance_) return Ranks::owners(work);
    std::vector<int> chosen;
    for (std::size_t i = 0; i < work.size(); ++i)
      chosen.push_back(static_cast<int>(choices_() % static_cast<unsigned>(count_)));
    return chosen;
  }

  void gather(std::span<std::byte> parts, std::span<const std::size_t> sizes) override {
    wait_by_chance();
    if (delays_ && choices_() % 2 == 0) {
      gather_by_messages(parts, sizes);
      return;
    }
    set(sizes, counts_, places_);
    requests_.resize(1);
    require(MPI_Iallgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, parts.data(), counts_.data(),
                            places_.data(), MPI_UINT64_T, MPI_COMM_WORLD, requests_.data()),
            "to gather what ranks have computed");
    wait_for_all();
  }

  void begin_exchange(std::span<const std::byte> sent, std::span<const std::size_t> sent_sizes,
                      std::span<std::byte> received,
                      std::span<const std::size_t> received_sizes) override {
    wait_by_chance();
    requests_.clear();
    std::size_t at = 0;
    for (int rank = 0; rank < count_; ++rank) {
      const std::size_t size = received_sizes[static_cast<std::size_t>(rank)];
      receive(rank, received.subspan(at, size));
      at += size;
    }
    at = 0;
    for (int rank = 0; rank < count_; ++rank) {
      const std::size_t size = sent_sizes[static_cast<std::size_t>(rank)];
      send(rank, sent.subspan(at, size));
      at += size;
    }
  }
  void progress() override { are_all_done(); }
  void end_exchange() override { wait_for_all(); }

 private:
  /// MPI would look all the time, and take the core that another rank waits for where there are
  /// fewer cores than there is work: after a while this sleeps between its looks.
  void wait_for_all() {
    constexpr double kLooking = 100e-6;  // s, some times what a message takes
    constexpr std::chrono::microseconds kSleep{20};
    const double begin = MPI_Wtime();
    while (!are_all_done()) {
      if (MPI_Wtime() - begin > kLooking) std::this_thread::sleep_for(kSleep);
    }
  }

  /// Also lets MPI go on with what is not.
  bool are_all_done() {
    send_those_due();
    int is_done = 0;
    require(MPI_Testall(static_cast<int>(requests_.size()), requests_.data(), &is_done,
                        MPI_STATUSES_IGNORE),
            "to wait for another rank");
    return is_done != 0 && held_.empty();
  }

  void receive(int rank, std::span<std::byte> message) {
    if (message.empty()) return;
    require(MPI_Irecv(message.data(), units(message.size()), MPI_UINT64_T, rank, kTag,
                      MPI_COMM_WORLD, &requests_.emplace_back()),
            "to receive from another rank");
  }
  void send(int rank, std::span<const std::byte> message) {
    if (message.empty()) return;
    if (delays_) {
      held_.push_back({rank, message, MPI_Wtime() + seconds_by_chance()});
      return;
    }
    require(MPI_Isend(message.data(), units(message.size()), MPI_UINT64_T, rank, kTag,
                      MPI_COMM_WORLD, &requests_.emplace_back()),
            "to send to another rank");
  }

  // For tests: ranks wait before they send anything, and messages by themselves, so that they come
  // in another order than they were sent.

  void wait_by_chance() {
    if (delays_) std::this_thread::sleep_for(std::chrono::duration<double>(seconds_by_chance()));
  }
  double seconds_by_chance() {
    constexpr unsigned kLongest = 1000;  // µs
    return 1e-6 * static_cast<double>(waits_() % kLongest);
  }
  void send_those_due() {
    const double now = held_.empty() ? 0.0 : MPI_Wtime();
    std::erase_if(held_, [&](const Held& held) {
      if (now < held.due) return false;
      require(MPI_Isend(held.message.data(), units(held.message.size()), MPI_UINT64_T, held.rank,
                        kTag, MPI_COMM_WORLD, &requests_.emplace_back()),
              "to send to another rank");
      return true;
    });
  }
  void gather_by_messages(std::span<std::byte> parts, std::span<const std::size_t> sizes) {
    requests_.clear();
    std::span<const std::byte> own;
    std::size_t at = 0;
    for (int rank = 0; rank < count_; ++rank) {
      const std::span<std::byte> part = parts.subspan(at, sizes[static_cast<std::size_t>(rank)]);
      if (rank == rank_)
        own = part;
      else
        receive(rank, part);
      at += part.size();
    }
    for (int rank = 0; rank < count_; ++rank) {
      if (rank != rank_) send(rank, own);
    }
    wait_for_all();
  }

  static void set(std::span<const std::size_t> sizes, std::vector<int>& counts,
                  std::vector<int>& places) {
    counts.clear();
    places.clear();
    std::size_t at = 0;
    for (const std::size_t size : sizes) {
      counts.push_back(units(size));
      places.push_back(units(at));
      at += size;
    }
  }

  int rank_ = 0;
  int count_ = 1;
  MPI_Comm ending_ = MPI_COMM_NULL;
  bool owners_by_chance_;
  bool delays_;
  std::mt19937 choices_;  // the same on all ranks
  std::mt19937 waits_;
  std::vector<int> counts_, places_;
  std::vector<MPI_Request> requests_;
  /// A message that is to be sent later.
  struct Held {
    int rank;
    std::span<const std::byte> message;
    double due;  ///< s
  };
  std::vector<Held> held_;
};

MpiJob::MpiJob() {
  int provided = 0;
  require(MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided), "to begin");
  MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
  ranks_ = std::make_unique<MpiRanks>();
}

MpiJob::~MpiJob() {
  ranks_.reset();
  MPI_Finalize();
}

geometry::Ranks& MpiJob::ranks() noexcept {
  return *ranks_;
}

void MpiJob::end_failed(int exit_code, const std::string& message, bool is_told) {
  MPI_Request all_failed;
  MPI_Ibarrier(ranks_->ending(), &all_failed);
  const double begin = MPI_Wtime();
  for (int is_over = 0; is_over == 0;) {
    MPI_Test(&all_failed, &is_over, MPI_STATUS_IGNORE);
    if (is_over != 0) return;
    if (MPI_Wtime() - begin > kWaitAfterFailure) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  if (!is_told) std::cerr << "plekton: rank " << ranks_->rank() << ": " << message << std::endl;
  MPI_Abort(MPI_COMM_WORLD, exit_code);
}

}  // namespace plekton::distributed
