// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/model/require_index.hpp"

#include <cstdint>
#include <stdexcept>
#include <string>

namespace plekton::dynamics {
namespace {

/// @param shown  the index as it was given
[[noreturn]] void refuse(std::string_view call, std::string_view what, const std::string& shown,
                         std::size_t count) {
  std::string whats = std::string(what) + "s";
  if (what.ends_with('y')) whats.replace(whats.size() - 2, 2, "ies");
  throw std::out_of_range("Simulation::" + std::string(call) + ": there is no " +
                          std::string(what) + " " + shown +
                          (count == 0 ? "; this scene has no " + whats
                                      : "; this scene has " + std::to_string(count) + " " + whats +
                                            ", from 0 to " + std::to_string(count - 1)));
}

}  // namespace

void require_index(std::string_view call, std::string_view what, std::size_t index,
                   std::size_t count) {
  if (index >= count) refuse(call, what, std::to_string(index), count);
}

void require_node(std::string_view call, geometry::NodeId node, std::size_t count) {
  const auto id = static_cast<std::int64_t>(node);
  if (id < 0 || static_cast<std::size_t>(id) >= count)
    refuse(call, "node", std::to_string(id), count);
}

}  // namespace plekton::dynamics
