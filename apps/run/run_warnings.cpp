// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/run_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace plekton::apps {
namespace {

std::string text_of(const DeepestOverlap& overlap) {
  const Vec3& x = overlap.place;
  return fmt::format("of {} with {} by {:.3g} mm at ({:.4g}, {:.4g}, {:.4g}) m after {:.4g} s",
                     overlap.a, overlap.b, 1e3 * overlap.depth, x[0], x[1], x[2], overlap.time);
}

std::string advice_on_overlap(const RunReport& report) {
  return fmt::format(
      "the largest overlap is {:.3g} % of a radius, above {:.0f} %{}: too deep for a contact, and "
      "grains may pass through what they press on; raise young_modulus of the materials, or slow "
      "down what moves fast",
      100.0 * report.largest_overlap_ratio, 100.0 * kDeepOverlap,
      report.deepest_overlap ? ", " + text_of(*report.deepest_overlap) : "");
}

/// A part below 1 in two digits that are not more than it is.
double rounded_down(double part) {
  double digits = 100.0;
  while (part * digits < 10.0 && digits < 1e12) digits *= 10.0;
  return std::floor(part * digits) / digits;
}

std::string advice_on_motion(const RunReport& report) {
  const double part = rounded_down(dynamics::kLargestMotion / report.largest_motion_ratio);
  return fmt::format(
      "the fastest node moves by {:.3g} % of the smallest radius in one step, above {:.0f} %: "
      "contacts are seen late; {}",
      100.0 * report.largest_motion_ratio, 100.0 * dynamics::kLargestMotion,
      report.chose_time_step
          ? fmt::format("the step was chosen, and something got faster than that foresees, as "
                        "where it tears; give simulation.time_step, {:.2g} of what it was then "
                        "(column time_step of energy.csv)",
                        part)
          : fmt::format("run with {:.2g} of this simulation.time_step, or with \"auto\", which "
                        "foresees gravity but not what tears",
                        part));
}

std::string advice_on_pass_throughs(const RunReport& report) {
  return fmt::format(
      "{} times the centre of a grain went through a facet or a cylinder; stiffer contacts or "
      "slower grains are held",
      report.pass_throughs);
}

std::string advice_on_crossings(const RunReport& report) {
  return fmt::format(
      "membranes went into each other by more than both half thicknesses: up to {} pairs of facets "
      "or cylinders crossed at a time; stiffer contacts, thicker membranes or slower motion keep "
      "them apart",
      report.most_crossings);
}

std::string advice_on_closure(const RunReport& report) {
  return fmt::format(
      "the energy balance is off by {:.2g} % of what went through, above {:.0f} %; run with a "
      "smaller simulation.time_step",
      100.0 * report.energy_closure, 100.0 * kPoorClosure);
}

std::string advice_on_tracking(const RunReport& report) {
  return fmt::format(
      "{:.2g} % of the energy that went through was {}, above {:.1f} %, where contacts are handed "
      "on from patch to patch or with elements that break (column tracking of energy.csv): look "
      "there when it happens; finer meshes and smaller overlaps make less of it",
      100.0 * report.tracking_ratio, report.energy.tracking < 0.0 ? "made" : "lost",
      100.0 * kMuchTracking);
}

std::string advice_on_momentum(const RunReport& report) {
  return fmt::format(
      "contacts, bonds and sheets made momentum from nothing: {:.2g} of the linear one that they "
      "carried and {:.2g} of the angular one, above {:.0e}. Results are wrong where they depend on "
      "it: a law of one's own whose forces on its two bodies differ does that; with the laws that "
      "are shipped it is a fault of plekton, please report it with the scenario",
      report.momentum.linear, report.momentum.angular, kMomentumDrift);
}

std::string advice_on_exact_decisions(const RunReport& report) {
  return fmt::format(
      "{} times, {:.2g} for each node and step, which feature is nearest could not be told by "
      "doubles, their pairs or intervals: results are right, but much of the time goes into that; "
      "bodies lie exactly on edges or in planes of others: shift or turn them by a little",
      report.exact_decisions.exact, exact_decisions_per_node(report));
}

std::string advice_on_lost_grains(const RunReport& report) {
  return fmt::format(
      "{} lost: {} passed through a membrane (smaller time steps or stiffer contacts hold them), "
      "{} left the box around everything, grown on every side by its longest side, with no plane "
      "below (a plane or a membrane can stop them){}",
      report.lost_grains == 1 ? "1 grain is" : fmt::format("{} grains are", report.lost_grains),
      report.lost_through_membranes, report.lost_out_of_bounds,
      report.lost_through_membranes + report.lost_out_of_bounds > report.lost_grains
          ? "; some did both"
          : "");
}

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// What was asked for is no fault: only whoever did not expect it has to know.
Check check_of_broken(const RunReport& report) {
  Check check{"broken_bonds", static_cast<double>(report.broken_bonds), kNoLimit, false, "", ""};
  if (report.broken_bonds > 0)
    check.advice = fmt::format(
        "{} of {} bonds broke, as strength, rupture_strain or wire of their membrane says; column "
        "broken_bonds of energy.csv has when",
        report.broken_bonds, report.bonds);
  return check;
}

/// By it runs are compared, on other machines too.
Check check_of_chain(const RunReport& report) {
  const double states = static_cast<double>(report.states.all().size());
  return {"hash_chain", states, kNoLimit, false, "", fmt::format("{:016x}", report.states.chain())};
}

/// A run tells of it when it happens.
constexpr std::string_view kStepCheck = "dt_over_critical";

std::string advice_on_step(const RunReport& report) {
  return fmt::format(
      "the time step was {:.2f} of the critical one, above {:.1f}: {}", report.dt_over_critical,
      dynamics::kLargestStep,
      report.chose_time_step
          ? fmt::format("it was chosen, and something became stiffer faster than that follows; "
                        "give simulation.time_step, {:.2g} of what it was then (column time_step "
                        "of energy.csv)",
                        rounded_down(dynamics::kSafety / report.dt_over_critical))
          : "run with a smaller one, or with none, and it is chosen");
}

using Advice = std::string (*)(const RunReport&);

Check checked(const RunReport& report, Check check, Advice advice) {
  if (check.is_red()) check.advice = advice(report);
  return check;
}

}  // namespace

