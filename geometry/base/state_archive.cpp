// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/state_archive.hpp"

#include <algorithm>

namespace plekton::geometry {

void StateArchive::operator()(std::string_view name, std::string& text) const {
  std::vector<std::uint8_t> characters(text.begin(), text.end());
  (*this)(name, characters);
  text.assign(characters.begin(), characters.end());
}

bool StateArchive::has(std::string_view name) const {
  return is_reading() && from_->arrays.contains(prefix_ + std::string(name));
}

const StateArray& StateArchive::find(std::string_view name) const {
  const auto found = from_->arrays.find(prefix_ + std::string(name));
  if (found == from_->arrays.end())
    throw StateMismatch("the state has no \"" + prefix_ + std::string(name) + "\"");
  return found->second;
}

void StateArchive::throw_other_kind(std::string_view name) const {
  throw StateMismatch("\"" + prefix_ + std::string(name) +
                      "\" of the state has numbers of another kind or number than expected");
}

void StateArchive::throw_impossible(std::string_view name) const {
  throw StateMismatch(
      "\"" + prefix_ + std::string(name) +
      "\" of the state has numbers that none of this scene can have: it is damaged");
}

void StateArchive::throw_other_count(std::size_t found, std::size_t expected,
                                     std::string_view what) {
  throw StateMismatch("the state has " + std::to_string(found) + " " + std::string(what) +
                      ", here are " + std::to_string(expected));
}

void StateArchive::throw_other(std::string_view what) {
  throw StateMismatch("the state was that of " + std::string(what));
}

RowFields::Column& RowFields::column(std::string_view name, const StateArray& empty) {
  if (next_ == columns_.size())
    columns_.push_back({std::string(name), archive_.is_reading() ? archive_.find(name) : empty, 0});
  Column& of = columns_[next_++];
  if (of.name != name) archive_.throw_other_kind(name);
  return of;
}

void RowFields::numbers(std::string_view name, double* numbers, std::size_t count) {
  double* const at = take<double>(name, 1, count);
  if (is_reading())
    std::copy_n(at, count, numbers);
  else
    std::copy_n(numbers, count, at);
}

void RowFields::throw_too_short(const Column& column) const {
  throw StateMismatch("\"" + archive_.prefix_ + column.name + "\" of the state has " +
                      std::to_string(column.array.size()) + " numbers, fewer than its rows need");
}

void RowFields::finish() {
  for (Column& of : columns_) {
    if (!archive_.is_reading())
      archive_.to_->arrays[archive_.prefix_ + of.name] = std::move(of.array);
    else if (of.used != of.array.size())
      archive_.throw_other_kind(of.name);
  }
}

}  // namespace plekton::geometry
