#pragma once

#include "sinew/scene/scene.h"
#include "sinew/world/edit.h"

#include <optional>
#include <span>
#include <vector>

namespace sinew {

/// A pointer's grab: a pin of limited force on one particle, or on a handle, a light particle joined by distances to
/// several particles. A grab with a radius also pins the particles of the same figure nearby.
struct PointerGrab {
    /// Acceleration limit of everything lifted, metres per second squared: 100 times gravity. A larger limit follows
    /// the pointer more closely but tears and jams the figure.
    static constexpr double strength = 1000;

    std::vector<ParticleId> members;
    Point target; ///< position of the held point at the end of the next step
    PinId pin{};
    std::optional<ParticleId> handle{}; ///< present if there are several members

    struct Along {
        PinId pin;
        Point offset; ///< from `target`

        template <class Self, class Visit> static void state(Self& self, Visit&& visit) {
            auto& [pin, offset] = self;
            visit(pin, offset);
        }
    };
    std::vector<Along> along{};

    /// State of a snapshot.
    template <class Self, class Visit> static void state(Self& self, Visit&& visit) {
        auto& [members, target, pin, handle, along] = self;
        visit(members, target, pin, handle, along);
    }

    /// Pins the members at `place`. Empty if a member has been removed or none can move. `acceleration` and `radius` in
    /// the world's units; `hold`: rule of classic mode.
    static std::optional<PointerGrab> take(AnyWorld& world, std::span<const ParticleId> members, const Point& position,
                                           double acceleration, double radius = 0, Hold hold = Hold::fixed);

    /// Sets the targets of the pins; a target behind a plane is projected onto the plane.
    void carry(AnyWorld& world) const;
    void let_go(AnyWorld& world) const;
};

} // namespace sinew
