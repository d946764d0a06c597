// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/model/acted_on.hpp"

namespace plekton::dynamics {
namespace {

class Marks {
 public:
  explicit Marks(std::size_t count) : marks_(count, 0) {}

  template <class Nodes>
  void add(const Nodes& nodes) {
    for (const NodeId node : nodes) marks_[index_of(node)] = 1;
  }
  void add(NodeId node) { marks_[index_of(node)] = 1; }

  std::vector<std::uint8_t> take() { return std::move(marks_); }

 private:
  std::vector<std::uint8_t> marks_;
};

void add_loaded(const Scene& scene, Marks& marks) {
  const Loads& loads = scene.loads;
  for (const PrescribedMotion& load : loads.motions) marks.add(load.nodes);
  for (const NodalForce& load : loads.forces) marks.add(load.nodes);
  for (const GroundSprings& load : loads.ground_springs) marks.add(load.nodes);
  for (const MassDamping& load : loads.mass_damping) marks.add(load.nodes);
  for (const SurfacePressure& load : loads.pressures)
    for (const geometry::FaceId facet : load.facets)
      marks.add(scene.elements.facets[index_of(facet)].nodes);
}

void add_tied(const Scene& scene, Marks& marks) {
  for (const Tie& tie : scene.ties) {
    marks.add(tie.node);
    if (const auto* const point = std::get_if<MaterialPoint>(&tie.to)) marks.add(point->nodes);
  }
  for (const Cable& cable : scene.cables) marks.add(cable.nodes);
}

}  // namespace

std::vector<std::uint8_t> acted_on(const Scene& scene) {
  Marks marks(scene.state.size());
  add_loaded(scene, marks);
  add_tied(scene, marks);
  for (const BeamBond& bond : scene.bonds) marks.add(bond.nodes);
  for (const SheetFacet& facet : scene.sheet_facets) marks.add(facet.nodes);
  for (const RigidBody& body : scene.rigid_bodies) {
    marks.add(body.node);
    marks.add(body.nodes);
  }
  return marks.take();
}

std::vector<std::uint8_t> servo_planes(const Scene& scene) {
  std::vector<std::uint8_t> marks(scene.planes.size(), 0);
  for (const PlaneServo& servo : scene.loads.servos) marks[servo.plane] = 1;
  return marks;
}

}  // namespace plekton::dynamics
