// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/load_settings.hpp"

#include <array>
#include <string>
#include <vector>

namespace plekton::apps {

/// Who prescribes which component of which node.
class PrescribedOnce {
 public:
  /// @param held  by node: what bodies and stages hold
  explicit PrescribedOnce(std::vector<dynamics::Held> held) : held_(std::move(held)) {}

  /// Takes down a motion.
  /// @param load  must outlive this
  /// @returns     empty; or the first component that is prescribed already and by whom, as in
  ///              "the translation along x of node 12 is prescribed by loads.push already"
  std::string add(const dynamics::PrescribedMotion& motion, const LoadSettings& load);

 private:
  std::vector<dynamics::Held> held_;
  std::vector<std::array<const LoadSettings*, 6>> by_;  // by node and component, if a load does it
};

}  // namespace plekton::apps
