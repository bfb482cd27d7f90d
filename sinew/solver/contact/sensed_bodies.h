#pragma once

#include "sinew/collide/collider.h"
#include "sinew/solver/solver.h"
#include "sinew/world/body_shape.h"

namespace sinew::detail {

/// Touches of sensors and bodies at the end of a step: their lines, and the insides of their filled outlines. Particles
/// on the way are sensed within the step.
template <int D, class Real> class SensedBodies {
  public:
    SensedBodies(const World<D, Real>& world, ColliderTouches<D, Real>& touches, const ContactFilter& filter)
        : world_(world), p_(world.particles), touches_(touches), filter_(filter) {}

    void note() {
        for (const auto& figure : world_.figures) {
            if (!figure.in_use() || figure.pieces.empty()) continue;
            const auto around = box_of(figure);
            for (std::uint32_t i = 0; i < world_.colliders.size(); ++i)
                if (const auto& collider = world_.colliders[i];
                    collider.is_sensor && touches_.boxes[i].overlaps(around) && touch(collider.filter, figure.filter))
                    note(figure, i);
        }
    }

  private:
    const World<D, Real>& world_;
    const Particles<D, Real>& p_;
    ColliderTouches<D, Real>& touches_;
    const ContactFilter& filter_;

    collide::BoundingBox<D, Real> box_of(const Figure& figure) const {
        collide::BoundingBox<D, Real> box;
        Real widest = 0;
        for (const auto& id : figure.particles)
            if (const auto row = p_.handles.find(id))
                box.include(p_.position[*row]), widest = max(widest, p_.radius[*row]);
        return box.grown(widest);
    }
    void note(const Figure& figure, std::uint32_t index) {
        const auto& collider = world_.colliders[index];
        const BodyShape<D, Real> body(world_, figure);
        bool any = false;
        body.each_segment([&](Row a, Row b, Real radius) {
            if (any ||
                !collide::nearest_to_segment(collider.shape, collider.target, p_.position[a], p_.position[b], radius))
                return;
            any = true;
            add(a, index);
        });
        if (any) return;
        const auto point = point_of(collider);
        const Row row = point ? body.solid_around(*point) : body.none;
        if (row != body.none) add(row, index);
    }
    /// A touch, unless it is known from a particle on its way, or the program refuses it.
    void add(Row row, std::uint32_t index) {
        PendingContact contact{.particle = row, .collider = index};
        if (touches_.has(row, index) || filter_.ask(contact)) touches_.add(row, index, Real(0));
    }
    /// Some point of a shape that no line of the body meets: the whole shape is where the point is.
    static std::optional<Vec<D, Real>> point_of(const collide::Collider<D, Real>& collider) {
        const auto box = collide::bounds(collider.shape, collider.target);
        if (!(box.high[0] < box.huge)) return std::nullopt;
        const auto surface =
            collide::nearest(collider.shape, collider.target, (box.low + box.high) * Real(0.5), box.huge);
        return surface ? std::optional(surface->point) : std::nullopt;
    }
};

} // namespace sinew::detail
