// SPDX-License-Identifier: GPL-3.0-or-later
// Cuts scenes into parts as ranks would, without computing a step, and counts what they would have
// to tell each other. Blocks of spheres and their owners are those of the library; for a sheet,
// which ranks do not share yet, it is what the same curve would give.
#include "contact/sphere_sphere/shared_blocks.hpp"
#include "contact/sphere_sphere/sphere_blocks.hpp"
#include "geometry/neighbor/space_order.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <numeric>
#include <vector>

namespace plekton::benchmarks {
namespace {

using contact::SphereBlocks;
using geometry::NodeId;
using geometry::Vec3;

constexpr double kSumBytes = 48;     // of a ghost, to its owner
constexpr double kMotionBytes = 72;  // of a ghost, from its owner
constexpr std::array kParts = {2, 8, 64, 512, 4096};

/// What a part has to do with others.
struct Part {
  std::uint64_t work = 0;
  std::uint64_t things = 0;
  std::uint64_t ghosts = 0;     ///< that it has of others
  std::vector<int> neighbours;  ///< may be there several times
};

void print_head(const char* things) {
  std::printf("%6s %12s %10s %10s %8s %10s %10s %10s\n", "parts", things, "ghosts", "most", "share",
              "kB a step", "neighbours", "imbalance");
}

/// @param bytes  a step, of one ghost
void print_row(std::vector<Part>& parts, double bytes) {
  double things = 0, ghosts = 0, work = 0;
  std::uint64_t most_ghosts = 0, most_work = 0;
  std::size_t most_neighbours = 0;
  for (Part& part : parts) {
    std::ranges::sort(part.neighbours);
    const auto twice = std::unique(part.neighbours.begin(), part.neighbours.end());
    part.neighbours.erase(twice, part.neighbours.end());
    things += static_cast<double>(part.things);
    ghosts += static_cast<double>(part.ghosts);
    work += static_cast<double>(part.work);
    most_ghosts = std::max(most_ghosts, part.ghosts);
    most_work = std::max(most_work, part.work);
    most_neighbours = std::max(most_neighbours, part.neighbours.size());
  }
  const auto count = static_cast<double>(parts.size());
  std::printf("%6zu %12.0f %10.0f %10llu %7.2f%% %10.1f %10zu %9.2f%%\n", parts.size(),
              things / count, ghosts / count, static_cast<unsigned long long>(most_ghosts),
              100.0 * ghosts / things, 1e-3 * bytes * static_cast<double>(most_ghosts),
              most_neighbours, 100.0 * (static_cast<double>(most_work) * count / work - 1.0));
}

/// Spheres in a dense crystal, each with its twelve neighbours, in no order in space.
struct Bed {
  explicit Bed(std::size_t about) {
    const int side = static_cast<int>(std::cbrt(2.0 * static_cast<double>(about)));
    const auto size = static_cast<std::size_t>(side);
    std::vector<std::int32_t> at(size * size * size, -1);
    const auto cell = [&](int i, int j, int k) {
      return (static_cast<std::size_t>(i) * size + static_cast<std::size_t>(j)) * size +
             static_cast<std::size_t>(k);
    };
    for (int i = 0; i < side; ++i)
      for (int j = 0; j < side; ++j)
        for (int k = (i + j) % 2; k < side; k += 2) {
          at[cell(i, j, k)] = static_cast<std::int32_t>(x.size());
          spheres.push_back({geometry::id_at<NodeId>(x.size()), 0.7, contact::MaterialId{0}, 1.0});
          x.emplace_back(i, j, k);
        }
    constexpr std::array<std::array<int, 3>, 6> kAhead = {
        {{0, 1, -1}, {0, 1, 1}, {1, -1, 0}, {1, 0, -1}, {1, 0, 1}, {1, 1, 0}}};
    const auto is_in = [side](int i) { return i >= 0 && i < side; };
    for (std::size_t n = 0; n < x.size(); ++n) {
      for (const auto& [di, dj, dk] : kAhead) {
        const int i = static_cast<int>(x[n][0]) + di, j = static_cast<int>(x[n][1]) + dj,
                  k = static_cast<int>(x[n][2]) + dk;
        if (is_in(i) && is_in(j) && is_in(k))
          pairs.push_back({static_cast<std::int32_t>(n), at[cell(i, j, k)]});
      }
    }
  }

