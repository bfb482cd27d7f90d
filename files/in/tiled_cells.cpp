#include "files/in/tiled_cells.h"

#include "sinew/scene/text.h"

#include "files/in/encoded.h"
#include "files/in/inflate.h"

#include <algorithm>
#include <tuple>

namespace sinew::files {
namespace {

std::string cell_bytes(const JsonNode& data, const std::string& compression, std::size_t size) {
    auto bytes = from_base64(data.text());
    if (!bytes) data.fail("this is not base64");
    if (compression == "zlib" || compression == "gzip") {
        auto read = inflate(*bytes, size);
        if (!read.problem.empty()) data.fail(concat("the data of the layer is damaged: ", read.problem));
        bytes = std::move(read.bytes);
    } else if (!compression.empty()) {
        data.fail(concat("layers compressed by ", printable(compression),
                         " cannot be read: choose zlib, gzip or CSV in the map's properties"));
    }
    if (bytes->size() != size)
        data.fail(concat("the data of the layer is damaged: expected ", size, " bytes, found ", bytes->size()));
    return *bytes;
}

} // namespace

void merge_boxes(std::vector<TileBox>& boxes, int axis) {
    const int other = 1 - axis;
    std::ranges::stable_sort(boxes, {},
                             [&](const TileBox& b) { return std::tuple(b.low[other], b.high[other], b.low[axis]); });
    std::vector<TileBox> merged;
    constexpr double little = 1e-6; // pixels
    for (auto& box : boxes) {
        const bool joins = !merged.empty() && merged.back().low[other] == box.low[other] &&
                           merged.back().high[other] == box.high[other] &&
                           absolute(merged.back().high[axis] - box.low[axis]) < little;
        if (joins)
            merged.back().high[axis] = box.high[axis];
        else
            merged.push_back(std::move(box));
    }
    boxes = std::move(merged);
}

std::vector<std::uint32_t> packed_cells(const JsonNode& data, const std::string& compression, std::size_t count) {
    const auto bytes = cell_bytes(data, compression, 4 * count);
    std::vector<std::uint32_t> cells;
    for (std::size_t i = 0; i < count; ++i) {
        std::uint32_t cell = 0;
        for (std::size_t k = 0; k < 4; ++k) cell |= std::uint32_t(std::uint8_t(bytes[4 * i + k])) << (8 * k);
        cells.push_back(cell);
    }
    return cells;
}

} // namespace sinew::files
