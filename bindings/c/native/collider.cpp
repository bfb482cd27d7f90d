#include "sinew/world/colliders.h"

#include "bindings/c/native/sized.h"
#include "bindings/c/simulation.h"

#include <cmath>

/// Colliders added by calls.
using namespace sinew;
using namespace sinew::c;

namespace {

constexpr std::uint32_t max_points = 1u << 20;

bool is_collider(const sinew_collider_spec& spec) {
    for (const auto* point : {&spec.position, &spec.axis, &spec.half, &spec.one_way})
        if (!is_finite(*point)) return false;
    for (std::uint32_t i = 0; i < spec.point_count; ++i)
        if (!is_finite(spec.points[i])) return false;
    return std::isfinite(spec.turn) && std::isfinite(spec.radius) && spec.radius >= 0 && spec.bounce >= 0 &&
           spec.bounce <= 1 && spec.friction >= 0 && std::isfinite(spec.friction) && spec.half.x >= 0 &&
           spec.half.y >= 0 && spec.half.z >= 0;
}

/// True for a convex outline, counter-clockwise.
bool is_convex(const sinew_point* points, std::uint32_t count) {
    double turns = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto &a = points[i], &b = points[(i + 1) % count], &c = points[(i + 2) % count];
        const double ux = b.x - a.x, uy = b.y - a.y, vx = c.x - b.x, vy = c.y - b.y;
        if (!(ux * vy - uy * vx > 0)) return false;
        turns += std::atan2(ux * vy - uy * vx, ux * vx + uy * vy);
    }
    return count >= 3 && turns < 7; // one turn, 2 pi: a star has two
}

template <int D, class Real> std::vector<Vec<D, Real>> points_of(const sinew_collider_spec& spec) {
    std::vector<Vec<D, Real>> points;
    for (std::uint32_t i = 0; i < spec.point_count; ++i) points.push_back(vector_of<D, Real>(spec.points[i]));
    return points;
}

/// The shape of a collider; a reason where the numbers make none.
template <int D, class Real> const char* set_shape(const sinew_collider_spec& spec, collide::Shape<D, Real>& shape) {
    switch (spec.shape) {
    case SINEW_HALF_SPACE:
        return shape = collide::HalfSpace<D, Real>{}, nullptr;
    case SINEW_SPHERE:
        if (!(spec.radius > 0)) return "a sphere has a radius above 0";
        return shape = collide::Sphere<D, Real>{Real(spec.radius)}, nullptr;
    case SINEW_CAPSULE: {
        if (!(spec.radius > 0)) return "a capsule has a radius above 0";
        const auto end = Vec<D, Real>::axis(0) * Real(spec.half.x);
        return shape = collide::Capsule<D, Real>{-end, end, Real(spec.radius)}, nullptr;
    }
    case SINEW_BOX: {
        const auto half = vector_of<D, Real>(spec.half);
        for (int i = 0; i < D; ++i)
            if (!(half[i] > Real(0))) return "a box has edges above 0";
        return shape = collide::Box<D, Real>{half * Real(2)}, nullptr;
    }
    default:
        break;
    }
    if constexpr (D == 2) {
        if (spec.shape == SINEW_POLYGON_2D) {
            if (!is_convex(spec.points, spec.point_count)) return "a polygon is convex, its corners counter-clockwise";
            return shape = collide::Polygon<2, Real>{points_of<2, Real>(spec)}, nullptr;
        }
        if (spec.shape == SINEW_TERRAIN_2D) {
            if (spec.point_count < 2) return "a terrain has two points or more";
            return shape = collide::Chain<2, Real>{points_of<2, Real>(spec), false}, nullptr;
        }
    }
    return "no shape of this dimension has this number";
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
    if (spec.name) collider.name = spec.name;
    return collider;
}

} // namespace

extern "C" {

sinew_status sinew_world_add_collider(sinew_world simulation, const sinew_collider_spec* given,
                                      sinew_collider* collider) {
    sinew_collider_spec spec;
    if (const auto status = take(given, spec)) return status;
    if (!collider || (spec.point_count > 0 && !spec.points)) return null_argument();
    if (spec.point_count > max_points || !is_collider(spec))
        return fail(SINEW_BAD_ARGUMENT, "a number of the collider is not possible");
    return change(simulation, [&](Session& session) {
        return std::visit(
            [&]<int D, class Real>(World<D, Real>& world) {
                collide::Shape<D, Real> shape;
                if (const auto* problem = set_shape<D, Real>(spec, shape)) return fail(SINEW_BAD_ARGUMENT, problem);
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
