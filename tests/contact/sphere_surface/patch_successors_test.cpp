// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_surface/patch_successors.hpp"

#include "tests/support/contact_surfaces.hpp"

#include <gtest/gtest.h>

namespace plekton::test::patch_successors_test {
namespace {

/// A surface with a ball over it.
struct Scene {
  explicit Scene(Complex c)
      : complex(std::move(c)), surface(complex.surface()), finder(surface), successors(surface) {}

  std::vector<std::uint32_t> successors_of(const std::vector<Feature>& minima, const Vec3& centre,
                                           double range) {
    const auto patches = finder.find(centre, range, all_cells(surface), complex.x);
    patch_count = patches.size();
    const auto found = successors.find(minima, centre, complex.x, patches, finder);
    return {found.begin(), found.end()};
  }

  Complex complex;
  Surface surface;
  PatchFinder finder;
  PatchSuccessors successors;
  std::size_t patch_count = 0;
};

using Places = std::vector<std::uint32_t>;

TEST(PatchSuccessors, LeadFromAnyFeatureOfAFlatSheetToItsOnePatch) {
  Scene scene(sheet(8));
  const Vec3 centre(4.3, 4.2, 0.9);

  for (const Feature feature : features_of(scene.surface)) {
    EXPECT_EQ(scene.successors_of({feature}, centre, 1.0), Places{0}) << feature;
  }
}

TEST(PatchSuccessors, AreNoneWhenTheSphereHasLeft) {
  Scene scene(sheet(8));

  EXPECT_EQ(scene.successors_of({Feature(FaceId{3})}, Vec3(4.3, 4.2, 1.1), 1.0), Places{});
}

TEST(PatchSuccessors, AreNoneWhereTheWalkEndsOutOfRange) {
  // Two bumps of a wire; the ball touches the one, the old contact was on the other.
  Complex wire;
  for (int i = 0; i < 5; ++i) wire.node(Vec3(i, 0, i % 2));
  for (int i = 0; i < 4; ++i) wire.cylinder(i, i + 1);
  Scene scene(wire);

  EXPECT_EQ(scene.successors_of({Feature(NodeId{3})}, Vec3(0.9, 0, 1.9), 1.0), Places{});
  EXPECT_EQ(scene.successors_of({Feature(NodeId{1})}, Vec3(0.9, 0, 1.9), 1.0), Places{0});
}

TEST(PatchSuccessors, AreAllPatchesOfASplitContactEachOnce) {
  Scene scene(book({45.0, 135.0}));
  const Feature left(FaceId{0});
  const Feature right(FaceId{1});
  const Vec3 centre(0, std::numbers::sqrt2 * 0.6, 0);

  EXPECT_EQ(scene.successors_of({left, right}, centre, 0.61), (Places{0, 1}));
  EXPECT_EQ(scene.patch_count, 2u);
  EXPECT_EQ(scene.successors_of({left, right, left}, centre, 0.9), Places{0});
  EXPECT_EQ(scene.patch_count, 1u);
}

}  // namespace
}  // namespace plekton::test::patch_successors_test
