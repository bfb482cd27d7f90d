#include "sinew/session/pick.h"
#include "sinew/session/pick_along.h"

#include "bindings/c/simulation.h"

#include <cmath>

/// The pointer: its grab and its cut; and grabs beside it.
using namespace sinew;
using namespace sinew::c;

namespace {

sinew_status nothing_there() {
    return fail(SINEW_NOT_FOUND, "nothing that could move is there");
}
sinew_status cannot_move() {
    return fail(SINEW_NOT_FOUND, "the particle cannot move");
}

/// The pixel of a position in the view that the scene asks for, and the pixels of `radius`.
std::optional<View::Seen> seen_in(const Session& session, const View& view, const sinew_point& at) {
    return session.scene().dimension == 2 ? view.see(point_of(at).as<3, double>()) : std::nullopt;
}

View own_view(const Session& session) {
    const auto& size = session.scene().view.size;
    return session.view(size[0], size[1]);
}

std::optional<PickedAlong> pick_along(const Session& session, const sinew_point& from, const sinew_point& to,
                                      double radius) {
    return std::visit([&](const auto& world) { return sinew::pick_along(world, point_of(from), point_of(to), radius); },
                      session.world());
}

/// Calls grab(members, position) for what is at a place: in 2D also a point between several particles.
template <class Grab>
sinew_status grab_at(const Session& session, const sinew_point& at, double radius, const Grab& grab) {
    const auto view = own_view(session);
    const auto seen = seen_in(session, view, at);
    const auto picked =
        seen ? pick(session.world(), view, cast<double>(seen->pixel), radius * double(seen->scale)) : std::nullopt;
    return picked && grab(picked->members, picked->position) ? SINEW_OK : nothing_there();
}

/// Calls grab(members, position) for a particle, whose status is that of success or failure.
template <class Grab> sinew_status grab_one(const Session& session, ParticleId particle, const Grab& grab) {
    const std::span members(&particle, 1);
    const auto position = position_of(session.world(), members);
    if (!position) return bad_id("particle");
    return grab(members, *position) ? SINEW_OK : cannot_move();
}

} // namespace

extern "C" {

sinew_status sinew_world_pick(sinew_world simulation, sinew_point from, sinew_point to, double radius,
                              sinew_particle* particle, double* share) {
    if (!particle) return null_argument();
    if (!is_finite(from) || !is_finite(to) || !(radius >= 0)) return not_finite();
    return read(simulation, [&](const Simulation&, const Session& session) {
        const auto picked = ::pick_along(session, from, to, radius);
        if (!picked) return nothing_there();
        *particle = number_of(picked->particle);
        if (share) *share = picked->share;
        return SINEW_OK;
    });
}

// --- the pointer -----------------------------------------------------------------------------------------------------

sinew_status sinew_world_grab(sinew_world simulation, sinew_point at, double radius) {
    if (!is_finite(at) || !(radius >= 0)) return not_finite();
    return change(simulation, [&](Session& session) {
        const auto grab = [&](auto members, const Point& position) { return session.grab(members, position); };
        if (session.scene().dimension == 2) return grab_at(session, at, radius, grab);
        const auto picked = ::pick_along(session, at, at, radius);
        return picked ? grab_one(session, picked->particle, grab) : nothing_there();
    });
}

sinew_status sinew_world_grab_particle(sinew_world simulation, sinew_particle particle) {
    return change(simulation, [&](Session& session) {
        return grab_one(session, id_of<ParticleTag>(particle),
                        [&](auto members, const Point& position) { return session.grab(members, position); });
    });
}

sinew_status sinew_world_drag(sinew_world simulation, sinew_point to) {
    if (!is_finite(to)) return not_finite();
    return change(simulation, [&](Session& session) {
        session.drag(point_of(to));
        return SINEW_OK;
    });
}

sinew_status sinew_world_let_go(sinew_world simulation) {
    return change(simulation, [](Session& session) {
        session.let_go();
        return SINEW_OK;
    });
}

sinew_status sinew_world_point_at(sinew_world simulation, sinew_point at) {
    if (!is_finite(at)) return not_finite();
    return change(simulation, [&](Session& session) {
        session.point_at(point_of(at));
        return SINEW_OK;
    });
}

sinew_status sinew_world_cut(sinew_world simulation, sinew_point from, sinew_point to, uint32_t* count) {
    if (!is_finite(from) || !is_finite(to)) return not_finite();
    return change(simulation, [&](Session& session) {
        const auto cut = session.cut({point_of(from), point_of(to)});
        if (count) *count = std::uint32_t(cut);
        return SINEW_OK;
    });
}

// --- grabs beside the pointer ----------------------------------------------------------------------------------------

sinew_status sinew_world_add_grab(sinew_world simulation, sinew_particle particle, sinew_grab* grab) {
    if (!grab) return null_argument();
    return change(simulation, [&](Session& session) {
        return grab_one(session, id_of<ParticleTag>(particle), [&](auto members, const Point& position) {
            const auto held = session.hold(members, position);
            if (held) *grab = number_of(*held);
            return held.has_value();
        });
    });
}

sinew_status sinew_world_move_grab(sinew_world simulation, sinew_grab grab, sinew_point to) {
    if (!is_finite(to)) return not_finite();
    return change(simulation, [&](Session& session) {
        return session.carry(id_of<PinTag>(grab), point_of(to)) ? SINEW_OK : bad_id("grab");
    });
}

sinew_status sinew_world_remove_grab(sinew_world simulation, sinew_grab grab) {
    return change(simulation,
                  [&](Session& session) { return session.release(id_of<PinTag>(grab)) ? SINEW_OK : bad_id("grab"); });
}

} // extern "C"
