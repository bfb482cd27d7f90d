#include "sinew/scene/join.h"

#include "sinew/constraint/kind_table.h"
#include "sinew/scene/check.h"
#include "sinew/world/edit.h"

#include <algorithm>

namespace sinew {
namespace {

template <class Real> std::optional<Interval<Real>> limits_of(const ConstraintSection& section) {
    const Real in_program = kind_called(section.kind)->angle ? pi<Real> / 180 : 1;
    if (section.rest) return exactly(Real(*section.rest) * in_program);
    if (!section.low && !section.high) return std::nullopt;
    auto limits = between(-std::numeric_limits<Real>::infinity(), std::numeric_limits<Real>::infinity());
    if (section.low) limits.low = Real(*section.low) * in_program;
    if (section.high) limits.high = Real(*section.high) * in_program;
    return limits;
}

/// Adds the drawn piece of a hand-made constraint. Part: the constraint's name, else "line" for a line and the kind's
/// name for an area.
void draw(Figure& figure, const ConstraintSection& section, const std::vector<ParticleId>& members) {
    const auto drawn_as = kind_called(section.kind)->drawn_as;
    if (drawn_as == DrawnAs::nothing) return;
    const bool line = drawn_as == DrawnAs::line;
    figure.pieces.push_back({.mark = line ? Mark::stroke : Mark::fill,
                             .part = !section.name.empty() ? section.name
                                     : line                ? "line"
                                                           : section.kind,
                             .particles = members,
                             .hidden = section.hidden});
}

template <int D, class Real>
void join_members(World<D, Real>& world, const ConstraintSection& section, FigureIndex figure,
                  const std::vector<ParticleId>& members) {
    auto spec = cast<Real>(section.spec());
    spec.limits = limits_of<Real>(section);
    spec.figure = figure;
    const auto id = add_constraint(world, kind_index<D>(section.kind), members, spec);
    if (!id || figure == no_figure) return;
    auto& built = world.figures[figure];
    built.constraints.push_back(*id);
    if (!section.name.empty()) built.constraint_names.emplace_back(section.name, *id);
    draw(built, section, members);
}

} // namespace

template <int D, class Real>
void join(World<D, Real>& world, const ConstraintSection& section, FigureIndex figure, const std::string& prefix) {
    std::vector<ParticleId> members, each;
    std::size_t many = 0; // index of the member with a star
    for (const auto& name : section.between) {
        auto found = find_particles(world, full_name(name, prefix));
        if (found.empty()) return;
        members.push_back(found.front());
        if (!name.ends_with('*')) continue;
        many = members.size() - 1;
        each = std::move(found);
    }
    if (each.empty()) return join_members(world, section, figure, members);
    for (const auto id : each) {
        members[many] = id;
        if (std::count(members.begin(), members.end(), id) == 1) // no particle twice in one constraint
            join_members(world, section, figure, members);
    }
}

#define SINEW_JOIN(D, Real)                                                                                            \
    template void join(World<D, Real>&, const ConstraintSection&, FigureIndex, const std::string&);
SINEW_INSTANTIATE(SINEW_JOIN)

} // namespace sinew
