// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/run_warnings.hpp"

#include <fmt/format.h>

namespace plekton::apps {
namespace {

std::string text_of(const DeepestOverlap& overlap) {
  const Vec3& x = overlap.place;
  return fmt::format("of {} with {} by {:.3g} mm at ({:.4g}, {:.4g}, {:.4g}) m after {:.4g} s",
                     overlap.a, overlap.b, 1e3 * overlap.depth, x[0], x[1], x[2], overlap.time);
}

}  // namespace

std::vector<std::string> warnings_about(const RunReport& report) {
  std::vector<std::string> warnings;
  if (report.largest_overlap_ratio > kDeepOverlap) {
    warnings.push_back(fmt::format(
        "the largest overlap is {:.3g} % of a radius, above {:.0f} %{}: too deep for a contact, "
        "and "
        "grains may pass through what they press on; raise young_modulus of the materials, or slow "
        "down what moves fast",
        100.0 * report.largest_overlap_ratio, 100.0 * kDeepOverlap,
        report.deepest_overlap ? ", " + text_of(*report.deepest_overlap) : ""));
  }
  if (report.largest_motion_ratio > kFastMotion) {
    warnings.push_back(fmt::format(
        "the fastest node moves by {:.3g} % of the smallest radius in one step, above {:.0f} %: "
        "contacts are seen late; run with simulation.time_step \"auto\" or {:.2g} of this one",
        100.0 * report.largest_motion_ratio, 100.0 * dynamics::kLargestMotion,
        dynamics::kLargestMotion / report.largest_motion_ratio));
  }
  if (report.pass_throughs > 0) {
    warnings.push_back(fmt::format(
        "{} times the centre of a grain went through a facet or a cylinder; stiffer contacts or "
        "slower grains are held",
        report.pass_throughs));
  }
  if (report.most_crossings > 0) {
    warnings.push_back(fmt::format(
        "membranes went into each other by more than both thicknesses: up to {} pairs of facets or "
        "cylinders crossed at a time; stiffer contacts, thicker membranes or slower motion keep "
        "them apart",
        report.most_crossings));
  }
  if (report.energy_closure > kPoorClosure) {
    warnings.push_back(
        fmt::format("the energy balance is off by {:.2g} % of what went through, above {:.0f} %; "
                    "run with a smaller simulation.time_step",
                    100.0 * report.energy_closure, 100.0 * kPoorClosure));
  }
  if (report.tracking_ratio > kMuchTracking) {
    warnings.push_back(fmt::format(
        "{:.2g} % of the energy that went through was {}, above {:.1f} %, where contacts are "
        "handed "
        "on from patch to patch or with elements that break (column tracking of energy.csv): look "
        "there when it happens; finer meshes and smaller overlaps make less of it",
        100.0 * report.tracking_ratio, report.energy.tracking < 0.0 ? "made" : "lost",
        100.0 * kMuchTracking));
  }
  if (report.lost_grains > 0) {
    warnings.push_back(
        fmt::format("{} grains are lost: {} passed through a membrane (smaller time steps or "
                    "stiffer contacts hold them), {} left the box around everything at the start, "
                    "grown on every side by its longest side (a plane or a membrane can stop them)",
                    report.lost_grains, report.lost_through_membranes, report.lost_out_of_bounds));
  }
  return warnings;
}

}  // namespace plekton::apps
