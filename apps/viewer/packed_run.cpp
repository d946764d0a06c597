// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/viewer/packed_run.hpp"

#include "apps/viewer/view_error.hpp"
#include "dynamics/output/contact_fields.hpp"
#include "dynamics/output/frame_fields.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <span>

namespace plekton::apps {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostRows = 4000;  // of a history: more than a wide screen has columns
constexpr std::size_t kMostNumbers = 1'000'000;  // of a history: some 3 MB of text
constexpr std::size_t kFramesOfAKey = 8;  // what a page reads beside a frame, for a sixth less room
/// Positions are kept in single precision where a step of 1/65536 of the box were more than this
/// share of the smallest radius.
constexpr double kCoarsestStep = 0.05;

/// Fields that only lines or only facets have; they are 0 of the others.
constexpr std::array kOfLines = {
    dynamics::frame_fields::kTension.name, dynamics::frame_fields::kAxialStress.name,
    dynamics::frame_fields::kBendingStress.name, dynamics::frame_fields::kTorsionStress.name};
constexpr std::array kOfFacets = {
    dynamics::frame_fields::kLargest.name, dynamics::frame_fields::kSmallest.name,
    dynamics::frame_fields::kPressure.name, dynamics::frame_fields::kShear.name};
/// What a page finds out by itself, or would need much room for little.
constexpr std::array<std::string_view, 11> kNotOfContacts = {
    "id",           "normal",           "point",   "feature_a",  "feature_b",
    "normal_force", "tangential_force", "group_a", "material_a", "group_b",
    "material_b"};

template <class Names>
bool is_in(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The field of a series; nothing of an array that plekton does not write.
std::optional<dynamics::OutputField> field_of(std::string_view series, std::string_view on,
                                              std::string_view name) {
  const auto find = [&](const auto& fields) -> std::optional<dynamics::OutputField> {
    for (const dynamics::OutputField& field : fields)
      if (field.name == name) return field;
    return std::nullopt;
  };
  if (series == "grains") return find(dynamics::frame_fields::kOfGrains);
  if (series == "contacts") return find(dynamics::contact_fields());
  return on == "nodes" ? find(dynamics::frame_fields::kOfNodes)
                       : find(dynamics::frame_fields::kOfCells);
}

constexpr std::array<std::string_view, 11> kWhole = {
    "id",     "grains", "material", "node",      "membrane",   "kind_a",
    "kind_b", "body_a", "body_b",   "is_bonded", "is_slipping"};

double length_of(const double* vector) {
  return std::sqrt(vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]);
}

ResultArray magnitudes(const ResultArray& array) {
  if (array.components != 3) return array;
  ResultArray lengths{array.name, 1, {}};
  for (std::size_t i = 0; i < array.values.size(); i += 3)
    lengths.values.push_back(length_of(&array.values[i]));
  return lengths;
}

/// The tuples from one on to another.
ResultArray part_of(const ResultArray& array, std::size_t begin, std::size_t end) {
  const auto at = [&](std::size_t i) {
    return array.values.begin() + static_cast<std::ptrdiff_t>(i * array.components);
  };
  return {array.name, array.components, std::vector<double>(at(begin), at(end))};
}

const ResultArray* find_array(const std::vector<ResultArray>& arrays, std::string_view name) {
  for (const ResultArray& array : arrays)
    if (array.name == name) return &array;
  return nullptr;
}

double smallest_radius(const std::vector<ResultArray>& arrays) {
  const ResultArray* radii = find_array(arrays, "radius");
  if (!radii || radii->values.empty()) return 0.0;
  return *std::min_element(radii->values.begin(), radii->values.end());
}

double middle_of(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// A name by which a page may ask for a block.
std::string block_name(std::size_t frame) {
  return std::to_string(frame);
}

}  // namespace

/// Stores bytes, or names the place where the same ones are already.
Json PackedRun::stored(Block& block, const PackedNumbers& numbers) const {
  const auto* bytes = reinterpret_cast<const Bytef*>(numbers.bytes.data());
  const Print print{
      numbers.bytes.size(), std::hash<std::string>{}(numbers.bytes),
      static_cast<std::uint32_t>(crc32(0, bytes, static_cast<uInt>(numbers.bytes.size())))};
  auto found = places_.find(print);
  if (found == places_.end()) {
    found = block.places.find(print);
    if (found == block.places.end()) {
      const std::string text = deflated_text(numbers.bytes, width_of(numbers.type));
      found =
          block.places.emplace(print, Place{block.name, block.chunks.size(), text.size()}).first;
      block.chunks += text;
    }
  }
  const auto& [name, place, length] = found->second;
  return {name, place, length};
}

namespace {

/// What tells an array of these numbers, but for its place.
Json record_of(const ResultArray& array, std::string_view on, const PackedNumbers& numbers) {
  Json record = {{"name", array.name},
                 {"on", on},
                 {"components", array.components},
                 {"count", array.values.size() / array.components},
                 {"type", name_of(numbers.type)}};
  if (numbers.type == NumberType::u16) {
    record["lo"] = numbers.low;
    record["hi"] = numbers.high;
  }
  if (numbers.type == NumberType::f16) record["scale"] = numbers.scale;
  return record;
}

/// Places in steps of their box, or in single precision where that were too coarse.
NumberType type_of_places(const std::vector<double>& places, double smallest_radius) {
  double widest = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double low = 0.0, high = 0.0;
    for (std::size_t i = axis; i < places.size(); i += 3) {
      low = i == axis ? places[i] : std::min(low, places[i]);
      high = i == axis ? places[i] : std::max(high, places[i]);
    }
    widest = std::max(widest, high - low);
  }
  return widest / 65535.0 <= kCoarsestStep * smallest_radius ? NumberType::u16 : NumberType::f32;
}

}  // namespace

