// SPDX-License-Identifier: GPL-3.0-or-later
// Cuts scenes into parts as ranks would, without computing a step, and counts what they would have
// to tell each other: to neighbours, and to all. Blocks of spheres and their owners are those of the
// library; for a sheet, which ranks do not share yet, it is what the same curve would give.
#include "contact/sphere_sphere/shared_blocks.hpp"
#include "contact/sphere_sphere/sphere_blocks.hpp"
#include "dynamics/integrators/leapfrog.hpp"
#include "geometry/neighbor/space_order.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace plekton::benchmarks {
namespace {

using contact::SphereBlocks;
using geometry::NodeId;
using geometry::Vec3;

// Bytes, as contact/sphere_sphere/shared_blocks.* and shared_motion.* tell them.
constexpr std::uint64_t kSumBytes = 48;     // of a ghost of a block, to its owner
constexpr std::uint64_t kMotionBytes = 72;  // of a private sphere, to a rank that has it as a ghost
constexpr std::uint64_t kNodeBytes = 152;   // of a private sphere, to all ranks at a new list
constexpr std::uint64_t kPairBytes = 16;    // of a pair found, to who counts it and to who has it
/// Of a rank, to all: what its contacts between spheres and with planes came to, and its motion.
constexpr std::uint64_t kTotalBytes = 2 * sizeof(contact::BlockTotals) + sizeof(dynamics::StepSums);
constexpr int kStepsBetweenLists = 100;  // as in the bed of docs/howto/many_ranks.md
constexpr std::array kParts = {2, 8, 64, 256, 512, 4096};

/// What a part sends to another one in a step.
struct Message {
  std::uint64_t sums = 0;    ///< bytes
  std::uint64_t motion = 0;  ///< bytes
};

/// What a part has to do with others.
struct Part {
  std::uint64_t inner_work = 0;   ///< of blocks with ghosts of no other part; in pairs
  std::uint64_t border_work = 0;  ///< of those with
  std::uint64_t things = 0;
  std::uint64_t at_walls = 0;                        ///< of its spheres, of which each takes longer
  std::uint64_t ghosts = 0;                          ///< that it has of others
  std::map<int, Message> sent;                       ///< by receiver
  std::uint64_t bytes_sent = 0, bytes_received = 0;  ///< in a step, to and from its neighbours

