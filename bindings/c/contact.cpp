#include "sinew/scene/text.h"
#include "sinew/world/colliders.h"

#include "bindings/c/native/sized.h"
#include "bindings/c/simulation.h"

#include <array>
#include <cmath>

/// Contacts of the last step, and colliders that code moves.
using namespace sinew;
using namespace sinew::c;

namespace {

/// Writes the sides of a contact; false if one of them is gone.
template <class WorldT> bool set_sides(const WorldT& world, const ColliderTouch& touch, sinew_contact& contact) {
    const auto& particles = world.particles.handles;
    const auto& colliders = world.collider_handles;
    if (!particles.in_use(touch.particle)) return false;
    const Row row = particles.row_at(touch.particle);
    contact.particle = number_of(particles.id_of(row));
    contact.figure = world.particles.figure[row];
    if (is_plane(touch.collider)) return contact.collider_name = bounds_name.data(), true;
    if (!colliders.in_use(touch.collider)) return false;
    const Row collider = colliders.row_at(touch.collider);
    contact.collider = number_of(colliders.id_of(collider));
    contact.collider_name = world.colliders[collider].name.c_str();
    return true;
}
template <class WorldT> bool set_sides(const WorldT& world, const FigureTouch& touch, sinew_contact& contact) {
    const auto& handles = world.particles.handles;
    if (!handles.in_use(touch.particle[0]) || !handles.in_use(touch.particle[1])) return false;
    contact.particle = number_of(handles.id_of(handles.row_at(touch.particle[0])));
    contact.other = number_of(handles.id_of(handles.row_at(touch.particle[1])));
    contact.figure = touch.first;
    contact.other_figure = touch.second;
    return true;
}

sinew_contact no_contact() {
    return {0, 0, 0, 0, SINEW_NO_ID, SINEW_NO_ID, SINEW_NO_ID, no_figure, no_figure, SINEW_BEGIN, "", {}, {}, 0};
}
sinew_point as_point(const std::array<double, 3>& numbers) {
    return {numbers[0], numbers[1], numbers[2]};
}

/// Calls visit(contact) for the touches of the last step, then for those that ended in it.
template <class WorldT, class Visit> void each_contact(const WorldT& world, Visit&& visit) {
    const auto present = [&](const auto& touches) {
        for (const auto& touch : touches) {
            auto contact = no_contact();
            if (!set_sides(world, touch, contact)) continue;
            contact.impulse = touch.strength.impulse;
            contact.blow = touch.strength.blow;
            contact.blow_before = touch.strength.blow_before;
            contact.phase = touch.strength.is_new ? SINEW_BEGIN : SINEW_PERSIST;
            contact.point = as_point(touch.place.point);
            contact.normal = as_point(touch.place.normal);
            contact.speed = touch.place.speed;
            visit(contact);
        }
    };
    present(world.contacts.touching);
    present(world.contacts.figures);
    for (const auto& event : world.events) {
        if (event.type != EventType::parted) continue;
        auto contact = no_contact();
        contact.phase = SINEW_END;
        contact.particle = number_of(event.particle);
        contact.figure = event.figure;
        contact.other_figure = event.other;
        if (event.other != no_figure) contact.other = number_of(event.other_particle);
        if (is_plane(event.collider.index)) contact.collider_name = bounds_name.data();
        if (const auto row = world.collider_handles.find(event.collider)) {
            contact.collider = number_of(event.collider);
            contact.collider_name = world.colliders[*row].name.c_str();
        }
        visit(contact);
    }
}

} // namespace

extern "C" {

sinew_status sinew_world_list_contacts(sinew_world simulation, uint32_t on) {
    if (on > 1) return fail(SINEW_BAD_ARGUMENT, "`on` is 0 or 1");
    return change(simulation, [&](Session& session) {
        std::visit([&](auto& world) { world.contacts.lists_figures = world.contacts.lists_planes = on != 0; },
                   session.world());
        return SINEW_OK;
    });
}

sinew_status sinew_world_contact_count(sinew_world simulation, uint32_t* count) {
    if (!count) return null_argument();
    return read(simulation, [&](Simulation& known, const Session& session) {
        known.contacts.clear();
        std::visit(
            [&](const auto& world) {
                each_contact(world, [&](const sinew_contact& contact) { known.contacts.push_back(contact); });
            },
            session.world());
        *count = std::uint32_t(known.contacts.size());
        return SINEW_OK;
    });
}

sinew_status sinew_world_contact_at(sinew_world simulation, uint32_t index, sinew_contact* contact) {
    if (const auto status = can_fill(contact)) return status;
    return read(simulation, [&](const Simulation& known, const Session&) {
        if (index >= known.contacts.size()) return fail(SINEW_NOT_FOUND, "there are fewer contacts");
        fill_sized(known.contacts[index], contact);
        return SINEW_OK;
    });
}

sinew_status sinew_world_find_collider(sinew_world simulation, const char* name, sinew_collider* collider) {
    if (!name || !collider) return null_argument();
    return read(simulation, [&](const Simulation&, const Session& session) {
        return std::visit(
            [&](const auto& world) {
                const auto found = collider_called(world, name);
                if (!found) return fail(SINEW_NOT_FOUND, concat("no collider is called ", in_quotes(name)));
                *collider = number_of(*found);
                return SINEW_OK;
            },
            session.world());
    });
}

sinew_status sinew_world_move_collider(sinew_world simulation, sinew_collider collider, sinew_point position,
                                       double turn, const sinew_point* axis) {
    if (!is_finite(position) || !std::isfinite(turn) || (axis && !is_finite(*axis))) return not_finite();
    return change(simulation, [&](Session& session) {
        return std::visit(
            [&]<int D, class Real>(World<D, Real>& world) {
                const collide::Pose<D, Real> pose{vector_of<D, Real>(position), rotation_of<D, Real>(turn, axis)};
                return move_collider(world, id_of<ColliderTag>(collider), pose) ? SINEW_OK : bad_id("collider");
            },
            session.world());
    });
}

} // extern "C"
