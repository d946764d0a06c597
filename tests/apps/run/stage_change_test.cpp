// SPDX-License-Identifier: GPL-3.0-or-later
// From stage to stage: all that remembers goes on as if there was no change, whatever it is.
#include "apps/run/stage_change.hpp"

#include "tests/apps/command_line/program_fixture.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <ostream>
#include <string>

namespace plekton::apps::stage_change_test {
namespace {

constexpr const char* kSameBits = "tests/same_bits/scenes/";
constexpr const char* kScenes = "tests/apps/run/scenes/";

struct Scene {
  const char* name;
  const char* folder;
  const char* body;      ///< as a load names it
  const char* material;  ///< of a plane
  double time_step;      ///< s, some part of the critical one
};

std::ostream& operator<<(std::ostream& out, const Scene& scene) {
  return out << scene.name;
}

class StageChange : public testing::TestWithParam<Scene> {
 protected:
  /// The scenario without its duration, in two stages of 1200 steps.
  std::string in_stages() const {
    std::string text = test::bytes_of(GetParam().folder + std::string(GetParam().name) + ".toml");
    const std::size_t begin = text.find("duration = ");
    text.erase(begin, text.find('\n', begin) - begin);
    const std::string half = std::to_string(1200 * GetParam().time_step);
    return text + "\n[[stages]]\nname = \"a\"\nsimulation.time_step = " +
           std::to_string(GetParam().time_step) + "\nend = { duration = " + half +
           " }\n[[stages]]\nname = \"b\"\nend = { duration = " + half + " }\n";
  }
  std::string energies_of(const std::string& name, const std::string& text) const {
    test::write_bytes(folder_ / (name + ".toml"), text);
    const Outcome outcome = Program({"run", (folder_ / (name + ".toml")).string(), "--quiet",
                                     "--out", (folder_ / name).string()})
                                .wait();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return test::bytes_of(folder_ / (name + "/energy.csv"));
  }

  test::TemporaryFolder folder_;
};

/// The load pulls with nothing, and the plane is far away: but the simulation is another one.
TEST_P(StageChange, IsNotSeenInWhatStaysAsItIs) {
  const std::string scene = in_stages();
  const std::string changed = scene + "[[stages.planes]]\nname = \"far\"\npoint = [0, 0, -1e3]\n" +
                              "material = \"" + GetParam().material + "\"\n[[stages.loads]]\n" +
                              "kind = \"force\"\nforce = [0, 0, 0]\nnodes = \"all\"\n" +
                              GetParam().body + "\n";

  const std::string whole = energies_of("whole", scene);

  EXPECT_GT(whole.size(), 1000U);
  EXPECT_EQ(energies_of("changed", changed), whole);
}

INSTANTIATE_TEST_SUITE_P(
    , StageChange,
    testing::Values(Scene{"catch", kSameBits, "membrane = \"hammock\"", "gravel", 5e-6},
                    Scene{"hertz", kSameBits, "grains = \"sand\"", "sand", 5e-6},
                    Scene{"net", kSameBits, "membrane = \"net\"", "steel", 1.1e-5},
                    Scene{"sheets", kSameBits, "membrane = \"sheet\"", "cloth", 1e-5},
                    Scene{"tube", kSameBits, "membrane = \"bladder\"", "rubber", 1.2e-5},
                    Scene{"turn", kSameBits, "membrane = \"basket\"", "rubber", 8e-6},
                    Scene{"glued", kScenes, "membrane = \"lower\"", "cloth", 5e-6},
                    Scene{"lattice", kScenes, "membrane = \"lattice\"", "steel", 2.1e-5},
                    Scene{"rolling", kScenes, "membrane = \"sheet\"", "sand", 1e-5},
                    Scene{"shells", kScenes, "membrane = \"left\"", "rubber", 1.5e-5}),
    [](const auto& scene) { return std::string(scene.param.name); });

}  // namespace
}  // namespace plekton::apps::stage_change_test
