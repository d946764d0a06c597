// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/stress/random_scene.hpp"

#include "tests/support/seeded_random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace plekton::stress {
namespace {

using test::Random;
using test::Vec3;

std::string num(double value) {
  return fmt::format("{:.4g}", value);
}
std::string word(std::string_view text) {
  return fmt::format("\"{}\"", text);
}
std::string vec(const Vec3& v) {
  return fmt::format("[{:.4g}, {:.4g}, {:.4g}]", v[0], v[1], v[2]);
}

constexpr const char* kAll = "xyz";
/// A motion along some components, and 0 along the others, which are left free.
Vec3 along(const std::string& components, Vec3 motion) {
  for (int axis = 0; axis < 3; ++axis)
    if (components.find(kAll[axis]) == std::string::npos) motion[axis] = 0.0;
  return motion;
}

/// What later tables have to know of a membrane.
struct Membrane {
  std::string name;
  bool is_closed = false;
  bool has_rim = false;
  bool has_bonds = false;  // beams or bars, not the facets of a sheet
  double volume = 0.0;     // m³, of a closed one
};

/// The geometry of a shape before it is placed: around its centre.
struct Shape {
  std::string text;
  Vec3 centre = Vec3::Zero();  // m, of the box around it
  double radius = 0.0;         // m, around the centre
  double half_height = 0.0;    // m, along z
  bool is_net = false;
  bool is_chain = false;
  bool is_hexagonal = false;
  bool is_closed = false;
  double volume = 0.0;  // m³
};

class Maker {
 public:
  explicit Maker(std::uint64_t seed) : random_(seed), of_containers_(seed + 1) {}

  SceneText make() {
    is_free_ = chance(0.35);
    add_simulation();
    add_materials();
    const int bodies = random_.integer(1, 4) + (is_free_ ? 1 : 0);
    for (int i = 0; i < bodies; ++i) chance(0.6) ? add_membrane() : add_grains();
    if (!is_free_) add_planes();
    add_contacts();
    add_loads();
    add_output();
    if (!is_free_ && of_containers_.unit() < 0.2) add_container();
    // Last, so that scenes without these are as before.
    if (of_containers_.unit() < 0.25 && !has_lid_) add_rigid_bodies();
    if (!membranes_.empty() && of_containers_.unit() < 0.12) add_tie();
    return std::move(scene_);
  }

 private:
  bool chance(double share) { return random_.unit() < share; }
  double power(double low, double high) { return std::pow(10.0, random_.uniform(low, high)); }
  template <std::size_t n>
  const char* one_of(const std::array<const char*, n>& words) {
    return words[random_.index(n)];
  }

  TextTable& table(std::string head) {
    scene_.tables.push_back({std::move(head), {}});
    return scene_.tables.back();
  }
  static void set(TextTable& table, std::string key, std::string value) {
    table.keys.emplace_back(std::move(key), std::move(value));
  }

  void add_simulation() {
    TextTable& t = table("[simulation]");
    duration_ = random_.uniform(4e-3, 30e-3);
    set(t, "duration", num(duration_));
    if (chance(0.3))
      set(t, "gravity", "[0, 0, 0]");
    else if (chance(0.3))
      set(t, "gravity", vec(power(1.0, 2.3) * random_.direction()));
    if (!is_free_ && chance(0.35)) {
      set(t, "damping", num(random_.uniform(0.05, 0.8)));
      if (chance(0.3)) set(t, "damp_gravity", "false");
    }
    if (chance(0.1)) set(t, "skin", num(power(-4.0, -2.0)));
    if (chance(0.15)) set(t, "self_contact", "false");
    if (chance(0.05)) set(t, "time_step", num(power(-6.5, -4.0)));
    set(t, "seed", fmt::format("{}", random_.integer(1, 1000)));
  }

  void add_materials() {
    materials_ = random_.integer(1, 3);
    for (int i = 0; i < materials_; ++i) {
      TextTable& t = table(fmt::format("[materials.m{}]", i));
      set(t, "density", num(power(2.7, 3.7)));
      set(t, "young_modulus", num(power(6.0, 8.3)));
      set(t, "friction_angle", word(fmt::format("{} deg", random_.integer(0, 45))));
      if (chance(0.5)) set(t, "stiffness_ratio", num(random_.uniform(0.0, 1.0)));
      if (chance(0.3)) set(t, "poisson_ratio", num(random_.uniform(0.0, 0.5)));
    }
  }
  std::string material() { return fmt::format("\"m{}\"", random_.integer(0, materials_ - 1)); }

