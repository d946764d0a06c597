// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/pictures/render.hpp"

#include "apps/pictures/render_script.hpp"
#include "apps/scenario/problems.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

namespace plekton::apps::render_test {
namespace {

RunFolder run_with_frames() {
  RunFolder run;
  for (const double time : {0.0, 0.1, 0.2, 0.25}) run.frames.push_back({time, {}});
  return run;
}

TEST(FrameAt, IsTheNearestOrTheLast) {
  const RunFolder run = run_with_frames();

  EXPECT_EQ(frame_at(run, {}).time, 0.25);
  EXPECT_EQ(frame_at(run, 0.0).time, 0.0);
  EXPECT_EQ(frame_at(run, 0.14).time, 0.1);
  EXPECT_EQ(frame_at(run, 0.29).time, 0.25);
  EXPECT_THROW(frame_at(run, 0.5), InputError);
  EXPECT_THROW(frame_at(RunFolder{}, {}), InputError);
}

TEST(RenderScript, IsTheFileOfTheTree) {
  const auto file = std::filesystem::path(PLEKTON_SOURCE_DIR) / "apps/pictures/render_frame.py";

  EXPECT_EQ(render_script(), test::bytes_of(file));
}

}  // namespace
}  // namespace plekton::apps::render_test
