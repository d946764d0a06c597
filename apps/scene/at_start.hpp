// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scene/build_scene.hpp"

#include <utility>

namespace plekton::apps {

/// While it lives, the nodes of a scene are where they were at the start of a stage.
class AtStart {
 public:
  /// @param start  nothing: they stay
  AtStart(BuiltScene& built, const StageStart* start) : built_(built), as_built_() {
    if (start != nullptr) as_built_ = std::exchange(built_.scene.state.position, start->positions);
  }
  AtStart(const AtStart&) = delete;
  AtStart& operator=(const AtStart&) = delete;
  ~AtStart() {
    if (!as_built_.empty()) built_.scene.state.position = std::move(as_built_);
  }

 private:
  BuiltScene& built_;
  std::vector<Vec3> as_built_;
};

}  // namespace plekton::apps
