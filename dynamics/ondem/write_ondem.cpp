// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/ondem/write_ondem.hpp"

#include "dynamics/checkpoint/checkpoint_file.hpp"
#include "dynamics/hdf5/hdf5_writer.hpp"
#include "dynamics/output/file.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <stdexcept>

namespace plekton::dynamics {
namespace {

using geometry::Quat;
using geometry::Vec3;

constexpr std::array<std::int64_t, 2> kVtkVersion{2, 5};

/// Blocks that are not bodies of the draft; no display group may have such a name.
constexpr std::string_view kContactsBlock = "contacts";
constexpr std::string_view kMembraneBlock = "membrane_";

void append(const Vec3& vector, std::vector<double>& values) {
  values.insert(values.end(), vector.data(), vector.data() + 3);
}

void append(const std::array<double, 4>& turn, std::vector<double>& values) {
  values.insert(values.end(), turn.begin(), turn.end());
}

std::array<double, 4> scalar_first(const Quat& q) {
  return {q.w(), q.x(), q.y(), q.z()};
}

/// Numbers of each item of a list, one after the other.
template <class Items, class Value>
std::vector<double> vectors_of(const Items& items, Value value) {
  std::vector<double> values;
  for (const auto& item : items) append(value(item), values);
  return values;
}
template <class Items, class Value>
std::vector<double> numbers_of(const Items& items, Value value) {
  std::vector<double> values;
  for (const auto& item : items) values.push_back(value(item));
  return values;
}
template <class Items, class Value>
std::vector<std::int64_t> whole_numbers_of(const Items& items, Value value) {
  std::vector<std::int64_t> values;
  for (const auto& item : items) values.push_back(static_cast<std::int64_t>(value(item)));
  return values;
}
template <std::size_t size>
std::vector<std::int64_t> flat(const std::vector<std::array<std::int64_t, size>>& rows) {
  std::vector<std::int64_t> values;
  for (const auto& row : rows) values.insert(values.end(), row.begin(), row.end());
  return values;
}

void mark(Hdf5Writer& file, const std::string& group, const char* type) {
  file.attribute(group, "Type", std::string(type));
  file.attribute(group, "Version", kVtkVersion);
}

/// Cells of a block: `size` points each.
void write_cells(Hdf5Writer& file, const std::string& group, std::size_t size,
                 std::span<const std::int64_t> points) {
  const std::size_t cells = points.size() / size;
  std::vector<std::int64_t> offsets(cells + 1);
  for (std::size_t i = 0; i <= cells; ++i) offsets[i] = static_cast<std::int64_t>(i * size);
  const std::array<std::int64_t, 1> cell_count{static_cast<std::int64_t>(cells)};
  const std::array<std::int64_t, 1> point_count{static_cast<std::int64_t>(points.size())};
  file.numbers(group + "/NumberOfCells", cell_count);
  file.numbers(group + "/NumberOfConnectivityIds", point_count);
  file.numbers(group + "/Offsets", offsets);
  file.numbers(group + "/Connectivity", points);
}

/// What a block shows: points, and cells over them.
struct BlockCells {
  std::vector<std::int64_t> vertices, lines, triangles;
};

/// A block of VTK without its arrays. @returns its group
std::string write_block(Hdf5Writer& file, const std::string& name, std::span<const double> points,
                        const BlockCells& cells) {
  std::string block = "/VTKHDF/" + name;
  file.group(block);
  mark(file, block, "PolyData");
  const std::array<std::int64_t, 1> count{static_cast<std::int64_t>(points.size() / 3)};
  file.numbers(block + "/NumberOfPoints", count);
  file.numbers(block + "/Points", points, 3);
  write_cells(file, block + "/Vertices", 1, cells.vertices);
  write_cells(file, block + "/Lines", 2, cells.lines);
  write_cells(file, block + "/Polygons", 3, cells.triangles);
  write_cells(file, block + "/Strips", 1, {});
  return block;
}

std::vector<std::int64_t> counted(std::size_t count) {
  std::vector<std::int64_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

/// All arrays of the bodies of a block: every block has the same ones.
void write_bodies(Hdf5Writer& file, const std::string& name,
                  const std::vector<const OndemBody*>& bodies) {
  using Body = const OndemBody*;
  const auto points = vectors_of(bodies, [](Body b) { return b->position; });
  const std::string data =
      write_block(file, name, points, {counted(bodies.size()), {}, {}}) + "/PointData/";
  const auto whole = [&](const char* field, auto value) {
    file.numbers(data + field, whole_numbers_of(bodies, value));
  };
  const auto number = [&](const char* field, auto value) {
    file.numbers(data + field, numbers_of(bodies, value));
  };
  const auto vector = [&](const char* field, auto value) {
    file.numbers(data + field, vectors_of(bodies, value), 3);
  };
  whole("body_id", [](Body b) { return b->id; });
  whole("shape_type", [](Body b) { return b->shape; });
  whole("material_id", [](Body b) { return b->material; });
  whole("clump_id", [](Body b) { return b->clump; });
  vector("velocity", [](Body b) { return b->velocity; });
  vector("angular_velocity", [](Body b) { return b->angular_velocity; });
  file.numbers(data + "orientation",
               vectors_of(bodies, [](Body b) { return scalar_first(b->orientation); }), 4);
  file.attribute(data + "orientation", "order", std::string("wxyz"));
  number("mass", [](Body b) { return b->mass; });
  number("volume", [](Body b) { return b->volume; });
  std::vector<double> inertia;
  for (Body b : bodies) {
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        inertia.push_back(row == column || std::isnan(b->moments[row]) ? b->moments[row] : 0.0);
  }
  file.numbers(data + "inertia", inertia, 9);
  whole("blocked_dofs", [](Body b) { return b->blocked_dofs; });
  vector("clump_relative_position", [](Body b) { return b->place_in_clump; });
  file.numbers(data + "clump_relative_orientation",
               vectors_of(bodies, [](Body b) { return b->turn_in_clump; }), 4);
  file.attribute(data + "clump_relative_orientation", "order", std::string("wxyz"));
  number("radius", [](Body b) { return b->radius; });
}

void write_membrane_block(Hdf5Writer& file, const std::string& name,
                          const OndemMembrane& membrane) {
  const auto points = vectors_of(membrane.position, [](const Vec3& x) { return x; });
  const std::string data =
      write_block(file, name, points, {{}, flat(membrane.cylinders), flat(membrane.facets)});
  const auto velocity = vectors_of(membrane.velocity, [](const Vec3& v) { return v; });
  file.numbers(data + "/PointData/velocity", velocity, 3);
  // Lines come before polygons.
  std::vector<double> radius = membrane.cylinder_radius;
  radius.insert(radius.end(), membrane.facet_radius.begin(), membrane.facet_radius.end());
  file.numbers(data + "/CellData/radius", radius);
}

void write_contact_block(Hdf5Writer& file, const std::string& name, const OndemScene& scene) {
  std::vector<double> points;
  for (const auto& [a, b] : scene.contact_lines) {
    append(a, points);
    append(b, points);
  }
  const std::string data =
      write_block(file, name, points, {{}, counted(2 * scene.contact_lines.size()), {}});
  file.group(data + "/CellData");
  // The numbers lie in the group of Plekton; here are second names of them.
  for (const OndemField& field : scene.contact_fields)
    file.same_as(data + "/CellData/" + field.name, "/Plekton/Contacts/" + field.name);
}

void require_names(const std::vector<std::string>& names) {
  std::vector<std::string> sorted = names;
  std::sort(sorted.begin(), sorted.end());
  const bool has_twice = std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
  const bool is_wrong = std::any_of(names.begin(), names.end(), [](const std::string& name) {
    return name.empty() || name == "Assembly" || name.find('/') != std::string::npos ||
           name.front() == '.';
  });
  if (has_twice || is_wrong)
    throw std::invalid_argument("blocks of a VTKHDF file need names of their own, without a slash");
}

void write_vtk(Hdf5Writer& file, const OndemScene& scene) {
  file.group("/VTKHDF");
  mark(file, "/VTKHDF", "MultiBlockDataSet");
  std::vector<std::string> names = scene.blocks;
  if (scene.has_additions) {
    for (std::size_t i = 0; i < scene.membranes.size(); ++i)
      names.push_back(std::string(kMembraneBlock) + std::to_string(i));
    names.emplace_back(kContactsBlock);
  }
  require_names(names);
  std::vector<std::vector<const OndemBody*>> bodies(scene.blocks.size());
  for (const OndemBody& body : scene.bodies) bodies.at(body.block).push_back(&body);
  for (std::size_t i = 0; i < bodies.size(); ++i) write_bodies(file, names[i], bodies[i]);
  if (scene.has_additions) {
    for (std::size_t i = 0; i < scene.membranes.size(); ++i)
      write_membrane_block(file, names[bodies.size() + i], scene.membranes[i]);
    write_contact_block(file, names.back(), scene);
  }
  file.group("/VTKHDF/Assembly");
  for (const std::string& name : names)
    file.soft_link("/VTKHDF/Assembly/" + name, "/VTKHDF/" + name);
}

void write_scene(Hdf5Writer& file, const OndemScene& scene) {
  const std::string group = "/ONDEM/Scene";
  file.group(group);
  file.attribute(group, "time", scene.time);
  file.attribute(group, "timestep", scene.time_step);
  file.attribute(group, "iteration", scene.iteration);
  file.numbers(group + "/gravity", std::span<const double>(scene.gravity.data(), 3));
  file.text(group + "/units", "SI");
  file.texts(group + "/display_group_names", scene.blocks);
  file.texts(group + "/shape_names", {"sphere", "clump", "other"});
}

void write_materials(Hdf5Writer& file, const OndemScene& scene) {
  file.group("/ONDEM/Materials");
  for (const OndemMaterial& material : scene.materials) {
    const std::string group = "/ONDEM/Materials/" + std::to_string(material.id);
    file.group(group);
    file.attribute(group, "schema_classes", std::string("linear_elastic_frictional_3D"));
    file.attribute(group, "provisional", std::int64_t{1});
    file.number(group + "/id", material.id);
    file.number(group + "/density", material.density);
    file.number(group + "/normal_stiffness", material.normal_stiffness);
    file.number(group + "/shear_stiffness", material.shear_stiffness);
    file.number(group + "/shear_friction", material.shear_friction);
    file.number(group + "/shear_damping", 0.0);
    file.text(group + "/label", material.label);
    file.number(group + "/plekton_poisson_ratio", material.poisson_ratio);
  }
}

void write_contacts(Hdf5Writer& file, const OndemScene& scene) {
  using Contact = OndemContact;
  const std::string group = "/ONDEM/Interactions/sphere_sphere";
  const auto& contacts = scene.contacts;
  file.group(group);
  file.attribute(group, "count", static_cast<std::int64_t>(contacts.size()));
  const auto number = [&](const char* field, double Contact::*which) {
    file.numbers(group + field, numbers_of(contacts, [&](const Contact& c) { return c.*which; }));
  };
  const auto vector = [&](const char* field, Vec3 Contact::*which) {
    file.numbers(group + field, vectors_of(contacts, [&](const Contact& c) { return c.*which; }),
                 3);
  };
  file.numbers(group + "/id1", whole_numbers_of(contacts, [](const Contact& c) { return c.id1; }));
  file.numbers(group + "/id2", whole_numbers_of(contacts, [](const Contact& c) { return c.id2; }));
  vector("/normal", &Contact::normal);
  number("/normal_force", &Contact::normal_force);
  vector("/shear_force", &Contact::shear_force);
  number("/kn", &Contact::normal_stiffness);
  number("/ks", &Contact::shear_stiffness);
  vector("/contact_point", &Contact::point);
  number("/overlap", &Contact::overlap);
}

void write_membrane(Hdf5Writer& file, const std::string& group, const OndemMembrane& membrane) {
  const auto same = [](const Vec3& v) { return v; };
  file.group(group);
  file.text(group + "/name", membrane.name);
  file.number(group + "/material_id", membrane.material);
  file.number(group + "/first_node", membrane.first_node);
  file.number(group + "/is_rigid", std::int64_t{membrane.is_rigid});
  file.numbers(group + "/position", vectors_of(membrane.position, same), 3);
  file.numbers(group + "/velocity", vectors_of(membrane.velocity, same), 3);
  file.numbers(group + "/angular_velocity", vectors_of(membrane.angular_velocity, same), 3);
  file.numbers(group + "/orientation", vectors_of(membrane.orientation, scalar_first), 4);
  file.attribute(group + "/orientation", "order", std::string("wxyz"));
  file.numbers(group + "/mass", membrane.mass);
  file.numbers(group + "/blocked_dofs", membrane.blocked_dofs);
  file.numbers(group + "/facets", flat(membrane.facets), 3);
  file.numbers(group + "/facet_radius", membrane.facet_radius);
  file.numbers(group + "/cylinders", flat(membrane.cylinders), 2);
  file.numbers(group + "/cylinder_radius", membrane.cylinder_radius);
}

void write_additions(Hdf5Writer& file, const OndemScene& scene) {
  file.group("/Plekton");
  file.attribute("/Plekton", "version", kOndemAdditions);
  file.attribute("/Plekton", "writer", scene.writer);
  file.attribute("/Plekton", "draft", std::string(kOndemDraft));
  file.attribute("/Plekton", "velocity_time", scene.velocity_time);
  file.group("/Plekton/Membranes");
  for (std::size_t i = 0; i < scene.membranes.size(); ++i)
    write_membrane(file, "/Plekton/Membranes/" + std::to_string(i), scene.membranes[i]);
  file.group("/Plekton/Planes");
  for (std::size_t i = 0; i < scene.planes.size(); ++i) {
    const OndemPlane& plane = scene.planes[i];
    const std::string group = "/Plekton/Planes/" + std::to_string(i);
    file.group(group);
    file.text(group + "/name", plane.name);
    file.number(group + "/material_id", plane.material);
    file.numbers(group + "/point", std::span<const double>(plane.point.data(), 3));
    file.numbers(group + "/normal", std::span<const double>(plane.normal.data(), 3));
    file.numbers(group + "/velocity", std::span<const double>(plane.velocity.data(), 3));
    file.number(group + "/radius", plane.radius);
    file.numbers(group + "/angular_velocity",
                 std::span<const double>(plane.angular_velocity.data(), 3));
  }
  file.group("/Plekton/Contacts");
  for (const OndemField& field : scene.contact_fields) {
    const std::string path = "/Plekton/Contacts/" + field.name;
    const std::size_t columns = field.numbers.columns > 1 ? field.numbers.columns : 0;
    if (const auto* const whole = std::get_if<std::vector<std::int64_t>>(&field.numbers.numbers))
      file.numbers(path, *whole, columns);
    else
      file.numbers(path, std::get<std::vector<double>>(field.numbers.numbers), columns);
    file.attribute(path, "unit", field.unit.empty() ? std::string("1") : field.unit);
  }
  file.group("/Plekton/State");
  file.attribute("/Plekton/State", "version", std::int64_t{kCheckpointVersion});
  for (const auto& [name, array] : scene.state.arrays) file.array("/Plekton/State/" + name, array);
}

}  // namespace

std::string ondem_file_of(const OndemScene& scene) {
  Hdf5Writer file;
  if (scene.has_additions) write_additions(file, scene);
  write_vtk(file, scene);
  write_scene(file, scene);
  write_materials(file, scene);
  write_contacts(file, scene);
  return file.bytes();
}

void write_ondem(const std::filesystem::path& path, const OndemScene& scene) {
  const std::string bytes = ondem_file_of(scene);
  OutputFile out(path);
  out.write(bytes);
  out.commit();
}

}  // namespace plekton::dynamics
