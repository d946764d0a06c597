// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/takeover/material_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plekton::apps::yade {
namespace {

constexpr double kSameDensity = 1e-9;  // relative, what the volume of a sphere is rounded by

/// The material of a body that has none, which YADE allows where nothing touches it.
const Material kNoMaterial{.type = "none", .label = "none", .young = 1e7};

const Material& material_of(const Scene& scene, int number) {
  return number < 0 ? kNoMaterial : scene.materials[static_cast<std::size_t>(number)];
}

/// Glued contacts of two cohesive materials, by the functors that there are.
std::string cohesion(const Scene& scene, const Material& a, const Material& b) {
  std::string text = fmt::format(
      "law = \"cohesive_frictional\"\ntensile_strength = {}\nshear_strength = {}\n"
      "bonds = \"{}\"\n",
      std::min(a.normal_cohesion, b.normal_cohesion), std::min(a.shear_cohesion, b.shear_cohesion),
      has_functor(scene, "setCohesionOnNewContacts") ? "new" : "start");
  if (!a.rolls || !b.rolls) return text;
  // YADE takes the mean of stiffnesses and the smaller limit.
  text += fmt::format("rolling_stiffness = {}\ntwisting_stiffness = {}\n",
                      0.5 * (a.rolling_stiffness + b.rolling_stiffness),
                      0.5 * (a.twisting_stiffness + b.twisting_stiffness));
  const double rolling = std::min(a.rolling_limit, b.rolling_limit);
  const double twisting = std::min(a.twisting_limit, b.twisting_limit);
  if (rolling >= 0.0) text += fmt::format("rolling_limit = {}\n", rolling);
  if (twisting >= 0.0) text += fmt::format("twisting_limit = {}\n", twisting);
  return text;
}

bool are_glued(const Scene& scene, const Material& a, const Material& b) {
  const bool has_law = (has_functor(scene, "Law2_ScGeom6D_CohFrictPhys_CohesionMoment") &&
                        has_functor(scene, "Ig2_Sphere_Sphere_ScGeom6D")) ||
                       has_functor(scene, "Law2_ScGridCoGeom_CohFrictPhys_CundallStrack");
  const bool are_at_all =
      has_functor(scene, "setCohesionNow") || has_functor(scene, "setCohesionOnNewContacts");
  return has_law && are_at_all && a.is_cohesive && b.is_cohesive;
}

/// A text of TOML.
std::string in_quotes(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      (result += '\\') += c;
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      result += ' ';
    else
      result += c;
  }
  return result + '"';
}

}  // namespace

std::string MaterialTable::free_name(const Material& material, bool is_rigid) const {
  std::string name = material.label.empty() ? material.type : material.label;
  // What a spreadsheet would take for a formula is no name in a scenario.
  if (std::string_view("=+-@ \t").find(name.front()) != std::string_view::npos) name = "m " + name;
  if (is_rigid) name += " (rigid)";
  const auto taken = [&](const std::string& wanted) {
    return std::ranges::any_of(rows_, [&](const Row& row) { return row.name == wanted; });
  };
  if (!taken(in_quotes(name))) return in_quotes(name);
  for (int i = 2;; ++i)
    if (const std::string next = in_quotes(fmt::format("{} {}", name, i)); !taken(next))
      return next;
}

std::string MaterialTable::name(int material, std::optional<double> density, bool is_rigid) {
  for (Row& row : rows_) {
    if (row.material != material || row.is_rigid != is_rigid) continue;
    if (!density || !row.density || std::abs(*density / *row.density - 1.0) < kSameDensity) {
      if (!row.density) row.density = density;
      return row.name;
    }
  }
  rows_.push_back(
      {material, density, is_rigid, free_name(material_of(scene_, material), is_rigid)});
  return rows_.back().name;
}

std::string MaterialTable::contact(const Row& a, const Row& b, bool is_hertz) const {
  const Material& first = material_of(scene_, a.material);
  const Material& second = material_of(scene_, b.material);
  std::string keys;
  if (is_hertz) {
    keys = "law = \"hertz_mindlin\"\n";
  } else {
    if (are_glued(scene_, first, second)) keys = cohesion(scene_, first, second);
    if (a.is_rigid != b.is_rigid) keys += "stiffness_radius = \"curvature\"\n";
  }
  return keys.empty()
             ? ""
             : fmt::format("[[contacts]]\nbetween = {}\nand = {}\n{}\n", a.name, b.name, keys);
}

std::string MaterialTable::text(std::vector<std::string>& notes) const {
  const bool is_hertz = has_functor(scene_, "Law2_ScGeom_MindlinPhys_Mindlin");
  std::string text;
  for (const Row& row : rows_) {
    const Material& material = material_of(scene_, row.material);
    text += fmt::format("[materials.{}]\nyoung_modulus = {}\nfriction_angle = {}\n", row.name,
                        material.young, material.friction_angle);
    if (is_hertz && material.poisson <= 0.5)
      text += fmt::format("poisson_ratio = {}\n", material.poisson);
    else
      text += fmt::format("stiffness_ratio = {}\n", std::max(material.poisson, 0.0));
    if (is_hertz && material.poisson > 0.5)
      notes.push_back(
          fmt::format("material {}: poisson = {} is no Poisson's ratio of the law after "
                      "Hertz; here 0.3",
                      row.name, material.poisson));
    if (row.density) text += fmt::format("density = {}\n", *row.density);
    text += '\n';
  }
  for (std::size_t i = 0; i < rows_.size(); ++i)
    for (std::size_t j = i; j < rows_.size(); ++j) text += contact(rows_[i], rows_[j], is_hertz);
  return text;
}

}  // namespace plekton::apps::yade
