// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace plekton::contact {

/// Which part of what a patch holds beside its elastic force each of its minima holds: friction,
/// dashpots, couples.
///
/// A minimum begins to push at its own level of the distance. Where a saddle joins two parts they
/// push on as one contact, shared by what each of them has had until then:
///
///     a_i = d_saddle - d_i of a minimum alone,   share of a part = a_part / (sum of both parts),
///     a of both together = the sum of both + the way from this saddle to the next one.
///
/// So shares are never negative and add up to 1; and they change with the distances alone, and
/// continuously: a minimum begins and ends together with a saddle at the same distance, with no
/// share. Where both parts have had nothing, which is where they are at the same place, each has a
/// half.
class MergeShares {
 public:
  /// @param minima  m, distances
  void begin(std::span<const double> minima);
  /// Joins two parts, at distances that never become less.
  /// @param a, b      different parts: of a minimum its number, of others what join() gave
  /// @param distance  m, of the saddle
  /// @returns the part that both are now
  std::uint32_t join(std::uint32_t a, std::uint32_t b, double distance);
  /// @returns by minimum; valid until the next call
  std::span<const double> shares();

 private:
  struct Part {
    double since;                ///< m, where it began
    double amount;               ///< m, what it had then
    double share = 1.0;          ///< of the part that it has joined
    std::uint32_t in = kNoPart;  ///< that part
  };
  static constexpr std::uint32_t kNoPart = ~std::uint32_t{0};

  std::vector<Part> parts_;  ///< the minima first, a part after all that is in it
  std::size_t minima_ = 0;
  std::vector<double> shares_;
};

}  // namespace plekton::contact
