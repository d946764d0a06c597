// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/bed_maker.hpp"
#include "tests/benchmarks/measurement.hpp"
#include "tests/benchmarks/scenes/laws.hpp"
#include "tests/benchmarks/scenes/parts.hpp"
#include "tests/benchmarks/scenes/scene_table.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace plekton::benchmarks::scenes_test {
namespace {

constexpr std::size_t kFewSpheres = 100;

Bed small_bed(BedKind kind, int threads = 1) {
  std::ostringstream progress;
  return make_bed({kind, kFewSpheres, 1, threads}, progress);
}

/// Beds are in contact from the start. A hollow sphere falls 1 mm at 0.5 m/s until it does, after
/// 496 steps; two fly at each other at 0.4 m/s over 0.05 mm, 31 steps; a boulder falls 5 mm at 5
/// m/s, 250 steps.
int steps_to_first_contact(const SceneEntry& entry) {
  if (entry.bed) return 0;
  if (entry.name == "s5") return 270;
  return entry.name == "s4a" ? 510 : 40;
}

void expect_equal(const Bed& a, const Bed& b, double relative_error) {
  ASSERT_EQ(a.grains.size(), b.grains.size());
  EXPECT_NEAR(a.side, b.side, relative_error * a.side);
  EXPECT_EQ(a.extent, b.extent);
  for (std::size_t i = 0; i < a.grains.size(); ++i) {
    const Bed::Grain& g = a.grains[i];
    const Bed::Grain& h = b.grains[i];
    EXPECT_NEAR(g.radius, h.radius, relative_error * g.radius);
    EXPECT_LE((g.position - h.position).norm(), relative_error * g.position.norm());
    EXPECT_LE((g.velocity - h.velocity).norm(), relative_error * g.velocity.norm());
    EXPECT_LE((g.angular_velocity - h.angular_velocity).norm(),
              relative_error * g.angular_velocity.norm());
  }
}

TEST(BenchmarkScenes, AllRunAndHaveContactsUnlessTheyAreLifted) {
  for (const SceneEntry& entry : scene_table()) {
    SCOPED_TRACE(entry.name);
    const SceneInput input{entry.bed ? small_bed(*entry.bed) : Bed{}, 4};
    const int warm_up = steps_to_first_contact(entry);

    const Measurement result = measure(entry.make(input), {warm_up, 20});

    EXPECT_EQ(total(result.contacts) > 0, !entry.name.ends_with("_lifted"));
    EXPECT_GT(result.elements + (entry.elements == "spheres" ? 1U : 0U), input.bed.grains.size());
    EXPECT_GT(result.wall, 0.0);
    EXPECT_TRUE(std::isfinite(result.state.kinetic_energy));
    EXPECT_LT(result.state.lowest_node, result.state.mean_height);
    EXPECT_LT(result.state.mean_height, result.state.highest_node);
  }
}

TEST(BenchmarkScenes, RunUnderEveryLaw) {
  const Bed bed = small_bed(BedKind::slab);
  for (const std::string& law : law_names()) {
    SCOPED_TRACE(law);
    BenchmarkScene scene = find_scene("s2").make({bed, 4});
    set_law(law, scene);

    const Measurement result = measure(std::move(scene), {0, 20});

    EXPECT_GT(result.contacts.sphere_sphere, 0U);
    EXPECT_TRUE(std::isfinite(result.state.kinetic_energy));
  }
  BenchmarkScene scene = find_scene("s2").make({bed, 4});
  EXPECT_THROW(set_law("glue", scene), std::invalid_argument);
}

TEST(BenchmarkScenes, AreListedWhereAnUnknownOneIsAskedFor) {
  EXPECT_THAT(
      [] { find_scene("s9"); },
      testing::ThrowsMessage<std::invalid_argument>(testing::AllOf(
          testing::HasSubstr("'s9'"), testing::HasSubstr("s1flow"), testing::HasSubstr("s4b"))));
}

TEST(BenchmarkScenes, LayersDifferInTheirContactsAlone) {
  for (const std::string ground : {"layer_sheet", "layer_spheres"}) {
    const Measurement on = measure(find_scene(ground).make({}), {200, 600});
    const Measurement above = measure(find_scene(ground + "_lifted").make({}), {200, 600});

    // Each sphere on one body; where a sphere is over an edge, its patch is one contact all the
    // same.
    EXPECT_EQ(total(on.contacts), 4096U);
    EXPECT_EQ(on.contacts.with_planes + on.contacts.between_structures, 0U);
    EXPECT_EQ(total(above.contacts), 0U);
    EXPECT_EQ(on.elements, above.elements);
  }
}

TEST(BenchmarkScenes, PullAGeogridOfThePeersSizeThroughABedOfTenThousandSpheres) {
  Bed bed{0.0411761546, 1.0, {}};  // the side of that bed, with one sphere in it
  bed.grains.push_back({{0.02, 0.02, 0.001}, 1e-3, Vec3::Zero(), Vec3::Zero()});

  const BenchmarkScene scene = find_scene("s3").make({bed});

  EXPECT_EQ(scene.scene.elements.cylinders.size(), 360U);
  EXPECT_EQ(scene.element_count, 361U);
}

TEST(BenchmarkScenes, RefuseABoxThatIsTooNarrowForAGeogrid) {
  Bed bed{0.007, 1.0, {}};
  bed.grains.push_back({{0.003, 0.003, 0.001}, 1e-3, Vec3::Zero(), Vec3::Zero()});

  EXPECT_THROW(find_scene("s3").make({bed}), std::invalid_argument);
}

TEST(BenchmarkScenes, HaveThePeersCountsOfFacets) {
  EXPECT_EQ(find_scene("s4a").make({}).element_count, 1280U);
  EXPECT_EQ(find_scene("s4b").make({}).element_count, 6400U);
}

TEST(BedMaker, LeavesSpheresAtRestInTheirBox) {
  const Bed bed = small_bed(BedKind::cube);

  EXPECT_EQ(bed.grains.size(), kFewSpheres);
  double kinetic_energy = 0.0;  // over m, J/kg
  for (const Bed::Grain& grain : bed.grains) {
    const Vec3& x = grain.position;
    kinetic_energy += 0.5 * grain.velocity.squaredNorm();
    // A wall gives way by far less than a tenth of a radius.
    EXPECT_GT(std::min({x.x(), x.y(), x.z()}), 0.9 * grain.radius);
    EXPECT_LT(std::max(x.x(), x.y()), bed.side - 0.9 * grain.radius);
  }
  // Masses differ from their mean by 33 % at most.
  EXPECT_LT(kinetic_energy / kFewSpheres, 1.5 * kRest * kGravity.norm() * kSphereRadius);
}

TEST(BedMaker, MakesTheSameBedOnAnyNumberOfThreads) {
  expect_equal(small_bed(BedKind::cube, 1), small_bed(BedKind::cube, 2), 0.0);
}

TEST(BedMaker, LetsAFlowRunOutOfItsBox) {
  const Bed bed = small_bed(BedKind::flow);

  EXPECT_EQ(bed.extent, 3.0);
  const auto is_out = [&](const Bed::Grain& grain) { return grain.position.x() > bed.side; };
  EXPECT_TRUE(std::any_of(bed.grains.begin(), bed.grains.end(), is_out));
}

TEST(BedMaker, RefusesABedOfNothing) {
  std::ostringstream progress;

  EXPECT_THROW(make_bed({BedKind::cube, 0}, progress), std::invalid_argument);
  EXPECT_THROW(side_by_side(Bed{}, 0), std::invalid_argument);
}

TEST(BedMaker, LaysCopiesSideBySide) {
  const Bed bed = small_bed(BedKind::slab);

  const Bed copies = side_by_side(bed, 2);

  ASSERT_EQ(copies.grains.size(), 4 * kFewSpheres);
  EXPECT_EQ(copies.side, 2.0 * bed.side);
  const Vec3 shift = copies.grains.back().position - bed.grains.back().position;
  EXPECT_LE((shift - Vec3(bed.side, bed.side, 0.0)).norm(), 1e-12 * bed.side);
}

TEST(Bed, ComesBackFromAFile) {
  const Bed bed = small_bed(BedKind::cube);
  const test::TemporaryFolder folder;

  write_bed(bed, folder / "bed.txt");

  constexpr double kTwelveDigits = 1e-11;
  expect_equal(bed, read_bed(folder / "bed.txt"), kTwelveDigits);
}

TEST(Bed, SaysWhichLineOfAFileIsShort) {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "bed.txt", "2 0.01 1\n0 0 0 1e-3 0 0 0 0 0 0\n0 0 0 1e-3 0 0 0 0 0\n");

  EXPECT_THAT([&] { read_bed(folder / "bed.txt"); },
              testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr("line 3")));
}

TEST(Bed, RefusesANumberOfSpheresThatItHasNoLinesForBeforeMemoryIsTaken) {
  for (const char* count : {"1000000000000000", "-5", "1.5", "nan", "3"}) {
    const std::string text =
        std::string(count) + " 0.01 1\n0 0 0 1e-3 0 0 0 0 0 0\n0 0 0 1e-3 0 0 0 0 0 0\n";
    EXPECT_THAT([&] { parse_bed(text, "bed"); },
                testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr("line 1")))
        << count;
  }
}

}  // namespace
}  // namespace plekton::benchmarks::scenes_test
