#include "sinew/session/session_snapshot.h"

#include "sinew/snapshot/archive.h"
#include "sinew/snapshot/world_snapshot.h"

#include <algorithm>

namespace sinew {
namespace snapshot {

template <> struct IsPacked<Point> : std::true_type {};

template <class Archive, class First, class Second> void archive(Archive& at, std::pair<First, Second>& pair) {
    archive_all(at, pair.first, pair.second);
}
template <class Archive> void archive(Archive& at, Controls& controls) {
    auto& [along, up, jump, hold] = controls;
    archive_all(at, along, up, jump, hold);
}
/// Version from which on a session's field is there.
template <class Field> inline constexpr std::uint32_t first_with = oldest_version;
template <> inline constexpr std::uint32_t first_with<Steering> = version_with_steering;
template <> inline constexpr std::uint32_t first_with<std::vector<PointerGrab>> = version_with_grabs;
template <> inline constexpr std::uint32_t first_with<AddedFigures> = version_with_added_figures;

template <class Archive> void archive(Archive& at, Steering::Known& known) {
    auto& [figure, steered, model] = known;
    archive_all(at, figure, steered);
    if constexpr (Archive::is_reading)
        if (at.version() < version_with_models) return;
    archive(at, model);
}
/// Parameters of a prefab.
template <class Archive, Record Prefab> void archive(Archive& at, Prefab& prefab) {
    Prefab::fields(prefab, [&](auto& parameter, const Field&) { archive(at, parameter); });
}
/// Types that list their own state.
template <class Archive, class T>
requires requires(T& value) {
    T::state(value, [](auto&...) {});
}
void archive(Archive& at, T& value) {
    T::state(value, [&](auto&... fields) { archive_all(at, fields...); });
}

} // namespace snapshot

namespace {

template <class WorldT> SnapshotHeader header_of(const WorldT&, SnapshotContent content) {
    return {WorldT::dimension, int(8 * sizeof(typename WorldT::Real)), content};
}

/// Reads the world of a frame into one of the type that the scene asks for.
std::optional<SnapshotError> read_world(const snapshot::Frame& frame, const SnapshotLimits& limits, AnyWorld& any) {
    return std::visit(
        [&]<class WorldT>(WorldT& world) -> std::optional<SnapshotError> {
            WorldT fresh;
            auto fault = snapshot::world_of(frame, limits.memory, fresh);
            if (!fault) world = std::move(fresh);
            return fault;
        },
        any);
}

} // namespace

void Session::name_gusts() {
    std::visit(
        [&](const auto& world) {
            for (auto& [force, until] : blowing_)
                force = force.index < world.forces.size() ? world.forces.id_of(force.index) : ForceId{};
        },
        world_);
}

bool Session::is_sound() const {
    const auto is_event = [&](const Due& due) {
        return due.event < scene_.events.size() && !scene_.events[due.event].on;
    };
    const auto is_driven = [&](const Driven& driven) {
        return driven.section < scene_.pins.size() && scene_.pins[driven.section].driver.has_value();
    };
    return std::ranges::all_of(due_, is_event) && std::is_heap(due_.begin(), due_.end()) &&
           std::ranges::all_of(driven_, is_driven) && rules_.is_of(scene_) && winder_.is_of(scene_) &&
           collider_moves_.is_of(scene_) && history_.is_of(scene_) && history_.is_sound() && steering_.is_of(scene_) &&
           happenings_.size() <= std::min(max_happenings, happening_count_);
}

std::vector<std::byte> save(const Session& session, std::string_view from) {
    std::vector<std::byte> own;
    snapshot::ByteWriter writer(own);
    auto text = json::to_text(to_json(session.scene()));
    auto path = std::string(from);
    archive_all(writer, text, path);
    Session::state(session, [&](const auto&... fields) {
        (archive(writer, const_cast<std::decay_t<decltype(fields)>&>(fields)), ...); // a writer changes nothing
    });
    return std::visit(
        [&](const auto& world) {
            const auto bytes = snapshot::bytes_of(world);
            return snapshot::framed(header_of(world, SnapshotContent::session), {bytes.fixed, bytes.moving, own});
        },
        session.world());
}

std::optional<Session> session_of(std::span<const std::byte> bytes, const SceneOpener& open, SnapshotError& error,
                                  const SnapshotLimits& limits) {
    const auto refused = [&](SnapshotError fault) {
        error = std::move(fault);
        return std::nullopt;
    };
    const auto frame = snapshot::unframed(bytes, error);
    if (!frame) return std::nullopt;
    if (frame->header.content != SnapshotContent::session) return refused({14, "a world without a session", {}});
    snapshot::ByteReader reader(frame->part[2], frame->at[2], limits.memory);
    reader.set_version(frame->version);
    std::string text, from;
    reader.enter("session", "scene");
    archive_all(reader, text, from);
    if (reader.failed()) return refused(reader.error());
    auto opened = open(text, from);
    if (!opened) return refused({});
    std::optional<Session> session(std::in_place, std::move(*opened));
    if (auto fault = read_world(*frame, limits, session->world())) return refused(std::move(*fault));
    reader.enter("session", "state");
    const auto read = [&]<class Field>(Field& field) {
        if (frame->version >= snapshot::first_with<Field>) archive(reader, field);
    };
    Session::state(*session, [&](auto&... fields) { (read(fields), ...); });
    if (frame->version < snapshot::version_with_force_ids) session->name_gusts();
    if (!reader.failed() && reader.left() > 0) reader.fail("more than a session");
    if (!reader.failed() && !session->is_sound()) reader.fail("an index of something that the scene has not");
    if (reader.failed()) return refused(reader.error());
    session->steering().pass_generations();
    session->added().pass_generations();
    return session;
}

} // namespace sinew
