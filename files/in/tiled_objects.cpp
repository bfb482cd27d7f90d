#include "files/in/tiled_objects.h"

#include "files/in/svg_values.h"
#include "files/in/xml.h"

#include <algorithm>

namespace sinew::files {
namespace {

constexpr std::size_t most_object_points = 2000;
constexpr double furthest_in_map = 1e6;

bool is_sensor_word(std::string_view type) {
    return type == "sensor" || type == "trigger" || type == "Sensor" || type == "Trigger";
}

Outline json_points(const JsonNode& list) {
    if (list.size() < 2 || list.size() > most_object_points)
        list.fail(concat("a polygon has 2 to ", most_object_points, " points, found ", list.size()));
    Outline points;
    for (std::size_t i = 0; i < list.size(); ++i) points.push_back({{list[i]["x"].number(), list[i]["y"].number()}});
    return points;
}

/// Tilesets of XML: their collision shapes.
class TsxReader {
  public:
    TsxReader(const std::string& name, std::string text) : name_(name), document_(std::move(text)) {}

    Tileset read() {
        const auto& root = document_.root();
        if (root.name != "tileset") fail(root, "expected <tileset>");
        Tileset tileset;
        tileset.tile = {{number(root, "tilewidth"), number(root, "tileheight")}};
        for (const auto& tile : root.children) {
            const auto* const group = tile.name == "tile" ? tile.child("objectgroup") : nullptr;
            if (!group) continue;
            const double id = number(tile, "id");
            if (!(id >= 0)) fail(tile, "its id is not negative");
            auto& shapes = tileset.shapes[std::size_t(id)];
            for (const auto& object : group->children)
                if (object.name == "object") shapes.push_back(object_of(object));
        }
        return tileset;
    }

  private:
    const std::string& name_;
    XmlDocument document_;

    [[noreturn]] void fail(const XmlElement& element, const std::string& message) const {
        throw ImportError{document_.place_of(element), message};
    }
    double number(const XmlElement& element, std::string_view name) const {
        const auto text = element.value(name);
        if (text.empty()) return 0;
        const auto found = svg_value::numbers(text);
        if (!found || found->size() != 1 || !(absolute((*found)[0]) <= furthest_in_map))
            fail(element, concat("its ", name, " is a number up to a million, found ", in_quotes(text)));
        return (*found)[0];
    }

    TiledObject object_of(const XmlElement& element) const {
        using Kind = TiledObject::Kind;
        TiledObject object;
        object.place = concat(name_, ":", document_.place_of(element));
        object.name = element.value("name");
        object.type = element.value(element.has("class") ? "class" : "type");
        object.at = {{number(element, "x"), number(element, "y")}};
        object.size = {{number(element, "width"), number(element, "height")}};
        object.rotation = number(element, "rotation");
        object.is_sensor = is_sensor_word(object.type);
        if (element.child("ellipse")) object.kind = Kind::ellipse;
        if (element.child("point")) object.kind = Kind::point;
        if (element.child("text")) object.kind = Kind::text;
        for (const auto* const name : {"polygon", "polyline"})
            if (const auto* const line = element.child(name)) {
                object.kind = name == std::string_view("polygon") ? Kind::polygon : Kind::polyline;
                object.points = points_of(*line);
            }
        return object;
    }

