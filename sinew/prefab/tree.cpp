#include "sinew/prefab/tree.h"

#include "sinew/prefab/material.h"

namespace sinew {
namespace {

/// Thickness of a branch relative to the trunk's, `level` forks up: the cross sections of the two branches above a fork
/// add up to the one below.
double thickness_at(int level) {
    double section = 1;
    for (int i = 0; i < level; ++i) section /= 2;
    return square_root(section);
}

/// A branch from the top of its parent (or the base) to its own top.
struct Branch {
    std::size_t below; ///< index of the parent branch; its own index for the trunk
    int level;
    double length, heading; ///< heading: radians to the left of straight up
    Vec2<double> top;

    double volume() const { return length * thickness_at(level) * thickness_at(level); } ///< relative
};

void grow(const Tree& tree, Vec2<double> from, std::size_t below, int level, double share, double heading,
          std::vector<Branch>& grown) {
    const double length = tree.branch * share;
    const auto top = from + Vec2<double>{{-sine(heading), cosine(heading)}} * length;
    const auto self = grown.size();
    grown.push_back({below, level, length, heading, top});
    if (level == tree.depth) return;
    const double next = max(share * share, Tree::min_share);
    grow(tree, top, self, level + 1, next, heading + tree.spread, grown);
    grow(tree, top, self, level + 1, next, heading - tree.spread, grown);
}

/// Sum over branches of length times cross section.
double volume_of(const std::vector<Branch>& branches) {
    double volume = 0;
    for (const auto& b : branches) volume += b.volume();
    return volume;
}

/// Builds a tree's figure: particles at the tops of the branches, constraints along and between them, then the picture.
template <int D, class Real> class TreeBuilder {
  public:
    TreeBuilder(const Tree& tree, Builder<D, Real>& figure) : tree_(tree), figure_(figure) {
        branches_.reserve(tree.sizes().constraints / 2);
        grow(tree, {}, 0, 0, tree.shrink, 0, branches_);
    }

    void build() {
        add_particles();
        add_constraints();
        draw();
    }

  private:
    const Tree& tree_;
    Builder<D, Real>& figure_;
    std::vector<Branch> branches_;
    ParticleId root_{}, base_{};
    std::vector<ParticleId> tops_; // by branch

    /// Particle at the lower end of a branch.
    ParticleId foot(std::size_t i) const { return i == 0 ? base_ : tops_[branches_[i].below]; }
    /// Particle at the lower end of the parent branch.
    ParticleId before(std::size_t i) const {
        if (i == 0) return root_;
        return branches_[i].below == 0 ? base_ : tops_[branches_[branches_[i].below].below];
    }

    /// Root and base are held, so their mass has no effect; all but a little of the mass goes to the branches.
    void add_particles() {
        constexpr double below_ground = 0.01;
        const double mass = tree_.mass, whole = volume_of(branches_);
        root_ = figure_.particle("root", on_screen<D>(0, -tree_.branch * tree_.shrink / 2), mass * below_ground / 2);
        base_ = figure_.particle("base", {}, mass * below_ground / 2);
        figure_.number_particles("particle", branches_.size());
        for (const auto& b : branches_)
            tops_.push_back(
                figure_.particle("", on_screen<D>(b.top[0], b.top[1]), mass * (1 - below_ground) * b.volume() / whole));
        figure_.hold(root_);
        figure_.hold(base_);
    }

    void add_constraints() {
        const bool classic = figure_.mode() == Mode::classic;
        // Torn from the ground, the trunk still has a foot to bend against.
        if (!classic) figure_.template constrain<Distance>("stump", {root_, base_});
        figure_.number_constraints("branch", branches_.size());
        for (std::size_t i = 0; i < branches_.size(); ++i)
            figure_.template constrain<Distance>("", {foot(i), tops_[i]});
        figure_.number_constraints("joint", branches_.size());
        for (std::size_t i = 0; i < branches_.size(); ++i) {
            const auto& b = branches_[i];
            const double thick = thickness_at(b.level), share = double(b.level) / double(tree_.depth + 1);
            auto spec = Elasticity::of_rod(b.length, tree_.bend_stiffness * thick * thick * thick * thick).spec();
            if (classic) spec.relaxation = tree_.joint_relaxation * (1 - share);
            figure_.template constrain<Angle>("", {before(i), foot(i), tops_[i]}, spec);
        }
    }

    /// Shaded leaves behind the branches, bright ones before; twigs first, the trunk on top.
    void draw() {
        const double leaf = tree_.leaf, thickness = tree_.thickness;
        for (const std::size_t which : {0U, 1U, 2U}) draw_leaves("shade", tree_.depth - 1, which, 1.3 * leaf);
        draw_leaves("shade", tree_.depth, 0, 1.2 * leaf);
        for (std::size_t i = branches_.size(); i-- > 0;)
            figure_.draw_tapered(Mark::stroke, "branch", {foot(i), tops_[i]},
                                 thickness * thickness_at(branches_[i].level),
                                 thickness * thickness_at(branches_[i].level + 1));
        draw_leaves("leaf", tree_.depth, 1, leaf);
        draw_leaves("bright", tree_.depth, 2, 0.8 * leaf);
    }

    /// Leaves on every third branch of a level.
    void draw_leaves(std::string_view part, int level, std::size_t which, double size) {
        if (!(tree_.leaf > 0)) return;
        for (std::size_t i = 0, count = 0; i < branches_.size(); ++i)
            if (branches_[i].level == level && count++ % 3 == which) figure_.draw(Mark::dot, part, {tops_[i]}, size);
    }
};

} // namespace

template <int D, class Real> void Tree::build(Builder<D, Real>& figure) const {
    TreeBuilder(*this, figure).build();
}

#define SINEW_TREE(D, Real) template void Tree::build(Builder<D, Real>&) const;
SINEW_INSTANTIATE_2D(SINEW_TREE)

} // namespace sinew
