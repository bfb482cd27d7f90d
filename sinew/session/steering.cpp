#include "sinew/session/steering.h"

#include "sinew/prefab/steer.h"
#include "sinew/scene/check.h"
#include "sinew/scene/types.h"
#include "sinew/world/edit.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>

namespace sinew {
namespace {

/// True while the event lasts, in one of its occurrences.
bool lasts(const EventSection& event, const SteerEvent& steer, double now) {
    double since = now - event.first();
    if (since < 0) return false;
    if (event.every > 0) {
        const double number = std::floor(since / event.every);
        if (event.times == 0 || number < event.times) since -= number * event.every;
    }
    return since < steer.duration;
}

/// Controls by the scene's events at a time; of several the last in the scene counts.
Controls controls_at(const Scene& scene, std::string_view figure, double now) {
    Controls controls;
    for (const auto& event : scene.events) {
        const auto* steer = std::get_if<SteerEvent>(&event.event);
        if (!steer || steer->figure != figure || !lasts(event, *steer, now)) continue;
        if (steer->along) controls.along = *steer->along;
        if (steer->up) controls.up = *steer->up;
        if (steer->jump) controls.jump = *steer->jump;
        if (steer->hold) controls.hold = *steer->hold;
    }
    return controls;
}

/// True if no two entries are of figures of one index.
template <class Entries, class FigureOf> bool are_of_different_figures(const Entries& entries, FigureOf figure_of) {
    std::vector<std::uint32_t> indices;
    for (const auto& entry : entries) indices.push_back(std::invoke(figure_of, entry).index);
    std::ranges::sort(indices);
    return std::ranges::adjacent_find(indices) == indices.end();
}

/// True if a scene in these units could state the parameters of a prefab.
template <class Prefab> bool are_within_ranges(const Prefab& prefab, const Units& units) {
    bool all = true;
    Prefab::fields(prefab, [&](double value, const Field& field) {
        const auto range = range_in_file(field, units);
        const double stated = rounded(value * in_file(field.unit));
        all = all && stated >= range.low && stated <= range.high;
    });
    return all && !prefab.problem(2);
}

} // namespace

Controls Steering::within_range(const Controls& controls) {
    return {clamp(controls.along, -1.0, 1.0), clamp(controls.up, -1.0, 1.0), controls.jump, controls.hold};
}

std::optional<Steering::Steered> Steering::of(const FigureSection& section) {
    std::optional<Steered> found;
    detail::visit_held(section.made, [&]<class Made>(const Made& made) {
        if constexpr (std::is_same_v<Made, Character> || std::is_same_v<Made, Car>) found = made;
    });
    return found;
}

void Steering::set(const FigureId& figure, std::optional<Controls> controls) {
    std::erase_if(set_, [&](const auto& entry) { return entry.first.index == figure.index; });
    if (controls) set_.emplace_back(figure, within_range(*controls));
}

void Steering::know(const Known& known) {
    std::erase_if(known_, [&](const Known& other) { return other.figure.index == known.figure.index; });
    known_.push_back(known);
}

std::string Steering::model_of(const FigureId& figure) const {
    const auto found = std::ranges::find(known_, figure, &Known::figure);
    return found == known_.end() ? std::string() : found->model;
}

std::optional<Steering::Steered> Steering::steered(const Scene& scene, const AnyWorld& world,
                                                   FigureIndex figure) const {
    return std::visit(
        [&](const auto& any) -> std::optional<Steered> {
            if (!has_figure(any, figure)) return std::nullopt;
            for (const auto& known : known_)
                if (known.figure == figure_id(any, figure)) return known.steered;
            for (const auto& section : scene.figures)
                if (name_of(section) == any.figures[figure].name) return of(section);
            return std::nullopt;
        },
        world);
}

bool Steering::has_any(const Scene& scene) const {
    return !known_.empty() ||
           std::ranges::any_of(scene.figures, [](const auto& section) { return of(section).has_value(); });
}

void Steering::restart() {
    set_.clear();
    known_.clear();
}

void Steering::take_over(const Steering& before, const AnyWorld& old, const AnyWorld& now) {
    const auto now_called = [&](const FigureId& figure) {
        const auto name = std::visit(
            [&](const auto& world) {
                const auto index = figure_index(world, figure);
                return index ? world.figures[*index].name : "";
            },
            old);
        return std::visit(
            [&](const auto& world) {
                const auto index = find_figure(world, name);
                return index ? figure_id(world, *index) : FigureId{};
            },
            now);
    };
    for (const auto& [figure, controls] : before.set_)
        if (const auto id = now_called(figure); id != FigureId{}) set(id, controls);
    for (const auto& [figure, steered, model] : before.known_)
        if (const auto id = now_called(figure); id != FigureId{}) know({id, steered, model});
}

template <class WorldT> void Steering::run_in(const Scene& scene, WorldT& world) const {
    using Real = typename WorldT::Real;
    const double now = world.time + step_length(scene) * 1e-6; // the clock is a sum of steps
    const auto move = [&](FigureIndex figure, const Steered& steered, std::string_view model) {
        const auto own =
            std::ranges::find(set_, figure_id(world, figure), [](const auto& entry) { return entry.first; });
        const auto controls = own != set_.end() ? own->second : player_ ? *player_ : controls_at(scene, model, now);
        const auto dt = Real(step_length(scene));
        if (const auto* character = std::get_if<Character>(&steered))
            walk(world, figure, *character, controls, dt);
        else if (const auto* car = std::get_if<Car>(&steered))
            steer(world, figure, *car, controls, dt);
    };
    const auto is_known = [&](FigureIndex figure) {
        const auto id = figure_id(world, figure);
        return std::ranges::any_of(known_, [&](const Known& known) { return known.figure == id; });
    };
    for (const auto& section : scene.figures)
        if (const auto steered = of(section))
            if (const auto figure = find_figure(world, name_of(section)); figure && !is_known(*figure))
                move(*figure, *steered, name_of(section));
    for (const auto& [known, steered, model] : known_)
        if (const auto figure = figure_index(world, known))
            move(*figure, steered, model.empty() ? world.figures[*figure].name : model);
}

bool Steering::is_of(const Scene& scene) const {
    const auto units = scene.measures();
    const auto is_within_range = [](const Controls& controls) { return controls == within_range(controls); };
    const auto is_possible = [&](const Steered& steered) {
        return std::visit([&](const auto& prefab) { return are_within_ranges(prefab, units); }, steered);
    };
    return (!player_ || is_within_range(*player_)) &&
           std::ranges::all_of(set_, [&](const auto& entry) { return is_within_range(entry.second); }) &&
           std::ranges::all_of(known_, [&](const Known& known) { return is_possible(known.steered); }) &&
           are_of_different_figures(set_, &std::pair<FigureId, Controls>::first) &&
           are_of_different_figures(known_, &Known::figure);
}

void Steering::pass_generations() const {
    for (const auto& [figure, controls] : set_) Stamp::pass(figure.generation);
    for (const auto& [figure, steered, model] : known_) Stamp::pass(figure.generation);
}

void Steering::run(const Scene& scene, AnyWorld& any) const {
    std::visit(
        [&]<class WorldT>(WorldT& world) {
            if constexpr (WorldT::dimension == 2) run_in(scene, world);
        },
        any);
}

} // namespace sinew
