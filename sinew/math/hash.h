#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sinew {

/// A running hash of plain data: XXH3, 64 bits, each piece seeded with the hash so far. Bytes are hashed as they lie in
/// memory, on the little-endian machines this runs on.
class Hash {
  public:
    void add(std::span<const std::byte> bytes);

    template <class T> void add(const std::vector<T>& column) { add(std::as_bytes(std::span(column))); }
    void add(std::uint64_t number) { add(std::as_bytes(std::span(&number, 1))); }

    std::uint64_t value() const { return value_; }

  private:
    std::uint64_t value_ = 0;
};

} // namespace sinew
