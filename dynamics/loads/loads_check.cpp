// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/loads_check.hpp"

#include "dynamics/loads/plane_servo.hpp"
#include "dynamics/loads/surface_pressure_check.hpp"
#include "dynamics/model/scene.hpp"
#include "dynamics/model/scene_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <string>

namespace plekton::dynamics {
namespace {

/// "translation along y"
std::string name_of(int component) {
  return std::string(component < 3 ? "translation along " : "rotation about ") +
         "xyz"[component % 3];
}

bool holds(Held held, int component) {
  return component < 3 ? holds_along(held, component) : holds_about(held, component - 3);
}

/// Collects what is wrong with the loads of a scene.
class LoadProblems {
 public:
  LoadProblems(const Scene& scene, std::ostream& text)
      : scene_(scene), text_(text), body_of_(scene.state.size(), -1) {
    for (std::size_t b = 0; b < scene.rigid_bodies.size(); ++b) {
      for (const NodeId node : scene.rigid_bodies[b].nodes) {
        if (exists(node)) body_of_[index_of(node)] = static_cast<std::int32_t>(b);
      }
    }
  }

  void list_all() {
    const Loads& loads = scene_.loads;
    for (std::size_t i = 0; i < loads.motions.size(); ++i)
      list("prescribed motion " + std::to_string(i), loads.motions[i]);
    list_motions_held_twice();
    for (std::size_t i = 0; i < loads.plane_motions.size(); ++i)
      list("motion of a plane " + std::to_string(i), loads.plane_motions[i]);
    for (std::size_t i = 0; i < loads.servos.size(); ++i)
      list("servo " + std::to_string(i), loads.servos[i]);
    list_planes_driven_twice();
    for (std::size_t i = 0; i < loads.body_servos.size(); ++i)
      list("servo of a rigid body " + std::to_string(i), loads.body_servos[i]);
    list_bodies_driven_twice();
    for (std::size_t i = 0; i < loads.forces.size(); ++i)
      list("nodal force " + std::to_string(i), loads.forces[i]);
    for (std::size_t i = 0; i < loads.ground_springs.size(); ++i)
      list("ground springs " + std::to_string(i), loads.ground_springs[i]);
    for (std::size_t i = 0; i < loads.pressures.size(); ++i)
      list_problems(loads.pressures[i], scene_, "surface pressure " + std::to_string(i), text_);
    for (std::size_t i = 0; i < loads.beam_damping.size(); ++i)
      list("beam damping " + std::to_string(i), loads.beam_damping[i]);
    for (std::size_t i = 0; i < loads.sheet_damping.size(); ++i)
      list("sheet damping " + std::to_string(i), loads.sheet_damping[i]);
    for (std::size_t i = 0; i < loads.mass_damping.size(); ++i)
      list("mass damping " + std::to_string(i), loads.mass_damping[i]);
  }

 private:
  void list(const std::string& name, const PrescribedMotion& motion) {
    expect_nodes(name, motion.nodes);
    expect_finite(name, "displacement", motion.displacement);
    expect_finite(name, "velocity", motion.velocity);
    expect_finite(name, "angular velocity", motion.angular_velocity);
    if (motion.turn) list_turn(name, motion);
    expect_starts(name, motion.nodes, motion.start);
    if (motion.held == Held::nothing)
      text_ << name << ": prescribes no component; say which in held\n";
  }

  void list_turn(const std::string& name, const PrescribedMotion& motion) {
    constexpr double kTolerance = 1e-9;  // of a unit vector
    const AxisTurn& turn = *motion.turn;
    expect_finite(name, "point of the axis", turn.point);
    expect(std::isfinite(turn.angle), name, "the angle of its turn must be finite");
    expect(std::abs(turn.axis.squaredNorm() - 1.0) < kTolerance, name,
           "the axis of its turn is not a unit vector; normalise it");
    expect(holds_translation(motion.held), name,
           "a turn about an axis moves nodes along all axes; prescribe all of their translation");
  }

  void list(const std::string& name, const PlaneMotion& motion) {
    expect_plane(name, motion.plane);
    expect_finite(name, "velocity", motion.velocity);
    if (motion.start) expect_finite(name, "point at the start", *motion.start);
  }

