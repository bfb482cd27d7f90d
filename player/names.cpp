#include "player/names.h"

#include "sinew/picture/style_resolver.h"
#include "sinew/scene/check.h"

#include "player/scene_edit.h"

#include <algorithm>

namespace sinew::play {
namespace {

using json::Array;
using json::Object;
using json::Value;

/// Names that the constraints and pieces of a hand-made figure have of others' particles.
std::vector<std::string> others_of(const FigureSection& figure) {
    std::vector<std::string> names;
    const auto* by_hand = std::get_if<ByHand>(&figure.made);
    if (!by_hand) return names;
    for (const auto& constraint : by_hand->constraints)
        for (const auto& name : constraint.between)
            if (name.find('/') != std::string::npos) names.push_back(name.substr(0, name.find('/')));
    return names;
}

bool is_joint(const FigureSection& figure) {
    const auto* by_hand = std::get_if<ByHand>(&figure.made);
    if (!by_hand || by_hand->constraints.empty() || others_of(figure).empty()) return false;
    return std::ranges::all_of(by_hand->particles, [](const auto& particle) { return particle.second.pinned; });
}

/// A look of each part that is coloured by its figure's place in the list.
void keep_colors(const Scene& scene, const AnyWorld& world, std::size_t number, Object& figure) {
    const auto& section = scene.figures[number];
    const auto name = std::string(sinew::name_of(section));
    const auto& theme = theme_called(scene.view.theme);
    const auto is_colored = [](const auto& look) { return !look.second.color.empty(); };
    if (std::ranges::any_of(section.looks, [&](const auto& look) { return look.first == "all" && is_colored(look); }))
        return;
    auto looks = json::find(figure, "looks") ? *json::find(figure, "looks")->value.as<Object>() : Object{};
    StyleResolver styles(scene, theme, number, name);
    std::visit(
        [&](const auto& any) {
            const auto known = find_figure(any, name);
            if (!known) return;
            for (const auto& piece : any.figures[*known].pieces) {
                if (theme.material_of(piece.part) || piece.part.empty()) continue;
                const auto* own = json::find(looks, piece.part);
                if (own && json::find(*own->value.template as<Object>(), "color")) continue;
                const auto style = styles.of(piece.part);
                auto look = own ? own->value : Value(Object{});
                look.template as<Object>()->push_back({"color", Value(hex_of(style.color))});
                if (!json::find(*look.template as<Object>(), "fill"))
                    look.template as<Object>()->push_back({"fill", Value(hex_of(style.fill))});
                if (auto* member = json::find(looks, piece.part))
                    member->value = std::move(look);
                else
                    looks.push_back({piece.part, std::move(look)});
            }
        },
        world);
    if (looks.empty()) return;
    if (auto* own = json::find(figure, "looks"))
        own->value = Value(std::move(looks));
    else
        figure.push_back({"looks", Value(std::move(looks))});
}

Array* list_called(Object& object, std::string_view name) {
    auto* own = json::find(object, name);
    return own ? own->value.as<Array>() : nullptr;
}

/// Removes constraints and drawn pieces of other figures that join the figure.
void forget(Object& root, const std::string& name) {
    for (const char* list : {"pins", "constraints", "pairs", "traces"})
        if (auto* all = list_called(root, list))
            std::erase_if(*all, [&](const Value& one) { return mentions(one, name); });
    if (auto* events = list_called(root, "events"))
        std::erase_if(*events, [&](Value& event) {
            auto* names = list_called(*event.as<Object>(), "remove");
            if (!names) return mentions(event, name);
            std::erase_if(*names, [&](const Value& one) { return mentions(one, name); });
            return names->empty();
        });
    if (auto* looks = json::find(root, "looks"))
        if (auto* all = looks->value.as<Object>())
            std::erase_if(*all, [&](const json::Member& one) { return belongs(one.key, name); });
    if (auto* figures = list_called(root, "figures"))
        for (auto& figure : *figures)
            for (const char* list : {"constraints", "pieces"})
                if (auto* all = list_called(*figure.as<Object>(), list))
                    std::erase_if(*all, [&](const Value& one) { return mentions(one, name); });
}

} // namespace

bool belongs(std::string_view name, std::string_view figure) {
    return name == figure || (name.size() > figure.size() && name.starts_with(figure) && name[figure.size()] == '/');
}

bool mentions(const Value& value, std::string_view name) {
    if (const auto* text = value.as<std::string>()) return belongs(*text, name);
    if (const auto* items = value.as<Array>())
        return std::ranges::any_of(*items, [&](const Value& item) { return mentions(item, name); });
    if (const auto* members = value.as<Object>())
        return std::ranges::any_of(*members, [&](const json::Member& one) { return mentions(one.value, name); });
    return false;
}

void rename(Value& value, const std::vector<std::pair<std::string, std::string>>& names) {
    if (auto* text = value.as<std::string>())
        for (const auto& [from, to] : names)
            if (belongs(*text, from)) return void(*text = to + text->substr(from.size()));
    if (auto* items = value.as<Array>())
        for (auto& item : *items) rename(item, names);
    if (auto* members = value.as<Object>())
        for (auto& member : *members) rename(member.value, names);
}

std::string unnumbered(const std::string& name) {
    const auto end = name.find_last_not_of("0123456789");
    const bool is_numbered = end != std::string::npos && end + 1 < name.size() && end > 0 && name[end] == '_';
    return is_numbered ? name.substr(0, end) : name;
}

std::string free_obstacle(const Scene& scene, const std::string& like) {
    const auto stem = like.starts_with('#') ? std::string("wall") : unnumbered(like);
    const auto taken = [&](const std::string& name) {
        return std::ranges::any_of(scene.colliders, [&](const auto& one) { return one.name == name; }) ||
               std::ranges::any_of(scene.figures, [&](const auto& one) { return sinew::name_of(one) == name; });
    };
    auto name = stem;
    for (int number = 2; taken(name); ++number) name = concat(stem, "_", number);
    return name;
}

std::vector<Part> with_joints(const Scene& scene, std::span<const Part> parts) {
    std::vector<Part> all(parts.begin(), parts.end());
    const auto has = [&](const std::string& name) { return std::ranges::find(all, Part{name, false}) != all.end(); };
    for (const auto& figure : scene.figures) {
        const auto name = std::string(sinew::name_of(figure));
        if (has(name) || !is_joint(figure)) continue;
        if (std::ranges::all_of(others_of(figure), has)) all.push_back({name, false});
    }
    return all;
}

std::optional<Scene> without(const Scene& scene, const AnyWorld& world, std::span<const Part> parts,
                             std::string& problem) {
    std::vector<Part> all(parts.begin(), parts.end());
    const auto has = [&](const std::string& name) { return std::ranges::find(all, Part{name, false}) != all.end(); };
    for (const auto& figure : scene.figures)
        if (is_joint(figure) && !has(std::string(sinew::name_of(figure))) &&
            std::ranges::any_of(others_of(figure), has))
            all.push_back({std::string(sinew::name_of(figure)), false});
    auto changed = edited(scene, [&](Object& root) {
        auto *figures = list_called(root, "figures"), *obstacles = list_called(root, "colliders");
        std::size_t removed = 0;
        for (std::size_t i = 0; figures && i < scene.figures.size(); ++i) {
            if (has(std::string(sinew::name_of(scene.figures[i])))) {
                figures->erase(figures->begin() + std::ptrdiff_t(i - removed));
                ++removed;
            } else if (removed > 0) {
                keep_colors(scene, world, i, *(*figures)[i - removed].as<Object>());
            }
        }
        for (std::size_t i = scene.colliders.size(); obstacles && i-- > 0;)
            if (std::ranges::find(all, Part{obstacle_name(scene, i), true}) != all.end())
                obstacles->erase(obstacles->begin() + std::ptrdiff_t(i));
        for (const auto& part : all) forget(root, part.name);
    });
    problem = std::move(changed.problem);
    return std::move(changed.scene);
}

} // namespace sinew::play
