// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/state/node_state.hpp"
#include "geometry/base/types.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
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
  std::vector<double> radii;              ///< m, of planes, likewise; of flat ones no matter
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

/// The bodies of a stage without grains that the next one takes out.
class KeptBodies {
 public:
  /// Whether a grain of a table is taken out, by its centre (m).
  using IsOut = std::function<bool(std::size_t table, const geometry::Vec3& centre)>;

  /// @param tables     of grains that are none of rigid bodies, by table: whose nodes come last
  /// @param positions  m, of all nodes
  KeptBodies(const StageBodies& before, const std::vector<bool>& tables,
             std::span<const geometry::Vec3> positions, const IsOut& is_out);

  template <class Thing>
  std::vector<Thing> kept(std::span<const Thing> of_nodes) const {
    std::vector<Thing> left;
    for (std::size_t i = 0; i < of_nodes.size(); ++i)
      if (nodes_[i] >= 0) left.push_back(of_nodes[i]);
    return left;
  }

  StageBodies& bodies() noexcept { return bodies_; }
  std::vector<geometry::Vec3>& positions() noexcept { return positions_; }
  /// By node of before: its number now; -1: it is gone.
  const std::vector<std::int32_t>& nodes() const noexcept { return nodes_; }

 private:
  std::vector<std::int32_t> nodes_;
  StageBodies bodies_;
  std::vector<geometry::Vec3> positions_;
};

}  // namespace plekton::apps
