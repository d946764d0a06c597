// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/stage_tables.hpp"

#include "apps/scenario/closest_word.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>

namespace plekton::apps {
namespace {

constexpr std::array<std::string_view, 4> kSimulationKeys = {"damping", "damp_gravity", "gravity",
                                                             "time_step"};
constexpr std::array<std::string_view, 4> kMaterialKeys = {"friction_angle", "poisson_ratio",
                                                           "stiffness_ratio", "young_modulus"};
constexpr std::array<std::string_view, 2> kBodyKeys = {"hold", "hold_rotation"};
constexpr std::array<std::string_view, 10> kOutputKeys = {"checkpoint_interval",
                                                          "checkpoint_wall_interval",
                                                          "contacts",
                                                          "grains",
                                                          "history_interval",
                                                          "interval",
                                                          "measures",
                                                          "membranes",
                                                          "reactions",
                                                          "reactions_interval"};

const std::string* text_of(const Table& table, std::string_view key) {
  const Entry* const entry = table.find(key);
  return entry ? std::get_if<std::string>(&entry->value.data) : nullptr;
}

const Table* table_in(const Value& value) {
  return std::get_if<Table>(&value.data);
}

void set(Table& table, const Entry& entry) {
  if (Entry* const there = table.find(entry.key))
    *there = entry;
  else
    table.entries.push_back(entry);
}

/// Table in the list with this text under a key; the length of the list if there is none.
std::size_t place_in(const Array& list, std::string_view key, const std::string& text) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const Value& value) {
    const Table* const table = table_in(value);
    const std::string* const own = table ? text_of(*table, key) : nullptr;
    return own != nullptr && *own == text;
  });
  return static_cast<std::size_t>(found - list.begin());
}

/// Text that two values have in common if they mean the same.
void write(const Value& value, std::string& text) {
  if (const auto* const list = std::get_if<Array>(&value.data)) {
    text += '[';
    for (const Value& item : *list) write(item, text);
    text += ']';
  } else if (const Table* const table = table_in(value)) {
    text += '{';
    for (const Entry& entry : table->entries) {
      text += entry.key + '=';
      write(entry.value, text);
    }
    text += '}';
  } else {
    text += shown(value) + ',';
  }
}

/// Membranes or rigid bodies: all of them are in the scenarios of all stages, so that what is known
/// of one by its number stays so; some are not there yet, or any more.
struct BodyList {
  std::string key;                 ///< of the tables
  std::string kind;                ///< as removals have it
  std::vector<std::size_t> comes;  ///< by table: the stage at whose start it comes
  std::size_t from_the_start = 0;  ///< how many stand outside of the stages; they come first
  std::vector<bool> is_gone;       ///< by table

  std::vector<bool> absent_in(std::size_t stage) const {
    std::vector<bool> absent;
    for (std::size_t i = 0; i < comes.size(); ++i) absent.push_back(comes[i] > stage || is_gone[i]);
    return absent;
  }
};

/// Planes or loads. Those without a name are called by their number among all that have come: so
/// they are called the same in all stages, whatever is taken out before them.
struct NumberedList {
  std::vector<std::size_t> numbers = {};  ///< by table that is there
  std::size_t come = 0;                   ///< how many have
  std::set<std::string> gone = {};        ///< names of those that were taken out

  void add() { numbers.push_back(come++); }
  void remove(std::size_t place, const std::string& name) {
    numbers.erase(numbers.begin() + static_cast<std::ptrdiff_t>(place));
    gone.insert(name);
  }
};

/// Goes from stage to stage.
class Stages {
 public:
  Stages(const Table& scenario, const Array& stages, Problems& problems) : problems_(problems) {
    for (const Entry& entry : scenario.entries)
      if (entry.key != "stages") now_.entries.push_back(entry);
    origins_.loads.assign(count("loads"), 0);
    origins_.reactions.assign(reaction_count(), 0);
    for (std::size_t i = 0; i < count("planes"); ++i) planes_.add();
    for (std::size_t i = 0; i < count("loads"); ++i) loads_.add();
    for (BodyList* const list : {&membranes_, &rigid_bodies_}) {
      list->from_the_start = count(list->key);
      list->comes.assign(list->from_the_start, 0);
      for (std::size_t k = 0; k < stages.size(); ++k) list_coming(stages[k], k, *list);
      list->is_gone.assign(list->comes.size(), false);
    }
    if (const Entry* const stop = now_.find("stop"))
      complain(stop->place, "stop", "does not go with stages; say it in the `end` of a stage");
    if (const Table* const simulation = table_of("simulation")) {
      if (const Entry* const duration = simulation->find("duration"))
        complain(duration->place, "simulation.duration",
                 "does not go with stages; each has a duration in its `end`, or a max_duration");
    }
  }

