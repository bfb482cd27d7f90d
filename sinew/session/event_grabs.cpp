#include "sinew/session/event_grabs.h"

#include "sinew/assert/assert.h"

namespace sinew {

bool EventGrabs::begin(AnyWorld& any, const Scene& scene, const GrabEvent& grab) {
    release(any, grab.particle);
    return std::visit(
        [&]<class WorldT>(WorldT& world) {
            const auto id = find_particle(world, grab.particle);
            if (!id) return false;
            Point from;
            for (int i = 0; i < WorldT::dimension; ++i) from[i] = double((*position_of(world, *id))[i]);
            Held held{grab.particle, {}, from, grab.to.value_or(from), world.time, grab.duration};
            if (strokes(any, grab.within)) {
                held.stroke = Stroke{from, grab.within, scene.pointer.grab_gain};
                held_.push_back(held);
                return true;
            }
            using Real = typename WorldT::Real;
            held.pin = *pin(world, *id, grab.grip.spec<WorldT::dimension, Real>(hold_rule(scene)));
            held_.push_back(held);
            if (grab.within > 0) hold_around(world, scene, *id, grab, held);
            return true;
        },
        any);
}

/// Pins the particles of the same figure within the grab's radius, each at a constant offset from the grabbed particle.
template <class WorldT>
void EventGrabs::hold_around(WorldT& world, const Scene& scene, ParticleId middle, const GrabEvent& grab,
                             const Held& held) {
    using Real = typename WorldT::Real;
    SINEW_ASSERT(row_of(world, middle).has_value(), "the grabbed particle exists");
    const auto position = *position_of(world, middle);
    const auto figure = world.particles.figure[*row_of(world, middle)];
    for (Row row = 0; row < world.particles.size(); ++row) {
        const auto offset = world.particles.position[row] - position;
        if (world.particles.figure[row] != figure || !(norm(offset) <= Real(grab.within))) continue;
        const auto id = world.particles.handles.id_of(row);
        if (id == middle || world.particles.mobility[row] == Real(0)) continue;
        auto near = held;
        for (int i = 0; i < WorldT::dimension; ++i) {
            near.from[i] += double(offset[i]);
            near.to[i] += double(offset[i]);
        }
        near.pin = *pin(world, id, grab.grip.spec<WorldT::dimension, Real>(hold_rule(scene)));
        held_.push_back(near);
    }
}

void EventGrabs::release(AnyWorld& any, const std::string& particle) {
    std::visit(
        [&](auto& world) {
            std::erase_if(held_, [&](const Held& held) {
                if (held.particle != particle) return false;
                unpin(world, held.pin);
                return true;
            });
        },
        any);
}

void EventGrabs::release_all(AnyWorld& any) {
    std::visit(
        [&](auto& world) {
            for (const auto& held : held_) unpin(world, held.pin);
        },
        any);
    held_.clear();
}

void EventGrabs::carry(AnyWorld& any, double step) {
    std::visit(
        [&]<class WorldT>(WorldT& world) {
            using Real = typename WorldT::Real;
            const double then = world.time + step;
            for (auto& held : held_) {
                const double share = held.duration > 0 ? clamp((then - held.since) / held.duration, 0.0, 1.0) : 1.0;
                Point position;
                for (int i = 0; i < 3; ++i) position[i] = held.from[i] + (held.to[i] - held.from[i]) * share;
                if (held.stroke)
                    held.stroke->go(any, position);
                else
                    move_pin(world, held.pin, position.template as<WorldT::dimension, Real>());
            }
        },
        any);
}

void EventGrabs::go_on(AnyWorld& any, const AnyWorld& old) {
    std::visit(
        [&]<class WorldT>(WorldT& world) {
            const auto* before = std::get_if<WorldT>(&old);
            std::erase_if(held_, [&](Held& held) {
                if (held.stroke) return false;
                const auto id = find_particle(world, held.particle);
                const auto row = before ? before->pin_handles.find(held.pin) : std::nullopt;
                if (!id || !row) return true;
                const auto& old_pin = before->pins[*row];
                if (find_particle(*before, held.particle) != old_pin.particle) return true; // held along with another
                const auto again = pin(world, *id, spec_of(old_pin));
                if (again) held.pin = *again;
                return !again;
            });
        },
        any);
}

std::vector<PinId> EventGrabs::pins() const {
    std::vector<PinId> all;
    for (const auto& held : held_)
        if (!held.stroke) all.push_back(held.pin);
    return all;
}

std::vector<ParticleId> EventGrabs::particles(const AnyWorld& any) const {
    std::vector<ParticleId> all;
    std::visit(
        [&](const auto& world) {
            for (const auto& held : held_)
                if (const auto id = find_particle(world, held.particle)) all.push_back(*id);
        },
        any);
    return all;
}

} // namespace sinew