Json PackedRun::packed(Block& block, const ResultArray& array, std::string_view on,
                       NumberType type) const {
  const PackedNumbers numbers = pack_numbers(array.values, array.components, type);
  Json record = record_of(array, on, numbers);
  record["at"] = stored(block, numbers);
  return record;
}

Json PackedRun::packed_places(Block& block, const ResultArray& places, std::string_view on,
                              double smallest_radius) const {
  const NumberType type = type_of_places(places.values, smallest_radius);
  if (type != NumberType::u16) return packed(block, places, on, type);
  const auto key = keys_.find(std::string(on));
  if (key != keys_.end() && frames_.size() < key->second.frame + kFramesOfAKey) {
    const PackedNumbers& before = key->second.numbers;
    if (auto ways = pack_ways(places.values, places.components, before)) {
      PackedNumbers numbers{type, std::move(*ways), before.low, before.high, 1.0, {}};
      Json record = record_of(places, on, numbers);
      record["at"] = stored(block, numbers);
      record["key"] = key->second.at;
      return record;
    }
  }
  PackedNumbers numbers = pack_numbers(places.values, places.components, type);
  Json record = record_of(places, on, numbers);
  record["at"] = stored(block, numbers);
  block.keys[std::string(on)] = {std::move(numbers), record["at"], frames_.size()};
  return record;
}

