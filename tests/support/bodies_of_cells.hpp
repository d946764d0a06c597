// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/linear_frictional.hpp"
#include "contact/law_table.hpp"
#include "contact/surface_surface/structure_contacts.hpp"
#include "geometry/neighbor/cell_neighbours.hpp"
#include "geometry/primitives/elements.hpp"

#include <Eigen/Geometry>

#include <memory>
#include <random>
#include <vector>

/// Bodies made of cells, moved as rigid ones, and the contacts between them.
namespace plekton::test {

using contact::NodeForces;
using geometry::CellId;
using geometry::Cylinder;
using geometry::Facet;
using geometry::NodeId;
using geometry::Vec3;

struct Body {
  std::vector<Vec3> x;
  std::vector<std::array<int, 3>> facets;
  std::vector<std::array<int, 2>> cylinders;
};

/// How the squares of a sheet are cut: all along one diagonal, or by turns.
enum class Cut { one_way, alternating };

/// A rectangle in the plane z = 0 about the origin; inner nodes moved at random if there is a seed.
inline Body sheet(int columns, int rows, double width, double height, Cut cut = Cut::one_way,
                  unsigned seed = 0) {
  Body body;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-0.2, 0.2);
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const double dx = seed != 0 && i > 0 && i < columns ? shift(random) / columns : 0.0;
      const double dy = seed != 0 && j > 0 && j < rows ? shift(random) / rows : 0.0;
      body.x.emplace_back((static_cast<double>(i) / columns - 0.5 + dx) * width,
                          (static_cast<double>(j) / rows - 0.5 + dy) * height, 0.0);
    }
  }
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const int a = j * (columns + 1) + i;
      const int b = a + 1, c = a + columns + 1, d = c + 1;
      if (cut == Cut::alternating && (i + j) % 2 == 1) {
        body.facets.push_back({a, b, d});
        body.facets.push_back({a, d, c});
      } else {
        body.facets.push_back({a, b, c});
        body.facets.push_back({b, d, c});
      }
    }
  }
  return body;
}

/// A straight chain of equal cylinders along x about the origin.
inline Body chain(int count, double length) {
  Body body;
  for (int i = 0; i <= count; ++i)
    body.x.emplace_back((static_cast<double>(i) / count - 0.5) * length, 0.0, 0.0);
  for (int i = 0; i < count; ++i) body.cylinders.push_back({i, i + 1});
  return body;
}

/// Turned about the x, then the y, then the z axis (rad), then moved (m).
inline Body moved(Body body, const Vec3& turns, const Vec3& shift) {
  const geometry::Mat3 rotation =
      (Eigen::AngleAxisd(turns.z(), Vec3::UnitZ()) * Eigen::AngleAxisd(turns.y(), Vec3::UnitY()) *
       Eigen::AngleAxisd(turns.x(), Vec3::UnitX()))
          .toRotationMatrix();
  for (Vec3& x : body.x) x = rotation * x + shift;
  return body;
}

/// Contact of two bodies of radius r / 2 each, without friction; of a linear law a spring of 1 N/m
/// per contact.
template <class Law>
class StructurePairUnder {
 public:
  StructurePairUnder(const Body& a, const Body& b, double range,
                     const contact::PropertiesOf<Law>& properties = {},
                     double stiffness_ratio = 0.0, double friction = 0.0)
      : count_a_(a.x.size()),
        stiffness_ratio_(stiffness_ratio),
        friction_(friction),
        properties_{{{contact::MaterialId{0}, contact::MaterialId{0}},
                     contact::AnyLaw::of<Law>(properties)}} {
    add(a, 0.5 * range);
    add(b, 0.5 * range);
    surface_ = std::make_unique<geometry::Surface>(cylinders_, facets_, x_.size());
    contacts_ = std::make_unique<contact::StructureContacts>(*surface_);
    neighbours_ = std::make_unique<geometry::CellNeighbours>(*surface_, x_, 0.0, false);
  }

  /// Puts the second body (its nodes in its own order) elsewhere and finds the forces.
  void place(const Body& b) { advance_to(b, 0.0); }
  /// The same, but contacts see how it goes there.
  void slide(const Body& b) { advance_to(b, 1.0); }
  double energy() const { return contacts_->elastic_energy(); }
  std::size_t patches() const { return contacts_->touching(); }
  Vec3 force_on_a() const { return sum(0, count_a_); }
  Vec3 force_on_b() const { return sum(count_a_, x_.size()); }
  /// N m, of the forces on the second body.
  Vec3 moment_on_b(const Vec3& about) const {
    Vec3 moment = Vec3::Zero();
    for (std::size_t i = count_a_; i < x_.size(); ++i)
      moment += (x_[i] - about).cross(forces_.force[i]);
    return moment;
  }
  const contact::StructureContacts& contacts() const { return *contacts_; }
  const std::vector<Vec3>& forces() const { return forces_.force; }
  const std::vector<Vec3>& positions() const { return x_; }
  std::size_t first_node_of_b() const { return count_a_; }

 private:
  void add(const Body& body, double radius) {
    const int first = static_cast<int>(x_.size());
    const auto node = [first](int i) { return NodeId{first + i}; };
    for (const auto& f : body.facets)
      facets_.push_back({{node(f[0]), node(f[1]), node(f[2])}, radius});
    for (const auto& c : body.cylinders) cylinders_.push_back({{node(c[0]), node(c[1])}, radius});
    x_.insert(x_.end(), body.x.begin(), body.x.end());
  }
  Vec3 sum(std::size_t begin, std::size_t end) const {
    Vec3 total = Vec3::Zero();
    for (std::size_t i = begin; i < end; ++i) total += forces_.force[i];
    return total;
  }

  /// @param dt  s, 0: at once
  void advance_to(const Body& b, double dt) {
    std::vector<Vec3> velocity(x_.size(), Vec3::Zero());
    for (std::size_t i = 0; i < b.x.size(); ++i) {
      Vec3& x = x_[count_a_ + i];
      if (dt > 0.0) velocity[count_a_ + i] = (b.x[i] - x) / dt;
      x = b.x[i];
    }
    if (neighbours_->update(x_, pool_)) {
      // k = 2 E R E R / (E R + E R) = E R: with E = 1 / R, 1 N/m.
      const double radius = surface_->radius(geometry::StructureId{0});
      const contact::MaterialPairs materials(
          {contact::Material{1.0 / radius, stiffness_ratio_, friction_}}, properties_);
      const std::vector<contact::MaterialId> of_structures(surface_->structure_count());
      contacts_->rebuild(neighbours_->pairs(), {materials, {}, of_structures});
    }
    const std::vector<Vec3> still(x_.size(), Vec3::Zero());
    contacts_->advance({x_, velocity, still}, dt, pool_);
    forces_ = NodeForces(x_.size());
    contacts_->add_forces(forces_);
  }

  std::size_t count_a_;
  double stiffness_ratio_;
  double friction_;
  contact::PairProperties<contact::AnyLaw> properties_;
  std::vector<Vec3> x_;
  std::vector<Facet> facets_;
  std::vector<Cylinder> cylinders_;
  geometry::ThreadPool pool_{1};
  std::unique_ptr<geometry::Surface> surface_;
  std::unique_ptr<contact::StructureContacts> contacts_;
  std::unique_ptr<geometry::CellNeighbours> neighbours_;
  NodeForces forces_{0};
};

using StructurePair = StructurePairUnder<contact::LinearFrictional>;

}  // namespace plekton::test
