// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/python/arrays.hpp"
#include "apps/python/from_python.hpp"
#include "apps/python/session.hpp"
#include "apps/run/body_tables.hpp"
#include "apps/run/reactions.hpp"
#include "apps/scenario/closest_word.hpp"
#include "apps/scenario/scenario_reader.hpp"
#include "dynamics/checkpoint/checkpoint_file.hpp"
#include "dynamics/output/contact_fields.hpp"
#include "dynamics/state_hash.hpp"
#include "dynamics/structure/beam_bonds.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstddef>
#include <cstring>
#include <string_view>
#include <variant>

namespace plekton::python {
namespace {

namespace fs = std::filesystem;
using apps::InputError;
using dynamics::NodeState;

// What a scenario or a checkpoint becomes.

std::unique_ptr<Session> load(const py::object& scenario, const py::iterable& overrides,
                              const std::optional<fs::path>& folder) {
  return std::make_unique<Session>(scenario_of(scenario, overrides, folder));
}

std::unique_ptr<Session> resume(const fs::path& path, const py::iterable& overrides) {
  const auto all = overrides_of(overrides);
  if (fs::is_directory(path))
    return std::make_unique<Session>(resumed_run({.folder = path, .overrides = all}), path);
  apps::FoundCheckpoint checkpoint{path, dynamics::read_checkpoint(path), {}};
  return std::make_unique<Session>(apps::resumed_from(std::move(checkpoint), all), std::nullopt);
}

// Moving it.

/// @returns what run.json says, if results are written
py::object run(const py::object& self, const py::object& until, const py::object& every,
               const std::optional<fs::path>& out, bool overwrite) {
  auto& session = self.cast<Session&>();
  const double end =
      until.is_none() ? session.scenario().simulation.duration : seconds_of(until, "until");
  Attendant attendant(self, every);
  std::optional<apps::RunReport> report;
  if (out)
    report = session.run_into(*out, end, overwrite, attendant);
  else
    session.run(end, attendant);
  attendant.throw_if_any();
  if (!report) return py::none();
  return py::module_::import("json").attr("loads")(apps::to_json(*report));
}

void step(const py::object& self, std::int64_t count) {
  if (count < 0) throw InputError(fmt::format("step: got {}; expected 0 or more", count));
  Attendant attendant(self, py::none());
  self.cast<Session&>().step(count, attendant);
  attendant.throw_if_any();
}

// Views. What they show is where it is as long as the simulation lives: nodes and spheres are never
// added or taken away, whatever breaks.

py::capsule keeper_of(const Session& session) {
  return py::capsule(new std::shared_ptr<apps::PreparedRun>(session.prepared()), [](void* kept) {
    delete static_cast<std::shared_ptr<apps::PreparedRun>*>(kept);
  });
}

/// @param first  of the numbers, `columns` side by side of each of `rows`, that are
///         `stride` bytes apart
template <class Number>
py::array view(const Session& session, const Number* first, std::size_t rows, std::size_t columns,
               std::size_t stride) {
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(rows)};
  std::vector<py::ssize_t> strides{static_cast<py::ssize_t>(stride)};
  if (columns > 1) {
    shape.push_back(static_cast<py::ssize_t>(columns));
    strides.push_back(static_cast<py::ssize_t>(sizeof(Number)));
  }
  py::array result =
      rows > 0 ? py::array(py::dtype::of<Number>(), shape, strides, first, keeper_of(session))
               : py::array(py::dtype::of<Number>(), shape);
  result.attr("flags").attr("writeable") = false;
  return result;
}

py::array view(const Session& session, const std::vector<Vec3>& vectors) {
  return view(session, reinterpret_cast<const double*>(vectors.data()), vectors.size(), 3,
              sizeof(Vec3));
}

py::array view(const Session& session, const std::vector<double>& numbers) {
  return view(session, numbers.data(), numbers.size(), 1, sizeof(double));
}

py::array orientations(const Session& session) {
  const auto& all = session.simulation().state().orientation;
  return view(session, reinterpret_cast<const double*>(all.data()), all.size(), 4,
              sizeof(geometry::Quat));
}

py::array radii(const Session& session) {
  const auto& spheres = session.simulation().elements().spheres;
  return view(session, spheres.empty() ? nullptr : &spheres.front().radius, spheres.size(), 1,
              sizeof(geometry::Sphere));
}

py::array sphere_nodes(const Session& session) {
  const auto& spheres = session.simulation().elements().spheres;
  const void* nodes = spheres.empty() ? nullptr : spheres.front().nodes.data();
  return view(session, static_cast<const std::int32_t*>(nodes), spheres.size(), 1,
              sizeof(geometry::Sphere));
}

// What may become less as things break is copied.

template <class Element>
auto nodes_of_elements(const std::vector<Element>& elements) {
  std::vector<decltype(Element::nodes)> nodes;
  for (const Element& element : elements) nodes.push_back(element.nodes);
  return array_of(nodes);
}

// What things are called.

std::string unknown(std::string_view what, const std::string& name,
                    const std::vector<std::string>& known) {
  const std::vector<std::string_view> words(known.begin(), known.end());
  if (words.empty()) return fmt::format("there is no {} \"{}\"; the scenario has none", what, name);
  const std::string closest = apps::did_you_mean(name, words);
  return fmt::format("there is no {} \"{}\"{}", what, name,
                     closest.empty() ? "; known here: " + apps::listed(words) : closest);
}

/// Nodes of a membrane or of grains; the numbers follow each other.
py::array nodes_of(const Session& session, const std::string& name) {
  const auto& built = session.prepared()->built;
  const auto& spheres = session.simulation().elements().spheres;
  std::vector<std::string> known;
  std::vector<std::int32_t> nodes;
  const auto is_meant = [&](const std::string& path) {
    known.push_back(path);
    return path == name;
  };
  for (const apps::BuiltMembrane& membrane : built.membranes) {
    if (!is_meant("membranes." + membrane.name)) continue;
    for (std::size_t i = 0; i < membrane.nodes; ++i)
      nodes.push_back(static_cast<std::int32_t>(membrane.first_node + i));
    return array_of(nodes);
  }
  std::size_t first = 0;
  for (const apps::BuiltGrains& grains : built.grains) {
    if (is_meant("grains." + grains.name)) {
      for (std::size_t i = first; i < first + grains.count; ++i)
        nodes.push_back(static_cast<std::int32_t>(spheres[i].nodes[0]));
      return array_of(nodes);
    }
    first += grains.count;
  }
  throw InputError(unknown("table", name, known));
}

// Reading out.

/// The layout of a row: every field of contacts.csv, eight bytes a number.
py::dtype contact_dtype() {
  py::list names, formats, offsets;
  py::ssize_t size = 0;
  for (const dynamics::ContactField& field : dynamics::contact_fields()) {
    using Field = dynamics::ContactField;
    const bool is_vector = std::holds_alternative<Field::Vector>(field.value);
    names.append(std::string(field.name));
    formats.append(is_vector                                            ? "(3,)f8"
                   : std::holds_alternative<Field::Number>(field.value) ? "f8"
                                                                        : "i8");
    offsets.append(size);
    size += is_vector ? 24 : 8;
  }
  return py::dtype(names, formats, offsets, size);
}

/// Writes a value behind another, as its bytes.
template <class Value>
void append(std::byte*& at, const Value& value) {
  std::memcpy(at, &value, sizeof(Value));
  at += sizeof(Value);
}

py::array contacts(const Session& session) {
  using Field = dynamics::ContactField;
  const auto records = session.simulation().list_contacts();
  const apps::BodyTables bodies(session.scenario(), session.prepared()->built,
                                session.simulation());
  py::array rows(contact_dtype(), static_cast<py::ssize_t>(records.size()));
  auto* at = static_cast<std::byte*>(rows.mutable_data());
  for (const contact::ContactRecord& record : records) {
    const dynamics::ContactLabels labels = bodies.labels_of(record);
    for (const Field& field : dynamics::contact_fields()) {
      if (const auto* number = std::get_if<Field::Number>(&field.value))
        append(at, (*number)(record));
      if (const auto* whole = std::get_if<Field::Whole>(&field.value)) append(at, (*whole)(record));
      if (const auto* vector = std::get_if<Field::Vector>(&field.value))
        append(at, plain((*vector)(record)));
      if (const auto* label = std::get_if<Field::Label>(&field.value))
        append(at, std::int64_t{labels.**label});
    }
  }
  return rows;
}

/// Of a plane or a reaction of [output].
apps::ReactionValue reaction(const Session& session, const std::string& name) {
  const auto& reactions = session.prepared()->built.reactions;
  dynamics::Simulation& simulation = session.simulation();
  std::vector<std::string> known;
  for (const apps::BuiltReaction& one : reactions) {
    known.push_back(one.name);
    if (one.name == name) return apps::reaction_in(simulation, one, simulation.contact_rows());
  }
  throw InputError(unknown("reaction", name, known) + "; [[output.reactions]] names them");
}

// Changing it.

/// Numbers of nodes, from these or from a truth value for each of them.
/// @param count  of all nodes
std::vector<std::int64_t> node_numbers(const py::object& nodes, std::size_t count) {
  const py::array given = py::array::ensure(nodes);
  if (!given) PyErr_Clear();
  if (given && given.dtype().kind() == 'b') {
    const py::array_t<bool, py::array::c_style> mask(given);
    if (given.ndim() != 1 || static_cast<std::size_t>(mask.size()) != count)
      throw InputError(
          fmt::format("set_velocity: got {} truth values; expected one for each of the {} nodes, "
                      "or whole numbers",
                      mask.size(), count));
    std::vector<std::int64_t> numbers;
    for (std::size_t i = 0; i < count; ++i)
      if (mask.data()[i]) numbers.push_back(static_cast<std::int64_t>(i));
    return numbers;
  }
  const Whole whole =
      whole_numbers(nodes, "set_velocity: nodes", "whole numbers, or a truth value for each node");
  return {whole.data(), whole.data() + whole.size()};
}

void set_velocity(const Session& session, const py::object& given_nodes, const Numbers& velocity,
                  const Numbers& angular_velocity) {
  dynamics::Simulation& simulation = session.simulation();
  const std::vector<std::int64_t> nodes =
      node_numbers(given_nodes, simulation.properties().held.size());
  const auto rows_of = [&](const Numbers& given, const char* name) {
    if (given.ndim() == 2) return vectors_of(given, name);
    if (given.ndim() != 1 || given.size() != 3)
      throw InputError(fmt::format("{}: expected three components, or those of every node", name));
    const Vec3 same(given.at(0), given.at(1), given.at(2));
    return std::vector<Vec3>(nodes.size(), same);
  };
  const auto velocities = rows_of(velocity, "velocity");
  const auto spins = rows_of(angular_velocity, "angular_velocity");
  const std::size_t count = nodes.size();
  if (velocities.size() != count || spins.size() != count)
    throw InputError(fmt::format("set_velocity: got {} nodes, {} velocities and {} angular ones",
                                 count, velocities.size(), spins.size()));
  const auto& held = simulation.properties().held;
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t node = nodes[i];
    if (node < 0 || static_cast<std::size_t>(node) >= held.size())
      throw InputError(
          fmt::format("set_velocity: there is no node {}; there are {}", node, held.size()));
    if (!dynamics::holds_translation(held[static_cast<std::size_t>(node)]))
      throw InputError(
          fmt::format("set_velocity: node {} is free, forces say how it moves; only "
                      "nodes that are held can be given a velocity",
                      node));
    if (!velocities[i].allFinite() || !spins[i].allFinite())
      throw InputError(fmt::format("set_velocity: the velocity of node {} is not finite", node));
    if (!dynamics::free_turns(held[static_cast<std::size_t>(node)])
             .cwiseProduct(spins[i])
             .isZero(0.0))
      throw InputError(
          fmt::format("set_velocity: node {} is free to turn, torques say how; an "
                      "angular_velocity can be given about axes about which it is held",
                      node));
  }
  for (std::size_t i = 0; i < count; ++i) {
    const auto node = static_cast<std::size_t>(nodes[i]);
    const Vec3 free = dynamics::free_turns(held[node]);  // about these it turns as it did
    const Vec3 spin = free.cwiseProduct(simulation.state().angular_velocity[node]) +
                      (Vec3::Ones() - free).cwiseProduct(spins[i]);
    simulation.set_velocity(geometry::id_at<geometry::NodeId>(node), velocities[i], spin);
  }
}

