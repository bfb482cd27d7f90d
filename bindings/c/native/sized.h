#pragma once

#include "bindings/c/failure.h"

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace sinew::c {

/// Copies a struct of the caller that begins with its size. A shorter one, down to the `first` version's size, is
/// filled up with zeros, which are the defaults; of a longer one, of a later version, the rest must be zero. Returns
/// the reason of a failure; null if there is none.
template <class Spec> const char* copy_sized(const void* given, std::size_t first, Spec& spec) {
    constexpr std::size_t longest = 4096;
    std::uint32_t size = 0;
    std::memcpy(&size, given, sizeof size);
    if (size < first || size > longest) return "struct_size is not the size of the struct";
    const auto* bytes = static_cast<const unsigned char*>(given);
    for (std::size_t i = sizeof(Spec); i < size; ++i)
        if (bytes[i] != 0) return "the struct has a field of a later version, which this library lacks";
    spec = {};
    std::memcpy(&spec, given, size < sizeof(Spec) ? size : sizeof(Spec));
    return nullptr;
}

/// The same for a parameter, whose first version is today's.
template <class Spec> sinew_status take(const Spec* given, Spec& spec) {
    if (!given) return null_argument();
    const auto* fault = copy_sized(given, sizeof(Spec), spec);
    return fault ? fail(SINEW_BAD_ARGUMENT, fault) : SINEW_OK;
}

} // namespace sinew::c
