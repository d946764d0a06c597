// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/study/run_key.hpp"

#include "apps/run/build_info.hpp"
#include "apps/scenario/overrides.hpp"
#include "apps/scenario/toml_file.hpp"
#include "apps/study/value_text.hpp"
#include "geometry/base/bit_hash.hpp"
#include "geometry/base/regular_file.hpp"
#include "geometry/version.hpp"

#include <fmt/format.h>
#include <link.h>

#include <algorithm>
#include <cstdint>
#include <system_error>
#include <vector>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

std::string hash_of(std::string_view bytes) {
  geometry::BitHash hash;
  hash.add(std::uint64_t{bytes.size()});
  for (std::size_t at = 0; at < bytes.size(); at += 8) {
    std::uint64_t word = 0;
    for (std::size_t i = at; i < std::min(at + 8, bytes.size()); ++i)
      word = word << 8U | static_cast<unsigned char>(bytes[i]);
    hash.add(word);
  }
  return fmt::format("{:016x}", hash.value());
}

std::string hash_of_file(const fs::path& file) {
  try {
    return hash_of(geometry::read_regular_file(file, "a file that the scenario names"));
  } catch (const geometry::UnreadableFile& error) {
    throw InputError(error.what());
  }
}

int add_library(dl_phdr_info* library, std::size_t /*size*/, void* files) {
  if (fs::path(library->dlpi_name).filename().string().starts_with("libplekton"))
    static_cast<std::vector<fs::path>*>(files)->emplace_back(library->dlpi_name);
  return 0;
}

/// Of the bytes of this program and of the libraries of the project that it has loaded.
std::string hash_of_program() {
  std::vector<fs::path> files;
  ::dl_iterate_phdr(add_library, &files);
  std::sort(files.begin(), files.end());
  std::error_code ignored;
  files.push_back(fs::read_symlink("/proc/self/exe", ignored));
  std::string hashes;
  for (const fs::path& file : files) hashes += hash_of_file(file);
  return hash_of(hashes);
}

std::string description_of_build() {
  const BuildInfo build = build_info();
  std::string text = fmt::format("plekton {} {} {}\n", kVersion, build.revision, build.compiler);
  const bool tells_sources = !build.revision.ends_with("-modified") && build.revision != kVersion;
  return tells_sources ? text : text + hash_of_program() + '\n';
}

/// The result does not depend on the number of threads.
void remove_threads(Table& root) {
  Entry* const simulation = root.find("simulation");
  auto* const table = simulation ? std::get_if<Table>(&simulation->value.data) : nullptr;
  if (table != nullptr)
    std::erase_if(table->entries, [](const Entry& entry) { return entry.key == "threads"; });
}

}  // namespace

RunKeys::RunKeys(fs::path scenario)
    : scenario_(std::move(scenario)), build_(description_of_build()) {}

const std::string& RunKeys::hash_of_file(const std::string& name) {
  const auto [found, is_new] = files_.try_emplace(name);
  const fs::path path = scenario_.parent_path() / name;
  if (std::error_code ignored; is_new && fs::is_regular_file(path, ignored))
    found->second = apps::hash_of_file(path);
  return found->second;
}

void RunKeys::add_files(const Value& value, std::string& description) {
  if (const auto* text = std::get_if<std::string>(&value.data)) {
    const std::string& hash = hash_of_file(*text);
    if (!hash.empty()) description += fmt::format("{} {}\n", *text, hash);
  } else if (const auto* array = std::get_if<Array>(&value.data)) {
    for (const Value& item : *array) add_files(item, description);
  } else if (const auto* table = std::get_if<Table>(&value.data)) {
    for (const Entry& entry : table->entries) add_files(entry.value, description);
  }
}

std::string RunKeys::key_of(std::string_view text, std::span<const std::string> overrides) {
  Table root = parse_toml(text, scenario_.string());
  apply_overrides(root, overrides);
  remove_threads(root);
  const Value value{{}, std::move(root)};
  std::string description = build_ + toml_text(value) + '\n';
  add_files(value, description);
  return hash_of(description);
}

}  // namespace plekton::apps
