// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/scene_contacts.hpp"
#include "tests/support/contact_surfaces.hpp"

#include <memory>

namespace plekton::test {

/// Many spheres in prescribed motion over a rough sheet, a net and a plane, touching each other
/// too.
class MovingScene {
 public:
  /// @param properties  of the one material that all have
  MovingScene(int sphere_count, double skin, std::uint64_t seed, int threads,
              const contact::AnyLaw::Properties& properties = {})
      : pool_(threads) {
    Random random(seed);
    const Complex sheet_part = roughened(centred(sheet(12), 12, 0.5), 0.5, 0.02, random);
    add(sheet_part, Vec3::Zero());
    add(centred(net(12), 12, 0.5), Vec3(8, 0, 0));
    for (int k = 0; k < sphere_count; ++k) {
      const double x = random.uniform(-2.5, 10.5);
      const double y = random.uniform(-2.5, 2.5);
      spheres_.push_back({{NodeId{complex_.node(Vec3(x, y, random.uniform(0.3, 0.42)))}},
                          random.uniform(0.2, 0.3)});
    }
    surface_ = complex_.surface();
    planes_.push_back({Vec3(0, 0, 0.6), -Vec3::UnitZ(), Vec3(0.01, 0, 0), MaterialId{0}});
    velocity_.resize(complex_.x.size());
    spin_.resize(complex_.x.size());
    for (std::size_t i = 0; i < complex_.x.size(); ++i) {
      const bool is_sphere = i >= complex_.x.size() - spheres_.size();
      velocity_[i] = is_sphere ? Vec3(random.in_cube(0.3)) : Vec3::Zero();
      if (is_sphere) velocity_[i][2] *= 0.1;
      spin_[i] = random.in_cube(1.0);
    }
    ContactMaterials materials{
        MaterialPairs({Material{1e6, 0.5, 0.4}}, {{{MaterialId{0}, MaterialId{0}}, properties}}),
        std::vector<MaterialId>(spheres_.size(), MaterialId{0}),
        std::vector<MaterialId>(surface_.structure_count(), MaterialId{0})};
    contacts_ = std::make_unique<SceneContacts>(spheres_, surface_, std::move(materials), skin);
    forces_ = NodeForces(complex_.x.size());
  }

  void step(double dt) {
    for (std::size_t i = 0; i < complex_.x.size(); ++i) complex_.x[i] += dt * velocity_[i];
    contacts_->advance({complex_.x, velocity_, spin_}, planes_, dt, pool_, forces_);
  }

  const SceneContacts& contacts() const { return *contacts_; }

  /// Contacts of the last step, numbered.
  std::vector<ContactRecord> list() {
    contacts_->assign_ids();
    std::vector<ContactRecord> rows;
    contacts_->for_each_record(complex_.x, [&](const ContactRecord& row) { rows.push_back(row); });
    return rows;
  }
  const NodeForces& forces() const { return forces_; }

 private:
  void add(const Complex& part, const Vec3& place) {
    const int first = static_cast<int>(complex_.x.size());
    const auto at = [&](NodeId node) { return first + static_cast<int>(node); };
    for (const Vec3& x : part.x) complex_.node(x + place);
    for (const auto& f : part.facets)
      complex_.facet(at(f.nodes[0]), at(f.nodes[1]), at(f.nodes[2]));
    for (const auto& c : part.cylinders) complex_.cylinder(at(c.nodes[0]), at(c.nodes[1]));
  }

  Complex complex_;
  std::vector<Sphere> spheres_;
  Surface surface_;
  std::vector<Plane> planes_;
  std::vector<Vec3> velocity_;
  std::vector<Vec3> spin_;
  std::unique_ptr<SceneContacts> contacts_;
  NodeForces forces_;
  geometry::ThreadPool pool_;
};

}  // namespace plekton::test