  std::vector<Vec3> x;
  std::vector<contact::SphereBody> spheres;
  std::vector<geometry::IndexPair> pairs;
};

void count_bed(std::size_t about) {
  SphereBlocks blocks;
  std::size_t spheres = 0;
  {
    const Bed bed(about);
    spheres = bed.spheres.size();
    geometry::ThreadPool pool(2);
    blocks.assign(bed.pairs, bed.spheres, {}, pool, bed.x);
    std::printf("%zu spheres, %zu pairs, %zu blocks\n", spheres, bed.pairs.size(),
                blocks.blocks().size());
  }
  std::vector<std::uint64_t> work;
  std::vector<std::int32_t> block_of(spheres);
  for (std::size_t k = 0; k < blocks.blocks().size(); ++k) {
    work.push_back(contact::SharedBlocks::work_of(blocks, blocks.blocks()[k]));
    for (const SphereBlocks::Member& sphere : blocks.owned(blocks.blocks()[k]))
      block_of[index_of(sphere.node)] = static_cast<std::int32_t>(k);
  }
  print_head("spheres");
  for (const int count : kParts) {
    const std::vector<int> owners = geometry::Ranks::ranges_of_equal_work(work, count);
    std::vector<Part> parts(static_cast<std::size_t>(count));
    std::vector<int> last_with(spheres, -1);           // part that had a sphere as a ghost last
    for (std::size_t k = 0; k < owners.size(); ++k) {  // parts are ranges: one after the other
      Part& part = parts[static_cast<std::size_t>(owners[k])];
      part.work += work[k];
      part.things += blocks.blocks()[k].owned;
      for (const SphereBlocks::Member& ghost : blocks.ghosts(blocks.blocks()[k])) {
        const int owner = owners[static_cast<std::size_t>(block_of[index_of(ghost.node)])];
        if (owner == owners[k] || last_with[index_of(ghost.node)] == owners[k]) continue;
        last_with[index_of(ghost.node)] = owners[k];
        ++part.ghosts;
        part.neighbours.push_back(owner);
      }
    }
    print_row(parts, kSumBytes + kMotionBytes);
  }
}

/// A flat sheet of right triangles. A node is owned by the part of the first facet on it.
void count_sheet(std::size_t about) {
  const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(about) / 2.0));
  std::vector<Vec3> centres;
  std::vector<std::array<std::size_t, 3>> facets;
  const auto node = [&](std::size_t i, std::size_t j) { return i * (side + 1) + j; };
  for (std::size_t i = 0; i < side; ++i) {
    for (std::size_t j = 0; j < side; ++j) {
      const auto x = static_cast<double>(i), y = static_cast<double>(j);
      facets.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
      centres.emplace_back(x + 2.0 / 3.0, y + 1.0 / 3.0, 0);
      facets.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
      centres.emplace_back(x + 1.0 / 3.0, y + 2.0 / 3.0, 0);
    }
  }
  const std::vector<std::int32_t> order = geometry::order_along_curve(centres);
  std::printf("\n%zu facets, %zu nodes\n", facets.size(), (side + 1) * (side + 1));
  print_head("facets");
  for (const int count : kParts) {
    std::vector<Part> parts(static_cast<std::size_t>(count));
    std::vector<int> owners((side + 1) * (side + 1), -1), last_with(owners.size(), -1);
    for (std::size_t place = 0; place < order.size(); ++place) {
      const int owner = static_cast<int>(place * static_cast<std::size_t>(count) / order.size());
      Part& part = parts[static_cast<std::size_t>(owner)];
      ++part.work;
      ++part.things;
      for (const std::size_t corner : facets[static_cast<std::size_t>(order[place])]) {
        if (owners[corner] < 0) owners[corner] = owner;
        if (owners[corner] == owner || last_with[corner] == owner) continue;
        last_with[corner] = owner;
        ++part.ghosts;
        part.neighbours.push_back(owners[corner]);
      }
    }
    print_row(parts, kSumBytes + kMotionBytes);
  }
}

}  // namespace
}  // namespace plekton::benchmarks

int main(int argc, char** argv) {
  CLI::App app("Counts what ranks would have to tell each other in a step");
  std::size_t spheres = 10000000, facets = 1000000;
  app.add_option("--spheres", spheres, "about how many")->capture_default_str();
  app.add_option("--facets", facets, "about how many")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  plekton::benchmarks::count_bed(spheres);
  plekton::benchmarks::count_sheet(facets);
}
