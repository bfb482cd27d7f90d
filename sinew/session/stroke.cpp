#include "sinew/session/stroke.h"

#include "sinew/world/edit.h"

namespace sinew {

void Stroke::go(AnyWorld& world, const Point& to) {
    std::visit(
        [&]<class WorldT>(WorldT& any) {
            using Real = typename WorldT::Real;
            constexpr int D = WorldT::dimension;
            auto& p = any.particles;
            const auto from = at.as<D, Real>(), way = to.as<D, Real>() - from;
            const auto velocity = way * (Real(haste) / any.settings.frame);
            for (Row row = 0; row < p.size(); ++row) {
                if (p.mobility[row] == Real(0)) continue;
                const auto along =
                    clamp(dot(p.position[row] - from, way) * inverse_or_zero(dot(way, way)), Real(0), Real(1));
                if (distance(p.position[row], from + way * along) < Real(radius))
                    set_velocity(any, p.handles.id_of(row), velocity);
            }
        },
        world);
    at = to;
}

bool strokes(const AnyWorld& world, double radius) {
    return radius > 0 && std::visit([](const auto& any) { return any.settings.mode == Mode::classic; }, world);
}

} // namespace sinew
