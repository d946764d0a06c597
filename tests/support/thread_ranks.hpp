// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/ranks.hpp"

#include <barrier>
#include <cstring>
#include <functional>
#include <memory>
#include <random>
#include <thread>
#include <vector>

namespace plekton::test {

/// Ranks that are threads of one process, so that what they tell each other can be tested without
/// MPI. If one of them throws, the program ends, since the others would wait.
class ThreadRanks {
 public:
  /// @param by_chance  whether owners of work are anybody, others at each call
  explicit ThreadRanks(int count, bool by_chance = false)
      : barrier_(count), views_(static_cast<std::size_t>(count)) {
    for (int rank = 0; rank < count; ++rank)
      ranks_.emplace_back(std::make_unique<One>(*this, rank, by_chance));
  }

  /// Calls body(ranks) on all ranks, and waits for them.
  void run(const std::function<void(geometry::Ranks&)>& body) {
    std::vector<std::jthread> threads;
    for (const auto& rank : ranks_) threads.emplace_back([&] { body(*rank); });
  }

 private:
  /// What a rank lays open to the others between two barriers.
  struct View {
    const std::byte* bytes;
    std::vector<std::size_t> starts;  // by receiver
  };

  class One final : public geometry::Ranks {
   public:
    One(ThreadRanks& all, int rank, bool by_chance)
        : all_(all), rank_(rank), by_chance_(by_chance) {}

    int rank() const noexcept override { return rank_; }
    int count() const noexcept override { return static_cast<int>(all_.views_.size()); }

    std::vector<int> owners(std::span<const std::uint64_t> work) override {
      if (!by_chance_) return Ranks::owners(work);
      std::vector<int> chosen;
      for (std::size_t i = 0; i < work.size(); ++i)
        chosen.push_back(static_cast<int>(random_() % all_.views_.size()));
      return chosen;
    }

    void gather(std::span<std::byte> parts, std::span<const std::size_t> sizes) override {
      const std::vector<std::size_t> starts = starts_of(sizes);
      const auto self = static_cast<std::size_t>(rank_);
      all_.views_[self] = {parts.data() + starts[self], {}};
      all_.barrier_.arrive_and_wait();
      for (std::size_t rank = 0; rank < sizes.size(); ++rank)
        if (rank != self && sizes[rank] > 0)
          std::memcpy(parts.data() + starts[rank], all_.views_[rank].bytes, sizes[rank]);
      all_.barrier_.arrive_and_wait();
    }

    void begin_exchange(std::span<const std::byte> sent, std::span<const std::size_t> sent_sizes,
                        std::span<std::byte> received,
                        std::span<const std::size_t> received_sizes) override {
      all_.views_[static_cast<std::size_t>(rank_)] = {sent.data(), starts_of(sent_sizes)};
      received_ = received;
      received_sizes_.assign(received_sizes.begin(), received_sizes.end());
    }

    void end_exchange() override {
      all_.barrier_.arrive_and_wait();
      const std::vector<std::size_t> starts = starts_of(received_sizes_);
      for (std::size_t rank = 0; rank < received_sizes_.size(); ++rank) {
        if (received_sizes_[rank] == 0) continue;
        const View& view = all_.views_[rank];
        std::memcpy(received_.data() + starts[rank],
                    view.bytes + view.starts[static_cast<std::size_t>(rank_)],
                    received_sizes_[rank]);
      }
      all_.barrier_.arrive_and_wait();
    }

   private:
    static std::vector<std::size_t> starts_of(std::span<const std::size_t> sizes) {
      std::vector<std::size_t> starts;
      std::size_t at = 0;
      for (const std::size_t size : sizes) {
        starts.push_back(at);
        at += size;
      }
      return starts;
    }

    ThreadRanks& all_;
    int rank_;
    bool by_chance_;
    std::mt19937 random_;  // the same on all ranks
    std::span<std::byte> received_;
    std::vector<std::size_t> received_sizes_;
  };

  std::barrier<> barrier_;
  std::vector<View> views_;
  std::vector<std::unique_ptr<One>> ranks_;
};

}  // namespace plekton::test
