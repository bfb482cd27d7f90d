#include "apps/play/saved_action.h"

#include <memory>
#include <utility>

namespace sinew::play {
namespace {

SavedId saved_id(ParticleId id) {
    return {id.slot, id.generation};
}

ParticleId id_of(const SavedId& id) {
    return {std::uint32_t(id[0]), std::uint32_t(id[1])};
}

using Saved = decltype(SavedAction::action);

/// Returns and restarts are branches of the log, not actions of a recipe.
struct Save {
    Saved operator()(const PointAt& deed) const { return SavedPointer{deed.place.value_or(Point{})}; }
    Saved operator()(const Grab& deed) const {
        SavedGrab grab{.members = {}, .place = deed.place};
        for (const auto id : deed.members) grab.members.push_back(saved_id(id));
        return grab;
    }
    Saved operator()(const Drag& deed) const { return SavedDrag{deed.place}; }
    Saved operator()(const LetGo&) const { return SavedRelease{}; }
    Saved operator()(const Slash& deed) const {
        return SavedCut{deed.line, deed.look.section, deed.look.focus, {deed.look.width, deed.look.height}};
    }
    Saved operator()(const Become& deed) const { return SavedEdit{to_json(*deed.scene)}; }
    Saved operator()(const Return&) const { return SavedRelease{}; }
    Saved operator()(const Restart&) const { return SavedRelease{}; }
    Saved operator()(const Quicken& deed) const { return SavedQuicken{deed.by}; }
    Saved operator()(const Tweak& deed) const {
        return SavedTweak{saved_id(deed.particle), deed.position, deed.velocity, deed.mass};
    }
};

struct Load {
    const std::function<std::optional<Opened>(const json::Value& scene)>& open;

    std::optional<Deed> operator()(const SavedPointer& action) const { return PointAt{action.place}; }
    std::optional<Deed> operator()(const SavedGrab& action) const {
        Grab grab{.members = {}, .place = action.place};
        for (const auto& id : action.members) grab.members.push_back(id_of(id));
        return grab;
    }
    std::optional<Deed> operator()(const SavedDrag& action) const { return Drag{action.place}; }
    std::optional<Deed> operator()(const SavedRelease&) const { return LetGo{}; }
    std::optional<Deed> operator()(const SavedCut& action) const {
        return Slash{action.line, {action.view, action.focus, action.picture[0], action.picture[1]}};
    }
    std::optional<Deed> operator()(const SavedEdit& action) const {
        auto opened = open(action.scene);
        if (!opened) return std::nullopt;
        return Become{std::make_shared<const Scene>(std::move(opened->scene))};
    }
    std::optional<Deed> operator()(const SavedQuicken& action) const { return Quicken{action.by}; }
    std::optional<Deed> operator()(const SavedTweak& action) const {
        return Tweak{id_of(action.particle), action.position, action.velocity, action.mass};
    }
};

} // namespace

SavedAction saved(const LoggedAction& action) {
    return {std::int64_t(action.step), std::visit(Save{}, action.deed)};
}

std::optional<Deed> deed_of(const SavedAction& action,
                            const std::function<std::optional<Opened>(const json::Value& scene)>& open) {
    return std::visit(Load{open}, action.action);
}

} // namespace sinew::play