  StageTable next(const Table& stage, const Place& place) {
    path_ = fmt::format("stages[{}]", number_);
    if (const std::string* const name = text_of(stage, "name")) path_ = "stages." + *name;
    begin_origins();
    const std::string before = text_of_all();
    Table own;
    if (const Entry* const removals = stage.find("remove"))
      own.entries.push_back(remove(*removals));
    changes_bodies_ = stage.find("fix") != nullptr || stage.find("free") != nullptr ||
                      stage.find("remove") != nullptr;
    for (const Entry& entry : stage.entries)
      if (entry.key != "remove" && !change(entry)) own.entries.push_back(entry);
    origins_.plane_numbers = planes_.numbers;
    origins_.load_numbers = loads_.numbers;
    origins_.absent_membranes = membranes_.absent_in(number_);
    origins_.absent_rigid_bodies = rigid_bodies_.absent_in(number_);
    origins_.changes_nothing = number_ > 0 && !changes_bodies_ && text_of_all() == before;
    Table table = now_;
    set_duration(table, stage, place);
    table.entries.push_back({"stages", place, Value{place, Array{Value{place, std::move(own)}}}});
    ++number_;
    return {std::move(table), origins_};
  }

 private:
  /// The list of a key; made where it is missing.
  Array& list_of(Table& table, std::string_view key, const Place& place) {
    if (Entry* const entry = table.find(key)) {
      if (auto* const list = std::get_if<Array>(&entry->value.data)) return *list;
      const std::string name = fmt::format("{}{}", &table == &now_ ? "" : "output.", key);
      problems_.add(entry->place,
                    fmt::format("{}: got {}; expected a list of tables, each under [[{}]]", name,
                                shown(entry->value), name));
      entry->value.data = Array{};
      return std::get<Array>(entry->value.data);
    }
    table.entries.push_back({std::string(key), place, Value{place, Array{}}});
    return std::get<Array>(table.entries.back().value.data);
  }

  void begin_origins() {
    origins_.planes.clear();
    for (std::size_t i = 0; i < count("planes"); ++i)
      origins_.planes.push_back(number_ == 0 ? -1 : static_cast<int>(i));
    for (std::vector<bool>* const said : flags_of_planes()) said->assign(count("planes"), false);
    origins_.says_hold.assign(count("rigid_bodies"), false);
  }

  /// What the stage says of each plane.
  std::array<std::vector<bool>*, 3> flags_of_planes() {
    return {&origins_.moved_planes, &origins_.says_point, &origins_.says_radius};
  }

  /// All but what is written.
  std::string text_of_all() const {
    std::string text;
    for (const Entry& entry : now_.entries) {
      if (entry.key == "output") continue;
      text += entry.key + ':';
      write(entry.value, text);
    }
    return text;
  }

  /// @returns whether it is a key of scenarios
  bool change(const Entry& entry) {
    if (entry.key == "simulation")
      change_table(entry, kSimulationKeys);
    else if (entry.key == "materials")
      change_materials(entry);
    else if (entry.key == "contacts")
      change_contacts(entry);
    else if (entry.key == "planes" || entry.key == "loads")
      change_named(now_, entry);
    else if (entry.key == "grains")
      add_grains(entry);
    else if (entry.key == "rigid_bodies")
      change_bodies(entry, rigid_bodies_);
    else if (entry.key == "membranes")
      change_bodies(entry, membranes_);
    else if (entry.key == "output")
      change_output(entry);
    else
      return refuse_ties(entry);
    return true;
  }

  bool refuse_ties(const Entry& entry) {
    if (entry.key != "ties") return false;
    complain(entry.place, entry.key,
             "ties are there from the first stage on; write them outside of the stages");
    return true;
  }

  /// Lists bodies that have not been named before.
  void list_coming(const Value& stage, std::size_t number, BodyList& list) {
    const Table* const table = table_in(stage);
    const Entry* const entry = table ? table->find(list.key) : nullptr;
    const auto* const bodies = entry ? std::get_if<Array>(&entry->value.data) : nullptr;
    if (bodies == nullptr) return;
    Array& all = list_of(now_, list.key, entry->place);
    for (const Value& body : *bodies) {
      const Table* const own = table_in(body);
      const std::string* const name = own ? text_of(*own, "name") : nullptr;
      if (name != nullptr && place_in(all, "name", *name) < all.size()) continue;
      all.push_back(body);
      list.comes.push_back(number);
    }
  }

