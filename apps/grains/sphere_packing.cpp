// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/grains/sphere_packing.hpp"

#include "geometry/base/elementary.hpp"
#include "geometry/closest/point_triangle.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plekton::apps {
namespace {

// Of FIRE, as its authors recommend.
constexpr int kStepsBeforeFaster = 5;
constexpr double kFaster = 1.1;
constexpr double kSlower = 0.5;
constexpr double kMix = 0.1;
constexpr double kLessMix = 0.99;
// In units of sqrt(mass / stiffness) of a contact. A sphere among twelve has a highest frequency of
// up to sqrt(24) in these, so that steps below 0.4 are stable.
constexpr double kFirstStep = 0.1;
constexpr double kLongestStep = 0.25;

constexpr double kApart = 2e-4;  // of the radii, by which spheres are larger while they are relaxed
constexpr double kBalanced = 1e-3;  // sum of the resultants over that of the forces of contacts
constexpr int kStepsBetweenLooks = 20;
constexpr int kMostSteps = 6000;  // of one relaxation

constexpr double kSkin = 0.25;         // of the smallest radius
constexpr double kFirstGrowth = 0.02;  // of the volume of the container that solids take more of
constexpr double kNearJamming = 0.55;  // solids of that volume from which on growth is slower
constexpr double kSlowGrowth = 0.005;
constexpr double kLeastGrowth = 6e-4;
constexpr double kPressureTolerance = 0.01;
constexpr int kMostCompressions = 60;

double cube(double x) {
  return x * x * x;
}

std::vector<contact::Plane> sides_of(const Container& container) {
  std::vector<contact::Plane> sides;
  if (container.is_inside) return sides;
  if (container.cylinder) {
    const Vec3 axis = (container.cylinder->to - container.cylinder->from).normalized();
    sides.push_back({container.cylinder->from, axis});
    sides.push_back({container.cylinder->to, -axis});
    sides.push_back({.point = container.cylinder->from,
                     .normal = Vec3::Zero(),
                     .form = contact::Plane::Form::cylinder,
                     .radius = container.cylinder->radius,
                     .axis = axis});
    return sides;
  }
  for (int axis = 0; axis < 3; ++axis) {
    sides.push_back({container.bounds.lower, Vec3::Unit(axis)});
    sides.push_back({container.bounds.upper, -Vec3::Unit(axis)});
  }
  return sides;
}

/// Whether two planes are the same wall, to rounding.
/// @param size  m, of the container
bool are_one(const contact::Plane& a, const contact::Plane& b, double size) {
  constexpr double kSame = 1e-9;
  if (a.form != b.form || std::abs(a.radius - b.radius) > kSame * size) return false;
  const Vec3 way = b.point - a.point;
  switch (a.form) {
    case contact::Plane::Form::flat:
      return (a.normal - b.normal).norm() < kSame && std::abs(a.normal.dot(way)) < kSame * size;
    case contact::Plane::Form::cylinder:
      return a.axis.cross(b.axis).norm() < kSame && a.axis.cross(way).norm() < kSame * size;
    case contact::Plane::Form::sphere:
      return way.norm() < kSame * size;
  }
  return false;
}

/// Those that are there, then the sides of the container along which there is none: a wall counts
/// once.
std::vector<contact::Plane> all_planes(const Container& container, const PackingWalls& walls) {
  std::vector<contact::Plane> planes(walls.planes.begin(), walls.planes.end());
  const double size = (container.bounds.upper - container.bounds.lower).norm();
  for (const contact::Plane& side : sides_of(container)) {
    if (!std::ranges::any_of(
            walls.planes, [&](const contact::Plane& plane) { return are_one(plane, side, size); }))
      planes.push_back(side);
  }
  return planes;
}

/// Springs of both sides of a contact, in series.
double in_series(double a, double b) {
  return 2.0 * a * b / (a + b);
}

/// A grid of cells over a box, each with the things in it.
class Cells {
 public:
  Cells(const Box& box, double side) : lower_(box.lower) {
    const Vec3 size = box.upper - box.lower;
    constexpr double kMostCells = 1 << 22;
    while ((size / side).array().floor().max(1.0).prod() > kMostCells) side *= 2.0;
    for (int axis = 0; axis < 3; ++axis)
      counts_[static_cast<std::size_t>(axis)] =
          static_cast<std::ptrdiff_t>(std::max(1.0, std::floor(size[axis] / side)));
    side_ = side;
    things_.resize(static_cast<std::size_t>(counts_[0] * counts_[1] * counts_[2]));
  }

