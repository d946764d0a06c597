// SPDX-License-Identifier: GPL-3.0-or-later
// Gives the files that are named, or are in folders that are named, to a fuzzer's target one after
// the other: findings stay mended in any build. With `--random SECONDS SEED` random bytes for so
// long, where a target cannot be built with libFuzzer.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string_view>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

int give_random(double seconds, std::uint64_t seed) {
  constexpr std::size_t kLongest = 128;  // bytes
  std::mt19937_64 random(seed);
  std::vector<std::uint8_t> bytes;
  std::size_t count = 0;
  const auto begin = std::chrono::steady_clock::now();
  while (std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() <
         seconds) {
    bytes.resize(random() % kLongest);
    for (std::uint8_t& byte : bytes) {
      const std::uint64_t drawn = random();
      // Many zeros, so that numbers are small as often as large.
      byte = (drawn & 0x300U) == 0 ? std::uint8_t{0} : static_cast<std::uint8_t>(drawn);
    }
    // The last input is in a file, should it end the program.
    std::ofstream("last-input", std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
    ++count;
  }
  std::printf("%zu inputs\n", count);
  return 0;
}

std::vector<std::filesystem::path> files_of(int count, char** names) {
  namespace fs = std::filesystem;
  std::vector<fs::path> files;
  for (int i = 1; i < count; ++i) {
    if (fs::is_directory(names[i])) {
      for (const auto& entry : fs::directory_iterator(names[i])) files.push_back(entry.path());
    } else {
      files.emplace_back(names[i]);
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

int main(int count, char** names) {
  if (count == 4 && std::string_view(names[1]) == "--random")
    return give_random(std::atof(names[2]), std::strtoull(names[3], nullptr, 10));
  const auto files = files_of(count, names);
  for (const auto& file : files) {
    std::printf("%s\n", file.c_str());
    std::fflush(stdout);  // so that the last one named is that of a crash
    std::ifstream in(file, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  }
  std::printf("%zu files\n", files.size());
  return files.empty() ? 1 : 0;
}
