#pragma once

/// Whether the tests run under the address sanitizer, which makes them ten to a hundred times slower: what repeats
/// itself is then cut short.
namespace sinew::test {

#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool sanitized = true;
#elif defined(__has_feature)
inline constexpr bool sanitized = __has_feature(address_sanitizer);
#else
inline constexpr bool sanitized = false;
#endif

} // namespace sinew::test
