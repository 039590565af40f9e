#pragma once

namespace zstep::test {

/// Under sanitizers all takes five to ten times as long: what looks at very many looks at one in so many.
#if defined(__SANITIZE_ADDRESS__)
inline constexpr int sparse = 4;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
inline constexpr int sparse = 4;
#else
inline constexpr int sparse = 1;
#endif
#else
inline constexpr int sparse = 1;
#endif

}  // namespace zstep::test
