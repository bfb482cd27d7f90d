#pragma once

#include "sinew/math/vec.h"
#include "sinew/snapshot/bytes.h"

#include <array>
#include <bit>

/// Numbers packed in memory: those of neighbours mostly have the same sign, exponent and first digits. Each is XORed
/// with the number of the row before, and the leading bytes that are zero then are left out.
///
///     2 bits   of each number: 0 no byte is kept, 1 all but two, 2 all but one, 3 all
///     bytes    that are kept, the lowest first, and at the end as many as a number has
namespace sinew::snapshot {

template <class Real> class Tails {
    using Word = std::conditional_t<sizeof(Real) == sizeof(std::uint32_t), std::uint32_t, std::uint64_t>;
    static constexpr std::size_t size = sizeof(Real);
    static constexpr std::array<std::size_t, 4> kept = {0, size - 2, size - 1, size};
    static constexpr Word low_bytes(std::size_t count) { return Word(~Word(0)) >> (8 * (size - count)); }
    static constexpr std::array<Word, 4> mask = {0, low_bytes(size - 2), low_bytes(size - 1), low_bytes(size)};

    static std::size_t code_bytes(std::size_t numbers) { return (numbers + 3) / 4; }
    static unsigned code_of(Word word) {
        return unsigned(word != 0) + unsigned((word >> (8 * (size - 2))) != 0) +
               unsigned((word >> (8 * (size - 1))) != 0);
    }
    /// A number without the bits that it shares with the one of the row before.
    static Word word_of(std::span<const Real> numbers, std::size_t i, std::size_t stride) {
        return std::bit_cast<Word>(numbers[i]) ^ before(numbers, i, stride);
    }
    static Word before(std::span<const Real> numbers, std::size_t i, std::size_t stride) {
        return i < stride ? Word(0) : std::bit_cast<Word>(numbers[i - stride]);
    }
    /// Estimate by some of the numbers whether tails are shorter.
    static bool seems_worth(std::span<const Real> numbers, std::size_t stride) {
        constexpr std::size_t samples = 256;
        const auto step = numbers.size() / samples + 1;
        std::size_t bytes = 0, whole = 0;
        for (std::size_t i = 0; i < numbers.size(); i += step, whole += size)
            bytes += kept[code_of(word_of(numbers, i, stride))];
        return bytes + bytes / 16 < whole; // two bits more of 32
    }

  public:
    /// `stride`: numbers of a row. False, and nothing is written, where rows as they are take no more bytes.
    static bool write(ByteWriter& writer, std::span<const Real> numbers, std::size_t stride) {
        if (!seems_worth(numbers, stride)) return false;
        const auto begin = writer.size();
        std::byte* const codes = writer.extend(code_bytes(numbers.size()) + (numbers.size() + 1) * size);
        std::byte* to = codes + code_bytes(numbers.size());
        for (std::size_t first = 0; first < numbers.size(); first += 4) {
            unsigned four = 0;
            for (std::size_t i = first; i < std::min(first + 4, numbers.size()); ++i) {
                const auto word = word_of(numbers, i, stride);
                const auto code = code_of(word);
                four |= code << (2 * (i % 4));
                std::memcpy(to, &word, size);
                to += kept[code];
            }
            codes[first / 4] = std::byte(four);
        }
        const auto used = std::size_t(to - codes) + size;
        const bool pays = used < numbers.size_bytes();
        writer.shrink(pays ? begin + used : begin);
        return pays;
    }
    /// Reads bytes that write() wrote in this process: nothing is checked.
    static void read(ByteReader& reader, std::span<Real> numbers, std::size_t stride) {
        const auto* const codes = reader.rest().data();
        const auto* from = codes + code_bytes(numbers.size());
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const auto code = std::size_t(codes[i / 4] >> (2 * (i % 4))) & 3;
            Word word = 0;
            std::memcpy(&word, from, size);
            numbers[i] = std::bit_cast<Real>(Word((word & mask[code]) ^ before(numbers, i, stride)));
            from += kept[code];
        }
        reader.skip(std::size_t(from - codes) + size);
    }
};

/// Numbers of the rows of a column.
template <class Real> std::span<Real> numbers_in(std::vector<Real>& rows) {
    return rows;
}
template <int D, class Real> std::span<Real> numbers_in(std::vector<Vec<D, Real>>& rows) {
    return {rows.empty() ? nullptr : rows.front().component.data(), rows.size() * D};
}

} // namespace sinew::snapshot
