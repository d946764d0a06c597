// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/ondem/read_ondem.hpp"

#include "dynamics/checkpoint/checkpoint_file.hpp"
#include "dynamics/hdf5/hdf5_reader.hpp"
#include "dynamics/hdf5/trial.hpp"
#include "geometry/base/printable.hpp"
#include "geometry/base/regular_file.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace plekton::dynamics {
namespace {

using geometry::Quat;
using geometry::Vec3;

/// Arrays of a group, of which each has to have as many rows as there are items.
class Rows {
 public:
  Rows(const Hdf5Reader& file, std::string group, std::size_t count)
      : file_(file), group_(std::move(group)), count_(count) {}

  bool has(const char* field) const { return file_.has(path(field)); }

  std::vector<double> numbers(const char* field, std::size_t columns = 1) const {
    return checked(field, file_.numbers(path(field)), columns);
  }
  std::vector<std::int64_t> whole_numbers(const char* field, std::size_t columns = 1) const {
    return checked(field, file_.whole_numbers(path(field)), columns);
  }
  std::vector<Vec3> vectors(const char* field) const {
    const std::vector<double> values = numbers(field, 3);
    std::vector<Vec3> result(count_);
    for (std::size_t i = 0; i < count_; ++i)
      result[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
    return result;
  }
  /// With the scalar first, as the draft has them, or last, where the set says so.
  std::vector<Quat> turns(const char* field) const {
    const std::vector<double> values = numbers(field, 4);
    const std::string order = file_.text_attribute(path(field), "order").value_or("wxyz");
    if (order != "wxyz" && order != "xyzw")
      file_.fail(path(field), "attribute order: got \"" + geometry::printable(order) +
                                  "\"; expected \"wxyz\" or \"xyzw\"");
    const std::size_t w = order == "wxyz" ? 0 : 3;
    const std::size_t x = order == "wxyz" ? 1 : 0;
    std::vector<Quat> result(count_);
    for (std::size_t i = 0; i < count_; ++i) {
      const double* const q = values.data() + 4 * i;
      result[i] = Quat(q[w], q[x], q[x + 1], q[x + 2]);
    }
    return result;
  }

  [[noreturn]] void fail(const char* field, const std::string& what) const {
    file_.fail(path(field), what);
  }

 private:
  std::string path(const char* field) const { return group_ + "/" + field; }

  template <class Number>
  std::vector<Number> checked(const char* field, Hdf5Array<Number> array,
                              std::size_t columns) const {
    if (array.values.size() != count_ * columns || (count_ > 0 && array.columns != columns))
      fail(field, "got " + std::to_string(array.rows()) + " rows of " +
                      std::to_string(array.columns) + "; expected " + std::to_string(count_) +
                      " of " + std::to_string(columns));
    return std::move(array.values);
  }

  const Hdf5Reader& file_;
  std::string group_;
  std::size_t count_;
};

/// A single number.
double number_in(const Hdf5Reader& file, const std::string& path) {
  const auto array = file.numbers(path);
  if (array.values.size() != 1)
    file.fail(path, "got " + std::to_string(array.values.size()) + " numbers; expected one");
  return array.values.front();
}
std::int64_t whole_number_in(const Hdf5Reader& file, const std::string& path) {
  const auto array = file.whole_numbers(path);
  if (array.values.size() != 1)
    file.fail(path, "got " + std::to_string(array.values.size()) + " numbers; expected one");
  return array.values.front();
}
std::string text_in(const Hdf5Reader& file, const std::string& path) {
  const auto texts = file.texts(path);
  if (texts.size() != 1)
    file.fail(path, "got " + std::to_string(texts.size()) + " texts; expected one");
  return texts.front();
}
Vec3 vector_in(const Hdf5Reader& file, const std::string& path) {
  const auto array = file.numbers(path);
  if (array.values.size() != 3)
    file.fail(path, "got " + std::to_string(array.values.size()) + " numbers; expected three");
  const Vec3 vector(array.values[0], array.values[1], array.values[2]);
  if (!vector.allFinite()) file.fail(path, "is not finite");
  return vector;
}

double finite_attribute(const Hdf5Reader& file, const std::string& path, const char* name,
                        double fallback) {
  const double value = file.number_attribute(path, name).value_or(fallback);
  if (!std::isfinite(value)) file.fail(path, std::string("attribute ") + name + ": is not finite");
  return value;
}

/// A reader of one file.
class Reader {
 public:
  explicit Reader(const Hdf5Reader& file) : file_(file) {}

