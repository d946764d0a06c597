// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/closest_word.hpp"
#include "apps/scenario/read_load_targets.hpp"
#include "apps/scenario/read_sections.hpp"
#include "dynamics/loads/plane_servo.hpp"
#include "dynamics/loads/surface_pressure_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace plekton::apps {
namespace {

using dynamics::Held;
using dynamics::TimeTable;

constexpr Range kGain{0.0, 1.0, false, true, " above 0, at most 1"};

/// The table that multiplies a load; 1 if there is none.
/// @param must_change  the load does nothing where the factor stays as it is
TimeTable read_factor(Section& section, bool must_change = false) {
  constexpr std::string_view kRemedy =
      "nodes move as the factor changes; give factor = [[\"0 s\", 0], [\"10 ms\", 1]]";
  const bool is_given = section.has("factor");
  if (must_change && !is_given) section.complain("factor", fmt::format("missing; {}", kRemedy));
  if (!is_given) return {};
  std::vector<TimeTable::Row> rows;
  for (const auto& [time, value] : section.rising_rows("factor", {kTime}, {kNumber}))
    rows.push_back({time, value});
  const bool changes = std::any_of(rows.begin(), rows.end(), [&](const TimeTable::Row& row) {
    return row.value != rows.front().value;
  });
  if (must_change && !rows.empty() && !changes)
    section.complain("factor", fmt::format("is {} at all times; {}", rows.front().value, kRemedy));
  return rows.empty() ? TimeTable() : TimeTable(std::move(rows));
}

/// Whether exactly one of two keys is there; complains otherwise.
bool has_one_of(Section& section, std::string_view a, std::string_view b, std::string_view why) {
  const bool has_a = section.has(a);
  const bool has_b = section.has(b);
  if (has_a != has_b) return true;
  section.complain(a, fmt::format("got {} of {} and {}; expected exactly one of them: {}",
                                  has_a ? "both" : "none", a, b, why));
  return false;
}

Held read_components(Section& section) {
  constexpr std::array<std::string_view, 7> kWords = {"xyz", "x", "y", "z", "xy", "xz", "yz"};
  constexpr std::array kMeanings = {Held::translation,
                                    Held::along_x,
                                    Held::along_y,
                                    Held::along_z,
                                    Held::along_x | Held::along_y,
                                    Held::along_x | Held::along_z,
                                    Held::along_y | Held::along_z};
  return kMeanings[section.choice("components", kWords, 0)];
}

dynamics::PlaneMotion read_plane_motion(Section& section, const Scenario& scenario) {
  dynamics::PlaneMotion motion;
  motion.plane = read_plane_name(section, scenario).value_or(0);
  motion.velocity = section.vector("velocity", {kVelocity});
  motion.factor = read_factor(section);
  return motion;
}

std::optional<dynamics::AxisTurn> read_turn(Section& section) {
  std::optional<Section> table = section.optional_table("turn");
  if (!table) return std::nullopt;
  dynamics::AxisTurn turn;
  turn.point = table->vector("point", {kLength});
  turn.axis = table->vector("axis", {kNumber}, turn.axis);
  turn.angle = table->quantity("angle", {kAngle});
  if (turn.axis.stableNorm() == 0.0)
    table->complain("axis", "got a vector of no length; expected the direction of the axis");
  turn.axis.stableNormalize();
  table->finish();
  return turn;
}

/// Whether something in the nodes' body resists turning them.
bool are_turned(const NodeSetSettings& set, const Scenario& scenario) {
  if (set.rigid_body || set.of_grains || set.body >= scenario.membranes.size()) return true;
  const MembraneSettings& membrane = scenario.membranes[set.body];
  return membrane.mode != MembraneMode::truss && membrane.bending_stiffness != 0.0;
}

/// Of a displacement or velocity along axes that a motion leaves free.
void require_components(Section& section, std::string_view key, const Vec3& motion, Held held) {
  for (int axis = 0; axis < 3; ++axis) {
    if (dynamics::holds_along(held, axis) || motion[axis] == 0.0) continue;
    section.complain(key,
                     fmt::format("is {} along {}, which components leaves free; expected 0 there, "
                                 "or components that name {}",
                                 motion[axis], "xyz"[axis], "xyz"[axis]));
  }
}

/// Whether the motion has a part that goes with the change of its factor.
bool follows_change(const dynamics::PrescribedMotion& motion) {
  const bool turns = motion.turn && std::abs(motion.turn->angle) > 0.0;
  return turns || (motion.displacement.array().abs() > 0.0).any();
}

MotionSettings read_motion(Section& section, const Scenario& scenario) {
  MotionSettings settings;
  settings.nodes = read_node_set(section, scenario);
  dynamics::PrescribedMotion& motion = settings.motion;
  motion.turn = read_turn(section);
  const bool turns = section.has("angular_velocity");
  const bool moves = section.has("displacement") || section.has("velocity");
  motion.held = Held::nothing;
  if (moves || motion.turn || !turns) {
    if (moves || !motion.turn)
      has_one_of(section, "displacement", "velocity", "a motion needs to be told");
    motion.held = read_components(section);
    if (motion.turn && motion.held != Held::translation)
      section.complain("components",
                       "a turn moves nodes along all axes; leave components or turn out");
    if (section.has("displacement"))
      motion.displacement = section.vector("displacement", {kLength});
    if (section.has("velocity")) motion.velocity = section.vector("velocity", {kVelocity});
    require_components(section, "displacement", motion.displacement, motion.held);
    require_components(section, "velocity", motion.velocity, motion.held);
  }
  const bool turns_with_axis = motion.turn && are_turned(settings.nodes, scenario);
  section.tell_default("hold_rotation", "whether they are turned");
  if (section.truth("hold_rotation", turns || turns_with_axis))
    motion.held = motion.held | Held::rotation;
  if (turns) motion.angular_velocity = section.vector("angular_velocity", {kAngularVelocity});
  if (turns && (motion.held & Held::rotation) != Held::rotation)
    section.complain("hold_rotation", "got false, but angular_velocity says how the nodes turn");
  motion.factor = read_factor(section, follows_change(motion));
  return settings;
}

ForceSettings read_force(Section& section, const Scenario& scenario) {
  ForceSettings settings;
  settings.nodes = read_node_set(section, scenario);
  settings.is_total = section.has("total_force");
  const bool has_torque = section.has("torque");
  if (has_torque) settings.load.torque = section.vector("torque", {kTorque});
  const bool turns = (settings.load.torque.array().abs() > 0.0).any();
  if (turns && !are_turned(settings.nodes, scenario))
    section.complain("torque",
                     fmt::format("the nodes of \"{}\" do not turn, since nothing in it resists "
                                 "bending, and a torque on them does nothing; expected a force, or "
                                 "a membrane in mode lattice, or continuum with bending stiffness",
                                 scenario.membranes[settings.nodes.body].name));
  if (!has_torque || settings.is_total || section.has("force"))
    has_one_of(section, "force", "total_force", "the force on each node, or on all together");
  if (section.has("force")) settings.load.force = section.vector("force", {kForce});
  if (settings.is_total) settings.load.force = section.vector("total_force", {kForce});
  settings.load.factor = read_factor(section);
  return settings;
}

GroundSpringSettings read_ground_springs(Section& section, const Scenario& scenario) {
  return {read_node_set(section, scenario),
          {{}, section.vector("stiffness", {kStiffness, kNotNegative})}};
}

MassDampingSettings read_mass_damping(Section& section, const Scenario& scenario) {
  return {read_node_set(section, scenario), {{}, section.quantity("rate", {kRate, kNotNegative})}};
}

BeamDampingSettings read_beam_damping(Section& section, const Scenario& scenario) {
  return {read_membrane_name(section, scenario).value_or(0),
          {{}, section.quantity("ratio", {kNumber, kNotNegative})}};
}

SheetDampingSettings read_sheet_damping(Section& section, const Scenario& scenario) {
  return {read_membrane_name(section, scenario).value_or(0),
          {{}, section.quantity("ratio", {kNumber, kNotNegative})}};
}

/// No gas has less than none.
void require_gas_pressure(Section& section, const dynamics::SurfacePressure& load) {
  const double lowest = dynamics::lowest_gas_pressure(load);
  if (!(lowest < 0.0)) return;
  section.complain(
      "pressure",
      fmt::format("times its factor falls to {} Pa, which with the outside_pressure of "
                  "{} Pa leaves the gas {} Pa; expected a sum of at least 0: give less "
                  "suction, or leave gas out for one that does not depend on the volume",
                  lowest - load.gas->outside_pressure, load.gas->outside_pressure, lowest));
}

PressureSettings read_pressure(Section& section, const Scenario& scenario) {
  PressureSettings settings;
  settings.membrane = read_membrane_name(section, scenario).value_or(0);
  settings.membrane_place = section.place_of("membrane");
  has_one_of(section, "pressure", "by_volume", "how strong it is");
  if (section.has("pressure")) settings.load.pressure = section.quantity("pressure", {kPressure});
  settings.volume_place = section.place_of(section.has("by_volume") ? "by_volume" : "gas");
  if (section.has("by_volume")) {
    auto rows = section.rising_rows("by_volume", {kVolume, kPositive}, {kPressure});
    if (!rows.empty()) settings.load.by_volume = dynamics::PressureByVolume{std::move(rows)};
    if (section.has("gas"))
      section.complain("gas", "by_volume says how the pressure follows the volume; leave one out");
  }
  settings.load.factor = read_factor(section);
  if (auto table = section.optional_table("gas")) {
    dynamics::Gas gas;
    gas.outside_pressure =
        table->quantity("outside_pressure", {kPressure, kNotNegative}, gas.outside_pressure);
    gas.exponent = table->quantity("exponent", {kNumber, kPositive}, gas.exponent);
    table->finish();
    settings.load.gas = gas;
    require_gas_pressure(section, settings.load);
  }
  return settings;
}

/// Of a servo, which only presses.
TimeTable read_pressing_factor(Section& section) {
  TimeTable factor = read_factor(section);
  const double lowest = factor.lowest();
  if (lowest < 0.0)
    section.complain("factor",
                     fmt::format("falls to {}, and a servo does not pull; expected factors of at "
                                 "least 0, or a motion or a force for what is to be drawn away",
                                 lowest));
  return factor;
}

/// The force or pressure of a servo, of a plane or of a body.
template <class Servo>
void read_pressing(Section& section, const Scenario& scenario, Servo& servo) {
  has_one_of(section, "force", "pressure", "a servo needs a target");
  if (section.has("force")) servo.force = section.quantity("force", {kForce, kPositive});
  if (section.has("pressure")) {
    servo.pressure = section.quantity("pressure", {kPressure, kPositive});
    has_one_of(section, "area", "between", "a pressure needs the area of the plate");
  }
  if (section.has("area")) servo.area = section.quantity("area", {kArea, kPositive});
  if (section.has("between")) servo.between = read_plane_pairs(section, scenario);
  if (section.has("force") && (section.has("area") || section.has("between")))
    section.complain("force", "is the whole force on the plate; area and between go with pressure");
}

void read_servo_axis(Section& section, std::string_view key, dynamics::BodyServo& servo) {
  constexpr std::array<std::string_view, 6> kWords = {"x", "-x", "y", "-y", "z", "-z"};
  const std::size_t direction = section.choice(key, kWords);
  servo.axis = static_cast<int>(direction / 2);
  servo.towards = direction % 2 == 0 ? 1.0 : -1.0;
}

void read_torque(Section& section, dynamics::BodyServo& servo) {
  for (const std::string_view key :
       {"force", "pressure", "area", "between", "direction", "speed"}) {
    if (section.has(key))
      section.complain(key,
                       "does not go with torque, which turns the body about an axis (about); "
                       "one servo drives one motion: give each a load of its own");
  }
  servo.torque = section.quantity("torque", {kTorque, kPositive});
  read_servo_axis(section, "about", servo);
  servo.largest_speed = section.quantity("angular_speed", {kAngularVelocity, kPositive});
}

/// Of a plate that moves along a direction.
/// @param name  of the plane or the body
void require_plate(Section& section, const Scenario& scenario,
                   std::span<const std::array<std::size_t, 2>> between, const Vec3& direction,
                   std::string_view name) {
  const auto normal = [&](std::size_t pair) { return scenario.planes[between[pair][0]].normal; };
  const bool are_two = between.size() == 2;
  if (are_two && dynamics::bound_a_plate(normal(0), normal(1), direction)) return;
  section.complain(
      "between",
      fmt::format(
          "got {}; expected the two pairs of planes that bound \"{}\" on its four sides, as "
          "in [\"left\", \"right\", \"front\", \"back\"], or give its area",
          are_two ? "two pairs of planes whose normals and the direction of the servo lie "
                    "in one plane"
                  : "one pair of planes, whose distance is no area",
          name));
}

/// Planes bound the side of a cylinder in its length alone, and no sphere.
void require_side(Section& section, const Scenario& scenario, const dynamics::PlaneServo& servo) {
  if (servo.between.empty() || servo.plane >= scenario.planes.size()) return;
  constexpr double kAlong = 1e-9;  // of unit vectors
  const PlaneSettings& plane = scenario.planes[servo.plane];
  const Vec3& of_end = scenario.planes[servo.between[0][0]].normal;
  if (plane.is_flat()) require_plate(section, scenario, servo.between, plane.normal, plane.name);
  if (plane.form == contact::Plane::Form::sphere)
    section.complain("between", fmt::format("\"{}\" is a sphere; expected its area", plane.name));
  if (plane.form == contact::Plane::Form::cylinder &&
      (servo.between.size() > 1 || of_end.cross(plane.axis).norm() > kAlong))
    section.complain("between",
                     fmt::format("\"{}\" is a cylinder; expected the names of the two planes at "
                                 "its ends, across its axis",
                                 plane.name));
}

dynamics::PlaneServo read_servo(Section& section, const Scenario& scenario) {
  dynamics::PlaneServo servo;
  const std::optional<std::size_t> plane = read_plane_name(section, scenario);
  servo.plane = plane.value_or(0);
  read_pressing(section, scenario, servo);
  if (plane) require_side(section, scenario, servo);
  servo.largest_speed = section.quantity("speed", {kVelocity, kPositive});
  servo.gain = section.quantity("gain", {kNumber, kGain}, servo.gain);
  servo.factor = read_pressing_factor(section);
  return servo;
}

BodyServoSettings read_body_servo(Section& section, const Scenario& scenario) {
  BodyServoSettings settings;
  const std::optional<std::size_t> body = read_rigid_body_name(section, scenario);
  settings.rigid_body = body.value_or(0);
  settings.place = section.place_of("rigid_body");
  dynamics::BodyServo& servo = settings.servo;
  if (section.has("torque")) {
    read_torque(section, servo);
  } else {
    read_servo_axis(section, "direction", servo);
    read_pressing(section, scenario, servo);
    servo.largest_speed = section.quantity("speed", {kVelocity, kPositive});
    if (body && !servo.between.empty())
      require_plate(section, scenario, servo.between, Vec3::Unit(servo.axis),
                    scenario.rigid_bodies[*body].name);
  }
  servo.gain = section.quantity("gain", {kNumber, kGain}, servo.gain);
  servo.factor = read_pressing_factor(section);
  return settings;
}

}  // namespace