  /// Calls visit(things) for the cells that a box meets.
  template <class Visit>
  void for_each_in(const Vec3& lower, const Vec3& upper, Visit visit) {
    const auto first = cell_of(lower), last = cell_of(upper);
    for (std::ptrdiff_t k = first[2]; k <= last[2]; ++k)
      for (std::ptrdiff_t j = first[1]; j <= last[1]; ++j)
        for (std::ptrdiff_t i = first[0]; i <= last[0]; ++i)
          visit(things_[static_cast<std::size_t>((k * counts_[1] + j) * counts_[0] + i)]);
  }

 private:
  std::array<std::ptrdiff_t, 3> cell_of(const Vec3& point) const {
    std::array<std::ptrdiff_t, 3> cell{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<Eigen::Index>(axis);
      const double place = std::floor((point[i] - lower_[i]) / side_);
      cell[axis] = static_cast<std::ptrdiff_t>(
          std::clamp(place, 0.0, static_cast<double>(counts_[axis] - 1)));
    }
    return cell;
  }

  Vec3 lower_;
  double side_ = 0.0;
  std::array<std::ptrdiff_t, 3> counts_{};
  std::vector<std::vector<std::uint32_t>> things_;
};

}  // namespace

SpherePacking::SpherePacking(std::vector<Vec3> centres, std::vector<double> radii, double factor,
                             const Container& container, const PackingWalls& walls)
    : container_(container),
      obstacles_(walls.obstacles.begin(), walls.obstacles.end()),
      planes_(all_planes(container, walls)),
      plane_moduli_(walls.plane_moduli.begin(), walls.plane_moduli.end()),
      radii_(std::move(radii)),
      factor_(factor),
      x_(std::move(centres)),
      v_(x_.size(), Vec3::Zero()),
      f_(x_.size(), Vec3::Zero()) {
  plane_moduli_.resize(planes_.size(), 1.0);
  const auto [least, most] = std::minmax_element(radii_.begin(), radii_.end());
  smallest_ = *least;
  largest_ = *most;
  // A large sphere may touch about as many small ones as its surface is larger.
  for (const double radius : radii_) mass_.push_back(radius * radius / smallest_);
}

void SpherePacking::set_factor(double factor) {
  factor_ = factor;
  if (factor > listed_factor_) listed_.clear();
}

bool SpherePacking::has_moved_far() const {
  if (listed_.empty()) return true;
  const double most = 0.5 * kSkin * smallest_ * listed_factor_;
  for (std::size_t i = 0; i < x_.size(); ++i)
    if ((x_[i] - listed_[i]).squaredNorm() > most * most) return true;
  return false;
}

void SpherePacking::find_neighbours() {
  constexpr double kRoomToGrow = 1.002;
  listed_ = x_;
  listed_factor_ = kRoomToGrow * factor_;
  find_pairs();
  find_walls();
}

void SpherePacking::find_pairs() {
  const double margin = kSkin * smallest_ * listed_factor_;
  const double largest = largest_ * listed_factor_;
  Cells cells(container_.bounds, 2.0 * largest + margin);
  pairs_.clear();
  for (std::uint32_t b = 0; b < x_.size(); ++b) {
    const double reach = radii_[b] * listed_factor_ + largest + margin;
    cells.for_each_in(x_[b].array() - reach, x_[b].array() + reach, [&](const auto& others) {
      for (const std::uint32_t a : others) {
        const double near = (radii_[a] + radii_[b]) * listed_factor_ + margin;
        if ((x_[a] - x_[b]).squaredNorm() < near * near) pairs_.push_back({a, b});
      }
    });
    cells.for_each_in(x_[b], x_[b], [&](auto& own) { own.push_back(b); });
  }
}

