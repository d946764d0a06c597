// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/set_paths.hpp"

#include "apps/scenario/key_list.hpp"

#include <fmt/format.h>

#include <map>
#include <set>

namespace plekton::apps {
namespace {

using Chosen = std::map<std::string, std::string>;

/// A text in a table; empty if there is none.
std::string text_in(const Table& table, std::string_view key) {
  const Entry* entry = table.find(key);
  const auto* text = entry ? std::get_if<std::string>(&entry->value.data) : nullptr;
  return text ? *text : "";
}

bool is_plain_word(const std::string& text) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  return !text.empty() && text.find_first_not_of(kPlain) == std::string::npos;
}

/// Goes down the tables of a scenario beside the keys that the reader knows.
class PathCollector {
 public:
  /// @param known  path of the table among the known keys, as in "loads[]."
  /// @param path   the same in this scenario, as in "loads.top."
  void add_table(const Table& table, const std::string& known, const std::string& path) {
    const Chosen chosen = chosen_in(table, known);
    std::set<std::string> parts;
    for (const ListedKey& key : listed_keys(chosen)) {
      if (!key.path.starts_with(known)) continue;
      const std::string rest = key.path.substr(known.size());
      const std::size_t dot = rest.find('.');
      if (dot == std::string::npos)
        paths_.push_back(path + rest);
      else if (parts.insert(rest.substr(0, dot)).second)
        add_part(table, rest.substr(0, dot), known, path);
    }
  }

  std::vector<std::string> paths() && { return std::move(paths_); }

 private:
  /// Words of the table that its other keys go by, beside those of the tables around it.
  Chosen chosen_in(const Table& table, const std::string& known) {
    for (const std::string_view key : {"kind", "law"}) {
      if (const std::string word = text_in(table, key); !word.empty())
        chosen_[known + std::string(key)] = word;
      else
        chosen_.erase(known + std::string(key));
    }
    return chosen_;
  }

  void add_part(const Table& table, const std::string& part, const std::string& known,
                const std::string& path) {
    if (part == "NAME") {
      for (const Entry& entry : table.entries) {
        const auto* inner = std::get_if<Table>(&entry.value.data);
        if (inner && is_plain_word(entry.key))
          add_table(*inner, known + "NAME.", path + entry.key + '.');
      }
      return;
    }
    const bool is_list = part.ends_with("[]");
    const std::string key = is_list ? part.substr(0, part.size() - 2) : part;
    const Entry* entry = table.find(key);
    if (entry == nullptr) return;
    if (const auto* inner = std::get_if<Table>(&entry->value.data))
      add_table(*inner, known + part + '.', path + key + '.');
    const auto* list = std::get_if<Array>(&entry->value.data);
    for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
      const auto* inner = std::get_if<Table>(&(*list)[i].data);
      if (inner == nullptr) continue;
      const std::string name = text_in(*inner, "name");
      add_table(*inner, known + part + '.',
                fmt::format("{}{}.{}.", path, key, is_plain_word(name) ? name : std::to_string(i)));
    }
  }

  Chosen chosen_;
  std::vector<std::string> paths_;
};

}  // namespace

std::vector<std::string> set_paths(const Table& scenario) {
  PathCollector collector;
  collector.add_table(scenario, "", "");
  return std::move(collector).paths();
}

}  // namespace plekton::apps
