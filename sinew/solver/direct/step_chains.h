#pragma once

#include "sinew/solver/direct/find_chain.h"
#include "sinew/solver/direct/lane_step.h"

/// Step of the chains, side by side in lanes.
namespace sinew::detail {

template <int D, class Real> class ChainStep : LaneStep<ChainStep<D, Real>, D, Real> {
    using Base = LaneStep<ChainStep, D, Real>;
    friend Base;

  public:
    ChainStep(World<D, Real>& world, Solver<D, Real>& solver, ChainSpace<D>& space, double frame, int substeps)
        : Base(world, solver, space.pack, frame, substeps), space_(space), pack_(space.pack),
          chains_(solver.blocks.chains), distances_(std::get<kind_number<Distance, D>>(world.constraints)) {}

    static bool are_alike(const ChainTurn& a, const ChainTurn& b) { return a.links == b.links; }

    /// Moves the chains of `turns`, all of the same number of links.
    template <class Whole, class Redo>
    void run(std::span<const ChainTurn> turns, double report_substep, Whole&& whole, Redo&& redo) {
        const auto& kernel = Base::kernel_;
        const bool single = turns.size() == 1 || turns.front().links > ChainSpace<D>::max_links_in_lanes;
        pack_.width = single ? min_block_lanes : kernel.block_lanes;
        pack_.links = int(turns.front().links);
        constexpr std::size_t per_node = sizeof(Node) / sizeof(double);
        Base::template exchange_with<Node>(pack_.nodes + per_node * std::size_t(pack_.width), turns.front().links,
                                           space_.rows.data());
        const auto swing = [&] { single ? kernel.swing_chain(pack_) : kernel.swing_chains(pack_); };
        Base::run(turns, report_substep, swing, whole, redo);
    }

  private:
    using Node = ChainNode<D, double>;

    ChainSpace<D>& space_;
    ChainPack<D>& pack_;
    const Chains<D>& chains_;
    Constraints<Distance<D>, Real>& distances_;

    LaneTable nodes(int lane) const { return LaneTable::of<Node>(pack_.nodes, pack_.width, lane); }
    const BlockChain& chain_of(const Block& block) const { return chains_.list[block.chain]; }
    std::span<const ChainLink> links_of(const Block& block) const {
        return std::span(std::as_const(chains_.links)).subspan(chain_of(block).first, chain_of(block).links);
    }
    double& tension(int lane, std::size_t link) const { return nodes(lane).at(link + 1, offsetof(Node, tension)); }

    template <class Visit> void each_particle(const Block& block, Visit&& visit) const {
        for (const auto& link : links_of(block)) visit(link.particle);
    }
    template <class Visit> void each_held(const Block& block, Visit&& visit) const { visit(chain_of(block).held); }
    double length_of(const Block& block) const {
        double length = 0;
        for (const auto& link : links_of(block)) length += link.length;
        return length;
    }

    void load(int lane, const Block& block) {
        const auto table = nodes(lane);
        const auto links = links_of(block);
        table.template put<D>(0, offsetof(Node, start), Base::held_position(chain_of(block).held));
        for (std::size_t i = 1; i <= links.size(); ++i) {
            const auto& link = links[i - 1];
            const double length2 = square(link.length);
            table.at(i, offsetof(Node, length2)) = length2;
            table.at(i, offsetof(Node, per_length2)) = 1 / length2;
            table.at(i, offsetof(Node, pulls_only)) = link.pulls_only;
        }
    }

    void load_tensions(int lane, const Block& block, double per) const {
        const auto links = links_of(block);
        for (std::size_t i = 0; i < links.size(); ++i)
            tension(lane, i) = -double(distances_.multiplier[links[i].constraint]) * per / links[i].length;
    }
    void report_tensions(int lane, const Block& block, double substep) const {
        const auto links = links_of(block);
        for (std::size_t i = 0; i < links.size(); ++i)
            distances_.multiplier[links[i].constraint] =
                BlockTensions<D, Real>::multiplier(tension(lane, i) * links[i].length, substep);
    }
    void take_tensions(int lane, const Block& block) const {
        const auto links = links_of(block);
        for (std::size_t i = 0; i < links.size(); ++i) tension(lane, i) = Base::blocks_.links[links[i].link].before;
    }
    void put_tensions(int lane, const Block& block) const {
        const auto links = links_of(block);
        for (std::size_t i = 0; i < links.size(); ++i) Base::blocks_.links[links[i].link].before = tension(lane, i);
    }
};

} // namespace sinew::detail