void bind_energy(py::module_& module) {
  using dynamics::Energy;
  py::class_<Energy>(module, "Energy",
                     "Where the energy of a simulation is and where it went, in J, at the moment "
                     "of the last forces.")
      .def_readonly("kinetic", &Energy::kinetic, "J, of all motions that are free")
      .def_readonly("contact_elastic", &Energy::contact_elastic, "J")
      .def_readonly("bond_elastic", &Energy::bond_elastic, "J, of beams and bars")
      .def_readonly("sheet_elastic", &Energy::sheet_elastic, "J, of membranes as sheets")
      .def_readonly("gravity", &Energy::gravity, "J, from where the free nodes were at the start")
      .def_readonly("friction", &Energy::friction, "J, dissipated in contacts")
      .def_readonly("tracking", &Energy::tracking,
                    "J, lost, or below 0 made, where contacts go on as others")
      .def_readonly("bond_dissipated", &Energy::bond_dissipated,
                    "J, by bonds that yielded or broke, sheets that tore")
      .def_readonly("damping", &Energy::damping, "J, taken by numerical damping")
      .def_readonly("external_work", &Energy::external_work,
                    "J, done by what moves as prescribed, and by loads")
      .def_readonly("initial", &Energy::initial, "J, kinetic and elastic at the start")
      .def("closure_error", &Energy::closure_error, "J that are not accounted for.");
}

