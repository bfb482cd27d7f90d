#include "player/reshape.h"

#include "sinew/math/trig.h"
#include "sinew/scene/check.h"
#include "sinew/scene/parameters.h"

#include "player/grow.h"
#include "player/names.h"
#include "player/scene_edit.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sinew::play {
namespace {

using json::Array;
using json::Object;
using json::Value;

Point point_in(const Object& object, std::string_view key) {
    Point point;
    const auto* own = json::find(object, key);
    const auto* items = own ? own->value.as<Array>() : nullptr;
    for (std::size_t i = 0; items && i < items->size() && i < 3; ++i)
        if (const auto* number = (*items)[i].as<json::Number>()) point[int(i)] = number->value;
    return point;
}

double number_in(const Object& object, std::string_view key) {
    const auto* own = json::find(object, key);
    const auto* number = own ? own->value.as<json::Number>() : nullptr;
    return number ? number->value : 0;
}

void put(Object& object, std::string_view key, Value value) {
    if (auto* own = json::find(object, key))
        own->value = std::move(value);
    else
        object.push_back({std::string(key), std::move(value)});
}

Value numbers(const Point& point, int dimension) {
    Array items;
    for (int i = 0; i < dimension; ++i) items.push_back(point[i]);
    return items;
}

Array* list_in(Object& root, std::string_view name) {
    auto* own = json::find(root, name);
    return own ? own->value.as<Array>() : nullptr;
}

std::optional<std::size_t> figure_called(const Scene& scene, const std::string& name) {
    const auto found =
        std::ranges::find(scene.figures, name, [](const auto& figure) { return std::string(sinew::name_of(figure)); });
    if (found == scene.figures.end()) return std::nullopt;
    return std::size_t(found - scene.figures.begin());
}

/// Mean of a figure's particles in a world.
std::optional<Point> middle_in(const AnyWorld& world, const std::string& name) {
    return std::visit(
        [&](const auto& any) -> std::optional<Point> {
            const auto known = find_figure(any, name);
            if (!known) return std::nullopt;
            Point sum;
            double count = 0;
            for (const auto id : any.figures[*known].particles)
                if (const auto row = row_of(any, id)) {
                    for (int i = 0; i < any.dimension; ++i) sum[i] += double(any.particles.position[*row][i]);
                    ++count;
                }
            for (int i = 0; i < 3 && count > 0; ++i) sum[i] /= count;
            return count > 0 ? std::optional(sum) : std::nullopt;
        },
        world);
}

Point middle_of(const ColliderSection& obstacle) {
    Point middle = obstacle.at;
    detail::visit_held(obstacle.shape, [&]<class Shape>(const Shape& shape) {
        if constexpr (std::is_same_v<Shape, CapsuleShape>)
            for (int i = 0; i < 3; ++i) middle[i] += (shape.from[i] + shape.to[i]) / 2;
        if constexpr (requires { shape.points; })
            for (const auto& point : shape.points)
                for (int i = 0; i < 3; ++i) middle[i] += point[i] / double(shape.points.size());
    });
    return middle;
}

/// x becomes middle + shift + scale R (x - middle).
struct Motion {
    Point middle, shift;
    double cosine = 1, sine = 0, scale = 1;

    Point of(const Point& x) const {
        Point moved = x;
        const double dx = x[0] - middle[0], dy = x[1] - middle[1];
        moved[0] = middle[0] + shift[0] + scale * (cosine * dx - sine * dy);
        moved[1] = middle[1] + shift[1] + scale * (sine * dx + cosine * dy);
        moved[2] = middle[2] + shift[2] + scale * (x[2] - middle[2]);
        return moved;
    }
};

/// Moves the points a pin is led to.
void move_pin(Object& pin, const Motion& motion, int dimension) {
    if (json::find(pin, "to")) put(pin, "to", numbers(motion.of(point_in(pin, "to")), dimension));
    if (auto* keys = list_in(pin, "keys"))
        for (auto& key : *keys)
            if (auto* object = key.as<Object>(); object && json::find(*object, "to"))
                put(*object, "to", numbers(motion.of(point_in(*object, "to")), dimension));
}

bool pins_of(const Value& pin, const std::string& figure) {
    const auto* object = pin.as<Object>();
    const auto* own = object ? json::find(*object, "particle") : nullptr;
    const auto* name = own ? own->value.as<std::string>() : nullptr;
    return name && belongs(*name, figure);
}

constexpr double degrees = 180 / pi<double>;

/// Reshapes a record with "at" and "turn": a figure or an obstacle.
void place(Object& record, const Motion& motion, double turn_on_screen, int dimension) {
    put(record, "at", numbers(motion.of(point_in(record, "at")), dimension));
    if (turn_on_screen == 0) return;
    const double turn = std::remainder(number_in(record, "turn") + turn_on_screen * degrees, 360);
    put(record, "turn", Value(turn));
}

} // namespace

