// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target of the checkpoint reader: any bytes are a state of arrays with whole rows, or
// refused with a CheckpointError. What has another checksum does not get to the HDF5 library;
// state.cpp goes on from there.
#include "dynamics/checkpoint/checkpoint_file.hpp"
#include "tests/fuzz/require.hpp"

#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using plekton::fuzz::require;
  try {
    const auto state =
        plekton::dynamics::parse_checkpoint({reinterpret_cast<const char*>(data), size}, "fuzzed");
    for (const auto& [name, array] : state.arrays) {
      require(!name.empty() && array.columns > 0, "an array without a name or columns");
      require(array.rows() * array.columns == array.size(), "a row that is not whole");
    }
  } catch (const plekton::dynamics::CheckpointError&) {
    // Refused, as it should be.
  }
  return 0;
}
