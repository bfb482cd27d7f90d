#include "player/saved_action.h"

#include <memory>
#include <utility>

namespace sinew::play {
namespace {

using Saved = decltype(SavedAction::action);

/// Return and Restart are branches of the log, never actions of a recipe; their cases only complete the visitor.
struct Save {
    Saved operator()(const PointAt& action) const { return SavedPointer{action.position.value_or(Point{})}; }
    Saved operator()(const Grab& action) const {
        SavedGrab grab{.members = {}, .position = action.position};
        for (const Row row : action.members) grab.members.push_back(std::int64_t(row));
        return grab;
    }
    Saved operator()(const Drag& action) const { return SavedDrag{action.position}; }
    Saved operator()(const LetGo&) const { return SavedRelease{}; }
    Saved operator()(const Slash& action) const {
        return SavedCut{action.line, action.look.section, action.look.focus, {action.look.width, action.look.height}};
    }
    Saved operator()(const Become& action) const { return SavedEdit{to_json(*action.scene)}; }
    Saved operator()(const Return&) const { return SavedRelease{}; }
    Saved operator()(const Restart&) const { return SavedRelease{}; }
    Saved operator()(const Quicken& action) const { return SavedQuicken{action.by}; }
    Saved operator()(const Tweak& action) const {
        return SavedTweak{std::int64_t(action.particle), action.position, action.velocity, action.mass};
    }
    Saved operator()(const Steer& action) const {
        const auto& [along, up, jump, hold] = action.controls;
        return SavedSteer{along, up, jump, hold};
    }
};

struct Load {
    const std::function<std::optional<Opened>(const json::Value& scene)>& open;

    std::optional<Action> operator()(const SavedPointer& action) const { return PointAt{action.position}; }
    std::optional<Action> operator()(const SavedGrab& action) const {
        Grab grab{.members = {}, .position = action.position};
        for (const auto row : action.members) grab.members.push_back(Row(row));
        return grab;
    }
    std::optional<Action> operator()(const SavedDrag& action) const { return Drag{action.position}; }
    std::optional<Action> operator()(const SavedRelease&) const { return LetGo{}; }
    std::optional<Action> operator()(const SavedCut& action) const {
        return Slash{action.line, {action.view, action.focus, action.picture[0], action.picture[1]}};
    }
    std::optional<Action> operator()(const SavedEdit& action) const {
        auto opened = open(action.scene);
        if (!opened) return std::nullopt;
        return Become{std::make_shared<const Scene>(std::move(opened->scene))};
    }
    std::optional<Action> operator()(const SavedQuicken& action) const { return Quicken{action.by}; }
    std::optional<Action> operator()(const SavedTweak& action) const {
        return Tweak{Row(action.particle), action.position, action.velocity, action.mass};
    }
    std::optional<Action> operator()(const SavedSteer& action) const {
        return Steer{{action.along, action.up, action.jump, action.hold}};
    }
};

} // namespace

SavedAction saved(const LoggedAction& logged) {
    return {std::int64_t(logged.step), std::visit(Save{}, logged.action)};
}

std::optional<Action> action_of(const SavedAction& action,
                                const std::function<std::optional<Opened>(const json::Value& scene)>& open) {
    return std::visit(Load{open}, action.action);
}

} // namespace sinew::play
