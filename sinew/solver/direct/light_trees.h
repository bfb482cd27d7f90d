#pragma once

#include "sinew/solver/block.h"

/// Light trees of a block: parts that hang on one node of the rest and are much lighter, such as the tail of a rope
/// below a heavy bead, or spokes on a hub with springs between them. A link in such a tree moves the lighter side and
/// little else. With a penalty in proportion to all mass, the light masses would be lost to rounding in the
/// elimination, and tolerances in proportion to all weight would be larger than any tension in the tree.
namespace sinew::detail {

inline constexpr double light = 1e-3; ///< mass of a light tree, at most, as a fraction of the block's

template <int D> class LightTrees {
  public:
    LightTrees(Blocks<D>& blocks, const Block& block) : blocks_(blocks), block_(block) {}

    /// Sets `share` of every link. False if all are 1.
    bool run(double total_mass) {
        held_ = total_mass;
        begin();
        for (auto i = block_.first_node; i < end(); ++i) join(i);
        for (auto i = end(); i-- > block_.first_node;) find_rest(i);
        bool any = false;
        for (auto& link : links()) {
            const auto first = min(link.a, link.b);
            const bool joins = link.entry != Blocks<D>::none;
            const double share = joins ? min(node(first).behind, node(first).rest) / held_ : 1;
            link.share = share < light ? share : 1;
            any = any || share < light;
        }
        return any;
    }

  private:
    Blocks<D>& blocks_;
    const Block& block_;
    double held_ = 0; ///< mass that stands for whatever holds a node

    std::uint32_t end() const { return block_.first_node + block_.unknowns; }
    BlockNode<D>& node(std::uint32_t i) const { return blocks_.nodes[i]; }
    std::span<DistanceRow<D>> links() const {
        return std::span(blocks_.links).subspan(block_.first_link, block_.links);
    }
    /// True if all that was eliminated before the node is coupled with one later node.
    bool is_leaf(std::uint32_t i) const { return blocks_.first_entry[i + 1] == blocks_.first_entry[i] + 1; }
    bool has_later(std::uint32_t i) const { return blocks_.first_entry[i + 1] > blocks_.first_entry[i]; }
    /// The first of the later nodes that a node is coupled with.
    std::uint32_t parent(std::uint32_t i) const { return blocks_.entries[blocks_.first_entry[i]].node; }

    /// Immovable nodes, angles and cables hold the nodes that they act on.
    void begin() {
        for (auto i = block_.first_node; i < end(); ++i) node(i).behind = node(i).mass;
        for (const auto& link : links())
            if (link.entry == Blocks<D>::none) hold(min(link.a, link.b));
        for (const auto& bend : std::span(blocks_.bends).subspan(block_.first_bend, block_.bends))
            for (std::size_t k = 0; k < bend.arity; ++k) hold(bend.nodes[k]);
        for (const auto& way : std::span(blocks_.ways).subspan(block_.first_way, block_.ways))
            for (const auto& on : std::span(blocks_.way_nodes).subspan(way.first, way.nodes)) hold(on.node);
    }
    void hold(std::uint32_t i) {
        if (i < end()) node(i).behind += held_;
    }
    /// Mass behind a node: its own, and that of all nodes eliminated before which the rest meets through this one
    /// first.
    void join(std::uint32_t i) {
        if (has_later(i)) node(parent(i)).behind += node(i).behind;
    }
    /// Mass on the other side. Links of a loop move all that hangs with the loop on one later node.
    void find_rest(std::uint32_t i) {
        auto& at = node(i);
        at.rest = 0;
        if (!has_later(i)) return;
        const auto& next = node(parent(i));
        if (is_leaf(i))
            at.rest = max(next.behind + next.rest - at.behind, next.mass);
        else
            at.behind = next.behind, at.rest = next.rest;
    }
};

} // namespace sinew::detail
