#include "player/action.h"

#include "sinew/world/edit.h"

#include <utility>

namespace sinew::play {
namespace {

struct EventApplier {
    Session& session;
    std::string lost{}; ///< why something did not go on

    void operator()(const PointAt& action) const { session.point_at(action.position); }
    void operator()(const Grab& action) const {
        std::vector<ParticleId> members;
        for (const Row row : action.members) members.push_back(id_at(session.world(), row));
        session.grab(members, action.position);
    }
    void operator()(const Drag& action) const { session.drag(action.position); }
    void operator()(const LetGo&) const { session.let_go(); }
    void operator()(const Slash& action) const { session.cut(action.line, {}, action.look.view(session.scene())); }
    void operator()(const Become& action) { lost = session.become(*action.scene); }
    void operator()(const Return& action) const { session = *action.to; }
    void operator()(const Restart&) const { session.restart(); }
    void operator()(const Quicken& action) const { session.quicken(action.by); }
    void operator()(const Tweak& action) const {
        std::visit(
            [&]<class WorldT>(WorldT& world) {
                using Real = typename WorldT::Real;
                constexpr int D = WorldT::dimension;
                const auto id = id_at(session.world(), action.particle);
                if (action.position) set_position(world, id, action.position->template as<D, Real>());
                if (action.velocity) set_velocity(world, id, action.velocity->template as<D, Real>());
                if (action.mass) set_mass(world, id, Real(*action.mass));
            },
            session.world());
    }
    void operator()(const Steer& action) const { session.steering().play(action.controls); }
};

} // namespace

ParticleId id_at(const AnyWorld& world, Row row) {
    return std::visit(
        [&](const auto& any) { return row < any.particles.size() ? any.particles.handles.id_of(row) : ParticleId{}; },
        world);
}

std::vector<Row> rows_of(const AnyWorld& world, std::span<const ParticleId> particles) {
    constexpr Row none = ~Row(0);
    std::vector<Row> rows;
    for (const auto id : particles)
        rows.push_back(std::visit([&](const auto& any) { return row_of(any, id).value_or(none); }, world));
    return rows;
}

std::string carry_out(const Action& action, Session& session) {
    EventApplier applier{session};
    std::visit(applier, action);
    return std::move(applier.lost);
}

} // namespace sinew::play
