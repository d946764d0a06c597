// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/read_load_targets.hpp"

#include "apps/scenario/closest_word.hpp"
#include "apps/scenario/read_sections.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace plekton::apps {
namespace {

template <class Body>
constexpr std::string_view kTables = "rigid_bodies";
template <>
constexpr std::string_view kTables<MembraneSettings> = "membranes";
template <>
constexpr std::string_view kTables<GrainSettings> = "grains";
template <>
constexpr std::string_view kTables<PlaneSettings> = "planes";

/// What membranes or grains are there that make up no rigid body.
template <class Body>
bool is_of_its_own(const Body& body) noexcept {
  if constexpr (requires { body.rigid_body; }) return !body.rigid_body;
  return true;
}

/// Position of a name among the bodies of a kind.
template <class Body>
std::optional<std::size_t> find_name(Section& section, std::string_view key,
                                     const std::string& name, const std::vector<Body>& bodies) {
  if (name.empty()) return std::nullopt;
  std::vector<std::string_view> names;
  bool are_any = false;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].name == name) {
      if constexpr (requires { bodies[i].is_absent; }) {
        if (bodies[i].is_absent)
          section.complain(
              key, fmt::format("\"{}\" is not there in this stage; {}", name,
                               section.path().starts_with("ties")
                                   ? "ties stay for the whole run, and so has to stay what they tie"
                                   : "expected a body that is; a load that goes on has to be taken "
                                     "out with its body, remove = [{ load = NAME }]"));
      }
      return i;
    }
    if (!is_of_its_own(bodies[i])) continue;
    are_any = true;
    if (!bodies[i].name.empty()) names.push_back(bodies[i].name);
  }
  const std::string closest = closest_word(name, names);
  section.complain(key, fmt::format("there is none called \"{}\"; {}", name,
                                    !closest.empty() ? fmt::format("did you mean \"{}\"?", closest)
                                    : !names.empty() ? "there are " + listed(names)
                                    : are_any        ? "none of them has a name; give it one"
                                              : fmt::format("there are no [[{}]]", kTables<Body>)));
  return std::nullopt;
}

/// The name of one body; empty after a problem.
std::string read_name(Section& section, std::string_view key) {
  if (!section.is_list(key)) return section.text(key);
  section.has(key);
  section.complain(key,
                   "got a list; expected one name in quotes; give each body a table of its own");
  return "";
}

/// The same of a membrane or of grains: a rigid body has no nodes of its own.
template <class Body>
std::optional<std::size_t> find_flexible(Section& section, std::string_view key,
                                         const std::vector<Body>& bodies) {
  const std::string name = read_name(section, key);
  const auto found = find_name(section, key, name, bodies);
  if (!found || !bodies[*found].rigid_body) return found;
  section.complain(key, fmt::format("\"{0}\" is a rigid body, whose inner nodes bear no loads of "
                                    "their own; expected rigid_body = \"{0}\"",
                                    name));
  return std::nullopt;
}

}  // namespace

std::optional<std::size_t> read_membrane_name(Section& section, const Scenario& scenario) {
  return find_flexible(section, "membrane", scenario.membranes);
}

std::optional<std::size_t> read_rigid_body_name(Section& section, const Scenario& scenario) {
  return find_name(section, "rigid_body", read_name(section, "rigid_body"), scenario.rigid_bodies);
}

std::optional<std::size_t> read_plane_name(Section& section, const Scenario& scenario) {
  return find_name(section, "plane", read_name(section, "plane"), scenario.planes);
}

std::vector<std::size_t> read_plane_names(Section& section, std::string_view key,
                                          const Scenario& scenario) {
  std::vector<std::size_t> planes;
  for (const std::string& name : section.texts(key))
    if (const auto plane = find_name(section, key, name, scenario.planes)) planes.push_back(*plane);
  return planes;
}

namespace {

constexpr double kParallel = 1e-9;  // of unit normals

void require_parallel(Section& section, const Scenario& scenario,
                      const std::array<std::size_t, 2>& of) {
  if (std::max(of[0], of[1]) >= scenario.planes.size()) return;  // complained of already
  const PlaneSettings &a = scenario.planes[of[0]], &b = scenario.planes[of[1]];
  const bool are_flat = a.is_flat() && b.is_flat();
  if (are_flat && a.normal.cross(b.normal).norm() < kParallel) return;
  section.complain("between",
                   fmt::format("planes \"{}\" and \"{}\" are not flat and parallel, so that they "
                               "have no distance; expected two that are",
                               a.name, b.name));
}

}  // namespace

StrainEnd read_two_bodies(Section& section, const Scenario& scenario) {
  const std::vector<std::string> names = section.texts("between");
  StrainEnd end;
  if (names.size() != 2) {
    if (!names.empty())
      section.complain("between",
                       fmt::format("got {} names; expected those of two planes or two rigid bodies",
                                   names.size()));
    return end;
  }
  end.are_rigid_bodies = std::any_of(scenario.rigid_bodies.begin(), scenario.rigid_bodies.end(),
                                     [&](const RigidBodySettings& body) {
                                       return body.name == names[0] || body.name == names[1];
                                     });
  for (std::size_t i = 0; i < 2; ++i) {
    end.of[i] =
        (end.are_rigid_bodies ? find_name(section, "between", names[i], scenario.rigid_bodies)
                              : find_name(section, "between", names[i], scenario.planes))
            .value_or(0);
  }
  end.place = section.place_of("between");
  if (names[0] == names[1])
    section.complain("between", fmt::format("names \"{}\" twice; expected two", names[0]));
  else if (!end.are_rigid_bodies)
    require_parallel(section, scenario, end.of);
  return end;
}

