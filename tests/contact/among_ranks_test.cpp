// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts that several ranks compute have the bits of those of one process: forces, energies,
// records with their numbers.
#include "contact/among_ranks.hpp"

#include "contact/law/cohesive_frictional.hpp"
#include "contact/law/hertz_mindlin.hpp"
#include "contact/models.hpp"
#include "contact/sphere_sphere/shared_motion.hpp"
#include "geometry/base/state_archive.hpp"
#include "tests/support/seeded_random.hpp"
#include "tests/support/thread_ranks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <mutex>
#include <set>
#include <span>
#include <vector>

namespace plekton::contact::among_ranks_test {
namespace {

/// Spheres in a dense cube that shake on the spot and turn; two sizes and two materials.
class ShakenSpheres {
 public:
  ShakenSpheres(int per_side, const ContactModel& model, int threads) : pool_(threads) {
    test::Random random(5);
    for (int i = 0; i < per_side; ++i)
      for (int j = 0; j < per_side; ++j)
        for (int k = 0; k < per_side; ++k) {
          spheres_.push_back(
              {{geometry::id_at<NodeId>(at_rest_.size())}, random.uniform(0.48, 0.56)});
          at_rest_.push_back(Vec3(i, j, k) + random.in_cube(0.03));
          way_.push_back(random.in_cube(0.12));
          spin_.push_back(random.in_cube(2.0));
          materials_.push_back(MaterialId{random.uniform(0.0, 1.0) < 0.3 ? 1 : 0});
        }
    surface_ = geometry::Surface({}, {}, at_rest_.size());
    contacts_ = model({.spheres = spheres_,
                       .surface = surface_,
                       .materials = {Material{1e6, 0.5, 0.4}, Material{3e6, 0.3, 0.2}},
                       .of_spheres = materials_,
                       .of_structures = {},
                       .masses = {},
                       .skin = 0.05,
                       .meets_planes = {},
                       .rest = {}});
    forces_ = NodeForces(at_rest_.size());
    orientation_.assign(at_rest_.size(), geometry::Quat::Identity());
    planes_.push_back({Vec3(0, 0, -0.48), Vec3::UnitZ(), Vec3::Zero(), MaterialId{0}});
    planes_.push_back({Vec3(-0.48, 0, 0), Vec3::UnitX(), Vec3(0, 2, 0), MaterialId{1}});
  }

  /// From here on the last spheres are far from all others: those before them fill one block.
  void scatter(bool are_scattered) { are_scattered_ = are_scattered; }

  /// @returns a hash of all that can be seen of a step
  std::uint64_t step(int number, bool looks) {
    const double dt = 1e-3;
    const double phase = 0.05 * number;
    x_ = at_rest_;
    std::vector<Vec3> v = way_;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      x_[i] += (phase - phase * phase) * way_[i];
      v[i] = 50.0 * (1.0 - 2.0 * phase) * way_[i];
    }
    constexpr std::size_t kOfOneBlock = 1200;
    for (std::size_t i = kOfOneBlock; are_scattered_ && i < x_.size(); ++i)
      x_[i] += Vec3(2.0 * static_cast<double>(i), 0, 50);
    contacts_->advance({x_, v, spin_}, planes_, dt, pool_, forces_);
    if (SharedMotion* const shared = contacts_->shared_motion())
      shared->tell_all({x_, v, spin_, orientation_, forces_.force, forces_.torque});
    std::uint64_t hash = 1469598103934665603ULL;
    const auto add = [&](double number_of) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(number_of)) * 1099511628211ULL;
    };
    const auto add_vector = [&](const Vec3& vector) {
      for (int axis = 0; axis < 3; ++axis) add(vector[axis]);
    };
    for (const Vec3& force : forces_.force) add_vector(force);
    for (const Vec3& torque : forces_.torque) add_vector(torque);
    add(contacts_->dissipated());
    add(contacts_->tracking_loss());
    add(contacts_->largest_overlap_ratio());
    add(static_cast<double>(contacts_->counts().sphere_sphere));
    add(static_cast<double>(contacts_->counts().with_planes));
    if (number % 3 == 0) {
      add_vector(contacts_->on_plane(1).force);
      contacts_->for_each_plane_pair(
          [&](NodeId node, std::size_t plane, const PairSprings&, double gap) {
            add(static_cast<double>(10 * index_of(node) + plane));
            add(gap);
          });
    }
    if (!looks) return hash;
    add_vector(contacts_->on_plane(0).moment);
    add(contacts_->on_plane(1).push);
    add(contacts_->elastic_energy());
    const auto add_pair = [&](NodeId a, NodeId b, const PairSprings& springs, double gap) {
      add(static_cast<double>(7 * index_of(a) + index_of(b)));
      add(springs.stiffness(gap).normal);
      add(gap);
    };
    contacts_->for_each_sphere_pair(add_pair);
    contacts_->for_each_near_sphere_pair(0.02, x_, add_pair);
    contacts_->assign_ids();
    contacts_->for_each_record(x_, [&](const ContactRecord& row) {
      add(static_cast<double>(row.id));
      add_vector(row.point);
      add_vector(row.force());
    });
    return hash;
  }

  void exchange(const geometry::StateArchive& archive) {
    contacts_->exchange(archive, planes_, pool_);
  }

  std::int64_t list_count() const { return contacts_->list_count(); }
  const Contacts& contacts() const { return *contacts_; }

 private:
  std::vector<geometry::Sphere> spheres_;
  geometry::Surface surface_;
  std::vector<Vec3> at_rest_, x_, way_, spin_;
  std::vector<geometry::Quat> orientation_;
  std::vector<MaterialId> materials_;
  std::vector<Plane> planes_;
  std::unique_ptr<Contacts> contacts_;
  NodeForces forces_;
  geometry::ThreadPool pool_;
  bool are_scattered_ = false;
};

