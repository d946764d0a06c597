// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/measures.hpp"

#include "apps/run/other_file.hpp"
#include "dynamics/output/file.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <system_error>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

constexpr std::array<dynamics::OutputField, 23> kMeasureFields = {{
    {"time", "s", "simulated"},
    {"volume", "m3", "of the region"},
    {"porosity", "", "part of the region that no grain fills; overlaps count twice as grain"},
    {"grains", "", "how many have their centres in the region"},
    {"rattlers", "", "how many of these have at most one contact"},
    {"coordination_number", "",
     "contacts of these grains, those with walls too, over their number"},
    {"coordination_number_without_rattlers", "", "the same of the others"},
    {"contacts", "", "between grains, with their contact points in the region"},
    {"mean_pressure", "Pa", "a third of the trace of the stress, compression above 0"},
    {"deviator_stress", "Pa", "the difference of the principal stresses in a triaxial state"},
    {"stress_xx", "Pa", "mean stress of the region, compression below 0"},
    {"stress_yy", "Pa", "likewise"},
    {"stress_zz", "Pa", "likewise"},
    {"stress_xy", "Pa", "likewise, mean of xy and yx, which are equal at rest"},
    {"stress_xz", "Pa", "likewise"},
    {"stress_yz", "Pa", "likewise"},
    {"stress_asymmetry", "Pa", "largest difference of such a pair"},
    {"fabric_xx", "", "mean of normal x normal of these contacts; a third if isotropic"},
    {"fabric_yy", "", "likewise"},
    {"fabric_zz", "", "likewise"},
    {"fabric_xy", "", "likewise; 0 if isotropic"},
    {"fabric_xz", "", "likewise"},
    {"fabric_yz", "", "likewise"},
}};

std::vector<dynamics::CsvColumn> columns_of_measure() {
  std::vector<dynamics::CsvColumn> columns;
  for (const dynamics::OutputField& field : kMeasureFields)
    columns.push_back({std::string(field.name), std::string(field.unit)});
  return columns;
}

/// By its first columns, which measures of earlier versions have too.
bool is_measure(std::string_view head) {
  return head.starts_with("time (s),volume (m3),porosity,grains,");
}

/// With their folder, if nothing else is in it.
void remove_measures(const fs::path& folder) {
  const std::vector<fs::path> files = measures_in(folder);
  std::error_code ignored;
  for (const fs::path& file : files) fs::remove(file, ignored);
  if (!files.empty()) fs::remove(folder / kMeasuresFolder, ignored);
}

/// Takes away what is outside a container, and moves the middle of what is left to its own.
/// @param middle  m, a point of its axis, or its centre
void narrow(geometry::Region& region, const Vec3& middle, double radius) {
  if (auto* const cylinder = std::get_if<geometry::CylinderRegion>(&region)) {
    const Vec3 axis = (cylinder->to - cylinder->from).normalized();
    const Vec3 way = middle - cylinder->from;
    const Vec3 across = way - way.dot(axis) * axis;
    cylinder->from += across;
    cylinder->to += across;
    cylinder->radius = std::min(cylinder->radius, radius);
  }
  if (auto* const ball = std::get_if<geometry::BallRegion>(&region)) {
    ball->centre = middle;
    ball->radius = std::min(ball->radius, radius);
  }
}

/// Takes away what is behind a plane, on the side of its solid.
void cut(geometry::Box& box, const Vec3& point, const Vec3& normal) {
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  if (normal[axis] > 0.0)
    box.lower[axis] = std::max(box.lower[axis], point[axis]);
  else
    box.upper[axis] = std::min(box.upper[axis], point[axis]);
}

void cut(geometry::CylinderRegion& cylinder, const Vec3& point, const Vec3& normal) {
  const Vec3 axis = (cylinder.to - cylinder.from).normalized();
  Vec3& end = normal.dot(axis) > 0.0 ? cylinder.from : cylinder.to;
  const double way = axis.dot(point - end) * (normal.dot(axis) > 0.0 ? 1.0 : -1.0);
  if (way > 0.0) end += axis.dot(point - end) * axis;
}

