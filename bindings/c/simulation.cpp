#include "bindings/c/simulation.h"

#include "sinew/scene/text.h"
#include "sinew/session/session_snapshot.h"
#include "sinew/solver/simd/kernel.h"
#include "sinew/version.h"
#include "sinew/world/measure.h"

#include "bindings/c/reading.h"
#include "player/scene_edit.h"

#include <algorithm>
#include <cmath>

namespace sinew::c {

const Session* Simulation::session() const {
    if (own) return &*own;
    if (lent) return lent;
    if (!player || pane >= player->pane_count()) return nullptr;
    const Session* found = nullptr;
    player->each_pane([&] {
        if (player->active_pane() == pane) found = &player->session();
    });
    return found;
}

Handles<Simulation>& simulations() {
    static Handles<Simulation> open;
    return open;
}

json::Array numbers_of(const sinew_point& point, int dimension) {
    json::Array list{point.x, point.y};
    if (dimension == 3) list.emplace_back(point.z);
    return list;
}

bool is_finite(const sinew_point& point) {
    return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

sinew_point of_usable_length(const sinew_point& direction) {
    constexpr double shortest = 1e-12, longest = 1e12;
    const auto& [x, y, z] = direction;
    const double length = std::max({std::fabs(x), std::fabs(y), std::fabs(z)});
    if (length == 0 || (length > shortest && length < longest)) return direction;
    return {x / length, y / length, z / length};
}

std::uint64_t number_of(std::uint32_t slot, std::uint32_t generation) {
    return std::uint64_t(generation) << 32 | slot;
}

namespace {

constexpr int kind_bits = 5;
constexpr std::uint32_t max_slots = 1u << (32 - kind_bits);

sinew_status add(Session session, sinew_world* handle) {
    auto simulation = std::make_unique<Simulation>();
    simulation->own.emplace(std::move(session));
    auto options = simulation->own->options(); // of the simulation that was copied
    options.contact_filter = {};
    options.program_threads = {};
    simulation->own->set_options(options);
    simulation->own->leave_level(); // which the player calls for its own
    const auto id = simulations().add(std::move(simulation));
    if (id == 0) return fail(SINEW_FULL, "too many open simulations");
    handle->id = id;
    return SINEW_OK;
}

} // namespace

std::uint64_t number_of(const ConstraintId& id) {
    if (id.kind < 0 || id.id.index >= max_slots) return SINEW_NO_ID;
    return number_of(std::uint32_t(id.kind) * max_slots + id.id.index, id.id.generation);
}

sinew_status callback_is_running() {
    return fail(SINEW_READ_ONLY, "a callback must not change the simulation that calls it");
}

ConstraintId constraint_of(std::uint64_t number) {
    const auto slot = std::uint32_t(number);
    return {int(slot / max_slots), {slot % max_slots, std::uint32_t(number >> 32)}};
}

} // namespace sinew::c

using namespace sinew;
using namespace sinew::c;

namespace {

/// Takes the steps of work(session). Meanwhile the caller's threads, filter and allocator must not change the
/// simulation.
template <class Work> sinew_status advance(sinew_world handle, const Work& work) {
    auto* known = simulations().find(handle.id);
    return change_own(handle, [&](Session& session) {
        known->is_asking = true;
        work(session);
        known->is_asking = false;
        return SINEW_OK;
    });
}

} // namespace

extern "C" {

const char* sinew_version(void) {
    return SINEW_VERSION;
}

const char* sinew_simd(void) {
    return name_of(best_simd());
}

// --- opening ---------------------------------------------------------------------------------------------------------

sinew_status sinew_world_open(const char* scene, const sinew_open_options* options, sinew_world* simulation) {
    if (!simulation) return null_argument();
    SceneFile file;
    if (const auto status = SceneFile::read(scene, options, file)) return status;
    auto opened = file.open();
    return opened ? add(Session(std::move(*opened)), simulation) : SINEW_BAD_SCENE;
}

sinew_status sinew_check(const char* scene, const sinew_open_options* options) {
    SceneFile file;
    if (const auto status = SceneFile::read(scene, options, file)) return status;
    return file.open() ? SINEW_OK : SINEW_BAD_SCENE;
}

sinew_status sinew_world_copy(sinew_world simulation, sinew_world* copy) {
    if (!copy) return null_argument();
    return read(simulation, [&](const Simulation&, const Session& session) { return add(session, copy); });
}

sinew_status sinew_world_save(sinew_world simulation, const uint8_t** bytes, size_t* size) {
    if (!bytes || !size) return null_argument();
    return read(simulation, [&](Simulation& known, const Session& session) {
        known.saved = save(session);
        *bytes = reinterpret_cast<const uint8_t*>(known.saved.data());
        *size = known.saved.size();
        return SINEW_OK;
    });
}

sinew_status sinew_world_load(const uint8_t* bytes, size_t size, const sinew_open_options* options,
                              sinew_world* simulation) {
    if (!simulation || (!bytes && size > 0)) return null_argument();
    SceneFile file;
    if (const auto status = SceneFile::read("", options, file)) return status;
    forget_diagnostics();
    const auto open = [&](const std::string& scene, const std::string&) {
        file.text = scene;
        return file.open({});
    };
    SnapshotError error;
    auto session = session_of(std::as_bytes(std::span(bytes, size)), open, error);
    if (session) return add(std::move(*session), simulation);
    return error.what.empty() ? SINEW_BAD_SCENE : fail(SINEW_BAD_ARGUMENT, error.text());
}

sinew_status sinew_world_close(sinew_world simulation) {
    const auto* known = simulations().find(simulation.id);
    if (!known) return bad_handle();
    if (!known->own) return fail(SINEW_READ_ONLY, "the simulation is closed with its player");
    if (known->is_asking) return callback_is_running();
    simulations().remove(simulation.id);
    return SINEW_OK;
}

// --- time ------------------------------------------------------------------------------------------------------------

sinew_status sinew_world_restart(sinew_world simulation) {
    return change_own(simulation, [](Session& session) {
        session.restart();
        return SINEW_OK;
    });
}

sinew_status sinew_world_step(sinew_world simulation, uint32_t count) {
    return advance(simulation, [&](Session& session) {
        for (std::uint32_t i = 0; i < count; ++i) session.step();
    });
}

sinew_status sinew_world_run_until(sinew_world simulation, double seconds) {
    constexpr double most = 1e9; // as a scene's duration
    if (!(std::fabs(seconds) <= most)) return fail(SINEW_BAD_ARGUMENT, "a time is at most 1e9 seconds");
    return advance(simulation, [&](Session& session) { session.run_until(seconds); });
}

// --- the scene -------------------------------------------------------------------------------------------------------

sinew_status sinew_world_scene_text(sinew_world simulation, const char** json) {
    if (!json) return null_argument();
    return read(simulation, [&](Simulation& known, const Session& session) {
        known.text = play::text_of(session);
        *json = known.text.c_str();
        return SINEW_OK;
    });
}

sinew_status sinew_world_set(sinew_world simulation, const char* override_pair) {
    if (!override_pair) return null_argument();
    return change_own(simulation, [&](Session& session) {
        const std::array<Override, 1> overrides = {{{override_pair}}};
        auto edited = play::edited(session.scene(), overrides);
        if (const auto status = keep_diagnostics(edited.diagnostics)) return status;
        auto next = session; // an edit that loses something is not made
        const auto lost = next.become(std::move(*edited.scene));
        if (!lost.empty()) return fail(SINEW_BAD_ARGUMENT, lost);
        session = std::move(next);
        return SINEW_OK;
    });
}

} // extern "C"
