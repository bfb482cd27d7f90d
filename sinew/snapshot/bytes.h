#pragma once

#include "sinew/snapshot/version.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

/// Bytes of a file: little-endian numbers, and columns packed where their rows repeat or count up.
namespace sinew::snapshot {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

/// Refusal of bytes: place and reason.
struct SnapshotError {
    std::size_t at = 0;  ///< offset in the file, bytes
    std::string what{};  ///< reason
    std::string field{}; ///< "world.position"; empty outside of any field
    /// "byte 120 (particles.position): ..."
    std::string text() const;
};

/// Appends to a list of bytes. `compact`: looks for repetitions in columns, which takes time.
class ByteWriter {
  public:
    static constexpr bool is_reading = false;
    explicit ByteWriter(std::vector<std::byte>& to, bool compact = true) : to_(to), compact_(compact) {}

    bool is_compact() const { return compact_; }
    void append(const void* from, std::size_t count) {
        const auto size = to_.size();
        to_.resize(size + count);
        if (count > 0) std::memcpy(to_.data() + size, from, count);
    }
    template <class T> void number(const T& value) { append(&value, sizeof value); }
    /// Seven bits a byte, the lowest first.
    void count(std::uint64_t value) {
        for (; value >= 0x80; value >>= 7) number(std::uint8_t(value | 0x80));
        number(std::uint8_t(value));
    }
    std::size_t size() const { return to_.size(); }
    /// Appends zeros, to be filled in before anything else is appended.
    std::byte* extend(std::size_t count) {
        to_.resize(size() + count);
        return to_.data() + size() - count;
    }
    /// Takes back the last bytes, down to a size.
    void shrink(std::size_t size) { to_.resize(size); }

  private:
    std::vector<std::byte>& to_;
    bool compact_;
};

/// Reads bytes that may come from anybody. After the first fault every number is 0 and every count too.
class ByteReader {
  public:
    static constexpr bool is_reading = true;
    /// `at`: offset of the bytes in their file; `memory`: bytes that may be allocated for the contents.
    ByteReader(std::span<const std::byte> bytes, std::size_t at, std::uint64_t memory)
        : bytes_(bytes), begin_(at), memory_(memory) {}

    /// Version of the format in which the bytes are written.
    std::uint32_t version() const { return version_; }
    void set_version(std::uint32_t written) { version_ = written; }
    bool failed() const { return failed_; }
    const SnapshotError& error() const { return error_; }
    std::size_t left() const { return bytes_.size() - at_; }
    std::uint64_t memory() const { return memory_; }

    /// Name of the next field, for a message.
    void enter(std::string_view part, std::string_view field) { part_ = part, field_ = field; }
    void fail(std::string what) {
        if (failed_) return;
        failed_ = true;
        error_ = {begin_ + at_, std::move(what),
                  field_.empty() ? std::string(part_) : std::string(part_) + "." + std::string(field_)};
        at_ = bytes_.size();
    }

    std::span<const std::byte> rest() const { return bytes_.subspan(at_); }
    void skip(std::size_t count) { at_ += count; }
    void read(void* to, std::size_t count) {
        if (count > left()) {
            fail("ends early");
            std::memset(to, 0, count);
            return;
        }
        if (count > 0) std::memcpy(to, bytes_.data() + at_, count);
        at_ += count;
    }
    template <class T> T number() {
        T value{};
        read(&value, sizeof value);
        return value;
    }
    std::uint64_t count() {
        std::uint64_t value = 0;
        for (int shift = 0; shift < 64; shift += 7) {
            const auto digit = number<std::uint8_t>();
            value |= std::uint64_t(digit & 0x7F) << shift;
            if ((digit & 0x80) == 0) return failed_ ? 0 : value;
        }
        fail("a count has too many digits");
        return 0;
    }
    /// Takes memory for so many things from the budget; 0 of them where it is used up.
    std::size_t room_for(std::uint64_t things, std::size_t size_of_each) {
        if (failed_) return 0;
        if (things > memory_ / size_of_each) {
            fail("needs more memory than is allowed");
            return 0;
        }
        memory_ -= things * size_of_each;
        return std::size_t(things);
    }
    /// Number of things of at least a byte each in the file.
    std::size_t listed(std::size_t size_of_each) {
        const auto things = count();
        if (things > left()) fail("lists more than there is");
        return room_for(things, size_of_each);
    }

  private:
    std::span<const std::byte> bytes_;
    std::size_t begin_ = 0, at_ = 0;
    std::uint64_t memory_ = 0;
    std::uint32_t version_ = snapshot::version;
    bool failed_ = false;
    SnapshotError error_;
    std::string_view part_, field_;
};

} // namespace sinew::snapshot