  OndemScene read() {
    require_kind();
    read_scene();
    read_materials();
    for (std::size_t i = 0; i < scene_.blocks.size(); ++i) read_block(i);
    read_contacts();
    if (file_.has("/Plekton")) read_additions();
    return std::move(scene_);
  }

 private:
  void require_kind() const {
    if (!file_.has("/ONDEM/Scene"))
      file_.fail("/ONDEM/Scene",
                 "there is no such group; expected an ON-DEM file, as plekton export-ondem "
                 "writes it");
    if (!file_.has("/ONDEM/Scene/shape_names") && file_.has("/ONDEM/Bodies"))
      file_.fail("/ONDEM/Bodies",
                 "is of the draft before October 2026; write the file again with a later version "
                 "of the program that made it");
    const auto type = file_.text_attribute("/VTKHDF", "Type");
    if (type != "MultiBlockDataSet")
      file_.fail("/VTKHDF", "attribute Type: got \"" + geometry::printable(type.value_or("")) +
                                "\"; expected \"MultiBlockDataSet\"");
  }

  void read_scene() {
    const std::string group = "/ONDEM/Scene";
    scene_.time = finite_attribute(file_, group, "time", 0.0);
    scene_.time_step = finite_attribute(file_, group, "timestep", 0.0);
    scene_.iteration = static_cast<std::int64_t>(
        std::clamp(finite_attribute(file_, group, "iteration", 0.0), 0.0, 9e18));
    if (file_.has(group + "/gravity")) scene_.gravity = vector_in(file_, group + "/gravity");
    shapes_ = file_.texts(group + "/shape_names");
    scene_.blocks = file_.has(group + "/display_group_names")
                        ? file_.texts(group + "/display_group_names")
                        : std::vector<std::string>{"Points", "Others"};
  }

  void read_materials() {
    if (!file_.has("/ONDEM/Materials")) return;
    for (const std::string& name : file_.names_in("/ONDEM/Materials")) {
      const std::string group = "/ONDEM/Materials/" + name + "/";
      const auto number = [&](const char* field) {
        return file_.has(group + field) ? number_in(file_, group + field) : kNoNumber;
      };
      OndemMaterial material;
      material.id = whole_number_in(file_, group + "id");
      if (file_.has(group + "label")) material.label = text_in(file_, group + "label");
      material.density = number("density");
      material.normal_stiffness = number("normal_stiffness");
      material.shear_stiffness = number("shear_stiffness");
      material.shear_friction = number("shear_friction");
      material.poisson_ratio = number("plekton_poisson_ratio");
      scene_.materials.push_back(std::move(material));
    }
    // By name the tenth comes before the second.
    std::ranges::sort(scene_.materials, {}, &OndemMaterial::id);
  }

  OndemShape shape_of(std::int64_t type, const Rows& rows) const {
    if (type < 0 || static_cast<std::size_t>(type) >= shapes_.size())
      rows.fail("shape_type", "got " + std::to_string(type) + "; shape_names has " +
                                  std::to_string(shapes_.size()) + " names");
    const std::string& name = shapes_[static_cast<std::size_t>(type)];
    if (name == "sphere") return OndemShape::sphere;
    return name == "clump" ? OndemShape::clump : OndemShape::other;
  }

