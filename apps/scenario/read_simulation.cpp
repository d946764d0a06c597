// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/read_sections.hpp"

#include <cstdint>
#include <limits>

namespace plekton::apps {
namespace {

constexpr std::int64_t kLargestSeed = std::numeric_limits<std::int64_t>::max();
constexpr int kMostThreads = 1024;

}  // namespace

SimulationSettings read_simulation(Section section) {
  SimulationSettings settings;
  settings.duration = section.quantity("duration", {kTime, kPositive});
  settings.time_step = section.quantity_unless("time_step", "auto", {kTime, kPositive});
  settings.time_step_place = section.place_of("time_step");
  settings.gravity = section.vector("gravity", {kAcceleration}, settings.gravity);
  settings.damping = section.quantity("damping", {kNumber, kBelowOne}, settings.damping);
  settings.damp_gravity = section.truth("damp_gravity", settings.damp_gravity);
  settings.self_contact = section.truth("self_contact", settings.self_contact);
  settings.skin = section.quantity_unless("skin", "auto", {kLength, kPositive}).value_or(0.0);
  settings.seed = static_cast<std::uint64_t>(section.integer("seed", 0, kLargestSeed, 1));
  settings.threads = static_cast<int>(section.integer("threads", 1, kMostThreads, 1));
  section.finish();
  return settings;
}

}  // namespace plekton::apps
