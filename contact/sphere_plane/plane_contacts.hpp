// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/bodies.hpp"
#include "contact/law/material_pairs.hpp"
#include "contact/sphere_sphere/sphere_batch.hpp"
#include "contact/tracking/contact_memory.hpp"
#include "contact/tracking/force_records.hpp"
#include "contact/tracking/rekey.hpp"
#include "contact/tracking/slip_state.hpp"
#include "geometry/base/function_ref.hpp"
#include "geometry/base/parallel_sum.hpp"
#include "geometry/base/state_archive.hpp"
#include "geometry/primitives/elements.hpp"

#include <array>
#include <span>
#include <vector>

namespace plekton::contact {

/// Contacts of spheres (a) with planes (b): one slot for each pair that may touch. A plane has the
/// stiffness of a sphere of its material and of the radius of the sphere that touches it. Spheres of
/// one rigid body that touch a plane carry its mass together, and so do their dashpots: each has an
/// equal part of it.
class PlaneContacts {
 public:
  /// Takes a new list of pairs (sphere, plane), sorted; pairs in both lists keep their memory.
  /// @param materials  must outlive this
  /// @returns the energy (J) lost with contacts that left the list
  double rebuild(std::span<const geometry::IndexPair> pairs, std::span<const SphereBody> spheres,
                 std::span<const Plane> planes, const MaterialPairs& materials);

  /// One step of all contacts; adds their forces to the nodes.
  /// @returns the energy (J) dissipated
  double advance(const Motion& motion, std::span<const Plane> planes, double dt,
                 geometry::ThreadPool& pool, NodeForces& forces);

  /// Adds the forces of the last step once more, to other sums.
  void add_forces(NodeForces& forces, geometry::ThreadPool& pool) const {
    records_.add_to(forces, pool);
  }
  std::size_t touching() const noexcept { return records_.size(); }
  /// Largest overlap of the last step over the radius of the smaller sphere.
  double largest_overlap_ratio() const noexcept { return records_.deepest(); }

  /// Energy (J) stored in all contacts, at the positions of the last step.
  double elastic_energy() const;

  /// Force (N) of all bodies on a plane in the last step.
  Vec3 force_on(std::size_t plane) const;

  /// Calls visit(sphere's node, plane, parameters, gap) for every touching pair.
  template <class Visit>
  void for_each_touching(Visit&& visit) const {
    records_.for_each([&](const PlaneForce& record) {
      const Slot& slot = slots_[record.contact];
      visit(record.a, record.plane, slot.parameters, slot.gap);
    });
  }

  /// Calls visit(sphere's node, plane, parameters, gap) for every listed pair that is nearer than a
  /// margin (m) with the bodies where they are now.
  template <class Visit>
  void for_each_near(double margin, std::span<const Plane> planes, Positions x,
                     Visit&& visit) const {
    for (const Slot& slot : slots_) {
      const Plane& plane = planes[slot.plane];
      const double gap = plane.height(x[index_of(slot.node)]) - slot.radius;
      if (gap < margin + AnyLaw::interaction_range(slot.parameters))
        visit(slot.node, slot.plane, slot.parameters, gap);
    }
  }

  /// Calls visit(plane, force (N) on it, how much of it (N) is out of the space of the bodies) for
  /// every touching pair of the last step, in a fixed order.
  template <class Visit>
  void for_each_force(Visit&& visit) const {
    records_.for_each([&](const PlaneForce& record) {
      visit(record.plane, record.force, record.force.dot(slots_[record.contact].memory.normal));
    });
  }

  /// Gives a number after the last one to every contact that has none.
  void assign_ids(std::int64_t& last) {
    for (Slot& slot : slots_) {
      if (!slot.memory.is_new() && slot.id == 0) slot.id = ++last;
    }
  }

  /// Calls visit(ContactRecord) for every touching pair of the last step, in the order of the list.
  /// @param structures  by sphere of the list: of what it is a node; -1 for a sphere by itself
  void for_each_record(Positions x, std::span<const geometry::StructureId> structures,
                       VisitRecord visit) const;

