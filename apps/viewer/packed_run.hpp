// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/viewer/packing.hpp"
#include "apps/viewer/read_results.hpp"
#include "apps/viewer/run_folder.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace plekton::apps {

/// What the values of a field were so far, for its colours.
struct FieldRange {
  std::string unit;
  std::string what;
  std::size_t components = 1;
  bool is_whole = false;  ///< numbers of things: no unit, and a colour for each
  bool is_empty = true;
  double lowest = 0.0, highest = 0.0;  ///< magnitudes of vectors
  std::vector<double> low, high;       ///< of each frame: the lowest and highest percent left out
};

/// The frames of a run as the text of a page: a header that says what there is, and a block for
/// each frame. A block is a directory (deflated JSON in base64), a point, and the arrays that it
/// names, each deflated, in base64, one after the other:
///
///     {"grains": [{"name", "on", "components", "count", "type", ..., "at": [block, place, length]}]}
///
/// An array that is the same as one before is stored once and named twice; so connectivity, radii
/// and materials cost nothing after the first frame. Positions are those of every eighth frame at
/// least, and of the others the ways from there: "key" is then where the earlier ones are. Of vectors but the velocities of grains the
/// magnitudes are kept, and of contacts between two spheres no points: they are on the line between
/// the centres.
class PackedRun {
 public:
  /// Adds a frame, later than those before.
  /// @throws ViewError if it cannot be read; the run is then as before
  void add(const FrameFiles& files, const std::vector<PlaneNumbers>& planes);

  /// Replaces the histories. Of more rows than a plot can show every so many are kept.
  void set_histories(const std::vector<RecordedHistory>& histories);

  /// Everything a page needs to know before it reads a block.
  nlohmann::ordered_json header(const RunFolder& run, const std::vector<std::string>& notes) const;

  std::size_t frames() const noexcept { return frames_.size(); }
  std::size_t size() const noexcept { return size_; }  ///< bytes of all blocks
  /// By name, in the order in which they were made. Names are of digits and letters.
  const std::vector<std::pair<std::string, std::string>>& blocks() const noexcept {
    return blocks_;
  }
  /// Every how many rows of histories were kept; 1: all.
  std::size_t history_step() const noexcept { return history_step_; }

 private:
  using Json = nlohmann::ordered_json;
  using Print = std::tuple<std::size_t, std::size_t, std::uint32_t>;  ///< of bytes, to find equals
  using Place = std::tuple<std::string, std::size_t, std::size_t>;    ///< block, place, length

  /// Positions of which later ones tell the ways.
  struct Key {
    PackedNumbers numbers;
    Json at;
    std::size_t frame = 0;
  };

  /// A block that is being made.
  struct Block {
    std::string name;
    Json directory = Json::object();
    std::string chunks;
    std::map<Print, Place> places;
    std::map<std::string, Key> keys;
  };

  Json packed(Block& block, const ResultArray& array, std::string_view on, NumberType type) const;
  Json packed_places(Block& block, const ResultArray& places, std::string_view on,
                     double smallest_radius) const;
  Json stored(Block& block, const PackedNumbers& numbers) const;
  void add_array(Block& block, std::string_view series, const ResultArray& array,
                 std::string_view on);
  void add_grains(Block& block, const Results& results);
  void add_membranes(Block& block, const Results& results);
  void add_contacts(Block& block, const Results& results);
  void note(std::string_view series, const ResultArray& array, std::string_view on);
  void finish(Block&& block);

  std::vector<Json> frames_;
  std::vector<std::pair<std::string, std::string>> blocks_;
  std::size_t size_ = 0;
  std::map<Print, Place> places_;
  std::map<std::string, Key> keys_;  ///< by what the positions are of
  /// By series and name; in the order in which they came.
  std::vector<std::pair<std::array<std::string, 3>, FieldRange>> fields_;
  double smallest_radius_ = 0.0;  ///< m, of the part that is being packed
  std::string history_block_;
  std::size_t history_blocks_ = 0;
  std::size_t history_step_ = 1;
};

}  // namespace plekton::apps