  void list(const std::string& name, const PlaneServo& servo) {
    expect_plane(name, servo.plane);
    for (const auto& pair : servo.between) expect_facing(name, pair);
    expect_side(name, servo);
    expect(servo.force >= 0.0 && servo.pressure >= 0.0 && servo.force + servo.pressure > 0.0, name,
           "has no target; give a force (N) or a pressure (Pa) above 0");
    expect_pace(name, servo);
    expect_finite(name, "target, area and speed",
                  Vec3(servo.force + servo.pressure, servo.area, servo.largest_speed));
  }

  void list(const std::string& name, const BodyServo& servo) {
    const double pressing = servo.force + servo.pressure;
    expect(servo.force >= 0.0 && servo.pressure >= 0.0 && servo.torque >= 0.0 &&
               pressing + servo.torque > 0.0,
           name, "has no target; give a force (N), a pressure (Pa) or a torque (N m) above 0");
    expect(!(servo.turns() && pressing > 0.0), name,
           "has a torque, and a force or pressure too; one servo drives one motion");
    for (const auto& pair : servo.between) expect_facing(name, pair);
    expect_pace(name, servo);
    expect(std::abs(servo.towards) == 1.0, name, "goes towards 1 or -1 along its axis");
    expect_finite(name, "target, area and speed",
                  Vec3(pressing + servo.torque, servo.area, servo.largest_speed));
    if (servo.body >= scene_.rigid_bodies.size()) {
      text_ << name << ": there is no rigid body " << servo.body << ", only "
            << scene_.rigid_bodies.size() << " rigid bodies\n";
    } else if (servo.axis < 0 || servo.axis > 2) {
      text_ << name << ": there is no axis " << servo.axis << ", only 0, 1 and 2\n";
    } else {
      if (!servo.turns()) expect_plate(name, servo.between, Vec3::Unit(servo.axis));
      const NodeId node = scene_.rigid_bodies[servo.body].node;
      const std::vector<Held> held =
          held_with_motions(scene_.properties.held, scene_.loads.motions);
      expect(!exists(node) || (held[index_of(node)] & driven_axis(servo)) == Held::nothing, name,
             servo.turns() ? "its rigid body is held or turned about that axis already"
                           : "its rigid body is held or moved along that axis already");
    }
  }

  /// Of what servos of planes and of bodies have in common.
  template <class Servo>
  void expect_pace(const std::string& name, const Servo& servo) {
    expect(servo.area > 0.0, name, "its area must be above 0");
    expect(servo.largest_speed > 0.0, name, "its largest speed must be above 0");
    expect(servo.gain > 0.0 && servo.gain <= 1.0, name, "its gain must be above 0, at most 1");
    if (servo.factor.lowest() < 0.0)
      text_ << name << ": its factor falls to " << servo.factor.lowest()
            << ", and a servo does not pull; give factors of at least 0\n";
  }

  void list(const std::string& name, const BeamDamping& damping) {
    expect(std::isfinite(damping.ratio) && damping.ratio >= 0.0, name,
           "its ratio must be finite and not negative");
    expect_each_once(name, damping.bonds, scene_.bonds.size(), "bond");
  }

  void list(const std::string& name, const SheetDamping& damping) {
    expect(std::isfinite(damping.ratio) && damping.ratio >= 0.0, name,
           "its ratio must be finite and not negative");
    expect_each_once(name, damping.facets, scene_.sheet_facets.size(), "sheet facet");
  }

  void list(const std::string& name, const MassDamping& damping) {
    expect_nodes(name, damping.nodes);
    expect(std::isfinite(damping.rate) && damping.rate >= 0.0, name,
           "its rate must be finite and not negative");
  }

  void expect_starts(const std::string& name, const std::vector<NodeId>& nodes,
                     const std::vector<Vec3>& starts) {
    expect(starts.empty() || starts.size() == nodes.size(), name,
           "must have a place at the start for each of its nodes, or none");
    for (const Vec3& start : starts) expect_finite(name, "place at the start", start);
  }

  void expect(bool holds, const std::string& name, const char* problem) {
    if (!holds) text_ << name << ": " << problem << '\n';
  }