LoadSettings read_load(Section section, const Scenario& scenario, std::size_t number) {
  constexpr std::array<std::string_view, 9> kKinds = {
      "motion",         "force",        "pressure",      "servo",       "gravity",
      "ground_springs", "beam_damping", "sheet_damping", "mass_damping"};
  LoadSettings settings;
  section.tell_default("name", "loads N");
  settings.name = section.name("name", default_load_name(number));
  settings.path = section.path();
  settings.place = section.place();
  const std::optional<std::size_t> kind = section.known_choice("kind", kKinds);
  if (!kind) return settings;
  switch (*kind) {
    case 0:
      if (section.has("plane"))
        settings.load = read_plane_motion(section, scenario);
      else
        settings.load = read_motion(section, scenario);
      break;
    case 1:
      settings.load = read_force(section, scenario);
      break;
    case 2:
      settings.load = read_pressure(section, scenario);
      break;
    case 3:
      section.tell_default("plane", "required without rigid_body");
      section.tell_default("direction", "required with rigid_body, but for a torque");
      section.tell_default("about", "required with torque");
      section.tell_default("speed", "required but for a torque");
      section.tell_default("angular_speed", "required with torque");
      if (section.has("rigid_body"))
        settings.load = read_body_servo(section, scenario);
      else
        settings.load = read_servo(section, scenario);
      break;
    case 4:
      section.tell_default("factor", "required");
      if (!section.has("factor"))
        section.complain(
            "factor", "missing; expected a list of [time, factor], by which gravity is multiplied");
      settings.load = GravitySettings{read_factor(section)};
      break;
    case 5:
      settings.load = read_ground_springs(section, scenario);
      break;
    case 6:
      settings.load = read_beam_damping(section, scenario);
      break;
    case 7:
      settings.load = read_sheet_damping(section, scenario);
      break;
    default:
      settings.load = read_mass_damping(section, scenario);
      break;
  }
  section.finish();
  return settings;
}

}  // namespace plekton::apps
