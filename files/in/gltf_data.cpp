#include "files/in/gltf_data.h"

#include "sinew/scene/text.h"

#include "files/in/encoded.h"
#include "files/in/neighbor.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

namespace sinew::files {
namespace {

// glTF 2.0, "Binary glTF Layout": all numbers are little-endian.
constexpr std::uint32_t glb_magic = 0x46546C67, json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;
constexpr std::size_t glb_header = 12, chunk_header = 8;

template <class Number> Number little_endian(std::string_view bytes) {
    Number number{};
    std::array<char, sizeof(Number)> ordered{};
    std::copy_n(bytes.begin(), sizeof(Number), ordered.begin());
    if constexpr (std::endian::native == std::endian::big) std::ranges::reverse(ordered);
    std::memcpy(&number, ordered.data(), sizeof(Number));
    return number;
}

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
    return little_endian<std::uint32_t>(bytes.substr(at, 4));
}

struct GlbChunks {
    std::string json, binary;
};

GlbChunks chunks_of(std::string_view bytes) {
    if (const auto version = word_at(bytes, 4); version != 2)
        throw ImportError{"byte 4", concat("only version 2 of glTF is read, this is version ", version)};
    GlbChunks chunks;
    for (std::size_t at = glb_header; at + chunk_header <= bytes.size();) {
        const std::size_t size = word_at(bytes, at), type = word_at(bytes, at + 4);
        if (size > bytes.size() - at - chunk_header)
            throw ImportError{concat("byte ", at),
                              concat("a chunk of ", size, " bytes is longer than the rest of the file")};
        const auto content = bytes.substr(at + chunk_header, size);
        if (type == json_chunk && chunks.json.empty()) chunks.json = content;
        if (type == binary_chunk && chunks.binary.empty()) chunks.binary = content;
        at += chunk_header + size;
    }
    if (chunks.json.empty()) throw ImportError{concat("byte ", glb_header), "there is no JSON chunk in it"};
    return chunks;
}

struct ComponentType {
    std::size_t code, bytes;
    double (*read)(std::string_view);
    double largest; ///< of a normalized integer
};

template <class Number> double read_component(std::string_view bytes) {
    return double(little_endian<Number>(bytes));
}
constexpr std::array component_types = {
    ComponentType{5120, 1, read_component<std::int8_t>, 127},
    ComponentType{5121, 1, read_component<std::uint8_t>, 255},
    ComponentType{5122, 2, read_component<std::int16_t>, 32767},
    ComponentType{5123, 2, read_component<std::uint16_t>, 65535},
    ComponentType{5125, 4, read_component<std::uint32_t>, 1},
    ComponentType{5126, 4, read_component<float>, 1},
};

/// A relative address with its %20 and the like replaced (RFC 3986).
std::string from_uri(std::string_view uri) {
    std::string path;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        unsigned code = 0;
        const char* const digits = uri.data() + i + 1;
        const bool is_code =
            uri[i] == '%' && uri.size() - i > 2 && std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2;
        path += is_code ? char(code) : uri[i];
        i += is_code ? 2 : 0;
    }
    return path;
}

Affine3 turn_of(const std::vector<double>& q, const JsonNode& node) {
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    const double size = x * x + y * y + z * z + w * w;
    if (!(size > 1e-12)) node.fail("a rotation is a unit quaternion");
    const double s = 2 / size;
    return {{{1 - s * (y * y + z * z), s * (x * y + z * w), s * (x * z - y * w)}},
            {{s * (x * y - z * w), 1 - s * (x * x + z * z), s * (y * z + x * w)}},
            {{s * (x * z + y * w), s * (y * z - x * w), 1 - s * (x * x + y * y)}},
            {}};
}

} // namespace

bool is_glb(std::string_view bytes) {
    return bytes.size() >= glb_header && word_at(bytes, 0) == glb_magic;
}

GltfData::GltfData(const ImportFile& file) {
    auto chunks = is_glb(file.bytes) ? chunks_of(file.bytes) : GlbChunks{file.bytes, {}};
    // Chunks are padded with blanks, by some writers with zeros.
    while (!chunks.json.empty() && chunks.json.back() == '\0') chunks.json.pop_back();
    text_ = std::move(chunks.json);
    json_ = std::make_unique<JsonFile>(file.name, text_);
    root_ = std::make_unique<JsonNode>(*json_);
    if (const auto version = (*root_)["asset"]["version"]; version.exists() && !version.text().starts_with("2"))
        version.fail("only version 2 of glTF is read");
    read_buffers(file, std::move(chunks.binary));
}

