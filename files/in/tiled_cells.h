#pragma once

#include "sinew/math/vec.h"

#include "files/in/json_file.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sinew::files {

/// An upright rectangle.
struct TileBox {
    Vec2<double> low{}, high{};
    std::string place;
};

/// Boxes that meet along a whole side become one: what slides over them meets no corners between.
void merge_boxes(std::vector<TileBox>& boxes, int axis);

/// Cells of a layer as base64, compressed by zlib or gzip or not at all. Throws ImportError.
std::vector<std::uint32_t> packed_cells(const JsonNode& data, const std::string& compression, std::size_t count);

} // namespace sinew::files
