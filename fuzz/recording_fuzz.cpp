#include "sinew/scene/document.h"

#include "player/recording.h"
#include "player/recording_format.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <random>

/// Changes some of the bytes in place, which may then be more or fewer; of libFuzzer.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

using namespace sinew;
using play::format::Type;
using Bytes = std::vector<std::byte>;

/// An entry of a recording without its length and checksums.
struct Entry {
    Type type = Type::step;
    Bytes content; ///< of short positions with their count
};

/// Bytes of an entry's content; fails with `reader`.
std::size_t content_size(snapshot::ByteReader& reader, Type type) {
    if (type == Type::step) return sizeof(std::uint32_t);
    if (!play::format::is_short(type)) {
        const auto size = std::size_t(reader.count());
        reader.number<std::uint16_t>();
        return size;
    }
    return 0; // a position: its count is read with it
}

/// The entries of a recording up to the first that is not whole.
std::vector<Entry> entries_of(std::span<const std::byte> bytes) {
    std::vector<Entry> entries;
    std::int64_t memory = 1 << 24;
    snapshot::ByteReader reader(bytes.subspan(play::format::head_size), 0, memory);
    while (reader.left() > 0) {
        Entry entry{.type = Type(reader.number<std::uint8_t>()), .content = {}};
        auto size = content_size(reader, entry.type);
        if (entry.type == Type::drag || entry.type == Type::point) {
            const auto count = reader.number<std::uint8_t>();
            entry.content.push_back(std::byte(count));
            size = 8U * count;
        }
        if (reader.failed() || size > reader.left()) break;
        const auto before = entry.content.size();
        entry.content.resize(before + size);
        reader.read(entry.content.data() + before, size);
        std::uint32_t checksum = 0;
        reader.read(&checksum, std::min(play::format::checksum_size(entry.type), reader.left()));
        entries.push_back(std::move(entry));
    }
    return entries;
}

/// A recording of these entries, with lengths and checksums as they ought to be.
Bytes recording_of(std::span<const Entry> entries) {
    Bytes bytes;
    snapshot::ByteWriter head(bytes);
    head.append(play::format::magic.data(), play::format::magic.size());
    head.number(play::format::version);
    std::uint64_t chain = 0;
    for (const auto& entry : entries) {
        Bytes frame;
        snapshot::ByteWriter writer(frame);
        writer.number(entry.type);
        if (!play::format::is_short(entry.type)) {
            writer.count(entry.content.size());
            writer.number(play::format::head_checksum(chain, frame));
        }
        writer.append(entry.content.data(), entry.content.size());
        chain = play::format::chained(chain, frame);
        bytes.insert(bytes.end(), frame.begin(), frame.end());
        const auto* sum = reinterpret_cast<const std::byte*>(&chain);
        bytes.insert(bytes.end(), sum, sum + play::format::checksum_size(entry.type));
    }
    return bytes;
}

/// Changes the content of one entry, its type, or its place among the others.
void change(std::vector<Entry>& entries, std::minstd_rand& random) {
    const auto one = entries.begin() + std::ptrdiff_t(random() % entries.size());
    const auto other = entries.begin() + std::ptrdiff_t(random() % entries.size());
    switch (random() % 8) {
    case 0:
        std::iter_swap(one, other);
        return;
    case 1:
        entries.insert(other, Entry(*one));
        return;
    case 2:
        entries.erase(one);
        return;
    case 3:
        one->type = Type(random() % play::format::types);
        return;
    default:
        break;
    }
    constexpr std::size_t growth = 64;
    const auto size = one->content.size();
    one->content.resize(size + growth);
    auto* data = reinterpret_cast<std::uint8_t*>(one->content.data());
    one->content.resize(LLVMFuzzerMutate(data, size, one->content.size()));
}

/// Small scenes only: a fuzzer's seconds are for readers.
std::optional<Opened> opened(const std::string& text, const std::string&) {
    auto document = load(text, "fuzz.json");
    if (document.limits.particles > 2000) document.limits.particles = 2000;
    return open_scene(document);
}

} // namespace

/// Mostly changes entries, and mends lengths and checksums: else no input would get past them.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
    std::minstd_rand random(seed);
    const auto bytes = std::as_bytes(std::span(data, size));
    if (size <= play::format::head_size || random() % 16 == 0) return LLVMFuzzerMutate(data, size, max_size);
    auto entries = entries_of(bytes);
    if (entries.empty()) return LLVMFuzzerMutate(data, size, max_size);
    change(entries, random);
    const auto changed = recording_of(entries);
    if (changed.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
    std::memcpy(data, changed.data(), changed.size());
    return changed.size();
}

/// Any bytes are read as a recording, whole or up to where they end, and played; or refused.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto bytes = std::as_bytes(std::span(data, size));
    SnapshotError error;
    auto recording = play::read_recording(bytes, opened, error);
    if (!recording) {
        if (error.at > size || error.what.empty()) std::abort();
        return 0;
    }
    auto replay = play::Replay::begin(std::move(*recording), opened, error);
    for (int i = 0; replay && i < 20 && replay->step(); ++i) {
    }
    return 0;
}