void SpherePacking::find_walls() {
  const double margin = kSkin * smallest_ * listed_factor_;
  near_planes_.clear();
  near_obstacles_.clear();
  Cells cells(container_.bounds, 2.0 * largest_ * listed_factor_ + margin);
  for (std::uint32_t wall = 0; wall < obstacles_.size(); ++wall) {
    const Box reach = geometry::bounding_box(
        obstacles_[wall].core, obstacles_[wall].radius + largest_ * listed_factor_ + margin);
    if ((reach.lower.array() > container_.bounds.upper.array()).any() ||
        (reach.upper.array() < container_.bounds.lower.array()).any())
      continue;
    cells.for_each_in(reach.lower, reach.upper, [&](auto& own) { own.push_back(wall); });
  }
  for (std::uint32_t i = 0; i < x_.size(); ++i) {
    const double near = radii_[i] * listed_factor_ + margin;
    for (std::uint32_t wall = 0; wall < planes_.size(); ++wall)
      if (planes_[wall].height(x_[i]) < near) near_planes_.push_back({i, wall});
    cells.for_each_in(x_[i], x_[i], [&](const auto& walls) {
      for (const std::uint32_t wall : walls)
        if (distance_to_triangle(x_[i], obstacles_[wall].core) < obstacles_[wall].radius + near)
          near_obstacles_.push_back({i, wall});
    });
  }
}

void SpherePacking::push_apart(const Pair& pair, Forces& sum) {
  const Vec3 way = x_[pair.b] - x_[pair.a];
  const double ra = radii_[pair.a] * factor_, rb = radii_[pair.b] * factor_;
  const double squared = way.squaredNorm();
  if (squared >= (ra + rb) * (ra + rb) || squared == 0.0) return;
  const double distance = std::sqrt(squared);
  const double overlap = ra + rb - distance;
  const double force = in_series(ra, rb) * overlap;
  const Vec3 on_b = force / distance * way;
  f_[pair.a] -= on_b;
  f_[pair.b] += on_b;
  sum.deepest = std::max(sum.deepest, overlap / (ra + rb));
  sum.carried += force;
  sum.moment += force * distance;
  ++sum.contacts;
}

/// @param outward   unit, out of the wall
/// @param distance  m, of the centre from it
/// @param spring    m, of the wall
void SpherePacking::push(std::size_t sphere, const Vec3& outward, double distance, double spring,
                         Forces& sum) {
  const double radius = radii_[sphere] * factor_;
  const double overlap = radius - distance;
  if (overlap <= 0.0) return;
  const double force = in_series(radius, spring) * overlap;
  f_[sphere] += force * outward;
  sum.deepest = std::max(sum.deepest, overlap / radius);
  sum.carried += force;
  sum.moment += force * distance;
  ++sum.contacts;
}

SpherePacking::Forces SpherePacking::add_forces() {
  if (has_moved_far()) find_neighbours();
  std::fill(f_.begin(), f_.end(), Vec3::Zero());
  Forces sum;
  for (const Pair& pair : pairs_) push_apart(pair, sum);
  for (const auto& [sphere, wall] : near_planes_) {
    const contact::Plane& plane = planes_[wall];
    push(sphere, plane.normal_at(x_[sphere]), plane.height(x_[sphere]),
         plane_moduli_[wall] * radii_[sphere] * factor_, sum);
  }
  for (const auto& [sphere, wall] : near_obstacles_) {
    const Obstacle& obstacle = obstacles_[wall];
    const geometry::ClosestPoints closest = geometry::point_triangle(x_[sphere], obstacle.core);
    const double spring = obstacle.spring > 0.0 ? obstacle.spring : radii_[sphere] * factor_;
    if (closest.distance > 0.0)
      push(sphere, -closest.separation / closest.distance, closest.distance - obstacle.radius,
           spring, sum);
  }
  pressure_ = sum.moment / (3.0 * container_.volume);
  return sum;
}

