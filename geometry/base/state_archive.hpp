// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/state_tree.hpp"
#include "geometry/base/types.hpp"

#include <array>
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

/// How classes hand their state out and take it back: each names its members once, in one function
/// for both ways, so that what is written is what is read.
///
///     void Skin::exchange(StateArchive archive) {
///       archive("skin", skin_);
///       archive("built_positions", built_positions_);
///     }
namespace plekton::geometry {

/// What a thing is as numbers.
template <class Thing>
struct NumbersOf;

template <class Kept, std::size_t kCount>
struct NumbersAs {
  using Number = Kept;
  static constexpr std::size_t count = kCount;
};

template <>
struct NumbersOf<double> : NumbersAs<double, 1> {
  static void put(double thing, double* to) noexcept { *to = thing; }
  static void get(const double* from, double& thing) noexcept { thing = *from; }
};

/// Counts and sizes as 64 bits, indices and ids as 32, flags as 8.
template <class Thing>
requires std::integral<Thing> || std::is_enum_v<Thing>
struct NumbersOf<Thing>
    : NumbersAs<
          std::conditional_t<sizeof(Thing) == 1, std::uint8_t,
                             std::conditional_t<sizeof(Thing) == 4, std::int32_t, std::int64_t>>,
          1> {
  using Number = typename NumbersOf::NumbersAs::Number;
  static void put(Thing thing, Number* to) noexcept { *to = static_cast<Number>(thing); }
  static void get(const Number* from, Thing& thing) noexcept { thing = static_cast<Thing>(*from); }
};

template <>
struct NumbersOf<Vec3> : NumbersAs<double, 3> {
  static void put(const Vec3& thing, double* to) noexcept {
    for (int i = 0; i < 3; ++i) to[i] = thing[i];
  }
  static void get(const double* from, Vec3& thing) noexcept {
    for (int i = 0; i < 3; ++i) thing[i] = from[i];
  }
};

/// x, y, z, w.
template <>
struct NumbersOf<Quat> : NumbersAs<double, 4> {
  static void put(const Quat& thing, double* to) noexcept {
    for (int i = 0; i < 4; ++i) to[i] = thing.coeffs()[i];
  }
  static void get(const double* from, Quat& thing) noexcept {
    for (int i = 0; i < 4; ++i) thing.coeffs()[i] = from[i];
  }
};

template <class Thing, std::size_t kSize>
struct NumbersOf<std::array<Thing, kSize>>
    : NumbersAs<typename NumbersOf<Thing>::Number, kSize * NumbersOf<Thing>::count> {
  using Number = typename NumbersOf<Thing>::Number;
  static void put(const std::array<Thing, kSize>& things, Number* to) noexcept {
    for (std::size_t i = 0; i < kSize; ++i)
      NumbersOf<Thing>::put(things[i], to + i * NumbersOf<Thing>::count);
  }
  static void get(const Number* from, std::array<Thing, kSize>& things) noexcept {
    for (std::size_t i = 0; i < kSize; ++i)
      NumbersOf<Thing>::get(from + i * NumbersOf<Thing>::count, things[i]);
  }
};

/// Writes members into a StateTree, or reads them from one. Copies are of the same tree.
class StateArchive {
 public:
  /// @param tree  outlives this
  static StateArchive writer(StateTree& tree) { return StateArchive(&tree, nullptr, ""); }
  static StateArchive reader(const StateTree& tree) { return StateArchive(nullptr, &tree, ""); }

  bool is_reading() const noexcept { return to_ == nullptr; }

  /// Whether the state that is read has an array: one that is not always written.
  bool has(std::string_view name) const;

  /// For what belongs to a member.
  StateArchive group(std::string_view name) const {
    return StateArchive(to_, from_, prefix_ + std::string(name) + "/");
  }

  /// One number or a few. @throws StateMismatch if there are none of this kind
  template <class Thing>
  void operator()(std::string_view name, Thing& thing) const {
    using Numbers = NumbersOf<Thing>;
    if (is_reading())
      Numbers::get(read<typename Numbers::Number>(name, Numbers::count, 1).data(), thing);
    else
      Numbers::put(thing, write<typename Numbers::Number>(name, Numbers::count, 1).data());
  }

  /// Any number of things.
  template <class Thing>
  void operator()(std::string_view name, std::vector<Thing>& things) const {
    using Numbers = NumbersOf<Thing>;
    using Number = typename Numbers::Number;
    if (is_reading()) {
      const std::vector<Number>& from = read<Number>(name, Numbers::count, kAnyNumber);
      things.resize(from.size() / Numbers::count);
      for (std::size_t i = 0; i < things.size(); ++i) {
        Thing thing{};
        Numbers::get(&from[i * Numbers::count], thing);
        things[i] = thing;
      }
    } else {
      std::vector<Number>& to = write<Number>(name, Numbers::count, things.size());
      for (std::size_t i = 0; i < things.size(); ++i)
        Numbers::put(things[i], &to[i * Numbers::count]);
    }
  }

  /// The characters of a text.
  void operator()(std::string_view name, std::string& text) const;

  /// As many things as there are here. @throws StateMismatch, with what they are, if the state has
  /// another number of them
  template <class Thing>
  void fixed(std::string_view name, std::vector<Thing>& things, std::string_view what) const {
    const std::size_t count = things.size();
    (*this)(name, things);
    if (things.size() != count) throw_other_count(things.size(), count, what);
  }