std::vector<std::array<std::size_t, 2>> read_plane_pairs(Section& section,
                                                         const Scenario& scenario) {
  const std::vector<std::string> names = section.texts("between");
  if (names.size() % 2 != 0 || names.size() > 4) {
    section.complain("between", fmt::format("got {} names; expected those of two planes that face "
                                            "each other, or of two such pairs",
                                            names.size()));
    return {};
  }
  std::vector<std::array<std::size_t, 2>> pairs;
  for (std::size_t i = 0; i + 1 < names.size(); i += 2) {
    const auto a = find_name(section, "between", names[i], scenario.planes);
    const auto b = find_name(section, "between", names[i + 1], scenario.planes);
    if (!a || !b) continue;
    if (scenario.planes[*a].is_flat() && scenario.planes[*b].is_flat() &&
        (scenario.planes[*a].normal + scenario.planes[*b].normal).norm() < kParallel)
      pairs.push_back({*a, *b});
    else
      section.complain("between", fmt::format("\"{}\" and \"{}\" do not face each other: their "
                                              "normals are not opposite; name them in pairs",
                                              names[i], names[i + 1]));
  }
  if (2 * pairs.size() != names.size()) return {};
  return pairs;
}

NodeSetSettings read_whole_body(Section& section, const Scenario& scenario) {
  if (section.has("rigid_body")) {
    NodeSetSettings set;
    for (const std::string_view key : {"membrane", "grains"}) {
      if (section.has(key))
        section.complain(key, "rigid_body says already what is meant; leave one of them out");
    }
    set.place = section.place_of("rigid_body");
    set.rigid_body = read_rigid_body_name(section, scenario).value_or(0);
    return set;
  }
  return read_flexible_body(section, scenario);
}

NodeSetSettings read_flexible_body(Section& section, const Scenario& scenario) {
  NodeSetSettings set;
  set.place = section.place();
  set.of_grains = section.has("grains");
  if (set.of_grains == section.has("membrane")) {
    section.complain("membrane", fmt::format("got {} of membrane and grains; expected exactly one "
                                             "of them: whose nodes are meant",
                                             set.of_grains ? "both" : "none"));
    return set;
  }
  set.body = (set.of_grains ? find_flexible(section, "grains", scenario.grains)
                            : read_membrane_name(section, scenario))
                 .value_or(0);
  return set;
}

namespace {

constexpr std::array<std::string_view, 8> kSetWords = {"all",   "rim",   "x_min", "x_max",
                                                       "y_min", "y_max", "z_min", "z_max"};

/// With the nodes of a body that the key `nodes` says.
NodeSetSettings with_choice(Section& section, NodeSetSettings set) {
  set.place = section.place_of("nodes");
  section.tell_default("nodes", "required; of grains \"all\"");
  if (section.is_table("nodes", box_type())) {
    set.which = SetWhich::box;
    set.box = read_box(*section.table("nodes"));
    return set;
  }
  const auto fallback = set.of_grains ? std::optional(std::size_t{0}) : std::nullopt;
  set.which = static_cast<SetWhich>(section.choice("nodes", kSetWords, fallback));
  if (set.of_grains && set.which == SetWhich::rim)
    section.complain("nodes",
                     "grains have no rim; expected \"all\", a side such as \"z_max\", or "
                     "a box { min = [...], max = [...] }");
  return set;
}

/// The same where the body is known.
NodeSetSettings with_nodes(Section& section, const NodeSetSettings& set) {
  if (section.has("grains") != section.has("membrane")) return with_choice(section, set);
  section.has("nodes");
  return set;
}

}  // namespace

std::string_view word_of(SetWhich which) {
  return kSetWords[static_cast<std::size_t>(which)];
}

NodeSetSettings read_node_set(Section& section, const Scenario& scenario) {
  const NodeSetSettings set = read_whole_body(section, scenario);
  if (set.rigid_body) {
    if (section.has("nodes"))
      section.complain("nodes",
                       "a rigid body moves as one, and its inner nodes bear no loads of "
                       "their own; leave nodes out");
    return set;
  }
  return with_nodes(section, set);
}

NodeSetSettings read_membrane_nodes(Section& section, const Scenario& scenario) {
  NodeSetSettings set;
  set.place = section.place();
  set.body = read_membrane_name(section, scenario).value_or(0);
  return with_nodes(section, set);
}

NodeSetSettings read_tied_body(Section& section, const Scenario& scenario) {
  NodeSetSettings set;
  set.place = section.place();
  if (section.has("rigid_body")) {
    if (section.has("membrane"))
      section.complain("membrane", "rigid_body says already what is meant; leave one of them out");
    set.place = section.place_of("rigid_body");
    set.rigid_body = read_rigid_body_name(section, scenario).value_or(0);
    return set;
  }
  section.tell_default("membrane", "required without rigid_body");
  set.body = read_membrane_name(section, scenario).value_or(0);
  return set;
}

NodeSetSettings read_tied_nodes(Section& section, const Scenario& scenario) {
  const NodeSetSettings set = read_tied_body(section, scenario);
  if (!set.rigid_body) return with_choice(section, set);
  if (section.has("nodes"))
    section.complain("nodes",
                     "of a rigid body its centre is tied; leave nodes out, or tie to its "
                     "kind = \"surface\"");
  return set;
}

}  // namespace plekton::apps
