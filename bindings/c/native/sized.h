#pragma once

#include "bindings/c/failure.h"

#include <cstdint>
#include <cstring>

namespace sinew::c {

/// Copies a struct of the caller that begins with its size; fails for a size of no version. All versions so far have
/// one size.
template <class Spec> sinew_status take(const Spec* given, Spec& spec) {
    if (!given) return null_argument();
    std::uint32_t size = 0;
    std::memcpy(&size, given, sizeof size);
    if (size != sizeof(Spec)) return fail(SINEW_BAD_ARGUMENT, "struct_size is not the size of the struct");
    spec = *given;
    return SINEW_OK;
}

} // namespace sinew::c