  /// Some come, and of rigid bodies that are there the stage says what is held.
  void change_bodies(const Entry& entry, const BodyList& list) {
    const auto* const changes = std::get_if<Array>(&entry.value.data);
    if (changes == nullptr) {
      set(now_, entry);  // the reader complains
      return;
    }
    changes_bodies_ = true;
    Array& all = list_of(now_, list.key, entry.place);
    std::set<std::string> names;
    for (const Value& value : *changes) {
      const Table* const table = table_in(value);
      const std::string* const name = table ? text_of(*table, "name") : nullptr;
      const std::size_t place = name ? place_in(all, "name", *name) : all.size();
      if (place == all.size()) continue;  // the reader complains of what has no name
      if (!is_to_be_changed(list, place, names.insert(*name).second, value.place)) continue;
      auto* const body = std::get_if<Table>(&all[place].data);
      const std::span<const std::string_view> allowed =
          &list == &rigid_bodies_ ? std::span<const std::string_view>(kBodyKeys)
                                  : std::span<const std::string_view>();
      for (const Entry& key : table->entries) {
        if (key.key != "name" && is_allowed(key, list.key + "." + *name, allowed)) set(*body, key);
      }
      if (&list == &rigid_bodies_) origins_.says_hold[place] = true;
    }
  }

  /// Whether a table of a stage changes a body, and does not bring it.
  bool is_to_be_changed(const BodyList& list, std::size_t place, bool is_first,
                        const Place& where) {
    if (!is_first) complain(where, list.key, "two tables of this stage have this name");
    if (list.is_gone[place])
      complain(where, list.key,
               "what has this name was taken out and does not come back; give what comes a name of "
               "its own");
    const bool comes = place >= list.from_the_start && list.comes[place] == number_;
    return is_first && !list.is_gone[place] && !comes;
  }

  /// Keys of a table replace those from before.
  void change_table(const Entry& entry, std::span<const std::string_view> allowed) {
    const Table* const changes = table_in(entry.value);
    if (changes == nullptr) {
      complain(entry.place, entry.key, fmt::format("got {}; expected a table", shown(entry.value)));
      return;
    }
    Entry* const there = now_.find(entry.key);
    if (there == nullptr) now_.entries.push_back({entry.key, entry.place, {entry.place, Table{}}});
    Entry& all = there ? *there : now_.entries.back();
    auto* const table = std::get_if<Table>(&all.value.data);
    if (table == nullptr) return;  // the reader complains
    for (const Entry& key : changes->entries)
      if (is_allowed(key, entry.key, allowed)) set(*table, key);
  }

  bool is_allowed(const Entry& key, const std::string& of,
                  std::span<const std::string_view> allowed) {
    if (std::find(allowed.begin(), allowed.end(), key.key) != allowed.end()) return true;
    const std::string hint = did_you_mean(key.key, allowed);
    complain(
        key.place, fmt::format("{}.{}", of, key.key),
        allowed.empty()
            ? std::string("is there already, and stays as it is; give what comes a name of its "
                          "own")
            : fmt::format("is the same in all stages{}; a stage may change {}", hint,
                          fmt::join(allowed, ", ")));
    return false;
  }

  void change_materials(const Entry& entry) {
    const Table* const changes = table_in(entry.value);
    Entry* const all = now_.find("materials");
    auto* const materials = all ? std::get_if<Table>(&all->value.data) : nullptr;
    if (changes == nullptr || materials == nullptr) {
      change_table(entry, {});
      return;
    }
    for (const Entry& material : changes->entries) {
      Entry* const there = materials->find(material.key);
      const Table* const keys = table_in(material.value);
      auto* const old = there ? std::get_if<Table>(&there->value.data) : nullptr;
      if (old == nullptr || keys == nullptr) {
        set(*materials, material);
        continue;
      }
      for (const Entry& key : keys->entries)
        if (is_allowed(key, "materials." + material.key, kMaterialKeys)) set(*old, key);
    }
  }

  /// Keys that planes of another kind have are not those of a plane that becomes one of this kind.
  static void leave_out_keys_of_other_kinds(const Table& change, Table& plane) {
    if (change.find("kind") == nullptr) return;
    const std::string* const kind = text_of(change, "kind");
    const bool is_flat = kind != nullptr && *kind == "flat";
    std::erase_if(plane.entries, [&](const Entry& entry) {
      return is_flat ? entry.key == "axis" || entry.key == "radius" : entry.key == "normal";
    });
  }

