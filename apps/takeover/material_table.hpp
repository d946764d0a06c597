// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/takeover/yade_scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace plekton::apps::yade {

/// The materials of a scenario that stand for those of a scene: for one of YADE's there may be some,
/// as bodies have masses of their own, and rigid facets get a stiffness without a thickness.
class MaterialTable {
 public:
  explicit MaterialTable(const Scene& scene) : scene_(scene) {}

  /// Name of the material of grains of this density (kg/m³), in quotes.
  std::string of_grains(int material, double density) { return name(material, density, false); }
  /// Of contacts only.
  std::string of_surface(int material) { return name(material, std::nullopt, false); }
  /// Of facets that have no thickness in YADE.
  std::string of_rigid(int material) { return name(material, std::nullopt, true); }

  /// The [materials] and [[contacts]] of all that was asked for.
  std::string text(std::vector<std::string>& notes) const;

 private:
  struct Row {
    int material;
    std::optional<double> density;
    bool is_rigid;
    std::string name;
  };

  std::string name(int material, std::optional<double> density, bool is_rigid);
  std::string free_name(const Material& material, bool is_rigid) const;
  std::string contact(const Row& a, const Row& b, bool is_hertz) const;

  const Scene& scene_;
  std::vector<Row> rows_;
};

}  // namespace plekton::apps::yade