std::string obstacle_name(const Scene& scene, std::size_t number) {
    const auto& name = scene.colliders[number].name;
    return name.empty() ? concat("#", number) : name;
}

std::optional<std::size_t> obstacle_called(const Scene& scene, const std::string& name) {
    for (std::size_t i = 0; i < scene.colliders.size(); ++i)
        if (obstacle_name(scene, i) == name) return i;
    return std::nullopt;
}

std::optional<Point> middle_of(const Scene& scene, const AnyWorld& world, const Part& part) {
    if (!part.is_obstacle) return middle_in(world, part.name);
    const auto number = obstacle_called(scene, part.name);
    return number ? std::optional(middle_of(scene.colliders[*number])) : std::nullopt;
}

std::optional<Scene> reshaped(const Scene& scene, const AnyWorld& world, std::span<const Part> parts, const Reshape& by,
                              std::string& problem) {
    Point common;
    std::vector<std::pair<Part, Point>> found;
    for (const auto& part : parts)
        if (const auto middle = middle_of(scene, world, part)) found.emplace_back(part, *middle);
    for (const auto& [part, middle] : found)
        for (int i = 0; i < 3; ++i) common[i] += middle[i] / double(found.size());
    const auto beginning = instantiate(scene);
    const double up = scene.units.up == "-y" ? -1 : 1;
    Motion whole{common, by.shift, cosine(by.turn), sine(by.turn), by.scale};
    auto changed = edited(scene, [&](Object& root) {
        for (const auto& [part, middle] : found) {
            const auto to = whole.of(middle);
            Motion now = whole, begun = whole; // as it is, and as it begins
            now.middle = middle;
            begun.middle = part.is_obstacle ? middle : middle_in(beginning, part.name).value_or(middle);
            for (int i = 0; i < 3; ++i) now.shift[i] = begun.shift[i] = to[i] - middle[i];
            auto* list = list_in(root, part.is_obstacle ? "colliders" : "figures");
            const auto number = part.is_obstacle ? obstacle_called(scene, part.name) : figure_called(scene, part.name);
            if (!list || !number || *number >= list->size()) continue;
            auto& record = (*list)[*number];
            auto* object = record.as<Object>();
            if (!object) continue;
            if (by.scale != 1)
                grow(record, part.is_obstacle ? section_layout("colliders").parts[0] : figure_layout(), by.scale,
                     scene.measures());
            place(*object, begun, by.turn * up, scene.dimension);
            if (auto* pins = list_in(root, "pins"); pins && !part.is_obstacle)
                for (auto& pin : *pins)
                    if (pins_of(pin, part.name)) move_pin(*pin.as<Object>(), now, scene.dimension);
        }
    });
    problem = std::move(changed.problem);
    return std::move(changed.scene);
}

std::optional<Scene> duplicated(const Scene& scene, const AnyWorld& world, std::span<const Part> parts,
                                const Point& shift, std::vector<Part>& made, std::string& problem) {
    std::vector<std::pair<std::string, std::string>> renamed;
    const auto beginning = instantiate(scene);
    const auto moved = [&](const Part& part) {
        Motion motion{.middle = {}, .shift = shift};
        const auto now = middle_of(scene, world, part);
        const auto begun = part.is_obstacle ? now : middle_in(beginning, part.name);
        for (int i = 0; i < 3 && now && begun; ++i) motion.shift[i] += (*now)[i] - (*begun)[i];
        return motion;
    };
    auto changed = edited(scene, [&](Object& root) {
        auto names = scene;
        for (const auto& part : with_joints(scene, parts)) {
            const auto copy =
                part.is_obstacle ? free_obstacle(names, part.name) : free_name(names, unnumbered(part.name));
            if (part.is_obstacle)
                names.colliders.emplace_back().name = copy;
            else
                names.figures.emplace_back().name = copy;
            renamed.emplace_back(part.name, copy);
            made.push_back({copy, part.is_obstacle});
            auto* list = list_in(root, part.is_obstacle ? "colliders" : "figures");
            const auto number = part.is_obstacle ? obstacle_called(scene, part.name) : figure_called(scene, part.name);
            if (!list || !number) continue;
            auto record = (*list)[*number];
            rename(record, renamed);
            auto* object = record.as<Object>();
            put(*object, "name", Value(copy));
            place(*object, moved(part), 0, scene.dimension);
            list->push_back(std::move(record));
            auto* pins = list_in(root, "pins");
            for (std::size_t i = 0, count = pins ? pins->size() : 0; i < count && !part.is_obstacle; ++i) {
                if (!pins_of((*pins)[i], part.name)) continue;
                auto pin = (*pins)[i];
                rename(pin, renamed);
                Motion motion{.middle = {}, .shift = shift};
                move_pin(*pin.as<Object>(), motion, scene.dimension);
                pins->push_back(std::move(pin));
            }
        }
    });
    problem = std::move(changed.problem);
    return std::move(changed.scene);
}

} // namespace sinew::play
