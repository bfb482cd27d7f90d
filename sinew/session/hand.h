#pragma once

#include "sinew/scene/scene.h"
#include "sinew/solver/edit.h"

#include <optional>
#include <span>
#include <vector>

namespace sinew {

/// A pointer that holds something: one particle by a pin, or a place between several by a handle, a light particle that
/// keeps its distances to them and is pinned instead. A wide hand pulls along what is near of the same figure.
struct Hand {
    /// The hand can give all that it lifts this acceleration, and no more: 100 times that of gravity. Larger follows
    /// closer, but tears and jams what is caught. Metres a second squared.
    static constexpr double strength = 1000;

    std::vector<ParticleId> members;
    Point target; ///< where the held place shall be when the next step ends
    PinId pin{};
    std::optional<ParticleId> handle{}; ///< of several members

    struct Along {
        PinId pin;
        Point offset; ///< from the target
    };
    std::vector<Along> along{};

    /// Nothing where a member is gone or none can move. `acceleration` and `reach` are in the world's units; `hold` is
    /// classic mode's rule.
    static std::optional<Hand> take(AnyWorld& world, std::span<const ParticleId> members, const Point& place,
                                    double acceleration, double reach = 0, Hold hold = Hold::fixed);

    /// Tells the pin where to be. A place beyond a wall is as good as the one before it.
    void carry(AnyWorld& world) const;
    void let_go(AnyWorld& world) const;
};

} // namespace sinew