double SpherePacking::sum_of_resultants() const {
  double sum = 0.0;
  for (const Vec3& force : f_) sum += force.norm();
  return sum;
}

SpherePacking::Relaxed SpherePacking::relax(bool to_balance) {
  double step = kFirstStep, mix = kMix;
  int downhill = 0;
  std::fill(v_.begin(), v_.end(), Vec3::Zero());
  for (int k = 0; k < kMostSteps; ++k) {
    const Forces sum = add_forces();
    if (!to_balance && sum.deepest < kApart) return Relaxed::apart;
    if (k % kStepsBetweenLooks == kStepsBetweenLooks - 1) {
      if (sum.contacts == 0) return Relaxed::apart;
      if (sum_of_resultants() < kBalanced * sum.carried) return Relaxed::balanced;
    }
    double power = 0.0, speed = 0.0, force = 0.0;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      power += f_[i].dot(v_[i]);
      speed += mass_[i] * v_[i].squaredNorm();
      force += f_[i].squaredNorm() / mass_[i];
    }
    if (power > 0.0) {
      if (++downhill > kStepsBeforeFaster) {
        step = std::min(step * kFaster, kLongestStep);
        mix *= kLessMix;
      }
    } else {
      std::fill(v_.begin(), v_.end(), Vec3::Zero());
      step *= kSlower;
      mix = kMix;
      downhill = 0;
      speed = 0.0;
    }
    // Directions are those of velocities times the root of the mass, so that all sizes follow.
    const double turn = force > 0.0 ? mix * std::sqrt(speed / force) : 0.0;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      v_[i] = (1.0 - mix) * v_[i] + (turn + step) / mass_[i] * f_[i];
      x_[i] += step * v_[i];
    }
  }
  return Relaxed::neither;
}

bool SpherePacking::grow_to(double factor, const std::function<void(double)>& tell) {
  double solids = 0.0;  // of the volume, at factor 1
  for (const double radius : radii_) solids += geometry::ball_volume(radius) / container_.volume;
  const double aim = factor * (1.0 + kApart);
  double growth = kFirstGrowth;
  std::vector<Vec3> before = x_;
  double reached = factor_;
  while (reached < aim) {
    const double filled = solids * cube(reached);
    if (filled > kNearJamming) growth = std::min(growth, kSlowGrowth);
    set_factor(std::min(aim, reached * elementary::pow((filled + growth) / filled, 1.0 / 3.0)));
    if (relax(false) == Relaxed::apart) {
      reached = factor_;
      before = x_;
      if (tell) tell(std::min(1.0, reached / aim));
      continue;
    }
    growth *= 0.5;
    x_ = before;
    listed_.clear();
    if (growth < kLeastGrowth) break;
  }
  const bool has_grown = reached >= aim;
  factor_ = reached / (1.0 + kApart);
  return has_grown;
}

bool SpherePacking::press_to(double pressure, const std::function<void(double)>& tell) {
  double growth = pressure;  // of the factor: overlaps over radii are about the pressure over E
  double low = factor_, pressure_at_low = 0.0;
  for (int k = 0; k < kMostCompressions; ++k) {
    set_factor(factor_ + growth);
    relax(true);
    add_forces();
    if (tell) tell(std::min(1.0, pressure_ / pressure));
    if (std::abs(pressure_ - pressure) < kPressureTolerance * pressure) return true;
    const double slope = (pressure_ - pressure_at_low) / (factor_ - low);
    const double longest = 2.0 * std::abs(growth);
    low = factor_;
    pressure_at_low = pressure_;
    growth = slope > 0.0 && pressure_ > 0.0
                 ? std::clamp((pressure - pressure_) / slope, -longest, longest)
                 : longest;
  }
  return false;
}

}  // namespace plekton::apps
