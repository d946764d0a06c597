// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

/// For the few files that call the HDF5 library. Its header is not needed to include this: handles of
/// the library are numbers (handle.cpp).
namespace plekton::dynamics::hdf5 {

/// A use of the library, which most builds of it allow to one thread at a time: other threads wait
/// for its end, and the library prints no errors of its own meanwhile. There may be uses within a
/// use. All calls of the library are within one.
class LibraryUse {
 public:
  LibraryUse();
  LibraryUse(const LibraryUse&) = delete;
  LibraryUse& operator=(const LibraryUse&) = delete;
  ~LibraryUse();

 private:
  int (*print_)(std::int64_t, void*) = nullptr;
  void* data_ = nullptr;
};

/// A name for a file in memory: the library takes two that are open for one where they have the same.
/// To be called within a use.
std::string name_of_file();

/// A handle of the library, closed at its end.
class Handle {
 public:
  using Close = int (*)(std::int64_t);
  Handle(std::int64_t id, Close close) : id_(id), close_(close) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ < 0) return;
    const LibraryUse use;
    close_(id_);
  }
  std::int64_t get() const noexcept { return id_; }
  explicit operator bool() const noexcept { return id_ >= 0; }

 private:
  std::int64_t id_;
  Close close_;
};

}  // namespace plekton::dynamics::hdf5
