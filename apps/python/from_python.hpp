// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/command_line/resumed_run.hpp"
#include "apps/python/bindings.hpp"
#include "apps/scenario/config_tree.hpp"
#include "apps/scenario/scenario.hpp"
#include "apps/scenario/units.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// What Python hands over, as the program knows it.
namespace plekton::python {

/// A dict as the tables of a scenario: texts, numbers, lists, tuples, arrays of numpy, dicts and
/// paths. Anything else is kept as a kind that no key takes, so that the reader complains about it
/// in its place.
/// @param source  what messages call it
/// @throws InputError for a key that is no text, and for what is nested deeper than a scenario may
/// be
apps::Table table_of(const py::dict& dict, const std::string& source);

/// What Python's text is in UTF-8.
/// @param name  what messages call it
/// @throws InputError for what is no text, and for halves of surrogate pairs, which UTF-8 has not
std::string text_of(const py::handle& value, const char* name);

/// A quantity in SI units: a number, or a text with a unit, as in "10 ms".
/// @param name  what messages call it
/// @throws InputError for what is neither
double quantity_of(const py::handle& value, const apps::Dimension& expected, const char* name);

/// A time in s that is finite and not below 0.
/// @throws InputError
double seconds_of(const py::handle& value, const char* name);

/// A text or anything with a path, as open() of Python takes them.
/// @throws InputError for a text that is no name of a file
std::filesystem::path path_of(const py::handle& value);

/// "path=value" each, as --set takes them.
std::vector<std::string> overrides_of(const py::handle& values);

/// Finds a run that is to go on, and gives a UserWarning of what the program warns of.
/// @throws InputError as find_resumed_run()
apps::ResumedRun resumed_run(const apps::ResumeArguments& arguments);

/// Ctrl-C while a scene is built. To be called without the lock.
void check_signals();

/// A file, or a dict with the same keys.
/// @param folder  where the paths in a dict begin
/// @throws InputError as the program says it
apps::Scenario scenario_of(const py::object& scenario, const py::handle& overrides,
                           const std::optional<std::filesystem::path>& folder);

}  // namespace plekton::python
