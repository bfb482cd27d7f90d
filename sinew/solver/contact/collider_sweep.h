#pragma once

#include "sinew/collide/moving_collider.h"
#include "sinew/solver/contact/plane_contact.h"

#include <array>
#include <optional>

/// Contact of swept particles with colliders, in one substep.
namespace sinew::detail {

/// Layers of a particle's figure; loose particles touch everything.
template <int D, class Real> collide::Filter filter_of(const World<D, Real>& world, Row row) {
    const auto figure = world.particles.figure[row];
    return figure < world.figures.size() ? world.figures[figure].filter : collide::Filter{};
}

template <int D, class Real> class ColliderSweep {
  public:
    ColliderSweep(World<D, Real>& world, Solver<D, Real>& solver, const PlaneContact<D, Real>& contact,
                  SubstepMover<D, Real>& mover, Real from_share, Real to_share)
        : world_(world), sweep_state_(solver.sweep_state), touches_(solver.touches), contact_(contact), mover_(mover),
          from_(from_share), to_(to_share) {}

    /// Keeps the particles of slots [first, last) out of all colliders.
    void keep_out(Row first, Row last) const {
        BoxT around;
        for (Row slot = first; slot < last; ++slot) include(around, slot);
        around = around.grown(sweep_state_.largest_radius + rounding_of(around));
        for (std::uint32_t i = 0; i < world_.colliders.size(); ++i)
            if (touches_.boxes[i].overlaps(around)) keep_out(i, first, last);
    }

  private:
    using BoxT = collide::BoundingBox<D, Real>;
    World<D, Real>& world_;
    const SweepState<D, Real>& sweep_state_;
    ColliderTouches<D, Real>& touches_;
    const PlaneContact<D, Real>& contact_;
    SubstepMover<D, Real>& mover_;
    Real from_, to_; ///< fractions of the step at the ends of the substep

    /// Width of a gap between flush solids.
    static Real rounding_of(const BoxT& box) {
        return Real(64) * std::numeric_limits<Real>::epsilon() * (norm(box.low) + norm(box.high));
    }
    void include(BoxT& box, Row slot) const {
        box.include(sweep_state_.position_at(slot));
        box.include(mover_.point_at(slot));
    }

    void keep_out(std::uint32_t index, Row first, Row last) const {
        const auto& collider = world_.colliders[index];
        for (Row slot = first; slot < last; ++slot) {
            const Row row = sweep_state_.row_of[slot];
            BoxT near;
            include(near, slot);
            const Real radius = world_.particles.radius[row];
            const auto filter = filter_of(world_, row);
            if (sweep_state_.mobility[slot] == Real(0) ||
                !touches_.boxes[index].overlaps(near.grown(radius + rounding_of(near))) ||
                !touch(collider.filter, filter))
                continue;
            const collide::Cover<D, Real, Real> cover(world_.colliders, touches_.boxes, to_, filter);
            const collide::MovingCollider<D, Real> moving(collider, from_, to_, mover_.h, cover);
            std::array<Held, most_held> held;
            std::size_t count = 0;
            moving.contacts(sweep_state_.position_at(slot), mover_.point_at(slot), radius, [&](const auto& contact) {
                if (const auto plane = resolve(index, slot, contact); plane && count < most_held)
                    held[count++] = {*plane, contact.begun_depth};
            });
            if (count > 1)
                contact_.settle(std::span<const Held>(held.data(), count), slot, [&](Real stopped) {
                    touches_.add(row, index, stopped * inverse_or_zero(sweep_state_.mobility[slot]) * mover_.per_h);
                });
        }
    }

    /// Surface that holds a particle, and the depth behind it at the start of the substep.
    struct Held {
        HalfSpace<D, Real> plane{};
        Real begun = 0;
    };
    static constexpr std::size_t most_held = 16;

    /// The surface that has held the particle, if any.
    std::optional<HalfSpace<D, Real>> resolve(std::uint32_t index, Row slot,
                                              const collide::ColliderContact<D, Real>& contact) const {
        const auto& collider = world_.colliders[index];
        const auto& surface = contact.surface;
        Real stopped = 0;
        const auto motion = sweep_state_.displacement_at(slot) - contact.surface_displacement;
        const Real speed = -dot(surface.normal, motion) * mover_.per_h;
        const HalfSpace<D, Real> plane{surface.normal, dot(surface.normal, surface.point)};
        auto rub = surface_between(world_, sweep_state_.row_of[slot], collider);
        if (collider.is_sensor) {
            if (!contact_.is_admitted(plane, slot, contact.surface_displacement, index, rub)) return std::nullopt;
        } else {
            if (contact_.is_held(slot) && !contact_.is_admitted(plane, slot, contact.surface_displacement, index, rub))
                return std::nullopt;
            stopped = contact_.keep_in(plane, rub, slot, contact.surface_displacement, contact.begun_depth, index + 1);
        }
        touches_.add(sweep_state_.row_of[slot], index,
                     stopped * inverse_or_zero(sweep_state_.mobility[slot]) * mover_.per_h,
                     {surface.point, surface.normal, speed});
        return contact_.is_held(slot) && !collider.is_sensor ? std::optional(plane) : std::nullopt;
    }
};

} // namespace sinew::detail
