#include "player/action_log.h"

#include <algorithm>
#include <utility>

namespace sinew::play {
namespace {

/// True if `later`, at the same step, overrides `earlier`.
bool replaces(const Action& later, const Action& earlier) {
    return later.index() == earlier.index() &&
           (std::holds_alternative<Drag>(later) || std::holds_alternative<PointAt>(later));
}

} // namespace

void ActionLog::plant(const Session& session) {
    const auto root = std::uint32_t(nodes_.size());
    nodes_.push_back({root, 0, Become{std::make_shared<const Scene>(session.scene())}});
    now_ = {root, 0};
}

void ActionLog::note(const Action& action, const Session& session) {
    if (const auto* back = std::get_if<Return>(&action)) return go_to(back->at);
    if (const auto* point = std::get_if<PointAt>(&action)) pointer_ = *point;
    if (std::holds_alternative<Restart>(action)) {
        plant(session);
        if (!pointer_.position) return;
        return note(Action(PointAt(pointer_)), session);
    }
    const bool is_newest = now_.last + 1 == nodes_.size();
    if (is_newest && nodes_.back().step == now_.step && replaces(action, nodes_.back().action)) {
        nodes_.back().action = action;
        return;
    }
    nodes_.push_back({now_.last, now_.step, action});
    now_.last = std::uint32_t(nodes_.size() - 1);
}

Recipe ActionLog::recipe() const {
    Recipe recipe{.scene = nullptr, .actions = {}, .steps = now_.step};
    auto index = now_.last;
    for (; nodes_[index].before != index; index = nodes_[index].before)
        recipe.actions.push_back({nodes_[index].step, nodes_[index].action});
    std::reverse(recipe.actions.begin(), recipe.actions.end());
    recipe.scene = std::get<Become>(nodes_[index].action).scene;
    return recipe;
}

} // namespace sinew::play
