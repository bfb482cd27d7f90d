#include "sinew/world/query.h"

#include "bindings/c/native/sized.h"
#include "bindings/c/simulation.h"

#include <cmath>

/// Queries: what is near a point, on a way, or in a region.
using namespace sinew;
using namespace sinew::c;

namespace {

/// Calls work(world) and returns its status.
template <class Work> sinew_status ask(sinew_world simulation, const Work& work) {
    return read(simulation,
                [&](const Simulation&, const Session& session) { return std::visit(work, session.world()); });
}

template <int D, class Real> sinew_point point_in_c(const Vec<D, Real>& vector) {
    sinew_point point{};
    point.x = double(vector[0]), point.y = double(vector[1]);
    if constexpr (D == 3) point.z = double(vector[2]);
    return point;
}

sinew_status nothing_near() {
    return fail(SINEW_NOT_FOUND, "nothing is within reach");
}

bool is_reach(double reach) {
    return std::isfinite(reach) && reach >= 0;
}
sinew_status no_reach() {
    return fail(SINEW_BAD_ARGUMENT, "a point must be finite, and a distance finite and not negative");
}

bool is_region(const sinew_region& region) {
    const auto& half = region.half;
    return is_finite(region.center) && is_finite(half) && half.x >= 0 && half.y >= 0 && half.z >= 0 &&
           is_reach(region.radius) && std::isfinite(region.turn) && is_finite(region.axis);
}

template <int D, class Real> collide::Shape<D, Real> shape_of(const sinew_region& region) {
    const auto half = vector_of<D, Real>(region.half);
    if (half == Vec<D, Real>{}) return collide::Sphere<D, Real>{Real(region.radius)};
    return collide::Box<D, Real>{half * Real(2)};
}
template <int D, class Real> collide::Pose<D, Real> pose_of(const sinew_region& region) {
    return {vector_of<D, Real>(region.center), rotation_of<D, Real>(region.turn, &region.axis)};
}

/// Hands out the ids that fit.
template <class Ids> void hand_out(const Ids& found, std::uint64_t* ids, std::size_t room, std::size_t& count) {
    for (std::size_t i = 0; i < found.size() && i < room; ++i) ids[i] = number_of(found[i]);
    count = found.size();
}

/// Calls search(world, shape, pose) for a list of ids.
template <class Search>
sinew_status search_region(sinew_world simulation, const sinew_region* region, std::uint64_t* ids, std::size_t room,
                           std::size_t* count, const Search& search) {
    sinew_region given;
    if (const auto status = take(region, given)) return status;
    if (!count || (room > 0 && !ids)) return null_argument();
    if (!is_region(given)) return no_reach();
    return ask(simulation, [&]<int D, class Real>(const World<D, Real>& world) {
        hand_out(search(world, shape_of<D, Real>(given), pose_of<D, Real>(given)), ids, room, *count);
        return SINEW_OK;
    });
}

} // namespace

extern "C" {

sinew_status sinew_world_nearest_particle(sinew_world simulation, sinew_point at, double reach,
                                          sinew_particle* particle, double* distance) {
    if (!particle) return null_argument();
    if (!is_finite(at) || !is_reach(reach)) return no_reach();
    return ask(simulation, [&]<int D, class Real>(const World<D, Real>& world) {
        const auto near = nearest_particle(world, vector_of<D, Real>(at), Real(reach));
        if (!near) return nothing_near();
        *particle = number_of(near->particle);
        if (distance) *distance = double(near->distance);
        return SINEW_OK;
    });
}

sinew_status sinew_world_nearest_link(sinew_world simulation, sinew_point at, double reach, sinew_constraint* link,
                                      double* t, double* distance) {
    if (!link) return null_argument();
    if (!is_finite(at) || !is_reach(reach)) return no_reach();
    return ask(simulation, [&]<int D, class Real>(const World<D, Real>& world) {
        const auto near = nearest_link(world, vector_of<D, Real>(at), Real(reach));
        if (!near) return nothing_near();
        *link = number_of(near->link);
        if (t) *t = double(near->t);
        if (distance) *distance = double(near->distance);
        return SINEW_OK;
    });
}

sinew_status sinew_world_cast_ray(sinew_world simulation, sinew_point from, sinew_point to, double radius,
                                  uint32_t mask, sinew_ray_hit* hit) {
    if (const auto status = can_fill(hit)) return status;
    if (!is_finite(from) || !is_finite(to) || !is_reach(radius)) return no_reach();
    return ask(simulation, [&]<int D, class Real>(const World<D, Real>& world) {
        const auto start = vector_of<D, Real>(from);
        const collide::Filter filter{.layers = ~std::uint32_t(0), .mask = mask};
        const auto met = cast_ray(world, start, vector_of<D, Real>(to) - start, Real(radius), filter);
        if (!met) return fail(SINEW_NOT_FOUND, "nothing is on the way");
        const sinew_ray_hit found{0,
                                  double(met->time),
                                  point_in_c(met->point),
                                  point_in_c(met->normal),
                                  met->is_collider || met->is_plane ? SINEW_NO_ID : number_of(met->particle),
                                  met->is_collider ? number_of(met->collider) : SINEW_NO_ID,
                                  met->line_end ? number_of(*met->line_end) : SINEW_NO_ID};
        fill_sized(found, hit);
        return SINEW_OK;
    });
}

sinew_status sinew_world_overlapping_particles(sinew_world simulation, const sinew_region* region,
                                               sinew_particle* particles, size_t room, size_t* count) {
    return search_region(simulation, region, particles, room, count,
                         [](const auto& world, const auto& shape, const auto& pose) {
                             return overlapping_particles(world, shape, pose);
                         });
}

sinew_status sinew_world_overlapping_links(sinew_world simulation, const sinew_region* region, sinew_constraint* links,
                                           size_t room, size_t* count) {
    return search_region(
        simulation, region, links, room, count,
        [](const auto& world, const auto& shape, const auto& pose) { return overlapping_links(world, shape, pose); });
}

} // extern "C"
