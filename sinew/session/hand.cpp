#include "sinew/session/hand.h"

#include <algorithm>

namespace sinew {
namespace {

/// What a hand at that particle would lift: its figure, or itself where it has none.
template <class WorldT> double lifted_mass(const WorldT& world, Row row) {
    const auto& p = world.particles;
    const auto figure = p.figure[row];
    if (figure == no_figure) return double(inverse_or_zero(p.inverse_mass[row]));
    double mass = 0;
    for (Row i = 0; i < p.size(); ++i)
        if (p.figure[i] == figure) mass += double(inverse_or_zero(p.inverse_mass[i]));
    return mass;
}

/// A particle that is to `place` as a corner is to its shape.
template <class WorldT> ParticleId add_handle(WorldT& world, std::span<const ParticleId> members, const Point& place) {
    using Real = typename WorldT::Real;
    constexpr int D = WorldT::dimension;
    constexpr Real lightness = Real(0.1); // of the lightest member: lighter is harder to solve, heavier is felt
    Real mass = limit::mass<Real>;
    for (const auto id : members)
        if (const Real w = world.particles.inverse_mass[*row_of(world, id)]; w > Real(0))
            mass = minimum(mass, lightness / w);
    const auto handle = add_particle(world, {.position = place.as<D, Real>(), .mass = mass});
    for (const auto id : members) add<Distance>(world, {handle, id});
    return handle;
}

} // namespace

std::optional<Hand> Hand::take(AnyWorld& world, std::span<const ParticleId> members, const Point& place,
                               double acceleration) {
    return std::visit(
        [&]<class WorldT>(WorldT& any) -> std::optional<Hand> {
            using Real = typename WorldT::Real;
            bool movable = false;
            for (const auto id : members) {
                const auto row = row_of(any, id);
                if (!row) return std::nullopt;
                movable = movable || any.particles.mobility[*row] > Real(0);
            }
            if (!movable) return std::nullopt;
            Hand hand{.members = {members.begin(), members.end()}, .target = place};
            const double mass = lifted_mass(any, *row_of(any, members.front()));
            auto held = members.front();
            if (members.size() > 1) hand.handle = held = add_handle(any, members, place);
            const auto pinned =
                sinew::pin(any, held, PinSpec<WorldT::dimension, Real>{.max_force = Real(mass * acceleration)});
            if (!pinned) return std::nullopt;
            hand.pin = *pinned;
            return hand;
        },
        world);
}

void Hand::carry(AnyWorld& world) const {
    std::visit(
        [&]<class WorldT>(WorldT& any) {
            using Real = typename WorldT::Real;
            auto goal = target.as<WorldT::dimension, Real>();
            for (const auto& plane : any.bounds) {
                const Real below = plane.offset - dot(plane.normal, goal);
                if (below > Real(0)) goal += plane.normal * below;
            }
            move_pin(any, pin, goal);
        },
        world);
}

void Hand::let_go(AnyWorld& world) const {
    std::visit(
        [&](auto& any) {
            unpin(any, pin);
            if (handle) remove_particles(any, std::span(&*handle, 1));
        },
        world);
}

} // namespace sinew