void PackedRun::note(std::string_view series, const ResultArray& array, std::string_view on) {
  const std::array<std::string, 3> key = {std::string(series), array.name, std::string(on)};
  auto found = std::find_if(fields_.begin(), fields_.end(),
                            [&](const auto& field) { return field.first == key; });
  if (found == fields_.end()) {
    FieldRange field;
    if (const auto known = field_of(series, on, array.name)) {
      field.unit = known->unit;
      field.what = known->what;
    }
    field.components = array.components;
    field.is_whole = is_in(kWhole, array.name);
    fields_.emplace_back(key, std::move(field));
    found = fields_.end() - 1;
  }
  std::vector<double> sizes = magnitudes(array).values;
  std::erase_if(sizes, [](double x) { return !std::isfinite(x); });
  if (sizes.empty()) return;
  FieldRange& field = found->second;
  const auto [lowest, highest] = std::minmax_element(sizes.begin(), sizes.end());
  field.lowest = field.is_empty ? *lowest : std::min(field.lowest, *lowest);
  field.highest = field.is_empty ? *highest : std::max(field.highest, *highest);
  field.is_empty = false;
  const auto percent = static_cast<std::ptrdiff_t>(sizes.size() / 100);
  std::nth_element(sizes.begin(), sizes.begin() + percent, sizes.end());
  field.low.push_back(sizes[static_cast<std::size_t>(percent)]);
  std::nth_element(sizes.begin(), sizes.end() - 1 - percent, sizes.end());
  field.high.push_back(*(sizes.end() - 1 - percent));
}

void PackedRun::add_array(Block& block, std::string_view series, const ResultArray& array,
                          std::string_view on) {
  const NumberType type = is_in(kWhole, array.name) ? NumberType::i32
                          : array.name == "radius"  ? NumberType::f32
                                                    : NumberType::f16;
  block.directory[std::string(series)].push_back(packed(block, array, on, type));
  note(series, array, on);
}

void PackedRun::add_grains(Block& block, const Results& results) {
  smallest_radius_ = smallest_radius(results.of_points);
  block.directory["grains"].push_back(
      packed_places(block, {"position", 3, results.positions}, "grains", smallest_radius_));
  for (const ResultArray& array : results.of_points)
    add_array(block, "grains", array.name == "velocity" ? array : magnitudes(array), "grains");
}

void PackedRun::add_membranes(Block& block, const Results& results) {
  const double radius = smallest_radius(results.of_cells);
  smallest_radius_ = smallest_radius_ > 0.0 ? std::min(smallest_radius_, radius) : radius;
  Json& directory = block.directory["membranes"];
  directory.push_back(packed_places(block, {"position", 3, results.positions}, "nodes", radius));
  directory.push_back(packed(block, {"nodes", 2, results.line_ends}, "edges", NumberType::i32));
  directory.push_back(packed(block, {"nodes", 3, results.corners}, "facets", NumberType::i32));
  for (const ResultArray& array : results.of_points)
    add_array(block, "membranes", magnitudes(array), "nodes");
  for (const ResultArray& array : results.of_cells) {
    const ResultArray values = magnitudes(array);
    const std::size_t cells = results.lines + results.polygons;
    if (!is_in(kOfFacets, array.name) && results.lines > 0)
      add_array(block, "membranes", part_of(values, 0, results.lines), "edges");
    if (!is_in(kOfLines, array.name) && results.polygons > 0)
      add_array(block, "membranes", part_of(values, results.lines, cells), "facets");
  }
}

void PackedRun::add_contacts(Block& block, const Results& results) {
  const ResultArray* kind_a = find_array(results.of_cells, "kind_a");
  const ResultArray* kind_b = find_array(results.of_cells, "kind_b");
  const ResultArray* point = find_array(results.of_cells, "point");
  if (kind_a && kind_b && point && point->components == 3) {
    ResultArray places{"point", 3, {}};
    for (std::size_t i = 0; i < results.lines; ++i) {
      if (kind_a->values[i] == 0.0 && kind_b->values[i] == 0.0) continue;
      for (std::size_t k = 0; k < 3; ++k) places.values.push_back(point->values[3 * i + k]);
    }
    block.directory["contacts"].push_back(
        packed(block, places, "places", type_of_places(places.values, smallest_radius_)));
  }
  for (const ResultArray& array : results.of_cells)
    if (!is_in(kNotOfContacts, array.name))
      add_array(block, "contacts", magnitudes(array), "contacts");
}

