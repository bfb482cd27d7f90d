#include "sinew/scene/check.h"
#include "sinew/session/change_figure.h"
#include "sinew/session/keep_changes.h"
#include "sinew/session/migrate_state.h"
#include "sinew/session/session.h"
#include "sinew/world/edit.h"

#include <algorithm>
#include <cmath>
#include <utility>

/// Input to a running session: grabbing, time scale, live editing.
namespace sinew {

bool Session::grab(std::span<const ParticleId> members, const Point& position) {
    let_go();
    grabs_.release_all(world_);
    taken_over_ = true;
    if (strokes(world_, scene_.pointer.grab_radius)) {
        stroke_ = Stroke{position, scene_.pointer.grab_radius, scene_.pointer.grab_gain};
        stroke_to_ = position;
        return true;
    }
    hand_ = grip(members, position);
    return hand_.has_value();
}

std::optional<PointerGrab> Session::grip(std::span<const ParticleId> members, const Point& position) {
    const auto units = scene_.measures();
    const double strength = PointerGrab::strength * units.per_metre / square(units.per_second);
    return PointerGrab::take(world_, members, position, strength, scene_.pointer.grab_radius, hold_rule(scene_));
}

std::optional<PinId> Session::hold(std::span<const ParticleId> members, const Point& position) {
    const auto taken = grip(members, position);
    if (!taken) return std::nullopt;
    hands_.push_back(*taken);
    return taken->pin;
}

bool Session::carry(PinId grab, const Point& position) {
    forget_lost_grabs();
    const auto found = std::ranges::find(hands_, grab, &PointerGrab::pin);
    if (found == hands_.end()) return false;
    found->target = position;
    return true;
}

bool Session::release(PinId grab) {
    forget_lost_grabs();
    const auto found = std::ranges::find(hands_, grab, &PointerGrab::pin);
    if (found == hands_.end()) return false;
    found->let_go(world_);
    hands_.erase(found);
    return true;
}

/// Grabs end with their pins: another pin has taken their place, or the particle is gone.
void Session::forget_lost_grabs() {
    std::visit(
        [&](const auto& world) {
            std::erase_if(hands_, [&](const PointerGrab& hand) { return !world.pin_handles.find(hand.pin); });
        },
        world_);
}

void Session::drag(const Point& position) {
    if (hand_) hand_->target = position;
    stroke_to_ = position;
}

void Session::let_go() {
    if (hand_) hand_->let_go(world_);
    hand_.reset();
    stroke_.reset();
}

void Session::quicken(double by) {
    constexpr double fastest = 5; // limit of the GameMaker tutorial
    std::visit(
        [&]<class WorldT>(WorldT& world) {
            auto& scale = world.settings.classic.time_scale;
            scale = typename WorldT::Real(clamp(double(scale) + by, 0.0, fastest));
        },
        world_);
}

FigureIndex Session::add(const FigureSection& section, const std::string& model) {
    add_figure(scene_, section, world_);
    const auto figure = std::visit([&](const auto& world) { return *find_figure(world, name_of(section)); }, world_);
    remember(figure, section, model);
    return figure;
}

void Session::remember(FigureIndex figure, const FigureSection& section, const std::string& model) {
    const auto id = id_of(figure);
    added_.remember(id, json::to_text(to_json(scene_, section)));
    if (const auto steered = Steering::of(section)) steering_.know({id, *steered, model});
}

std::string Session::change(FigureIndex figure, const Opened& before, const Opened& after) {
    auto why_not = change_figure(world_, figure, {before.world, after.world});
    if (why_not.empty()) remember(figure, after.scene.figures.front(), steering_.model_of(id_of(figure)));
    return why_not;
}

FigureId Session::id_of(FigureIndex figure) const {
    return std::visit([&](const auto& world) { return figure_id(world, figure); }, world_);
}

std::string Session::become(Scene scene) {
    return become(std::move(scene), level_);
}

std::string Session::become(Scene scene, std::shared_ptr<Level> level) {
    let_go();
    auto fresh = instantiate(scene);
    const auto going_on = migrate_state(scene_, world_, scene, fresh);
    const AnyWorld old = std::exchange(world_, std::move(fresh));
    const Scene before = std::exchange(scene_, std::move(scene));
    level_ = std::move(level);
    skip_past_events();
    find_driven();
    const auto lost = level_ ? "" : keep_changes_of(before, old, going_on);
    const auto memory = std::move(level_memory_);
    const auto steering = steering_;
    auto added = added_;
    build_level();
    if (!level_) { // code steers its own figures
        steering_.take_over(steering, old, world_);
        added.keep_those_of(world_);
        added_ = std::move(added);
    }
    if (memory.size() == level_memory_.size()) level_memory_ = memory;
    if (level_) migrate_built({old, before.figures.size()}, {world_, scene_.figures.size()});
    keep_going(old);
    forget_lost_grabs();
    if (!history_.is_of(scene_)) history_.restart(scene_, world_);
    return lost;
}

/// Pins of events are made anew by keep_going().
std::string Session::keep_changes_of(const Scene& scene, const AnyWorld& old, std::span<const FigureIndex> going_on) {
    Renamed renamed;
    const auto held = grabs_.pins();
    auto lost = keep_changes({scene, scene_, old, world_, going_on, held}, renamed);
    for (auto& driven : driven_) renamed.rename(driven.pin);
    winder_.each([&](ConstraintId& id) { renamed.rename(id); });
    return lost;
}

/// Drops due events before the present step; a periodic event continues with the next occurrence.
void Session::skip_past_events() {
    plan_events();
    const double now = std::visit([](const auto& world) { return world.time; }, world_);
    const double first = now - step_length(scene_) / 2;
    std::erase_if(due_, [&](Due& due) {
        const auto& event = scene_.events[due.event];
        if (due.at >= first) return false;
        if (!(event.every > 0)) return true;
        due.before = std::uint64_t(std::ceil((first - event.first()) / event.every));
        due.at = event.first() + event.every * double(due.before);
        return event.times != 0 && due.before >= std::uint64_t(event.times);
    });
    std::make_heap(due_.begin(), due_.end());
}

/// Restores the state of events that have begun but not ended: grabs and gusts.
void Session::keep_going(const AnyWorld& old) {
    grabs_.go_on(world_, old);
    std::visit(
        [&]<class WorldT>(WorldT& world) {
            const auto* before = std::get_if<WorldT>(&old);
            if (!before) return blowing_.clear();
            for (auto& blowing : blowing_)
                if (const auto* wind = before->forces.find(blowing.force); wind && !world.forces.find(blowing.force))
                    blowing.force = world.forces.push_back(*wind);
        },
        world_);
}

} // namespace sinew
