// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/bodies_of_cells.hpp"

#include <memory>
#include <vector>

namespace plekton::geometry_check {

/// Two bodies, or one that is folded onto itself.
struct Structures {
  test::Body a;
  test::Body b;                          ///< may have nothing
  bool are_sheets = false;               ///< that lie on each other along z = 0, up to roughness
  std::vector<geometry::Vec3> rest;      ///< m, all nodes, where bodies are at rest
  bool do_cross = false;                 ///< cores of one go through those of the other
  static constexpr double kRange = 0.1;  ///< m, sum of both radii

  std::vector<geometry::Vec3> nodes() const {
    std::vector<geometry::Vec3> x = a.x;
    x.insert(x.end(), b.x.begin(), b.x.end());
    return x;
  }
};

/// What structures do to each other.
struct StructurePush {
  double energy = 0.0;                 ///< J
  std::vector<geometry::Vec3> forces;  ///< N, on all nodes
};

/// Contacts of structures whose nodes may be anywhere: springs of 1 N/m, without friction.
class StructureScene {
 public:
  explicit StructureScene(const Structures& structures) {
    add(structures.a);
    add(structures.b);
    surface_ = std::make_unique<geometry::Surface>(cylinders_, facets_, structures.rest.size());
    contacts_ = std::make_unique<contact::StructureContacts>(*surface_);
    neighbours_ = std::make_unique<geometry::CellNeighbours>(*surface_, structures.rest, kSkin,
                                                             structures.b.x.empty());
    still_.assign(structures.rest.size(), geometry::Vec3::Zero());
  }

  StructurePush push(const std::vector<geometry::Vec3>& x) {
    if (neighbours_->update(x, pool_)) list();
    contacts_->advance({x, still_, still_}, 0.0, pool_);
    contact::NodeForces forces(x.size());
    contacts_->add_forces(forces);
    return {contacts_->elastic_energy(), std::move(forces.force)};
  }
  std::size_t crossings() const { return contacts_->crossings(); }

 private:
  static constexpr double kSkin = 0.1 * Structures::kRange;

  void add(const test::Body& body) {
    const int first = count_;
    const auto node = [first](int i) { return geometry::NodeId{first + i}; };
    constexpr double kRadius = 0.5 * Structures::kRange;
    for (const auto& f : body.facets)
      facets_.push_back({{node(f[0]), node(f[1]), node(f[2])}, kRadius});
    for (const auto& c : body.cylinders) cylinders_.push_back({{node(c[0]), node(c[1])}, kRadius});
    count_ += static_cast<int>(body.x.size());
  }
  void list() {
    // k = 2 E R E R / (E R + E R) = E R: with E = 1 / R, 1 N/m.
    const contact::MaterialPairs materials({contact::Material{2.0 / Structures::kRange, 0.0, 0.0}},
                                           properties_);
    const std::vector<contact::MaterialId> of_structures(surface_->structure_count());
    contacts_->rebuild(neighbours_->pairs(), {materials, {}, of_structures});
  }

  int count_ = 0;  ///< of nodes
  contact::PairProperties<contact::AnyLaw> properties_{
      {{contact::MaterialId{0}, contact::MaterialId{0}},
       contact::AnyLaw::of<contact::LinearFrictional>({})}};
  std::vector<geometry::Facet> facets_;
  std::vector<geometry::Cylinder> cylinders_;
  geometry::ThreadPool pool_{1};
  std::unique_ptr<geometry::Surface> surface_;
  std::unique_ptr<contact::StructureContacts> contacts_;
  std::unique_ptr<geometry::CellNeighbours> neighbours_;
  std::vector<geometry::Vec3> still_;
};

}  // namespace plekton::geometry_check