  void add_contacts() {
    for (int a = 0; a < materials_; ++a) {
      for (int b = a; b < materials_; ++b) {
        if (chance(0.3)) continue;
        TextTable& t = table("[[contacts]]");
        set(t, "between", fmt::format("\"m{}\"", a));
        set(t, "and", fmt::format("\"m{}\"", b));
        add_law(t);
      }
    }
  }

  void add_law(TextTable& t) {
    const std::string law =
        one_of<4>({"linear_frictional", "hertz_mindlin", "dmt_adhesion", "cohesive_frictional"});
    set(t, "law", word(law));
    if (law == "dmt_adhesion") set(t, "work_of_adhesion", num(power(-3.0, 0.0)));
    if (law == "linear_frictional" || law == "cohesive_frictional") {
      if (chance(0.15)) {
        set(t, "normal_stiffness", num(power(3.0, 5.5)));
        if (chance(0.5)) set(t, "tangential_stiffness", num(power(3.0, 5.0)));
      } else if (chance(0.3)) {
        set(t, "stiffness_radius", word("curvature"));
      }
    }
    if (law == "cohesive_frictional") {
      set(t, "tensile_strength", num(power(2.0, 6.0)));
      if (chance(0.8)) set(t, "shear_strength", num(power(2.0, 6.0)));
      if (chance(0.4)) set(t, "rupture_distance", num(power(-5.0, -2.7)));
      if (chance(0.2)) set(t, "bonds", word("start"));
    }
    if (chance(0.3)) {
      set(t, "rolling_stiffness", num(random_.uniform(0.1, 2.0)));
      if (chance(0.7)) set(t, "rolling_limit", num(random_.uniform(0.0, 0.5)));
    }
    if (chance(0.2)) {
      set(t, "twisting_stiffness", num(random_.uniform(0.1, 2.0)));
      if (chance(0.7)) set(t, "twisting_limit", num(random_.uniform(0.0, 0.5)));
    }
    if (chance(0.3)) set(t, "restitution", num(random_.uniform(0.1, 1.0)));
  }

  /// m, where the next body begins: mostly just above the last one, now and then in it.
  double place_above(double half_height) {
    const double gap = chance(0.06) ? -power(-3.5, -1.8) : power(-5.0, -3.0);
    const double z = top_ + gap + half_height;
    top_ = std::max(top_, z + half_height);
    return z;
  }

  /// m/s: what is higher comes down faster.
  Vec3 velocity() {
    const double fall = random_.uniform(0.5, 3.0) * static_cast<double>(bodies_);
    return Vec3(random_.uniform(-1.0, 1.0), random_.uniform(-1.0, 1.0), -fall);
  }

