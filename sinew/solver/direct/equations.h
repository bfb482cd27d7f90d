#pragma once

#include "sinew/solver/direct/angle_rows.h"
#include "sinew/solver/direct/cable_rows.h"
#include "sinew/solver/direct/distance_rows.h"
#include "sinew/solver/direct/light_trees.h"

namespace sinew::detail {

/// Sums over the unknowns of a block.
template <int D> struct NodeSums {
    double mass = 0;
    double weight = 0;       ///< sum of the magnitudes of the field forces, N
    double lightest = 1e300; ///< mass of the lightest node, kg

    explicit NodeSums(std::span<const BlockNode<D>> nodes) {
        for (const auto& node : nodes) {
            mass += node.mass;
            weight += node.mass * norm(node.acceleration);
            lightest = min(lightest, node.mass);
        }
    }
};

/// Linear equations of a block, assembled by links, angles and cables, and measurements of the block.
template <int D> class BlockEquations {
  public:
    using Vector = Vec<D, double>;

    BlockEquations(Blocks<D>& blocks, const Block& block, double substep)
        : blocks_(blocks), block_(block), h_(substep), per_h_(1 / substep), sums_(unknowns()),
          links_(blocks, block, relative_stiffness * sums_.mass * per_h_ * per_h_), bends_(blocks, block, substep),
          ways_(blocks, block, substep) {}

    std::span<BlockNode<D>> nodes() const { return std::span(blocks_.nodes).subspan(block_.first_node, block_.nodes); }
    std::span<BlockNode<D>> unknowns() const {
        return std::span(blocks_.nodes).subspan(block_.first_node, block_.unknowns);
    }
    DistanceRows<D>& links() { return links_; }
    const DistanceRows<D>& links() const { return links_; }
    AngleRows<D>& bends() { return bends_; }
    const AngleRows<D>& bends() const { return bends_; }
    CableRows<D>& ways() { return ways_; }
    const CableRows<D>& ways() const { return ways_; }
    BlockNode<D>& node(std::uint32_t i) const { return blocks_.nodes[i]; }
    const Block& block() const { return block_; }
    double substep() const { return h_; }
    double total_mass() const { return sums_.mass; }
    /// Sum of the magnitudes of the field forces.
    double weight() const { return sums_.weight; }

    /// Fits penalties and tolerances to light trees from now on. Only for a block on which nothing acts but fields and
    /// immovable nodes.
    void find_light_trees() {
        if (sums_.lightest < light * sums_.mass && LightTrees<D>(blocks_, block_).run(sums_.mass)) links_.use_shares();
    }

    void clear_entries() {
        const auto begin = blocks_.first_entry[block_.first_node];
        const auto end = blocks_.first_entry[block_.first_node + block_.unknowns];
        for (auto e = begin; e < end; ++e) blocks_.entries[e].lower = blocks_.entries[e].upper = {};
    }
    void solve() { solve_block(blocks_, block_); }

    double worst_start_strain() const {
        return max(links_.worst_strain(start_of), max(bends_.worst_warp(true), ways_.worst_strain(true)));
    }
    double worst_position_strain() const {
        return max(links_.worst_strain(position_of), max(bends_.worst_warp(false), ways_.worst_strain(false)));
    }
    static const Vector& start_of(const BlockNode<D>& node) { return node.start; }
    static const Vector& position_of(const BlockNode<D>& node) { return node.position; }

    /// True if velocities would change lengths more than a swing does in a time h, as after a blow.
    bool has_velocity_error(double h) const {
        const double usual = block_.is_motorized ? 1e-4 : 0.02; // motors start and stop, and must not ring
        return links_.has_velocity_error(usual, h) || ways_.has_velocity_error(usual, h);
    }

    /// Kinetic energy, half the sum of m v^2.
    double kinetic() const {
        double sum = 0;
        for (const auto& node : unknowns()) sum += 0.5 * node.mass * dot(node.velocity, node.velocity);
        return sum;
    }

  protected:
    Blocks<D>& blocks_;
    const Block& block_;
    double h_, per_h_;
    NodeSums<D> sums_;
    DistanceRows<D> links_;
    AngleRows<D> bends_;
    CableRows<D> ways_;

  private:
    static constexpr double relative_stiffness = 1e4; ///< stiffness of a rigid link, over total mass / h^2
};

} // namespace sinew::detail
