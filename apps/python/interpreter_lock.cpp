// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/python/interpreter_lock.hpp"

#include <cxxabi.h>
#include <unistd.h>

namespace plekton::python {

bool is_interpreter_ending() noexcept {
#if PY_VERSION_HEX >= 0x030D0000
  return Py_IsFinalizing() != 0;
#else
  return _Py_IsFinalizing() != 0;
#endif
}

void wait_for_process_end() noexcept {
  while (true) ::pause();
}

// An unwinding that stays in its handler is not aborted.

WithoutLock::~WithoutLock() {
  try {
    PyEval_RestoreThread(thread_);
  } catch (const abi::__forced_unwind&) {
    wait_for_process_end();
  }
}

WithLock::WithLock() {
  try {
    state_ = PyGILState_Ensure();
  } catch (const abi::__forced_unwind&) {
    wait_for_process_end();
  }
}

}  // namespace plekton::python
