#pragma once

#include "sinew/math/decay.h"
#include "sinew/solver/direct/chain_room.h"
#include "sinew/solver/direct/find_chain.h"
#include "sinew/solver/direct/light_trees.h"
#include "sinew/solver/direct/look_up_rows.h"
#include "sinew/solver/phases.h"
#include "sinew/solver/simd/kernel.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

/// Step of the chains: many side by side, each lane with a chain and a substep of its own. A substep that fails is cut
/// into halves, and the lane goes on with the first; a chain that has arrived makes room for the next. A chain that
/// needs more than shorter substeps is handed to the solver of blocks (direct/step_blocks.cpp) for one substep.
namespace sinew::detail {

/// Part of a step, in units of the shortest substep.
struct ChainClock {
    static constexpr std::uint32_t deepest = 6; ///< maximum depth of division of a substep
    static constexpr std::uint32_t whole = 64;  ///< shortest substeps in an undivided one: 2^deepest

    std::uint32_t begun = 0, depth = 0;

    std::uint32_t length() const { return whole >> depth; }
    std::uint32_t end() const { return begun + length(); }
    /// Goes on with the next substep: as long as the one that has been divided, once all its parts are done.
    void advance() {
        begun = end();
        while (depth > 0 && begun % (2 * length()) == 0) --depth;
    }
};

/// Looks up the rows of a block by slots, if rows have moved, and with them those of the chain.
template <int D, class Real> void follow_rows(const World<D, Real>& world, Blocks<D>& blocks, Block& block) {
    if (block.row_moves == world.journal.row_moves) return;
    look_up_rows(world, blocks, block);
    if (block.chain == Blocks<D>::none) return;
    auto& chain = blocks.chains.list[block.chain];
    chain.held = blocks.nodes[chain.held_node].row;
    for (auto& link : std::span(blocks.chains.links).subspan(chain.first, chain.links)) {
        link.particle = blocks.nodes[link.node].row;
        link.constraint = blocks.links[link.link].constraint;
    }
}

template <int D, class Real> class ChainStep {
  public:
    ChainStep(World<D, Real>& world, Solver<D, Real>& solver, ChainSpace<D>& space, double frame, int substeps)
        : world_(world), solver_(solver), particles_(world.particles), blocks_(solver.blocks), chains_(blocks_.chains),
          space_(space), pack_(space.pack), distances_(std::get<kind_number<Distance, D>>(world.constraints)),
          frame_(frame), last_(ChainClock::whole * std::uint32_t(substeps)),
          per_last2_(inverse_or_zero(square(double(world.last_substep)))) {
        pack_.longest = frame / substeps;
        for (std::uint32_t depth = 0; depth <= ChainClock::deepest; ++depth)
            decay_[depth] = Decay<double>::of(clamp(double(world.settings.damping), 0.0, limit::measure<double>),
                                              pack_.longest / double(1U << depth));
    }

    /// True if chains can be solved in lanes in this world: no field acts on them but gravity.
    static bool serves(const World<D, Real>& world) {
        return std::all_of(world.forces.begin(), world.forces.end(),
                           [](const auto& force) { return std::holds_alternative<Gravity<D, Real>>(force); });
    }

    /// Moves the chains of `turns`, all of the same number of links. `whole(block)` moves a block as any other;
    /// `redo(block, from, to, depth, tensions)` moves one over a part of the step, and returns the energy lost.
    template <class Whole, class Redo>
    void run(std::span<const ChainTurn> turns, double report_substep, Whole&& whole, Redo&& redo) {
        const auto& kernel = kernels<D, Real>(solver_.options.simd);
        const bool single = turns.size() == 1 || turns.front().links > ChainSpace<D>::most_links_in_lanes;
        pack_.width = single ? 1 : kernel.chain_lanes;
        pack_.links = int(turns.front().links);
        pack_.active = {};
        for (auto next = turns.begin();;) {
            int busy = 0;
            for (int l = 0; l < pack_.width; ++l) {
                while (!lanes_[l].block && next != turns.end()) take_in(l, blocks_.list[(next++)->block], whole);
                busy += lanes_[l].block != nullptr;
            }
            if (busy == 0) return;
            single ? kernel.swing_chain(pack_) : kernel.swing_chains(pack_);
            for (int l = 0; l < pack_.width; ++l)
                if (lanes_[l].block) go_on(l, report_substep, redo);
        }
    }

  private:
    using Node = ChainNode<D, double>;
    struct Lane {
        Block* block = nullptr;
        ChainClock clock;
    };

    World<D, Real>& world_;
    Solver<D, Real>& solver_;
    Particles<D, Real>& particles_;
    Blocks<D>& blocks_;
    Chains<D>& chains_;
    ChainSpace<D>& space_;
    ChainPack<D>& pack_;
    Constraints<Distance<D>, Real>& distances_;
    double frame_;
    std::uint32_t last_; ///< end of the step, in shortest substeps
    double per_last2_;   ///< 1 / squared length of the substep that multipliers were reported for
    std::array<Decay<double>, ChainClock::deepest + 1> decay_;
    std::array<Lane, max_chain_lanes> lanes_{};
    std::array<Vec<D, double>, max_chain_lanes> push_{}; ///< acceleration by gravity, m/s^2
    std::array<double, max_chain_lanes> weight_reach_{}; ///< weight times length, J

    /// Number of a node in a lane, at an offset in ChainNode.
    double& number(int lane, std::uint32_t node, std::size_t offset) const {
        constexpr std::size_t per_node = sizeof(Node) / sizeof(double);
        return pack_.nodes[(node * per_node + offset / sizeof(double)) * std::size_t(pack_.width) + std::size_t(lane)];
    }
    void put(int lane, std::uint32_t node, std::size_t offset, const Vec<D, double>& vector) const {
        for (int k = 0; k < D; ++k) number(lane, node, offset + std::size_t(k) * sizeof(double)) = vector[k];
    }
    Vec<D, double> get(int lane, std::uint32_t node, std::size_t offset) const {
        return Vec<D, double>::map([&](int k) { return number(lane, node, offset + std::size_t(k) * sizeof(double)); });
    }
    std::span<const ChainLink> links_of(const BlockChain& chain) const {
        return std::span(std::as_const(chains_.links)).subspan(chain.first, chain.links);
    }
    const BlockChain& chain_of(const Block& block) const { return chains_.list[block.chain]; }

    // --- into the lanes

    template <class Whole> void take_in(int lane, Block& block, Whole&& whole) {
        follow_rows(world_, blocks_, block);
        const auto& chain = chain_of(block);
        if (!fits(chain) || !find_room(lane, chain)) return whole(block);
        block.lost = 0;
        lanes_[std::size_t(lane)] = {&block, {}};
        load_tensions(chain);
        load(lane, chain);
        start_substep(lane, true);
    }

    /// False for a chain that something pulls or carries about, and for one of very unequal masses.
    bool fits(const BlockChain& chain) const {
        double lightest = 1e300, total = 0;
        for (const auto& link : links_of(chain)) {
            const auto row = link.particle;
            const double mass = inverse_or_zero(double(particles_.inverse_mass[row]));
            total += mass;
            lightest = minimum(lightest, mass);
            if (particles_.any_force && particles_.force[row] != Vec<D, Real>{}) return false;
            if (blocks_.pin_of[row] != Blocks<D>::none) return false;
        }
        for (auto i = blocks_.pin_of[chain.held]; i != Blocks<D>::none; i = blocks_.next_pin[i])
            if (!(world_.pins[i].from == world_.pins[i].target)) return false;
        return lightest >= light * total;
    }

    /// Sets the room of a lane for the step. False if a plane or a collider may be touched. A whip gets faster than at
    /// the start: what leaves the room is left to the solver of blocks.
    bool find_room(int lane, const BlockChain& chain) {
        auto room = collide::BoundingBox<D, double>::everything();
        if (has_walls(world_)) {
            constexpr double margin = 2;
            collide::BoundingBox<D, double> reached;
            double length = 0, thickness = 0, fastest2 = 0;
            const auto held = held_place(chain);
            reached.include(held);
            for (const auto& link : links_of(chain)) {
                const auto velocity = cast<double>(particles_.velocity[link.particle]);
                reached.include(cast<double>(particles_.position[link.particle]));
                fastest2 = maximum(fastest2, dot(velocity, velocity));
                thickness = maximum(thickness, double(particles_.radius[link.particle]));
                length += link.length;
            }
            const double push = norm(cast<double>(push_on(world_, chains_.links[chain.first].particle).acceleration));
            const double reach = margin * frame_ * (square_root(fastest2) + frame_ * push) + thickness;
            room = ChainRoom<D, Real>(world_, solver_)
                       .find(held, 1.001 * length + thickness, reached.grown(reach))
                       .grown(-thickness);
            if (room.high[0] < room.low[0]) return false;
        }
        for (int k = 0; k < D; ++k) pack_.low[k].lane[lane] = room.low[k], pack_.high[k].lane[lane] = room.high[k];
        return true;
    }

    void load_tensions(const BlockChain& chain) const {
        const auto links = links_of(chain);
        for (std::size_t i = 0; i < links.size(); ++i)
            space_.tensions[i] = -double(distances_.multiplier[links[i].constraint]) * per_last2_ / links[i].length;
    }

    Vec<D, double> held_place(const BlockChain& chain) const {
        auto place = cast<double>(particles_.position[chain.held]);
        for (auto i = blocks_.pin_of[chain.held]; i != Blocks<D>::none; i = blocks_.next_pin[i])
            if (world_.pins[i].hard() && !particles_.quarantined[chain.held])
                place = cast<double>(world_.pins[i].target);
        return place;
    }

    /// Loads the state of the world, and the tensions of the space.
    void load(int lane, const BlockChain& chain) {
        double reach = 0, total = 0;
        put(lane, 0, offsetof(Node, start), held_place(chain));
        const auto links = links_of(chain);
        for (std::uint32_t i = 1; i <= links.size(); ++i) {
            const auto& link = links[i - 1];
            const auto row = link.particle;
            const double length2 = square(link.length), mass = inverse_or_zero(double(particles_.inverse_mass[row]));
            put(lane, i, offsetof(Node, start),
                cast<double>(particles_.position[row]) + cast<double>(particles_.residual[row]));
            put(lane, i, offsetof(Node, velocity), cast<double>(particles_.velocity[row]));
            number(lane, i, offsetof(Node, mass)) = mass;
            number(lane, i, offsetof(Node, length2)) = length2;
            number(lane, i, offsetof(Node, per_length2)) = 1 / length2;
            number(lane, i, offsetof(Node, tension)) = space_.tensions[i - 1];
            reach += link.length;
            total += mass;
        }
        const auto push = cast<double>(push_on(world_, links.front().particle).acceleration);
        const auto l = std::size_t(lane);
        push_[l] = push;
        pack_.reach.lane[l] = reach;
        weight_reach_[l] = total * norm(push) * reach;
        pack_.pulls_only.lane[l] = chain.pulls_only;
        pack_.active.lane[l] = 1;
    }

    void start_substep(int lane, bool fresh) {
        const auto l = std::size_t(lane);
        const auto depth = lanes_[l].clock.depth;
        const auto& decay = decay_[depth];
        pack_.fresh.lane[l] = fresh;
        pack_.shortest.lane[l] = depth == ChainClock::deepest;
        pack_.h.lane[l] = pack_.longest / double(1U << depth);
        pack_.keep.lane[l] = decay.keep;
        pack_.yield.lane[l] = decay.yield;
        for (int k = 0; k < D; ++k) pack_.push[k].lane[l] = push_[l][k] * decay.yield;
        pack_.weight_reach.lane[l] = weight_reach_[l] * decay.yield;
    }

    // --- on, and out of the lanes

    template <class Redo> void go_on(int lane, double report_substep, Redo&& redo) {
        const auto l = std::size_t(lane);
        auto& [block, clock] = lanes_[l];
        const bool good = pack_.good.lane[l] > 0;
        if (!good && pack_.alien.lane[l] == 0 && clock.depth < ChainClock::deepest) {
            ++clock.depth;
            return start_substep(lane, false);
        }
        if (good)
            block->lost += pack_.lost.lane[l] / pack_.yield.lane[l];
        else
            hand_over(lane, redo);
        clock.advance();
        if (clock.begun < last_) return start_substep(lane, !good);
        store(lane, chain_of(*block));
        report_tensions(lane, chain_of(*block), report_substep);
        block = nullptr;
        pack_.active.lane[l] = 0;
    }

    template <class Redo> void hand_over(int lane, Redo&& redo) {
        const auto& [block, clock] = lanes_[std::size_t(lane)];
        const auto& chain = chain_of(*block);
        store(lane, chain);
        for (std::uint32_t i = 0; i < chain.links; ++i)
            space_.tensions[i] = number(lane, i + 1, offsetof(Node, tension));
        const double from = double(clock.begun) / last_, to = double(clock.end()) / last_;
        block->lost += redo(*block, from, to, int(clock.depth) / 2, std::span(space_.tensions).first(chain.links));
        load(lane, chain);
    }

    void store(int lane, const BlockChain& chain) const {
        constexpr double fastest = double(limit::speed<Real>), furthest = double(limit::coordinate<Real>);
        const auto links = links_of(chain);
        for (std::uint32_t i = 1; i <= links.size(); ++i) {
            const auto row = links[i - 1].particle;
            const auto place = clamp_components(get(lane, i, offsetof(Node, start)), furthest);
            const auto held = cast<Real>(place);
            particles_.residual[row] = cast<Real>(place - cast<double>(held));
            particles_.position[row] = held;
            particles_.velocity[row] = cast<Real>(clamp_components(get(lane, i, offsetof(Node, velocity)), fastest));
        }
    }

    void report_tensions(int lane, const BlockChain& chain, double substep) const {
        constexpr double most = double(limit::multiplier<Real>);
        const auto links = links_of(chain);
        for (std::uint32_t i = 1; i <= links.size(); ++i) {
            const double tension = number(lane, i, offsetof(Node, tension));
            distances_.multiplier[links[i - 1].constraint] =
                Real(clamp(-tension * links[i - 1].length * square(substep), -most, most));
        }
    }
};

} // namespace sinew::detail
