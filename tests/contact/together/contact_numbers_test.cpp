// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/ball_on_surface.hpp"
#include "tests/support/moving_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

/// A contact keeps its number as long as it lasts, and no number is given twice.
namespace plekton::test::contact_numbers_test {
namespace {

constexpr double kStep = 0.02;  // s
constexpr int kSteps = 140;

std::set<std::int64_t> ids_of(const std::vector<ContactRecord>& rows) {
  std::set<std::int64_t> ids;
  for (const ContactRecord& row : rows) ids.insert(row.id);
  return ids;
}

TEST(ContactNumbers, AreTheSameFromElementToElement) {
  SphereOnSurface ball(centred(sheet(16), 16, 0.25), 0.9, Material{1e6, 0.5, 0.3});
  ball.put(Vec3(-0.8, -0.31, 0.95));

  for (int k = 0; k < 40; ++k) {
    ball.move(Vec3(0.04, 0.013, 0));
    if (k == 20) ball.rebuild();
    const std::vector<ContactRecord> rows = ball.numbered_rows();
    ASSERT_EQ(rows.size(), 1u);
    ASSERT_EQ(rows[0].id, 1);
  }
}

TEST(ContactNumbers, AreNewWhenBodiesMeetAgain) {
  SphereOnSurface ball(centred(sheet(4), 4, 0.5), 0.9, Material{1e6, 0.5, 0.3});
  ball.put(Vec3(0.1, 0.05, 0.95));
  EXPECT_EQ(ball.numbered_rows().at(0).id, 1);

  ball.put(Vec3(0.1, 0.05, 1.2));
  ball.put(Vec3(0.1, 0.05, 0.95));

  EXPECT_EQ(ball.numbered_rows().at(0).id, 2);
}

/// A valley along y whose sides rise by an angle.
Complex valley(double angle) {
  Complex complex;
  const double x = 3.0 * std::cos(angle), z = 3.0 * std::sin(angle);
  for (const double y : {-3.0, 3.0}) {
    complex.node(Vec3(0, y, 0));
    complex.node(Vec3(-x, y, z));
    complex.node(Vec3(x, y, z));
  }
  complex.facet(0, 3, 1);
  complex.facet(1, 3, 4);
  complex.facet(0, 2, 3);
  complex.facet(2, 5, 3);
  return complex;
}

// Deep in the valley the crease is in range, and both sides are one patch; higher up they are two.
TEST(ContactNumbers, GoToTheLargerPartOfWhatSplitsAndStayThatOfTheLargerWhereTheyMerge) {
  SphereOnSurface ball(valley(0.35), 0.9, Material{1e6, 0.5, 0.3});
  const double range = ball.range();
  const Vec3 low(0, 0.1, 0.99 * range), high(0, 0.1, 1.03 * range);
  const Vec3 left(-0.01, 0, 0);
  ball.put(low);
  ASSERT_EQ(ball.numbered_rows().size(), 1u);

  ball.put(high + left);
  const std::vector<ContactRecord> split = ball.numbered_rows();
  ASSERT_EQ(split.size(), 2u);
  for (const ContactRecord& row : split) EXPECT_EQ(row.id, row.normal[0] < 0.0 ? 1 : 2);

  ball.put(high - left);  // now the right side pushes more
  EXPECT_EQ(ids_of(ball.numbered_rows()), (std::set<std::int64_t>{1, 2}));
  ball.put(low - left);
  const std::vector<ContactRecord> merged = ball.numbered_rows();
  ASSERT_EQ(merged.size(), 1u);
  EXPECT_EQ(merged[0].id, 2);
}

TEST(ContactNumbers, AreGivenOnceAndEndWithTheContact) {
  MovingScene scene(60, 0.05, 1, 1);
  std::set<std::int64_t> last, ended;
  std::map<std::int64_t, std::pair<ContactBody, ContactBody>> bodies;
  for (int k = 0; k < kSteps; ++k) {
    scene.step(kStep);
    const std::vector<ContactRecord> rows = scene.list();
    const std::set<std::int64_t> now = ids_of(rows);
    ASSERT_EQ(now.size(), rows.size());
    ASSERT_EQ(now.count(0), 0u);
    for (const std::int64_t id : last)
      if (now.count(id) == 0) ended.insert(id);
    for (const ContactRecord& row : rows) {
      ASSERT_EQ(ended.count(row.id), 0u);
      const auto& [first, is_new] = bodies.try_emplace(row.id, row.a, row.b);
      ASSERT_EQ(first->second.first.index, row.a.index);
      ASSERT_EQ(first->second.second.index, row.b.index);
      ASSERT_EQ(first->second.second.kind, row.b.kind);
    }
    last = now;
  }
  EXPECT_GT(ended.size(), 20u);
}

// Numbers differ, but what is one contact for one reader is one for the other.
TEST(ContactNumbers, MeanTheSameContactsHoweverOftenTheyAreAskedFor) {
  MovingScene often(60, 0.05, 1, 1), rarely(60, 0.05, 1, 1);
  std::map<std::int64_t, std::int64_t> to, from;
  std::size_t compared = 0;
  for (int k = 0; k < kSteps; ++k) {
    often.step(kStep);
    rarely.step(kStep);
    const std::vector<ContactRecord> rows = often.list();
    if (k % 9 != 0) continue;
    const std::vector<ContactRecord> others = rarely.list();
    ASSERT_EQ(rows.size(), others.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      ASSERT_EQ(to.try_emplace(rows[i].id, others[i].id).first->second, others[i].id);
      ASSERT_EQ(from.try_emplace(others[i].id, rows[i].id).first->second, rows[i].id);
      ++compared;
    }
  }
  EXPECT_GT(compared, 2 * to.size());  // most are seen several times
}

TEST(ContactNumbers, DoNotDependOnTheNumberOfThreads) {
  MovingScene one(60, 0.05, 1, 1);
  std::vector<std::unique_ptr<MovingScene>> others;
  for (const int threads : {2, 4})
    others.push_back(std::make_unique<MovingScene>(60, 0.05, 1, threads));
  for (int k = 0; k < kSteps; ++k) {
    one.step(kStep);
    for (auto& other : others) other->step(kStep);
    if (k % 4 != 0) continue;
    const std::vector<ContactRecord> rows = one.list();
    for (auto& other : others) {
      const std::vector<ContactRecord> same = other->list();
      ASSERT_EQ(rows.size(), same.size());
      for (std::size_t i = 0; i < rows.size(); ++i) {
        ASSERT_EQ(rows[i].id, same[i].id);
        ASSERT_EQ(rows[i].a, same[i].a);
        ASSERT_EQ(rows[i].b, same[i].b);
        ASSERT_EQ(rows[i].force(), same[i].force());
      }
    }
  }
}

/// A small sheet that is moved over a larger one.
class SheetOnSheet {
 public:
  SheetOnSheet() {
    add(centred(sheet(8), 8, 0.5));
    first_of_small_ = complex_.x.size();
    add(centred(sheet(2), 2, 0.45));
    for (std::size_t i = first_of_small_; i < complex_.x.size(); ++i)
      complex_.x[i] += Vec3(-0.83, -0.41, 0.19);  // both are 0.2 thick
    surface_ = complex_.surface();
    contacts_ = std::make_unique<SceneContacts>(
        std::span<const Sphere>(), surface_,
        ContactMaterials{
            MaterialPairs({Material{1e6, 0.5, 0.3}}), {}, {MaterialId{0}, MaterialId{0}}},
        0.05);
  }
  std::vector<ContactRecord> move(const Vec3& way) {
    const std::vector<Vec3> still(complex_.x.size(), Vec3::Zero());
    for (std::size_t i = first_of_small_; i < complex_.x.size(); ++i) complex_.x[i] += way;
    NodeForces forces(complex_.x.size());
    contacts_->advance({complex_.x, still, still}, {}, 1.0, pool_, forces);
    contacts_->assign_ids();
    std::vector<ContactRecord> rows;
    contacts_->for_each_record(complex_.x, [&](const ContactRecord& row) { rows.push_back(row); });
    return rows;
  }

