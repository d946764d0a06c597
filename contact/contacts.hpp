// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/bodies.hpp"
#include "contact/base/motion.hpp"
#include "contact/base/plane_action.hpp"
#include "contact/law/pair_springs.hpp"
#include "contact/tracking/contact_record.hpp"
#include "geometry/base/function_ref.hpp"
#include "geometry/base/thread_pool.hpp"
#include "geometry/critical/product_features.hpp"
#include "geometry/primitives/proximity.hpp"
#include "geometry/primitives/surface_change.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace plekton::geometry {
class CellNeighbours;
class Neighbours;
class StateArchive;
}  // namespace plekton::geometry

namespace plekton::contact {

class PatchFinder;
class StructureProbe;
class SharedMotion;

/// How many contacts of each kind there are.
struct ContactCounts {
  std::size_t sphere_sphere = 0;
  std::size_t sphere_surface = 0;
  std::size_t between_structures = 0;
  std::size_t with_planes = 0;
};

/// Where the bodies of some contacts are among those of others, in ascending order; -1: not there.
struct BodyPlaces {
  std::vector<std::int32_t> nodes;    ///< by node
  std::vector<std::int32_t> spheres;  ///< by sphere
  std::vector<std::int32_t> planes;   ///< by plane
};

/// All contacts of a scene, whatever their law: spheres with spheres, spheres with surfaces,
/// structures with each other and with themselves, spheres and nodes of surfaces with planes. A
/// ContactModel makes them (contact_model.hpp).
///
/// Calls of many functions a step would be slow; these are a few, and what is inside knows the law
/// as a type.
class Contacts {
 public:
  template <class... Arguments>
  using Visit = geometry::FunctionRef<void(Arguments...)>;

  Contacts() = default;
  Contacts(const Contacts&) = delete;
  Contacts& operator=(const Contacts&) = delete;
  virtual ~Contacts() = default;

  /// From now on the spheres' lists choose their skin by themselves
  /// (geometry/neighbor/neighbours.hpp).
  /// @param radius  m, > 0, of a usual sphere
  virtual void tune_skin(double radius) noexcept = 0;

  /// From now on the lists of structures choose their skin by themselves
  /// (geometry/neighbor/cell_neighbours.hpp).
  virtual void choose_skin_of_structures() = 0;

  /// One step: finds who touches whom, carries histories over, asks the law, and sets the forces of
  /// all nodes to those of contacts.
  virtual void advance(const Motion& motion, std::span<const Plane> planes, double dt,
                       geometry::ThreadPool& pool, NodeForces& forces) = 0;

  /// Which of several processes moves which nodes; null: each that there is moves all of them.
  virtual SharedMotion* shared_motion() noexcept { return nullptr; }
  /// Whether advance() will look at all nodes, not only at those that are near others: to be asked
  /// once before it, with the same motion, where a process does not know all of them.
  virtual bool makes_lists(const Motion& motion, std::span<const Plane> planes,
                           geometry::ThreadPool& pool) = 0;

  /// Goes on with what is left of the surface after some of its elements have broken away
  /// (geometry::Surface::left_with). Contacts go on where a feature they touch is left, those far
  /// from the change to the last bit. Nodes go on touching planes, also those that have lost their
  /// last element. To be called where advance() would be, before it; linear in the lists.
  /// @param change  to the surface as it is now, which outlives this
  /// @param motion  of this step
  /// @param at      m, where the nodes were half a drift ago: to compare elastic energies there
  ///                loses nothing to second order (trapezoidal rule)
  virtual void follow(const geometry::SurfaceChange& change, const Motion& motion, Positions at,
                      geometry::ThreadPool& pool) = 0;

  /// All that decides how contacts go on, and what can be read out of the last step. A state that
  /// is read has to be of contacts of the same bodies, materials and laws, on what is left of the
  /// same surface; threads may be other ones. Lists are made anew, from where they were made.
  /// @throws geometry::StateMismatch
  virtual void exchange(const geometry::StateArchive& archive, std::span<const Plane> planes,
                        geometry::ThreadPool& pool) = 0;

  /// Goes on with those contacts of a scene that may have had other spheres and planes, and numbers
  /// of materials, which this scene has too; of the same structures and laws. What pairs remember
  /// goes on; pairs that are not there any more are left out, and their energy with them. To be
  /// called before the first step, on the surface as it is there.
  /// @param places  of its bodies among these
  /// @param x       m, where the nodes are
  /// @throws geometry::StateMismatch if the structures or laws are others
  virtual void take_over(Contacts& before, const BodyPlaces& places, std::span<const Plane> planes,
                         Positions x, geometry::ThreadPool& pool) = 0;

  virtual ContactCounts counts() const noexcept = 0;

  /// Energy (J) stored at the positions of the last step.
  virtual double elastic_energy() const = 0;
  /// Energy (J) dissipated since the beginning, by the law and with contacts that are over.
  virtual double dissipated() const noexcept = 0;
  /// Energy (J) lost since the beginning, or below 0 made, where contacts go on as others: where
  /// histories are handed from patch to patch, on lists that change, and with elements that break.
  virtual double tracking_loss() const noexcept = 0;

