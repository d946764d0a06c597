// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/neighbor/skin.hpp"

#include "geometry/base/ranks.hpp"
#include "geometry/base/state_archive.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>
#include <stdexcept>

namespace plekton::geometry {

namespace {

bool is_skin(double skin) noexcept {
  return std::isfinite(skin) && (skin == 0.0 || skin >= kSmallestSkin);
}

double checked(double skin) {
  if (!is_skin(skin)) {
    std::ostringstream message;
    message << "Skin: got a skin of " << skin << " m, expected 0 or a finite length of at least "
            << kSmallestSkin << " m; a tenth of the smallest radius is a good start";
    throw std::invalid_argument(message.str());
  }
  return skin;
}

/// m, largest coordinate.
double furthest(Positions x) {
  double furthest = 0.0;
  for (const Vec3& position : x) furthest = std::max(furthest, position.cwiseAbs().maxCoeff());
  return furthest;
}

/// Once NaN always NaN.
double larger_or_nan(double a, double b) noexcept {
  return b > a || std::isnan(b) ? b : a;
}

}  // namespace

Skin::Skin(double skin) : skin_(checked(skin)) {}

void Skin::set(double skin) {
  skin_ = checked(skin);
  built_ = false;
}

void Skin::mark_built(Positions x) {
  built_positions_.assign(x.begin(), x.end());
  built_ = true;
  way_ = 0.0;
  furthest_ = furthest(x);
}

/// How far nodes have moved since then is not known of a state that was read: the next step asks.
void Skin::exchange(const StateArchive& archive) {
  archive("skin", skin_);
  archive("is_built", built_);
  archive("built_positions", built_positions_);
  archive.require(is_skin(skin_), "skin");
  if (!archive.is_reading()) return;
  way_ = std::numeric_limits<double>::infinity();
  furthest_ = furthest(built_positions_);
}

/// @param node_at  place of node i of so many
/// @returns m², how far any of them has moved; NaN if any place is
template <class NodeAt>
double Skin::largest_square(Positions x, std::size_t count, const NodeAt& node_at,
                            ThreadPool& pool) {
  largest_.assign(static_cast<std::size_t>(pool.thread_count()), 0.0);
  pool.for_each_range(count, [&](std::size_t begin, std::size_t end, int worker) {
    double& largest_of_worker = largest_[static_cast<std::size_t>(worker)];
    double largest = largest_of_worker;
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t node = node_at(i);
      largest = larger_or_nan(largest, (x[node] - built_positions_[node]).squaredNorm());
    }
    largest_of_worker = largest;
  });
  return std::accumulate(largest_.begin(), largest_.end(), 0.0, larger_or_nan);
}

bool Skin::needs_rebuild(Positions x, ThreadPool& pool, const KnownNodes* known) {
  if (!built_ || skin_ == 0.0 || x.size() != built_positions_.size()) return true;
  double largest = 0.0;  // m²
  if (known == nullptr) {
    largest = largest_square(
        x, x.size(), [](std::size_t i) { return i; }, pool);
  } else {
    for (const std::span<const NodeId> nodes : {known->common, known->own}) {
      const auto node_at = [&](std::size_t i) { return index_of(nodes[i]); };
      largest = larger_or_nan(largest, largest_square(x, nodes.size(), node_at, pool));
    }
    std::vector<double> of_ranks(static_cast<std::size_t>(known->ranks->count()));
    of_ranks[static_cast<std::size_t>(known->ranks->rank())] = largest;
    known->ranks->gather(std::as_writable_bytes(std::span(of_ranks)),
                         std::vector<std::size_t>(of_ranks.size(), sizeof(double)));
    largest = std::accumulate(of_ranks.begin(), of_ranks.end(), 0.0, larger_or_nan);
  }
  way_ = (1.0 + 1e-15) * std::sqrt(largest);
  // Written so that NaN counts as too far.
  return !(4.0 * largest <= skin_ * skin_ * (1.0 - 1e-12));
}

/// Rounding: a step x += v dt is rounded twice, by at most eps / 2 of the way and of the coordinate
/// in each of three components; the sum and the speed by a few eps of it. Four eps of each pay for
/// all of it, and the last factor for the sums of a list that lasts a million steps.
bool Skin::may_need_rebuild(double way) noexcept {
  constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
  way_ += (1.0 + kRounding) * way + (way > 0.0 ? kRounding * (furthest_ + skin_) : 0.0);
  return !(built_ && 2.0 * way_ <= skin_ * (1.0 - 1e-9));
}

}  // namespace plekton::geometry
