// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/scene_check.hpp"

#include "dynamics/loads/loads_check.hpp"
#include "dynamics/model/rigid_check.hpp"
#include "dynamics/model/scene.hpp"
#include "dynamics/model/shape_check.hpp"
#include "dynamics/ties/ties_check.hpp"
#include "geometry/base/problems.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace plekton::dynamics {
namespace {

using contact::MaterialId;

/// Collects the problems of a scene one by one.
class SceneProblems {
 public:
  explicit SceneProblems(const Scene& scene) : scene_(scene) {}

  void list_all() {
    if (!list_lengths()) return;  // the rest would read beyond the ends
    list_nodes();
    list_spheres();
    for (std::size_t i = 0; i < scene_.bonds.size(); ++i) {
      list_problems(scene_.bonds[i], scene_.state.size(), "bond " + std::to_string(i), text_);
    }
    list_problems(scene_.bond_laws, scene_.bonds, text_);
    for (std::size_t i = 0; i < scene_.sheet_facets.size(); ++i) {
      list_problems(scene_.sheet_facets[i], scene_.state.size(), "sheet facet " + std::to_string(i),
                    text_);
    }
    list_materials();
    list_planes();
    list_structures();
    list_shape_problems(scene_, text_);
    list_rigid_problems(scene_, text_);
    list_tie_problems(scene_, text_);
    list_load_problems(scene_, text_);
  }

  void throw_if_any() const { geometry::throw_if_any(text_); }

 private:
  std::ostream& line(std::string_view kind, std::size_t id) {
    return text_ << kind << ' ' << id << ": ";
  }

  void expect_length(std::string_view what, std::size_t length, std::size_t expected) {
    if (length == expected) return;
    text_ << what << " has " << length << " entries instead of " << expected << '\n';
  }

  /// @returns whether all arrays are as long as they have to be
  bool list_lengths() {
    const NodeState& state = scene_.state;
    const std::size_t nodes = state.size();
    expect_length("state.velocity", state.velocity.size(), nodes);
    expect_length("state.angular_velocity", state.angular_velocity.size(), nodes);
    expect_length("state.orientation", state.orientation.size(), nodes);
    expect_length("properties.mass", scene_.properties.mass.size(), nodes);
    expect_length("properties.inertia", scene_.properties.inertia.size(), nodes);
    expect_length("properties.held", scene_.properties.held.size(), nodes);
    const geometry::Elements& elements = scene_.elements;
    expect_length("sphere_materials", scene_.sphere_materials.size(), elements.spheres.size());
    expect_length("cylinder_materials", scene_.cylinder_materials.size(),
                  elements.cylinders.size());
    expect_length("facet_materials", scene_.facet_materials.size(), elements.facets.size());
    if (!scene_.is_absent.empty()) expect_length("is_absent", scene_.is_absent.size(), nodes);
    return text_.view().empty();
  }

  void list_nodes() {
    constexpr double kTolerance = 1e-9;  // far above rounding, far below any real mistake
    const std::vector<Held> all_held =
        held_with_motions(scene_.properties.held, scene_.loads.motions);
    for (std::size_t i = 0; i < scene_.state.size(); ++i) {
      expect_finite("node", i, "position", scene_.state.position[i]);
      expect_finite("node", i, "velocity", scene_.state.velocity[i]);
      expect_finite("node", i, "angular velocity", scene_.state.angular_velocity[i]);
      if (!(std::abs(scene_.state.orientation[i].squaredNorm() - 1.0) < kTolerance)) {
        line("node", i) << "its orientation is not a unit quaternion; normalise it\n";
      }
      const Held held = all_held[i];
      if (is_reference(held)) continue;  // rigid_check.hpp
      expect_inertia(i, "mass", scene_.properties.mass[i], holds_translation(held));
      expect_inertia(i, "moment of inertia", scene_.properties.inertia[i], holds_rotation(held));
    }
  }

  void expect_finite(std::string_view kind, std::size_t id, std::string_view what,
                     const Vec3& value) {
    if (value.allFinite()) return;
    line(kind, id) << "its " << what << " (" << value.transpose() << ") is not finite\n";
  }

  void expect_inertia(std::size_t node, std::string_view what, double value, bool is_held) {
    if (is_held ? std::isfinite(value) && value >= 0.0 : std::isfinite(value) && value > 0.0)
      return;
    line("node", node) << "its " << what << " is " << value;
    text_ << (is_held ? "; it must be finite and not negative\n"
                      : "; attach something that has mass to it, or hold it\n");
  }

  void list_spheres() {
    for (std::size_t i = 0; i < scene_.elements.spheres.size(); ++i) {
      const geometry::Sphere& sphere = scene_.elements.spheres[i];
      const auto node = static_cast<std::int32_t>(sphere.nodes[0]);
      if (node < 0 || index_of(sphere.nodes[0]) >= scene_.state.size()) {
        line("sphere", i) << "there is no node " << node << ", only " << scene_.state.size()
                          << " nodes\n";
      }
      expect_positive("sphere", i, "radius", sphere.radius);
      expect_material("sphere", i, scene_.sphere_materials[i]);
    }
  }

  void expect_positive(std::string_view kind, std::size_t id, std::string_view what, double value) {
    if (value > 0.0 && std::isfinite(value)) return;
    line(kind, id) << "its " << what << " is " << value << "; it must be positive and finite\n";
  }

  void expect_material(std::string_view kind, std::size_t id, MaterialId material) {
    const auto index = static_cast<std::int32_t>(material);
    if (index >= 0 && static_cast<std::size_t>(index) < scene_.materials.size()) return;
    line(kind, id) << "there is no material " << index << ", only " << scene_.materials.size()
                   << " materials\n";
  }

