#pragma once

#include "sinew/scene/scene.h"
#include "sinew/session/picture.h"
#include "sinew/session/view.h"

#include <cstddef>
#include <string>
#include <vector>

/// The ways of dots that leave a trail (looks.NAME.trail), step by step.
namespace sinew {

class Trails {
  public:
    Trails() = default;
    /// Of all dots of a world at its start.
    Trails(const Scene& scene, const AnyWorld& world);

    /// Notes where the dots are.
    void note(const AnyWorld& world);

    /// Adds the trails to a picture, from the palest end to the dot. `unit` is a nominal pixel.
    void draw(const Scene& scene, const View& view, float unit, Picture& picture) const;

  private:
    struct Trail {
        ParticleId particle;
        std::size_t figure = 0;
        std::string figure_name, part;
        std::vector<Point> places; ///< a ring buffer of all the trail can hold
        std::size_t noted = 0;     ///< places noted so far
    };
    std::vector<Trail> trails_;

    static void draw(const Trail& trail, const Scene& scene, const View& view, float unit, Picture& picture);
};

} // namespace sinew