  Shape sheet() {
    Shape shape;
    const double width = random_.uniform(0.05, 0.2);
    const double length = random_.uniform(0.05, 0.2);
    shape.text = fmt::format(
        "kind = \"sheet\", width = {:.4g}, length = {:.4g}, cells = [{}, {}], pattern = \"{}\"",
        width, length, random_.integer(1, 6), random_.integer(1, 6),
        one_of<3>({"diagonal", "alternating", "cross"}));
    shape.radius = 0.5 * std::hypot(width, length);
    return shape;
  }
  Shape tube() {
    Shape shape;
    const double radius = random_.uniform(0.02, 0.05);
    const double length = random_.uniform(0.05, 0.15);
    shape.text = fmt::format("kind = \"tube\", radius = {:.4g}, length = {:.4g}, cells = [{}, {}]",
                             radius, length, random_.integer(3, 10), random_.integer(1, 5));
    shape.centre = Vec3(0.0, 0.0, 0.5 * length);
    shape.radius = std::hypot(radius, 0.5 * length);
    shape.half_height = 0.5 * length;
    return shape;
  }
  Shape ball() {
    Shape shape;
    shape.radius = random_.uniform(0.02, 0.06);
    shape.text = fmt::format("kind = \"sphere\", radius = {:.4g}, subdivisions = {}", shape.radius,
                             chance(0.1) ? 2 : random_.integer(0, 1));
    shape.half_height = shape.radius;
    shape.is_closed = true;
    shape.volume = 4.0 / 3.0 * std::numbers::pi * std::pow(shape.radius, 3);
    return shape;
  }
  Shape box() {
    Shape shape;
    const Vec3 size =
        Vec3(random_.uniform(0.03, 0.1), random_.uniform(0.03, 0.1), random_.uniform(0.03, 0.1));
    shape.text = fmt::format("kind = \"box\", size = {}, cells = [{}, {}, {}]", vec(size),
                             random_.integer(1, 3), random_.integer(1, 3), random_.integer(1, 3));
    shape.centre = 0.5 * size;
    shape.radius = shape.centre.norm();
    shape.half_height = shape.centre[2];
    shape.is_closed = true;
    shape.volume = size.prod();
    return shape;
  }
  Shape geogrid(bool is_biaxial) {
    Shape shape;
    const double rib_pitch = random_.uniform(0.015, 0.04);
    const double bar_pitch =
        is_biaxial ? random_.uniform(0.015, 0.04) : rib_pitch * random_.uniform(1.1, 3.0);
    const int across = random_.integer(1, 5);
    const int along = random_.integer(1, 5);
    shape.text = fmt::format(
        "kind = \"{}\", rib_pitch = {:.4g}, bar_pitch = {:.4g}, apertures = [{}, {}], "
        "divisions = {}",
        is_biaxial ? "biaxial_geogrid" : "uniaxial_geogrid", rib_pitch, bar_pitch, across, along,
        random_.integer(1, 3));
    shape.radius = 0.5 * std::hypot(rib_pitch * across, bar_pitch * along);
    shape.is_net = true;
    return shape;
  }
  Shape hexagonal() {
    Shape shape;
    const double size = random_.uniform(0.02, 0.04);
    const int across = random_.integer(2, 4);
    const int rows = random_.integer(1, 4);
    shape.text = fmt::format(
        "kind = \"hexagonal_net\", mesh_size = {:.4g}, twist_length = {:.4g}, wire_height = "
        "{:.4g}, meshes = [{}, {}]",
        size, 0.5 * size, 0.4 * size, across, rows);
    shape.radius = size * std::hypot(across, rows);
    shape.is_net = shape.is_hexagonal = true;
    return shape;
  }
  Shape rings() {
    Shape shape;
    const double diameter = random_.uniform(0.03, 0.06);
    const int across = random_.integer(1, 3);
    const int along = random_.integer(1, 3);
    shape.text =
        fmt::format("kind = \"ring_net\", ring_diameter = {:.4g}, rings = [{}, {}], divisions = {}",
                    diameter, across, along, random_.integer(1, 3));
    shape.radius = 0.5 * diameter * std::hypot(across, along);
    shape.is_net = true;
    return shape;
  }
  Shape chain() {
    Shape shape;
    const int count = random_.integer(2, 4);
    std::string points;
    for (int i = 0; i < count; ++i) {
      const Vec3 point(random_.uniform(-0.08, 0.08), random_.uniform(-0.08, 0.08),
                       random_.uniform(-0.01, 0.01));
      points += (i == 0 ? "" : ", ") + vec(point);
    }
    shape.text = fmt::format("kind = \"chain\", points = [{}], divisions = {}", points,
                             random_.integer(1, 6));
    shape.radius = 0.115;
    shape.half_height = 0.01;
    shape.is_net = shape.is_chain = true;
    return shape;
  }
  Shape any_shape() {
    switch (random_.integer(0, 9)) {
      case 0:
      case 1:
        return sheet();
      case 2:
        return tube();
      case 3:
        return ball();
      case 4:
        return box();
      case 5:
        return geogrid(true);
      case 6:
        return geogrid(false);
      case 7:
        return hexagonal();
      case 8:
        return rings();
      default:
        return chain();
    }
  }

