#include "files/in/inflate.h"

#include "sinew/scene/text.h"

#include "files/checksum.h"
#include "files/deflate_tables.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace sinew::files {
namespace {

constexpr unsigned longest_code = 15; // bits

/// A canonical prefix code: symbols by length of their code, then by number (RFC 1951, 3.2.2).
class PrefixCode {
  public:
    /// Lengths of the codes of symbols 0, 1, ...; 0 for a symbol without a code.
    explicit PrefixCode(const std::vector<std::uint8_t>& lengths) {
        for (const auto length : lengths) ++counts_[length];
        counts_[0] = 0;
        std::array<std::size_t, longest_code + 2> begin{};
        for (std::size_t length = 1; length <= longest_code; ++length) {
            free_ = 2 * free_ - counts_[length];
            begin[length + 1] = begin[length] + std::size_t(counts_[length]);
        }
        symbols_.resize(begin[longest_code + 1]);
        for (std::size_t symbol = 0; symbol < lengths.size(); ++symbol)
            if (lengths[symbol] != 0) symbols_[begin[lengths[symbol]]++] = std::uint16_t(symbol);
    }

    /// True if no bits have two meanings, and all have one; a code of one symbol may leave half of them without.
    bool is_valid() const { return free_ == 0 || symbols_.size() <= 1; }

    /// The symbol of the next bits; empty where they have no meaning.
    template <class NextBit> std::optional<unsigned> next(const NextBit& next_bit) const {
        int code = 0, first = 0;
        std::size_t before = 0;
        for (std::size_t length = 1; length <= longest_code; ++length) {
            code |= next_bit();
            const int count = counts_[length];
            if (code - first < count) return symbols_[before + std::size_t(code - first)];
            before += std::size_t(count);
            first = (first + count) << 1;
            code <<= 1;
        }
        return std::nullopt;
    }

  private:
    std::array<int, longest_code + 1> counts_{};
    std::vector<std::uint16_t> symbols_;
    int free_ = 1; ///< codes of the longest length without a symbol
};

class Inflater {
  public:
    Inflater(std::string_view stream, std::size_t max) : stream_(stream), max_(max) {}

    Inflated read() {
        const bool is_gzip = stream_.starts_with("\x1f\x8b");
        if (is_gzip ? skip_gzip_header() : skip_zlib_header()) {
            while (problem_.empty() && !is_last_) read_block();
            if (problem_.empty()) is_gzip ? check_gzip() : check_zlib();
        }
        return {std::move(out_), std::move(problem_), at_};
    }

  private:
    std::string_view stream_;
    std::size_t max_;
    std::size_t at_ = 0;      ///< next byte
    std::uint32_t held_ = 0;  ///< bits that were taken from the stream
    unsigned held_count_ = 0; ///< of them
    bool is_last_ = false;
    std::string out_, problem_;

    void fail(std::string_view problem) {
        if (problem_.empty()) problem_ = problem;
    }

    unsigned byte() {
        if (at_ < stream_.size()) return static_cast<unsigned char>(stream_[at_++]);
        fail("the compressed data breaks off");
        return 0;
    }
    /// So many bits, up to 16, the lowest first.
    unsigned bits(unsigned count) {
        while (held_count_ < count) held_ |= byte() << held_count_, held_count_ += 8;
        const unsigned value = held_ & ((1U << count) - 1);
        held_ >>= count, held_count_ -= count;
        return value;
    }
    std::uint32_t little(unsigned bytes) {
        std::uint32_t value = 0;
        for (unsigned i = 0; i < bytes; ++i) value |= byte() << (8 * i);
        return value;
    }

    bool skip_zlib_header() {
        const unsigned method = byte(), flags = byte();
        if ((method & 15U) != 8 || (method * 256 + flags) % 31 != 0 || (flags & 32U) != 0)
            fail("the compressed data does not begin as that of zlib does");
        return problem_.empty();
    }
    bool skip_gzip_header() {
        at_ = 2;
        if (byte() != 8) fail("the method of compression is not known");
        const unsigned flags = byte();
        at_ += 6; // time, level, system
        if ((flags & 4U) != 0) at_ += little(2);
        for (const unsigned flag : {8U, 16U}) // name, comment
            while ((flags & flag) != 0 && problem_.empty() && byte() != 0) {
            }
        if ((flags & 2U) != 0) at_ += 2;
        at_ = std::min(at_, stream_.size());
        return problem_.empty();
    }
    void check_zlib() {
        std::uint32_t sum = 0;
        for (int i = 0; i < 4; ++i) sum = sum << 8U | byte();
        if (problem_.empty() && sum != adler32(out_)) fail("the checksum of the data is another");
    }
    void check_gzip() {
        const auto sum = little(4), size = little(4);
        if (problem_.empty() && (sum != crc32(out_) || size != std::uint32_t(out_.size())))
            fail("the checksum of the data is another");
    }

