#include "sinew/prefab/jelly.h"

#include "sinew/math/format.h"
#include "sinew/prefab/tetrahedra.h"

namespace sinew {
namespace {

TetraMesh solid_of(const Jelly& jelly) {
    if (jelly.model) return fill_with_tetrahedra(*jelly.model, jelly.cells);
    return fill_with_tetrahedra(BallSolid(0.5), jelly.cells); // `size` scales it
}

} // namespace

/// A cell of the lattice has two points, twelve tetrahedra and fourteen edges; a layer of cells is added all round.
Sizes Jelly::sizes() const {
    const auto side = std::size_t(cells) + 2, volume = side * side * side;
    return {.particles = 2 * volume + 3 * side * side + 3 * side + 1, .constraints = 26 * volume};
}

std::optional<std::string> Jelly::problem(int) const {
    if (model) {
        if (const auto open = open_edges(*model); open > 0)
            return format_text("a jelly fills a closed mesh, and {} edges of this one belong to no second face", open);
        if (solid_of(*this).tetrahedra.empty())
            return format_text("no tetrahedron fits into this mesh: more cells than {} make smaller ones", cells);
    }
    return std::nullopt;
}

template <int D, class Real> void Jelly::build(Builder<D, Real>& figure) const {
    const auto solid = solid_of(*this);
    figure.number_particles("vertex", solid.points.size());
    const auto& particles = figure.figure().particles;
    for (const auto& point : solid.points)
        figure.particle("", point * size, mass / double(solid.points.size()), thickness / 2);

    const auto spec = strength.applied_to(elasticity.spec());
    figure.number_constraints("edge", solid.edges.size());
    for (const auto& [a, b] : solid.edges) figure.template constrain<Distance>("", {particles[a], particles[b]}, spec);
    if (least_volume > 0) {
        figure.number_constraints("volume", solid.tetrahedra.size());
        for (const auto& t : solid.tetrahedra) {
            const std::array members{particles[t[0]], particles[t[1]], particles[t[2]], particles[t[3]]};
            const double volume = figure.template measure<Volume>(members);
            figure.template constrain<Volume>("", members, {.limits = at_least(least_volume * volume)});
        }
    }
    for (const auto& [a, b, c] : solid.surface) // a patch has four corners
        figure.draw(Mark::surface, "skin", {particles[a], particles[b], particles[c], particles[c]});
}

#define SINEW_JELLY(D, Real) template void Jelly::build(Builder<D, Real>&) const;
SINEW_INSTANTIATE_3D(SINEW_JELLY)

} // namespace sinew
