// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/validation/validation_case.hpp"

#include <span>
#include <string>
#include <string_view>

namespace plekton::apps {

/// A case with what it came to.
struct DoneCase {
  const ValidationCase* of;
  CaseReport report;
  double seconds = 0.0;
  std::string error;  ///< why it has no result

  bool passes() const;
};

/// A page of its own, with all figures in it, that loads nothing.
/// @param origin  Version, revision, compiler, host and date, in a line.
std::string validation_page(std::span<const DoneCase> cases, const std::string& origin);

/// Tells such a page by its first bytes.
bool is_validation_page(std::string_view head);

}  // namespace plekton::apps
