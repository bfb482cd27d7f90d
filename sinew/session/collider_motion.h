#pragma once

#include "sinew/scene/scene.h"

#include <algorithm>
#include <optional>
#include <vector>

/// Motion of the colliders of a scene, a function of time and of the pointer.
namespace sinew {

enum class Arrival : bool {
    in_a_step, ///< evenly over the next step: what touches is carried along
    at_once
};

/// Moves the colliders to where they are at a time, in the scene's unit.
void move_colliders(const Scene& scene, const std::optional<Point>& pointer, double time, Arrival arrival,
                    AnyWorld& world);

/// Motions of colliders that events have begun: along a straight line, with an even turn.
class ColliderMoves {
  public:
    void begin(const AnyWorld& world, const Scene& scene, const ColliderEvent& event);
    /// Sets the places at the end of the next step, of length `step`.
    void carry(AnyWorld& world, const Scene& scene, double step);
    /// Forgets the motions in a world that is gone.
    void clear() { moves_.clear(); }

    template <class Self, class Visit> static void state(Self& self, Visit&& visit) {
        auto& [moves] = self;
        visit(moves);
    }
    /// False unless all motions are of colliders of this scene.
    bool is_of(const Scene& scene) const {
        return std::ranges::all_of(moves_, [&](const Move& move) { return move.section < scene.colliders.size(); });
    }

  private:
    struct Move {
        std::size_t section = 0;
        Point from{}, to{};
        double from_turn = 0, to_turn = 0;
        double since = 0, duration = 0; ///< in the scene's unit of time

        template <class Self, class Visit> static void state(Self& self, Visit&& visit) {
            auto& [section, from, to, from_turn, to_turn, since, duration] = self;
            visit(section, from, to, from_turn, to_turn, since, duration);
        }
    };
    std::vector<Move> moves_;
};

} // namespace sinew
