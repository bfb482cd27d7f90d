#pragma once

#include "sinew/solver/direct/angle_rows.h"
#include "sinew/solver/direct/cable_rows.h"
#include "sinew/solver/direct/light_trees.h"

/// Linear equations of a block, assembled by links, angles and cables, and measurements of the block.
namespace sinew::detail {

template <int D> class BlockEquations {
  public:
    using Vector = Vec<D, double>;

    BlockEquations(Blocks<D>& blocks, const Block& block, double substep)
        : blocks_(blocks), block_(block), bends_(blocks, block, substep), ways_(blocks, block, substep), h_(substep),
          per_h_(1 / substep) {
        constexpr double relative = 1e4; // stiffness of a rigid link, over total mass / h^2
        for (const auto& node : unknowns()) {
            total_mass_ += node.mass;
            weight_ += node.mass * norm(node.push);
            lightest_ = minimum(lightest_, node.mass);
        }
        stiffness_ = relative * total_mass_ * per_h_ * per_h_;
    }

    std::span<BlockNode<D>> nodes() const { return std::span(blocks_.nodes).subspan(block_.first_node, block_.nodes); }
    std::span<BlockNode<D>> unknowns() const {
        return std::span(blocks_.nodes).subspan(block_.first_node, block_.unknowns);
    }
    std::span<DistanceRow<D>> links() const {
        return std::span(blocks_.links).subspan(block_.first_link, block_.links);
    }
    BlockBends<D>& bends() { return bends_; }
    const BlockBends<D>& bends() const { return bends_; }
    BlockWays<D>& ways() { return ways_; }
    const BlockWays<D>& ways() const { return ways_; }
    BlockNode<D>& node(std::uint32_t i) const { return blocks_.nodes[i]; }
    const Block& block() const { return block_; }
    double substep() const { return h_; }
    double total_mass() const { return total_mass_; }
    /// Sum of the magnitudes of the field forces.
    double weight() const { return weight_; }
    /// Penalty stiffness of a rigid link of length 1.
    double stiffness() const { return stiffness_; }
    /// Penalty stiffness of one rigid link, relative to `stiffness()`: the mass that the link moves, relative to all.
    double share(const DistanceRow<D>& link) const { return has_light_trees_ ? link.share : 1; }
    /// Fits penalties and tolerances to light trees from now on. Only for a block on which nothing acts but fields and
    /// immovable nodes.
    void find_light_trees() {
        has_light_trees_ = lightest_ < light * total_mass_ && LightTrees<D>(blocks_, block_).run(total_mass_);
    }

    /// True for a spring; stiffer than the penalty counts as rigid.
    bool soft(const DistanceRow<D>& link) const { return link.compliance * stiffness_ > 1; }

    /// True for a joint's range that a link can leave, and comes back from at the speed of arrival.
    bool bounces(const DistanceRow<D>& link) const { return ranges_bounce_ && link.is_range() && !soft(link); }

    void clear_entries() {
        const auto begin = blocks_.first_entry[block_.first_node];
        const auto end = blocks_.first_entry[block_.first_node + block_.unknowns];
        for (auto e = begin; e < end; ++e) blocks_.entries[e].lower = blocks_.entries[e].upper = {};
    }
    [[gnu::always_inline]] void add(const DistanceRow<D>& link, const Matrix<D, double>& stiffness,
                                    const Vector& force) {
        auto &a = node(link.a), &b = node(link.b);
        a.diagonal += stiffness;
        b.diagonal += stiffness;
        if (link.entry != Blocks<D>::none) {
            blocks_.entries[link.entry].lower -= stiffness;
            blocks_.entries[link.entry].upper -= stiffness;
        }
        a.residual += force;
        b.residual -= force;
    }
    void solve() { solve_block(blocks_, block_); }

    /// Worst violation of a rigid link, as Green strain, at the positions at(node).
    template <class At> double worst_strain(At&& at) const {
        double worst = 0;
        for (const auto& link : links()) {
            if (soft(link)) continue;
            const auto span = at(node(link.b)) - at(node(link.a));
            const double length2 = dot(span, span);
            const double error = maximum(length2 - square(link.high), square(link.low) - length2);
            worst = maximum(worst, 0.5 * error * link.per_length2);
        }
        return worst;
    }
    double worst_start_strain() const {
        return maximum(worst_strain(start_of), maximum(bends_.worst_warp(true), ways_.worst_strain(true)));
    }
    double worst_place_strain() const {
        return maximum(worst_strain(place_of), maximum(bends_.worst_warp(false), ways_.worst_strain(false)));
    }
    static const Vector& start_of(const BlockNode<D>& node) { return node.start; }
    static const Vector& place_of(const BlockNode<D>& node) { return node.place; }

    /// True if velocities would change lengths more than a swing does in a time h, as after a blow.
    bool has_velocity_error(double h) const {
        const double usual = block_.is_motorized ? 1e-4 : 0.02; // motors start and stop, and must not ring
        for (const auto& link : links()) {
            if (soft(link) || (link.one_sided() && link.tension == 0)) continue;
            const auto span = node(link.b).place - node(link.a).place;
            const double rate = dot(span, node(link.b).velocity - node(link.a).velocity);
            if (absolute(rate) * h > usual * square(link.length)) return true;
        }
        return ways_.has_velocity_error(usual, h);
    }

    /// Kinetic energy, half the sum of m v^2.
    double kinetic() const {
        double sum = 0;
        for (const auto& node : unknowns()) sum += 0.5 * node.mass * dot(node.velocity, node.velocity);
        return sum;
    }

    double stored(const DistanceRow<D>& link, const Vector& span) const {
        if (!soft(link)) return 0;
        const double length = norm(span);
        return 0.5 * square(length - clamp(length, link.low, link.high)) / link.compliance;
    }

  protected:
    Blocks<D>& blocks_;
    const Block& block_;
    BlockBends<D> bends_;
    BlockWays<D> ways_;
    double h_, per_h_;
    bool ranges_bounce_ = false;
    double total_mass_ = 0, weight_ = 0, stiffness_ = 0;
    double lightest_ = 1e300;      ///< mass of the lightest node, kg
    bool has_light_trees_ = false; ///< `share` of the links is in use
};

} // namespace sinew::detail