  /// Turns it about an axis through the origin, and moves it to its place above the last body.
  void place(TextTable& t, const Shape& shape, double thickness) {
    Vec3 centre = shape.centre;
    double half_height = shape.half_height;
    if (chance(0.7)) {
      const bool lies = half_height < 0.2 * shape.radius;
      const double angle = lies ? random_.uniform(-20.0, 20.0) : random_.uniform(-180.0, 180.0);
      const Vec3 axis = lies ? Vec3(random_.uniform(-1.0, 1.0), random_.uniform(-1.0, 1.0), 0.3)
                             : random_.direction();
      const double turn = angle * std::numbers::pi / 180.0;
      set(t, "rotate", fmt::format("{{ axis = {}, angle = \"{:.4g} deg\" }}", vec(axis), angle));
      centre = Eigen::AngleAxisd(turn, axis.normalized()) * centre;
      half_height = std::min(shape.radius, half_height + shape.radius * std::abs(std::sin(turn)));
    }
    const Vec3 at(random_.uniform(-0.02, 0.02), random_.uniform(-0.02, 0.02),
                  place_above(half_height + 0.5 * thickness));
    set(t, "translate", vec(at - centre));
  }

  void add_membrane() {
    const Shape shape = any_shape();
    Membrane membrane{fmt::format("b{}", bodies_++), shape.is_closed, !shape.is_closed, true,
                      shape.volume};
    TextTable& t = table("[[membranes]]");
    set(t, "name", word(membrane.name));
    set(t, "shape", "{ " + shape.text + " }");
    const double thickness = power(-3.0, -2.2);
    place(t, shape, thickness);
    std::string mode = shape.is_net ? one_of<2>({"lattice", "truss"})
                                    : one_of<3>({"lattice", "truss", "continuum"});
    set(t, "mode", word(mode));
    membrane.has_bonds = mode != "continuum";
    set(t, "thickness", num(thickness));
    set(t, "material", material());
    add_stiffness(t, shape, mode, thickness);
    add_mass(t, shape, mode);
    if (!is_free_) add_hold(t, shape);
    set(t, "initial_velocity", vec(velocity()));
    membranes_.push_back(membrane);
  }

  void add_stiffness(TextTable& t, const Shape& shape, const std::string& mode, double thickness) {
    if (mode == "truss" && chance(0.3)) {
      const double force = power(6.5, 9.0) * thickness * thickness * 0.01;
      const std::string rows =
          fmt::format("[[\"1 %\", {:.4g}], [\"5 %\", {:.4g}], [\"{} %\", {:.4g}]]", force,
                      force * 1.6, random_.integer(6, 20), force * random_.uniform(0.5, 2.0));
      set(t, "wire", rows);
      if (shape.is_hexagonal && chance(0.5)) {
        set(t, "twist_wire",
            fmt::format("[[\"1 %\", {:.4g}], [\"9 %\", {:.4g}]]", 2.0 * force, 3.0 * force));
      }
      return;
    }
    const double modulus = power(6.3, 9.3);
    if (!shape.is_net && chance(0.2))
      set(t, "sheet_stiffness", num(modulus * thickness));
    else
      set(t, "young_modulus", num(modulus));
    if (chance(0.4)) set(t, "poisson_ratio", num(random_.uniform(0.0, 0.49)));
    if (chance(0.1)) set(t, "prestrain", num(random_.uniform(-0.02, 0.02)));
    if (mode == "continuum") {
      if (chance(0.15)) set(t, "bending_stiffness", "0");
      if (chance(0.35)) set(t, "strength", num(modulus * power(-3.0, -0.7)));
      return;
    }
    if (!chance(0.4)) return;
    const double yield = modulus * power(-3.5, -1.5);
    const bool yields = chance(0.7);
    if (yields) {
      set(t, "yield_stress", num(yield));
      if (chance(0.5)) set(t, "hardening", num(modulus * random_.uniform(0.0, 0.3)));
      if (chance(0.5)) set(t, "rupture_strain", num(power(-3.0, -0.7)));
    }
    if (!yields || chance(0.5)) set(t, "strength", num(yield * random_.uniform(1.1, 5.0)));
  }

  void add_mass(TextTable& t, const Shape& shape, const std::string& mode) {
    if (!shape.is_net && chance(0.2))
      set(t, "mass_mode", word(mode == "continuum" ? "edge" : "area"));
    if (chance(0.3)) set(t, "nodal_inertia", word("length"));
    if (!shape.is_chain && chance(0.4))
      set(t, "areal_mass", num(power(-0.3, 1.0)));
    else
      set(t, "density", num(power(2.7, 3.9)));
  }

