// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

/// For the few files that call the HDF5 library. Its header is not needed to include this: handles of
/// the library are numbers (handle.cpp).
namespace plekton::dynamics::hdf5 {

/// A handle of the library, closed at its end.
class Handle {
 public:
  using Close = int (*)(std::int64_t);
  Handle(std::int64_t id, Close close) : id_(id), close_(close) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  std::int64_t get() const noexcept { return id_; }
  explicit operator bool() const noexcept { return id_ >= 0; }

 private:
  std::int64_t id_;
  Close close_;
};

/// The library prints no errors of its own meanwhile.
class QuietErrors {
 public:
  QuietErrors();
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;
  ~QuietErrors();

 private:
  int (*print_)(std::int64_t, void*) = nullptr;
  void* data_ = nullptr;
};

}  // namespace plekton::dynamics::hdf5