std::vector<double> row_of(double time, const dynamics::RegionMeasure& m) {
  const geometry::Mat3& s = m.stress;
  const geometry::Mat3& f = m.fabric;
  return {time,
          m.volume,
          m.porosity,
          static_cast<double>(m.grains),
          static_cast<double>(m.rattlers),
          m.coordination,
          m.coordination_without_rattlers,
          static_cast<double>(m.contacts),
          m.mean_pressure() + 0.0,  // not -0 without contacts
          m.deviator_stress(),
          s(0, 0) + 0.0,
          s(1, 1) + 0.0,
          s(2, 2) + 0.0,
          0.5 * (s(0, 1) + s(1, 0)) + 0.0,
          0.5 * (s(0, 2) + s(2, 0)) + 0.0,
          0.5 * (s(1, 2) + s(2, 1)) + 0.0,
          (s - s.transpose()).cwiseAbs().maxCoeff(),
          f(0, 0),
          f(1, 1),
          f(2, 2),
          f(0, 1),
          f(0, 2),
          f(1, 2)};
}

}  // namespace

std::span<const dynamics::OutputField> measure_fields() {
  return kMeasureFields;
}

std::string file_of(const MeasureSettings& measure) {
  return std::string(kMeasuresFolder) + "/" + measure.name + ".csv";
}

std::vector<fs::path> measures_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder / kMeasuresFolder, ignored))
    if (entry.path().extension() == ".csv" && is_file_of_kind(entry.path(), is_measure))
      files.push_back(entry.path());
  return files;
}

void refuse_other_measures(const fs::path& folder, const Scenario& scenario) {
  for (const MeasureSettings& measure : scenario.output.measures)
    refuse_other_file(folder / file_of(measure), "measure of plekton run", is_measure);
}

geometry::Region region_of(const MeasureSettings& settings, const dynamics::Simulation& simulation,
                           const dynamics::Sample& sample) {
  geometry::Region region = settings.region.value_or(sample.box());
  if (auto* const box = std::get_if<geometry::Box>(&region); box != nullptr && !settings.region) {
    box->lower[2] = std::max(box->lower[2], settings.bottom);
    box->upper[2] = std::min(box->upper[2], settings.top);
  }
  for (const std::size_t plane : settings.planes) {
    if (simulation.planes()[plane].form != contact::Plane::Form::flat) {
      narrow(region, simulation.force_point(plane), simulation.force_radius(plane));
      continue;
    }
    const Vec3 point = simulation.force_point(plane);
    const Vec3& normal = simulation.planes()[plane].normal;
    if (auto* const box = std::get_if<geometry::Box>(&region)) cut(*box, point, normal);
    if (auto* const cylinder = std::get_if<geometry::CylinderRegion>(&region))
      cut(*cylinder, point, normal);
  }
  const auto* const before =
      settings.region ? std::get_if<geometry::CylinderRegion>(&*settings.region) : nullptr;
  if (before == nullptr) return region;
  const auto& now = std::get<geometry::CylinderRegion>(region);
  if ((now.to - now.from).dot(before->to - before->from) > 0.0) return region;
  return geometry::Box{now.from, now.from};
}

Measures::Measures(const fs::path& folder, const Scenario& scenario, const WrittenFiles* before)
    : measures_(scenario.output.measures) {
  if (before == nullptr) remove_measures(folder);
  if (!measures_.empty()) dynamics::ensure_output_folder(folder / kMeasuresFolder);
  for (const MeasureSettings& measure : measures_)
    files_.emplace_back().open(folder, file_of(measure), columns_of_measure(), before);
}

void Measures::add(const dynamics::Simulation& simulation) {
  if (measures_.empty()) return;
  const dynamics::Sample sample(simulation);
  for (std::size_t i = 0; i < measures_.size(); ++i)
    files_[i].add_row(
        row_of(simulation.time(), sample.measure(region_of(measures_[i], simulation, sample))));
}

void Measures::flush() {
  for (HistoryFile& file : files_) file.flush();
}

void Measures::close() {
  for (HistoryFile& file : files_) file.close();
}

void Measures::tell(WrittenFiles& written) const {
  for (const HistoryFile& file : files_) file.tell(written);
}

}  // namespace plekton::apps
