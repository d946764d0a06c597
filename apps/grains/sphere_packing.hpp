// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/grains/container.hpp"
#include "apps/grains/free_space.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace plekton::apps {

/// What grains are packed against, beside their container.
struct PackingWalls {
  std::span<const Obstacle> obstacles;
  std::span<const contact::Plane> planes;
  std::span<const double> plane_moduli = {};  ///< by plane, over that of the spheres; empty: all 1
};

/// Spheres without friction that grow in a container until they are as dense, or press on each
/// other as much, as asked for.
///
/// All radii are a factor times what they shall be. The factor grows by small steps from a sparse
/// random placement; after each the overlaps are relaxed: the spheres repel each other, the walls
/// and obstacles with linear springs, and their energy is minimised by FIRE (Bitzek et al., Phys.
/// Rev. Lett. 97 (2006) 170201). Where an equilibrium is left instead, the spheres are jammed, and
/// the step is taken back and halved: growth and relaxation as in O'Hern, Silbert, Liu & Nagel,
/// Phys. Rev. E 68 (2003) 011306. Without friction this ends at the densest random packing, a
/// porosity of about 0.36 of equal spheres far from walls; anything looser is reached without
/// contacts, and is uniform, as all spheres grow at the same time.
///
/// Springs are those of the default contact law for a modulus E: 2 E r_a r_b / (r_a + r_b), E r at
/// the sides of the container, and at planes and obstacles that of E r and their own in series. A
/// plane along a side of the container is that side. Lengths and pressures here are for E = 1. One thread, one order: the same bits on
/// every machine. A step of relaxation is linear in the number of spheres.
class SpherePacking {
 public:
  /// @param centres  m, one for each sphere, with room for them at the first factor
  /// @param radii    m, what they shall be
  /// @param factor   of the radii at first
  SpherePacking(std::vector<Vec3> centres, std::vector<double> radii, double factor,
                const Container& container, const PackingWalls& walls);

  /// Grows until the radii are a factor times what they shall be, or the spheres are jammed.
  /// Afterwards nothing overlaps.
  /// @param tell  called now and then with the factor
  /// @returns whether it got there
  bool grow_to(double factor, const std::function<void(double)>& tell = {});

  /// Grows jammed spheres until their mean pressure is this over E, to a hundredth.
  /// @returns whether it got there
  bool press_to(double pressure, const std::function<void(double)>& tell = {});

  double factor() const noexcept { return factor_; }
  /// Over E: a third of the trace of the stress in the container, compression above 0.
  double pressure() const noexcept { return pressure_; }
  const std::vector<Vec3>& centres() const noexcept { return x_; }

 private:
  /// A sphere near something that does not move.
  struct Near {
    std::uint32_t sphere;
    std::uint32_t wall;  ///< among planes_, or obstacles_
  };
  struct Pair {
    std::uint32_t a;
    std::uint32_t b;
  };
  /// What a look at all forces tells.
  struct Forces {
    double deepest = 0.0;  ///< overlap over the sum of both radii, or the radius
    double carried = 0.0;  ///< sum of the magnitudes
    double moment = 0.0;   ///< sum of force times distance
    std::size_t contacts = 0;
  };
  enum class Relaxed : std::uint8_t { apart, balanced, neither };

  void set_factor(double factor);
  void find_neighbours();
  void find_pairs();
  void find_walls();
  bool has_moved_far() const;
  Forces add_forces();
  void push_apart(const Pair& pair, Forces& sum);
  void push(std::size_t sphere, const Vec3& outward, double distance, double spring, Forces& sum);
  double sum_of_resultants() const;
  Relaxed relax(bool to_balance);

  const Container& container_;
  std::vector<Obstacle> obstacles_;
  std::vector<contact::Plane> planes_;  // of the container too
  std::vector<double> plane_moduli_;    // by plane
  std::vector<double> radii_;           // m, as they shall be
  std::vector<double> mass_;            // for relaxation alone
  double factor_;
  double smallest_ = 0.0;  // m, of the radii
  double largest_ = 0.0;   // m
  double pressure_ = 0.0;
  std::vector<Vec3> x_;
  std::vector<Vec3> v_;
  std::vector<Vec3> f_;
  std::vector<Vec3> listed_;    // m, where they were when neighbours were looked for
  double listed_factor_ = 0.0;  // up to which the lists are good
  std::vector<Pair> pairs_;
  std::vector<Near> near_planes_;
  std::vector<Near> near_obstacles_;
};

}  // namespace plekton::apps