  void read_block(std::size_t block) {
    const std::string group = "/VTKHDF/" + scene_.blocks[block];
    const auto points = file_.numbers(group + "/Points");
    if (!points.values.empty() && points.columns != 3)
      file_.fail(group + "/Points",
                 "got rows of " + std::to_string(points.columns) + "; expected three coordinates");
    const std::size_t count = points.values.size() / 3;
    const Rows rows(file_, group + "/PointData", count);
    std::vector<OndemBody> bodies(count);
    for (std::size_t i = 0; i < count; ++i) {
      bodies[i].block = block;
      bodies[i].position = Vec3(points.values.data() + 3 * i);
      if (!bodies[i].position.allFinite()) file_.fail(group + "/Points", "is not finite");
    }
    read_identity(rows, bodies);
    read_motion(rows, bodies);
    read_mass(rows, bodies);
    for (const OndemBody& body : bodies) {
      if (!ids_.insert(body.id).second)
        rows.fail("body_id", "body " + std::to_string(body.id) + " is there twice");
    }
    scene_.bodies.insert(scene_.bodies.end(), bodies.begin(), bodies.end());
  }

  void read_identity(const Rows& rows, std::vector<OndemBody>& bodies) const {
    const auto ids = rows.whole_numbers("body_id");
    const auto types = rows.whole_numbers("shape_type");
    const auto fill = [&](const char* field, std::int64_t OndemBody::*which) {
      if (!rows.has(field)) return;
      const auto values = rows.whole_numbers(field);
      for (std::size_t i = 0; i < bodies.size(); ++i) bodies[i].*which = values[i];
    };
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      bodies[i].id = ids[i];
      bodies[i].shape = shape_of(types[i], rows);
    }
    fill("material_id", &OndemBody::material);
    fill("clump_id", &OndemBody::clump);
    fill("blocked_dofs", &OndemBody::blocked_dofs);
  }

  void read_motion(const Rows& rows, std::vector<OndemBody>& bodies) const {
    const auto fill = [&](const char* field, Vec3 OndemBody::*which) {
      if (!rows.has(field)) return;
      const auto values = rows.vectors(field);
      for (std::size_t i = 0; i < bodies.size(); ++i) {
        bodies[i].*which = values[i];
        if (!values[i].allFinite()) rows.fail(field, not_finite(bodies[i]));
      }
    };
    fill("velocity", &OndemBody::velocity);
    fill("angular_velocity", &OndemBody::angular_velocity);
    if (!rows.has("orientation")) return;
    const auto turns = rows.turns("orientation");
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      // Other programs let it drift off a unit by rounding, not by more.
      constexpr double kDrift = 1e-6;
      if (!(std::abs(turns[i].norm() - 1.0) <= kDrift))
        rows.fail("orientation",
                  "of body " + std::to_string(bodies[i].id) + " is no unit quaternion");
      bodies[i].orientation = turns[i];
    }
  }

  void read_mass(const Rows& rows, std::vector<OndemBody>& bodies) const {
    const auto fill = [&](const char* field, double OndemBody::*which) {
      if (!rows.has(field)) return;
      const auto values = rows.numbers(field);
      for (std::size_t i = 0; i < bodies.size(); ++i) bodies[i].*which = values[i];
    };
    fill("mass", &OndemBody::mass);
    fill("volume", &OndemBody::volume);
    fill("radius", &OndemBody::radius);
    for (const OndemBody& body : bodies) {
      if (body.shape == OndemShape::sphere && !(std::isfinite(body.radius) && body.radius > 0.0))
        rows.fail("radius", "of sphere " + std::to_string(body.id) + " is " +
                                std::to_string(body.radius) + "; expected a length above 0");
    }
    if (!rows.has("inertia")) return;
    const auto inertia = rows.numbers("inertia", 9);
    for (std::size_t i = 0; i < bodies.size(); ++i)
      bodies[i].moments = {inertia[9 * i], inertia[9 * i + 4], inertia[9 * i + 8]};
  }

  static std::string not_finite(const OndemBody& body) {
    return "of body " + std::to_string(body.id) + " is not finite";
  }

