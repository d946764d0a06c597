// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/scenes/scene_table.hpp"

#include "tests/benchmarks/scenes/boulder_in_net.hpp"
#include "tests/benchmarks/scenes/geogrid_pullout.hpp"
#include "tests/benchmarks/scenes/hollow_spheres.hpp"
#include "tests/benchmarks/scenes/layer_of_spheres.hpp"
#include "tests/benchmarks/scenes/sphere_bed.hpp"
#include "tests/benchmarks/scenes/spheres_on_membrane.hpp"

#include <array>
#include <iomanip>
#include <sstream>
#include <stdexcept>

namespace plekton::benchmarks {
namespace {

BenchmarkScene of_bed(const SceneInput& input) {
  return sphere_bed(input.bed);
}
BenchmarkScene of_bed_and_sheet(const SceneInput& input) {
  return spheres_on_membrane(input.bed, input.cells);
}
BenchmarkScene of_bed_and_grid(const SceneInput& input) {
  return geogrid_pullout(input.bed);
}
BenchmarkScene of_hollow_sphere(const SceneInput&) {
  return hollow_sphere_on_floor();
}
BenchmarkScene of_hollow_spheres(const SceneInput&) {
  return colliding_hollow_spheres();
}
BenchmarkScene of_boulder(const SceneInput&) {
  return boulder_in_net();
}

constexpr double kLifted = 3e-3;  // m, further than lists of pairs reach

template <Ground kGround>
BenchmarkScene of_layer(const SceneInput&) {
  return layer_of_spheres(kGround, 0.0);
}
template <Ground kGround>
BenchmarkScene of_lifted_layer(const SceneInput&) {
  return layer_of_spheres(kGround, kLifted);
}

// clang-format off
constexpr std::array<SceneEntry, 11> kScenes = {{
    {"s1",     "spheres at rest in a box",                          "spheres",             BedKind::cube, 5000,  200,  2000, of_bed},
    {"s1flow", "spheres collapsing into a box three times as long", "spheres",             BedKind::flow, 20000, 100,  400,  of_bed},
    {"s2",     "spheres on a membrane held at its rim",             "spheres + facets",    BedKind::slab, 5000,  4000, 600,  of_bed_and_sheet},
    {"s3",     "a geogrid pulled through spheres",                  "spheres + cylinders", BedKind::cube, 10000, 5000, 600,  of_bed_and_grid},
    {"s4a",    "a hollow sphere hits a floor",                      "facets",              {},            0,     700,  1200, of_hollow_sphere},
    {"s4b",    "20 hollow spheres collide",                         "facets",              {},            0,     300,  300,  of_hollow_spheres},
    {"s5",     "a boulder caught by a net of 60 x 60 meshes",       "cylinders",           {},            0,     30000, 100,  of_boulder},
    {"layer_sheet",          "spheres beside each other on a sheet",             "spheres + facets", {}, 0, 200, 600, of_layer<Ground::sheet>},
    {"layer_sheet_lifted",   "the same, lifted so far that nothing touches",     "spheres + facets", {}, 0, 200, 600, of_lifted_layer<Ground::sheet>},
    {"layer_spheres",        "spheres beside each other, each on another one",   "spheres",          {}, 0, 200, 600, of_layer<Ground::spheres>},
    {"layer_spheres_lifted", "the same, lifted so far that nothing touches",     "spheres",          {}, 0, 200, 600, of_lifted_layer<Ground::spheres>},
}};
// clang-format on

}  // namespace

std::span<const SceneEntry> scene_table() noexcept {
  return kScenes;
}

std::string list_of_scenes() {
  std::ostringstream text;
  for (const SceneEntry& scene : kScenes) {
    text << std::left << std::setw(22) << scene.name << scene.what << " (" << scene.elements
         << ")\n";
  }
  return text.str();
}

const SceneEntry& find_scene(std::string_view name) {
  for (const SceneEntry& scene : kScenes) {
    if (scene.name == name) return scene;
  }
  throw std::invalid_argument("there is no scene '" + std::string(name) + "'; there are\n" +
                              list_of_scenes());
}

}  // namespace plekton::benchmarks