  void add_hold(TextTable& t, const Shape& shape) {
    if (chance(0.45)) return;
    if (chance(0.12))
      set(t, "hold", word("all"));
    else if (shape.is_closed || chance(0.3))
      set(t, "hold",
          fmt::format("{{ min = [-1, -1, -1], max = [{:.4g}, 1, 1] }}",
                      random_.uniform(-0.05, 0.03)));
    else
      set(t, "hold", word("rim"));
    if (chance(0.3)) set(t, "hold_rotation", "true");
    if (chance(0.15)) set(t, "velocity", vec(random_.in_cube(1.0)));
  }

  void add_grains() {
    TextTable& t = table("[[grains]]");
    const std::string name = fmt::format("b{}", bodies_++);
    grains_.push_back(name);
    set(t, "name", word(name));
    set(t, "material", material());
    if (chance(0.35)) {
      const double radius = power(-2.3, -1.4);
      set(t, "radius", num(radius));
      set(t, "centres",
          "[" +
              vec({random_.uniform(-0.03, 0.03), random_.uniform(-0.03, 0.03),
                   place_above(radius)}) +
              "]");
    } else {
      add_bed(t);
    }
    set(t, "velocity", vec(velocity()));
    if (chance(0.5)) set(t, "angular_velocity", vec(random_.in_cube(100.0)));
  }

  /// Grains in a box that is mostly large enough.
  void add_bed(TextTable& t) {
    const double largest = random_.uniform(0.004, 0.01);
    int count = random_.integer(2, 25);
    if (chance(0.4)) {
      set(t, "sieves",
          fmt::format("[{{ sieve = {:.4g}, passing = 0 }}, {{ sieve = {:.4g}, passing = 0.6 }}, "
                      "{{ sieve = {:.4g}, passing = 1 }}]",
                      largest, 1.5 * largest, 2.0 * largest));
    } else {
      set(t, "radius", num(largest));
    }
    set(t, "count", fmt::format("{}", count));
    const bool is_lattice = chance(0.2);
    if (is_lattice) set(t, "placement", word("lattice"));
    const double half = random_.uniform(0.025, 0.06);
    const double solids = count * 4.2 * std::pow(largest, 3);
    const double room = solids / (is_lattice ? 0.35 : 0.2) / (4.0 * half * half);
    const double half_height = std::max(1.3 * largest, 0.5 * room);
    const double z = place_above(half_height);
    set(t, "box",
        fmt::format("{{ min = {}, max = {} }}", vec({-half, -half, z - half_height}),
                    vec({half, half, z + half_height})));
  }

  void add_plane(const std::string& name, const Vec3& point, const Vec3& normal) {
    TextTable& t = table("[[planes]]");
    set(t, "name", word(name));
    set(t, "point", vec(point));
    set(t, "normal", vec(normal));
    set(t, "material", material());
    if (chance(0.12)) set(t, "velocity", vec(normal * random_.uniform(-0.3, 0.3)));
    planes_.push_back(name);
  }

  void add_planes() {
    if (chance(0.5))
      add_plane("floor", {0, 0, -power(-5.0, -3.0)},
                {random_.uniform(-0.02, 0.02), 0.0, random_.uniform(0.5, 2.0)});
    has_lid_ = chance(0.25);
    if (has_lid_) add_plane("lid", {0, 0, top_ + power(-5.0, -3.0)}, {0, 0, -1});
    if (chance(0.15)) add_plane("left", {-0.2, 0, 0}, {1, 0, 0});
    if (chance(0.15)) add_plane("right", {0.2, 0, 0}, {-1, 0, 0});
  }

  /// Around all that there is; from numbers of its own, so that scenes without one are as before.
  void add_container() {
    const bool is_sphere = of_containers_.unit() < 0.4;
    const Vec3 half(0.2, 0.2, 0.5 * top_);
    TextTable& t = table("[[planes]]");
    set(t, "name", word("container"));
    set(t, "kind", word(is_sphere ? "sphere" : "cylinder"));
    set(t, "point", vec({0.0, 0.0, half.z()}));
    set(t, "axis", vec(of_containers_.direction()));
    set(t, "radius", num(of_containers_.uniform(0.5, 1.2) * half.norm()));
    set(t, "material", material());
    if (of_containers_.unit() < 0.3) set(t, "velocity", vec(of_containers_.in_cube(0.3)));
    if (of_containers_.unit() < 0.5)
      set(t, "angular_velocity", num(of_containers_.uniform(-20.0, 20.0)));
    if (of_containers_.unit() > 0.3) return;
    TextTable& servo = load("servo");
    set(servo, "plane", word("container"));
    set(servo, "force", num(of_containers_.uniform(0.1, 100.0)));
    set(servo, "speed", num(of_containers_.uniform(0.1, 2.0)));
  }

