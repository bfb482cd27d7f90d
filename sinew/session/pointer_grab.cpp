#include "sinew/session/pointer_grab.h"

#include "sinew/assert/assert.h"

#include <algorithm>

namespace sinew {
namespace {

/// Mass of the particle's figure, or of a single particle without a figure.
template <class WorldT> double lifted_mass(const WorldT& world, Row row) {
    const auto& p = world.particles;
    const auto figure = p.figure[row];
    if (figure == no_figure) return double(inverse_or_zero(p.inverse_mass[row]));
    double mass = 0;
    for (Row i = 0; i < p.size(); ++i)
        if (p.figure[i] == figure) mass += double(inverse_or_zero(p.inverse_mass[i]));
    return mass;
}

/// Light particle at `place`, joined to every member by a distance constraint.
template <class WorldT>
ParticleId add_handle(WorldT& world, std::span<const ParticleId> members, const Point& position) {
    using Real = typename WorldT::Real;
    constexpr int D = WorldT::dimension;
    constexpr Real lightness = Real(0.1); // mass over the lightest member's: less is ill-conditioned, more is felt
    Real mass = limit::mass<Real>;
    for (const auto id : members)
        if (const Real w = world.particles.inverse_mass[*row_of(world, id)]; w > Real(0))
            mass = min(mass, lightness / w);
    const auto handle = add_particle(world, {.position = position.as<D, Real>(), .mass = mass});
    for (const auto id : members) add<Distance>(world, {handle, id});
    return handle;
}

/// Movable particles of the first member's figure within `radius` of `place`, members excluded.
template <class WorldT>
std::vector<ParticleId> near(const WorldT& world, std::span<const ParticleId> members, const Point& position,
                             double radius) {
    using Real = typename WorldT::Real;
    std::vector<ParticleId> found;
    if (!(radius > 0)) return found;
    const auto& p = world.particles;
    SINEW_ASSERT(!members.empty(), "a hand holds a particle");
    const auto figure = p.figure[*row_of(world, members.front())];
    const auto middle = position.template as<WorldT::dimension, Real>();
    for (Row row = 0; row < p.size(); ++row) {
        if (p.figure[row] != figure || p.mobility[row] == Real(0)) continue;
        const auto id = p.handles.id_of(row);
        if (distance(p.position[row], middle) <= Real(radius) &&
            std::find(members.begin(), members.end(), id) == members.end())
            found.push_back(id);
    }
    return found;
}

} // namespace

std::optional<PointerGrab> PointerGrab::take(AnyWorld& world, std::span<const ParticleId> members,
                                             const Point& position, double acceleration, double radius, Hold hold) {
    return std::visit(
        [&]<class WorldT>(WorldT& any) -> std::optional<PointerGrab> {
            using Real = typename WorldT::Real;
            bool movable = false;
            for (const auto id : members) {
                const auto row = row_of(any, id);
                if (!row) return std::nullopt;
                movable = movable || any.particles.mobility[*row] > Real(0);
            }
            if (!movable) return std::nullopt;
            PointerGrab hand{.members = {members.begin(), members.end()}, .target = position};
            const double mass = lifted_mass(any, *row_of(any, members.front()));
            const auto others = near(any, members, position, radius);
            const PinSpec<WorldT::dimension, Real> grip{
                .max_force = Real(mass * acceleration / double(1 + others.size())), .hold = hold};
            auto held = members.front();
            if (members.size() > 1) hand.handle = held = add_handle(any, members, position);
            const auto pinned = sinew::pin(any, held, grip);
            if (!pinned) return std::nullopt;
            hand.pin = *pinned;
            for (const auto id : others) {
                Point offset;
                for (int i = 0; i < WorldT::dimension; ++i)
                    offset[i] = double((*position_of(any, id))[i]) - position[i];
                hand.along.push_back({*sinew::pin(any, id, grip), offset});
            }
            return hand;
        },
        world);
}

void PointerGrab::carry(AnyWorld& world) const {
    std::visit(
        [&]<class WorldT>(WorldT& any) {
            using Real = typename WorldT::Real;
            const auto carry = [&](PinId held, const Point& offset) {
                auto goal = target.as<WorldT::dimension, Real>() + offset.as<WorldT::dimension, Real>();
                for (const auto& plane : any.bounds) {
                    const Real below = plane.offset - dot(plane.normal, goal);
                    if (below > Real(0)) goal += plane.normal * below;
                }
                move_pin(any, held, goal);
            };
            carry(pin, {});
            for (const auto& [held, offset] : along) carry(held, offset);
        },
        world);
}

void PointerGrab::let_go(AnyWorld& world) const {
    std::visit(
        [&](auto& any) {
            unpin(any, pin);
            for (const auto& other : along) unpin(any, other.pin);
            if (handle) remove_particles(any, std::span(&*handle, 1));
        },
        world);
}

} // namespace sinew
