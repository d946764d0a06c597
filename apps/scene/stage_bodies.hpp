// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/state/node_state.hpp"
#include "geometry/base/types.hpp"

#include <cstddef>
#include <vector>

namespace plekton::geometry {
class StateArchive;
}

namespace plekton::apps {

/// How things stood at the start of a stage, of what there is now.
struct StageStart {
  double time = 0.0;                      ///< s
  std::vector<geometry::Vec3> positions;  ///< m, by node; of what came later where it began
  std::vector<geometry::Vec3> planes;     ///< m, their points, likewise
};

/// What a stage has from those before it that its scenario does not say: with the state of a
/// simulation it is enough to build the scene anew.
struct StageBodies {
  std::size_t stage = 0;                    ///< its number
  std::vector<StageStart> starts;           ///< of all stages up to this one; empty: no stages
  std::vector<std::vector<double>> grains;  ///< m, radii, by table
  std::vector<dynamics::Held> held;         ///< by node, without motions that loads prescribe
  std::vector<bool> is_absent;              ///< by node of what was there first; as Scene has it

  bool empty() const noexcept { return starts.empty(); }
  void exchange(const geometry::StateArchive& archive);
};

}  // namespace plekton::apps