  /// Tables of one name are one.
  void change_named(Table& of, const Entry& entry) {
    const auto* const changes = std::get_if<Array>(&entry.value.data);
    if (changes == nullptr) {
      set(of, entry);  // the reader complains
      return;
    }
    Array& all = list_of(of, entry.key, entry.place);
    std::set<std::string> names;
    for (const Value& value : *changes) {
      const Table* const table = table_in(value);
      const std::string* const name = table ? text_of(*table, "name") : nullptr;
      const bool is_first = name == nullptr || names.insert(*name).second;
      const std::size_t place =
          name != nullptr && is_first ? place_in(all, "name", *name) : all.size();
      if (place == all.size()) {
        all.push_back(value);
        number_new(entry.key, value, name == nullptr);
      } else {
        all[place].place = value.place;
        if (entry.key == "planes")
          leave_out_keys_of_other_kinds(*table, std::get<Table>(all[place].data));
        for (const Entry& key : table->entries) set(std::get<Table>(all[place].data), key);
      }
      note_origin(entry.key, place, table);
    }
  }

  /// Of planes and loads. A column is of one of them alone.
  void number_new(std::string_view list, const Value& value, bool is_unnamed) {
    if (list != "planes" && list != "loads") return;
    const bool is_plane = list == "planes";
    NumberedList& all = is_plane ? planes_ : loads_;
    all.add();
    const std::string name =
        is_plane ? default_plane_name(all.numbers.back()) : default_load_name(all.numbers.back());
    if (is_unnamed && all.gone.contains(name))
      complain(value.place, list,
               fmt::format("without a name it is called \"{}\", as one was that is taken out; give "
                           "it a name",
                           name));
  }

  void note_origin(std::string_view list, std::size_t place, const Table* table) {
    const auto note = [&](auto& all, auto what) {
      if (place == all.size())
        all.push_back(what);
      else
        all[place] = what;
    };
    if (list == "loads") note(origins_.loads, number_);
    if (list == "reactions") note(origins_.reactions, number_);
    if (list != "planes") return;
    if (place == origins_.planes.size()) origins_.planes.push_back(-1);
    const auto says = [table](std::string_view key) {
      return table != nullptr && table->find(key) != nullptr;
    };
    note(origins_.says_point, says("point"));
    note(origins_.says_radius, says("radius"));
    note(origins_.moved_planes,
         says("point") || says("radius") || says("kind") || says("axis") || says("normal"));
  }

  void change_contacts(const Entry& entry) {
    const auto* const changes = std::get_if<Array>(&entry.value.data);
    if (changes == nullptr) {
      set(now_, entry);
      return;
    }
    Array& all = list_of(now_, entry.key, entry.place);
    for (const Value& value : *changes) {
      const auto same = std::find_if(all.begin(), all.end(),
                                     [&](const Value& old) { return same_pair(old, value); });
      if (same == all.end()) {
        all.push_back(value);
        continue;
      }
      for (const Entry& key : table_in(value)->entries) set(std::get<Table>(same->data), key);
    }
  }

  static bool same_pair(const Value& a, const Value& b) {
    std::array<std::multiset<std::string>, 2> pairs;
    for (std::size_t i = 0; i < 2; ++i) {
      const Table* const table = table_in(i == 0 ? a : b);
      if (table == nullptr) return false;
      for (const char* const key : {"between", "and"})
        if (const std::string* const name = text_of(*table, key)) pairs[i].insert(*name);
    }
    return pairs[0].size() == 2 && pairs[0] == pairs[1];
  }

  void add_grains(const Entry& entry) {
    const auto* const added = std::get_if<Array>(&entry.value.data);
    if (added == nullptr) {
      set(now_, entry);
      return;
    }
    Array& all = list_of(now_, entry.key, entry.place);
    all.insert(all.end(), added->begin(), added->end());
  }

  void change_output(const Entry& entry) {
    change_table({entry.key, entry.place, without(without(entry.value, "reactions"), "measures")},
                 kOutputKeys);
    const Table* const changes = table_in(entry.value);
    for (const char* const list : {"reactions", "measures"}) {
      const Entry* const named = changes ? changes->find(list) : nullptr;
      if (named == nullptr) continue;
      auto* const output = std::get_if<Table>(&now_.find("output")->value.data);
      if (output != nullptr) change_named(*output, *named);
    }
  }

