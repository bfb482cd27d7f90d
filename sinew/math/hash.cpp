#include "sinew/math/hash.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace sinew {

void Hash::add(std::span<const std::byte> bytes) {
    value_ = XXH3_64bits_withSeed(bytes.data(), bytes.size(), value_);
}

} // namespace sinew
