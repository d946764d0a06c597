// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target of one mesh format, PLEKTON_FUZZ_FORMAT: any bytes are either a soup of polygons
// with finite points and corners that exist, or refused with a MeshError.
#include "geometry/mesh/io/mesh_file.hpp"
#include "tests/fuzz/require.hpp"

#include <cstdint>
#include <string_view>

namespace {

using namespace plekton::geometry;
using plekton::fuzz::require;

void require_sound(const PolygonSoup& soup) {
  for (const Vec3& point : soup.points) require(point.allFinite(), "a point that is not finite");
  for (const auto& polygon : soup.polygons) {
    for (const auto corner : polygon)
      require(static_cast<std::size_t>(corner) < soup.points.size(), "a corner that is no point");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    require_sound(parse_mesh(bytes, MeshFormat::PLEKTON_FUZZ_FORMAT, "fuzzed"));
  } catch (const MeshError&) {
    // Refused, as it should be.
  }
  return 0;
}
