// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/rigid/sphere_union.hpp"

#include "geometry/base/elementary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace plekton::dynamics {
namespace {

constexpr double kPi = std::numbers::pi;

struct Disc {
  double x, y, radius;  // m
};

/// Area and moments of a slice.
struct SliceMoments {
  double area = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;

  void add(const SliceMoments& other, double sign) noexcept {
    area += sign * other.area;
    x += sign * other.x;
    y += sign * other.y;
    xx += sign * other.xx;
    xy += sign * other.xy;
    yy += sign * other.yy;
  }
};

/// What an arc from the angle 0 to another gives to 1/2 (x dy - y dx), 1/2 x² dy, -1/2 y² dx, 1/3
/// x³ dy, 1/2 x² y dy and -1/3 y³ dx, but for constants that cancel over any arc.
SliceMoments to_angle(const Disc& disc, double angle) noexcept {
  const double c = elementary::cos(angle), s = elementary::sin(angle);
  const double r = disc.radius, a = disc.x, b = disc.y;
  const double c2 = 0.5 * (angle + s * c), s2 = 0.5 * (angle - s * c);  // integrals of cos², sin²
  const double c3 = s - s * s * s / 3.0, s3 = c * c * c / 3.0 - c;
  const double c4 = 0.75 * c2 + 0.25 * s * c * c * c, s4 = 0.75 * s2 - 0.25 * c * s * s * s;
  const double c1s = 0.5 * s * s, c2s = -c * c * c / 3.0, c3s = -0.25 * c * c * c * c;
  const double x_dy = a * a * s + 2.0 * a * r * c2 + r * r * c3;
  return {
      0.5 * r * (a * s - b * c + r * angle),
      0.5 * r * x_dy,
      0.5 * r * (-b * b * c + 2.0 * b * r * s2 + r * r * s3),
      r / 3.0 * (a * a * a * s + 3.0 * a * a * r * c2 + 3.0 * a * r * r * c3 + r * r * r * c4),
      0.5 * r * (b * x_dy + r * (a * a * c1s + 2.0 * a * r * c2s + r * r * c3s)),
      r / 3.0 * (-b * b * b * c + 3.0 * b * b * r * s2 + 3.0 * b * r * r * s3 + r * r * r * s4)};
}

/// Spheres with those that each of them meets.
class Slices {
 public:
  Slices(std::span<const Vec3> centres, std::span<const double> radii, const Vec3& origin)
      : radii_(radii), neighbours_(radii.size()), discs_(radii.size()) {
    for (const Vec3& centre : centres) centres_.push_back(centre - origin);
    for (std::size_t i = 0; i < radii.size(); ++i) {
      for (std::size_t j = 0; j < radii.size(); ++j) {
        const double reach = radii[i] + radii[j];
        if (i != j && (centres_[i] - centres_[j]).squaredNorm() < reach * reach)
          neighbours_[i].push_back(j);
      }
    }
    find_breaks();
  }

  /// Gauss' rule between all breaks.
  VolumeMoments integrate(const std::vector<std::array<double, 2>>& rule) {
    VolumeMoments sum;
    for (std::size_t i = 0; i + 1 < breaks_.size(); ++i) {
      const double half = 0.5 * (breaks_[i + 1] - breaks_[i]);
      if (!(half > 0.0)) continue;
      const double middle = breaks_[i] + half;
      for (const auto& [point, weight] : rule) {
        const double theta = 0.5 * kPi * (1.0 + point);
        const double z = middle - half * elementary::cos(theta);
        add(slice(z), z, 0.5 * kPi * weight * half * elementary::sin(theta), sum);
      }
    }
    return sum;
  }

 private:
  static void add(const SliceMoments& slice, double z, double dz, VolumeMoments& sum) noexcept {
    const double a = dz * slice.area, x = dz * slice.x, y = dz * slice.y;
    Mat3 second;
    second << dz * slice.xx, dz * slice.xy, z * x, dz * slice.xy, dz * slice.yy, z * y, z * x,
        z * y, z * z * a;
    sum += {a, Vec3(x, y, z * a), second};
  }

  /// Heights where what a slice looks like changes.
  void find_breaks() {
    for (std::size_t i = 0; i < centres_.size(); ++i) {
      breaks_.push_back(centres_[i].z() - radii_[i]);
      breaks_.push_back(centres_[i].z() + radii_[i]);
      for (const std::size_t j : neighbours_[i]) {
        if (j < i) continue;
        break_at_circle(i, j);
        for (const std::size_t k : neighbours_[i]) {
          if (k > j) break_at_points(i, j, k);
        }
      }
    }
    std::sort(breaks_.begin(), breaks_.end());
  }

  /// The circle in which two spheres meet, from its lowest to its highest point.
  void break_at_circle(std::size_t i, std::size_t j) {
    const Vec3 apart = centres_[j] - centres_[i];
    const double distance = apart.norm();
    if (!(distance > 0.0)) return;
    const double along =
        0.5 * (distance + (radii_[i] - radii_[j]) * (radii_[i] + radii_[j]) / distance);
    const double squared = (radii_[i] - along) * (radii_[i] + along);
    if (!(squared >= 0.0)) return;
    const Vec3 normal = apart / distance;
    const double z = centres_[i].z() + along * normal.z();
    const double half = std::sqrt(squared * std::max(0.0, 1.0 - normal.z() * normal.z()));
    breaks_.push_back(z - half);
    breaks_.push_back(z + half);
  }

