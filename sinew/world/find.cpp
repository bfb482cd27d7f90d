#include "sinew/world/edit.h"

#include <set>
#include <utility>

/// Look-up by name.
namespace sinew {

template <int D, class Real>
std::optional<FigureIndex> find_figure(const World<D, Real>& world, std::string_view name) {
    return world.figure_names.find(name);
}

namespace {

struct Path {
    const Figure* figure = nullptr;
    std::string_view name;
};

/// Splits a path "figure/name" into the figure and the name.
template <int D, class Real> Path split(const World<D, Real>& world, std::string_view path) {
    const auto slash = path.find('/');
    if (slash == std::string_view::npos) return {};
    const auto figure = find_figure(world, path.substr(0, slash));
    return figure ? Path{&world.figures[*figure], path.substr(slash + 1)} : Path{};
}

/// Id of a name, either given or by number.
template <class Id>
std::optional<Id> look_up(std::string_view name, const NameTable<Id>& given, const std::vector<Numbered>& numbered,
                          const IdList<Id>& built) {
    if (const auto id = given.find(name)) return id;
    const auto number = number_called(name, numbered);
    return number && *number < built.size() ? std::optional(built[*number]) : std::nullopt;
}

} // namespace

template <int D, class Real>
std::optional<ParticleId> find_particle(const World<D, Real>& world, std::string_view path) {
    const auto [figure, name] = split(world, path);
    if (!figure) return std::nullopt;
    const auto id = look_up(name, figure->particle_names, figure->particle_numbers, figure->particles);
    return id && world.particles.handles.find(*id) ? id : std::nullopt;
}

template <int D, class Real>
std::vector<ParticleId> find_particles(const World<D, Real>& world, std::string_view path) {
    if (const auto one = find_particle(world, path)) return {*one};
    auto [figure, stem] = split(world, path);
    if (!figure || !stem.ends_with('*')) return {};
    stem.remove_suffix(1);
    const auto& built = figure->particles;
    std::set<std::uint32_t> named;
    for (const auto& [name, id] : figure->particle_names)
        if (name.starts_with(stem)) named.insert(id.index);
    std::vector<ParticleId> found;
    for (std::size_t i = 0; i < built.size(); ++i) {
        if (!world.particles.handles.find(built[i])) continue;
        if (named.contains(built[i].index) || stem.empty() ||
            name_of(i, figure->particle_numbers).starts_with(stem)) // unnamed particles match the empty stem only
            found.push_back(built[i]);
    }
    return found;
}

template <int D, class Real>
std::optional<ConstraintId> find_constraint(const World<D, Real>& world, std::string_view path) {
    const auto [figure, name] = split(world, path);
    if (!figure) return std::nullopt;
    const auto id = look_up(name, figure->constraint_names, figure->constraint_numbers, figure->constraints);
    return id && constraint_state(world, *id) ? id : std::nullopt;
}

template <int D, class Real>
std::vector<ConstraintId> find_constraints(const World<D, Real>& world, std::string_view path) {
    if (const auto one = find_constraint(world, path)) return {*one};
    auto [figure, stem] = split(world, path);
    if (!figure || !stem.ends_with('*')) return {};
    stem.remove_suffix(1);
    std::set<std::pair<int, std::uint32_t>> named;
    for (const auto& [name, id] : figure->constraint_names)
        if (name.starts_with(stem)) named.insert({id.kind, id.id.index});
    std::vector<ConstraintId> found;
    const auto& built = figure->constraints;
    for (std::size_t i = 0; i < built.size(); ++i) {
        const ConstraintId id = built[i];
        const bool matches = stem.empty() || named.contains({id.kind, id.id.index}) ||
                             name_of(i, figure->constraint_numbers).starts_with(stem);
        if (matches && constraint_state(world, id)) found.push_back(id);
    }
    return found;
}

#define SINEW_FIND(D, Real)                                                                                            \
    template std::optional<FigureIndex> find_figure(const World<D, Real>&, std::string_view);                          \
    template std::optional<ParticleId> find_particle(const World<D, Real>&, std::string_view);                         \
    template std::vector<ParticleId> find_particles(const World<D, Real>&, std::string_view);                          \
    template std::vector<ConstraintId> find_constraints(const World<D, Real>&, std::string_view);                      \
    template std::optional<ConstraintId> find_constraint(const World<D, Real>&, std::string_view);

SINEW_INSTANTIATE(SINEW_FIND)

} // namespace sinew
