#pragma once

#include "sinew/scene/scene.h"
#include "sinew/session/stroke.h"
#include "sinew/world/edit.h"

#include <optional>
#include <string>
#include <vector>

namespace sinew {

/// Grabs begun by events of a scene and not yet released. Each holds a particle by a pin whose target moves along a
/// straight path, and the particles of the same figure within the grab's radius by pins at a constant offset.
class EventGrabs {
  public:
    /// Begins a grab, after releasing an earlier one of the same particle. False if no particle has the name.
    bool begin(AnyWorld& world, const Scene& scene, const GrabEvent& grab);
    void release(AnyWorld& world, const std::string& particle);
    void release_all(AnyWorld& world);
    /// Forgets all grabs of a world that is gone.
    void clear() { held_.clear(); }

    /// Sets the targets to their places at the end of the next step, of length `step`.
    void carry(AnyWorld& world, double step);
    /// Pins again, in a world made anew in place of `old`, where the particles still exist.
    void go_on(AnyWorld& world, const AnyWorld& old);

    /// Pins that hold particles.
    std::vector<PinId> pins() const;
    /// Particles named by the events.
    std::vector<ParticleId> particles(const AnyWorld& world) const;

    /// State of a snapshot.
    template <class Self, class Visit> static void state(Self& self, Visit&& visit) {
        auto& [held] = self;
        visit(held);
    }

  private:
    struct Held {
        std::string particle;
        PinId pin;
        Point from, to;                 ///< ends of the target's path
        double since = 0, duration = 0; ///< start and duration, in the scene's unit of time
        std::optional<Stroke> stroke{}; ///< replaces the pin in classic mode

        template <class Self, class Visit> static void state(Self& self, Visit&& visit) {
            auto& [particle, pin, from, to, since, duration, stroke] = self;
            visit(particle, pin, from, to, since, duration, stroke);
        }
    };

    template <class WorldT>
    void hold_around(WorldT& world, const Scene& scene, ParticleId middle, const GrabEvent& grab, const Held& held);

    std::vector<Held> held_;
};

} // namespace sinew
