#include "apps/play/deed.h"

#include "sinew/solver/edit.h"

namespace sinew::play {
namespace {

struct Doer {
    Session& session;

    void operator()(const PointAt& deed) const { session.point_at(deed.place); }
    void operator()(const Grab& deed) const { session.grab(deed.members, deed.place); }
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
                if (deed.position) set_position(world, deed.particle, deed.position->template as<D, Real>());
                if (deed.velocity) set_velocity(world, deed.particle, deed.velocity->template as<D, Real>());
                if (deed.mass) set_mass(world, deed.particle, Real(*deed.mass));
            },
            session.world());
    }
};

} // namespace

void carry_out(const Deed& deed, Session& session) {
    std::visit(Doer{session}, deed);
}

} // namespace sinew::play
