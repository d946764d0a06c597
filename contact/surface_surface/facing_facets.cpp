// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/facing_facets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

/// Every step forwards, from the corners to the energy, has its step backwards, from the slope of
/// the energy by a result to those by what the result was made of.
namespace plekton::contact::structure {
namespace {

/// A vector, and the slope of the energy by it.
struct Traced {
  Vec3 x;
  Vec3 slope;

  void set(const Vec3& value) {
    x = value;
    slope = Vec3::Zero();
  }
};

/// Unit vector along another.
struct Direction {
  Traced along;
  double length = 0.0;

  void set(const Vec3& v) {
    length = v.norm();
    along.set(v / length);
  }
  /// Slope by the vector it was made of.
  Vec3 back() const { return (along.slope - along.x.dot(along.slope) * along.x) / length; }
};

/// The unit normal of a facet, either way round.
struct Normal {
  Direction direction;
  double sign = 1.0;

  void set(const std::array<Traced, 3>& facet, double which) {
    sign = which;
    direction.set(sign * (facet[1].x - facet[0].x).cross(facet[2].x - facet[0].x));
  }
  void back(std::array<Traced, 3>& facet) const {
    const Vec3 by_cross = sign * direction.back();
    const Vec3 by_first = (facet[2].x - facet[0].x).cross(by_cross);
    const Vec3 by_second = by_cross.cross(facet[1].x - facet[0].x);
    facet[1].slope += by_first;
    facet[2].slope += by_second;
    facet[0].slope -= by_first + by_second;
  }
};

/// A point that is on a plane but for round-off (kPlaneRoundoff) lies on the side that it would be
/// on if the upper body were moved along this a little: all facets of both bodies then agree which
/// part of one lies over which part of the other, and the slopes of coinciding edges add up to those
/// of the whole. Source: symbolic perturbation, Edelsbrunner & Muecke, ACM Transactions on Graphics
/// 9 (1990).
const Vec3 kTieBreak(0.533, 0.811, 0.241);  // any direction that meshes do not have

/// The part of facet a that lies over facet b, seen along b's normal.
class Overlap {
 public:
  Overlap(const Simplex& a, const Simplex& b, double range) : range_(range) {
    for (std::size_t i = 0; i < 3; ++i) {
      a_[i].set(a.x[i]);
      b_[i].set(b.x[i]);
    }
  }

  /// Energy (J), and the slopes by all corners.
  double energy_and_slopes(const NormalSpring& spring);
  const std::array<Traced, 3>& a() const { return a_; }
  const std::array<Traced, 3>& b() const { return b_; }

 private:
  /// Five cuts leave a triangle at most 4, 6, 9, 13, 19 corners and make 2, 4, 6, 8, 12 new ones,
  /// the last two on either side of b, also where rounding takes corners for dents.
  static constexpr std::size_t kMostCorners = 19;
  static constexpr std::size_t kMostPoints = 3 + 12 + 2 * 20;
  static constexpr std::size_t kSideCut = 3;
  static constexpr std::size_t kRangeCut = 4;

  /// A corner that a cut made on the way from one point to another.
  struct Cut {
    std::size_t point;
    std::size_t from;
    std::size_t to;
    std::size_t plane;
    double height_from;  ///< m²; of the range m
    double height_to;
  };
  struct Polygon {
    std::array<std::size_t, kMostCorners> points;
    std::size_t size = 0;
    std::size_t next(std::size_t i) const { return i + 1 == size ? 0 : i + 1; }
  };

  bool face_each_other();
  bool make_region();
  double energy_of_region(const NormalSpring& spring, double by_energy);
  double energy_of_sides(const NormalSpring& spring, double by_energy);
  double distance(const Vec3& p) const { return side_ * (b_[0].x - p).dot(normal_b()); }
  const Vec3& normal_a() const { return of_a_.direction.along.x; }
  const Vec3& normal_b() const { return of_b_.direction.along.x; }
  void distance_back(const Vec3& p, double by_distance, Vec3& by_point);
  double height(std::size_t point, std::size_t plane) const;
  template <class Height>
  void cut(std::size_t plane, Height height);
  void cut_back(const Cut& cut);
  double integral(const NormalSpring& spring) const;
  void integral_back(const NormalSpring& spring, double by_integral);