  void read_contacts() {
    if (!file_.has("/ONDEM/Interactions")) return;
    for (const std::string& name : file_.names_in("/ONDEM/Interactions"))
      read_contacts_of("/ONDEM/Interactions/" + name);
  }

  void read_contacts_of(const std::string& group) {
    if (!file_.has(group + "/id1")) return;
    const std::size_t count = file_.whole_numbers(group + "/id1").values.size();
    const Rows rows(file_, group, count);
    const auto id1 = rows.whole_numbers("id1");
    const auto id2 = rows.whole_numbers("id2");
    std::vector<OndemContact> contacts(count);
    for (std::size_t i = 0; i < count; ++i) {
      contacts[i].id1 = id1[i];
      contacts[i].id2 = id2[i];
      for (const std::int64_t id : {id1[i], id2[i]})
        if (!ids_.contains(id))
          file_.fail(group,
                     "a contact is with body " + std::to_string(id) + ", which is not there");
    }
    const auto fill = [&](const char* field, double OndemContact::*which) {
      if (!rows.has(field)) return;
      const auto values = rows.numbers(field);
      for (std::size_t i = 0; i < count; ++i) contacts[i].*which = values[i];
    };
    const auto fill_vectors = [&](const char* field, Vec3 OndemContact::*which) {
      if (!rows.has(field)) return;
      const auto values = rows.vectors(field);
      for (std::size_t i = 0; i < count; ++i) contacts[i].*which = values[i];
    };
    fill_vectors("normal", &OndemContact::normal);
    fill("normal_force", &OndemContact::normal_force);
    fill_vectors("shear_force", &OndemContact::shear_force);
    fill("kn", &OndemContact::normal_stiffness);
    fill("ks", &OndemContact::shear_stiffness);
    fill_vectors("contact_point", &OndemContact::point);
    fill("overlap", &OndemContact::overlap);
    scene_.contacts.insert(scene_.contacts.end(), contacts.begin(), contacts.end());
  }

  // What Plekton adds.

  void read_additions() {
    const double version = finite_attribute(file_, "/Plekton", "version", 0.0);
    if (version != static_cast<double>(kOndemAdditions))
      file_.fail("/Plekton", "attribute version: got " + std::to_string(version) + "; expected " +
                                 std::to_string(kOndemAdditions) +
                                 ": read it with the version of Plekton that wrote it");
    scene_.has_additions = true;
    scene_.writer = file_.text_attribute("/Plekton", "writer").value_or("");
    scene_.velocity_time = finite_attribute(file_, "/Plekton", "velocity_time", scene_.time);
    for (std::size_t i = 0; file_.has("/Plekton/Membranes/" + std::to_string(i)); ++i)
      scene_.membranes.push_back(membrane_in("/Plekton/Membranes/" + std::to_string(i)));
    for (std::size_t i = 0; file_.has("/Plekton/Planes/" + std::to_string(i)); ++i)
      scene_.planes.push_back(plane_in("/Plekton/Planes/" + std::to_string(i) + "/"));
    if (file_.has("/Plekton/State")) read_state();
  }

  OndemPlane plane_in(const std::string& group) const {
    return {text_in(file_, group + "name"),
            vector_in(file_, group + "point"),
            vector_in(file_, group + "normal"),
            vector_in(file_, group + "velocity"),
            whole_number_in(file_, group + "material_id"),
            file_.has(group + "radius") ? number_in(file_, group + "radius") : 0.0,
            file_.has(group + "angular_velocity") ? vector_in(file_, group + "angular_velocity")
                                                  : Vec3(Vec3::Zero())};
  }