void bind_reaction(py::module_& module) {
  using apps::ReactionValue;
  py::class_<ReactionValue>(module, "Reaction", "A force and its moment, in the last step.")
      .def_property_readonly(
          "force", [](const ReactionValue& r) { return array_of(r.value.force); }, "N")
      .def_property_readonly(
          "moment", [](const ReactionValue& r) { return array_of(r.value.moment); },
          "N m, about the point that the scenario says")
      .def_property_readonly(
          "position", [](const ReactionValue& r) { return array_of(r.position); },
          "m, of the point of the plane, or the mean of the nodes");
}

using SessionClass = py::class_<Session>;

void bind_motion(SessionClass& session) {
  session
      .def("run", &run, py::arg("until") = py::none(), py::arg("every") = py::none(), py::kw_only(),
           py::arg("out") = py::none(), py::arg("overwrite") = false,
           "Runs to a time (s, or a text as in \"0.5 s\"; the duration of the scenario if not "
           "given).\n\n"
           "every={\"10 ms\": f} calls f(simulation) every so much time; Ctrl-C and an error in f "
           "end the run. "
           "With out it runs as plekton run does: results go to that folder, [stop] counts, and "
           "what run.json "
           "says is returned.")
      .def("step", &step, py::arg("count") = 1, "Makes so many time steps.")
      .def("stop", &Session::stop,
           "Ends the run after the step that is under way; for a function that run(every=...) "
           "calls.")
      .def("save", &Session::save, py::arg("file"),
           "Writes a checkpoint with the scenario, for restore() and plekton.resume().")
      .def("restore", &Session::restore, py::arg("file"),
           "Takes the state of a checkpoint of the same scene. Arrays that were handed out before "
           "keep "
           "what they show: ask for new ones.")
      .def("set_velocity", &set_velocity, py::arg("nodes"), py::arg("velocity"),
           py::arg("angular_velocity") = py::make_tuple(0.0, 0.0, 0.0),
           "Gives nodes that are held, by their numbers or a truth value for each of all, a "
           "velocity "
           "(m/s) and an angular velocity (rad/s), the same "
           "or one "
           "for each, until they are given another.")
      .def(
          "break_bond",
          [](const Session& s, std::size_t bond) {
            if (bond >= s.simulation().bonds().size())
              throw InputError(fmt::format("break_bond: there is no bond {}; there are {}", bond,
                                           s.simulation().bonds().size()));
            s.simulation().break_bond(bond);
          },
          py::arg("bond"), "Breaks a beam or bar for good, in the next step.")
      .def(
          "break_facet",
          [](const Session& s, const std::array<std::int32_t, 3>& n) {
            s.simulation().break_facet(
                {geometry::NodeId{n[0]}, geometry::NodeId{n[1]}, geometry::NodeId{n[2]}});
          },
          py::arg("nodes"), "Tears the facet between three nodes, in the next step.")
      .def("view", &Session::view, py::arg("out") = py::none(),
           "Writes the page of plekton view and returns its path: of the run, if results were "
           "written, into its "
           "folder, else of the state of now, as view.html.");
}

