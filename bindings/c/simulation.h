#pragma once

#include "sinew/picture/picture.h"
#include "sinew/session/session.h"

#include "bindings/c/failure.h"
#include "bindings/c/handles.h"
#include "player/play.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sinew::c {

/// A picture as handed out.
struct Drawn {
    Picture picture;
    std::vector<sinew_item> items;

    /// Copies the items into plain structs and fills `out` with views.
    void hand_out(sinew_picture& out);
};

struct UserData; // native/user_data.cpp

/// Threads of the caller: a function for all tasks of a step, or two for each of them, or none.
struct Tasks {
    sinew_parallel parallel = nullptr;
    sinew_enqueue enqueue = nullptr;
    sinew_finish finish = nullptr;
    void* context = nullptr;
};

/// A simulation: a session of its own, one that is lent for the length of a call, or one of a player's panes.
struct Simulation {
    std::optional<Session> own;
    Session* lent = nullptr;
    play::Play* player = nullptr; ///< outlives the simulation
    std::size_t pane = 0;
    Drawn drawn{};
    std::string text{};                    ///< last text handed out
    std::vector<std::byte> saved{};        ///< last snapshot handed out
    std::vector<std::uint32_t> rows{};     ///< last column of rows handed out
    std::vector<double> numbers{};         ///< last column of computed numbers handed out
    std::vector<sinew_contact> contacts{}; ///< as last counted
    std::shared_ptr<UserData> user_data{}; ///< none before the first
    struct Filter {
        sinew_contact_filter ask = nullptr;
        void* context = nullptr;
    };
    Filter filter{};        ///< of contacts, by the caller
    Tasks tasks{};          ///< the solver has their address
    bool is_asking = false; ///< it steps: a callback of the caller's may be running

    /// Null if the player has no such pane, and for one that is lent between calls.
    const Session* session() const;
    /// The session that the caller may change; null: a player's.
    Session* changeable() { return own ? &*own : lent; }
};

Handles<Simulation>& simulations();

/// Status of changes that a callback of a step asks for.
sinew_status callback_is_running();

/// Calls work(simulation, session) with a const session and returns its status; fails for an unknown handle.
template <class Work> sinew_status read(sinew_world handle, const Work& work) {
    auto* simulation = simulations().find(handle.id);
    const auto* session = simulation ? simulation->session() : nullptr;
    return session ? work(*simulation, *session) : bad_handle();
}

/// Calls work(session); fails for an unknown handle and for a simulation of a player.
template <class Work> sinew_status change(sinew_world handle, const Work& work) {
    auto* simulation = simulations().find(handle.id);
    if (!simulation || !simulation->session()) return bad_handle();
    auto* session = simulation->changeable();
    if (!session) return fail(SINEW_READ_ONLY, "the simulation belongs to a player, which alone may change it");
    if (simulation->is_asking) return callback_is_running();
    return work(*session);
}

/// The same for changes that only the owner of the session may make: steps, another scene.
template <class Work> sinew_status change_own(sinew_world handle, const Work& work) {
    const auto* simulation = simulations().find(handle.id);
    if (simulation && simulation->lent)
        return fail(SINEW_READ_ONLY, "the player of the level takes the steps, and opens the scenes");
    return change(handle, work);
}

inline Point point_of(const sinew_point& point) {
    return {{point.x, point.y, point.z}};
}
template <int D, class Real> Vec<D, Real> vector_of(const sinew_point& point) {
    return point_of(point).as<D, Real>();
}
/// As a scene states it.
json::Array numbers_of(const sinew_point& point, int dimension);
bool is_finite(const sinew_point& point);
/// The same direction, by a vector whose square neither overflows nor vanishes, even in float.
sinew_point of_usable_length(const sinew_point& direction);
/// Rotation by an angle; in space about an axis, or about z if there is none.
template <int D, class Real> collide::Rotation<D, Real> rotation_of(double angle, const sinew_point* axis) {
    if constexpr (D == 2) {
        return collide::Rotation<2, Real>::of(Real(angle));
    } else {
        const auto given = axis ? vector_of<3, Real>(of_usable_length(*axis)) : Vec<3, Real>{};
        return collide::Rotation<3, Real>::of(given == Vec<3, Real>{} ? Vec<3, Real>::axis(2) : given, Real(angle));
    }
}

/// Ids as numbers: slot and generation; of constraints also the kind.
std::uint64_t number_of(std::uint32_t slot, std::uint32_t generation);
template <class Tag> std::uint64_t number_of(Id<Tag> id) {
    return number_of(id.index, id.generation);
}
template <class Tag> Id<Tag> id_of(std::uint64_t number) {
    return {std::uint32_t(number), std::uint32_t(number >> 32)};
}
std::uint64_t number_of(const ConstraintId& id);
ConstraintId constraint_of(std::uint64_t number);

} // namespace sinew::c
