// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/takeover/scenario_text.hpp"

#include "apps/takeover/material_table.hpp"
#include "apps/takeover/node_boxes.hpp"
#include "apps/takeover/yade_grid.hpp"
#include "geometry/base/printable.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

namespace plekton::apps::yade {
namespace {

using geometry::Box;

constexpr double kRigidThickness =
    0.02;  // of the smallest radius: how far a surface moves out is half of it

std::string text_of(const Vec3& v) {
  return fmt::format("[{}, {}, {}]", v[0], v[1], v[2]);
}

/// As it may stand in a comment, which a line break would end, and which may have no other control
/// characters.
std::string on_one_line(std::string_view text) {
  std::string shown = geometry::printable(text);
  for (std::size_t at = shown.find('\n'); at != std::string::npos; at = shown.find('\n', at))
    shown.replace(at, 1, "\\n");
  return shown;
}

/// A list with a row on each line.
template <class Rows, class Write>
std::string list_of(const Rows& rows, const Write& write) {
  std::string text = "[\n";
  for (const auto& row : rows) text += fmt::format("  {},\n", write(row));
  return text + "]";
}

std::string list_of_vectors(const std::vector<Vec3>& vectors) {
  return list_of(vectors, text_of);
}

bool any_moves(const std::vector<Vec3>& vectors) {
  return std::ranges::any_of(vectors, [](const Vec3& v) { return v != Vec3::Zero(); });
}

/// Letters of what is blocked that are among these.
std::string among(const std::string& blocked, std::string_view letters) {
  std::string text;
  for (const char letter : letters)
    if (blocked.find(letter) != std::string::npos) text += letter;
  return text;
}

using Key = std::array<double, 3>;
Key key_of(const Vec3& v) {
  return {v[0], v[1], v[2]};
}

/// How a node is held: what is blocked, and how it moves along and about these.
using Hold = std::tuple<std::string, Key, Key>;

/// Force and torque.
using Load = std::tuple<Key, Key>;

Hold hold_of(const Body& body) {
  Key velocity{}, angular_velocity{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<Eigen::Index>(axis);
    if (body.blocked.find("xyz"[axis]) != std::string::npos) velocity[axis] = body.velocity[k];
    if (body.blocked.find("XYZ"[axis]) != std::string::npos)
      angular_velocity[axis] = body.angular_velocity[k];
  }
  return {body.blocked, velocity, angular_velocity};
}

double ball_volume(double radius) {
  return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

/// What is said of some bodies in the same words, once: `membrane "grid 0" and 3 more: ...`.
std::vector<std::string> folded(const std::vector<std::string>& notes) {
  struct Note {
    std::string who, kind, what;
    std::size_t count = 1;
  };
  std::vector<Note> found;
  for (const std::string& note : notes) {
    const std::size_t colon = note.find("\": ");
    const std::string who = colon == std::string::npos ? "" : note.substr(0, colon + 1);
    const Note next{who, who.substr(0, who.find('"')), note.substr(who.size())};
    const auto same = std::ranges::find_if(found, [&](const Note& n) {
      return !n.who.empty() && n.kind == next.kind && n.what == next.what;
    });
    if (same == found.end())
      found.push_back(next);
    else
      ++same->count;
  }
  std::vector<std::string> lines;
  for (const Note& note : found)
    lines.push_back(note.count == 1
                        ? note.who + note.what
                        : fmt::format("{} and {} more{}", note.who, note.count - 1, note.what));
  return lines;
}

class Writer {
 public:
  Writer(const Scene& scene, const TakeoverOptions& options)
      : scene_(scene), options_(options), materials_(scene) {
    for (const PermanentForce& force : scene.forces)
      loads_on_.try_emplace(force.id, key_of(force.force), key_of(force.torque));
  }

  Takeover written() {
    note_what_is_left_out();
    const std::vector<Grid> grids = grids_of(scene_, notes_);
    for (std::size_t i = 0; i < grids.size(); ++i) write_grid(grids[i], i);
    write_grains();
    write_clumps();
    write_rigid_facets();
    write_walls();
    note_contacts_that_differ(grids);
    Takeover result;
    result.scenario = head(grids) + materials_.text(notes_) + bodies_ + loads_;
    result.counts = std::move(counts_);
    result.notes = folded(notes_);
    return result;
  }

 private:
  std::string head(const std::vector<Grid>& grids) const {
    std::string text = fmt::format(
        "# SI units. Taken over from {} at iteration {} of YADE ({} s); report.txt says what has "
        "no\n"
        "# counterpart here. The duration is that of {:g} steps of YADE.\n[simulation]\n"
        "duration = {}\ntime_step = {}\ngravity = {}\n",
        on_one_line(options_.script), scene_.iteration, scene_.time, options_.steps,
        options_.steps * scene_.time_step,
        has_chosen_step() ? "\"auto\"" : fmt::format("{}", scene_.time_step),
        text_of(scene_.gravity));
    if (scene_.damping != 0.0) text += fmt::format("damping = {}\n", scene_.damping);
    if (!scene_.damps_gravity) text += "damp_gravity = false\n";
    if (!grids.empty() && !grids_touch()) text += "self_contact = false\n";
    return text + '\n';
  }

  /// As YADE lets a stepper choose, or where its step is refused here.
  bool has_chosen_step() const { return options_.has_chosen_step || !scene_.stepper.empty(); }

  bool grids_touch() const {
    return has_functor(scene_, "Ig2_GridConnection_GridConnection_GridCoGridCoGeom") ||
           has_functor(scene_, "Ig2_PFacet_PFacet_ScGeom");
  }

  void write_grid(const Grid& grid, std::size_t number) {
    const std::string name = fmt::format("\"grid {}\"", number);
    std::vector<Vec3> velocities;
    Nodes nodes{.who = "membrane " + name, .target = fmt::format("membrane = {}\n", name)};
    double mass = 0.0;
    double turning = 0.0;
    for (const std::size_t i : grid.nodes) {
      const GridNode& node = scene_.nodes[i];
      nodes.points.push_back(node.position);
      nodes.bodies.push_back(&node);
      velocities.push_back(node.velocity);
      mass += node.mass;
      turning = std::max(turning, node.angular_velocity.norm());
    }
    const auto row = [](const auto& corners) { return fmt::format("{}", corners); };
    bodies_ += fmt::format("[[membranes]]\nname = {}\n", name);
    bodies_ += fmt::format("shape.kind = \"{}\"\nshape.points = {}\n",
                           grid.facets.empty() ? "bars" : "facets", list_of_vectors(nodes.points));
    if (!grid.facets.empty())
      bodies_ += fmt::format("shape.facets = {}\n", list_of(grid.facets, row));
    if (!grid.bars.empty()) bodies_ += fmt::format("shape.bars = {}\n", list_of(grid.bars, row));
    bodies_ += fmt::format(
        "mode = \"{}\"\nthickness = {}\nmaterial = {}\nyoung_modulus = {}\ndensity = {}\n",
        grid.bends ? "lattice" : "truss", 2.0 * grid.radius, materials_.of_surface(grid.material),
        grid.young_modulus, grid.density);
    if (grid.bends) bodies_ += fmt::format("poisson_ratio = {}\n", grid.poisson_ratio);
    if (grid.strength > 0.0) {
      bodies_ +=
          fmt::format("{} = {}\n", grid.is_fragile ? "strength" : "yield_stress", grid.strength);
      notes_.push_back(
          fmt::format("membrane {}: its beams {} where the stress of the outermost fibre "
                      "is above that of YADE's adhesion in tension; YADE compares force "
                      "and moments one by one",
                      name, grid.is_fragile ? "break" : "yield"));
    }
    if (any_moves(velocities))
      bodies_ += fmt::format("initial_velocities = {}\n", list_of_vectors(velocities));
    if (turning > 0.0 && grid.bends)
      notes_.push_back(
          fmt::format("membrane {}: nodes turn with up to {:.3g} rad/s: left out, they "
                      "begin without",
                      name, turning));
    bodies_ += '\n';
    counts_.push_back(
        fmt::format("membrane {}: {} nodes, {:.6g} kg, {} facets, {} bars beside them", name,
                    grid.nodes.size(), mass, grid.facets.size(), grid.bars.size()));
    hold_nodes(nodes, grid.bends);
    load_nodes(nodes);
  }

  /// Nodes of a membrane, or grains of one table.
  struct Nodes {
    std::string who;             ///< as in `membrane "grid 0"`
    std::string target;          ///< of a load, a line
    std::vector<Vec3> points{};  ///< m
    std::vector<const Body*> bodies{};
  };

  /// Nodes by what is said of each; nothing is said where it is the default.
  template <class What>
  static std::map<What, std::vector<bool>> by(const Nodes& nodes, const auto& what) {
    std::map<What, std::vector<bool>> chosen;
    for (std::size_t i = 0; i < nodes.bodies.size(); ++i) {
      const What said = what(*nodes.bodies[i]);
      if (said == What{}) continue;
      chosen.try_emplace(said, nodes.bodies.size(), false).first->second[i] = true;
    }
    return chosen;
  }

  /// Lines of loads that say what they act on: all, or boxes.
  std::vector<std::string> targets_of(const Nodes& nodes, const std::vector<bool>& chosen) {
    if (std::ranges::find(chosen, false) == chosen.end())
      return {nodes.target + "nodes = \"all\"\n"};
    const NodeBoxes around = boxes_around(nodes.points, chosen);
    if (!around.hold_all)
      notes_.push_back(
          fmt::format("{}: nodes at one place of which some are held or loaded "
                      "and others are not: these are as if they were not",
                      nodes.who));
    std::vector<std::string> targets;
    for (const Box& box : around.boxes)
      targets.push_back(fmt::format("{}nodes = {{ min = {}, max = {} }}\n", nodes.target,
                                    text_of(box.lower), text_of(box.upper)));
    return targets;
  }

  void hold_nodes(const Nodes& nodes, bool turn) {
    for (const auto& [hold, chosen] : by<Hold>(nodes, hold_of))
      for (const std::string& target : targets_of(nodes, chosen))
        write_hold(target, hold, std::ranges::count(chosen, true), turn);
  }

  /// A load that holds what it names, or moves it for good.
  void write_hold(const std::string& target, const Hold& hold, std::ptrdiff_t nodes, bool turns) {
    const auto& [blocked, velocity, angular] = hold;
    const std::string axes = among(blocked, "xyz"), turns_of = among(blocked, "XYZ");
    const bool is_clamped = turns && turns_of.size() == 3;
    std::string who = target.substr(0, target.find('\n'));
    who.erase(who.find("= "), 2);
    if (turns && !turns_of.empty() && !is_clamped)
      notes_.push_back(
          fmt::format("{}: rotation of {} nodes is blocked about {} alone: left out, "
                      "they turn freely",
                      who, nodes, turns_of));
    if (axes.empty() && !is_clamped) return;
    loads_ += fmt::format("[[loads]]\nkind = \"motion\"\n{}", target);
    const Vec3 v(velocity[0], velocity[1], velocity[2]), w(angular[0], angular[1], angular[2]);
    if (!axes.empty()) {
      loads_ += fmt::format("components = \"{}\"\n", axes);
      loads_ += v == Vec3::Zero() ? "displacement = [0, 0, 0]\n"
                                  : fmt::format("velocity = {}\n", text_of(v));
    }
    if (is_clamped && (axes.empty() || w != Vec3::Zero()))
      loads_ += fmt::format("angular_velocity = {}\n", text_of(w));
    else if (is_clamped)
      loads_ += "hold_rotation = true\n";
    loads_ += '\n';
  }

  /// That is permanent; zero if there is none.
  Load load_on(const Body& body) const {
    const auto found = loads_on_.find(body.id);
    return found == loads_on_.end() ? Load{} : found->second;
  }

  void write_force(const std::string& target, const Load& load) {
    const auto& [force, torque] = load;
    loads_ += fmt::format("[[loads]]\nkind = \"force\"\n{}force = [{}]\ntorque = [{}]\n\n", target,
                          fmt::join(force, ", "), fmt::join(torque, ", "));
  }

  void load_nodes(const Nodes& nodes) {
    const auto load = [&](const Body& body) { return load_on(body); };
    for (const auto& [said, chosen] : by<Load>(nodes, load))
      for (const std::string& target : targets_of(nodes, chosen)) write_force(target, said);
  }

  /// A table for each material and way of being held.
  void write_grains() {
    std::map<std::pair<std::string, Hold>, std::vector<const Sphere*>> tables;
    for (const Sphere& sphere : scene_.spheres) {
      const double density = sphere.mass / ball_volume(sphere.radius);
      if (!(density > 0.0) && sphere.blocked.size() < 6) {
        notes_.push_back(fmt::format("sphere {}: it has no mass: left out", sphere.id));
        continue;
      }
      // What is held for good needs some density, which nothing depends on.
      const std::string material =
          materials_.of_grains(sphere.material, density > 0.0 ? density : 1000.0);
      tables[{material, hold_of(sphere)}].push_back(&sphere);
    }
    int number = 0;
    for (const auto& [key, spheres] : tables)
      write_grains(fmt::format("\"spheres {}\"", number++), key.first, key.second, spheres);
  }

  void write_grains(const std::string& name, const std::string& material, const Hold& hold,
                    const std::vector<const Sphere*>& spheres) {
    Nodes nodes{.who = "grains " + name, .target = fmt::format("grains = {}\n", name)};
    std::vector<Vec3> velocities, angular_velocities;
    std::vector<double> radii;
    double mass = 0.0;
    for (const Sphere* const sphere : spheres) {
      nodes.points.push_back(sphere->position);
      nodes.bodies.push_back(sphere);
      radii.push_back(sphere->radius);
      velocities.push_back(sphere->velocity);
      angular_velocities.push_back(sphere->angular_velocity);
      mass += sphere->mass;
    }
    bodies_ += fmt::format("[[grains]]\nname = {}\nmaterial = {}\ncentres = {}\nradii = {}\n", name,
                           material, list_of_vectors(nodes.points),
                           list_of(radii, [](double r) { return fmt::format("{}", r); }));
    if (any_moves(velocities))
      bodies_ += fmt::format("velocities = {}\n", list_of_vectors(velocities));
    if (any_moves(angular_velocities))
      bodies_ += fmt::format("angular_velocities = {}\n", list_of_vectors(angular_velocities));
    bodies_ += '\n';
    counts_.push_back(fmt::format("grains {}: {}, {:.6g} kg", name, spheres.size(), mass));
    if (hold != Hold{})
      write_hold(nodes.target, hold, static_cast<std::ptrdiff_t>(spheres.size()), true);
    load_nodes(nodes);
  }

  void write_clumps() {
    std::size_t spheres = 0;
    double mass = 0.0;
    for (const Clump& clump : scene_.clumps) {
      const std::string name = fmt::format("\"clump {}\"", clump.id);
      bodies_ +=
          fmt::format("[[rigid_bodies]]\nname = {}\nmaterial = {}\nmass = {}\ncentre = {}\n", name,
                      materials_.of_surface(clump.material), clump.mass, text_of(clump.position));
      bodies_ += "spheres = [\n";
      for (std::size_t i = 0; i < clump.radii.size(); ++i)
        bodies_ += fmt::format("  {{ centre = {}, radius = {} }},\n", text_of(clump.centres[i]),
                               clump.radii[i]);
      bodies_ += "]\n";
      write_inertia(clump, name);
      write_motion(clump);
      if (const Load load = load_on(clump); load != Load{})
        write_force(fmt::format("rigid_body = {}\n", name), load);
      bodies_ += '\n';
      spheres += clump.radii.size();
      mass += clump.mass;
    }
    if (!scene_.clumps.empty())
      counts_.push_back(fmt::format("clumps as rigid bodies: {}, {} spheres, {:.6g} kg",
                                    scene_.clumps.size(), spheres, mass));
  }

  /// A scenario says moments about x, y and z alone.
  void write_inertia(const Clump& clump, const std::string& name) {
    geometry::Mat3 tensor = geometry::Mat3::Zero();
    for (std::size_t k = 0; k < 3; ++k)
      tensor +=
          clump.inertia[static_cast<Eigen::Index>(k)] * clump.axes[k] * clump.axes[k].transpose();
    const Vec3 moments = tensor.diagonal();
    const double products = (tensor - geometry::Mat3(moments.asDiagonal())).cwiseAbs().maxCoeff();
    if (products <= 1e-9 * moments.maxCoeff())
      bodies_ += fmt::format("inertia = {}\n", text_of(moments));
    else
      notes_.push_back(
          fmt::format("rigid body {}: its principal axes are not along x, y and z, so its "
                      "moments of inertia are those of its spheres, overlaps counted once",
                      name));
  }

  void write_motion(const Body& body) {
    std::string turns = among(body.blocked, "XYZ");
    std::ranges::transform(turns, turns.begin(),
                           [](char c) { return static_cast<char>(c + 'a' - 'A'); });
    if (const std::string axes = among(body.blocked, "xyz"); !axes.empty())
      bodies_ += fmt::format("hold = \"{}\"\n", axes);
    if (!turns.empty()) bodies_ += fmt::format("hold_rotation = \"{}\"\n", turns);
    if (body.velocity != Vec3::Zero())
      bodies_ += fmt::format("velocity = {}\n", text_of(body.velocity));
    if (body.angular_velocity != Vec3::Zero())
      bodies_ += fmt::format("angular_velocity = {}\n", text_of(body.angular_velocity));
  }

  /// Of facets that have none: a small part of the smallest radius that meets them.
  double rigid_thickness() const {
    double radius = std::numeric_limits<double>::infinity();
    for (const Sphere& sphere : scene_.spheres) radius = std::min(radius, sphere.radius);
    for (const Clump& clump : scene_.clumps)
      for (const double r : clump.radii) radius = std::min(radius, r);
    for (const GridNode& node : scene_.nodes) radius = std::min(radius, node.radius);
    if (std::isfinite(radius)) return kRigidThickness * radius;
    return 1e-3 * (scene_.facets[0].points[1] - scene_.facets[0].points[0]).norm();
  }

  /// Facets and boxes that move alike are one body, which does not touch itself.
  void write_rigid_facets() {
    if (scene_.facets.empty()) return;
    const double thickness = rigid_thickness();
    std::map<std::tuple<int, Key, Key>, RigidGroup> groups;
    std::size_t free = 0;
    for (const RigidFacets& body : scene_.facets) {
      if (body.blocked.size() < 6) ++free;
      const auto key =
          std::tuple{body.material, key_of(body.velocity), key_of(body.angular_velocity)};
      RigidGroup& group = groups[key];
      static_cast<Body&>(group.all) = body;
      append(group, body, thickness);
    }
    for (const auto& [key, group] : groups) write_rigid(group.all, thickness);
    notes_.push_back(
        fmt::format("rigid facets have a thickness here: {:.3g} m, half of it on either side "
                    "of where they are in YADE (boxes have the size that they have there)",
                    thickness));
    if (free > 0)
      notes_.push_back(
          fmt::format("{} facets or boxes move freely in YADE; here they are held", free));
  }

  /// Facets that move alike.
  struct RigidGroup {
    RigidFacets all;
    std::map<Key, std::size_t> numbers;  ///< of the points, by place
  };

  /// Joins points that are equal; a box shrinks by half the thickness, which its facets add again.
  static void append(RigidGroup& group, const RigidFacets& body, double thickness) {
    std::vector<Vec3> points = body.points;
    if (body.is_box) {
      const Vec3 centre = 0.5 * (points.front() + points.back());
      for (const std::size_t along : {1u, 2u, 4u}) {
        const Vec3 axis = (body.points[along] - body.points[0]).normalized();
        for (Vec3& point : points)
          point -= std::copysign(0.5 * thickness, (point - centre).dot(axis)) * axis;
      }
    }
    std::vector<std::size_t> numbers;
    for (const Vec3& point : points) {
      const auto [found, is_new] =
          group.numbers.try_emplace(key_of(point), group.all.points.size());
      numbers.push_back(found->second);
      if (is_new) group.all.points.push_back(point);
    }
    for (const auto& [a, b, c] : body.facets)
      group.all.facets.push_back({numbers[a], numbers[b], numbers[c]});
  }

  void write_rigid(const RigidFacets& group, double thickness) {
    const std::string name = fmt::format("\"facets {}\"", group.id);
    bodies_ += fmt::format(
        "[[rigid_bodies]]\nname = {}\nmaterial = {}\nthickness = {}\nfilling = \"shell\"\n"
        "hold = \"xyz\"\nhold_rotation = \"xyz\"\nshape.kind = \"facets\"\nshape.points = {}\n"
        "shape.facets = {}\n",
        name, materials_.of_rigid(group.material), thickness, list_of_vectors(group.points),
        list_of(group.facets, [](const auto& corners) { return fmt::format("{}", corners); }));
    if (group.velocity != Vec3::Zero())
      bodies_ += fmt::format("velocity = {}\n", text_of(group.velocity));
    if (group.angular_velocity != Vec3::Zero()) {
      bodies_ += fmt::format("angular_velocity = {}\n", text_of(group.angular_velocity));
      notes_.push_back(
          fmt::format("rigid body {}: it turns about its centre as a whole; in YADE each "
                      "facet about its own",
                      name));
    }
    bodies_ += '\n';
    counts_.push_back(fmt::format("rigid body {}: {} facets", name, group.facets.size()));
  }

  /// Bodies on either side of a wall.
  std::pair<std::size_t, std::size_t> sides_of(const Wall& wall) const {
    std::size_t below = 0, above = 0;
    const auto look = [&](const Vec3& x) {
      ++(x[wall.axis] < wall.position[wall.axis] ? below : above);
    };
    for (const Sphere& sphere : scene_.spheres) look(sphere.position);
    for (const GridNode& node : scene_.nodes) look(node.position);
    for (const Clump& clump : scene_.clumps)
      for (const Vec3& centre : clump.centres) look(centre);
    return {below, above};
  }

  void write_walls() {
    for (const Wall& wall : scene_.walls) {
      const auto [below, above] = sides_of(wall);
      const double side = wall.sense != 0 ? wall.sense : above >= below ? 1.0 : -1.0;
      if ((side > 0.0 ? below : above) > 0) {
        notes_.push_back(
            fmt::format("wall {}: there are bodies on both of its sides; a plane has one: "
                        "left out",
                        wall.id));
        continue;
      }
      Vec3 normal = Vec3::Zero();
      normal[wall.axis] = side;
      bodies_ += fmt::format(
          "[[planes]]\nname = \"wall {}\"\nmaterial = {}\npoint = {}\nnormal = {}\n", wall.id,
          materials_.of_surface(wall.material), text_of(wall.position), text_of(normal));
      if (wall.velocity != Vec3::Zero())
        bodies_ += fmt::format("velocity = {}\n", text_of(wall.velocity));
      bodies_ += '\n';
      counts_.push_back(fmt::format("plane \"wall {}\"", wall.id));
    }
  }

  void note_what_is_left_out() {
    if (scene_.is_periodic) notes_.push_back("the cell is periodic; here space is not");
    for (const auto& [shape, number] : scene_.others)
      notes_.push_back(fmt::format("{} bodies of shape {}: left out", number, shape));
    for (const std::string& engine : scene_.engines) {
      constexpr std::array<std::string_view, 5> kKnown = {"ForceResetter", "InsertionSortCollider",
                                                          "InteractionLoop", "NewtonIntegrator",
                                                          "GlobalStiffnessTimeStepper"};
      if (std::ranges::find(kKnown, engine) == kKnown.end())
        notes_.push_back(fmt::format("engine {}: left out, with what it would do", engine));
    }
    constexpr std::array<std::string_view, 9> kKnown = {
        "Ip2_FrictMat_FrictMat_FrictPhys",
        "Ip2_CohFrictMat_CohFrictMat_CohFrictPhys",
        "Ip2_FrictMat_FrictMat_MindlinPhys",
        "Law2_ScGeom_FrictPhys_CundallStrack",
        "Law2_ScGridCoGeom_FrictPhys_CundallStrack",
        "Law2_GridCoGridCoGeom_FrictPhys_CundallStrack",
        "Law2_ScGeom6D_CohFrictPhys_CohesionMoment",
        "Law2_ScGridCoGeom_CohFrictPhys_CundallStrack",
        "Law2_ScGeom_MindlinPhys_Mindlin"};
    for (const std::string& functor : scene_.functors)
      if ((functor.starts_with("Ip2_") || functor.starts_with("Law2_")) &&
          std::ranges::find(kKnown, functor) == kKnown.end())
        notes_.push_back(
            fmt::format("{}: has no counterpart; contacts are linear_frictional", functor));
    for (const auto& [functor, attributes] : scene_.functor_settings)
      notes_.push_back(fmt::format(
          "{}: what it sets is left out: {}; contacts are as [materials] and [[contacts]] say",
          functor, fmt::join(attributes, ", ")));
    if (scene_.contacts > 0)
      notes_.push_back(fmt::format("{} contacts are there: their friction begins anew, from zero",
                                   scene_.contacts));
  }

  /// Pairs of bodies that go through each other in YADE.
  void note_contacts_that_differ(const std::vector<Grid>& grids) {
    const auto note_without = [&](bool are_there, std::string_view functor, std::string_view pair) {
      const bool touch = std::ranges::any_of(
          scene_.functors, [&](const std::string& f) { return f.starts_with(functor); });
      if (are_there && !touch)
        notes_.push_back(
            fmt::format("{} do not touch in YADE (no {}...); here they do", pair, functor));
    };
    const bool spheres = !scene_.spheres.empty();
    note_without(scene_.spheres.size() > 1, "Ig2_Sphere_Sphere_", "spheres and spheres");
    note_without(spheres && !scene_.connections.empty() && scene_.pfacets.empty(),
                 "Ig2_Sphere_GridConnection_", "spheres and connections");
    note_without(spheres && !scene_.pfacets.empty(), "Ig2_Sphere_PFacet_", "spheres and PFacets");
    if (grids.size() > 1 && !grids_touch())
      notes_.push_back("grids do not touch each other in YADE; here they do");
  }

  const Scene& scene_;
  const TakeoverOptions& options_;
  MaterialTable materials_;
  std::map<int, Load> loads_on_;  // that are permanent, by id of the body
  std::string bodies_, loads_;
  std::vector<std::string> counts_, notes_;
};

}  // namespace

Takeover take_over(const Scene& scene, const TakeoverOptions& options) {
  return Writer(scene, options).written();
}

}  // namespace plekton::apps::yade