void bind_arrays(SessionClass& session) {
  const auto of_state = [&](const char* name, std::vector<Vec3> NodeState::*field,
                            const char* doc) {
    session.def_property_readonly(
        name, [field](const Session& s) { return view(s, s.simulation().state().*field); }, doc);
  };
  of_state("positions", &NodeState::position,
           "m, (nodes, 3); a read-only view of now, as all of these");
  of_state("velocities", &NodeState::velocity, "m/s, (nodes, 3), in the middle of the last step");
  of_state("angular_velocities", &NodeState::angular_velocity, "rad/s, (nodes, 3), likewise");
  session
      .def_property_readonly("orientations", &orientations,
                             "(nodes, 4), unit quaternions x, y, z, w")
      .def_property_readonly(
          "forces", [](const Session& s) { return view(s, s.simulation().forces().force); },
          "N, (nodes, 3), of contacts, bonds, sheets and loads in the last step, without gravity")
      .def_property_readonly(
          "torques", [](const Session& s) { return view(s, s.simulation().forces().torque); },
          "N m, (nodes, 3), likewise")
      .def_property_readonly(
          "masses", [](const Session& s) { return view(s, s.simulation().properties().mass); },
          "kg, (nodes,)")
      .def_property_readonly(
          "inertias", [](const Session& s) { return view(s, s.simulation().properties().inertia); },
          "kg m2, (nodes,), the same about every axis")
      .def_property_readonly("radii", &radii, "m, (spheres,)")
      .def_property_readonly("sphere_nodes", &sphere_nodes, "(spheres,), the node of each sphere")
      .def_property_readonly(
          "facets",
          [](const Session& s) { return nodes_of_elements(s.simulation().elements().facets); },
          "(facets, 3), nodes of those that are left; a copy")
      .def_property_readonly(
          "bars",
          [](const Session& s) { return nodes_of_elements(s.simulation().elements().cylinders); },
          "(bars, 2), nodes of those that are left; a copy")
      .def("nodes", &nodes_of, py::arg("name"),
           "Numbers of the nodes of a table of the scenario, as in \"membranes.sheet\" or "
           "\"grains.sand\".");
}

