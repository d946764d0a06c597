// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace plekton::contact {

/// A list that is filled anew in each step. What it held stays as room, so that things which are
/// written member by member are not set to zero before: that would write each of them twice.
template <class Thing>
class ReusedList {
 public:
  /// @returns one more, to be filled in; before that it holds anything
  Thing& add() {
    if (count_ == things_.size()) things_.resize(count_ + count_ / 2 + 64);
    return things_[count_++];
  }
  /// Leaves the first ones. @param count  not more than there are
  void shrink(std::size_t count) noexcept { count_ = count; }
  void clear() noexcept { count_ = 0; }

  std::size_t size() const noexcept { return count_; }
  const Thing* data() const noexcept { return things_.data(); }
  Thing& operator[](std::size_t i) noexcept { return things_[i]; }
  const Thing& operator[](std::size_t i) const noexcept { return things_[i]; }
  Thing* begin() noexcept { return things_.data(); }
  Thing* end() noexcept { return things_.data() + count_; }
  const Thing* begin() const noexcept { return things_.data(); }
  const Thing* end() const noexcept { return things_.data() + count_; }

 private:
  std::vector<Thing> things_;  ///< the first count_ of them
  std::size_t count_ = 0;
};

}  // namespace plekton::contact