  /// The two points that three spheres have in common.
  void break_at_points(std::size_t i, std::size_t j, std::size_t k) {
    const Vec3 u = centres_[j] - centres_[i], v = centres_[k] - centres_[i];
    const Vec3 across = u.cross(v);
    const double size = across.squaredNorm();
    if (!(size > 0.0)) return;
    const auto height = [&](const Vec3& way, double radius) {
      return 0.5 * (way.squaredNorm() + (radii_[i] - radius) * (radii_[i] + radius));
    };
    const Vec3 foot =
        (height(u, radii_[j]) * v.cross(across) + height(v, radii_[k]) * across.cross(u)) / size;
    const double squared = radii_[i] * radii_[i] - foot.squaredNorm();
    if (!(squared >= 0.0)) return;
    const double way = std::sqrt(squared / size) * across.z();
    breaks_.push_back(centres_[i].z() + foot.z() - way);
    breaks_.push_back(centres_[i].z() + foot.z() + way);
  }

  SliceMoments slice(double z) {
    for (std::size_t i = 0; i < discs_.size(); ++i) {
      const double way = z - centres_[i].z();
      const double squared = (radii_[i] - way) * (radii_[i] + way);
      discs_[i] = {centres_[i].x(), centres_[i].y(), squared > 0.0 ? std::sqrt(squared) : 0.0};
    }
    SliceMoments sum;
    for (std::size_t i = 0; i < discs_.size(); ++i) {
      if (discs_[i].radius > 0.0 && find_covered(i)) add_bare_arcs(discs_[i], sum);
    }
    return sum;
  }

  /// Arcs of a disc that others cover. @returns whether anything of it may be bare
  bool find_covered(std::size_t i) {
    covered_.clear();
    const Disc& own = discs_[i];
    for (const std::size_t j : neighbours_[i]) {
      const Disc& other = discs_[j];
      if (other.radius == 0.0) continue;
      const double x = other.x - own.x, y = other.y - own.y;
      const double distance = elementary::hypot(x, y);
      if (distance >= own.radius + other.radius) continue;
      const double excess = other.radius - own.radius;
      if (distance <= std::abs(excess)) {
        const bool hides = excess > 0.0 || (excess == 0.0 && j < i);
        if (hides) return false;
        continue;
      }
      const double cosine = (distance * distance - excess * (own.radius + other.radius)) /
                            (2.0 * distance * own.radius);
      const double half =
          elementary::atan2(std::sqrt(std::max(0.0, (1.0 - cosine) * (1.0 + cosine))), cosine);
      const double middle = elementary::atan2(y, x);
      cover(middle - half, middle + half);
    }
    return true;
  }

  /// @param begin  from -2 pi
  void cover(double begin, double end) {
    if (begin < -kPi) {
      covered_.push_back({begin + 2.0 * kPi, kPi});
      begin = -kPi;
    }
    if (end > kPi) {
      covered_.push_back({-kPi, end - 2.0 * kPi});
      end = kPi;
    }
    covered_.push_back({begin, end});
  }

  void add_bare_arcs(const Disc& disc, SliceMoments& sum) {
    std::sort(covered_.begin(), covered_.end());
    double from = -kPi;
    const auto add_arc = [&](double to) {
      if (!(to > from)) return;
      sum.add(to_angle(disc, to), 1.0);
      sum.add(to_angle(disc, from), -1.0);
    };
    for (const auto& [begin, end] : covered_) {
      add_arc(begin);
      from = std::max(from, end);
    }
    add_arc(kPi);
  }

  std::vector<Vec3> centres_;  // m, from the origin
  std::span<const double> radii_;
  std::vector<std::vector<std::size_t>> neighbours_;
  std::vector<double> breaks_;                      // m, ascending
  std::vector<Disc> discs_;                         // working space of a slice
  std::vector<std::pair<double, double>> covered_;  // rad, of one disc
};

/// Points and weights of Gauss' rule on [-1, 1], by Newton's method on the Legendre polynomial.
std::vector<std::array<double, 2>> gauss_rule(int count) {
  std::vector<std::array<double, 2>> rule;
  for (int i = 0; i < count; ++i) {
    double x = elementary::cos(kPi * (i + 0.75) / (count + 0.5));
    double slope = 0.0;
    for (int step = 0; step < 8; ++step) {
      double before = 0.0, now = 1.0;
      for (int n = 1; n <= count; ++n) {
        const double next = ((2 * n - 1) * x * now - (n - 1) * before) / n;
        before = now;
        now = next;
      }
      slope = count * (x * now - before) / (x * x - 1.0);
      x -= now / slope;
    }
    rule.push_back({x, 2.0 / ((1.0 - x * x) * slope * slope)});
  }
  return rule;
}

}  // namespace

SphereUnion sphere_union(std::span<const Vec3> centres, std::span<const double> radii,
                         const Vec3& origin) {
  Slices slices(centres, radii, origin);
  const VolumeMoments rough = slices.integrate(gauss_rule(32));
  SphereUnion result{slices.integrate(gauss_rule(48)), 0.0};
  const double volume = result.moments.volume;
  if (volume > 0.0) result.error = std::abs(volume - rough.volume) / volume;
  return result;
}

}  // namespace plekton::dynamics
