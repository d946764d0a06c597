// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/python/from_python.hpp"

#include "apps/python/interpreter_lock.hpp"
#include "apps/scenario/scenario_reader.hpp"
#include "apps/scenario/section.hpp"
#include "geometry/base/printable.hpp"

#include <fmt/format.h>

#include <cmath>

namespace plekton::python {
namespace {

using apps::InputError;
using apps::Place;
using apps::Value;

std::string type_of(const py::handle& object) {
  return py::str(py::type::handle_of(object).attr("__name__"));
}

/// As Python prints it.
std::string shown(const py::handle& object) {
  return py::repr(object);
}

bool is_a(const py::handle& object, const char* module, const char* name) {
  return py::isinstance(object, py::module_::import(module).attr(name));
}

apps::Table converted(const py::dict& dict, const Place& place, int depth);

/// A whole number that int64 does not hold is kept as a kind that no key takes.
decltype(Value::data) whole_number(const py::handle& object) {
  const py::int_ number = py::reinterpret_steal<py::int_>(PyNumber_Index(object.ptr()));
  if (!number) throw py::error_already_set();
  int overflow = 0;
  const long long value = PyLong_AsLongLongAndOverflow(number.ptr(), &overflow);
  if (overflow != 0) return apps::OtherKind{std::string(py::repr(number))};
  return std::int64_t{value};
}

decltype(Value::data) list_of(const py::handle& items, const Place& place, int depth);

/// @param depth  levels above this value
decltype(Value::data) data_of(const py::handle& object, const Place& place, int depth) {
  if (depth > apps::kDeepest) apps::refuse_depth(place);
  if (py::isinstance<py::str>(object)) return text_of(object, to_string(place).c_str());
  if (py::isinstance<py::bool_>(object)) return object.cast<bool>();
  if (py::isinstance<py::float_>(object)) return object.cast<double>();
  if (py::isinstance<py::dict>(object))
    return converted(py::reinterpret_borrow<py::dict>(object), place, depth);
  if (py::isinstance<py::list>(object) || py::isinstance<py::tuple>(object))
    return list_of(object, place, depth);
  // Numbers and arrays of numpy, as the Python objects that they stand for.
  if (py::hasattr(object, "dtype") && py::hasattr(object, "tolist")) {
    const py::object plain = object.attr("tolist")();
    // A long double stands for nothing of Python's.
    if (py::hasattr(plain, "dtype")) return py::float_(plain).cast<double>();
    return data_of(plain, place, depth);
  }
  if (PyIndex_Check(object.ptr()) != 0) return whole_number(object);
  if (is_a(object, "os", "PathLike")) return path_of(object).string();
  if (object.is_none()) return apps::OtherKind{"None"};
  return apps::OtherKind{fmt::format("something of type {}", type_of(object))};
}

decltype(Value::data) list_of(const py::handle& items, const Place& place, int depth) {
  apps::Array array;
  for (const py::handle item : items) array.push_back({place, data_of(item, place, depth + 1)});
  return array;
}

apps::Table converted(const py::dict& dict, const Place& place, int depth) {
  apps::Table table;
  for (const auto& [key, value] : dict) {
    if (!py::isinstance<py::str>(key))
      throw InputError(
          fmt::format("{}: got the key {}; expected a text", to_string(place), shown(key)));
    table.entries.push_back(
        {text_of(key, to_string(place).c_str()), place, {place, data_of(value, place, depth + 1)}});
  }
  return table;
}

}  // namespace

apps::Table table_of(const py::dict& dict, const std::string& source) {
  return converted(dict, {source, 0, 0}, 0);
}

std::string text_of(const py::handle& value, const char* name) {
  const bool is_text = py::isinstance<py::str>(value);
  py::ssize_t size = 0;
  const char* const bytes = is_text ? PyUnicode_AsUTF8AndSize(value.ptr(), &size) : nullptr;
  if (bytes != nullptr) return {bytes, static_cast<std::size_t>(size)};
  PyErr_Clear();
  throw InputError(fmt::format("{}: got {}; expected a text{}", name, shown(value),
                               is_text ? " without halves of surrogate pairs" : ""));
}

double quantity_of(const py::handle& value, const apps::Dimension& expected, const char* name) {
  if (py::isinstance<py::str>(value)) {
    try {
      return apps::parse_quantity(text_of(value, name), expected);
    } catch (const apps::UnitError& error) {
      throw InputError(fmt::format("{}: {}", name, error.what()));
    }
  }
  const double number = PyFloat_AsDouble(value.ptr());
  if (PyErr_Occurred() == nullptr) return number;
  PyErr_Clear();
  throw InputError(fmt::format("{}: got {}; expected {} ({})", name, shown(value), expected.name,
                               expected.units));
}

double seconds_of(const py::handle& value, const char* name) {
  const double time = quantity_of(value, apps::kTime, name);
  if (apps::kNotNegative.holds(time) && std::isfinite(time)) return time;
  throw InputError(fmt::format("{}: got {}; expected {}{}", name, shown(value), apps::kTime.name,
                               std::isfinite(time) ? apps::kNotNegative.text : ", finite"));
}

std::filesystem::path path_of(const py::handle& value) {
  try {
    return std::string(py::bytes(py::module_::import("os").attr("fsencode")(value)));
  } catch (const py::error_already_set& error) {
    if (!error.matches(PyExc_UnicodeError)) throw;
    throw InputError(fmt::format("got {}, which is no name of a file", shown(value)));
  }
}

std::vector<std::string> overrides_of(const py::handle& values) {
  // A text is a list of its letters.
  if (py::isinstance<py::str>(values))
    throw InputError(
        fmt::format("overrides: got {}; expected a list of texts, as in "
                    "[\"simulation.duration=2 s\"]",
                    std::string(py::repr(values))));
  std::vector<std::string> overrides;
  for (const py::handle value : values) overrides.push_back(text_of(value, "overrides"));
  return overrides;
}

apps::ResumedRun resumed_run(const apps::ResumeArguments& arguments) {
  apps::ResumedRun run = apps::find_resumed_run(arguments);
  for (const std::string& warning : apps::warnings_about(run))
    if (PyErr_WarnEx(PyExc_UserWarning, geometry::printable(warning).c_str(), 1) != 0)
      throw py::error_already_set();
  return run;
}

void check_signals() {
  const WithLock lock;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

apps::Scenario scenario_of(const py::object& scenario, const py::handle& overrides,
                           const std::optional<std::filesystem::path>& folder) {
  const auto all = overrides_of(overrides);
  if (!py::isinstance<py::dict>(scenario)) {
    if (folder)
      throw InputError("folder: goes with a dict; paths in a file are relative to the file");
    return apps::read_scenario(path_of(scenario), all);
  }
  const std::filesystem::path path = folder.value_or("") / "dict";
  auto table = table_of(py::reinterpret_borrow<py::dict>(scenario), path.string());
  return apps::scenario_from(std::move(table), path, all);
}

}  // namespace plekton::python
