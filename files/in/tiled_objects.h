#pragma once

#include "files/in/affine.h"
#include "files/in/drawing.h"
#include "files/in/json_file.h"

#include <map>

namespace sinew::files {

/// A shape of an object layer or of a tile (Tiled's JSON format, "Object").
struct TiledObject {
    enum class Kind { rectangle, ellipse, point, polygon, polyline, text, tile };
    Kind kind = Kind::rectangle;
    std::string place, name, type;
    Vec2<double> at{}, size{};
    double rotation = 0; ///< degrees, clockwise
    Outline points{};    ///< from `at`
    bool is_sensor = false;
};

TiledObject tiled_object(const JsonNode& node);

/// Collision shapes of the tiles of a tileset, by the tile's number in it.
struct Tileset {
    std::size_t first = 1; ///< number of its first tile in the map
    Vec2<double> tile{};
    std::map<std::size_t, std::vector<TiledObject>> shapes;
};

Tileset tileset_of(const JsonNode& node);
/// A tileset of a file: .tsj (JSON) or .tsx (XML). Throws ImportError.
Tileset tileset_in(const std::string& name, std::string text);

/// The shape of an object under a map. Empty for what has no extent.
std::optional<DrawnShape> drawn_shape(const TiledObject& object, const Affine& map);

} // namespace sinew::files