  void list_materials() {
    for (std::size_t i = 0; i < scene_.materials.size(); ++i) {
      const contact::Material& material = scene_.materials[i];
      expect_positive("material", i, "Young's modulus", material.young_modulus);
      expect_not_negative(i, "stiffness ratio", material.stiffness_ratio);
      expect_not_negative(i, "friction coefficient", material.friction);
      expect_poisson_ratio(i, material.poisson_ratio);
    }
  }

  void expect_not_negative(std::size_t material, std::string_view what, double value) {
    if (value >= 0.0 && std::isfinite(value)) return;
    line("material", material) << "its " << what << " is " << value
                               << "; it must be zero or positive, and finite\n";
  }

  void expect_poisson_ratio(std::size_t material, double ratio) {
    if (ratio > -1.0 && ratio <= 0.5) return;
    line("material", material) << "its Poisson's ratio is " << ratio
                               << "; it must be above -1 and at most 0.5\n";
  }

  void expect_unit(std::string_view kind, std::size_t id, std::string_view what,
                   const Vec3& vector) {
    constexpr double kTolerance = 1e-9;
    if (std::abs(vector.squaredNorm() - 1.0) < kTolerance) return;
    line(kind, id) << "its " << what << " (" << vector.transpose()
                   << ") is not a unit vector; normalise it\n";
  }

  void expect_turning_in_itself(std::size_t id, const contact::Plane& plane) {
    constexpr double kTolerance = 1e-9;  // of unit vectors
    if (plane.form != contact::Plane::Form::flat || !plane.turns()) return;
    if (plane.axis.cross(plane.normal).norm() < kTolerance) return;
    line("plane", id) << "it is flat and turns about (" << plane.axis.transpose()
                      << "), which is not along its normal (" << plane.normal.transpose()
                      << "); it turns in its own plane alone\n";
  }

  void list_planes() {
    for (std::size_t i = 0; i < scene_.planes.size(); ++i) {
      const contact::Plane& plane = scene_.planes[i];
      expect_finite("plane", i, "point", plane.point);
      expect_finite("plane", i, "velocity", plane.velocity);
      expect_material("plane", i, plane.material);
      if (plane.form == contact::Plane::Form::flat) {
        expect_unit("plane", i, "normal", plane.normal);
      } else if (!(plane.radius > 0.0 && std::isfinite(plane.radius))) {
        line("plane", i) << "the radius of its cylinder or ball is " << plane.radius
                         << "; it must be positive and finite\n";
      }
      if (plane.form == contact::Plane::Form::cylinder || plane.turns())
        expect_unit("plane", i, "axis", plane.axis);
      if (!std::isfinite(plane.angular_velocity))
        line("plane", i) << "its angular velocity is " << plane.angular_velocity
                         << "; it must be finite\n";
      if (!std::isfinite(plane.widening))
        line("plane", i) << "its widening is " << plane.widening << " m/s; it must be finite\n";
      if (plane.form == contact::Plane::Form::flat && plane.widening != 0.0)
        line("plane", i) << "it is flat and gets wider by " << plane.widening
                         << " m/s; only a cylinder or a ball does\n";
      expect_turning_in_itself(i, plane);
    }
  }

  /// A surface may be without thickness, but nothing that is in contact; other radii are the
  /// surface's affair.
  void expect_thickness(std::string_view kind, std::size_t id, double radius) {
    if (radius == 0.0) line(kind, id) << "its radius is 0; what is in contact needs a thickness\n";
  }

  /// Facets and cylinders, and the one material of each connected structure.
  void list_structures() {
    const geometry::Elements& elements = scene_.elements;
    for (std::size_t i = 0; i < elements.cylinders.size(); ++i) {
      expect_thickness("cylinder", i, elements.cylinders[i].radius);
      expect_material("cylinder", i, scene_.cylinder_materials[i]);
    }
    for (std::size_t i = 0; i < elements.facets.size(); ++i) {
      expect_thickness("facet", i, elements.facets[i].radius);
      expect_material("facet", i, scene_.facet_materials[i]);
    }
    try {
      const geometry::Surface surface(elements.cylinders, elements.facets, scene_.state.size());
      std::vector<MaterialId> materials(surface.structure_count(), kNone);
      compare_materials("facet", elements.facets, scene_.facet_materials, surface, materials);
      compare_materials("cylinder", elements.cylinders, scene_.cylinder_materials, surface,
                        materials);
    } catch (const std::invalid_argument& problems) {
      text_ << problems.what() << '\n';
    }
  }

  template <class Element>
  void compare_materials(std::string_view kind, const std::vector<Element>& elements,
                         const std::vector<MaterialId>& own, const geometry::Surface& surface,
                         std::vector<MaterialId>& of_structures) {
    for (std::size_t i = 0; i < elements.size(); ++i) {
      MaterialId& common = of_structures[index_of(surface.structure_of(elements[i].nodes[0]))];
      if (common == kNone) common = own[i];
      if (common == own[i]) continue;
      line(kind, i) << "it has material " << static_cast<std::int32_t>(own[i])
                    << ", but it is connected to elements of material "
                    << static_cast<std::int32_t>(common)
                    << "; a connected structure needs one material\n";
    }
  }

  static constexpr MaterialId kNone{-1};

  const Scene& scene_;
  std::ostringstream text_;
};

}  // namespace

void check(const Scene& scene) {
  SceneProblems problems(scene);
  problems.list_all();
  problems.throw_if_any();
}

}  // namespace plekton::dynamics
