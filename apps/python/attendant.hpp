// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/python/bindings.hpp"
#include "dynamics/simulation.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <vector>

namespace plekton::python {

/// What Python wants between the steps of a run: functions that are called every so much time, and
/// Ctrl-C. The run itself goes on without the interpreter's lock.
class Attendant {
 public:
  /// @param owner  what functions are called with
  /// @param every  functions, or lists of them, by their intervals (s, or texts as in "10
  ///         ms"); or None
  /// @throws InputError for an interval that is no time above 0, and for what cannot be called
  Attendant(py::handle owner, const py::object& every);

  /// Begins from now: a function is due at the next multiple of its interval.
  void start(const dynamics::Simulation& simulation);

  /// After a step, without the lock. A function is called after the step whose end is nearest to
  /// its time; those that are due together in their order.
  /// @returns whether the run is to end: after stop(), Ctrl-C and what a function raised. Not at
  ///          all in a thread that is left over when the interpreter ends
  bool wants_end(const dynamics::Simulation& simulation);

  void stop() noexcept { stops_ = true; }
  /// Throws what ended the run, if it was Ctrl-C or raised by a function. With the lock.
  void throw_if_any() const;
  /// Whether a function is being called.
  bool is_calling() const noexcept { return is_calling_; }

 private:
  struct Call {
    double interval;  ///< s
    py::object function;
    double next = 0.0;  ///< multiple of the interval at which it is due
  };
  void add(const py::handle& interval, const py::handle& function);
  void call_due(const dynamics::Simulation& simulation);
  void find_next() noexcept;

  py::handle owner_;
  std::vector<Call> calls_;
  double next_ = 0.0;                ///< s, when the first call is due
  std::atomic<bool> stops_ = false;  ///< from any thread
  bool is_calling_ = false;
  bool began_at_end_ = false;  ///< in the thread that ends the interpreter, whose lock it keeps
  std::exception_ptr raised_;
  std::uint64_t looks_ = 0;
  std::chrono::steady_clock::time_point last_signals_{};
};

}  // namespace plekton::python
