#pragma once

#include "bindings/c/failure.h"

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace sinew::c {

/// Reason why no version of a struct has a size; null if one may.
inline const char* fault_of_size(std::size_t size, std::size_t first) {
    constexpr std::size_t longest = 4096;
    return size < first || size > longest ? "struct_size is not the size of the struct" : nullptr;
}

/// Copies a struct of the caller that begins with its size. A shorter one, down to the `first` version's size, is
/// filled up with zeros, which are the defaults; of a longer one, of a later version, the rest must be zero. Returns
/// the reason of a failure; null if there is none.
template <class Spec> const char* copy_sized(const void* given, std::size_t first, Spec& spec) {
    std::uint32_t size = 0;
    std::memcpy(&size, given, sizeof size);
    if (const auto* fault = fault_of_size(size, first)) return fault;
    const auto* bytes = static_cast<const unsigned char*>(given);
    for (std::size_t i = sizeof(Spec); i < size; ++i)
        if (bytes[i] != 0) return "the struct has a field of a later version, which this library lacks";
    spec = {};
    std::memcpy(&spec, given, size < sizeof(Spec) ? size : sizeof(Spec));
    return nullptr;
}

/// The same for a parameter; `first`: size of the first version, today's unless the struct has grown.
template <class Spec> sinew_status take(const Spec* given, Spec& spec, std::size_t first = sizeof(Spec)) {
    if (!given) return null_argument();
    const auto* fault = copy_sized(given, first, spec);
    return fault ? fail(SINEW_BAD_ARGUMENT, fault) : SINEW_OK;
}

/// Status of a struct of the caller that a function fills: its size must be that of the first version, today's, or
/// more.
template <class State> sinew_status can_fill(const State* out) {
    if (!out) return null_argument();
    const auto* fault = fault_of_size(out->struct_size, sizeof(State));
    return fault ? fail(SINEW_BAD_ARGUMENT, fault) : SINEW_OK;
}

/// Converts to any type of an alignment.
template <std::size_t alignment> struct Aligned {
    template <class T>
    requires(alignof(T) == alignment) operator T() const;
};

/// Place of the field after `struct_size`, which is 8-aligned or not.
template <class State> inline constexpr std::size_t place_of_second = requires {
    State{std::uint32_t(0), Aligned<8>{}};
}
? 8 : 4;

/// Fills a struct of the caller, of which can_fill() is true: fields of a later version, which the library lacks, are
/// 0, and so are bytes between `struct_size` and the next field.
template <class State> void fill_sized(const State& made, State* out) {
    constexpr auto own = sizeof out->struct_size, second = place_of_second<State>;
    const std::size_t size = out->struct_size, known = size < sizeof(State) ? size : sizeof(State);
    auto* bytes = reinterpret_cast<unsigned char*>(out);
    std::memset(bytes + own, 0, second - own);
    std::memcpy(bytes + second, reinterpret_cast<const unsigned char*>(&made) + second, known - second);
    std::memset(bytes + known, 0, size - known);
}

} // namespace sinew::c