void GltfData::read_buffers(const ImportFile& file, std::string binary) {
    const auto list = root()["buffers"];
    constexpr std::size_t most_buffers = 64;
    if (list.size() > most_buffers) list.fail(concat("at most ", most_buffers, " buffers are read"));
    std::size_t total = 0;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const auto uri = list[i]["uri"];
        buffers_.push_back(uri.exists() ? buffer_bytes(file, uri) : i == 0 ? std::move(binary) : std::string());
        total += buffers_.back().size();
        if (total > 4 * ImportLimits::bytes) list.fail("the buffers are too large");
        const auto size = list[i]["byteLength"].index();
        if (buffers_.back().size() < size)
            list[i].fail(
                concat("the buffer has ", buffers_.back().size(), " bytes, less than its byteLength of ", size));
    }
}

std::string GltfData::buffer_bytes(const ImportFile& file, const JsonNode& uri) const {
    const auto text = uri.text();
    if (!text.starts_with("data:")) return bytes_beside(file, from_uri(text), uri.place());
    const auto comma = text.find(";base64,");
    const auto bytes = comma == text.npos ? std::nullopt : from_base64(std::string_view(text).substr(comma + 8));
    if (!bytes) uri.fail("a buffer within the file is data:...;base64,...");
    return *bytes;
}

std::vector<double> GltfData::numbers(const JsonNode& accessor_index, std::string_view type,
                                      std::size_t components) const {
    const auto number = accessor_index.index();
    const auto accessor = root()["accessors"][number];
    if (!accessor.object()) accessor_index.fail(concat("there is no accessor ", number));
    if (accessor["sparse"].exists()) accessor["sparse"].fail("sparse accessors are not read");
    if (const auto found = accessor["type"].text(); found != type)
        accessor["type"].fail(concat("expected ", type, " here, found ", printable(found)));
    const auto count = accessor["count"].index(8 * ImportLimits::points);
    const auto code = accessor["componentType"].index();
    const auto component = std::ranges::find(component_types, code, &ComponentType::code);
    if (component == component_types.end())
        accessor["componentType"].fail("expected 5120, 5121, 5122, 5123, 5125 or 5126");
    if (!accessor["bufferView"].exists()) return std::vector<double>(count * components);

    const auto view_number = accessor["bufferView"].index();
    const auto view = root()["bufferViews"][view_number];
    if (!view.object()) accessor["bufferView"].fail(concat("there is no bufferView ", view_number));
    const auto buffer = view["buffer"].index();
    if (buffer >= buffers_.size()) view["buffer"].fail(concat("there is no buffer ", buffer));
    const auto offset_or_0 = [](const JsonNode& node) { return node.exists() ? node.index() : 0; };
    const auto begin = offset_or_0(view["byteOffset"]), size = view["byteLength"].index();
    if (begin > buffers_[buffer].size() || size > buffers_[buffer].size() - begin)
        view.fail(concat("it reaches from byte ", begin, " on for ", size, " bytes, and the buffer has ",
                         buffers_[buffer].size()));
    const auto bytes = std::string_view(buffers_[buffer]).substr(begin, size);
    const auto item = component->bytes * components;
    const auto stride = view["byteStride"].exists() ? view["byteStride"].index(252) : item;
    const auto first = offset_or_0(accessor["byteOffset"]);
    if (count > 0 &&
        (stride < item || first > size || size - first < item || (size - first - item) / stride < count - 1))
        accessor.fail(
            concat(count, " items from byte ", first, " on do not fit into the ", size, " bytes of its bufferView"));

    std::vector<double> result;
    result.reserve(count * components);
    const bool is_share = accessor["normalized"].truth_or(false);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < components; ++k) {
            const double value = component->read(bytes.substr(first + i * stride + k * component->bytes));
            result.push_back(is_share ? std::max(value / component->largest, -1.0) : value);
        }
    return result;
}

std::vector<std::uint32_t> GltfData::indices(const JsonNode& accessor_index, std::size_t max) const {
    std::vector<std::uint32_t> result;
    for (const double number : numbers(accessor_index, "SCALAR", 1)) {
        if (!(number >= 0 && number < double(max)) || number != std::floor(number))
            accessor_index.fail(concat("an index is beyond the ", max, " points of the mesh"));
        result.push_back(std::uint32_t(number));
    }
    return result;
}

Affine3 GltfData::matrix_of(const JsonNode& node) {
    if (const auto matrix = node["matrix"]; matrix.exists()) {
        const auto m = matrix.numbers(16);
        return {{{m[0], m[1], m[2]}}, {{m[4], m[5], m[6]}}, {{m[8], m[9], m[10]}}, {{m[12], m[13], m[14]}}};
    }
    Affine3 map;
    if (const auto rotation = node["rotation"]; rotation.exists()) map = turn_of(rotation.numbers(4), rotation);
    if (const auto scale = node["scale"]; scale.exists()) {
        const auto s = scale.numbers(3);
        map.x = map.x * s[0], map.y = map.y * s[1], map.z = map.z * s[2];
    }
    if (const auto translation = node["translation"]; translation.exists()) {
        const auto t = translation.numbers(3);
        map.origin = {{t[0], t[1], t[2]}};
    }
    return map;
}

} // namespace sinew::files
