// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/validation/validation_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace plekton::apps {
namespace {

constexpr std::string_view kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Plekton: validation</title>
<style>
body { font: 16px/1.5 sans-serif; color: #222; max-width: 62rem; margin: 2rem auto; padding: 0 1rem; }
table { border-collapse: collapse; width: 100%; font-size: 0.9rem; }
th, td { text-align: left; padding: 0.3rem 0.6rem; border-bottom: 1px solid #ddd; vertical-align: top; }
td.number { font-variant-numeric: tabular-nums; white-space: nowrap; }
.pass { color: #1a7431; } .fail { color: #b3001b; font-weight: bold; }
svg { width: 100%; height: auto; margin: 1rem 0; border: 1px solid #eee; }
section { break-inside: avoid; }
</style></head><body>
<h1>Validation of Plekton</h1>
)";

std::string with_unit(double value, const std::string& unit) {
  return html_text(fmt::format("{:.6g}{}{}", value, unit.empty() ? "" : " ", unit));
}

std::string verdict(bool passes) {
  return passes ? "<span class=\"pass\">pass</span>" : "<span class=\"fail\">FAIL</span>";
}

std::string row_of(const Finding& finding) {
  return fmt::format(
      "<tr><td>{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td>"
      "<td class=\"number\">{}</td><td>{}</td><td>{}</td></tr>\n",
      html_text(finding.what), with_unit(finding.value, finding.unit),
      with_unit(finding.reference, finding.unit), with_unit(finding.tolerance, finding.unit),
      html_text(finding.source), verdict(finding.passes()));
}

std::string section_of(const DoneCase& done) {
  std::string text = fmt::format("<section><h2>{}</h2><p>{} ({:.1f} s)</p>\n",
                                 html_text(std::string(done.of->name)),
                                 html_text(std::string(done.of->what)), done.seconds);
  if (!done.error.empty())
    return text + "<p class=\"fail\">" + html_text(done.error) + "</p></section>\n";
  text +=
      "<table><tr><th>what</th><th>value</th><th>reference</th><th>tolerance</th>"
      "<th>where the reference is from</th><th></th></tr>\n";
  for (const Finding& finding : done.report.findings) text += row_of(finding);
  text += "</table>\n";
  for (const Figure& figure : done.report.figures) text += svg_of(figure);
  return text + "</section>\n";
}

}  // namespace

bool DoneCase::passes() const {
  return error.empty() && std::all_of(report.findings.begin(), report.findings.end(),
                                      [](const Finding& finding) { return finding.passes(); });
}

std::string validation_page(std::span<const DoneCase> cases, const std::string& origin) {
  const auto passed =
      std::count_if(cases.begin(), cases.end(), [](const DoneCase& done) { return done.passes(); });
  std::string page(kHead);
  page += fmt::format("<p>{}</p>\n<p>{} of {} cases pass.</p>\n", html_text(origin), passed,
                      cases.size());
  for (const DoneCase& done : cases) page += section_of(done);
  return page + "</body></html>\n";
}

bool is_validation_page(std::string_view head) {
  return head.starts_with("<!DOCTYPE html>") &&
         head.find("<title>Plekton: validation</title>") != std::string_view::npos;
}

}  // namespace plekton::apps
