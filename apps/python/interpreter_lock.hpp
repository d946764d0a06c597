// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/python/bindings.hpp"

/// The interpreter's lock, given back and taken so that a thread that is left over when the
/// interpreter ends (a daemon thread) ends with the process.
///
/// Until version 3.13 an interpreter that ends answers such a thread, when it asks for the lock,
/// with pthread_exit(): an unwinding that no destructor and no handler of C++ may end, else the
/// process is aborted. Here the thread waits for the end of the process instead, as the interpreter
/// itself has it since 3.14 (python/cpython, issue 87135).
namespace plekton::python {

/// Whether the interpreter ends: no other thread than the one that ends it gets its lock any more.
bool is_interpreter_ending() noexcept;

/// Waits for the end of the process. Without the lock.
[[noreturn]] void wait_for_process_end() noexcept;

/// While it lives, this thread is without the lock that it had. Where the interpreter has ended
/// meanwhile, the end of its life does not return.
class WithoutLock {
 public:
  WithoutLock() noexcept : thread_(PyEval_SaveThread()) {}
  WithoutLock(const WithoutLock&) = delete;
  WithoutLock& operator=(const WithoutLock&) = delete;
  ~WithoutLock();

 private:
  PyThreadState* thread_;
};

/// While it lives, this thread has the lock. Where the interpreter has ended, its constructor does
/// not return.
class WithLock {
 public:
  WithLock();
  WithLock(const WithLock&) = delete;
  WithLock& operator=(const WithLock&) = delete;
  ~WithLock() { PyGILState_Release(state_); }

 private:
  PyGILState_STATE state_{};
};

}  // namespace plekton::python
