#include "files/in/formats.h"
#include "files/in/neighbor.h"
#include "files/in/tiled_cells.h"
#include "files/in/tiled_objects.h"

#include <algorithm>

namespace sinew::files {
namespace {

// Flags of a cell (Tiled's "Global Tile IDs").
constexpr std::uint32_t mirrored_across = 0x80000000, mirrored_down = 0x40000000, swapped_axes = 0x20000000,
                        number_mask = 0x0fffffff;
constexpr std::size_t most_cells = 1'000'000;

class TiledReader {
  public:
    TiledReader(const ImportFile& file, const ImportOptions& options)
        : file_(file), json_(file.name, file.bytes), root_(json_), scale_(options.scale.value_or(1)),
          usual_(role_called(options.role)), error_(options.error.value_or(usual_error)) {}

    Imported read() {
        if (const auto form = root_["orientation"].text_or("orthogonal"); form != "orthogonal")
            root_["orientation"].fail(concat("only orthogonal maps are imported, this one is ", printable(form)));
        tile_ = {{positive("tilewidth"), positive("tileheight")}};
        for (std::size_t i = 0; i < root_["tilesets"].size(); ++i) add_tileset(root_["tilesets"][i]);
        std::ranges::sort(tilesets_, std::greater(), &Tileset::first);
        find_extent(root_["layers"], 0);
        Drawing drawing((high_ - low_) * scale_, error_);
        drawing_ = &drawing;
        if (root_["backgroundcolor"].exists())
            drawing.notes().add(root_["backgroundcolor"].place(), "its backgroundcolor is not taken");
        note_properties(root_);
        read_layers(root_["layers"], scaled_by(scale_, scale_) * moved_by(-low_), "", 0);
        for (const int axis : {0, 1}) merge_boxes(boxes_, axis);
        for (const auto& box : boxes_) add_box(box);
        return drawing.finish(concat("Imported from ", file_.name));
    }

  private:
    static constexpr double usual_error = 0.5; // pixels
    const ImportFile& file_;
    JsonFile json_;
    JsonNode root_;
    double scale_;
    std::optional<Role> usual_;
    double error_;
    Vec2<double> tile_{}, low_{}, high_{};
    std::vector<Tileset> tilesets_; ///< the last first
    std::vector<TileBox> boxes_;
    Drawing* drawing_ = nullptr;
    bool is_empty_ = true; ///< nothing has been included
    std::size_t cells_ = 0;

    double positive(std::string_view key) {
        const double number = root_[key].number();
        constexpr double most = 10'000;
        if (!(number >= 1 && number <= most))
            root_[key].fail(format_text("expected a size from 1 to {:6} pixels", most));
        return number;
    }

    void add_tileset(const JsonNode& node) {
        auto tileset = node["source"].exists() ? tileset_beside(node["source"]) : tileset_of(node);
        tileset.first = node["firstgid"].index();
        tilesets_.push_back(std::move(tileset));
    }
    Tileset tileset_beside(const JsonNode& source) const {
        const auto name = source.text();
        return tileset_in(name, bytes_beside(file_, name, source.place()));
    }

    /// Extent of the map, pixels; that of an infinite one is that of its chunks.
    void find_extent(const JsonNode& layers, std::size_t depth) {
        const Vec2<double> whole{
            {tile_[0] * double(root_["width"].index(100'000)), tile_[1] * double(root_["height"].index(100'000))}};
        const bool is_infinite = root_["infinite"].truth_or(false);
        if (depth == 0 && !is_infinite) include({}), include(whole);
        if (depth > ImportLimits::depth) layers.fail(concat("groups nest more than ", ImportLimits::depth, " deep"));
        for (std::size_t i = 0; i < layers.size(); ++i) {
            find_extent(layers[i]["layers"], depth + 1);
            const auto chunks = layers[i]["chunks"];
            for (std::size_t k = 0; k < chunks.size(); ++k) include_chunk(chunks[k]);
        }
        constexpr double most = 1e6;
        if (depth == 0 && !(high_[0] - low_[0] > 0 && high_[1] - low_[1] > 0 && high_[0] - low_[0] <= most &&
                            high_[1] - low_[1] <= most))
            root_.fail("the map has no size, or more than a million pixels");
    }

