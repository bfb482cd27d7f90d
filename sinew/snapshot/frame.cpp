#include "sinew/snapshot/frame.h"

#include "sinew/math/hash.h"

namespace sinew {
namespace snapshot {
namespace {

constexpr std::string_view magic = "SINEWSNP";
constexpr std::size_t head_size = 16, header_size = head_size + parts * 16;

std::uint64_t checksum(std::span<const std::byte> head, std::span<const std::byte> part) {
    Hash hash;
    hash.add(head);
    hash.add(part);
    return hash.value();
}

std::nullopt_t refused(SnapshotError& error, std::size_t at, std::string what) {
    error = {at, std::move(what), {}};
    return std::nullopt;
}

constexpr std::array<std::string_view, parts> part_names = {"what never changes", "what moves", "the session"};

} // namespace

std::string SnapshotError::text() const {
    return "byte " + std::to_string(at) + (field.empty() ? "" : " (" + field + ")") + ": " + what;
}

std::vector<std::byte> framed(const SnapshotHeader& header, const std::array<std::span<const std::byte>, parts>& part) {
    std::vector<std::byte> bytes;
    bytes.reserve(header_size + part[0].size() + part[1].size() + part[2].size());
    ByteWriter writer(bytes);
    writer.append(magic.data(), magic.size());
    writer.number(version);
    for (const int number : {header.dimension, header.precision, int(header.content), 0})
        writer.number(std::uint8_t(number));
    const std::vector<std::byte> head(bytes.begin(), bytes.end());
    for (const auto& one : part) {
        writer.number(std::uint64_t(one.size()));
        writer.number(checksum(head, one));
    }
    for (const auto& one : part) writer.append(one.data(), one.size());
    return bytes;
}

std::optional<Frame> unframed(std::span<const std::byte> bytes, SnapshotError& error) {
    if (!is_snapshot(bytes)) return refused(error, 0, "not a snapshot of Sinew");
    if (bytes.size() < header_size) return refused(error, bytes.size(), "ends within the header");
    ByteReader reader(bytes.subspan(magic.size()), magic.size(), 0);
    const auto found = reader.number<std::uint32_t>();
    if (found < oldest_version || found > version)
        return refused(error, magic.size(),
                       "version " + std::to_string(found) + " of the format; this program reads versions " +
                           std::to_string(oldest_version) + " to " + std::to_string(version));
    const auto dimension = reader.number<std::uint8_t>(), precision = reader.number<std::uint8_t>(),
               content = reader.number<std::uint8_t>(), zero = reader.number<std::uint8_t>();
    const bool is_known = (dimension == 2 || dimension == 3) && (precision == 32 || precision == 64) &&
                          content <= std::uint8_t(SnapshotContent::session) && zero == 0;
    if (!is_known) return refused(error, head_size - 4, "a header of no known sort");
    Frame frame{found, {dimension, precision, SnapshotContent(content)}, {}, {}};
    std::size_t at = header_size;
    for (std::size_t i = 0; i < parts; ++i) {
        const auto length = reader.number<std::uint64_t>(), expected = reader.number<std::uint64_t>();
        if (length > bytes.size() - at)
            return refused(error, bytes.size(),
                           "ends within " + std::string(part_names[i]) + ", of " + std::to_string(length) + " bytes");
        frame.part[i] = bytes.subspan(at, std::size_t(length)), frame.at[i] = at;
        if (checksum(bytes.first(head_size), frame.part[i]) != expected)
            return refused(error, at, "damaged: the checksum of " + std::string(part_names[i]) + " differs");
        at += std::size_t(length);
    }
    if (at != bytes.size())
        return refused(error, at, std::to_string(bytes.size() - at) + " bytes too many behind the end");
    return frame;
}

} // namespace snapshot

bool is_snapshot(std::span<const std::byte> bytes) {
    return bytes.size() >= snapshot::magic.size() &&
           std::memcmp(bytes.data(), snapshot::magic.data(), snapshot::magic.size()) == 0;
}

std::optional<SnapshotHeader> snapshot_header(std::span<const std::byte> bytes, SnapshotError& error) {
    const auto frame = snapshot::unframed(bytes, error);
    return frame ? std::optional(frame->header) : std::nullopt;
}

} // namespace sinew
