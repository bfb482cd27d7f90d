#include "sinew/assert/assert.h"
#include "sinew/world/edit.h"
#include "sinew/world/mobility.h"

#include <algorithm>

/// Figures as a whole: adding, removing, teleporting and releasing from quarantine.
namespace sinew {
namespace {

template <int D, class Real> std::vector<ParticleId> particles_of(const World<D, Real>& world, FigureIndex figure) {
    const auto& p = world.particles;
    std::vector<ParticleId> found;
    for (Row row = 0; row < p.size(); ++row)
        if (p.figure[row] == figure) found.push_back(p.handles.id_of(row));
    return found;
}

/// Constraints owned by the figure, between any particles.
template <int D, class Real> std::vector<ConstraintId> constraints_of(const World<D, Real>& world, FigureIndex figure) {
    std::vector<ConstraintId> found;
    int kind = 0;
    for_each_table(world, [&](const auto& table) {
        for (Row row = 0; row < table.size(); ++row)
            if (table.figure[row] == figure) found.push_back({kind, table.handles.id_of(row)});
        ++kind;
    });
    return found;
}

} // namespace

template <int D, class Real>
FigureIndex add_figure(World<D, Real>& world, std::string_view name, std::string_view prefab) {
    auto& figures = world.figures;
    auto position = figures.end();
    if (world.unused_figures > 0)
        position = std::ranges::find_if(figures, [](const Figure& figure) { return !figure.in_use(); });
    SINEW_ASSERT(world.unused_figures == 0 || position != figures.end(), "as many entries are unused as are counted");
    if (position == figures.end())
        position = figures.emplace(position);
    else
        --world.unused_figures;
    position->name = name;
    position->prefab = prefab;
    position->generation = world.figure_stamp.get();
    const auto index = FigureIndex(position - figures.begin());
    world.figure_names.emplace_back(name, index);
    return index;
}

template <int D, class Real> FigureId figure_id(const World<D, Real>& world, FigureIndex figure) {
    return has_figure(world, figure) ? FigureId{figure, world.figures[figure].generation} : FigureId{};
}

template <int D, class Real>
std::optional<FigureIndex> figure_index(const World<D, Real>& world, const FigureId& figure) {
    const bool found = has_figure(world, figure.index) && world.figures[figure.index].generation == figure.generation;
    return found ? std::optional(figure.index) : std::nullopt;
}

template <int D, class Real> bool remove_figure(World<D, Real>& world, FigureIndex figure) {
    if (!has_figure(world, figure)) return false;
    remove_constraints(world, std::span<const ConstraintId>(constraints_of(world, figure)));
    remove_particles(world, std::span<const ParticleId>(particles_of(world, figure)));
    world.figure_names.erase_if([&](FigureIndex named) { return named == figure; });
    world.forces.erase_if([&](const auto& force) { // a later figure may have the index
        const auto* attractor = std::get_if<Attractor<D, Real>>(&force);
        return attractor && attractor->figure == figure;
    });
    for (auto& event : world.events)
        if (event.figure == figure) event.figure = no_figure;
    world.figures[figure] = {};
    world.figure_stamp.forget();
    SINEW_ASSERT(!has_figure(world, figure), "an entry without a generation is unused");
    ++world.unused_figures;
    for (; !world.figures.empty() && !world.figures.back().in_use(); --world.unused_figures) world.figures.pop_back();
    return true;
}

template <int D, class Real>
bool teleport(World<D, Real>& world, FigureIndex figure, const Vec<D, Real>& offset, Momentum momentum) {
    if (!has_figure(world, figure)) return false;
    constexpr auto furthest = limit::coordinate<Real>;
    const auto by = clamp_finite(offset, Real(2) * furthest);
    const auto move = [&](Vec<D, Real>& position) { position = clamp_finite(position + by, furthest); };
    auto& p = world.particles;
    for (const auto id : world.figures[figure].particles) {
        const auto row = p.handles.find(id);
        if (!row) continue;
        move(p.position[*row]);
        move(p.previous[*row]);
        if (momentum == Momentum::reset) {
            p.previous[*row] = p.position[*row];
            p.velocity[*row] = {};
        }
    }
    for (auto& pin : world.pins) {
        const auto row = p.handles.find(pin.particle);
        if (!row || p.figure[*row] != figure) continue;
        move(pin.from);
        move(pin.target);
    }
    return true;
}

template <int D, class Real> bool release_quarantine(World<D, Real>& world, FigureIndex figure) {
    if (!has_figure(world, figure)) return false;
    world.figures[figure].quarantined = false;
    for (const auto id : world.figures[figure].particles) {
        const auto row = world.particles.handles.find(id);
        if (!row) continue;
        world.particles.quarantined[*row] = 0;
        detail::refresh_mobility(world, *row);
    }
    return true;
}

#define SINEW_FIGURES(D, Real)                                                                                         \
    template FigureIndex add_figure(World<D, Real>&, std::string_view, std::string_view);                              \
    template FigureId figure_id(const World<D, Real>&, FigureIndex);                                                   \
    template std::optional<FigureIndex> figure_index(const World<D, Real>&, const FigureId&);                          \
    template bool remove_figure(World<D, Real>&, FigureIndex);                                                         \
    template bool teleport(World<D, Real>&, FigureIndex, const Vec<D, Real>&, Momentum);                               \
    template bool release_quarantine(World<D, Real>&, FigureIndex);

SINEW_INSTANTIATE(SINEW_FIGURES)

} // namespace sinew