  void add_rigid_bodies() {
    const int count = random_.integer(1, 3);
    for (int i = 0; i < count; ++i) add_rigid_body();
    if (!is_free_ && chance(0.5)) add_load_of_rigid_body();
  }

  void add_rigid_body() {
    const std::string name = fmt::format("b{}", bodies_++);
    TextTable& t = table("[[rigid_bodies]]");
    set(t, "name", word(name));
    set(t, "material", material());
    if (chance(0.4)) {
      place(t, add_clump(t), 0.0);
    } else {
      const Shape shape = any_shape();
      const double thickness = power(-3.0, -2.2);
      set(t, "shape", "{ " + shape.text + " }");
      set(t, "thickness", num(thickness));
      if (shape.is_closed && chance(0.4)) set(t, "filling", word("shell"));
      place(t, shape, thickness);
    }
    set(t, "density", num(power(2.7, 3.9)));
    if (!is_free_ && chance(0.25)) set(t, "hold", word(one_of<5>({"x", "z", "xy", "yz", "xyz"})));
    if (!is_free_ && chance(0.2)) set(t, "hold_rotation", word(one_of<3>({"x", "xy", "xyz"})));
    set(t, "velocity", vec(velocity()));
    if (chance(0.5)) set(t, "angular_velocity", vec(random_.in_cube(30.0)));
    rigid_bodies_.push_back(name);
  }

  /// Spheres that overlap, or nearly do, around the first.
  Shape add_clump(TextTable& t) {
    Shape shape;
    const int count = random_.integer(1, 6);
    std::string rows;
    for (int i = 0; i < count; ++i) {
      const double radius = random_.uniform(0.004, 0.02);
      const double reach = i == 0 ? 0.0 : random_.uniform(0.3, 1.2) * radius;
      shape.radius = std::max(shape.radius, reach + radius);
      rows += fmt::format("{}{{ centre = {}, radius = {} }}", i == 0 ? "" : ", ",
                          vec(reach * random_.direction()), num(radius));
    }
    set(t, "spheres", "[" + rows + "]");
    shape.half_height = shape.radius;
    return shape;
  }

  void add_load_of_rigid_body() {
    const std::string body = word(rigid_bodies_[random_.index(rigid_bodies_.size())]);
    const char* kind = one_of<4>({"motion", "force", "servo", "mass_damping"});
    TextTable& t = load(kind);
    set(t, "rigid_body", body);
    const std::string what = kind;
    if (what == "mass_damping") return set(t, "rate", num(power(0.0, 3.0)));
    if (what == "force") {
      set(t, "force", vec(power(-1.0, 2.0) * random_.direction()));
      if (chance(0.5)) set(t, "torque", vec(power(-4.0, -1.0) * random_.direction()));
      return maybe_factor(t);
    }
    if (what == "motion") {
      const Vec3 velocity = random_.in_cube(1.0);
      const std::string components = chance(0.5) ? one_of<3>({"x", "z", "xy"}) : kAll;
      set(t, "velocity", vec(along(components, velocity)));
      if (components != kAll) set(t, "components", word(components));
      return maybe_factor(t);
    }
    if (chance(0.3)) {
      set(t, "about", word(one_of<3>({"x", "-y", "z"})));
      set(t, "torque", num(power(-3.0, 0.0)));
      return set(t, "angular_speed", num(power(0.0, 2.0)));
    }
    set(t, "direction", word(one_of<3>({"x", "-z", "z"})));
    set(t, "force", num(power(-1.0, 2.0)));
    set(t, "speed", num(power(-1.0, 0.3)));
  }

