#pragma once

#include "sinew/collide/bounding_box.h"
#include "sinew/world/contacts.h"

#include <algorithm>
#include <span>
#include <vector>

namespace sinew {

/// Touches of particles and colliders during a step. Each particle reports a few colliders: those that press hardest.
/// Planes count on from the colliders, where they are listed.
template <int D, class Real> struct ColliderTouches {
    struct Place {
        Vec<D, Real> point{}, normal{};
        Real speed = 0; ///< of approach
    };
    struct Touch {
        std::uint32_t collider = 0; ///< 1 + index of the collider, or 0
        Real impulse = 0;           ///< newton seconds
        Real hardest = 0;           ///< largest impulse at a place
        Place place{};
    };
    static constexpr std::size_t most = 4; ///< colliders of a particle; each costs a word of memory per particle

    std::vector<collide::BoundingBox<D, Real>> boxes; ///< of the colliders during the step
    std::vector<ColliderTouch> before;                ///< pairs of the step before, in order
    std::vector<FigureTouch> figures;                 ///< of the step, in any order, some of them several times
    std::vector<FigureTouch> figures_before;          ///< of the step before, in order

    void begin(std::size_t particles, std::size_t colliders) {
        per_particle_ = std::min(colliders, most);
        list_.assign(particles * per_particle_, {});
    }
    /// Touches of a particle, those without a collider among them.
    std::span<Touch> of(Row row) {
        const auto first = row * per_particle_;
        return first + per_particle_ <= list_.size() ? std::span(list_).subspan(first, per_particle_)
                                                     : std::span<Touch>();
    }
    bool has(Row row, std::uint32_t index) {
        return std::ranges::any_of(of(row), [&](const Touch& touch) { return touch.collider == index + 1; });
    }

    /// Adds an impulse of a collider on a particle; it displaces the weakest touch that it exceeds.
    void add(Row row, std::uint32_t index, Real impulse, const Place& place = {}) {
        Touch* weakest = nullptr;
        for (auto& touch : of(row)) {
            if (touch.collider == index + 1) return add(touch, impulse, place);
            if (!weakest || rank(touch) < rank(*weakest)) weakest = &touch;
        }
        if (weakest && impulse > rank(*weakest)) *weakest = {index + 1, impulse, impulse, place};
    }

  private:
    std::vector<Touch> list_; ///< by particles
    std::size_t per_particle_ = 0;

    static void add(Touch& touch, Real impulse, const Place& place) {
        touch.impulse += impulse;
        if (place.normal == Vec<D, Real>{} || impulse < touch.hardest) return;
        touch.hardest = impulse, touch.place = place;
    }
    static Real rank(const Touch& touch) { return touch.collider == 0 ? Real(-1) : touch.impulse; }
};

} // namespace sinew
