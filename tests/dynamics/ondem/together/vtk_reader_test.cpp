// SPDX-License-Identifier: GPL-3.0-or-later
// ON-DEM files before the reader of VTK, which is that of ParaView.
#include "dynamics/ondem/write_ondem.hpp"
#include "tests/support/ondem_scene.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace plekton::dynamics::vtk_reader_test {
namespace {

using testing::HasSubstr;

struct Answer {
  int code = -1;
  std::string text;
};

Answer answer_of(const std::string& command) {
  Answer answer;
  std::FILE* const pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return answer;
  std::array<char, 4096> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) answer.text += buffer.data();
  const int status = pclose(pipe);
  if (WIFEXITED(status)) answer.code = WEXITSTATUS(status);
  return answer;
}

TEST(VtkReader, SeesBodiesMembranesAndContactsInBlocks) {
  constexpr int kSkipped = 77;
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "a.vtkhdf";
  write_ondem(file, test::ondem_scene());
  const std::string script = PLEKTON_SOURCE_DIR "/tests/support/open_vtkhdf.py " + file.string();
  Answer answer = answer_of("python3 " + script);
  if (answer.code == kSkipped && std::system("command -v pvpython > /dev/null 2>&1") == 0)
    answer = answer_of("pvpython --force-offscreen-rendering " + script);
  if (answer.code == kSkipped)
    GTEST_SKIP() << answer.text << "so VTK was not asked about our VTKHDF files";

  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_THAT(answer.text, HasSubstr("sand 1 1 0 0 angular_velocity,"));
  EXPECT_THAT(answer.text, HasSubstr("empty 0 0 0 0"));
  EXPECT_THAT(answer.text, HasSubstr("pairs 2 2 0 0"));
  EXPECT_THAT(answer.text, HasSubstr("membrane_0 4 0 2 1 radius,velocity"));
  EXPECT_THAT(answer.text, HasSubstr("contacts 2 0 1 0 gap,id,normal"));
}

}  // namespace
}  // namespace plekton::dynamics::vtk_reader_test
