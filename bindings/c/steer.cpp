#include "sinew/session/steering.h"

#include "bindings/c/native/sized.h"
#include "bindings/c/simulation.h"

#include <cmath>

/// Controls of characters and cars.
using namespace sinew;
using namespace sinew::c;

namespace {

sinew_status no_controls() {
    return fail(SINEW_BAD_ARGUMENT, "the figure has no controls: prefabs \"character\" and \"car\" have");
}

} // namespace

extern "C" {

sinew_status sinew_world_steer(sinew_world simulation, uint32_t figure, const sinew_controls* given) {
    sinew_controls controls{};
    if (given)
        if (const auto status = take(given, controls)) return status;
    if (!std::isfinite(controls.along) || !std::isfinite(controls.up))
        return fail(SINEW_BAD_ARGUMENT, "a number is not finite");
    return change(simulation, [&](Session& session) {
        auto& steering = session.steering();
        if (!steering.steered(session.scene(), session.world(), FigureIndex(figure))) return no_controls();
        const Controls wanted{controls.along, controls.up, controls.jump != 0, controls.hold != 0};
        const auto id =
            std::visit([&](const auto& world) { return figure_id(world, FigureIndex(figure)); }, session.world());
        steering.set(id, given ? std::optional(wanted) : std::nullopt);
        return SINEW_OK;
    });
}

sinew_status sinew_world_get_footing(sinew_world simulation, uint32_t figure, sinew_footing* footing) {
    if (const auto status = can_fill(footing)) return status;
    return read(simulation, [&](const Simulation&, const Session& session) {
        const auto steered = session.steering().steered(session.scene(), session.world(), FigureIndex(figure));
        const auto* character = steered ? std::get_if<Character>(&*steered) : nullptr;
        if (!character) return fail(SINEW_BAD_ARGUMENT, "the figure is no character");
        const auto found = std::visit(
            [&]<class WorldT>(const WorldT& world) {
                if constexpr (WorldT::dimension == 2)
                    return footing_of(world, FigureIndex(figure), *character,
                                      typename WorldT::Real(step_length(session.scene())));
                else
                    return Footing{};
            },
            session.world());
        fill_sized(sinew_footing{0, found.on_ground ? 1u : 0u, found.is_holding ? 1u : 0u,
                                 found.figure == no_figure ? ~std::uint32_t(0) : std::uint32_t(found.figure)},
                   footing);
        return SINEW_OK;
    });
}

} // extern "C"
