// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/repair/orientation.hpp"

#include "geometry/mesh/repair/solid_angle.hpp"
#include "geometry/primitives/box.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

namespace plekton::geometry {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

/// Facets in patches, each with the flips that make it agree with its first facet.
struct Patches {
  std::vector<std::uint32_t> patch_of;
  std::vector<bool> flip;
  std::vector<std::vector<std::uint32_t>> facets;
  std::vector<bool> orientable;
};

/// Spreads the side of the first facet of a patch over all facets that hang on through ordinary
/// edges.
void grow_patch(const EdgeTable& edges, std::uint32_t first, Patches& patches) {
  const auto patch = static_cast<std::uint32_t>(patches.facets.size());
  std::vector<std::uint32_t> members = {first};
  patches.patch_of[first] = patch;
  bool orientable = true;
  for (std::size_t next = 0; next < members.size(); ++next) {
    const std::uint32_t facet = members[next];
    for (const std::uint32_t edge : edges.edges_of(facet)) {
      const auto uses = edges.uses(edge);
      if (uses.size() != 2) continue;
      const std::uint32_t other = uses[0].facet == facet ? uses[1].facet : uses[0].facet;
      const bool disagree = uses[0].forward == uses[1].forward;
      const bool flip = patches.flip[facet] != disagree;
      if (patches.patch_of[other] == kNone) {
        patches.patch_of[other] = patch;
        patches.flip[other] = flip;
        members.push_back(other);
      } else if (patches.flip[other] != flip) {
        orientable = false;
      }
    }
  }
  patches.facets.push_back(std::move(members));
  patches.orientable.push_back(orientable);
}

Patches find_patches(std::size_t facet_count, const EdgeTable& edges) {
  Patches patches;
  patches.patch_of.assign(facet_count, kNone);
  patches.flip.assign(facet_count, false);
  for (std::uint32_t facet = 0; facet < facet_count; ++facet)
    if (patches.patch_of[facet] == kNone) grow_patch(edges, facet, patches);
  return patches;
}

/// A patch is closed if it runs along each of its edges as often in one direction as in the other.
std::vector<bool> closed_patches(const EdgeTable& edges, const Patches& patches) {
  std::vector<bool> closed(patches.facets.size(), true);
  std::vector<std::pair<std::uint32_t, int>> runs;
  for (std::size_t edge = 0; edge < edges.size(); ++edge) {
    runs.clear();
    for (const EdgeUse& use : edges.uses(edge))
      runs.emplace_back(patches.patch_of[use.facet],
                        use.forward != patches.flip[use.facet] ? 1 : -1);
    std::sort(runs.begin(), runs.end());
    for (std::size_t i = 0; i < runs.size();) {
      const std::uint32_t patch = runs[i].first;
      int sum = 0;
      for (; i < runs.size() && runs[i].first == patch; ++i) sum += runs[i].second;
      if (sum != 0) closed[patch] = false;
    }
  }
  return closed;
}

/// Signed volume (m³) of a closed patch, times 6, and the sum of the sizes of its terms.
std::pair<double, double> volume_times_six(const Mesh& mesh, const Patches& patches,
                                           std::size_t patch) {
  const auto& facets = patches.facets[patch];
  // Relative to a point of the patch, so that its distance from the world's origin costs no digits.
  const Vec3 origin = mesh.points[index_of(mesh.facets[facets.front()][0])];
  double sum = 0.0, size = 0.0;
  for (const std::uint32_t f : facets) {
    const auto& [a, b, c] = mesh.facets[f];
    const Vec3 xa = mesh.points[index_of(a)] - origin;
    const Vec3 xb = mesh.points[index_of(b)] - origin;
    const Vec3 xc = mesh.points[index_of(c)] - origin;
    const double term = xa.dot(xb.cross(xc));
    sum += patches.flip[f] ? -term : term;
    size += std::abs(term);
  }
  return {sum, size};
}

/// A closed patch.
struct Solid {
  std::size_t patch;
  bool faces_inward;
  Box bounds;
};

std::array<Vec3, 3> corners(const Mesh& mesh, std::uint32_t facet) {
  const auto& [a, b, c] = mesh.facets[facet];
  return {mesh.points[index_of(a)], mesh.points[index_of(b)], mesh.points[index_of(c)]};
}

Box bounds_of(const Mesh& mesh, const std::vector<std::uint32_t>& facets) {
  const Vec3 first = corners(mesh, facets.front())[0];
  Box box{first, first};
  for (const std::uint32_t f : facets)
    for (const Vec3& p : corners(mesh, f)) box = {box.lower.cwiseMin(p), box.upper.cwiseMax(p)};
  return box;
}

bool encloses(const Mesh& mesh, const Patches& patches, const Solid& outer, const Solid& inner) {
  if ((outer.bounds.lower.array() > inner.bounds.lower.array()).any() ||
      (outer.bounds.upper.array() < inner.bounds.upper.array()).any())
    return false;
  // The middle of a facet, because a node may be shared with the outer patch.
  const auto x = corners(mesh, patches.facets[inner.patch].front());
  const Vec3 point = (x[0] + x[1] + x[2]) / 3.0;
  double angle = 0.0;
  for (const std::uint32_t f : patches.facets[outer.patch])
    angle += (patches.flip[f] ? -1.0 : 1.0) * solid_angle(corners(mesh, f), point);
  return std::abs(angle) > 2.0 * std::numbers::pi;
}

/// Closed patches that face inward though they are no cavity, that is not inside an odd number of
/// others.
std::vector<bool> inside_out_patches(const Mesh& mesh, const Patches& patches,
                                     const std::vector<Solid>& solids) {
  std::vector<bool> inside_out(patches.facets.size(), false);
  for (const Solid& solid : solids) {
    if (!solid.faces_inward) continue;
    const auto outer = std::count_if(solids.begin(), solids.end(), [&](const Solid& other) {
      return other.patch != solid.patch && encloses(mesh, patches, other, solid);
    });
    inside_out[solid.patch] = outer % 2 == 0;
  }
  return inside_out;
}

/// Gives the facets of every orientable patch the sides that most of them came with, the first
/// one's on a tie.
void follow_the_majority(Patches& patches) {
  for (std::size_t patch = 0; patch < patches.facets.size(); ++patch) {
    const auto& facets = patches.facets[patch];
    const auto flipped = std::count_if(facets.begin(), facets.end(),
                                       [&](std::uint32_t f) { return patches.flip[f]; });
    const bool turn = 2 * static_cast<std::size_t>(flipped) > facets.size();
    for (const std::uint32_t f : facets)
      patches.flip[f] = patches.orientable[patch] && patches.flip[f] != turn;
  }
}

std::vector<Solid> find_solids(const Mesh& mesh, const EdgeTable& edges, const Patches& patches) {
  const std::vector<bool> closed = closed_patches(edges, patches);
  std::vector<Solid> solids;
  for (std::size_t patch = 0; patch < closed.size(); ++patch) {
    if (!closed[patch] || !patches.orientable[patch]) continue;
    const auto [volume, size] = volume_times_six(mesh, patches, patch);
    constexpr double kRounding = 1e-13;  // A few ulp of each term: below it the sign is noise.
    if (std::abs(volume) > kRounding * size)
      solids.push_back({patch, volume < 0.0, bounds_of(mesh, patches.facets[patch])});
  }
  return solids;
}

}  // namespace

Orientation find_orientation(const Mesh& mesh, const EdgeTable& edges) {
  Patches patches = find_patches(mesh.facets.size(), edges);
  follow_the_majority(patches);
  const auto inside_out = inside_out_patches(mesh, patches, find_solids(mesh, edges, patches));
  for (std::size_t f = 0; f < mesh.facets.size(); ++f)
    if (inside_out[patches.patch_of[f]]) patches.flip[f] = !patches.flip[f];

  Orientation result;
  result.patches = patches.facets.size();
  result.non_orientable_patches = static_cast<std::size_t>(
      std::count(patches.orientable.begin(), patches.orientable.end(), false));
  result.flipped =
      static_cast<std::size_t>(std::count(patches.flip.begin(), patches.flip.end(), true));
  result.flip = std::move(patches.flip);
  return result;
}

}  // namespace plekton::geometry