void bind_readings(SessionClass& session) {
  session
      .def("__repr__",
           [](const Session& s) {
             return fmt::format("<plekton.Simulation of {}: {:.6g} s, step {}>",
                                s.scenario().file.string(), s.simulation().time(),
                                s.simulation().steps());
           })
      .def_property_readonly(
          "time", [](const Session& s) { return s.simulation().time(); }, "s")
      .def_property_readonly(
          "steps", [](const Session& s) { return s.simulation().steps(); }, "Time steps so far.")
      .def_property_readonly(
          "time_step", [](const Session& s) { return s.simulation().time_step(); },
          "s, of the next step")
      .def_property_readonly(
          "critical_time_step", [](const Session& s) { return s.simulation().critical_step().dt; },
          "s, of the scene as it is now, with the contacts that may come")
      .def_property_readonly(
          "duration", [](const Session& s) { return s.scenario().simulation.duration; },
          "s, that the scenario asks for")
      .def_property_readonly(
          "warnings", [](const Session& s) { return s.prepared()->built.warnings; },
          "What is to be known about the scene, as plekton check says it.")
      .def_property_readonly(
          "scenario", [](const Session& s) { return s.scenario().text; },
          "The scenario as TOML; of a dict what it says.")
      .def_property_readonly(
          "hash",
          [](const Session& s) {
            return fmt::format("{:016x}", dynamics::state_hash(s.simulation()));
          },
          "Of the state, as run.json has it: the same for the same bits.")
      .def_property_readonly(
          "largest_overlap_ratio",
          [](const Session& s) { return s.simulation().largest_overlap_ratio(); },
          "Largest overlap so far over the radius of the grain, of two grains the smaller one; "
          "between membranes, and of them with planes, over half the thickness.")
      .def_property_readonly(
          "unbalanced_force_ratio",
          [](const Session& s) { return s.simulation().unbalanced_force_ratio(); },
          "How far from balance the last step was.")
      .def("contacts", &contacts,
           "A structured array of the contacts of the last step, with the columns of contacts.csv: "
           "id, kind_a, body_a, "
           "feature_a, kind_b, ..., point (m), normal (from a to b), gap (m, negative: overlap), "
           "normal_force, "
           "tangential_force (N, on b) and their magnitudes, moment (N m), is_bonded, is_slipping, "
           "group_a, material_a, group_b, material_b (numbers of tables and materials, from 0).")
      .def(
          "energy", [](const Session& s) { return s.simulation().energy(); }, "J, by where it is.")
      .def("reaction", &reaction, py::arg("name"),
           "Force (N), moment (N m) and place (m) of a reaction that [[output.reactions]] names.");
}

}  // namespace

void bind_simulation(py::module_& module) {
  bind_energy(module);
  bind_reaction(module);
  SessionClass session(
      module, "Simulation",
      "A scenario in motion; load(), resume() make one. Arrays by node or sphere are read-only "
      "views "
      "that follow it and keep its memory; they stay as they are where elements break.");
  bind_motion(session);
  bind_arrays(session);
  bind_readings(session);
  module.def("load", &load, py::arg("scenario"), py::arg("overrides") = py::tuple(), py::kw_only(),
             py::arg("folder") = py::none(),
             "Makes a simulation of a scenario: a TOML file, or a dict with the same keys, whose "
             "lists may be arrays of "
             "numpy.\n\noverrides are texts as --set takes them; folder is where the paths in a "
             "dict begin.");
  module.def(
      "resume", &resume, py::arg("path"), py::arg("overrides") = py::tuple(),
      "Goes on from the last checkpoint of a run (its folder), or from a checkpoint (a file).");
}

}  // namespace plekton::python
