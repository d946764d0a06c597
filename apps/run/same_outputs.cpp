// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/same_outputs.hpp"

#include "apps/run/measures.hpp"
#include "apps/run/run_state.hpp"
#include "apps/run/written_files.hpp"
#include "apps/scenario/problems.hpp"
#include "apps/scenario/read_load_targets.hpp"
#include "apps/scenario/scenario_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace plekton::apps {
namespace {

// Two things are one if they have the same text: it has all that decides what is written.

std::string text_of(const Vec3& point) {
  return fmt::format("[{}, {}, {}]", point.x(), point.y(), point.z());
}

std::string text_of(const geometry::Box& box) {
  return fmt::format("the box from {} to {}", text_of(box.lower), text_of(box.upper));
}

std::string text_of(const NodeSetSettings& set, const Scenario& scenario) {
  if (set.rigid_body)
    return fmt::format("rigid body \"{}\"", scenario.rigid_bodies[*set.rigid_body].name);
  const std::string body = set.of_grains
                               ? fmt::format("grains \"{}\"", scenario.grains[set.body].name)
                               : fmt::format("membrane \"{}\"", scenario.membranes[set.body].name);
  if (set.which == SetWhich::all) return body;
  if (set.which == SetWhich::box) return fmt::format("{} in {}", body, text_of(set.box));
  return fmt::format("{} of {}", word_of(set.which), body);
}

std::string text_of(const ReactionSettings& reaction, const Scenario& scenario) {
  static_assert(static_cast<std::size_t>(ReactionKind::section) == 4);
  constexpr std::array<std::string_view, 5> kOf = {"", "the supports of ", "the contacts of ",
                                                   "the nodes of ", "the section of "};
  std::string text(kOf[static_cast<std::size_t>(reaction.kind)]);
  text += reaction.kind == ReactionKind::plane
              ? fmt::format("plane \"{}\"", scenario.planes[reaction.plane].name)
              : text_of(reaction.nodes, scenario);
  if (reaction.about) text += " about " + text_of(*reaction.about);
  return text;
}

std::string text_of(const geometry::Region& region) {
  if (const auto* const box = std::get_if<geometry::Box>(&region)) return text_of(*box);
  if (const auto* const ball = std::get_if<geometry::BallRegion>(&region))
    return fmt::format("the sphere around {} with radius {} m", text_of(ball->centre),
                       ball->radius);
  const auto& cylinder = std::get<geometry::CylinderRegion>(region);
  return fmt::format("the cylinder from {} to {} with radius {} m", text_of(cylinder.from),
                     text_of(cylinder.to), cylinder.radius);
}

std::string text_of(const MeasureSettings& measure, const Scenario& scenario) {
  std::string text = measure.region ? text_of(*measure.region) : "the box around the grains";
  if (std::isfinite(measure.bottom)) text += fmt::format(" above {} m", measure.bottom);
  if (std::isfinite(measure.top)) text += fmt::format(" below {} m", measure.top);
  for (const std::size_t plane : measure.planes)
    text += fmt::format("{} \"{}\"", plane == measure.planes.front() ? " between" : " and",
                        scenario.planes[plane].name);
  return text;
}

/// @param file_of  (output), where it is written to
template <class Output, class FileOf>
void require_same(const std::vector<Output>& then, const Scenario& before,
                  const std::vector<Output>& outputs, const Scenario& now, std::string_view key,
                  const FileOf& file_of) {
  for (const Output& output : outputs) {
    const auto old = std::ranges::find(then, output.name, &Output::name);
    if (old == then.end()) continue;
    const std::string was = text_of(*old, before), is = text_of(output, now);
    if (was == is) continue;
    throw InputError(
        fmt::format("output.{}: \"{}\" in {} is of {} so far, and would go on with {}; give that "
                    "another name, or go on in another folder with --out",
                    key, output.name, file_of(output), was, is));
  }
}

}  // namespace

void require_same_outputs(const geometry::StateTree& state, const Scenario& now) {
  ScenarioText text;
  text.exchange(geometry::StateArchive::reader(state).group(kRunGroup));
  if (text.overrides == text_of(now).overrides) return;
  const Scenario all = parse_scenario(text.text, text.file, text.overrides);
  const Scenario& before = now.stage ? all.stages.at(now.stage->number) : all;
  require_same(before.output.reactions, before, now.output.reactions, now, "reactions",
               [](const ReactionSettings&) { return std::string(kReactionsFile); });
  require_same(before.output.measures, before, now.output.measures, now, "measures",
               [](const MeasureSettings& measure) { return file_of(measure); });
}

}  // namespace plekton::apps
