// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/viewer/page.hpp"

#include "apps/run/other_file.hpp"
#include "apps/viewer/view_error.hpp"
#include "apps/viewer/viewer_files.hpp"
#include "dynamics/output/file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPlaceOfRun = "<!--plekton:run-->";

std::string joined(std::span<const std::string_view> pieces) {
  std::string text;
  for (const std::string_view piece : pieces) text += piece;
  return text;
}

/// The page before and behind the place of the run.
std::pair<std::string, std::string> page_halves() {
  const std::string page = joined(viewer_html());
  const std::size_t place = page.find(kPlaceOfRun);
  return {page.substr(0, place), page.substr(place + kPlaceOfRun.size())};
}

/// A script element that is not run. Its text holds no "<".
std::string element(std::string_view type, std::string_view id, std::string_view text) {
  return fmt::format("<script type=\"{}\" id=\"{}\">{}</script>\n", type, id, text);
}

std::string code_element() {
  return element("text/plain", "plekton-code", deflated_text(joined(viewer_code())));
}

std::string without_tags(std::string json) {
  for (std::size_t at = json.find('<'); at != std::string::npos; at = json.find('<', at))
    json.replace(at, 1, "\\u003c");
  return json;
}

/// Every so many frames, and the last one.
PackedRun packed_every(const RunFolder& run, std::size_t step, std::size_t limit) {
  PackedRun packed;
  packed.set_histories(read_histories(run.folder));
  const std::size_t count = run.frames.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (i % step != 0 && i + 1 != count) continue;
    packed.add(run.frames[i], planes_at(run, run.frames[i].time));
    if (packed.size() > limit && packed.frames() > 1 && step < count) break;
  }
  return packed;
}

/// How many frames every so many of a number are, with the last one.
std::size_t taken(std::size_t count, std::size_t step) {
  return (count + step - 1) / step + ((count - 1) % step != 0 ? 1 : 0);
}

}  // namespace

std::string every(std::size_t step) {
  if (step == 2) return "every second";
  if (step == 3) return "every third";
  return fmt::format("every {}th", step);
}

PageData pack_run(const RunFolder& run, std::size_t limit) {
  const std::size_t count = run.frames.size();
  if (count == 0)
    throw ViewError(run.folder.string() +
                    ": the run has no frames; ask for grains, membranes or contacts in [output]");
  PageData data;
  std::size_t step = 1;
  while (true) {
    data.packed = packed_every(run, step, limit);
    const std::size_t done = data.packed.frames(), wanted = taken(count, step);
    if (data.packed.size() <= limit || step >= count) break;
    // About as many as fit, and always fewer than before.
    const double share = static_cast<double>(limit) / static_cast<double>(data.packed.size()) *
                         static_cast<double>(done) / static_cast<double>(wanted);
    const double enough = static_cast<double>(step) / std::max(share, 1e-6);
    step = std::min(count, std::max(step + 1, static_cast<std::size_t>(enough)));
  }
  if (step > 1)
    data.notes.push_back(fmt::format(
        "{} of {} frames are shown, {} and the last: all would be more than the limit of "
        "{:g} MB (--limit)",
        data.packed.frames(), count, every(step), 1e-6 * static_cast<double>(limit)));
  if (const std::size_t rows = data.packed.history_step(); rows > 1)
    data.notes.push_back(fmt::format("of the longest history {} row is shown", every(rows)));
  if (!run.report)
    data.notes.push_back("the run has not ended, or was broken off: there is no run.json");
  return data;
}

std::size_t write_page(const fs::path& file, const RunFolder& run, const PageData& data) {
  refuse_other_file(file, "page of plekton view", is_page);
  const auto [before, behind] = page_halves();
  const auto header = data.packed.header(run, data.notes);
  std::size_t size = 0;
  dynamics::OutputFile out(file);
  const auto write = [&](const std::string& text) {
    out.write(text);
    size += text.size();
  };
  write(before);
  // A path need not be UTF-8; what is not becomes a replacement character.
  write(element(
      "application/json", "plekton-run",
      without_tags(header.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace))));
  for (const auto& [name, text] : data.packed.blocks())
    write(element("text/plain", "block-" + name, text));
  write(code_element());
  write(behind);
  out.commit();
  return size;
}

std::string live_page() {
  const auto [before, behind] = page_halves();
  return before + element("application/json", "plekton-live", "{}") + code_element() + behind;
}

}  // namespace plekton::apps