    void read_block() {
        is_last_ = bits(1) != 0;
        switch (bits(2)) {
        case 0:
            return read_stored();
        case 1:
            return read_codes(fixed_symbols(), PrefixCode(std::vector<std::uint8_t>(30, 5)));
        case 2:
            return read_dynamic();
        default:
            return fail("a block of the compressed data is of no kind");
        }
    }

    void read_stored() {
        held_ = 0, held_count_ = 0; // the rest of the byte
        const auto size = little(2), complement = little(2);
        if (size != (~complement & 0xffffU)) return fail("the length of a block is damaged");
        if (size > stream_.size() - at_) return fail("the compressed data breaks off");
        out_ += stream_.substr(at_, size);
        at_ += size;
        check_size();
    }
    void check_size() {
        if (out_.size() > max_) fail(concat("the data has more than ", max_, " bytes"));
    }

    static const PrefixCode& fixed_symbols() {
        static const PrefixCode code = [] {
            std::vector<std::uint8_t> lengths(288, 8);
            std::fill(lengths.begin() + 144, lengths.begin() + 256, std::uint8_t(9));
            std::fill(lengths.begin() + 256, lengths.begin() + 280, std::uint8_t(7));
            return PrefixCode(lengths);
        }();
        return code;
    }

    unsigned symbol(const PrefixCode& code) {
        const auto found = code.next([&] { return int(bits(1)); });
        if (!found) fail("the compressed data has a code of no symbol");
        return found.value_or(0);
    }

    void read_dynamic() {
        constexpr std::array<std::uint8_t, 19> order = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                        11, 4,  12, 3, 13, 2, 14, 1, 15};
        const unsigned symbols = bits(5) + 257, distance_codes = bits(5) + 1, count = bits(4) + 4;
        if (symbols > 286 || distance_codes > 30) return fail("a block has more codes than there are");
        std::vector<std::uint8_t> lengths(19);
        for (unsigned i = 0; i < count; ++i) lengths[order[i]] = std::uint8_t(bits(3));
        const PrefixCode code(lengths);
        if (!code.is_valid()) return fail("the codes of a block are damaged");
        lengths.clear();
        while (problem_.empty() && lengths.size() < symbols + distance_codes) add_lengths(code, lengths);
        if (!problem_.empty()) return;
        if (lengths.size() > symbols + distance_codes) return fail("the codes of a block are damaged");
        const auto split = lengths.begin() + std::ptrdiff_t(symbols);
        const PrefixCode first(std::vector<std::uint8_t>(lengths.begin(), split));
        const PrefixCode second(std::vector<std::uint8_t>(split, lengths.end()));
        if (!first.is_valid() || !second.is_valid()) return fail("the codes of a block are damaged");
        read_codes(first, second);
    }
    void add_lengths(const PrefixCode& code, std::vector<std::uint8_t>& lengths) {
        const unsigned found = symbol(code);
        if (found < 16) return lengths.push_back(std::uint8_t(found));
        if (found == 16 && lengths.empty()) return fail("the codes of a block are damaged");
        const auto repeated = found == 16 ? lengths.back() : std::uint8_t(0);
        const unsigned count = found == 16 ? 3 + bits(2) : found == 17 ? 3 + bits(3) : 11 + bits(7);
        lengths.insert(lengths.end(), count, repeated);
    }

    void read_codes(const PrefixCode& symbols, const PrefixCode& distance_code) {
        constexpr unsigned end = 256;
        while (problem_.empty()) {
            const unsigned found = symbol(symbols);
            if (found == end) return;
            if (found < end)
                out_ += char(found);
            else
                copy(found - end - 1, distance_code);
            check_size();
        }
    }
    void copy(unsigned number, const PrefixCode& distance_code) {
        if (number >= copy_lengths.size()) return fail("the compressed data has a code of no symbol");
        const unsigned length = copy_lengths[number].base + bits(copy_lengths[number].bits);
        const unsigned which = symbol(distance_code);
        if (which >= copy_distances.size()) return fail("the compressed data has a code of no symbol");
        const std::size_t back = copy_distances[which].base + bits(copy_distances[which].bits);
        if (!problem_.empty()) return;
        if (back > out_.size()) return fail("the compressed data refers to what is before its beginning");
        for (unsigned i = 0; i < length; ++i) out_ += out_[out_.size() - back];
    }
};

} // namespace

Inflated inflate(std::string_view stream, std::size_t max) {
    return Inflater(stream, max).read();
}

} // namespace sinew::files
