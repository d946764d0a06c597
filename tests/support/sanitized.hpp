// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#if defined(__has_feature)  // clang
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define PLEKTON_IS_SANITIZED 1
#endif
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define PLEKTON_IS_SANITIZED 1
#endif

namespace plekton::test {

/// By how much a sanitizer makes programs slower, or more.
#if defined(PLEKTON_IS_SANITIZED)
inline constexpr int kSlowedDown = 12;
#else
inline constexpr int kSlowedDown = 1;
#endif

}  // namespace plekton::test