 private:
  void add(const Complex& part) {
    const int first = static_cast<int>(complex_.x.size());
    const auto at = [&](NodeId node) { return first + static_cast<int>(node); };
    for (const Vec3& x : part.x) complex_.node(x);
    for (const auto& f : part.facets)
      complex_.facet(at(f.nodes[0]), at(f.nodes[1]), at(f.nodes[2]));
  }

  Complex complex_;
  std::size_t first_of_small_ = 0;
  Surface surface_;
  std::unique_ptr<SceneContacts> contacts_;
  geometry::ThreadPool pool_;
};

TEST(ContactNumbers, OfStructuresLastAsTheySlideAndEndWhereTheyPart) {
  SheetOnSheet sheets;
  std::set<geometry::Feature> features;
  for (int k = 0; k < 60; ++k) {
    const std::vector<ContactRecord> rows = sheets.move(Vec3(0.021, 0.013, 0));
    ASSERT_EQ(rows.size(), 1u);
    ASSERT_EQ(rows[0].id, 1);
    features.insert(rows[0].a.feature);
  }
  EXPECT_GT(features.size(), 2u);

  EXPECT_TRUE(sheets.move(Vec3(0, 0, 0.1)).empty());
  EXPECT_EQ(sheets.move(Vec3(0, 0, -0.1)).at(0).id, 2);
}

TEST(ContactRecord, SaysWhetherAContactSlips) {
  const Material material{1e6, 0.5, 0.3};
  SphereOnSurface ball(centred(sheet(8), 8, 0.5), 0.9, material);
  ball.put(Vec3(0.03, 0.02, 0.95));
  const double overlap = ball.range() - 0.95;
  // k_s = k_n / 2, so it slips beyond twice the friction times the overlap.
  const double limit = 2.0 * material.friction * overlap;

  ball.move(Vec3(0.9 * limit, 0, 0));
  EXPECT_FALSE(ball.rows().at(0).is_slipping);
  ball.move(Vec3(0.2 * limit, 0, 0));
  EXPECT_TRUE(ball.rows().at(0).is_slipping);
  ball.move(Vec3(-0.1 * limit, 0, 0));
  EXPECT_FALSE(ball.rows().at(0).is_slipping);
  EXPECT_FALSE(ball.rows().at(0).is_bonded);
}

/// Friction of bars, and of sheets that lie on each other, is that of their spread contacts alone.
TEST(ContactRecord, SaysWhetherBarsThatCrossSlip) {
  const double friction = 0.3;
  const double overlap = 0.01;  // of two radii of 0.1
  Complex bars;
  bars.node(Vec3(-1, 0, 0));
  bars.node(Vec3(1, 0, 0));
  bars.node(Vec3(0.1, -1, 0.2 - overlap));
  bars.node(Vec3(0.1, 1, 0.2 - overlap));
  bars.cylinder(0, 1);
  bars.cylinder(2, 3);
  const Surface surface = bars.surface();
  SceneContacts contacts(
      std::span<const Sphere>(), surface,
      ContactMaterials{
          MaterialPairs({Material{1e6, 0.5, friction}}), {}, {MaterialId{0}, MaterialId{0}}},
      0.05);
  geometry::ThreadPool pool;
  const auto slips_after = [&](double way) {
    std::vector<Vec3> velocity(bars.x.size(), Vec3::Zero());
    velocity[2] = velocity[3] = Vec3(way, 0, 0);
    bars.x[2] += velocity[2];
    bars.x[3] += velocity[3];
    const std::vector<Vec3> still(bars.x.size(), Vec3::Zero());
    NodeForces forces(bars.x.size());
    contacts.advance({bars.x, velocity, still}, {}, 1.0, pool, forces);
    std::vector<ContactRecord> rows;
    contacts.for_each_record(bars.x, [&](const ContactRecord& row) { rows.push_back(row); });
    EXPECT_EQ(rows.size(), 1U);
    return rows.at(0).is_slipping;
  };
  // k_s = k_n / 2, so they slip beyond twice the friction times the overlap.
  const double limit = 2.0 * friction * overlap;

  EXPECT_FALSE(slips_after(0.0));
  EXPECT_FALSE(slips_after(0.9 * limit));
  EXPECT_TRUE(slips_after(0.2 * limit));
  EXPECT_FALSE(slips_after(-0.1 * limit));
}

}  // namespace
}  // namespace plekton::test::contact_numbers_test
