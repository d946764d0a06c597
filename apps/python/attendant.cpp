// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/python/attendant.hpp"

#include "apps/python/from_python.hpp"
#include "apps/python/interpreter_lock.hpp"

#include <cxxabi.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace plekton::python {
namespace {

constexpr std::uint64_t kStepsBetweenClocks = 16;
constexpr std::chrono::milliseconds kBetweenSignals{50};  // nobody feels that Ctrl-C waits for it

/// How many whole intervals are over. A step ends within half its length of where it was to.
double intervals_over(const dynamics::Simulation& simulation, double interval) {
  return std::floor((simulation.time() + 0.5 * simulation.time_step()) / interval);
}

/// Functions of Python take the lock again and again. An unwinding by an interpreter that has ended
/// goes no further than here: it would release objects without the lock.
/// @throws py::error_already_set
void call_with(const py::object& function, py::handle argument) {
  PyObject* result = nullptr;
  try {
    result = PyObject_CallFunctionObjArgs(function.ptr(), argument.ptr(), nullptr);
  } catch (const abi::__forced_unwind&) {
    wait_for_process_end();
  }
  if (result == nullptr) throw py::error_already_set();
  Py_DECREF(result);
}

}  // namespace

Attendant::Attendant(py::handle owner, const py::object& every) : owner_(owner) {
  if (every.is_none()) return;
  if (!py::isinstance<py::dict>(every))
    throw apps::InputError(fmt::format("every: got {}; expected a dict of times and functions",
                                       std::string(py::repr(every))));
  for (const auto& [interval, functions] : py::reinterpret_borrow<py::dict>(every)) {
    const bool is_list =
        py::isinstance<py::list>(functions) || py::isinstance<py::tuple>(functions);
    if (!is_list) add(interval, functions);
    if (!is_list) continue;
    for (const py::handle function : functions) add(interval, function);
  }
}

void Attendant::add(const py::handle& interval, const py::handle& function) {
  const double time = seconds_of(interval, "every");
  const std::string shown = py::repr(interval);
  if (!(time > 0.0))
    throw apps::InputError(fmt::format("every: got {}; expected a time above 0", shown));
  if (PyCallable_Check(function.ptr()) == 0)
    throw apps::InputError(fmt::format("every {}: got {}; expected a function", shown,
                                       std::string(py::repr(function))));
  calls_.push_back({time, py::reinterpret_borrow<py::object>(function)});
}

void Attendant::start(const dynamics::Simulation& simulation) {
  began_at_end_ = is_interpreter_ending();
  for (Call& call : calls_) call.next = intervals_over(simulation, call.interval) + 1;
  find_next();
}

void Attendant::find_next() noexcept {
  next_ = std::numeric_limits<double>::infinity();
  for (const Call& call : calls_) next_ = std::min(next_, call.next * call.interval);
}

bool Attendant::wants_end(const dynamics::Simulation& simulation) {
  // Nobody can ask for what comes now, and what the steps need is about to be destroyed.
  if (!began_at_end_ && is_interpreter_ending()) wait_for_process_end();
  const bool is_due = simulation.time() >= next_ - 0.5 * simulation.time_step();
  if (!is_due && ++looks_ % kStepsBetweenClocks != 0) return stops_;
  const auto now = std::chrono::steady_clock::now();
  if (!is_due && now - last_signals_ < kBetweenSignals) return stops_;
  last_signals_ = now;
  const WithLock lock;
  try {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (is_due) call_due(simulation);
  } catch (...) {
    is_calling_ = false;
    raised_ = std::current_exception();
    stops_ = true;
  }
  return stops_;
}

void Attendant::call_due(const dynamics::Simulation& simulation) {
  is_calling_ = true;
  for (Call& call : calls_) {
    const double over = intervals_over(simulation, call.interval);
    if (call.next > over) continue;
    call.next = over + 1;
    call_with(call.function, owner_);
  }
  is_calling_ = false;
  find_next();
}

void Attendant::throw_if_any() const {
  if (raised_) std::rethrow_exception(raised_);
}

}  // namespace plekton::python
