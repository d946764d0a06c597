// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/hdf5/handle.hpp"

#include <hdf5.h>

#include <type_traits>

namespace plekton::dynamics::hdf5 {

static_assert(std::is_same_v<hid_t, std::int64_t> && std::is_same_v<herr_t, int>);

QuietErrors::QuietErrors() {
  H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

QuietErrors::~QuietErrors() {
  H5Eset_auto2(H5E_DEFAULT, print_, data_);
}

}  // namespace plekton::dynamics::hdf5
