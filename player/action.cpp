#include "player/deed.h"

#include "sinew/world/edit.h"

namespace sinew::play {
namespace {

struct EventApplier {
    Session& session;

    void operator()(const PointAt& deed) const { session.point_at(deed.place); }
    void operator()(const Grab& deed) const {
        std::vector<ParticleId> members;
        for (const Row row : deed.members) members.push_back(id_at(session.world(), row));
        session.grab(members, deed.place);
    }
    void operator()(const Drag& deed) const { session.drag(deed.place); }
    void operator()(const LetGo&) const { session.let_go(); }
    void operator()(const Slash& deed) const { session.cut(deed.line, {}, deed.look.view(session.scene())); }
    void operator()(const Become& deed) const { session.become(*deed.scene); }
    void operator()(const Return& deed) const { session = *deed.to; }
    void operator()(const Restart&) const { session.restart(); }
    void operator()(const Quicken& deed) const { session.quicken(deed.by); }
    void operator()(const Tweak& deed) const {
        std::visit(
            [&]<class WorldT>(WorldT& world) {
                using Real = typename WorldT::Real;
                constexpr int D = WorldT::dimension;
                const auto id = id_at(session.world(), deed.particle);
                if (deed.position) set_position(world, id, deed.position->template as<D, Real>());
                if (deed.velocity) set_velocity(world, id, deed.velocity->template as<D, Real>());
                if (deed.mass) set_mass(world, id, Real(*deed.mass));
            },
            session.world());
    }
};

} // namespace

ParticleId id_at(const AnyWorld& world, Row row) {
    return std::visit(
        [&](const auto& any) { return row < any.particles.size() ? any.particles.slots.id_of(row) : ParticleId{}; },
        world);
}

std::vector<Row> rows_of(const AnyWorld& world, std::span<const ParticleId> particles) {
    constexpr Row none = ~Row(0);
    std::vector<Row> rows;
    for (const auto id : particles)
        rows.push_back(std::visit([&](const auto& any) { return row_of(any, id).value_or(none); }, world));
    return rows;
}

void carry_out(const Action& deed, Session& session) {
    std::visit(EventApplier{session}, deed);
}

} // namespace sinew::play
