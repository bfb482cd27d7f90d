#pragma once

#include "sinew/scene/scene.h"

#include <vector>

namespace sinew {

/// Winches and motors of a scene: constraints whose limits are driven.
class Winder {
  public:
    /// Looks for them in a world as its scene made it.
    void find(const Scene& scene, const AnyWorld& world);
    /// Sets their speeds and strengths for the next step.
    void run(const Scene& scene, AnyWorld& world) const;

  private:
    struct Driven {
        ConstraintId constraint;
        std::size_t figure = 0, section = 0; ///< of the scene, or the figure's; scene's own have no figure
    };
    static const ConstraintSection& section_of(const Scene& scene, const Driven& driven);

    std::vector<Driven> driven_;
};

} // namespace sinew
