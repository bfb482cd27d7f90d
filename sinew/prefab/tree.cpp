#include "sinew/prefab/tree.h"

namespace sinew {
namespace {

/// A branch from the top of its parent (or the base) to its own top.
struct Branch {
    std::size_t below; ///< index of the parent branch; its own index for the trunk
    int level;
    double length, heading; ///< heading: radians to the left of straight up
    Vec2<double> top;
};

void grow(const Tree& tree, Vec2<double> from, std::size_t below, int level, double share, double heading,
          std::vector<Branch>& grown) {
    const double length = tree.branch * share;
    const auto top = from + Vec2<double>{{-sine(heading), cosine(heading)}} * length;
    const auto self = grown.size();
    grown.push_back({below, level, length, heading, top});
    if (level == tree.depth) return;
    const double next = maximum(share * share, Tree::least_share);
    grow(tree, top, self, level + 1, next, heading + tree.spread, grown);
    grow(tree, top, self, level + 1, next, heading - tree.spread, grown);
}

/// Thickness of a branch relative to the trunk's, `level` forks up: the cross sections of the two branches above a fork
/// add up to the one below.
double thickness_at(int level) {
    double section = 1;
    for (int i = 0; i < level; ++i) section /= 2;
    return square_root(section);
}

} // namespace

template <int D, class Real> void Tree::build(Builder<D, Real>& figure) const {
    const bool classic = figure.mode() == Mode::classic;
    std::vector<Branch> branches;
    branches.reserve(sizes().constraints / 2);
    grow(*this, {}, 0, 0, shrink, 0, branches);

    const auto weight = [&](const Branch& b) { return b.length * thickness_at(b.level) * thickness_at(b.level); };
    double whole = 0;
    for (const auto& b : branches) whole += weight(b);

    // Root and base are held, so their mass has no effect; all but a little of the mass goes to the branches.
    constexpr double below_ground = 0.01;
    const auto root = figure.particle("root", on_screen<D>(0, -branch * shrink / 2), mass * below_ground / 2);
    const auto base = figure.particle("base", {}, mass * below_ground / 2);
    figure.number_particles("particle", branches.size());
    std::vector<ParticleId> tops;
    for (const auto& b : branches)
        tops.push_back(
            figure.particle("", on_screen<D>(b.top[0], b.top[1]), mass * (1 - below_ground) * weight(b) / whole));
    figure.hold(root);
    figure.hold(base);

    const auto foot = [&](std::size_t i) { return i == 0 ? base : tops[branches[i].below]; };
    const auto before = [&](std::size_t i) {
        if (i == 0) return root;
        return branches[i].below == 0 ? base : tops[branches[branches[i].below].below];
    };
    // Torn from the ground, the trunk still has a foot to bend against.
    if (!classic) figure.template constrain<Distance>("stump", {root, base});
    figure.number_constraints("branch", branches.size());
    for (std::size_t i = 0; i < branches.size(); ++i) figure.template constrain<Distance>("", {foot(i), tops[i]});
    figure.number_constraints("joint", branches.size());
    for (std::size_t i = 0; i < branches.size(); ++i) {
        const auto& b = branches[i];
        const double thick = thickness_at(b.level), share = double(b.level) / double(depth + 1);
        figure.template constrain<Angle>("", {before(i), foot(i), tops[i]},
                                         {.compliance = b.length / (bend_stiffness * thick * thick * thick * thick),
                                          .relaxation = classic ? joint_relaxation * (1 - share) : 1});
    }

    const auto leaves = [&](std::string_view part, int level, std::size_t which, double size) {
        if (!(leaf > 0)) return;
        for (std::size_t i = 0, count = 0; i < branches.size(); ++i)
            if (branches[i].level == level && count++ % 3 == which) figure.draw(Mark::dot, part, {tops[i]}, size);
    };
    for (const std::size_t which : {0U, 1U, 2U}) leaves("shade", depth - 1, which, 1.3 * leaf);
    leaves("shade", depth, 0, 1.2 * leaf);
    for (std::size_t i = branches.size(); i-- > 0;) // from the twigs to the trunk, which is drawn on top
        figure.draw_tapered(Mark::stroke, "branch", {foot(i), tops[i]}, thickness * thickness_at(branches[i].level),
                            thickness * thickness_at(branches[i].level + 1));
    leaves("leaf", depth, 1, leaf);
    leaves("bright", depth, 2, 0.8 * leaf);
}

#define SINEW_TREE(D, Real) template void Tree::build(Builder<D, Real>&) const;
SINEW_INSTANTIATE_2D(SINEW_TREE)

} // namespace sinew
