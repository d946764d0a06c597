// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/linear_frictional.hpp"
#include "contact/sphere_surface/surface_contacts.hpp"
#include "tests/support/contact_surfaces.hpp"

#include <vector>

namespace plekton::test {

/// A ball that is moved over a surface of radius 0.1 m by hand, and what it feels. The surface
/// stays where it is unless its nodes are given a velocity. Ball and surface are of one material.
class SphereOnSurface {
 public:
  using Law = LinearFrictional;

  /// @param ball_radius  m; range is this + 0.1
  /// @param properties   of the law of both with each other
  SphereOnSurface(const Complex& complex, double ball_radius, const Material& material,
                  const contact::PairProperties<contact::AnyLaw>& properties = {})
      : surface_(complex.cylinders, complex.facets, complex.x.size() + 1),
        x_(complex.x),
        velocity_(complex.x.size() + 1, Vec3::Zero()),
        spin_(complex.x.size() + 1, Vec3::Zero()),
        ball_{id_at<NodeId>(complex.x.size()), ball_radius, MaterialId{0}},
        materials_({material}, properties),
        parameters_(Law::combine({material, ball_radius}, {material, 0.1})),
        contacts_(surface_),
        forces_(complex.x.size() + 1) {
    x_.push_back(Vec3::Constant(1e3));
    rebuild();
  }
  SphereOnSurface(const SphereOnSurface&) = delete;
  SphereOnSurface& operator=(const SphereOnSurface&) = delete;

  double range() const { return ball_.radius + 0.1; }
  const Law::Parameters& parameters() const { return parameters_; }
  const SurfaceContacts& contacts() const { return contacts_; }
  const NodeForces& forces() const { return forces_; }
  const Surface& surface() const { return surface_; }
  std::vector<Vec3>& x() { return x_; }
  std::vector<Vec3>& velocity() { return velocity_; }
  std::vector<Vec3>& spin() { return spin_; }
  const Vec3& centre() const { return x_.back(); }

  /// Lists all cells of all structures anew.
  void rebuild() {
    std::vector<geometry::IndexPair> pairs;
    std::vector<NearCells> near;
    std::vector<CellId> cells;
    for (std::size_t s = 0; s < surface_.structure_count(); ++s) {
      pairs.push_back({0, static_cast<std::int32_t>(s)});
      near.push_back({static_cast<std::uint32_t>(cells.size()), 0});
      for (const CellId cell : all_cells(surface_)) {
        if (index_of(surface_.structure_of(cell)) != s) continue;
        cells.push_back(cell);
        ++near.back().count;
      }
    }
    const std::vector<SphereBody> balls{ball_};
    const std::vector<MaterialId> of_structures(surface_.structure_count(), MaterialId{0});
    contacts_.rebuild(pairs, near, cells, balls, of_structures, materials_);
  }

  /// Takes the ball to a place without any velocity, and its contacts with it. @returns the force
  /// (N) on the ball
  Vec3 put(const Vec3& centre) {
    velocity_.back() = Vec3::Zero();
    x_.back() = centre;
    return advance(1.0);
  }

  /// Moves the ball by a distance (m) in one step of 1 s. @returns the force (N) on the ball
  Vec3 move(const Vec3& distance) {
    velocity_.back() = distance;
    x_.back() += distance;
    return advance(1.0);
  }

  /// Lets all nodes go on with their velocities. @returns the force (N) on the ball
  Vec3 step(double dt) {
    for (std::size_t i = 0; i < x_.size(); ++i) x_[i] += dt * velocity_[i];
    return advance(dt);
  }

  std::vector<ContactRecord> rows() const {
    std::vector<ContactRecord> rows;
    contacts_.for_each_record(x_, [&](const ContactRecord& row) { rows.push_back(row); });
    return rows;
  }

  /// Rows with their numbers.
  std::vector<ContactRecord> numbered_rows() {
    contacts_.assign_ids(last_number_);
    return rows();
  }

  double dissipated() const { return dissipated_; }

 private:
  Vec3 advance(double dt) {
    const auto loss = contacts_.advance({x_, velocity_, spin_}, dt, pool_);
    dissipated_ += loss.dissipated + loss.tracking;
    forces_.set_zero();
    contacts_.add_forces(forces_, pool_);
    return forces_.force.back();
  }

  Surface surface_;
  std::vector<Vec3> x_;  ///< the ball is the last node
  std::vector<Vec3> velocity_;
  std::vector<Vec3> spin_;
  SphereBody ball_;
  MaterialPairs materials_;
  Law::Parameters parameters_;
  SurfaceContacts contacts_;
  NodeForces forces_;
  geometry::ThreadPool pool_;
  double dissipated_ = 0.0;
  std::int64_t last_number_ = 0;
};

}  // namespace plekton::test