    Outline points_of(const XmlElement& element) const {
        const auto numbers = svg_value::numbers(element.value("points"));
        if (!numbers || numbers->size() % 2 != 0) fail(element, "its points are pairs of numbers, found others");
        const auto count = numbers->size() / 2;
        if (count < 2 || count > most_object_points)
            fail(element, concat("a polygon has 2 to ", most_object_points, " points, found ", count));
        Outline points;
        for (std::size_t i = 0; i < count; ++i) points.push_back({{(*numbers)[2 * i], (*numbers)[2 * i + 1]}});
        return points;
    }
};

} // namespace

TiledObject tiled_object(const JsonNode& node) {
    using Kind = TiledObject::Kind;
    if (!node.object()) node.fail("expected an object of a layer");
    TiledObject object;
    object.place = node.place();
    object.name = node["name"].text_or("");
    object.type = node["class"].exists() ? node["class"].text() : node["type"].text_or("");
    const auto number = [&](std::string_view key) {
        const double value = node[key].number_or(0);
        if (!(absolute(value) <= furthest_in_map)) node[key].fail("a coordinate is at most a million pixels");
        return value;
    };
    object.at = {{number("x"), number("y")}};
    object.size = {{number("width"), number("height")}};
    object.rotation = number("rotation");
    object.is_sensor = is_sensor_word(object.type);
    for (std::size_t i = 0; i < node["properties"].size(); ++i)
        if (const auto property = node["properties"][i]; property["name"].text_or("") == "sensor")
            object.is_sensor = property["value"].truth_or(false);
    if (node["ellipse"].truth_or(false)) object.kind = Kind::ellipse;
    if (node["point"].truth_or(false)) object.kind = Kind::point;
    if (node["text"].exists()) object.kind = Kind::text;
    if (node["gid"].exists()) object.kind = Kind::tile;
    if (node["polygon"].exists()) object.kind = Kind::polygon, object.points = json_points(node["polygon"]);
    if (node["polyline"].exists()) object.kind = Kind::polyline, object.points = json_points(node["polyline"]);
    return object;
}

Tileset tileset_of(const JsonNode& node) {
    Tileset tileset;
    tileset.tile = {{node["tilewidth"].number_or(0), node["tileheight"].number_or(0)}};
    const auto tiles = node["tiles"];
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const auto objects = tiles[i]["objectgroup"]["objects"];
        if (objects.size() == 0) continue;
        auto& shapes = tileset.shapes[tiles[i]["id"].index()];
        for (std::size_t k = 0; k < objects.size(); ++k) shapes.push_back(tiled_object(objects[k]));
    }
    return tileset;
}

Tileset tileset_in(const std::string& name, std::string text) {
    const auto begin = text.find_first_not_of(" \t\r\n\xef\xbb\xbf");
    try {
        if (begin != text.npos && text[begin] == '<') return TsxReader(name, std::move(text)).read();
        const JsonFile file(name, std::move(text));
        auto tileset = tileset_of(file);
        for (auto& [tile, shapes] : tileset.shapes)
            for (auto& shape : shapes) shape.place = concat(name, ":", shape.place);
        return tileset;
    } catch (ImportError& error) {
        error.place = concat(name, ":", error.place);
        throw;
    }
}

std::optional<DrawnShape> drawn_shape(const TiledObject& object, const Affine& map) {
    using Kind = TiledObject::Kind;
    const auto whole = map * moved_by(object.at) * turned_by(object.rotation);
    const auto [w, h] = std::pair(object.size[0], object.size[1]);
    DrawnShape shape;
    shape.name = object.name;
    shape.place = object.place;
    shape.is_sensor = object.is_sensor;
    DrawnLine line{object.points, object.kind != Kind::polyline};
    const bool is_box = object.kind == Kind::rectangle || object.kind == Kind::tile;
    // A tile object stands on its position.
    const Vec2<double> corner{{0, object.kind == Kind::tile ? -h : 0}};
    if (is_box)
        line.points = {corner, corner + Vec2<double>{{w, 0}}, corner + object.size, corner + Vec2<double>{{0, h}}};
    if (object.kind == Kind::ellipse) {
        constexpr int corners = 48; // chords are 1/460 of the radius off
        for (int i = 0; i < corners; ++i) {
            const double angle = 2 * pi<double> * i / corners;
            line.points.push_back({{w / 2 * (1 + std::cos(angle)), h / 2 * (1 + std::sin(angle))}});
        }
    }
    if (line.points.size() < 2 || ((is_box || object.kind == Kind::ellipse) && !(w > 0 && h > 0))) return std::nullopt;
    for (auto& p : line.points) p = whole(p);
    shape.lines.push_back(std::move(line));
    const double scale = whole.similarity();
    if (scale > 0 && is_box)
        shape.box = object.size * scale, shape.middle = whole(corner + object.size * 0.5), shape.turn = whole.turn();
    if (scale > 0 && object.kind == Kind::ellipse && w == h)
        shape.circle = w / 2 * scale, shape.middle = whole(object.size * 0.5);
    return shape;
}

} // namespace sinew::files
