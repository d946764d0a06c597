// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/study/job_texts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace plekton::apps::job_texts_test {
namespace {

using testing::HasSubstr;

const JobSettings kSettings{"/opt/plekton", "/home/a b/it's.toml", "/data/$(id)", 3};

TEST(JobTexts, QuoteWhatAShellWouldReadOtherwise) {
  const std::array<std::size_t, 2> runs = {0, 6};

  EXPECT_EQ(
      parallel_lines(kSettings, runs),
      "/opt/plekton study '/home/a b/it'\\''s.toml' --out '/data/$(id)' --threads 3 --only 1\n"
      "/opt/plekton study '/home/a b/it'\\''s.toml' --out '/data/$(id)' --threads 3 --only 7\n");
}

TEST(JobTexts, NameTheTasksOfAnArrayByRanges) {
  const std::array<std::size_t, 6> runs = {0, 1, 2, 6, 8, 9};

  const std::string script = slurm_script(kSettings, runs);

  EXPECT_THAT(script, HasSubstr("#SBATCH --array=1-3,7,9-10\n"));
  EXPECT_THAT(script, HasSubstr("#SBATCH --job-name=it_s\n"));
  EXPECT_THAT(script, HasSubstr("--only \"$SLURM_ARRAY_TASK_ID\"\n"));
}

}  // namespace
}  // namespace plekton::apps::job_texts_test
