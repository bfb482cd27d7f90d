#include "files/out/deflate.h"

#include "files/checksum.h"
#include "files/deflate_tables.h"
#include "files/out/bytes.h"

#include <algorithm>
#include <vector>

namespace sinew::files {
namespace {

constexpr std::size_t shortest_copy = 3, window = 32768; // bytes
constexpr int longest_search = 32;                       // earlier places of the same three bytes

class Deflater {
  public:
    explicit Deflater(std::string_view data) : data_(data), latest_(hashes, none), earlier_(data.size(), none) {}

    std::string stream() {
        out_ = "\x78\x01";
        put(1, 1), put(1, 2); // one block, the last, of fixed codes
        for (std::size_t at = 0; at < data_.size();) {
            const auto copy = longest_match(at);
            const auto size = copy.size >= shortest_copy ? copy.size : 1;
            if (size == 1)
                put_symbol(static_cast<unsigned char>(data_[at]));
            else
                put_copy(copy);
            for (const auto end = at + size; at < end; ++at) remember(at);
        }
        put_symbol(256);
        if (held_count_ > 0) put(0, 8 - held_count_);
        put_big(out_, adler32(data_));
        return std::move(out_);
    }

  private:
    static constexpr std::size_t hashes = 1U << 15U;
    static constexpr std::uint32_t none = 0xffffffff;
    struct Copy {
        std::size_t size = 0, back = 0;
    };

    std::string_view data_;
    std::vector<std::uint32_t> latest_, earlier_; ///< places of three bytes, by their hash and by the later place
    std::string out_;
    std::uint32_t held_ = 0;
    unsigned held_count_ = 0; ///< bits

    std::uint32_t& latest(std::size_t at) {
        std::uint32_t hash = 0;
        for (std::size_t i = 0; i < shortest_copy; ++i) hash = hash * 191 + static_cast<unsigned char>(data_[at + i]);
        return latest_[hash * 2654435761U >> 17U];
    }
    void remember(std::size_t at) {
        if (at + shortest_copy > data_.size()) return;
        auto& place = latest(at);
        earlier_[at] = place;
        place = std::uint32_t(at);
    }

    Copy longest_match(std::size_t at) {
        Copy best;
        if (at + shortest_copy > data_.size()) return best;
        const auto most = std::min<std::size_t>(longest_copy, data_.size() - at);
        auto place = latest(at);
        for (int i = 0; i < longest_search && place != none && at - place <= window; ++i, place = earlier_[place]) {
            std::size_t size = 0;
            while (size < most && data_[place + size] == data_[at + size]) ++size;
            if (size > best.size) best = {size, at - place};
            if (size == most) break;
        }
        return best;
    }

    void put(std::uint32_t value, unsigned bits) {
        held_ |= value << held_count_, held_count_ += bits;
        for (; held_count_ >= 8; held_count_ -= 8, held_ >>= 8U) out_ += char(held_ & 255U);
    }
    /// Codes begin with their highest bit.
    void put_code(std::uint32_t code, unsigned bits) {
        std::uint32_t reversed = 0;
        for (unsigned i = 0; i < bits; ++i) reversed |= (code >> i & 1U) << (bits - 1 - i);
        put(reversed, bits);
    }
    /// RFC 1951, 3.2.6.
    void put_symbol(unsigned symbol) {
        if (symbol < 144) return put_code(0x30 + symbol, 8);
        if (symbol < 256) return put_code(0x190 + symbol - 144, 9);
        if (symbol < 280) return put_code(symbol - 256, 7);
        put_code(0xc0 + symbol - 280, 8);
    }
    void put_copy(const Copy& copy) {
        const auto number_of = [](const auto& table, std::size_t value) {
            return unsigned(std::ranges::upper_bound(table, value, {}, &CopyExtent::base) - table.begin()) - 1;
        };
        const auto length = number_of(copy_lengths, copy.size), distance = number_of(copy_distances, copy.back);
        put_symbol(257 + length);
        put(std::uint32_t(copy.size) - copy_lengths[length].base, copy_lengths[length].bits);
        put_code(distance, 5);
        put(std::uint32_t(copy.back) - copy_distances[distance].base, copy_distances[distance].bits);
    }
};

} // namespace

std::string deflated(std::string_view data) {
    return Deflater(data).stream();
}

} // namespace sinew::files