  std::uint64_t work() const { return inner_work + border_work; }
};

/// Adds up what parts send, on both sides.
void add_up_messages(std::vector<Part>& parts) {
  for (Part& part : parts) {
    for (const auto& [to, message] : part.sent) {
      part.bytes_sent += message.sums + message.motion;
      parts[static_cast<std::size_t>(to)].bytes_received += message.sums + message.motion;
    }
  }
}

/// The largest of what all parts have.
template <class Of>
double most(const std::vector<Part>& parts, const Of& of) {
  double largest = 0.0;
  for (const Part& part : parts) largest = std::max(largest, static_cast<double>(of(part)));
  return largest;
}
template <class Of>
double mean(const std::vector<Part>& parts, const Of& of) {
  double sum = 0.0;
  for (const Part& part : parts) sum += static_cast<double>(of(part));
  return sum / static_cast<double>(parts.size());
}

void print_head(const char* things) {
  std::printf("%6s %11s %8s %8s %7s %10s %10s %10s %10s %10s %9s\n", "parts", things, "ghosts",
              "most", "share", "kB sent", "kB taken", "neighbours", "kB to all", "kB lists",
              "imbalance");
}

/// What a part takes of all others at a new list, in bytes, if all the pairs that it has were found
/// by others.
double list_bytes(const std::vector<Part>& parts, std::uint64_t things) {
  const double pairs = mean(parts, [](const Part& part) { return part.work(); });
  return kNodeBytes * static_cast<double>(things) + kPairBytes * pairs;
}

/// @param bytes_of_list  that are taken at a new list
void print_row(const std::vector<Part>& parts, double bytes_of_list) {
  const auto ghosts = [](const Part& part) { return part.ghosts; };
  const auto things = [](const Part& part) { return part.things; };
  const auto work = [](const Part& part) { return part.work(); };
  const double to_all = kTotalBytes * static_cast<double>(parts.size());
  std::printf("%6zu %11.0f %8.0f %8.0f %6.2f%% %10.1f %10.1f %10.0f %10.1f %10.1f %8.2f%%\n",
              parts.size(), mean(parts, things), mean(parts, ghosts), most(parts, ghosts),
              100.0 * mean(parts, ghosts) / mean(parts, things),
              1e-3 * most(parts, [](const Part& part) { return part.bytes_sent; }),
              1e-3 * most(parts, [](const Part& part) { return part.bytes_received; }),
              most(parts, [](const Part& part) { return part.sent.size(); }), 1e-3 * to_all,
              1e-3 * bytes_of_list / kStepsBetweenLists,
              100.0 * (most(parts, work) / mean(parts, work) - 1.0));
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
          spheres.push_back(
              {geometry::id_at<NodeId>(x.size()), 0.7, contact::MaterialId{0}, -1, 1.0});
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

/// The bed in blocks, without its list.
struct BlockedBed {
  explicit BlockedBed(std::size_t about) {
    const Bed bed(about);
    spheres = bed.spheres.size();
    geometry::ThreadPool pool(2);
    blocks.assign(bed.pairs, bed.spheres, {}, pool, bed.x);
    std::printf("%zu spheres, %zu pairs, %zu blocks\n", spheres, bed.pairs.size(),
                blocks.blocks().size());
    work.assign(blocks.work().begin(), blocks.work().end());
    block_of.resize(spheres);
    for (std::size_t k = 0; k < work.size(); ++k)
      for (const SphereBlocks::Member& sphere : blocks.owned(blocks.blocks()[k]))
        block_of[index_of(sphere.node)] = static_cast<std::int32_t>(k);
    // The outermost layer lies on the walls of a box.
    const auto last = bed.x.back().maxCoeff();
    for (const Vec3& x : bed.x)
      is_at_wall.push_back(x.minCoeff() < 0.5 || x.maxCoeff() > last - 0.5 ? 1 : 0);
  }

  std::size_t spheres = 0;
  SphereBlocks blocks;
  std::vector<std::uint64_t> work;       ///< by block
  std::vector<std::int32_t> block_of;    ///< by sphere
  std::vector<std::uint8_t> is_at_wall;  ///< by sphere
};

/// Parts are ranges of blocks: those of one follow each other.
std::vector<Part> parts_of(const BlockedBed& bed, int count) {
  const std::vector<int> owners = geometry::Ranks::ranges_of_equal_work(bed.work, count);
  std::vector<Part> parts(static_cast<std::size_t>(count));
  std::vector<int> last_with(bed.spheres, -1);  // part that had a sphere as a ghost last
  for (std::size_t k = 0; k < owners.size(); ++k) {
    const int self = owners[k];
    Part& part = parts[static_cast<std::size_t>(self)];
    const SphereBlocks::Block& block = bed.blocks.blocks()[k];
    part.things += block.owned;
    for (const SphereBlocks::Member& sphere : bed.blocks.owned(block))
      part.at_walls += bed.is_at_wall[index_of(sphere.node)];
    bool is_at_border = false;
    for (const SphereBlocks::Member& ghost : bed.blocks.ghosts(block)) {
      const std::size_t sphere = index_of(ghost.node);
      const int owner = owners[static_cast<std::size_t>(bed.block_of[sphere])];
      if (owner == self) continue;
      is_at_border = true;
      part.sent[owner].sums += kSumBytes;  // once for each block that has it
      if (std::exchange(last_with[sphere], self) == self) continue;
      ++part.ghosts;
      parts[static_cast<std::size_t>(owner)].sent[self].motion += kMotionBytes;
    }
    (is_at_border ? part.border_work : part.inner_work) += bed.work[k];
  }
  add_up_messages(parts);
  return parts;
}

/// For simulate.py: a line of the whole, then one of each part.
void write(const std::vector<Part>& parts, double bytes_of_list,
           const std::filesystem::path& path) {
  std::ofstream file(path);
  file << parts.size() << ' ' << kTotalBytes << ' ' << bytes_of_list << ' ' << kStepsBetweenLists
       << '\n';
  for (const Part& part : parts) {
    file << part.things << ' ' << part.at_walls << ' ' << part.border_work << ' ' << part.inner_work
         << ' ' << part.sent.size();
    for (const auto& [to, message] : part.sent)
      file << ' ' << to << ' ' << message.sums << ' ' << message.motion;
    file << '\n';
  }
  if (!file.flush()) throw std::runtime_error(path.string() + ": cannot be written");
}

/// @param folder  where parts are written, a file for each number of them; empty: nowhere
void count_bed(std::size_t about, const std::filesystem::path& folder) {
  const BlockedBed bed(about);
  std::printf("%td of the spheres on the walls of a box\n", std::ranges::count(bed.is_at_wall, 1));
  print_head("spheres");
  for (const int count : kParts) {
    const std::vector<Part> parts = parts_of(bed, count);
    const double bytes = list_bytes(parts, bed.spheres);
    print_row(parts, bytes);
    if (!folder.empty()) write(parts, bytes, folder / (std::to_string(count) + ".txt"));
  }
}

/// A flat sheet of right triangles. A node is owned by the part of the first facet on it; the sums
/// of a ghost are told to its owner, and its motion by it.
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
      ++part.inner_work;
      ++part.things;
      for (const std::size_t corner : facets[static_cast<std::size_t>(order[place])]) {
        if (owners[corner] < 0) owners[corner] = owner;
        if (owners[corner] == owner || last_with[corner] == owner) continue;
        last_with[corner] = owner;
        ++part.ghosts;
        part.sent[owners[corner]].sums += kSumBytes;
        parts[static_cast<std::size_t>(owners[corner])].sent[owner].motion += kMotionBytes;
      }
    }
    add_up_messages(parts);
    print_row(parts, 0.0);
  }
}

}  // namespace
}  // namespace plekton::benchmarks

int main(int argc, char** argv) {
  CLI::App app("Counts what ranks would have to tell each other in a step");
  std::size_t spheres = 10000000, facets = 1000000;
  app.add_option("--spheres", spheres, "about how many")->capture_default_str();
  app.add_option("--facets", facets, "about how many")->capture_default_str();
  std::filesystem::path folder;
  app.add_option("--write", folder, "folder for the parts of the spheres, for simulate.py")
      ->check(CLI::ExistingDirectory);
  CLI11_PARSE(app, argc, argv);
  plekton::benchmarks::count_bed(spheres, folder);
  plekton::benchmarks::count_sheet(facets);
}
