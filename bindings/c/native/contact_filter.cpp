#include "sinew/solver/contact_filter.h"

#include "bindings/c/simulation.h"

#include <utility>

/// Contacts filtered and changed by the caller.
using namespace sinew;
using namespace sinew::c;

namespace {

template <class WorldT> sinew_pending_contact in_c(const WorldT& world, const PendingContact& contact) {
    const auto& particles = world.particles;
    const auto of_row = [&](Row row) {
        return row == PendingContact::none ? SINEW_NO_ID : number_of(particles.handles.id_of(row));
    };
    const auto figure_of = [&](Row row) { return row == PendingContact::none ? no_figure : particles.figure[row]; };
    return {.struct_size = sizeof(sinew_pending_contact),
            .figure = figure_of(contact.particle),
            .particle = of_row(contact.particle),
            .other = of_row(contact.other),
            .collider = contact.collider == PendingContact::none
                            ? SINEW_NO_ID
                            : number_of(world.collider_handles.id_of(contact.collider)),
            .other_figure = figure_of(contact.other),
            .reserved = 0,
            .normal = {contact.normal[0], contact.normal[1], contact.normal[2]},
            .gap = contact.gap,
            .speed = contact.speed,
            .friction = contact.friction,
            .bounce = contact.restitution};
}

/// Asks the caller, in whose terms the contact is; meanwhile the simulation must not be changed. An exception
/// of the caller's in C++ ends here.
bool ask(void* context, PendingContact& contact) noexcept {
    auto& known = *static_cast<Simulation*>(context);
    const auto* session = known.session();
    if (!session || !known.filter.ask) return true;
    auto given = std::visit([&](const auto& world) { return in_c(world, contact); }, session->world());
    const bool before = std::exchange(known.is_asking, true);
    const bool admits = known.filter.ask(known.filter.context, &given) != 0;
    known.is_asking = before;
    contact.friction = given.friction, contact.restitution = given.bounce;
    return admits;
}

} // namespace

extern "C" {

sinew_status sinew_world_set_contact_filter(sinew_world simulation, sinew_contact_filter filter, void* context) {
    auto* known = simulations().find(simulation.id);
    return change(simulation, [&](Session& session) {
        known->filter = {filter, context};
        session.set_contact_filter(filter ? ContactFilter{ask, known} : ContactFilter{});
        return SINEW_OK;
    });
}

} // extern "C"