  OndemMembrane membrane_in(const std::string& group) const {
    OndemMembrane membrane;
    membrane.name = text_in(file_, group + "/name");
    membrane.material = whole_number_in(file_, group + "/material_id");
    membrane.first_node = whole_number_in(file_, group + "/first_node");
    membrane.is_rigid = whole_number_in(file_, group + "/is_rigid") != 0;
    const Rows nodes(file_, group, file_.numbers(group + "/position").rows());
    const auto finite = [&](const char* field) {
      std::vector<Vec3> vectors = nodes.vectors(field);
      for (const Vec3& vector : vectors)
        if (!vector.allFinite()) nodes.fail(field, "is not finite");
      return vectors;
    };
    membrane.position = finite("position");
    membrane.velocity = finite("velocity");
    membrane.angular_velocity = finite("angular_velocity");
    membrane.orientation = nodes.turns("orientation");
    membrane.mass = nodes.numbers("mass");
    membrane.blocked_dofs = nodes.whole_numbers("blocked_dofs");
    membrane.facets = elements_in<3>(group, "facets", membrane.position.size());
    membrane.cylinders = elements_in<2>(group, "cylinders", membrane.position.size());
    membrane.facet_radius = Rows(file_, group, membrane.facets.size()).numbers("facet_radius");
    membrane.cylinder_radius =
        Rows(file_, group, membrane.cylinders.size()).numbers("cylinder_radius");
    return membrane;
  }

  template <std::size_t size>
  std::vector<std::array<std::int64_t, size>> elements_in(const std::string& group,
                                                          const char* field,
                                                          std::size_t nodes) const {
    const std::size_t count = file_.whole_numbers(group + "/" + field).values.size() / size;
    const Rows rows(file_, group, count);
    const auto values = rows.whole_numbers(field, size);
    std::vector<std::array<std::int64_t, size>> elements(count);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i] < 0 || static_cast<std::size_t>(values[i]) >= nodes)
        rows.fail(field,
                  "got node " + std::to_string(values[i]) + "; there are " + std::to_string(nodes));
      elements[i / size][i % size] = values[i];
    }
    return elements;
  }

  /// Of another version of checkpoints it is of no use to anybody here.
  void read_state() {
    const double version = finite_attribute(file_, "/Plekton/State", "version", 0.0);
    if (version != static_cast<double>(kCheckpointVersion)) return;
    add_arrays("");
  }

  /// @param group  below /Plekton/State, with a slash at its end
  void add_arrays(const std::string& group) {
    constexpr int kMostGroups = 2000;  // a group may say that it holds itself
    const std::string whole = "/Plekton/State/" + group;
    if (++groups_ > kMostGroups || whole.size() > std::size_t{kMostGroups})
      file_.fail(whole, "groups have no end; the file is damaged");
    for (const std::string& name : file_.names_in(whole.substr(0, whole.size() - 1))) {
      if (file_.is_group(whole + name))
        add_arrays(group + name + "/");
      else
        scene_.state.arrays[group + name] = file_.array(whole + name);
    }
  }

  const Hdf5Reader& file_;
  OndemScene scene_;
  std::vector<std::string> shapes_;
  std::set<std::int64_t> ids_;
  int groups_ = 0;  ///< of the state
};

}  // namespace

OndemScene read_ondem(const std::filesystem::path& file) {
  try {
    return parse_ondem(geometry::read_regular_file(file, "an ON-DEM file (.vtkhdf)"), file);
  } catch (const geometry::UnreadableFile& error) {
    throw OndemError(error.what());
  }
}

OndemScene parse_ondem(std::string bytes, const std::filesystem::path& name) {
  constexpr unsigned kLongest = 600;  // s, for a file as large as a disk has them
  const auto read = [&] {
    const Hdf5Reader file(bytes, name);
    Reader(file).read();
  };
  const hdf5::Trial trial = hdf5::try_out(read, kLongest);
  if (trial.error) throw OndemError(*trial.error);
  if (trial.was_killed)
    throw OndemError(geometry::printable(name.string()) +
                     ": is damaged, the HDF5 library fails on it; take another copy of it, or "
                     "write it again");
  try {
    const Hdf5Reader file(std::move(bytes), name);
    return Reader(file).read();
  } catch (const Hdf5Error& error) {
    throw OndemError(error.what());
  }
}

}  // namespace plekton::dynamics
