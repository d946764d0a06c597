// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

namespace plekton::contact {

/// Which of eight pairs side by side touched in the last step, and which of them in every step
/// since contacts were numbered: a bit for each.
class TouchedLanes {
 public:
  bool any() const noexcept { return last_ != 0; }
  bool last(std::size_t lane) const noexcept { return (last_ >> lane & 1) != 0; }
  /// Bits of the last step from a lane on.
  unsigned from(std::size_t lane) const noexcept { return static_cast<unsigned>(last_) >> lane; }
  bool since_numbered(std::size_t lane) const noexcept { return (numbered_ >> lane & 1) != 0; }

  /// A step of some lanes.
  /// @param lanes     bits of those, from the first lane on
  /// @param touching  those that touch; no others than lanes
  void set(std::size_t lane, unsigned lanes, unsigned touching) noexcept {
    const unsigned others = ~(lanes << lane);
    last_ = static_cast<std::uint8_t>((last_ & others) | touching << lane);
    numbered_ = static_cast<std::uint8_t>(numbered_ & (others | touching << lane));
  }
  /// A pair comes to a lane from another one.
  void set_moved(std::size_t lane, bool touched, bool is_numbered) noexcept {
    set(lane, 1, touched);
    const unsigned bit = 1U << lane;
    numbered_ = static_cast<std::uint8_t>(is_numbered ? numbered_ | bit : numbered_ & ~bit);
  }
  void set_numbered() noexcept { numbered_ = last_; }

 private:
  std::uint8_t last_ = 0;
  std::uint8_t numbered_ = 0;
};
static_assert(sizeof(TouchedLanes) == 2);

}  // namespace plekton::contact