constexpr int kPerSide = 12;  // 1728 spheres: eight blocks
constexpr int kSteps = 40;

bool looks_after(int step) {
  return step % 7 == 3;
}

std::vector<std::uint64_t> hashes(const ContactModel& model, int threads = 1) {
  ShakenSpheres spheres(kPerSide, model, threads);
  std::vector<std::uint64_t> all;
  for (int step = 0; step < kSteps; ++step) all.push_back(spheres.step(step, looks_after(step)));
  EXPECT_GT(spheres.list_count(), 3);
  return all;
}

/// Of two steps of so many spheres that what they remember goes into several messages.
std::vector<std::uint64_t> hashes_of_many(const ContactModel& model) {
  constexpr int kMany = 24;  // 13824 spheres, of which each has some 450 bytes
  ShakenSpheres spheres(kMany, model, 1);
  return {spheres.step(0, true), spheres.step(1, true)};
}

/// Of steps between which there are several blocks, then one, then several again.
std::vector<std::uint64_t> hashes_of_scattered(const ContactModel& model) {
  ShakenSpheres spheres(11, model, 1);  // 1331
  std::vector<std::uint64_t> all;
  for (int step = 0; step < 9; ++step) {
    spheres.scatter(step / 3 == 1);
    all.push_back(spheres.step(step, step % 2 == 0));
  }
  return all;
}

constexpr int kStepOfState = 13;

/// What a state has after some steps.
geometry::StateTree state_of(const ContactModel& model) {
  ShakenSpheres spheres(kPerSide, model, 1);
  for (int step = 0; step < kStepOfState; ++step) spheres.step(step, looks_after(step));
  geometry::StateTree tree;
  spheres.exchange(geometry::StateArchive::writer(tree));
  return tree;
}

/// Of the steps that go on from there.
std::vector<std::uint64_t> hashes_from(const geometry::StateTree& state,
                                       const ContactModel& model) {
  ShakenSpheres spheres(kPerSide, model, 1);
  spheres.exchange(geometry::StateArchive::reader(state));
  std::vector<std::uint64_t> all;
  for (int step = kStepOfState; step < kStepOfState + 12; ++step)
    all.push_back(spheres.step(step, looks_after(step)));
  return all;
}

/// With one law, and with pairs of materials of different ones.
std::vector<ContactModel> models() {
  PairProperties<AnyLaw> mixed;
  mixed[{MaterialId{0}, MaterialId{1}}] = AnyLaw::of<HertzMindlin>();
  mixed[{MaterialId{1}, MaterialId{1}}] = AnyLaw::of<CohesiveFrictional>();
  return {linear_frictional(), any_law(mixed, AnyLaw::of<LinearFrictional>())};
}

void expect_same_bits(int count, bool by_chance, int threads = 1) {
  for (const ContactModel& model : models()) {
    const std::vector<std::uint64_t> alone = hashes(model);
    std::mutex mutex;
    test::ThreadRanks(count, by_chance).run([&](geometry::Ranks& ranks) {
      const std::vector<std::uint64_t> together = hashes(among_ranks(model, ranks), threads);
      const std::lock_guard lock(mutex);
      EXPECT_EQ(together, alone) << "rank " << ranks.rank() << " of " << count;
    });
  }
}