  /// Largest overlap of the last step over a radius: of the smaller of two spheres, of the sphere on
  /// a surface or plane, of the thinner of two structures.
  virtual double largest_overlap_ratio() const noexcept = 0;
  /// How many spheres' centres went through a facet or a cylinder in the last step.
  virtual std::int64_t pass_throughs() const noexcept = 0;
  /// Pairs of facets and cylinders whose cores cross.
  virtual std::size_t crossings() const noexcept = 0;

  /// Numbers the contacts of the last step that have no number yet, from 1 on, in a fixed order:
  /// the same numbers for any number of threads, and none given twice. A contact keeps its number
  /// as long as it lasts, from element to element, whoever asks for it in between. Where a patch
  /// splits, the part that pushes most keeps it; where some merge, the one that pushed most.
  virtual void assign_ids() = 0;

  /// Calls visit for every contact of the last step, in a fixed order. Together the rows hold all
  /// that contacts did to the nodes.
  /// @param x  m, where the nodes were in that step
  virtual void for_each_record(Positions x, Visit<const ContactRecord&> visit) const = 0;
  /// Those of them between structures that have no row, as their elastic forces cancel: of bodies
  /// that lie one in the other. At the features that are deepest; without normal and force.
  virtual void for_each_balanced(Positions x, Visit<const ContactRecord&> visit) const = 0;
  /// Calls visit(row, force (N), torque (N m)) for contacts between structures, with what each did
  /// to one node.
  virtual void for_each_structure_record_on(
      NodeId node, Positions x,
      Visit<const ContactRecord&, const Vec3&, const Vec3&> visit) const = 0;

  /// Adds what contacts did in the last step to the nodes of surfaces: forces of spheres on each
  /// other are left out.
  virtual void add_surface_forces(NodeForces& forces, geometry::ThreadPool& pool) const = 0;
  /// Adds what contacts of spheres with surfaces did.
  virtual void add_sphere_surface_forces(NodeForces& forces, geometry::ThreadPool& pool) const = 0;

  /// What all bodies did to a plane in the last step, if there was any. Of ranks all have to ask.
  virtual const PlaneAction& on_plane(std::size_t plane) const = 0;

  /// Bonds between structures that hold.
  virtual std::size_t structure_bond_count() const = 0;

  // What the time step depends on. Gaps are in m, negative where bodies overlap.

  using VisitSpheres = Visit<NodeId, NodeId, const PairSprings&, double>;
  using VisitSphereOnSurface =
      Visit<NodeId, const geometry::CorePoint&, const PairSprings&, double, const TermPart&>;
  using VisitPlane = Visit<NodeId, std::size_t, const PairSprings&, double>;

  /// Calls visit(a, b, springs, gap) for every touching pair of spheres, in the order of the list. Of
  /// ranks all have to ask for pairs of spheres, and each is told of all.
  virtual void for_each_sphere_pair(VisitSpheres visit) const = 0;
  /// The same for every listed pair that is nearer than a margin (m) with the nodes where they are
  /// now.
  virtual void for_each_near_sphere_pair(double margin, Positions x, VisitSpheres visit) const = 0;

  /// Calls visit(sphere's node, core point, springs, range (m): radius of the sphere and of the
  /// surface, part) for every term of a contact of a sphere with a surface.
  virtual void for_each_surface_term(VisitSphereOnSurface visit) const = 0;
  /// The same, without force, for what is not in contact but may be once bodies are nearer by a
  /// margin (m).
  virtual void for_each_coming_surface_term(double margin, Positions x,
                                            VisitSphereOnSurface visit) const = 0;
  /// Adds the elastic normal forces on spheres and surfaces with the nodes at x.
  /// @param of  which spheres, by their nodes
  virtual void add_elastic_forces(Positions x, NodeForces& forces, PatchFinder& finder,
                                  geometry::FunctionRef<bool(NodeId)> of) const = 0;

  /// Calls visit(node, stiffness, radius (m)) for what contacts between structures are to their
  /// nodes.
  virtual void for_each_structure_stiffness(
      Visit<NodeId, const PairStiffness&, double> visit) const = 0;
  /// Lets a probe ask how structures push each other with nodes near where they were in the last
  /// step.
  virtual void probe_structures(StructureProbe& probe) const = 0;
  /// Calls visit(cells) for the listed pairs of cells of structures that do not touch, but may be
  /// as near as a margin (m).
  virtual void for_each_near_cell_pair(double margin,
                                       Visit<const geometry::CellPair&> visit) const = 0;

  /// Calls visit(node, plane, springs, gap) for every sphere that touches a plane.
  virtual void for_each_plane_pair(VisitPlane visit) const = 0;
  /// The same for every listed pair that is nearer than a margin (m) with the bodies where they are
  /// now.
  virtual void for_each_near_plane_pair(double margin, std::span<const Plane> planes, Positions x,
                                        VisitPlane visit) const = 0;

  /// Stiffness of so many equal contacts side by side of two bodies, at a gap (m).
  virtual PairStiffness stiffness(const BodyPart& a, const BodyPart& b, double gap,
                                  double count = 1.0) const = 0;

  /// How often a list of pairs that may touch was made: what is not in one cannot touch before the
  /// next.
  virtual std::int64_t list_count() const noexcept = 0;
  /// Of ranks each has found some of the pairs of spheres.
  virtual const geometry::Neighbours& neighbours() const noexcept = 0;
  virtual const geometry::CellNeighbours& cell_neighbours() const noexcept = 0;
};

}  // namespace plekton::contact
