#include "sinew/world/query.h"

#include "sinew/world/body_shape.h"

namespace sinew {
namespace {

template <int D> constexpr int link_kind = kind_number<Distance, D>;

/// Calls visit(row, a, b) for the links of a world, with the places of their ends.
template <int D, class Real, class Visit> void each_link(const World<D, Real>& world, Visit&& visit) {
    const auto& table = std::get<std::size_t(link_kind<D>)>(world.constraints);
    const auto& position = world.particles.position;
    for (Row row = 0; row < table.size(); ++row) {
        const auto ends = table.members[row];
        if (ties(table, row)) visit(table.handles.id_of(row), position[ends[0]], position[ends[1]]);
    }
}

template <int D, class Real> collide::Filter layers_of(const World<D, Real>& world, Row row) {
    const auto figure = world.particles.figure[row];
    return figure < world.figures.size() ? world.figures[figure].filter : collide::Filter{};
}

template <int D, class Real> void keep_first(std::optional<RayHit<D, Real>>& first, const RayHit<D, Real>& hit) {
    if (!first || hit.time < first->time) first = hit;
}

/// False for the mover itself, and for figures that it does not touch.
template <int D, class Real> bool counts(const World<D, Real>& world, FigureIndex figure, FigureIndex mover) {
    if (!has_figure(world, mover)) return true;
    return figure != mover && has_figure(world, figure) && world.figures[mover].collides &&
           world.figures[figure].collides;
}

template <int D, class Real>
void cast_at_lines(const World<D, Real>& world, const Vec<D, Real>& from, const Vec<D, Real>& displacement, Real radius,
                   const collide::Filter& filter, FigureIndex mover, std::optional<RayHit<D, Real>>& first) {
    const auto& p = world.particles;
    for (FigureIndex i = 0; i < world.figures.size(); ++i) {
        const auto& figure = world.figures[i];
        if (!figure.in_use() || !counts(world, i, mover) || !touch(filter, figure.filter)) continue;
        BodyShape<D, Real>(world, figure).each_segment([&](Row a, Row b, Real thickness) {
            const collide::Capsule<D, Real> line{{}, p.position[b] - p.position[a], thickness};
            if (const auto impact = collide::sweep(line, from - p.position[a], displacement, radius))
                keep_first(first, {.time = impact->time,
                                   .point = p.position[a] + impact->surface.point,
                                   .normal = impact->surface.normal,
                                   .particle = p.handles.id_of(a),
                                   .figure = i,
                                   .line_end = p.handles.id_of(b)});
        });
    }
}

/// Some point of a shape that lines of figures do not meet: the whole shape is where it is.
template <int D, class Real>
Vec<D, Real> point_of(const collide::Shape<D, Real>& shape, const collide::Pose<D, Real>& pose) {
    const auto box = collide::bounds(shape, pose);
    const auto surface = collide::nearest(shape, pose, (box.low + box.high) * Real(0.5), box.huge);
    return surface ? surface->point : pose.position;
}

} // namespace

template <int D, class Real>
std::optional<NearParticle<D, Real>> nearest_particle(const World<D, Real>& world, const Vec<D, Real>& point,
                                                      Real radius) {
    std::optional<NearParticle<D, Real>> best;
    const auto& p = world.particles;
    for (Row row = 0; row < p.size(); ++row) {
        const Real apart = distance(p.position[row], point) - p.radius[row];
        if (apart <= radius && (!best || apart < best->distance)) best = {p.handles.id_of(row), apart};
    }
    return best;
}

template <int D, class Real>
std::optional<NearLink<D, Real>> nearest_link(const World<D, Real>& world, const Vec<D, Real>& point, Real radius) {
    std::optional<NearLink<D, Real>> best;
    each_link(world, [&](const auto& id, const Vec<D, Real>& a, const Vec<D, Real>& b) {
        const Real t = collide::nearest_parameter(a, b, point);
        const Real apart = distance(a + (b - a) * t, point);
        if (apart <= radius && (!best || apart < best->distance)) best = {{link_kind<D>, id}, t, apart};
    });
    return best;
}

template <int D, class Real>
std::optional<RayHit<D, Real>> cast_ray(const World<D, Real>& world, const Vec<D, Real>& from,
                                        const Vec<D, Real>& displacement, Real radius, collide::Filter filter,
                                        FigureIndex mover) {
    std::optional<RayHit<D, Real>> first;
    const auto& p = world.particles;
    for (Row row = 0; row < p.size(); ++row) {
        if (!(p.radius[row] > Real(0)) || !touch(filter, layers_of(world, row))) continue;
        if (!counts(world, p.figure[row], mover)) continue;
        const collide::Sphere<D, Real> sphere{p.radius[row]};
        if (const auto impact = collide::sweep(sphere, from - p.position[row], displacement, radius))
            keep_first(first, {.time = impact->time,
                               .point = p.position[row] + impact->surface.point,
                               .normal = impact->surface.normal,
                               .particle = p.handles.id_of(row),
                               .figure = p.figure[row]});
    }
    cast_at_lines(world, from, displacement, radius, filter, mover, first);
    for (Row row = 0; row < world.colliders.size(); ++row) {
        const auto& collider = world.colliders[row];
        if (collider.is_sensor || !touch(filter, collider.filter)) continue;
        if (const auto impact = collide::sweep(collider.shape, collider.target, from, displacement, radius))
            keep_first(first, {.time = impact->time,
                               .point = impact->surface.point,
                               .normal = impact->surface.normal,
                               .collider = world.collider_handles.id_of(row),
                               .is_collider = true});
    }
    for (const auto& plane : world.bounds) {
        const collide::HalfSpace<D, Real> solid{plane.normal, plane.offset};
        if (const auto impact = collide::sweep(solid, from, displacement, radius))
            keep_first(first, {.time = impact->time,
                               .point = impact->surface.point,
                               .normal = impact->surface.normal,
                               .is_plane = true});
    }
    return first;
}

template <int D, class Real>
std::vector<ParticleId> overlapping_particles(const World<D, Real>& world, const collide::Shape<D, Real>& shape,
                                              const collide::Pose<D, Real>& pose) {
    std::vector<ParticleId> found;
    const auto& p = world.particles;
    for (Row row = 0; row < p.size(); ++row)
        if (collide::nearest(shape, pose, p.position[row], p.radius[row])) found.push_back(p.handles.id_of(row));
    return found;
}

template <int D, class Real>
std::vector<ConstraintId> overlapping_links(const World<D, Real>& world, const collide::Shape<D, Real>& shape,
                                            const collide::Pose<D, Real>& pose) {
    std::vector<ConstraintId> found;
    each_link(world, [&](const auto& id, const Vec<D, Real>& a, const Vec<D, Real>& b) {
        if (collide::nearest_to_segment(shape, pose, a, b, Real(0))) found.push_back({link_kind<D>, id});
    });
    return found;
}

template <int D, class Real>
std::vector<FigureIndex> overlapping_figures(const World<D, Real>& world, const collide::Shape<D, Real>& shape,
                                             const collide::Pose<D, Real>& pose) {
    const auto& p = world.particles;
    std::vector<FigureIndex> found;
    for (FigureIndex i = 0; i < world.figures.size(); ++i) {
        const auto& figure = world.figures[i];
        if (!figure.in_use()) continue;
        const BodyShape<D, Real> body(world, figure);
        bool touches = body.solid_around(point_of(shape, pose)) != body.none;
        for (const auto& id : figure.particles)
            if (const auto row = p.handles.find(id); row && !touches)
                touches = collide::nearest(shape, pose, p.position[*row], p.radius[*row]).has_value();
        body.each_segment([&](Row a, Row b, Real radius) {
            touches = touches || collide::nearest_to_segment(shape, pose, p.position[a], p.position[b], radius);
        });
        if (touches) found.push_back(i);
    }
    return found;
}

#define SINEW_QUERY(D, Real)                                                                                           \
    template std::optional<NearParticle<D, Real>> nearest_particle(const World<D, Real>&, const Vec<D, Real>&, Real);  \
    template std::optional<NearLink<D, Real>> nearest_link(const World<D, Real>&, const Vec<D, Real>&, Real);          \
    template std::optional<RayHit<D, Real>> cast_ray(const World<D, Real>&, const Vec<D, Real>&, const Vec<D, Real>&,  \
                                                     Real, collide::Filter, FigureIndex);                              \
    template std::vector<ParticleId> overlapping_particles(const World<D, Real>&, const collide::Shape<D, Real>&,      \
                                                           const collide::Pose<D, Real>&);                             \
    template std::vector<ConstraintId> overlapping_links(const World<D, Real>&, const collide::Shape<D, Real>&,        \
                                                         const collide::Pose<D, Real>&);                               \
    template std::vector<FigureIndex> overlapping_figures(const World<D, Real>&, const collide::Shape<D, Real>&,       \
                                                          const collide::Pose<D, Real>&);
SINEW_INSTANTIATE(SINEW_QUERY)

} // namespace sinew