TEST(AmongRanks, HaveTheBitsOfOneProcessOnAnyNumberOfRanks) {
  for (const int count : {1, 2, 3, 5}) expect_same_bits(count, false);
}

TEST(AmongRanks, HaveThemWithOwnersByChanceAtEveryList) {
  for (const int count : {2, 5}) expect_same_bits(count, true);
}

TEST(AmongRanks, HaveThemWithThreadsInRanks) {
  expect_same_bits(2, false, 2);
}

TEST(AmongRanks, HaveThemWhereWhatTheyRememberGoesIntoSeveralMessages) {
  const std::vector<std::uint64_t> alone = hashes_of_many(linear_frictional());
  std::mutex mutex;
  test::ThreadRanks(3).run([&](geometry::Ranks& ranks) {
    const std::vector<std::uint64_t> together =
        hashes_of_many(among_ranks(linear_frictional(), ranks));
    const std::lock_guard lock(mutex);
    EXPECT_EQ(together, alone) << "rank " << ranks.rank();
  });
}

TEST(AmongRanks, HaveThemWhereThereIsNothingToShareForAWhile) {
  for (const ContactModel& model : models()) {
    const std::vector<std::uint64_t> alone = hashes_of_scattered(model);
    std::mutex mutex;
    test::ThreadRanks(3, true).run([&](geometry::Ranks& ranks) {
      const std::vector<std::uint64_t> together = hashes_of_scattered(among_ranks(model, ranks));
      const std::lock_guard lock(mutex);
      EXPECT_EQ(together, alone) << "rank " << ranks.rank();
    });
  }
}

TEST(AmongRanks, GoOnFromAStateOfAnyNumberOfRanks) {
  for (const ContactModel& model : models()) {
    const geometry::StateTree of_one = state_of(model);
    const std::vector<std::uint64_t> alone = hashes_from(of_one, model);
    const std::vector<std::uint64_t> all = hashes(model);
    EXPECT_TRUE(std::ranges::equal(alone, std::span(all).subspan(kStepOfState, alone.size())));
    std::mutex mutex;
    geometry::StateTree of_ranks;
    test::ThreadRanks(3).run([&](geometry::Ranks& ranks) {
      const std::vector<std::uint64_t> together = hashes_from(of_one, among_ranks(model, ranks));
      geometry::StateTree state = state_of(among_ranks(model, ranks));
      const std::lock_guard lock(mutex);
      EXPECT_EQ(together, alone) << "rank " << ranks.rank();
      if (ranks.rank() == 1) of_ranks = std::move(state);
    });
    EXPECT_EQ(hashes_from(of_ranks, model), alone);
    test::ThreadRanks(5, true).run([&](geometry::Ranks& ranks) {
      const std::vector<std::uint64_t> together = hashes_from(of_ranks, among_ranks(model, ranks));
      const std::lock_guard lock(mutex);
      EXPECT_EQ(together, alone) << "rank " << ranks.rank();
    });
  }
}

TEST(AmongRanks, TellWhatEachDoesAlone) {
  std::mutex mutex;
  std::set<std::vector<std::size_t>> told;
  test::ThreadRanks(3).run([&](geometry::Ranks& ranks) {
    ShakenSpheres spheres(kPerSide, among_ranks(linear_frictional(), ranks), 1);
    spheres.step(0, false);
    std::vector<std::size_t> counts;
    for (const RankShare& share : shares_of_ranks(spheres.contacts()))
      counts.insert(counts.end(), {share.blocks, share.spheres});
    const std::lock_guard lock(mutex);
    told.insert(counts);
  });
  ASSERT_EQ(told.size(), 1U) << "all know the same";
  ASSERT_EQ(told.begin()->size(), 6U);
  EXPECT_GT(std::ranges::min(*told.begin()), 0U);

  ShakenSpheres alone(kPerSide, linear_frictional(), 1);
  alone.step(0, false);
  EXPECT_TRUE(shares_of_ranks(alone.contacts()).empty());
}

TEST(AmongRanks, HaveThemWithMoreRanksThanBlocks) {
  expect_same_bits(11, false);
}

}  // namespace
}  // namespace plekton::contact::among_ranks_test
