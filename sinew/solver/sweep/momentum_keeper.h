#pragma once

#include "sinew/solver/simd/kernel.h"
#include "sinew/solver/sweep_state.h"
#include "sinew/world/world.h"

#include <span>

/// Conservation of angular momentum of free bodies. Constraints act within a body, but an unfinished sweep, and
/// corrections along directions at the end of a substep, take w^2 h of its angular momentum a second. A rotation about
/// the centre of mass gives this back:
///
///     v <- v + w x r,        w = I^-1 (L - L'),
///
/// and where the kinetic energy about the centre would exceed what it was, the motion relative to the rotation of the
/// whole is slowed down. Sums are relative to one particle: the motion of the whole is no part of them.
namespace sinew::detail {

template <int D, class Real> class MomentumKeeper {
  public:
    MomentumKeeper(SweepState<D, Real>& state, const Kernels<D, Real>& kernels) : state_(state), kernels_(kernels) {}

    /// Notes the momenta before constraints act. `keep`: factor by which drag reduces velocities until the end.
    void note(std::span<FreeBody<D>> bodies, double keep) const {
        for (auto& body : bodies) {
            const auto before = moments_of(body);
            body.held = body.meets || before.mass >= immovable_mass;
            const double per_mass = inverse_or_zero(before.mass);
            body.spin = before.spin * (keep * per_mass);
            body.square = before.square * (square(keep) * per_mass);
        }
    }

    /// Gives back the momentum that constraints took, once positions have advanced.
    void restore(std::span<FreeBody<D>> bodies) const {
        for (const auto& body : bodies)
            if (!body.held && !touches(body)) restore(body);
    }

  private:
    SweepState<D, Real>& state_;
    const Kernels<D, Real>& kernels_;

    template <class Visit> void each(const FreeBody<D>& body, Visit&& visit) const {
        if (body.scattered)
            for (const Row slot : std::span(state_.bodies.slots).subspan(body.first, body.members)) visit(slot);
        else
            for (Row slot = body.first; slot < body.first + body.members; ++slot) visit(slot);
    }
    bool touches(const FreeBody<D>& body) const {
        bool found = false;
        if (!state_.bodies.touched.empty()) each(body, [&](Row slot) { found = found || state_.bodies.touched[slot]; });
        return found;
    }

    BodyColumns<D, Real> columns_of(const FreeBody<D>& body) const {
        const Row first = state_.bodies.first_of(body);
        return {.position = state_.position[0],
                .displacement = state_.displacement[0],
                .stride = state_.stride(),
                .mobility = state_.mobility,
                .slots = body.scattered ? state_.bodies.slots.data() + body.first : nullptr,
                .first = body.first,
                .count = body.members,
                .origin = cast<double>(state_.position_at(first)),
                .drift = cast<double>(state_.displacement_at(first))};
    }
    CentralMoments<D> moments_of(const FreeBody<D>& body) const {
        Moments<D> sums;
        kernels_.moments(columns_of(body), sums);
        return CentralMoments<D>(sums);
    }

    void restore(const FreeBody<D>& body) const {
        const auto now = moments_of(body);
        const auto spin = body.spin * now.mass;
        const auto rate_due = now.rate_of(spin), rate = now.rate_of(now.spin);
        const double rotation = dot(rate_due, spin), inner = now.square - dot(rate, now.spin);
        const double left = max(body.square * now.mass - rotation, 0.0);
        const double share = body.lossless && inner > left ? square_root(left * inverse_or_zero(inner)) : 1;
        const auto change = rate_due - rate * share;
        constexpr double max_turned = 1; // radians a substep; faster, no rotation is what was meant
        if (!(norm(change) <= max_turned)) return;
        const auto columns = columns_of(body);
        kernels_.turn(columns, {.rate = change,
                                .center = columns.origin + now.center,
                                .drift = columns.drift + now.velocity,
                                .loss = 1 - share,
                                .max = max_displacement(Real(1) / state_.per_h)});
    }
};

} // namespace sinew::detail
