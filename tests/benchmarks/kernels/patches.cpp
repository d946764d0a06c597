// SPDX-License-Identifier: GPL-3.0-or-later
// Balls that slide over a surface: which features push, patches, what they transfer, the law and
// the forces; all of contact/sphere_surface/surface_contacts.hpp between two lists of neighbours.
#include "contact/law/linear_frictional.hpp"
#include "contact/sphere_surface/surface_contacts.hpp"
#include "tests/benchmarks/kernels/run_over.hpp"
#include "tests/benchmarks/kernels/subjects.hpp"
#include "tests/support/contact_surfaces.hpp"

#include <cmath>
#include <string>
#include <vector>

namespace plekton::benchmarks {
namespace {

using contact::MaterialId;
using geometry::NodeId;
using geometry::Vec3;
using Law = contact::LinearFrictional;

constexpr std::size_t kBalls = 4096;
constexpr int kCells = 64;              // of a surface along either side, each 1 m
constexpr double kSurfaceRadius = 0.1;  // m, of all complexes
constexpr int kStepsOneWay = 50;
constexpr double kWay = 0.005;  // part of a ball's radius that it moves in a step

/// What the balls slide on, and where.
struct Ground {
  test::Complex surface;  ///< about z = 0
  double depth;           ///< part of a ball's radius that it sinks below z = 0
  bool along_edges;       ///< the centres stay exactly above lines of the lattice
};

/// Nodes up to a fifth of their spacing off their places, along each axis.
test::Complex rough_sheet() {
  test::Random random(1);
  return test::roughened(test::sheet(kCells), 1.0, 0.2, random);
}

/// Balls that do not feel each other, each going to and fro over the surface from a place of its
/// own; as many configurations as there are balls times steps. A step lasts 1 s.
class SlidingBalls {
 public:
  SlidingBalls(const Ground& ground, double radius)
      : x_(ground.surface.x),
        velocity_(x_.size() + kBalls, Vec3::Zero()),
        spin_(x_.size() + kBalls, Vec3::Zero()),
        surface_(ground.surface.cylinders, ground.surface.facets, x_.size() + kBalls),
        contacts_(surface_),
        way_(kWay * radius),
        forces_(x_.size() + kBalls) {
    place(ground, radius);
    list_neighbours(radius);
  }
  SlidingBalls(const SlidingBalls&) = delete;
  SlidingBalls& operator=(const SlidingBalls&) = delete;

  /// Forces add up over the steps; nothing follows them.
  void step() {
    const std::size_t first = x_.size() - kBalls;
    const bool turns = steps_++ % kStepsOneWay == 0;
    for (std::size_t i = first; i < x_.size(); ++i) {
      if (turns) velocity_[i] = -velocity_[i];
      x_[i] += velocity_[i];
    }
    contacts_.advance({x_, velocity_, spin_, way_}, 1.0, pool_);
    contacts_.add_forces(forces_, pool_);
  }

  double patches_per_ball() const {
    return static_cast<double>(contacts_.touching()) / static_cast<double>(kBalls);
  }
  double terms_per_ball() const {
    std::size_t terms = 0;
    contacts_.for_each_touching([&](const auto&...) { ++terms; });
    return static_cast<double>(terms) / static_cast<double>(kBalls);
  }

 private:
  void place(const Ground& ground, double radius) {
    test::Random random(2);
    const double margin = radius + kSurfaceRadius;  // no ball reaches the rim
    const auto anywhere = [&] { return random.uniform(margin, kCells - margin); };
    for (std::size_t i = 0; i < kBalls; ++i) {
      const double height = (1.0 - ground.depth) * radius + kSurfaceRadius;
      const double x = anywhere();
      const double y = ground.along_edges ? std::round(anywhere()) : anywhere();
      const Vec3 way = ground.along_edges ? Vec3::UnitX().eval() : in_plane(random);
      spheres_.push_back({{geometry::id_at<NodeId>(x_.size())}, radius});
      velocity_[x_.size()] = kWay * radius * way;
      x_.emplace_back(x, y, height);
    }
  }

  static Vec3 in_plane(test::Random& random) {
    Vec3 way = random.direction();
    way[2] = 0.0;
    return way.normalized();
  }

  /// Lists that hold for the whole way.
  void list_neighbours(double radius) {
    geometry::Neighbours neighbours(spheres_, surface_, 2.1 * kStepsOneWay * kWay * radius);
    neighbours.update(x_, pool_);
    std::vector<contact::SphereBody> balls;
    for (const auto& sphere : spheres_)
      balls.push_back({sphere.nodes[0], sphere.radius, MaterialId{0}});
    const std::vector<MaterialId> of_structures(surface_.structure_count(), MaterialId{0});
    contacts_.rebuild(neighbours.sphere_structures(), neighbours.near_cells(), neighbours.cells(),
                      balls, of_structures, contact::MaterialPairs({{1e6, 0.5, 0.4}}));
  }

  std::vector<Vec3> x_;  ///< m, the balls are the last nodes
  std::vector<Vec3> velocity_;
  std::vector<Vec3> spin_;
  std::vector<geometry::Sphere> spheres_;
  geometry::Surface surface_;
  contact::SurfaceContacts contacts_;
  double way_;  ///< m, of every ball in a step
  contact::NodeForces forces_;
  geometry::ThreadPool pool_;
  std::int64_t steps_ = 0;
};

template <class Make>
void add_ground(const std::string& name, Make make) {
  for (const double radius : {0.5, 2.0}) {
    const std::string cells = radius < 1.0 ? "/ball_of_half_a_cell" : "/ball_of_two_cells";
    add_benchmark("patch/" + name + cells, [=](benchmark::State& state) {
      SlidingBalls balls(make(), radius);
      run_steps(state, kBalls, [&] { balls.step(); });
      state.counters["patches"] = balls.patches_per_ball();
      state.counters["terms"] = balls.terms_per_ball();
    });
  }
}

}  // namespace

void add_patches() {
  add_ground("flat_mesh", [] { return Ground{test::sheet(kCells), 0.03, false}; });
  add_ground("flat_mesh_along_edges", [] { return Ground{test::sheet(kCells), 0.03, true}; });
  add_ground("rough_mesh", [] { return Ground{rough_sheet(), 0.1, false}; });
  add_ground("net", [] { return Ground{test::net(kCells), 0.03, false}; });
}

}  // namespace plekton::benchmarks
