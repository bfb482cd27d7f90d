#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sinew {

/// Running hash of plain data: XXH3, 64 bits, each piece seeded with the hash of the pieces before. Bytes are hashed in
/// memory order; all supported machines are little-endian.
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