void PackedRun::add(const FrameFiles& files, const std::vector<PlaneNumbers>& planes) {
  std::array<std::optional<Results>, kSeries.size()> results;
  for (std::size_t series = 0; series < kSeries.size(); ++series)
    if (!files.of[series].empty()) results[series] = read_results(files.of[series]);

  Block block;
  block.name = block_name(frames_.size());
  Json frame = {{"time", files.time}, {"block", block.name}};
  smallest_radius_ = 0.0;
  if (const auto& grains = results[0]) {
    add_grains(block, *grains);
    frame["grains"] = grains->points;
  }
  if (const auto& membranes = results[1]) {
    add_membranes(block, *membranes);
    frame["nodes"] = membranes->points;
    frame["edges"] = membranes->lines;
    frame["facets"] = membranes->polygons;
  }
  if (const auto& contacts = results[2]) {
    add_contacts(block, *contacts);
    frame["contacts"] = contacts->lines;
  }
  if (!planes.empty()) frame["planes"] = planes;
  finish(std::move(block));
  frames_.push_back(std::move(frame));
}

void PackedRun::finish(Block&& block) {
  places_.merge(block.places);
  for (auto& [on, key] : block.keys) keys_[on] = std::move(key);
  std::string text =
      deflated_text(block.directory.dump(-1, ' ', false, Json::error_handler_t::replace)) + '.' +
      block.chunks;
  size_ += text.size();
  blocks_.emplace_back(std::move(block.name), std::move(text));
}

void PackedRun::set_histories(const std::vector<RecordedHistory>& histories) {
  if (histories.empty()) return;
  Block block;
  block.name = 'h' + std::to_string(history_blocks_++);
  block.directory = Json::array();
  history_step_ = 1;
  for (const RecordedHistory& history : histories) {
    const std::size_t most =
        std::clamp<std::size_t>(kMostNumbers / history.columns.size(), 1, kMostRows);
    const std::size_t step = (history.rows() + most - 1) / most;
    history_step_ = std::max(history_step_, step);
    Json columns = Json::array();
    for (const RecordedHistory::Column& column : history.columns) {
      ResultArray kept{column.name, 1, {}};
      for (std::size_t row = 0; row < history.rows(); row += step)
        kept.values.push_back(column.values[row]);
      if ((history.rows() - 1) % step != 0) kept.values.push_back(column.values.back());
      const bool is_time = columns.empty();
      Json record = packed(block, kept, "rows", is_time ? NumberType::f64 : NumberType::f32);
      record["unit"] = column.unit;
      columns.push_back(std::move(record));
    }
    block.directory.push_back({{"file", history.file}, {"columns", std::move(columns)}});
  }
  if (!history_block_.empty()) {
    // A page that still shows those of before has read them.
    const auto before = std::find_if(blocks_.begin(), blocks_.end(),
                                     [&](const auto& b) { return b.first == history_block_; });
    size_ -= before->second.size();
    blocks_.erase(before);
  }
  history_block_ = block.name;
  // Frames do not name arrays of histories, which are replaced as the run goes on.
  block.places.clear();
  finish(std::move(block));
}

Json PackedRun::header(const RunFolder& run, const std::vector<std::string>& notes) const {
  Json fields = Json::object();
  for (const auto& [key, field] : fields_) {
    if (field.is_empty) continue;
    const auto& [series, name, on] = key;
    fields[series].push_back({{"name", name},
                              {"on", on},
                              {"components", field.components},
                              {"unit", field.unit},
                              {"what", field.what},
                              {"whole", field.is_whole},
                              {"range", {field.lowest, field.highest}},
                              {"usual",
                               {*std::min_element(field.low.begin(), field.low.end()),
                                *std::max_element(field.high.begin(), field.high.end())}},
                              {"typical", {middle_of(field.low), middle_of(field.high)}}});
  }
  Json report = run.report ? Json(*run.report) : Json(nullptr);
  if (report.is_object()) report.erase("states");
  return {{"format", 1},
          {"title", run.title},
          {"run", std::move(report)},
          {"notes", notes},
          {"frames", frames_},
          {"fields", std::move(fields)},
          {"histories", history_block_}};
}

}  // namespace plekton::apps
