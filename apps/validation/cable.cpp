// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/validation/hanging_chain.hpp"
#include "apps/validation/validation_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace plekton::apps::cable {
namespace {

/// Of the catenary, which is lowest in the middle of the span: y = a (cosh((x - span / 2) / a) -
/// cosh(span / 2 a)).
Curve curve_of(const HangingChain& exact) {
  const double a = exact.pull / kChainWeight;  // m
  Curve curve{"catenary", CurveStyle::dashed, {}, {}};
  for (int i = 0; i <= 100; ++i) {
    const double x = 0.01 * i * kChainSpan;
    curve.x.push_back(x);
    curve.y.push_back(a * (cosh_of((x - 0.5 * kChainSpan) / a) - cosh_of(0.5 * kChainSpan / a)));
  }
  return curve;
}

}  // namespace

/// A chain of n straight links hangs off the catenary by a part of it that falls with 1 / n²; of 40
/// links it is below 1e-3 (A4 of docs/validation.md), and it grows from there.
CaseReport validate(bool full) {
  constexpr double kTolerance = 1e-3;  // of sag and pull, with 40 links
  constexpr double kStretch = 5e-5;    // of links under their weight: below 3e-5
  const HangingChain exact = catenary(kChainWeight);
  const std::string source = "catenary y = a cosh(x / a); n links are off as 1 / n²";
  CaseReport report;
  Figure shape{"A chain of 1.2 m over a span of 1 m", "place (m)", "height (m)", {}};
  Figure error{"How many links the chain has", "links", "error of the sag (m)", {}};
  error.curves.push_back({"Plekton", CurveStyle::points, {}, {}});
  error.curves.push_back({"1 / n², of the finest", CurveStyle::dashed, {}, {}});
  const std::vector<int> numbers =
      full ? std::vector<int>{6, 10, 20, 40, 80} : std::vector<int>{10, 20, 40};
  for (const int links : numbers) {
    const HangingChain chain = hang_chain(links);
    const double allowed = kTolerance * 1600.0 / (links * links) + kStretch;
    report.findings.push_back({fmt::format("sag, {} links", links), chain.sag, exact.sag,
                               allowed * exact.sag, "m", source});
    report.findings.push_back({fmt::format("pull on a support, {} links", links), chain.pull,
                               exact.pull, allowed * exact.pull, "N", source});
    error.curves[0].x.push_back(links);
    error.curves[0].y.push_back(std::abs(chain.sag - exact.sag));
    Curve curve{fmt::format("{} links", links), CurveStyle::points, {}, {}};
    for (const geometry::Vec3& x : chain.places) {
      curve.x.push_back(x.x());
      curve.y.push_back(x.z());
    }
    if (links <= 20) shape.curves.push_back(std::move(curve));
  }
  shape.curves.push_back(curve_of(exact));
  error.curves[1].x = error.curves[0].x;
  for (const double links : error.curves[1].x) {
    const double ratio = error.curves[0].x.back() / links;
    error.curves[1].y.push_back(error.curves[0].y.back() * ratio * ratio);
  }
  report.figures = {std::move(shape), std::move(error)};
  return report;
}

}  // namespace plekton::apps::cable