  /// Refuses a state that is read, by the name of an array, unless its numbers can be.
  /// @throws StateMismatch
  void require(bool holds, std::string_view name) const {
    if (is_reading() && !holds) throw_impossible(name);
  }

  /// Something that has to be the same: written, and compared when read. @throws StateMismatch with
  /// what it is
  template <class Thing>
  void same(std::string_view name, const Thing& thing, std::string_view what) const {
    Thing kept = thing;
    (*this)(name, kept);
    if (!(kept == thing)) throw_other(what);
  }

  /// One thing after the other by its members: fields(row, thing) calls row(name, member) for each
  /// of them, always in the same order.
  template <class Thing, class Fields>
  void rows(std::string_view name, std::vector<Thing>& things, Fields&& fields) const;

 private:
  friend class RowFields;
  static constexpr std::size_t kAnyNumber = static_cast<std::size_t>(-1);

  StateArchive(StateTree* to, const StateTree* from, std::string prefix)
      : to_(to), from_(from), prefix_(std::move(prefix)) {}

  template <class Number>
  std::vector<Number>& write(std::string_view name, std::size_t columns, std::size_t rows) const {
    StateArray& array = to_->arrays[prefix_ + std::string(name)];
    array = {std::vector<Number>(columns * rows), columns};
    return std::get<std::vector<Number>>(array.numbers);
  }
  template <class Number>
  const std::vector<Number>& read(std::string_view name, std::size_t columns,
                                  std::size_t rows) const {
    const StateArray& array = find(name);
    const auto* const numbers = std::get_if<std::vector<Number>>(&array.numbers);
    if (!numbers || array.columns != columns || (rows != kAnyNumber && array.rows() != rows))
      throw_other_kind(name);
    return *numbers;
  }
  const StateArray& find(std::string_view name) const;
  [[noreturn]] void throw_other_kind(std::string_view name) const;
  [[noreturn]] void throw_impossible(std::string_view name) const;
  [[noreturn]] static void throw_other_count(std::size_t found, std::size_t expected,
                                             std::string_view what);
  [[noreturn]] static void throw_other(std::string_view what);

  StateTree* to_;
  const StateTree* from_;
  std::string prefix_;
};

/// The members of one thing after the other, each an array of its own.
class RowFields {
 public:
  explicit RowFields(StateArchive archive) : archive_(std::move(archive)) {}

  bool is_reading() const noexcept { return archive_.is_reading(); }
  /// Of the row that is read. @throws StateMismatch
  void require(bool holds, std::string_view name) const { archive_.require(holds, name); }
  void begin_row() noexcept { next_ = 0; }

  template <class Thing>
  void operator()(std::string_view name, Thing& thing) {
    using Numbers = NumbersOf<Thing>;
    using Number = typename Numbers::Number;
    Number* const at = take<Number>(name, Numbers::count, Numbers::count);
    if (archive_.is_reading())
      Numbers::get(at, thing);
    else
      Numbers::put(thing, at);
  }

  /// So many numbers, as many as whoever reads knows of the row.
  void numbers(std::string_view name, double* numbers, std::size_t count);

  /// A list of things, of another length in each row.
  template <class Thing>
  void operator()(std::string_view name, std::vector<Thing>& things) {
    using Numbers = NumbersOf<Thing>;
    using Number = typename Numbers::Number;
    const std::string count_name = std::string(name) + "_count";
    std::size_t count = things.size();
    (*this)(count_name, count);
    require(count <= kMostInRow, count_name);
    Number* at = take<Number>(name, Numbers::count, count * Numbers::count);
    things.resize(count);
    for (Thing& thing : things) {
      if (archive_.is_reading())
        Numbers::get(at, thing);
      else
        Numbers::put(thing, at);
      at += Numbers::count;
    }
  }

  /// Hands over what was written. @throws StateMismatch if not all was read
  void finish();

 private:
  /// No list of a row is longer, and none of them is so long that its size in bytes overflows.
  static constexpr std::size_t kMostInRow = std::size_t{1} << 40U;

  struct Column {
    std::string name;
    StateArray array;
    std::size_t used = 0;
  };
  Column& column(std::string_view name, const StateArray& empty);
  [[noreturn]] void throw_too_short(const Column& column) const;

  /// The next numbers of a column, to be written or read.
  template <class Number>
  Number* take(std::string_view name, std::size_t columns, std::size_t count) {
    Column& of = column(name, {std::vector<Number>{}, columns});
    auto* const numbers = std::get_if<std::vector<Number>>(&of.array.numbers);
    if (!numbers || of.array.columns != columns) archive_.throw_other_kind(name);
    const std::size_t first = of.used;
    if (!archive_.is_reading()) numbers->resize(first + count);
    if (count > numbers->size() - first) throw_too_short(of);
    of.used = first + count;
    return numbers->data() + first;
  }

  StateArchive archive_;
  std::vector<Column> columns_;
  std::size_t next_ = 0;
};

template <class Thing, class Fields>
void StateArchive::rows(std::string_view name, std::vector<Thing>& things, Fields&& fields) const {
  const StateArchive of_rows = group(name);
  std::size_t count = things.size();
  of_rows("count", count);
  if (is_reading()) things.clear();
  RowFields row(of_rows);
  for (std::size_t i = 0; i < count; ++i) {
    if (is_reading()) things.emplace_back();  // one by one: a count may be of a damaged state
    row.begin_row();
    fields(row, things[i]);
  }
  row.finish();
}

}  // namespace plekton::geometry
