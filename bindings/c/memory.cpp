#include "bindings/c/sinew.h"

#include <cstdint>
#include <cstdlib>

/// Functions that every module has, with or without an engine.
extern "C" {

uint32_t sinew_abi(void) {
    return SINEW_ABI;
}

void* sinew_allocate(size_t bytes) {
    if (bytes > PTRDIFF_MAX) return nullptr; // larger than any object of C: some allocators abort
    return std::malloc(bytes > 0 ? bytes : 1);
}

void sinew_free(void* memory) {
    std::free(memory);
}

} // extern "C"