    void include(const Vec2<double>& point) {
        if (is_empty_) low_ = high_ = point;
        is_empty_ = false;
        for (int i = 0; i < 2; ++i) low_[i] = std::min(low_[i], point[i]), high_[i] = std::max(high_[i], point[i]);
    }
    void include_chunk(const JsonNode& chunk) {
        const double x = chunk["x"].number(), y = chunk["y"].number();
        include({{x * tile_[0], y * tile_[1]}});
        include({{(x + double(chunk["width"].index(10'000))) * tile_[0],
                  (y + double(chunk["height"].index(10'000))) * tile_[1]}});
    }

    void read_layers(const JsonNode& layers, const Affine& outer, const std::string& above, std::size_t depth) {
        if (depth > ImportLimits::depth) layers.fail(concat("groups nest more than ", ImportLimits::depth, " deep"));
        for (std::size_t i = 0; i < layers.size(); ++i) {
            const auto layer = layers[i];
            const auto type = layer["type"].text_or("");
            const auto names = concat(layer["class"].text_or(""), " ", layer["name"].text_or(""), " ", above);
            note_looks(layer);
            const auto map = outer * moved_by({{layer["offsetx"].number_or(0), layer["offsety"].number_or(0)}});
            if (type == "group")
                read_layers(layer["layers"], map, names, depth + 1);
            else if (type == "objectgroup")
                read_objects(layer, map, names);
            else if (type == "tilelayer")
                read_tiles(layer, map, names);
            else
                drawing_->notes().count(layer.place(), concat("a layer of type ", in_quotes(type), " is not taken"));
        }
    }

    /// Looks of a layer that a scene has not.
    void note_looks(const JsonNode& layer) {
        for (const auto* const key : {"opacity", "parallaxx", "parallaxy"})
            if (layer[key].number_or(1) != 1)
                drawing_->notes().count(layer[key].place(), concat("its ", key, " is not taken"));
        if (layer["tintcolor"].exists())
            drawing_->notes().count(layer["tintcolor"].place(), "its tintcolor is not taken");
        note_properties(layer);
    }
    void note_properties(const JsonNode& node) {
        const auto properties = node["properties"];
        for (std::size_t i = 0; i < properties.size(); ++i)
            if (const auto name = properties[i]["name"].text_or(""); name != "sensor")
                drawing_->notes().count(properties[i].place(), "properties of one's own are not taken");
    }

    void read_objects(const JsonNode& layer, const Affine& map, const std::string& names) {
        const auto objects = layer["objects"];
        for (std::size_t i = 0; i < objects.size(); ++i) {
            if (objects[i]["template"].exists()) {
                drawing_->notes().count(objects[i].place(), "objects of templates are not taken: detach them in Tiled");
                continue;
            }
            const auto object = tiled_object(objects[i]);
            note_properties(objects[i]);
            auto shape = object.kind == TiledObject::Kind::text || object.kind == TiledObject::Kind::point
                             ? std::nullopt
                             : drawn_shape(object, map);
            if (!shape) {
                drawing_->notes().count(object.place, "points, texts and objects without an extent are not taken");
                continue;
            }
            const bool is_tile = object.kind == TiledObject::Kind::tile;
            if (is_tile) drawing_->notes().count(object.place, "pictures of tiles are not taken");
            const auto named = role_in(concat(object.type, " ", object.name));
            const auto role = named ? named : role_in(names);
            shape->role = object.is_sensor ? Role::collider
                                           : role.value_or(usual_.value_or(is_tile ? Role::solid : Role::collider));
            set_looks(*shape, layer);
            drawing_->add(*shape);
        }
    }

    static void set_looks(DrawnShape& shape, const JsonNode& layer) {
        if (shape.role == Role::collider) return;
        auto color = layer["color"].text_or("#c08552");
        if (color.size() == 9) color = "#" + color.substr(3) + color.substr(1, 2); // #AARRGGBB
        const bool is_color = (color.size() == 7 || color.size() == 9) &&
                              color.find_first_not_of("0123456789abcdefABCDEF", 1) == color.npos;
        shape.fill = is_color && color[0] == '#' ? color : "#c08552";
        shape.stroke = shape.role == Role::rope ? shape.fill : "none";
        constexpr double rope_width = 3; // pixels
        if (shape.role == Role::rope) shape.stroke_width = rope_width;
    }

    void read_tiles(const JsonNode& layer, const Affine& map, const std::string& names) {
        const auto role = role_in(names);
        if (role == Role::none) return drawing_->notes().count(layer.place(), "left out, as its name says");
        const bool is_solid = role == Role::collider;
        std::size_t bare = 0;
        bool has_shapes = false;
        const auto place_cells = [&](const JsonNode& part, double column, double row) {
            const auto width = part["width"].index(100'000), height = part["height"].index(100'000);
            const auto cells = cells_of(part["data"], layer, width * height);
            for (std::size_t i = 0; i < cells.size(); ++i)
                if ((cells[i] & number_mask) != 0) {
                    const Vec2<double> corner{
                        {(column + double(i % width)) * tile_[0], (row + double(i / width)) * tile_[1]}};
                    const bool has_shape = add_cell(cells[i], map * moved_by(corner), is_solid, layer.place());
                    has_shapes |= has_shape;
                    bare += has_shape ? 0 : 1;
                }
        };
        const auto chunks = layer["chunks"];
        if (!chunks.exists()) place_cells(layer, 0, 0);
        for (std::size_t k = 0; k < chunks.size(); ++k)
            place_cells(chunks[k], chunks[k]["x"].number(), chunks[k]["y"].number());
        if (has_shapes) drawing_->notes().count(layer.place(), "pictures of tiles are not taken");
        if (bare > 0)
            drawing_->notes().add(
                layer.place(),
                format_text("{} tiles of the layer {} have no collision shape, and are not taken; a layer "
                            "with ground, wall or collider in its name is solid",
                            bare, in_quotes(layer["name"].text_or(""))));
    }

    /// Cells of a layer or a chunk: numbers, or base64 of them, compressed or not.
    std::vector<std::uint32_t> cells_of(const JsonNode& data, const JsonNode& layer, std::size_t count) {
        if ((cells_ += count) > most_cells) data.fail(concat("the map has more than ", most_cells, " cells"));
        std::vector<std::uint32_t> cells;
        if (data.exists() && data.value()->as<std::string>()) {
            return packed_cells(data, layer["compression"].text_or(""), count);
        }
        if (data.size() != count) data.fail(concat("expected ", count, " cells, found ", data.size()));
        for (std::size_t i = 0; i < count; ++i) cells.push_back(std::uint32_t(data[i].index()));
        return cells;
    }

    /// Adds the shapes of a cell; false for a cell without any.
    bool add_cell(std::uint32_t cell, const Affine& map, bool is_solid, const std::string& place) {
        const auto number = cell & number_mask;
        const auto tileset = std::ranges::find_if(tilesets_, [&](const Tileset& t) { return t.first <= number; });
        const auto* const shapes = tileset == tilesets_.end() ? nullptr : shapes_of(*tileset, number - tileset->first);
        if (!shapes && !is_solid) return false;
        if (!shapes) {
            TiledObject whole;
            whole.place = place, whole.name = "tile", whole.size = tile_;
            add_tile_shape(whole, map);
            return true;
        }
        for (auto object : *shapes) {
            object.name = "tile";
            add_tile_shape(object, map * flipped(cell, tileset->tile));
        }
        return true;
    }
    static const std::vector<TiledObject>* shapes_of(const Tileset& tileset, std::size_t number) {
        const auto found = tileset.shapes.find(number);
        return found == tileset.shapes.end() ? nullptr : &found->second;
    }

    /// Map of a cell's flags; tiles larger than the map's stand on the lower edge of their cell.
    Affine flipped(std::uint32_t cell, const Vec2<double>& size) const {
        Affine map;
        auto shown = size;
        if ((cell & swapped_axes) != 0) map = {{{0, 1}}, {{1, 0}}, {}}, std::swap(shown[0], shown[1]);
        if ((cell & mirrored_across) != 0) map = moved_by({{shown[0], 0}}) * scaled_by(-1, 1) * map;
        if ((cell & mirrored_down) != 0) map = moved_by({{0, shown[1]}}) * scaled_by(1, -1) * map;
        return moved_by({{0, tile_[1] - shown[1]}}) * map;
    }

    void add_tile_shape(const TiledObject& object, const Affine& map) {
        auto shape = drawn_shape(object, map);
        if (!shape)
            return drawing_->notes().count(object.place, "points, texts and objects without an extent are not taken");
        shape->role = Role::collider;
        if (shape->box && object.rotation == 0 && !object.is_sensor) {
            auto size = *shape->box;
            if (map.across[0] == 0) std::swap(size[0], size[1]);
            return boxes_.push_back(
                {snapped(shape->middle - size * 0.5), snapped(shape->middle + size * 0.5), object.place});
        }
        drawing_->add(*shape);
    }
    /// On a grid of 1/1024 pixel, so that neighbours share their corners exactly.
    static Vec2<double> snapped(const Vec2<double>& p) {
        constexpr double grid = 1024;
        return {{std::round(p[0] * grid) / grid, std::round(p[1] * grid) / grid}};
    }

    void add_box(const TileBox& box) {
        DrawnShape shape;
        shape.name = "tiles";
        shape.place = box.place;
        shape.role = Role::collider;
        shape.box = box.high - box.low;
        shape.middle = (box.low + box.high) * 0.5;
        drawing_->add(shape);
    }
};

bool has_tile_layers(std::string_view bytes) {
    const auto begin = bytes.find_first_not_of(" \t\r\n");
    return begin != bytes.npos && bytes[begin] == '{' && bytes.find("\"tilewidth\"") != bytes.npos &&
           bytes.find("\"layers\"") != bytes.npos;
}

} // namespace

const ImportFormat reader::tiled{
    "Tiled", "tmj", "a map: objects and collision shapes of tiles as colliders and figures", has_tile_layers,
    [](const ImportFile& file, const ImportOptions& options) { return TiledReader(file, options).read(); }};

} // namespace sinew::files
