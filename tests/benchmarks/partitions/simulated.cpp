// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of ranks as SimGrid sees them: each rank takes the part that plekton-bench-partitions has
// counted for it, computes for as long as that would take, and sends messages of those sizes.
// simulate.py compiles and starts it; the build of the project does not.
//
// Usage: simulated PARTS whole|planned
#include <mpi.h>
#include <smpi/smpi.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <vector>

namespace {

// s, of one core, as measured with 100 000 spheres (docs/howto/many_ranks.md): 72 ns a sphere and
// step, of which about 5 go into lists, and about 5 into the walls; about a tenth of the spheres
// there lie on these.
constexpr double kPairsTime = 62e-9;   // a sphere
constexpr double kListTime = 5e-9;     // a sphere
constexpr double kWallTime = 50e-9;    // a sphere on a wall
constexpr double kFlops = 1e9;         // a second, of the machine that simulate.py describes
constexpr double kBandwidth = 12.5e9;  // bytes a second, likewise
constexpr int kSteps = 3;
constexpr int kTag = 1;

struct Message {
  int rank;
  int sums;    // bytes
  int motion;  // bytes
};

struct Part {
  double spheres, at_walls, border_work, inner_work;
  std::vector<Message> sent, received;
};

/// What plekton-bench-partitions --write has counted.
struct Parts {
  explicit Parts(const char* path) {
    std::ifstream file(path);
    std::size_t count = 0;
    file >> count >> total_bytes >> list_bytes >> steps_between_lists;
    of_ranks.resize(count);
    for (std::size_t rank = 0; rank < count; ++rank) {
      Part& part = of_ranks[rank];
      std::size_t neighbours = 0;
      file >> part.spheres >> part.at_walls >> part.border_work >> part.inner_work >> neighbours;
      for (std::size_t i = 0; i < neighbours; ++i) {
        Message message{};
        file >> message.rank >> message.sums >> message.motion;
        part.sent.push_back(message);
        of_ranks[static_cast<std::size_t>(message.rank)].received.push_back(
            {static_cast<int>(rank), message.sums, message.motion});
      }
      spheres += part.spheres;
      at_walls += part.at_walls;
      work += part.border_work + part.inner_work;
    }
    is_read = static_cast<bool>(file);
  }
  double time_of_one() const { return spheres * (kPairsTime + kListTime) + at_walls * kWallTime; }

  std::vector<Part> of_ranks;
  double total_bytes = 0, list_bytes = 0;
  double steps_between_lists = 1;
  double spheres = 0, at_walls = 0, work = 0;
  bool is_read = false;
};

void compute(double seconds) {
  smpi_execute_flops(seconds * kFlops);
}

class Rank {
 public:
  Rank(const Parts& parts, bool is_planned) : parts_(parts), is_planned_(is_planned) {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    part_ = &parts.of_ranks[static_cast<std::size_t>(rank)];
    const int total = static_cast<int>(parts.total_bytes) * static_cast<int>(parts.of_ranks.size());
    int largest = 0;
    for (const Part& part : parts.of_ranks) {
      for (const Message& message : part.sent)
        largest = std::max({largest, message.sums, message.motion});
    }
    // One piece of memory of all ranks: what is in it does not matter.
    room_ = static_cast<char*>(SMPI_SHARED_MALLOC(static_cast<std::size_t>(total)));
    sent_ =
        static_cast<char*>(SMPI_SHARED_MALLOC(static_cast<std::size_t>(std::max(total, largest))));
  }
  ~Rank() {
    SMPI_SHARED_FREE(room_);
    SMPI_SHARED_FREE(sent_);
  }

  void step() {
    const Part& part = *part_;
    const double spheres = is_planned_ ? part.spheres : parts_.spheres;
    compute(spheres * kListTime + part.at_walls * kWallTime);
    const double time_of_work = kPairsTime * parts_.spheres / parts_.work;
    compute(part.border_work * time_of_work);
    begin_exchange(&Message::sums);
    compute(part.inner_work * time_of_work);
    end_exchange();
    const auto bytes = static_cast<int>(parts_.total_bytes);
    MPI_Allgather(sent_, bytes, MPI_CHAR, room_, bytes, MPI_CHAR, MPI_COMM_WORLD);
    if (!is_planned_) take_lists();
    begin_exchange(&Message::motion);
    end_exchange();
  }

 private:
  /// At a new list all spheres go to all: 1.5 GB for ten million spheres, which is taken to
  /// come as fast as a link can bring it.
  void take_lists() { compute(parts_.list_bytes / (parts_.steps_between_lists * kBandwidth)); }

  void begin_exchange(int Message::*size) {
    requests_.clear();
    for (const Message& from : part_->received) {
      if (from.*size > 0)
        MPI_Irecv(room_, from.*size, MPI_CHAR, from.rank, kTag, MPI_COMM_WORLD,
                  &requests_.emplace_back());
    }
    for (const Message& to : part_->sent) {
      if (to.*size > 0)
        MPI_Isend(sent_, to.*size, MPI_CHAR, to.rank, kTag, MPI_COMM_WORLD,
                  &requests_.emplace_back());
    }
  }
  void end_exchange() {
    MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
  }

  const Parts& parts_;
  bool is_planned_;
  const Part* part_;
  std::vector<MPI_Request> requests_;
  char* room_;
  char* sent_;
};

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int rank = 0, count = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  const Parts parts(argv[1]);
  if (!parts.is_read || parts.of_ranks.size() != static_cast<std::size_t>(count)) {
    std::fprintf(stderr, "%s: not the parts of %d ranks\n", argv[1], count);
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  {
    Rank steps(parts, std::strcmp(argv[2], "planned") == 0);
    MPI_Barrier(MPI_COMM_WORLD);
    const double begin = MPI_Wtime();
    for (int step = 0; step < kSteps; ++step) steps.step();
    MPI_Barrier(MPI_COMM_WORLD);
    const double time = (MPI_Wtime() - begin) / kSteps;
    if (rank == 0)
      std::printf("%.6g %.6g %.4f\n", 1e3 * parts.time_of_one(), 1e3 * time,
                  parts.time_of_one() / (count * time));
  }
  MPI_Finalize();
}