  /// @param list  makes the list anew by rebuild()
  void exchange(const geometry::StateArchive& archive, geometry::FunctionRef<void()> list,
                geometry::ThreadPool& pool);

  /// Goes on with the pairs of others that are listed here too.
  /// @param spheres, planes  places of theirs among these, ascending; -1: not there
  /// @param list             makes the list anew by rebuild()
  void take_over(const PlaneContacts& before, std::span<const std::int32_t> spheres,
                 std::span<const std::int32_t> planes, geometry::FunctionRef<void()> list,
                 geometry::ThreadPool& pool);

 private:
  struct Slot {
    NodeId node;
    std::size_t plane;
    double radius;
    double gap = 0.0;  ///< m, of the last step
    AnyLaw::Parameters parameters;
    ContactMemory<AnyLaw> memory;
    std::int64_t id = 0;  ///< 0: none yet
  };

  /// A slot of a sphere of a rigid body.
  struct OnBody {
    std::size_t slot;
    std::size_t place;  ///< of this body and plane in touching_on_bodies_
    BodyPart sphere;    ///< with the mass of the body
    BodyPart plane;
    std::size_t sharing = 1;  ///< how many share the mass in the parameters of the slot
  };

  using Records = typename ForceRecords<PlaneForce>::List;

  /// A touching pair in a state.
  struct KeptPair {
    std::array<std::int32_t, 2> pair;  ///< sphere and plane
    double gap;                        ///< m
    ContactMemory<AnyLaw> memory;
    std::int64_t id;
    Vec3 force;     ///< N, on the plane
    Vec3 torque_a;  ///< N m, on the sphere
  };

  /// Slots that touch, in the order of the list, and how high (m) their centres are.
  struct Touching {
    std::array<std::size_t, kBatchLanes> slot;
    std::array<double, kBatchLanes> height;
    std::size_t count = 0;
    const AnyLaw::Functions* law = nullptr;  ///< of all of them
    bool all_have_images = true;             ///< none is so deep that it is beyond its mirror image
  };

  bool touches(const Slot& slot, double height) const;
  void find_bodies(std::span<const geometry::IndexPair> keys, std::span<const SphereBody> spheres,
                   std::span<const Plane> planes);
  template <class Touches>
  void share_masses(const Touches& touches);
  void share_masses_as_kept();
  static double end_contact(Slot& slot, double height, const Plane& plane, const Motion& motion,
                            double dt);
  static SphereMotionOf<double> motion_of(const Slot& slot, const Vec3& separation,
                                          const Plane& plane, const Motion& motion);
  /// One step of slots that touch, of one law, side by side if it allows. @returns the energy (J)
  /// dissipated
  double advance_touching(const Touching& touching, const Motion& motion,
                          std::span<const Plane> planes, double dt, Records& records);
  /// One step of all contacts of some spheres.
  double advance_spheres(std::size_t begin, std::size_t end, const Motion& motion,
                         std::span<const Plane> planes, double dt, Records& records);
  void gather(const Touching& touching, const Motion& motion, std::span<const Plane> planes,
              SphereBatch& batch) const;
  double scatter(const Touching& touching, SphereBatch& batch, Records& records);
  double advance_one(std::size_t i, double height, const Motion& motion,
                     std::span<const Plane> planes, double dt, Records& records);
  void begin_anew(geometry::FunctionRef<void()> list, geometry::ThreadPool& pool);
  std::vector<KeptPair> kept_pairs() const;
  std::size_t exchange_pair(geometry::RowFields& row, KeptPair& kept, std::size_t from) const;
  void keep(const KeptPair& kept, std::size_t place, double overlap_ratio);

  std::vector<Slot> slots_;
  std::vector<OnBody> on_bodies_;
  std::vector<std::size_t> touching_on_bodies_;  ///< how many, by body and plane
  const MaterialPairs* materials_ = nullptr;
  std::size_t sphere_count_ = 0;
  ForceRecords<PlaneForce> records_;
  Rekey<Slot> rekey_;
  geometry::ParallelSum<double> sum_;
};

}  // namespace plekton::contact
