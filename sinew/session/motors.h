#pragma once

#include "sinew/scene/scene.h"

#include <vector>

namespace sinew {

/// Winches and motors of a scene: constraints with driven limits.
class Motors {
  public:
    /// Finds the driven constraints in a freshly built world.
    void find(const Scene& scene, const AnyWorld& world);
    /// Calls visit(id) for every driven constraint, whose id may be changed.
    template <class Visit> void each(Visit&& visit) {
        for (auto& driven : driven_) visit(driven.constraint);
    }
    /// Sets speeds and force limits for the next step.
    void run(const Scene& scene, AnyWorld& world) const;

    /// State of a snapshot; is_of() says whether it belongs to a scene.
    template <class Self, class Visit> static void state(Self& self, Visit&& visit) {
        auto& [driven] = self;
        visit(driven);
    }
    bool is_of(const Scene& scene) const;

  private:
    struct Driven {
        ConstraintId constraint;
        std::size_t figure = 0, section = 0; ///< indices; `figure` is ~0 for the scene's own constraints
        double rest = 0;                     ///< high limit at the start, in the world's units

        template <class Self, class Visit> static void state(Self& self, Visit&& visit) {
            auto& [constraint, figure, section, rest] = self;
            visit(constraint, figure, section, rest);
        }
    };
    static const ConstraintSection& section_of(const Scene& scene, const Driven& driven);

    std::vector<Driven> driven_;
};

} // namespace sinew