  /// Of some nodes of a membrane to what there is.
  void add_tie() {
    const Membrane& membrane = membranes_[random_.index(membranes_.size())];
    TextTable& t = table("[[ties]]");
    set(t, "from",
        fmt::format("{{ membrane = \"{}\", nodes = \"{}\" }}", membrane.name,
                    one_of<4>({"x_min", "x_max", "y_max", "z_max"})));
    if (!rigid_bodies_.empty() && chance(0.7))
      set(t, "to",
          fmt::format("{{ kind = \"{}\", rigid_body = \"{}\" }}",
                      one_of<3>({"nodes", "surface", "body"}), rigid_bodies_.front()));
    else if (is_free_ || (membranes_.size() > 1 && chance(0.5)))
      set(t, "to",
          fmt::format("{{ kind = \"surface\", membrane = \"{}\" }}",
                      membranes_[random_.index(membranes_.size())].name));
    else
      set(t, "to", "{ kind = \"ground\" }");
    if (chance(0.4)) set(t, "stiffness", num(power(2.0, 5.0)));
    if (chance(0.3)) set(t, "rest_length", num(power(-4.0, -2.0)));
    if (chance(0.4)) set(t, "only_pulls", "true");
    if (chance(0.3)) set(t, "strength", num(power(-1.0, 2.0)));
    if (chance(0.3))
      set(t, "brake",
          fmt::format("{{ force = {}, stroke = {} }}", num(power(-1.0, 1.5)),
                      num(power(-3.5, -2.0))));
  }

  std::string factor() {
    return fmt::format("[[0, {}], [{:.4g}, {}], [{:.4g}, {:.3g}]]", random_.integer(0, 1),
                       0.3 * duration_, random_.integer(0, 2), duration_,
                       random_.uniform(-1.0, 1.0));
  }
  void maybe_factor(TextTable& t) {
    if (chance(0.5)) set(t, "factor", factor());
  }

  /// Names a body and some of its nodes.
  void add_nodes(TextTable& t) {
    const std::size_t which = random_.index(membranes_.size() + grains_.size());
    if (which >= membranes_.size()) {
      set(t, "grains", word(grains_[which - membranes_.size()]));
      return;
    }
    const Membrane& membrane = membranes_[which];
    set(t, "membrane", word(membrane.name));
    set(t, "nodes",
        word(membrane.has_rim && chance(0.4)
                 ? "rim"
                 : one_of<5>({"all", "x_min", "x_max", "y_max", "z_max"})));
  }

  void add_loads() {
    for (const Membrane& membrane : membranes_) {
      if (membrane.is_closed && chance(0.5)) add_pressure(membrane);
      if (chance(0.15)) {
        TextTable& t = load(membrane.has_bonds ? "beam_damping" : "sheet_damping");
        set(t, "membrane", word(membrane.name));
        set(t, "ratio", num(random_.uniform(0.0, 0.5)));
      }
    }
    if (is_free_) return;
    const int count = random_.integer(0, 3);
    for (int i = 0; i < count; ++i) add_load();
  }

  TextTable& load(const char* kind) {
    TextTable& t = table("[[loads]]");
    set(t, "name", word(fmt::format("l{}", loads_++)));
    set(t, "kind", word(kind));
    return t;
  }

  void add_pressure(const Membrane& membrane) {
    TextTable& t = load("pressure");
    set(t, "membrane", word(membrane.name));
    if (chance(0.25)) {
      set(t, "by_volume",
          fmt::format("[[{:.4g}, {:.4g}], [{:.4g}, 0]]", 0.5 * membrane.volume, power(2.0, 4.0),
                      1.5 * membrane.volume));
    } else {
      set(t, "pressure", num(power(1.5, 4.3)));
      if (chance(0.6))
        set(t, "gas", chance(0.5) ? std::string("{}") : std::string("{ exponent = 1.4 }"));
    }
    maybe_factor(t);
  }

  void add_load() {
    switch (random_.integer(0, 7)) {
      case 0:
      case 1:
        return add_motion();
      case 2: {
        TextTable& t = load("force");
        add_nodes(t);
        set(t, chance(0.7) ? "total_force" : "force", vec(power(-2.0, 1.0) * random_.direction()));
        if (chance(0.3)) set(t, "torque", vec(power(-5.0, -2.0) * random_.direction()));
        return maybe_factor(t);
      }
      case 3: {
        TextTable& t = load("ground_springs");
        add_nodes(t);
        const double stiffness = power(1.0, 4.0);
        return set(t, "stiffness", vec({stiffness, stiffness, chance(0.3) ? 0.0 : stiffness}));
      }
      case 4: {
        TextTable& t = load("mass_damping");
        add_nodes(t);
        return set(t, "rate", num(power(0.0, 3.0)));
      }
      case 5:
        return set(load("gravity"), "factor", factor());
      case 6:
        return add_open_pressure();
      default:
        return add_servo();
    }
  }

