// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target of the beds of the benchmarks: any text is a bed of finite numbers, which is
// read again as it was written, or refused with a std::runtime_error.
#include "tests/benchmarks/bed.hpp"

#include "tests/fuzz/require.hpp"

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace plekton::benchmarks;
  using plekton::fuzz::require;
  try {
    const Bed bed = parse_bed({reinterpret_cast<const char*>(data), size}, "fuzzed");
    require(bed.side > 0.0 && bed.extent > 0.0, "a box of no size");
    for (const Bed::Grain& grain : bed.grains) {
      require(grain.position.allFinite() && grain.velocity.allFinite() &&
                  grain.angular_velocity.allFinite(),
              "a sphere that is nowhere");
      require(grain.radius > 0.0 && std::isfinite(grain.radius), "a sphere of no size");
    }
    require(parse_bed(text_of(bed), "again").grains.size() == bed.grains.size(), "another bed");
  } catch (const std::runtime_error& error) {
    require(std::string_view(error.what()).starts_with("fuzzed: "), error.what());
  }
  return 0;
}