/// In the order of their warnings.
std::vector<Check> certificate_of_motion(const RunReport& report) {
  std::vector<Check> certificate;
  const auto add = [&](std::string_view name, double value, double limit, bool in_percent,
                       Advice advice) {
    certificate.push_back(checked(report, {name, value, limit, in_percent, "", ""}, advice));
  };
  add("largest_overlap_ratio", report.largest_overlap_ratio, kDeepOverlap, true, advice_on_overlap);
  add("largest_motion_ratio", report.largest_motion_ratio, kFastMotion, true, advice_on_motion);
  add("pass_throughs", static_cast<double>(report.pass_throughs), 0.0, false,
      advice_on_pass_throughs);
  add("most_crossings", static_cast<double>(report.most_crossings), 0.0, false,
      advice_on_crossings);
  add("energy_closure", report.energy_closure, kPoorClosure, true, advice_on_closure);
  add("tracking_ratio", report.tracking_ratio, kMuchTracking, true, advice_on_tracking);
  add("momentum_drift", std::max(report.momentum.linear, report.momentum.angular), kMomentumDrift,
      false, advice_on_momentum);
  add("lost_grains", static_cast<double>(report.lost_grains), 0.0, false, advice_on_lost_grains);
  add(kStepCheck, report.dt_over_critical, dynamics::kLargestStep, false, advice_on_step);
  certificate.push_back(check_of_broken(report));
  return certificate;
}

std::vector<Check> certificate_of(const RunReport& report) {
  std::vector<Check> certificate = certificate_of_motion(report);
  certificate.push_back(checked(
      report,
      {"exact_decisions", exact_decisions_per_node(report), kManyExactDecisions, false, "", ""},
      advice_on_exact_decisions));
  certificate.push_back(check_of_chain(report));
  return certificate;
}

bool has_red(const std::vector<Check>& certificate) {
  return std::any_of(certificate.begin(), certificate.end(),
                     [](const Check& check) { return check.is_red(); });
}

std::string summary_of(const std::vector<Check>& certificate) {
  std::string reds;
  std::size_t green = 0;
  for (const Check& check : certificate) {
    if (!check.is_red()) {
      ++green;
      continue;
    }
    const double in = check.in_percent ? 100.0 : 1.0;
    const std::string_view unit = check.in_percent ? " %" : "";
    reds += fmt::format("{} {} {:.3g}{} (at most {:.3g}{})", reds.empty() ? "; red:" : ",",
                        check.name, in * check.value, unit, in * check.limit, unit);
  }
  return fmt::format("certificate: {} of {} green{}", green, certificate.size(), reds);
}

std::vector<std::string> warnings_about(const RunReport& report) {
  std::vector<std::string> warnings;
  for (const Check& check : certificate_of(report))
    if (check.is_red() && check.name != kStepCheck) warnings.push_back(check.advice);
  return warnings;
}

void add_warnings_to(RunReport& report) {
  for (std::string& warning : warnings_about(report)) report.warnings.push_back(std::move(warning));
}

}  // namespace plekton::apps