  void add_motion() {
    if (!planes_.empty() && chance(0.3)) {
      TextTable& t = load("motion");
      set(t, "plane", word(planes_[random_.index(planes_.size())]));
      set(t, "velocity", vec(random_.in_cube(1.0)));
      return maybe_factor(t);
    }
    TextTable& t = load("motion");
    add_nodes(t);
    if (chance(0.35)) {
      set(t, "turn",
          fmt::format("{{ point = {}, axis = {}, angle = \"{} deg\" }}", vec(random_.in_cube(0.05)),
                      vec(random_.direction()), random_.integer(-90, 90)));
      return set(t, "factor", factor());
    }
    const bool is_way = chance(0.5);
    const Vec3 motion = random_.in_cube(is_way ? 0.01 : 1.0);
    if (is_way)
      set(t, "factor", factor());
    else
      maybe_factor(t);
    std::string components = kAll;
    if (chance(0.4))
      set(t, "components", word(components = one_of<5>({"x", "z", "xy", "yz", kAll})));
    else if (chance(0.3))
      set(t, "angular_velocity", vec(random_.in_cube(20.0)));
    set(t, is_way ? "displacement" : "velocity", vec(along(components, motion)));
  }

  void add_open_pressure() {
    if (membranes_.empty()) return;
    TextTable& t = load("pressure");
    set(t, "membrane", word(membranes_[random_.index(membranes_.size())].name));
    set(t, "pressure", num(random_.signed_power(1.0, 3.5)));
    maybe_factor(t);
  }

  void add_servo() {
    if (planes_.empty()) return;
    TextTable& t = load("servo");
    set(t, "plane", word(planes_[random_.index(planes_.size())]));
    if (chance(0.7)) {
      set(t, "force", num(power(-1.0, 2.0)));
    } else {
      set(t, "pressure", num(power(1.5, 4.0)));
      set(t, "area", num(power(-3.0, -1.5)));
    }
    set(t, "speed", num(power(-1.0, 0.3)));
    if (chance(0.3)) set(t, "gain", num(power(-2.0, 0.0)));
  }

  void add_output() {
    TextTable& t = table("[output]");
    if (chance(0.2)) set(t, "contact_list", "true");
    if (chance(0.1)) set(t, "contacts", "false");
    set(t, "interval", num(duration_ / random_.integer(2, 5)));
    set(t, "history_interval", num(duration_ / random_.integer(5, 50)));
    add_reactions();
    if (!chance(0.06)) return;
    TextTable& stop = table("[stop]");
    set(stop, "kinetic_energy", num(power(-6.0, -1.0)));
  }

  void add_reactions() {
    if (!planes_.empty() && chance(0.3)) {
      TextTable& r = table("[[output.reactions]]");
      set(r, "kind", word("plane"));
      set(r, "plane", word(planes_.front()));
    }
    if (!chance(0.3)) return;
    TextTable& r = table("[[output.reactions]]");
    const bool is_contacts = chance(0.4);
    set(r, "kind", word(is_contacts ? "contacts" : one_of<2>({"support", "nodes"})));
    if (is_contacts && !membranes_.empty())
      set(r, "membrane", word(membranes_.front().name));
    else if (is_contacts)
      set(r, "grains", word(grains_.front()));
    else
      add_nodes(r);
  }

  Random random_;
  Random of_containers_;
  SceneText scene_;
  bool is_free_ = false;
  bool has_lid_ = false;   // above what was made before the planes
  double duration_ = 0.0;  // s
  int materials_ = 0;
  int bodies_ = 0;
  int loads_ = 0;
  double top_ = 0.0;  // m, of the bodies so far
  std::vector<Membrane> membranes_;
  std::vector<std::string> grains_;
  std::vector<std::string> planes_;
  std::vector<std::string> rigid_bodies_;
};

}  // namespace

SceneText random_scene(std::uint64_t seed, std::uint64_t number) {
  // Scenes of neighbouring seeds have nothing in common: the odd factor is that of splitmix64.
  return Maker(seed * 0x9e3779b97f4a7c15U + number * 0xbf58476d1ce4e5b9U + 1U).make();
}

}  // namespace plekton::stress