  bool is_flat(std::size_t plane) const {
    return scene_.planes[plane].form == contact::Plane::Form::flat;
  }

  /// Two planes whose normals are opposite.
  void expect_facing(const std::string& name, const std::array<std::size_t, 2>& pair) {
    constexpr double kTolerance = 1e-9;  // of unit normals
    for (const std::size_t plane : pair) expect_plane(name, plane);
    if (std::max(pair[0], pair[1]) >= scene_.planes.size()) return;
    const Vec3 sum = scene_.planes[pair[0]].normal + scene_.planes[pair[1]].normal;
    if (sum.norm() < kTolerance && is_flat(pair[0]) && is_flat(pair[1])) return;
    text_ << name << ": planes " << pair[0] << " and " << pair[1]
          << " do not face each other; the distance of planes bounds an area only where their "
             "normals are opposite\n";
  }

  /// Two pairs of planes that leave an area across a direction, or none.
  void expect_plate(const std::string& name, const std::vector<std::array<std::size_t, 2>>& between,
                    const Vec3& direction) {
    const auto exists_plane = [&](std::size_t pair) {
      return between[pair][0] < scene_.planes.size();
    };
    if (between.empty()) return;
    const bool are_two = between.size() == 2;
    if (are_two && !(exists_plane(0) && exists_plane(1))) return;
    expect(are_two && bound_a_plate(scene_.planes[between[0][0]].normal,
                                    scene_.planes[between[1][0]].normal, direction),
           name,
           "the planes that it lies between bound no area across its direction; give two pairs of "
           "planes, around its four sides, or its area alone");
  }

  /// Planes bound the side of a cylinder in its length alone, and no ball.
  void expect_side(const std::string& name, const PlaneServo& servo) {
    if (servo.between.empty() || servo.plane >= scene_.planes.size()) return;
    if (is_flat(servo.plane))
      return expect_plate(name, servo.between, scene_.planes[servo.plane].normal);
    constexpr double kTolerance = 1e-9;  // of unit vectors
    const contact::Plane& plane = scene_.planes[servo.plane];
    const std::size_t end = servo.between[0][0];
    if (plane.form == contact::Plane::Form::sphere)
      text_ << name << ": plane " << servo.plane << " is a ball; give its area\n";
    else if (servo.between.size() > 1 ||
             (end < scene_.planes.size() &&
              scene_.planes[end].normal.cross(plane.axis).norm() > kTolerance))
      text_ << name << ": plane " << servo.plane
            << " is a cylinder; give the two planes at its ends, across its axis\n";
  }

  void list_planes_driven_twice() {
    std::vector<bool> driven(scene_.planes.size(), false);
    const auto drive = [&](const std::string& name, std::size_t plane) {
      if (plane >= driven.size()) return;
      if (driven[plane])
        text_ << name << ": plane " << plane << " is driven already; drive every plane once\n";
      driven[plane] = true;
    };
    for (std::size_t i = 0; i < scene_.loads.plane_motions.size(); ++i) {
      const std::string name = "motion of a plane " + std::to_string(i);
      const std::size_t plane = scene_.loads.plane_motions[i].plane;
      drive(name, plane);
      if (plane < driven.size() && !scene_.planes[plane].velocity.isZero(0.0))
        text_ << name << ": plane " << plane
              << " has a velocity of its own; leave it to the motion\n";
    }
    for (std::size_t i = 0; i < scene_.loads.servos.size(); ++i)
      drive("servo " + std::to_string(i), scene_.loads.servos[i].plane);
  }

  void list_bodies_driven_twice() {
    const std::vector<BodyServo>& servos = scene_.loads.body_servos;
    for (std::size_t i = 0; i < servos.size(); ++i) {
      const auto drives_the_same = [&](const BodyServo& other) {
        return other.body == servos[i].body && other.axis == servos[i].axis &&
               other.turns() == servos[i].turns();
      };
      if (std::any_of(servos.begin(), servos.begin() + static_cast<std::ptrdiff_t>(i),
                      drives_the_same))
        text_ << "servo of a rigid body " << i << ": rigid body " << servos[i].body
              << " is driven so already; drive every motion once\n";
    }
  }

  void list(const std::string& name, const NodalForce& load) {
    expect_nodes(name, load.nodes);
    expect_finite(name, "force", load.force);
    expect_finite(name, "torque", load.torque);
  }

