// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/scenario_reader.hpp"
#include "tests/support/seeded_random.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

namespace plekton::apps::scenario_mutation_test {
namespace {

/// A character, a few, or a line of the text changed, doubled or taken away.
std::string mutated(std::string text, test::Random& random) {
  constexpr std::string_view kCharacters = "[]{}=\",.#-+0123456789 \nabmskeE%\xff";
  const std::size_t at = random.index(text.size());
  const std::size_t length = std::min(text.size() - at, 1 + random.index(random.coin() ? 3 : 60));
  switch (random.index(4)) {
    case 0:
      return text.erase(at, length);
    case 1:
      return text.insert(at, text.substr(at, length));
    case 2:
      return text.insert(random.index(text.size()), text.substr(at, length));
    default:
      text[at] = kCharacters[random.index(kCharacters.size())];
      return text;
  }
}

/// Reads a text; only one kind of error is allowed. @returns whether it was read
bool is_read(const std::string& text, const std::filesystem::path& path) {
  try {
    (void)parse_scenario(text, path);
    return true;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()), "");
    return false;
  }
}

TEST(ScenarioReader, AnswersAnyTextWithAScenarioOrAnInputError) {
  for (const char* example : {"catch/catch.toml", "import/generators.toml"}) {
    const auto path = std::filesystem::path(PLEKTON_SOURCE_DIR "/apps/examples") / example;
    const std::string original = test::bytes_of(path);
    ASSERT_TRUE(is_read(original, path));
    test::Random random(11);
    int read = 0;
    for (int i = 0; i < 3000; ++i) {
      std::string text = mutated(original, random);
      while (random.coin()) text = mutated(text, random);
      if (is_read(text, path)) ++read;
    }

    // Changes of comments and digits, so that valid scenarios are among the cases.
    EXPECT_GT(read, 100) << example;
    EXPECT_LT(read, 2900) << example;
  }
}

}  // namespace
}  // namespace plekton::apps::scenario_mutation_test
