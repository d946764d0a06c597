// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/parallel_sum.hpp"

#include "geometry/base/types.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <vector>

namespace plekton::geometry::parallel_sum_test {
namespace {

/// Terms of both signs and of sizes from 1e-20 to 1e20, so that any other order of adding gives
/// other bits.
std::vector<double> terms_of_all_sizes(std::size_t count) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-20.0, 20.0);
  std::vector<double> terms(count);
  for (double& term : terms)
    term = (random() % 2 == 0 ? 1.0 : -1.0) * std::pow(10.0, exponent(random));
  return terms;
}

/// A body that adds up term(i).
template <class Term>
auto adding(const Term& term) {
  return [term](std::size_t begin, std::size_t end, int) {
    auto sum = term(begin);
    for (std::size_t i = begin + 1; i < end; ++i) sum += term(i);
    return sum;
  };
}

double sum_with(int thread_count, const std::vector<double>& terms) {
  ThreadPool pool(thread_count);
  return ParallelSum<double>()(terms.size(), pool, adding([&](std::size_t i) { return terms[i]; }));
}

TEST(ParallelSum, HasTheSameBitsForAnyNumberOfThreads) {
  for (const std::size_t count : {1u, 255u, 256u, 257u, 1000u, 65537u}) {
    SCOPED_TRACE(count);
    const std::vector<double> terms = terms_of_all_sizes(count);
    const auto expected = std::bit_cast<std::uint64_t>(sum_with(1, terms));

    for (const int threads : {2, 4, 7}) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(sum_with(threads, terms)), expected);
    }
  }
}

TEST(ParallelSum, OfVectorsIsTheSumOfEachComponent) {
  const std::vector<double> terms = terms_of_all_sizes(5000);
  ThreadPool pool(4);

  const Vec3 sum = ParallelSum<Vec3>()(terms.size() - 2, pool, adding([&](std::size_t i) {
                                         return Vec3(terms[i], terms[i + 1], terms[i + 2]);
                                       }));

  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double component = ParallelSum<double>()(
        terms.size() - 2, pool, adding([&](std::size_t i) { return terms[i + axis]; }));
    EXPECT_EQ(sum[static_cast<int>(axis)], component);
  }
}

TEST(ParallelSum, OfIntegersIsExact) {
  for (const int threads : {1, 2, 4, 7}) {
    ThreadPool pool(threads);

    const double sum = ParallelSum<double>()(
        100001, pool, adding([](std::size_t i) { return static_cast<double>(i); }));

    EXPECT_EQ(sum, 100000.0 * 100001.0 / 2.0);
  }
}

TEST(ParallelSum, OfNothingIsZeroAlsoAfterALongerSum) {
  ThreadPool pool(2);
  ParallelSum<double> sum;
  ParallelSum<Vec3> vector_sum;
  const auto ones = adding([](std::size_t) { return 1.0; });

  EXPECT_EQ(sum(3000, pool, ones), 3000.0);
  EXPECT_EQ(sum(0, pool, ones), 0.0);
  EXPECT_EQ(sum(1, pool, ones), 1.0);
  const auto vectors = adding([](std::size_t) { return Vec3(1, 1, 1); });
  EXPECT_EQ(vector_sum(0, pool, vectors), Vec3(0, 0, 0));
}

TEST(ParallelSum, CoversEveryIndexOnceAndGivesAWorkerAscendingChunks) {
  constexpr std::size_t kCount = 5 * ParallelSum<int>::kChunk + 7;
  ThreadPool pool(3);
  std::vector<int> visits(kCount, 0);
  std::vector<std::size_t> reached(3, 0);
  std::vector<int> out_of_order(3, 0);

  const int chunks =
      ParallelSum<int>()(kCount, pool, [&](std::size_t begin, std::size_t end, int worker) {
        const auto w = static_cast<std::size_t>(worker);
        out_of_order[w] += begin < reached[w];
        reached[w] = end;
        for (std::size_t i = begin; i < end; ++i) ++visits[i];
        return 1;
      });

  EXPECT_EQ(chunks, 6);
  EXPECT_EQ(visits, std::vector<int>(kCount, 1));
  EXPECT_EQ(out_of_order, std::vector<int>(3, 0));
}

TEST(ParallelSum, PassesOnWhatABodyThrows) {
  ThreadPool pool(2);
  const auto fail_late = adding([](std::size_t i) {
    if (i == 900) throw std::range_error("term 900");
    return 1.0;
  });

  EXPECT_THROW(ParallelSum<double>()(1000, pool, fail_late), std::range_error);
}

}  // namespace
}  // namespace plekton::geometry::parallel_sum_test