  void list(const std::string& name, const GroundSprings& springs) {
    expect_nodes(name, springs.nodes);
    expect_starts(name, springs.nodes, springs.start);
    if (!springs.stiffness.allFinite() || (springs.stiffness.array() < 0.0).any()) {
      text_ << name << ": stiffness (" << springs.stiffness.transpose()
            << ") N/m must be finite and not negative along every axis\n";
    }
  }

  void expect_finite(const std::string& name, const char* what, const Vec3& value) {
    if (!value.allFinite())
      text_ << name << ": its " << what << " (" << value.transpose() << ") is not finite\n";
  }

  /// Of what a load names by place: something, each there and once. @param what  "bond"
  void expect_each_once(const std::string& name, const std::vector<std::size_t>& places,
                        std::size_t count, const std::string& what) {
    if (places.empty()) text_ << name << ": has no " << what << "s; give at least one\n";
    named_.assign(count, false);
    for (const std::size_t place : places) {
      if (place >= count) {
        text_ << name << ": there is no " << what << " " << place << ", only " << count << " "
              << what << "s\n";
      } else if (named_[place]) {
        text_ << name << ": names " << what << " " << place << " twice; name it once\n";
      } else {
        named_[place] = true;
      }
    }
  }

  void expect_plane(const std::string& name, std::size_t plane) {
    if (plane < scene_.planes.size()) return;
    text_ << name << ": there is no plane " << plane << ", only " << scene_.planes.size()
          << " planes\n";
  }

  /// Nodes that exist, each once, at least one.
  void expect_nodes(const std::string& name, const std::vector<NodeId>& nodes) {
    if (nodes.empty()) text_ << name << ": has no nodes; give at least one\n";
    named_.assign(scene_.state.size(), false);
    for (const NodeId node : nodes) {
      if (!exists(node)) {
        text_ << name << ": there is no node " << static_cast<std::int32_t>(node) << ", only "
              << scene_.state.size() << " nodes\n";
      } else if (named_[index_of(node)]) {
        text_ << name << ": names node " << index_of(node) << " twice; name it once\n";
      } else {
        named_[index_of(node)] = true;
        expect_outside_bodies(name, node);
      }
    }
  }

  void expect_outside_bodies(const std::string& name, NodeId node) {
    const std::int32_t body = body_of_[index_of(node)];
    if (body < 0) return;
    text_ << name << ": node " << index_of(node) << " follows rigid body " << body
          << "; load the reference node of that, "
          << static_cast<std::int32_t>(scene_.rigid_bodies[static_cast<std::size_t>(body)].node)
          << '\n';
  }

  bool exists(NodeId node) const {
    return static_cast<std::int32_t>(node) >= 0 && index_of(node) < scene_.state.size();
  }

  /// Says it once for each motion and component, with the first node.
  void list_motions_held_twice() {
    std::vector<Held> held = scene_.properties.held;
    for (std::size_t i = 0; i < scene_.loads.motions.size(); ++i) {
      const PrescribedMotion& motion = scene_.loads.motions[i];
      std::array<bool, 6> said{};
      for (const NodeId node : motion.nodes) {
        if (!exists(node)) continue;
        for (int component = 0; component < 6; ++component) {
          bool& is_said = said[static_cast<std::size_t>(component)];
          if (is_said || !holds(motion.held & held[index_of(node)], component)) continue;
          is_said = true;
          text_ << "prescribed motion " << i << ": node " << index_of(node) << ": its "
                << name_of(component)
                << " is held or prescribed already; prescribe every component once\n";
        }
      }
      for (const NodeId node : motion.nodes) {
        if (exists(node)) held[index_of(node)] = held[index_of(node)] | motion.held;
      }
    }
  }

  const Scene& scene_;
  std::ostream& text_;
  std::vector<bool> named_;            // by NodeId, of the set that is looked at
  std::vector<std::int32_t> body_of_;  // by NodeId, rigid body that it follows; -1: none
};

}  // namespace

void list_load_problems(const Scene& scene, std::ostream& problems) {
  LoadProblems(scene, problems).list_all();
}

}  // namespace plekton::dynamics
