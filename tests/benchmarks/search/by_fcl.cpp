// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/search/codes.hpp"
#include "tests/benchmarks/search/stopwatch.hpp"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/distance.h>

#include <memory>

namespace plekton::benchmarks {
namespace {

using Model = fcl::BVHModel<fcl::OBBRSSd>;

std::shared_ptr<Model> model_of(const Shape& shape) {
  std::vector<fcl::Triangle> facets;
  facets.reserve(shape.facets.size());
  for (const auto& [a, b, c] : shape.facets) {
    facets.emplace_back(static_cast<std::size_t>(a), static_cast<std::size_t>(b),
                        static_cast<std::size_t>(c));
  }
  auto model = std::make_shared<Model>();
  model->beginModel(static_cast<int>(facets.size()), static_cast<int>(shape.points.size()));
  model->addSubModel(shape.points, facets);
  model->endModel();
  return model;
}

}  // namespace

Answer distance_by_fcl(const Shape& a, const Shape& b) {
  Answer answer{};
  Stopwatch watch;
  const fcl::CollisionObjectd on_a(model_of(a)), on_b(model_of(b));
  answer.build_s = watch.lap();
  fcl::DistanceResultd result;
  answer.distance = fcl::distance(&on_a, &on_b, fcl::DistanceRequestd(true), result);
  answer.ask_s = watch.lap();
  return answer;
}

}  // namespace plekton::benchmarks
