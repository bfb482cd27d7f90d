#include "sinew/topology/cut.h"

#include "sinew/math/sort.h"
#include "sinew/topology/slice.h"
#include "sinew/topology/vertex_split.h"
#include "sinew/world/changes.h"
#include "sinew/world/constraint_graph.h"

#include <algorithm>

namespace sinew {
namespace {

double side_of(const Vec2<double>& from, const Vec2<double>& to, const Vec2<double>& point) {
    return cross(to - from, point - from);
}

double distance_to(const Vec2<double>& point, const Vec2<double>& a, const Vec2<double>& b) {
    const double share = dot(point - a, b - a) * inverse_or_zero(dot(b - a, b - a));
    return distance(point, a + (b - a) * clamp(share, 0.0, 1.0));
}

bool crosses(const Blade& blade, const Vec2<double>& a, const Vec2<double>& b) {
    const bool apart = (side_of(blade.from, blade.to, a) > 0) != (side_of(blade.from, blade.to, b) > 0);
    if (apart && (side_of(a, b, blade.from) > 0) != (side_of(a, b, blade.to) > 0)) return true;
    return blade.radius > 0 &&
           (distance_to(a, blade.from, blade.to) <= blade.radius ||
            distance_to(b, blade.from, blade.to) <= blade.radius || distance_to(blade.from, a, b) <= blade.radius ||
            distance_to(blade.to, a, b) <= blade.radius);
}

/// Adds the dependents of a distance: constraints of other kinds with both ends among their members.
template <int D, class Real>
void add_what_hangs(const World<D, Real>& world, const std::array<Row, 2>& ends, std::vector<ConstraintId>& all) {
    for_each_constraint(world, ends[0], [&]<class Table>(const Table& table, Row row) {
        constexpr int kind = kind_of<World<D, Real>, Table>;
        const auto members = table.members[row];
        const bool both = std::find(members.begin(), members.end(), ends[1]) != members.end();
        if (both && kind != kind_number<Distance, D>) all.push_back({kind, table.handles.id_of(row)});
    });
}

template <int D, class Real>
std::vector<ConstraintId> crossed_by(const World<D, Real>& world, const Blade& blade, const Projection<D>& see) {
    std::vector<Vec2<double>> positions;
    positions.reserve(world.particles.size());
    for (const auto& position : world.particles.position) positions.push_back(see(cast<double>(position)));
    const auto& distances = std::get<kind_number<Distance, D>>(world.constraints);
    std::vector<ConstraintId> crossed;
    for (Row row = 0; row < distances.size(); ++row) {
        const auto ends = distances.members[row];
        const auto &a = positions[ends[0]], &b = positions[ends[1]];
        if (ties(distances, row) && is_finite(a) && is_finite(b) && crosses(blade, a, b))
            crossed.push_back({kind_number<Distance, D>, distances.handles.id_of(row)});
    }
    return crossed;
}

template <int D, class Real>
Cut cut(World<D, Real>& world, std::span<const ConstraintId> ids, const Slicer<D, Real>* slicer) {
    constexpr int link_kind = kind_number<Distance, D>;
    const auto& distances = std::get<link_kind>(world.constraints);
    Cut done;
    if (ids.empty()) return done;
    detail::list_constraints(world);
    std::vector<Ends> gone;
    std::vector<ConstraintId> all(ids.begin(), ids.end());
    for (const auto& id : ids) {
        const auto row = id.kind == link_kind ? distances.handles.find(id.id) : std::nullopt;
        if (!row) continue;
        const auto ends = distances.members[*row];
        gone.push_back({world.particles.handles.id_of(ends[0]), world.particles.handles.id_of(ends[1])});
        done.figures.push_back(distances.figure[*row]);
        add_what_hangs(world, distances.members.rows[*row], all);
    }
    done.links = gone.size();
    sinew::sort(done.figures.begin(), done.figures.end());
    done.figures.erase(std::unique(done.figures.begin(), done.figures.end()), done.figures.end());
    remove_constraints(world, std::span<const ConstraintId>(all));
    done.new_particles = come_apart(world, std::span<const Ends>(gone), slicer);
    return done;
}

} // namespace

template <int D, class Real> Cut cut(World<D, Real>& world, const Blade& blade, const Projection<D>& see) {
    const Slicer<D, Real> slicer(world, blade, see);
    return cut(world, std::span<const ConstraintId>(crossed_by(world, blade, see)), &slicer);
}

template <int D, class Real> Cut cut(World<D, Real>& world, std::span<const ConstraintId> ids) {
    return cut<D, Real>(world, ids, nullptr);
}

template <int D, class Real>
std::size_t come_apart(World<D, Real>& world, std::span<const Ends> gone, const Slicer<D, Real>* slicer) {
    if (slicer) detail::list_constraints(world);
    split_pieces(world, gone, slicer);
    const auto added = split(world, gone);
    bind(world);
    return added;
}

#define SINEW_CUT(D, Real)                                                                                             \
    template Cut cut(World<D, Real>&, const Blade&, const Projection<D>&);                                             \
    template Cut cut(World<D, Real>&, std::span<const ConstraintId>);                                                  \
    template std::size_t come_apart(World<D, Real>&, std::span<const Ends>, const Slicer<D, Real>*);
SINEW_INSTANTIATE(SINEW_CUT)

} // namespace sinew
