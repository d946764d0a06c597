// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/hdf5/handle.hpp"

#include <hdf5.h>

#include <mutex>
#include <type_traits>

namespace plekton::dynamics::hdf5 {

static_assert(std::is_same_v<hid_t, std::int64_t> && std::is_same_v<herr_t, int>);

namespace {

/// For the state of a library that all of the process shares.
std::mutex in_use;
/// Of this thread, one within the other. Not a mutex that knows its thread: in a copy of the process
/// (trial.hpp) a thread has another name.
thread_local int uses = 0;

std::uint64_t named = 0;  // files so far

}  // namespace

std::string name_of_file() {
  return "image " + std::to_string(++named);
}

LibraryUse::LibraryUse() {
  if (uses == 0) in_use.lock();
  ++uses;
  H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

LibraryUse::~LibraryUse() {
  H5Eset_auto2(H5E_DEFAULT, print_, data_);
  --uses;
  if (uses == 0) in_use.unlock();
}

}  // namespace plekton::dynamics::hdf5
