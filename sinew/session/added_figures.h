#pragma once

#include "sinew/world/edit.h"

#include <algorithm>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace sinew {

/// Descriptions of figures added to a running scene by calls and events.
class AddedFigures {
  public:
    /// `description`: JSON, as of a figure in the scene.
    void remember(const FigureId& figure, std::string description) {
        std::erase_if(all_, [&](const auto& entry) { return entry.first.index == figure.index; });
        all_.emplace_back(figure, std::move(description));
    }
    /// Null for a figure of the scene.
    const std::string* find(const FigureId& figure) const {
        const auto found = std::ranges::find(all_, figure, [](const auto& entry) { return entry.first; });
        return found == all_.end() ? nullptr : &found->second;
    }
    /// Forgets figures missing from the world.
    template <class AnyWorldT> void keep_those_of(const AnyWorldT& any) {
        std::visit(
            [&](const auto& world) {
                std::erase_if(all_, [&](const auto& entry) { return !figure_index(world, entry.first); });
            },
            any);
    }
    void clear() { all_.clear(); }

    /// State of a snapshot.
    template <class Self, class Visit> static void state(Self& self, Visit&& visit) {
        auto& [all] = self;
        visit(all);
    }
    /// Keeps ids that came with a file from being given out again.
    void pass_generations() const {
        for (const auto& [figure, description] : all_) Stamp::pass(figure.generation);
    }

  private:
    std::vector<std::pair<FigureId, std::string>> all_;
};

} // namespace sinew
