// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <string>
#include <type_traits>

namespace plekton::test {

/// For INSTANTIATE_TEST_SUITE_P: what a parameter prints as, with _ for what no name may have.
inline constexpr auto name_of_parameter = [](const auto& info) {
  std::string name;
  if constexpr (std::is_convertible_v<decltype(info.param), std::string>)
    name = info.param;  // a pointer prints its address
  else
    name = testing::PrintToString(info.param);
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
};

}  // namespace plekton::test