  static Value without(Value value, std::string_view key) {
    if (auto* const table = std::get_if<Table>(&value.data))
      std::erase_if(table->entries, [&](const Entry& entry) { return entry.key == key; });
    return value;
  }

  /// Takes out planes and loads. @returns the removals of what is left: grains
  Entry remove(const Entry& removals) {
    const auto* const all = std::get_if<Array>(&removals.value.data);
    if (all == nullptr) return removals;  // the reader complains
    Array left;
    for (const Value& value : *all) {
      const Table* const table = table_in(value);
      const bool is_plane = table != nullptr && table->find("plane") != nullptr;
      const bool is_load = table != nullptr && table->find("load") != nullptr;
      const bool is_rigid = table != nullptr && table->find("rigid_body") != nullptr;
      const bool is_membrane =
          table != nullptr && table->find("membrane") != nullptr && table->entries.size() == 1;
      if (is_plane)
        remove_named("planes", "plane", *table);
      else if (is_load)
        remove_named("loads", "load", *table);
      else if (is_rigid)
        remove_body(rigid_bodies_, *table);
      else if (is_membrane)
        remove_body(membranes_, *table);
      else if (number_ > 0 || table == nullptr || table->find("grains") == nullptr)
        left.push_back(value);
      else
        complain(
            value.place, "remove",
            "no grains have been there before the first stage; say so where they are placed, or "
            "take them out in a stage after it");
    }
    return {removals.key, removals.place, Value{removals.value.place, std::move(left)}};
  }

  void remove_body(BodyList& list, const Table& removal) {
    const std::size_t place = place_of_removed(list.key, list.kind, removal);
    if (place == list.comes.size()) return;
    if (list.comes[place] >= std::max<std::size_t>(number_, 1) || list.is_gone[place])
      complain_of_none(list.kind, *removal.find(list.kind));
    list.is_gone[place] = true;
    remove_reactions_of(list.kind, removal);
  }

  /// The list in [output] of a key; null where there is none.
  Array* output_list(std::string_view key) {
    Entry* const output = now_.find("output");
    auto* const table = output ? std::get_if<Table>(&output->value.data) : nullptr;
    Entry* const entry = table ? table->find(key) : nullptr;
    return entry ? std::get_if<Array>(&entry->value.data) : nullptr;
  }

  /// Reactions go with what they are of; their columns stay.
  void remove_reactions_of(std::string_view kind, const Table& removal) {
    const std::string* const name = text_of(removal, kind);
    Array* const all = output_list("reactions");
    if (name == nullptr || all == nullptr) return;
    for (std::size_t i = all->size(); i-- > 0;) {
      const Table* const reaction = table_in((*all)[i]);
      const std::string* const of = reaction ? text_of(*reaction, kind) : nullptr;
      if (of == nullptr || *of != *name) continue;
      const auto at = static_cast<std::ptrdiff_t>(i);
      all->erase(all->begin() + at);
      origins_.reactions.erase(origins_.reactions.begin() + at);
    }
  }

  /// A plane that is gone cuts no region any more.
  void leave_out_of_measures(const std::string& plane) {
    Array* const all = output_list("measures");
    if (all == nullptr) return;
    for (Value& value : *all) {
      auto* const measure = std::get_if<Table>(&value.data);
      Entry* const between = measure ? measure->find("between") : nullptr;
      auto* const names = between ? std::get_if<Array>(&between->value.data) : nullptr;
      if (names == nullptr) continue;
      std::erase_if(*names, [&](const Value& name) {
        const auto* const text = std::get_if<std::string>(&name.data);
        return text != nullptr && *text == plane;
      });
      if (names->empty())
        std::erase_if(measure->entries, [](const Entry& entry) { return entry.key == "between"; });
    }
  }

  void complain_of_none(std::string_view key, const Entry& named) {
    complain(named.value.place, fmt::format("remove.{}", key),
             fmt::format("there is none called {} in the stage before, or it is taken out already",
                         shown(named.value)));
  }

  /// @returns the length of the list after a problem
  std::size_t place_of_removed(std::string_view list, std::string_view key, const Table& removal) {
    const Entry& named = *removal.find(key);
    if (removal.entries.size() > 1)
      complain(named.place, "remove",
               fmt::format("a {} is taken out as a whole; expected {{ {} = "
                           "NAME }}",
                           key, key));
    const std::string* const name = std::get_if<std::string>(&named.value.data);
    const Array& all = list_of(now_, list, named.place);
    const std::size_t place = name ? place_in(all, "name", *name) : all.size();
    if (place == all.size()) complain_of_none(key, named);
    return place;
  }

