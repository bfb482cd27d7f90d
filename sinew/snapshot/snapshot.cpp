#include "sinew/snapshot/snapshot.h"

#include "sinew/snapshot/check_world.h"
#include "sinew/snapshot/world_snapshot.h"
#include "sinew/snapshot/world_visitors.h"

namespace sinew {
namespace snapshot {
namespace {

/// Generations that came with a file are not given out again.
template <int D, class Real> void pass_generations(const World<D, Real>& world) {
    world.particles.handles.pass_generations();
    world.pin_handles.pass_generations();
    world.collider_handles.pass_generations();
    world.forces.pass_generations();
    for_each_table(world, [](const auto& table) { table.handles.pass_generations(); });
    for (const auto& figure : world.figures) Stamp::pass(figure.generation);
}

} // namespace

template <int D, class Real> WorldBytes bytes_of(const World<D, Real>& world) {
    WorldBytes bytes;
    ByteWriter fixed(bytes.fixed), moving(bytes.moving);
    visit_fields(world, FieldWriter(&fixed, moving));
    return bytes;
}

template <int D, class Real>
std::optional<SnapshotError> world_of(const Frame& frame, std::uint64_t memory, World<D, Real>& world) {
    if (frame.header.dimension != D || frame.header.precision != int(8 * sizeof(Real)))
        return SnapshotError{12, "a world of another dimension or precision", {}};
    ByteReader fixed(frame.part[0], frame.at[0], memory), moving(frame.part[1], frame.at[1], memory);
    moving.set_version(frame.version);
    visit_fields(world, FieldReader(&fixed, moving));
    for (auto* part : {&fixed, &moving}) {
        part->enter("", "");
        if (!part->failed() && part->left() > 0) part->fail("more than a world");
        if (part->failed()) return part->error();
    }
    if (const auto fault = WorldCheck(world).run()) return SnapshotError{frame.at[1], fault->what, fault->field};
    pass_generations(world);
    world.events.reserve(events_per_step);
    for_each_table(world, [&](auto& table) {
        bool any = false;
        for_each_table(world, [&](const auto& other) { any = any || other.may_tear(); });
        if (any) table.expect_tears();
    });
    return std::nullopt;
}

} // namespace snapshot

template <int D, class Real> std::vector<std::byte> save(const World<D, Real>& world) {
    const auto bytes = snapshot::bytes_of(world);
    return snapshot::framed({D, int(8 * sizeof(Real)), SnapshotContent::world}, {bytes.fixed, bytes.moving, {}});
}

template <int D, class Real>
std::optional<SnapshotError> restore(World<D, Real>& world, std::span<const std::byte> bytes,
                                     const SnapshotLimits& limits) {
    SnapshotError error;
    const auto frame = snapshot::unframed(bytes, error);
    if (!frame) return error;
    World<D, Real> fresh;
    if (auto fault = snapshot::world_of(*frame, limits.memory, fresh)) return fault;
    world = std::move(fresh);
    return std::nullopt;
}

#define SINEW_SNAPSHOT(D, Real)                                                                                        \
    template snapshot::WorldBytes snapshot::bytes_of(const World<D, Real>&);                                           \
    template std::optional<SnapshotError> snapshot::world_of(const snapshot::Frame&, std::uint64_t, World<D, Real>&);  \
    template std::vector<std::byte> save(const World<D, Real>&);                                                       \
    template std::optional<SnapshotError> restore(World<D, Real>&, std::span<const std::byte>, const SnapshotLimits&);
SINEW_INSTANTIATE(SINEW_SNAPSHOT)

} // namespace sinew
