#include "sinew/world/colliders.h"

#include "bindings/c/native/collider_shape.h"
#include "bindings/c/native/sized.h"
#include "bindings/c/simulation.h"

#include <cmath>
#include <cstddef>

/// Colliders added by calls.
using namespace sinew;
using namespace sinew::c;

namespace {

/// Reason why a number beside the shape is not possible; null if all are.
const char* problem_of(const sinew_collider_spec& spec) {
    if (!is_finite(spec.position) || !is_finite(spec.axis) || !std::isfinite(spec.turn))
        return "position, axis or turn is not finite";
    if (!is_finite(spec.one_way) || !is_finite(spec.surface_velocity))
        return "one_way or surface_velocity is not finite";
    if (!(spec.radius >= 0) || !(spec.half.x >= 0) || !(spec.half.y >= 0) || !(spec.half.z >= 0))
        return "radius and half are at least 0";
    if (!(spec.bounce >= 0 && spec.bounce <= 1)) return "bounce is from 0 to 1";
    if (!(spec.friction >= 0 && std::isfinite(spec.friction))) return "friction is at least 0, and finite";
    return nullptr;
}

template <int D, class Real>
collide::Collider<D, Real> collider_of(const sinew_collider_spec& spec, collide::Shape<D, Real> shape) {
    collide::Collider<D, Real> collider;
    collider.shape = std::move(shape);
    collider.target = {vector_of<D, Real>(spec.position), rotation_of<D, Real>(spec.turn, &spec.axis)};
    collider.restitution = Real(spec.bounce);
    collider.friction = Real(spec.friction);
    collider.filter = {spec.layers == 0 ? 1 : spec.layers, spec.mask == 0 ? ~std::uint32_t(0) : spec.mask};
    collider.one_way = vector_of<D, Real>(of_usable_length(spec.one_way));
    collider.is_sensor = spec.is_sensor != 0;
    collider.surface_velocity = vector_of<D, Real>(spec.surface_velocity);
    if (spec.name) collider.name = spec.name;
    return collider;
}

} // namespace

extern "C" {

sinew_status sinew_world_add_collider(sinew_world simulation, const sinew_collider_spec* given,
                                      sinew_collider* collider) {
    sinew_collider_spec spec;
    constexpr auto first_version = offsetof(sinew_collider_spec, triangles);
    if (const auto status = take(given, spec, first_version)) return status;
    if (!collider || (spec.point_count > 0 && !spec.points)) return null_argument();
    if (const auto* problem = problem_of(spec)) return fail(SINEW_BAD_ARGUMENT, problem);
    return change(simulation, [&](Session& session) {
        return std::visit(
            [&]<int D, class Real>(World<D, Real>& world) {
                collide::Shape<D, Real> shape;
                const auto problem = set_shape<D, Real>(spec, shape);
                if (!problem.empty()) return fail(SINEW_BAD_ARGUMENT, problem);
                *collider = number_of(add_collider(world, collider_of<D, Real>(spec, std::move(shape))));
                return SINEW_OK;
            },
            session.world());
    });
}

sinew_status sinew_world_remove_collider(sinew_world simulation, sinew_collider collider) {
    return change(simulation, [&](Session& session) {
        const bool was = std::visit([&](auto& world) { return remove_collider(world, id_of<ColliderTag>(collider)); },
                                    session.world());
        return was ? SINEW_OK : bad_id("collider");
    });
}

} // extern "C"