  void remove_named(std::string_view list, std::string_view key, const Table& removal) {
    const std::size_t place = place_of_removed(list, key, removal);
    Array& all = list_of(now_, list, removal.find(key)->place);
    if (place == all.size()) return;
    const auto at = static_cast<std::ptrdiff_t>(place);
    all.erase(all.begin() + at);
    (list == "loads" ? loads_ : planes_).remove(place, *text_of(removal, key));
    if (list == "loads") origins_.loads.erase(origins_.loads.begin() + at);
    if (list != "planes") return;
    origins_.planes.erase(origins_.planes.begin() + at);
    for (std::vector<bool>* const said : flags_of_planes()) said->erase(said->begin() + at);
    remove_reactions_of(key, removal);
    leave_out_of_measures(*text_of(removal, key));
  }

  /// The duration of the scenario is that of the stage: intervals of output follow from it.
  void set_duration(Table& table, const Table& stage, const Place& place) {
    const Entry* const end = stage.find("end");
    const Table* const ends = end ? table_in(end->value) : nullptr;
    const Entry* longest = ends ? ends->find("duration") : nullptr;
    if (longest == nullptr) longest = stage.find("max_duration");
    // Without any the stage complains.
    const Value duration = longest ? longest->value : Value{place, 1.0};
    Entry* const simulation = table.find("simulation");
    if (simulation == nullptr) {
      table.entries.push_back({"simulation", place, Value{place, Table{}}});
      set(std::get<Table>(table.entries.back().value.data), {"duration", place, duration});
    } else if (auto* const keys = std::get_if<Table>(&simulation->value.data)) {
      set(*keys, {"duration", place, duration});
    }
  }

  const Table* table_of(std::string_view key) const {
    const Entry* const entry = now_.find(key);
    return entry ? table_in(entry->value) : nullptr;
  }
  std::size_t count(std::string_view key) const {
    const Entry* const entry = now_.find(key);
    const auto* const list = entry ? std::get_if<Array>(&entry->value.data) : nullptr;
    return list ? list->size() : 0;
  }
  std::size_t reaction_count() const {
    const Table* const output = table_of("output");
    const Entry* const reactions = output ? output->find("reactions") : nullptr;
    const auto* const list = reactions ? std::get_if<Array>(&reactions->value.data) : nullptr;
    return list ? list->size() : 0;
  }

  void complain(const Place& place, std::string_view key, const std::string& what) {
    problems_.add(place, path_.empty() ? fmt::format("{}: {}", key, what)
                                       : fmt::format("{}.{}: {}", path_, key, what));
  }

  Problems& problems_;
  Table now_;
  StageOrigins origins_;
  NumberedList planes_;
  NumberedList loads_;
  BodyList membranes_{"membranes", "membrane", {}, 0, {}};
  BodyList rigid_bodies_{"rigid_bodies", "rigid_body", {}, 0, {}};
  std::size_t number_ = 0;
  std::string path_;
  bool changes_bodies_ = false;
};

}  // namespace

bool has_stages(const Table& scenario) {
  return scenario.find("stages") != nullptr;
}

std::vector<StageTable> stage_tables(const Table& scenario, Problems& problems) {
  const Entry& entry = *scenario.find("stages");
  const auto* const list = std::get_if<Array>(&entry.value.data);
  if (list == nullptr || list->empty()) {
    problems.add(entry.place, fmt::format("stages: got {}; expected at least one table, under "
                                          "[[stages]]",
                                          shown(entry.value)));
    return {};
  }
  Stages stages(scenario, *list, problems);
  std::vector<StageTable> tables;
  std::set<std::string> names;
  for (const Value& value : *list) {
    const Table* const stage = table_in(value);
    if (stage == nullptr) {
      problems.add(value.place, fmt::format("stages: got {}; expected a table", shown(value)));
      continue;
    }
    const std::string* const name = text_of(*stage, "name");
    if (name != nullptr && !names.insert(*name).second)
      problems.add(stage->find("name")->value.place,
                   fmt::format("stages.{}.name: \"{}\" has this name already; names must differ",
                               *name, *name));
    tables.push_back(stages.next(*stage, value.place));
  }
  return tables;
}

}  // namespace plekton::apps
