// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/scenario.hpp"
#include "apps/scene/build_scene.hpp"
#include "contact/tracking/contact_record.hpp"
#include "dynamics/output/contact_fields.hpp"
#include "dynamics/simulation.hpp"

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace plekton::apps {

/// A table of a scenario that bodies come from.
struct BodyTable {
  enum class Kind : std::uint8_t { grains, membrane, plane };
  Kind kind = Kind::grains;
  std::size_t number = 0;  ///< among the tables of its kind

  friend auto operator<=>(const BodyTable&, const BodyTable&) = default;
};

/// "grains.sand", "membranes.net", "planes.floor" or, without a name, "planes[0]".
std::string path_of(const BodyTable& table, const Scenario& scenario);

/// Says which tables the bodies of a simulation are from, and what they are made of. Nodes stay
/// with their table, also where a membrane falls apart.
class BodyTables {
 public:
  /// @param simulation  has to stay as long as this
  BodyTables(const Scenario& scenario, const BuiltScene& built,
             const dynamics::Simulation& simulation);

  BodyTable table_of(const contact::ContactBody& body) const;
  /// Its number in the table of grains; 0 of other bodies.
  std::size_t grain_of(const contact::ContactBody& body) const;
  /// Its number among those of all stages.
  std::int32_t number_of(const BodyTable& table) const {
    const bool is_plane = table.kind == BodyTable::Kind::plane;
    return static_cast<std::int32_t>(is_plane ? plane_numbers_[table.number] : table.number);
  }
  /// Number of its material.
  std::size_t material_of(const BodyTable& table) const;
  /// Tables and materials of both sides of a contact.
  dynamics::ContactLabels labels_of(const contact::ContactRecord& contact) const;

  /// By node: number of its table among those of its kind.
  const std::vector<std::int32_t>& groups() const noexcept { return groups_; }
  /// By node: number of its material.
  const std::vector<std::int32_t>& materials() const noexcept { return materials_; }

 private:
  void set_node(std::size_t node, const BodyTable& table);

  const dynamics::Simulation& simulation_;
  std::array<std::vector<std::size_t>, 3> material_of_;  ///< by kind and number of a table
  std::vector<std::size_t> plane_numbers_;
  std::vector<std::size_t> first_grain_{0};  ///< by table, and their end
  std::vector<std::int32_t> groups_;
  std::vector<std::int32_t> materials_;
};

}  // namespace plekton::apps
