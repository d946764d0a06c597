// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/bodies.hpp"
#include "contact/base/plane_action.hpp"
#include "contact/law/material_pairs.hpp"
#include "contact/sphere_plane/action_sums.hpp"
#include "contact/sphere_plane/plane_pieces.hpp"
#include "contact/sphere_sphere/block_totals.hpp"
#include "contact/sphere_sphere/sphere_batch.hpp"
#include "contact/tracking/contact_memory.hpp"
#include "contact/tracking/rekey.hpp"
#include "contact/tracking/slip_state.hpp"
#include "geometry/base/function_ref.hpp"
#include "geometry/base/state_archive.hpp"
#include "geometry/primitives/elements.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace plekton::contact {

/// Contacts of spheres (a) with planes (b): one slot for each pair that may touch. A plane has the
/// stiffness of a sphere of its material and of the radius of the sphere that touches it. Spheres of
/// one rigid body that touch a plane carry its mass together, and so do their dashpots: each has an
/// equal part of it.
///
/// Ranks share them out with the spheres (plane_pieces.hpp). What asks for contacts then has to be
/// asked by all ranks.
class PlaneContacts {
 public:
  /// Shares out what there is on the list: before the first step with it, or with other holders.
  /// @param spheres  of the list
  void share_out(std::span<const SphereBody> spheres, const SphereHolders& holders);

  /// Takes a new list of pairs (sphere, plane), sorted; pairs in both lists keep their memory. None
  /// is computed before they are shared out.
  /// @param materials  must outlive this
  /// @returns the energy (J) lost with contacts that left the list
  double rebuild(std::span<const geometry::IndexPair> pairs, std::span<const SphereBody> spheres,
                 std::span<const Plane> planes, const MaterialPairs& materials);

  /// One step of all contacts; adds their forces to the nodes.
  /// @returns the energy (J) dissipated
  double advance(const Motion& motion, std::span<const Plane> planes, double dt,
                 geometry::ThreadPool& pool, NodeForces& forces);

  /// Adds the forces of the last step once more, to other sums.
  void add_forces(NodeForces& forces) const;
  std::size_t touching() const noexcept { return totals_.touching; }
  /// Largest overlap of the last step over the radius of the smaller sphere.
  double largest_overlap_ratio() const noexcept { return totals_.largest_ratio; }

  /// Energy (J) stored in all contacts, at the positions of the last step.
  double elastic_energy() const;

  /// What all bodies did to a plane in the last step; nothing before the first.
  const PlaneAction& action_on(std::size_t plane) const;
  /// Finds that anew, as if the bodies were where they are now: after take_over().
  void add_up_actions(Positions x, std::span<const Plane> planes);

