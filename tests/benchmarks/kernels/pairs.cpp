// SPDX-License-Identifier: GPL-3.0-or-later
// Two primitives of a scene: nearest points with the features that hold them, gap, normal and arms,
// for each of the six pairs of geometry/closest/primitive_pairs.hpp.
#include "geometry/closest/primitive_pairs.hpp"
#include "tests/benchmarks/kernels/inputs.hpp"
#include "tests/benchmarks/kernels/subjects.hpp"

#include <string>

namespace plekton::benchmarks {
namespace {

using geometry::CellId;
using geometry::NodeId;

constexpr double kRadius = 0.1;  // m, of every primitive; the cores are about 1 m long

template <std::size_t kCount>
void add_element(const std::array<Vec3, kCount>& corners, geometry::Elements& elements,
                 std::vector<Vec3>& x) {
  std::array<NodeId, kCount> nodes;
  for (std::size_t k = 0; k < kCount; ++k) {
    nodes[k] = geometry::id_at<NodeId>(x.size());
    x.push_back(corners[k]);
  }
  if constexpr (kCount == 1) elements.spheres.push_back({nodes, kRadius});
  if constexpr (kCount == 2) elements.cylinders.push_back({nodes, kRadius});
  if constexpr (kCount == 3) elements.facets.push_back({nodes, kRadius});
}

/// Pairs of primitives of a scene, without common nodes.
template <std::size_t kCountA, std::size_t kCountB>
class PairScene {
 public:
  explicit PairScene(const CorePairs<kCountA, kCountB>& pairs) {
    geometry::Elements elements;
    for (const auto& pair : pairs) {
      add_element(pair.a, elements, x_);
      add_element(pair.b, elements, x_);
    }
    surface_ = geometry::Surface(elements.cylinders, elements.facets, x_.size());
    spheres_ = elements.spheres;
  }

  geometry::Proximity proximity_of(std::size_t pair) const {
    constexpr std::size_t kSameKind = kCountA == kCountB ? 1 : 0;
    const std::size_t a = (1 + kSameKind) * pair;
    const std::size_t b = a + kSameKind;
    if constexpr (kCountB == 1) {
      return geometry::proximity(spheres_[a], spheres_[b], x_);
    } else if constexpr (kCountA == 1) {
      return geometry::proximity(spheres_[a], surface_, cell<kCountB>(b), x_);
    } else {
      return geometry::proximity(surface_, cell<kCountA>(a), cell<kCountB>(b), x_);
    }
  }

 private:
  /// The cells are the facets, then the cylinders.
  template <std::size_t kCount>
  CellId cell(std::size_t place) const {
    return geometry::id_at<CellId>(kCount == 3 ? place : surface_.face_count() + place);
  }

  std::vector<Vec3> x_;
  std::vector<geometry::Sphere> spheres_;
  geometry::Surface surface_;
};

/// Places 0, 1, 2, ... of the inputs.
struct Places {
  std::size_t operator[](std::size_t i) const noexcept { return i; }
  std::size_t size() const noexcept { return kConfigurations; }
};

template <std::size_t kCountA, std::size_t kCountB, class Draw>
void add_scene(const std::string& name, Draw draw) {
  add_benchmark(name, [=](benchmark::State& state) {
    const PairScene<kCountA, kCountB> scene(draw());
    run_over(state, Places{}, [&](std::size_t pair) { return scene.proximity_of(pair); });
  });
}

template <std::size_t kCountA, std::size_t kCountB>
void add_primitives(const std::string& primitives) {
  const std::string start = "pair/" + primitives;
  add_scene<kCountA, kCountB>(start + "/distant",
                              [] { return core_pairs<kCountA, kCountB>(PairFamily::distant); });
  add_scene<kCountA, kCountB>(start + "/crossing",
                              [] { return core_pairs<kCountA, kCountB>(PairFamily::crossing); });
  add_scene<kCountA, kCountB>(start + "/flat_lattice",
                              [] { return lattice_pairs<kCountA, kCountB>(false); });
}

}  // namespace

void add_pairs() {
  add_primitives<1, 1>("sphere_sphere");
  add_primitives<1, 2>("sphere_cylinder");
  add_primitives<1, 3>("sphere_facet");
  add_primitives<2, 2>("cylinder_cylinder");
  add_primitives<2, 3>("cylinder_facet");
  add_primitives<3, 3>("facet_facet");
}

}  // namespace plekton::benchmarks