  double range_;
  std::array<Traced, 3> a_;
  std::array<Traced, 3> b_;
  Normal of_a_;
  Normal of_b_;
  std::array<Traced, 3> inward_;
  Vec3 tie_break_ = Vec3::Zero();  ///< how b is moved against a where they tie
  double side_ = 1.0;              ///< 1 if b lies on the normal's side of a, -1 on the other
  std::array<Traced, kMostPoints> points_;
  std::size_t point_count_ = 0;
  std::array<Cut, kMostPoints> cuts_;
  std::size_t cut_count_ = 0;
  Polygon region_;
  bool is_in_range_ = false;  ///< any part of it
};

bool Overlap::face_each_other() {
  of_a_.set(a_, 1.0);
  of_b_.set(b_, 1.0);
  if (normal_a().dot(normal_b()) < 0.0) of_b_.set(b_, -1.0);
  if (!(normal_a().dot(normal_b()) > kCosineOfCrossing)) return false;
  for (std::size_t i = 0; i < 3; ++i)
    inward_[i].set(of_b_.sign * normal_b().cross(b_[(i + 1) % 3].x - b_[i].x));
  const double towards_b = normal_b().dot(b_[0].x - a_[0].x) >= 0.0 ? 1.0 : -1.0;
  tie_break_ = (towards_b * normal_b()).cross(kTieBreak);
  return true;
}

double Overlap::height(std::size_t point, std::size_t plane) const {
  const Vec3 up = points_[point].x - b_[plane].x;
  const Vec3& inward = inward_[plane].x;
  const double height = up.dot(inward);
  const bool is_on_it = height * height <=
                        kPlaneRoundoff * kPlaneRoundoff * (up.squaredNorm() * inward.squaredNorm());
  return is_on_it ? std::copysign(0.0, -tie_break_.dot(inward)) : height;
}

/// Keeps what has a positive height, 0 with its sign included.
template <class Height>
void Overlap::cut(std::size_t plane, Height height) {
  std::array<double, kMostCorners> heights;
  const auto is_kept = [&](std::size_t i) { return !std::signbit(heights[i]); };
  bool keeps_all = true;
  for (std::size_t i = 0; i < region_.size; ++i) {
    heights[i] = height(region_.points[i]);
    keeps_all = keeps_all && is_kept(i);
  }
  if (keeps_all) return;
  Polygon kept;
  for (std::size_t i = 0; i < region_.size; ++i) {
    const std::size_t k = region_.next(i);
    if (is_kept(i)) kept.points[kept.size++] = region_.points[i];
    if (is_kept(i) == is_kept(k)) continue;
    const Cut made{point_count_, region_.points[i], region_.points[k],
                   plane,        heights[i],        heights[k]};
    const Vec3& from = points_[made.from].x;
    const double share = made.height_from / (made.height_from - made.height_to);
    points_[point_count_].set(from + share * (points_[made.to].x - from));
    cuts_[cut_count_++] = made;
    kept.points[kept.size++] = point_count_++;
  }
  region_ = kept;
}

/// Sets what of a lies over b, on whichever side. @returns whether there is any
bool Overlap::make_region() {
  if (!face_each_other()) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    points_[i].set(a_[i].x);
    region_.points[i] = i;
  }
  region_.size = point_count_ = 3;
  for (std::size_t i = 0; i < 3; ++i) {
    cut(i, [&](std::size_t point) { return height(point, i); });
    if (region_.size < 3) return false;
  }
  return true;
}

/// A place in a triangle, by the weights of its corners, and its part of the area.
struct Sample {
  double p, q, r, part;
};
/// Radon's rule, exact to the fifth degree (Stroud 1971, Approximate Calculation of Multiple
/// Integrals, T2 5-1): for a linear spring, and for any other law near enough that it hardly matters
/// how a region is cut into triangles.
constexpr double kInner = 0.10128650732345633;      // (6 - sqrt 15) / 21
constexpr double kOuter = 0.47014206410511505;      // (6 + sqrt 15) / 21
constexpr double kInnerPart = 0.12593918054482717;  // (155 - sqrt 15) / 1200
constexpr double kOuterPart = 0.13239415278850619;  // (155 + sqrt 15) / 1200
constexpr std::array<Sample, 7> kSamples{{{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0, 0.225},
                                          {kInner, kInner, 1.0 - 2.0 * kInner, kInnerPart},
                                          {kInner, 1.0 - 2.0 * kInner, kInner, kInnerPart},
                                          {1.0 - 2.0 * kInner, kInner, kInner, kInnerPart},
                                          {kOuter, kOuter, 1.0 - 2.0 * kOuter, kOuterPart},
                                          {kOuter, 1.0 - 2.0 * kOuter, kOuter, kOuterPart},
                                          {1.0 - 2.0 * kOuter, kOuter, kOuter, kOuterPart}}};

/// Calls visit(first, second, third corner) for the triangles of a fan.
template <class Polygon, class Visit>
void for_each_triangle(const Polygon& region, Visit visit) {
  for (std::size_t i = 1; i + 1 < region.size; ++i)
    visit(region.points[0], region.points[i], region.points[i + 1]);
}

double Overlap::integral(const NormalSpring& spring) const {
  double sum = 0.0;
  for_each_triangle(region_, [&](std::size_t i, std::size_t j, std::size_t k) {
    const Vec3 &p = points_[i].x, &q = points_[j].x, &r = points_[k].x;
    const double area = 0.5 * normal_a().dot((q - p).cross(r - p));
    for (const Sample& s : kSamples)
      sum += area * s.part * spring.energy(distance(s.p * p + s.q * q + s.r * r));
  });
  return sum;
}

void Overlap::integral_back(const NormalSpring& spring, double by_integral) {
  const Vec3& normal = normal_a();
  for_each_triangle(region_, [&](std::size_t i, std::size_t j, std::size_t k) {
    Traced &p = points_[i], &q = points_[j], &r = points_[k];
    const Vec3 u = q.x - p.x, v = r.x - p.x;
    const Vec3 cross = u.cross(v);
    const double area = 0.5 * normal.dot(cross);
    double energy = 0.0;  // mean
    for (const Sample& s : kSamples) {
      const Vec3 at = s.p * p.x + s.q * q.x + s.r * r.x;
      const double apart = distance(at);
      energy += s.part * spring.energy(apart);
      Vec3 by_at = Vec3::Zero();
      distance_back(at, -by_integral * area * s.part * spring.force(apart), by_at);
      p.slope += s.p * by_at;
      q.slope += s.q * by_at;
      r.slope += s.r * by_at;
    }
    const double by_cross = 0.5 * by_integral * energy;
    of_a_.direction.along.slope += by_cross * cross;
    const Vec3 by_u = by_cross * v.cross(normal);
    const Vec3 by_v = by_cross * normal.cross(u);
    q.slope += by_u;
    r.slope += by_v;
    p.slope -= by_u + by_v;
  });
}

void Overlap::distance_back(const Vec3& p, double by_distance, Vec3& by_point) {
  const Vec3 by_tip = side_ * by_distance * normal_b();
  b_[0].slope += by_tip;
  by_point -= by_tip;
  of_b_.direction.along.slope += side_ * by_distance * (b_[0].x - p);
}

void Overlap::cut_back(const Cut& cut) {
  Traced &from = points_[cut.from], &to = points_[cut.to];
  const Vec3& by_point = points_[cut.point].slope;
  const double drop = cut.height_from - cut.height_to;
  const double share = cut.height_from / drop;
  const double by_share = by_point.dot(to.x - from.x);
  from.slope += (1.0 - share) * by_point;
  to.slope += share * by_point;
  const double by_from = -by_share * cut.height_to / (drop * drop);
  const double by_to = by_share * cut.height_from / (drop * drop);
  // Where a crosses b the energy has the same density on both sides: moving the line between them
  // changes nothing, and its place is lost in rounding as the facets come to lie in one plane.
  if (cut.plane == kSideCut) return;
  if (cut.plane == kRangeCut) {
    distance_back(from.x, -by_from, from.slope);
    distance_back(to.x, -by_to, to.slope);
    return;
  }
  Traced& inward = inward_[cut.plane];
  Traced& origin = b_[cut.plane];
  from.slope += by_from * inward.x;
  to.slope += by_to * inward.x;
  origin.slope -= (by_from + by_to) * inward.x;
  inward.slope += by_from * (from.x - origin.x) + by_to * (to.x - origin.x);
}

/// What the part of the region on one side of b stores, times range^2, and its slopes.
/// @param by_energy  slope of the whole by that
double Overlap::energy_of_region(const NormalSpring& spring, double by_energy) {
  const std::size_t first_cut = cut_count_;
  cut(kRangeCut, [&](std::size_t point) { return range_ - distance(points_[point].x); });
  if (region_.size < 3) {
    cut_count_ = first_cut;
    return 0.0;
  }
  is_in_range_ = true;
  const double sum = integral(spring);
  integral_back(spring, by_energy);
  while (cut_count_ > first_cut) cut_back(cuts_[--cut_count_]);
  return sum;
}

/// The same of all of it.
double Overlap::energy_of_sides(const NormalSpring& spring, double by_energy) {
  double above = 0.0, lowest = 0.0, highest = 0.0;
  for (std::size_t i = 0; i < region_.size; ++i) {
    const double height = (b_[0].x - points_[region_.points[i]].x).dot(normal_b());
    above += height;
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  side_ = above >= 0.0 ? 1.0 : -1.0;
  if (!(lowest < 0.0 && highest > 0.0)) return energy_of_region(spring, by_energy);
  const Polygon both = region_;
  double sum = 0.0;
  for (side_ = -1.0; side_ <= 1.0; side_ += 2.0) {
    region_ = both;
    const std::size_t first_cut = cut_count_;
    cut(kSideCut, [&](std::size_t point) { return distance(points_[point].x) + 0.0; });  // no -0
    if (region_.size >= 3) sum += energy_of_region(spring, by_energy);
    while (cut_count_ > first_cut) cut_back(cuts_[--cut_count_]);
  }
  return sum;
}

double Overlap::energy_and_slopes(const NormalSpring& spring) {
  if (!make_region()) return 0.0;
  const double cosine = normal_a().dot(normal_b());
  const double factor = parallel_share(cosine) / (range_ * range_);
  const double sum = energy_of_sides(spring, factor);
  if (!is_in_range_) return 0.0;
  while (cut_count_ > 0) cut_back(cuts_[--cut_count_]);
  for (std::size_t i = 0; i < 3; ++i) {
    a_[i].slope += points_[i].slope;
    Traced &first = b_[i], &last = b_[(i + 1) % 3];
    const Vec3 by_inward = of_b_.sign * inward_[i].slope;
    const Vec3 by_side = by_inward.cross(normal_b());
    of_b_.direction.along.slope += (last.x - first.x).cross(by_inward);
    last.slope += by_side;
    first.slope -= by_side;
  }
  const double by_cosine =
      2.0 * (cosine - kCosineOfCrossing) /
      ((1.0 - kCosineOfCrossing) * (1.0 - kCosineOfCrossing) * range_ * range_) * sum;
  of_a_.direction.along.slope += by_cosine * normal_b();
  of_b_.direction.along.slope += by_cosine * normal_a();
  of_a_.back(a_);
  of_b_.back(b_);
  return factor * sum;
}

}  // namespace

PairForces facing_facets(const Simplex& a, const Simplex& b, const NormalSpring& spring) {
  PairForces pair;
  Overlap of_a(a, b, spring.range());
  Overlap of_b(b, a, spring.range());
  pair.energy = 0.5 * (of_a.energy_and_slopes(spring) + of_b.energy_and_slopes(spring));
  // Also without energy: an overlap that is about to begin has none, but a slope.
  for (std::size_t i = 0; i < 3; ++i) {
    pair.on_a[i] = -0.5 * (of_a.a()[i].slope + of_b.b()[i].slope);
    pair.on_b[i] = -0.5 * (of_a.b()[i].slope + of_b.a()[i].slope);
  }
  return pair;
}

}  // namespace plekton::contact::structure