  /// Calls visit(sphere's node, plane, parameters, gap) for every touching pair, in the order of
  /// the list.
  template <class Visit>
  void for_each_touching(Visit&& visit) const {
    know_gaps();
    for (const Slot& slot : slots_)
      if (slot.touches) visit(slot.node, slot.plane, slot.parameters, slot.state.gap);
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

  /// Gives a number after the last one to every contact that has none.
  void assign_ids(std::int64_t& last);

  /// Calls visit(ContactRecord) for every touching pair of the last step, in the order of the list.
  void for_each_record(Positions x, VisitRecord visit) const;

  /// @param list  makes the list anew by rebuild()
  void exchange(const geometry::StateArchive& archive, std::size_t plane_count,
                geometry::FunctionRef<void()> list);

  /// Goes on with the pairs of others that are listed here too.
  /// @param spheres, planes  places of theirs among these, ascending; -1: not there
  /// @param list             makes the list anew by rebuild()
  void take_over(const PlaneContacts& before, std::span<const std::int32_t> spheres,
                 std::span<const std::int32_t> planes, geometry::FunctionRef<void()> list);

 private:
  /// What there is of a touching pair.
  struct PairState {
    double gap = 0.0;  ///< m, of the last step
    ContactMemory<AnyLaw> memory;
    std::int64_t id = 0;           ///< 0: none yet
    Vec3 force = Vec3::Zero();     ///< N, on the plane
    Vec3 torque_a = Vec3::Zero();  ///< N m, on the sphere
  };

  struct Slot {
    NodeId node;
    geometry::StructureId structure{-1};  ///< see SphereBody
    bool touches = false;                 ///< in the last step
    std::size_t plane;
    double radius;
    AnyLaw::Parameters parameters;
    PairState state;
  };

  /// A slot of a sphere of a rigid body.
  struct OnBody {
    std::size_t slot;
    std::size_t place;  ///< of this body and plane in touching_on_bodies_
    BodyPart sphere;    ///< with the mass of the body
    BodyPart plane;
    std::size_t sharing = 1;  ///< how many share the mass in the parameters of the slot
  };

  /// A touching pair in a state.
  struct KeptPair {
    std::array<std::int32_t, 2> pair;  ///< sphere and plane
    PairState state;
  };

  /// What a step of a piece came to.
  struct PieceOutcome {
    double dissipated = 0.0;     ///< J
    double largest_ratio = 0.0;  ///< of overlap to radius
    std::size_t touching = 0;
  };

  /// Slots that touch, in the order of the list, and how high (m) their centres are.
  struct Touching {
    std::array<std::uint32_t, kBatchLanes> slot;
    std::array<double, kBatchLanes> height;
    std::size_t count = 0;
    const AnyLaw::Functions* law = nullptr;  ///< of all of them
    bool all_have_images = true;             ///< none is so deep that it is beyond its mirror image
  };

  static bool touches(const Slot& slot, double height);
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
                          std::span<const Plane> planes, double dt);
  /// One step of all contacts of a piece. @returns the energy (J) dissipated
  double advance_piece(const PlanePieces::Piece& piece, const Motion& motion,
                       std::span<const Plane> planes, double dt);
  /// Adds what its contacts did to the nodes.
  void hand_over(const PlanePieces::Piece& piece, NodeForces& forces, PieceOutcome& outcome) const;
  void add_up_actions(const PlanePieces::Piece& piece, Positions x, std::span<const Plane> planes);
  void gather(const Touching& touching, const Motion& motion, std::span<const Plane> planes,
              SphereBatch& batch) const;
  double scatter(const Touching& touching, SphereBatch& batch);
  double advance_one(Slot& slot, double height, const Motion& motion, std::span<const Plane> planes,
                     double dt);
  void find_actions() const;
  std::span<const std::uint32_t> slots_of(const PlanePieces::Piece& piece) const noexcept {
    return pieces_.order().subspan(piece.begin, piece.end - piece.begin);
  }

  // Of ranks each knows what it computes; these make all know all.
  void know_gaps() const;
  void know_states() const;

  void begin_anew(geometry::FunctionRef<void()> list);
  std::vector<KeptPair> kept_pairs() const;
  std::size_t exchange_pair(geometry::RowFields& row, KeptPair& kept, std::size_t from) const;
  void keep(const KeptPair& kept, std::size_t place);

  mutable std::vector<Slot> slots_;
  std::vector<OnBody> on_bodies_;
  std::vector<std::size_t> touching_on_bodies_;  ///< how many, by body and plane
  const MaterialPairs* materials_ = nullptr;
  Rekey<Slot> rekey_;
  PlanePieces pieces_;
  std::vector<PieceOutcome> outcomes_;          ///< by piece
  std::vector<PlaneAction> actions_of_pieces_;  ///< by place in pieces_.planes()
  BlockTotals totals_;                          ///< of all pieces
  mutable std::vector<PlaneAction> actions_;    ///< by plane, of all pieces
  mutable bool are_actions_known_ = true;
  mutable std::vector<ActionSums> sums_;      ///< by plane
  mutable std::vector<ActionSums> own_sums_;  ///< likewise, of this rank
  /// Of what others compute.
  enum class Known : std::uint8_t { nothing, gaps, all };
  mutable Known known_ = Known::all;
  mutable std::vector<std::byte> room_;  ///< for messages
};

}  // namespace plekton::contact
