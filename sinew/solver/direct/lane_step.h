#pragma once

#include "sinew/math/decay.h"
#include "sinew/solver/direct/chain_room.h"
#include "sinew/solver/direct/light_trees.h"
#include "sinew/solver/direct/look_up_rows.h"
#include "sinew/solver/direct/tensions.h"
#include "sinew/solver/phases.h"
#include "sinew/solver/simd/kernel.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

/// Step of blocks of equal structure side by side, each lane with a block and a substep of its own. A substep that
/// fails is cut into halves, and the lane goes on with the first; a block that has arrived makes room for the next. A
/// block that needs more than shorter substeps is handed to the solver of blocks (direct/step_blocks.cpp) for one
/// substep.
namespace sinew::detail {

/// Part of a step, in units of the shortest substep.
struct LaneClock {
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

/// A table of packs, `per` numbers of each lane in a row.
struct LaneTable {
    double* numbers;
    std::size_t per, width, lane;

    template <class Record> static LaneTable of(double* numbers, int width, int lane) {
        return {numbers, sizeof(Record) / sizeof(double), std::size_t(width), std::size_t(lane)};
    }
    /// Number of a row, at an offset in the record of one lane.
    double& at(std::size_t row, std::size_t offset) const {
        return numbers[(row * per + offset / sizeof(double)) * width + lane];
    }
    template <int D> void put(std::size_t row, std::size_t offset, const Vec<D, double>& vector) const {
        for (int k = 0; k < D; ++k) at(row, offset + std::size_t(k) * sizeof(double)) = vector[k];
    }
    template <int D> Vec<D, double> get(std::size_t row, std::size_t offset) const {
        return Vec<D, double>::map([&](int k) { return at(row, offset + std::size_t(k) * sizeof(double)); });
    }
};

/// True if blocks can be solved in lanes in this world: no field acts on them but gravity.
template <int D, class Real> bool serves_lanes(const World<D, Real>& world) {
    return std::all_of(world.forces.begin(), world.forces.end(),
                       [](const auto& force) { return std::holds_alternative<Gravity<D, Real>>(force); });
}

/// Looks up the rows of a block by slots, if rows have moved, and with them those of a chain.
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

/// `Layout` knows where the numbers of a block are: load(lane, block) moves constants into the lane;
/// load_tensions(lane, block, per) and report_tensions(lane, block, substep) tensions between multipliers and lane,
/// take_tensions(lane, block) and put_tensions(lane, block) between rows and lane. each_particle(block, visit) and
/// each_held(block, visit) visit rows of particles.
template <class Layout, int D, class Real> class LaneStep {
  public:
    LaneStep(World<D, Real>& world, Solver<D, Real>& solver, LanePack<D>& pack, double frame, int substeps)
        : world_(world), solver_(solver), particles_(world.particles), blocks_(solver.blocks), pack_(pack),
          kernel_(kernels<D, Real>(solver.options.simd)), frame_(frame),
          last_(LaneClock::whole * std::uint32_t(substeps)),
          per_last2_(inverse_or_zero(square(double(world.last_substep)))) {
        pack_.longest = frame / substeps;
        if (particles_.position.empty()) return;
        exchange_.position = particles_.position.data()->component.data();
        exchange_.residual = particles_.residual.data()->component.data();
        exchange_.velocity = particles_.velocity.data()->component.data();
        exchange_.inverse_mass = particles_.inverse_mass.data();
        for (std::uint32_t depth = 0; depth <= LaneClock::deepest; ++depth)
            decay_[depth] = Decay<double>::of(clamp(double(world.settings.damping), 0.0, limit::measure<double>),
                                              pack_.longest / double(1U << depth));
    }

  protected:
    struct Lane {
        Block* block = nullptr;
        LaneClock clock;
    };

    World<D, Real>& world_;
    Solver<D, Real>& solver_;
    Particles<D, Real>& particles_;
    Blocks<D>& blocks_;
    LanePack<D>& pack_;
    const Kernels<D, Real>& kernel_;
    NodeExchange<D, Real> exchange_;

    /// Moves the blocks of `turns`, all of one structure. `swing()` moves the lanes on by a substep; `whole(block)`
    /// moves a block as any other; `redo(block, from, to, depth)` moves one over a part of the step, and returns the
    /// energy lost.
    template <class Turns, class Swing, class Whole, class Redo>
    void run(const Turns& turns, double report_substep, Swing&& swing, Whole&& whole, Redo&& redo) {
        pack_.active = {};
        for (auto next = turns.begin();;) {
            for (int l = 0; l < pack_.width; ++l)
                while (!lanes_[std::size_t(l)].block && next != turns.end())
                    take_in(l, blocks_.list[(next++)->block], whole);
            exchange_nodes(kernel_.load_nodes);
            if (std::none_of(lanes_.begin(), lanes_.end(), [](const Lane& lane) { return lane.block; })) return;
            swing();
            for (int l = 0; l < pack_.width; ++l)
                if (lanes_[std::size_t(l)].block) go_on(l, report_substep, redo);
            exchange_nodes(kernel_.store_nodes);
        }
    }

    Vec<D, double> held_position(Row row) const {
        auto position = cast<double>(particles_.position[row]);
        for (auto i = blocks_.pin_of[row]; i != Blocks<D>::none; i = blocks_.next_pin[i])
            if (world_.pins[i].hard() && !particles_.quarantined[row]) position = cast<double>(world_.pins[i].target);
        return position;
    }
    /// Movable nodes of the lanes: `count` records from `nodes` on. `rows` has room for a particle of each lane.
    template <class Node> void exchange_with(double* nodes, std::size_t count, std::uint32_t* rows) {
        constexpr auto after = [](int vectors) { return std::size_t(vectors * D) * sizeof(double); };
        static_assert(offsetof(Node, start) == 0 && offsetof(Node, velocity) == after(1) &&
                      offsetof(Node, mass) == after(2));
        exchange_.nodes = nodes, exchange_.numbers = sizeof(Node) / sizeof(double);
        exchange_.count = std::uint32_t(count), exchange_.width = pack_.width;
        exchange_.rows = rows_ = rows;
        exchange_.has_last_row = false;
    }

  private:
    std::uint32_t* rows_ = nullptr;             ///< particles of the nodes, a row for each node
    std::array<bool, max_block_lanes> moves_{}; ///< lanes whose nodes are to be exchanged with the particles
    double frame_;
    std::uint32_t last_; ///< end of the step, in shortest substeps
    double per_last2_;   ///< 1 / squared length of the substep that multipliers were reported for
    std::array<Decay<double>, LaneClock::deepest + 1> decay_;
    std::array<Lane, max_block_lanes> lanes_{};
    std::array<Vec<D, double>, max_block_lanes> acceleration_{}; ///< acceleration by gravity, m/s^2
    std::array<double, max_block_lanes> weight_length_{};        ///< weight times length, J

    Layout& layout() { return static_cast<Layout&>(*this); }

    // --- into the lanes

    template <class Whole> void take_in(int lane, Block& block, Whole&& whole) {
        follow_rows(world_, blocks_, block);
        if (!fits(lane, block) || !find_room(lane, block)) return whole(block);
        block.lost = 0;
        lanes_[std::size_t(lane)] = {&block, {}};
        start_block(lane, block);
        layout().load(lane, block);
        layout().load_tensions(lane, block, per_last2_);
        start_substep(lane, true);
    }
    void start_block(int lane, const Block& block) {
        const auto l = std::size_t(lane), width = std::size_t(pack_.width);
        std::size_t at = l;
        layout().each_particle(block, [&](Row row) {
            rows_[at] = row;
            at += width;
            exchange_.has_last_row = exchange_.has_last_row || row + 1 == particles_.position.size();
        });
        pack_.total_length.lane[l] = layout().length_of(block);
        acceleration_[l] = cast<double>(forcing_on(world_, rows_[l]).acceleration);
        weight_length_[l] = pack_.total.lane[l] * norm(acceleration_[l]) * pack_.total_length.lane[l];
        pack_.active.lane[l] = 1;
        moves_[l] = true;
    }
    /// Moves the nodes of the lanes that are to be exchanged: all at once, or one after the other.
    void exchange_nodes(void (*kernel)(const NodeExchange<D, Real>&, int, int)) {
        const auto width = std::size_t(pack_.width);
        if (std::all_of(moves_.begin(), moves_.begin() + std::ptrdiff_t(width), [](bool moves) { return moves; }))
            kernel(exchange_, 0, pack_.width);
        else
            for (std::size_t l = 0; l < width; ++l)
                if (moves_[l]) kernel(exchange_, int(l), int(l) + 1);
        moves_ = {};
    }

    /// False for a block that something pulls or carries about, and for one of very unequal masses. Sets the total mass
    /// of the lane.
    bool fits(int lane, const Block& block) {
        double lightest = 1e300, total = 0;
        bool is_left_alone = true;
        layout().each_particle(block, [&](Row row) {
            const double mass = inverse_or_zero(double(particles_.inverse_mass[row]));
            total += mass;
            lightest = min(lightest, mass);
            const bool is_pulled = particles_.any_force && particles_.force[row] != Vec<D, Real>{};
            is_left_alone = is_left_alone && !is_pulled && blocks_.pin_of[row] == Blocks<D>::none;
        });
        layout().each_held(block, [&](Row row) {
            for (auto i = blocks_.pin_of[row]; i != Blocks<D>::none; i = blocks_.next_pin[i])
                is_left_alone = is_left_alone && world_.pins[i].from == world_.pins[i].target;
        });
        pack_.total.lane[std::size_t(lane)] = total;
        return is_left_alone && lightest >= light * total;
    }

    /// Sets the room of a lane for the step. False if a plane or a collider may be touched. A whip gets faster than at
    /// the start: what leaves the room is left to the solver of blocks.
    bool find_room(int lane, const Block& block) {
        auto room = collide::BoundingBox<D, double>::everything();
        if (has_walls(world_)) room = room_of(block);
        if (room.high[0] < room.low[0]) return false;
        const auto l = std::size_t(lane);
        for (int k = 0; k < D; ++k) pack_.low[k].lane[l] = room.low[k], pack_.high[k].lane[l] = room.high[k];
        return true;
    }
    collide::BoundingBox<D, double> room_of(const Block& block) {
        constexpr double margin = 2;
        collide::BoundingBox<D, double> reached;
        double thickness = 0, fastest2 = 0;
        Row any = 0;
        layout().each_particle(block, [&](Row row) {
            const auto velocity = cast<double>(particles_.velocity[row]);
            reached.include(cast<double>(particles_.position[row]));
            fastest2 = max(fastest2, dot(velocity, velocity));
            thickness = max(thickness, double(particles_.radius[row]));
            any = row;
        });
        const double acceleration = norm(cast<double>(forcing_on(world_, any).acceleration));
        std::optional<Vec<D, double>> held;
        layout().each_held(block, [&](Row row) { reached.include(*(held = held_position(row))); });
        const auto ahead = reached.grown(margin * frame_ * (square_root(fastest2) + frame_ * acceleration) + thickness);
        const ChainRoom<D, Real> around(world_, solver_);
        const auto room =
            held ? around.find(*held, 1.001 * layout().length_of(block) + thickness, ahead) : around.find(ahead);
        return room.grown(-thickness);
    }

    void start_substep(int lane, bool fresh) {
        const auto l = std::size_t(lane);
        const auto depth = lanes_[l].clock.depth;
        const auto& decay = decay_[depth];
        pack_.fresh.lane[l] = fresh;
        pack_.shortest.lane[l] = depth == LaneClock::deepest;
        pack_.h.lane[l] = pack_.longest / double(1U << depth);
        pack_.keep.lane[l] = decay.keep;
        pack_.yield.lane[l] = decay.yield;
        for (int k = 0; k < D; ++k) pack_.acceleration[k].lane[l] = acceleration_[l][k] * decay.yield;
        pack_.weight_length.lane[l] = weight_length_[l] * decay.yield;
    }

    // --- on, and out of the lanes

    template <class Redo> void go_on(int lane, double report_substep, Redo&& redo) {
        const auto l = std::size_t(lane);
        auto& [block, clock] = lanes_[l];
        const bool good = pack_.good.lane[l] > 0;
        if (!good && pack_.alien.lane[l] == 0 && clock.depth < LaneClock::deepest) {
            ++clock.depth;
            return start_substep(lane, false);
        }
        if (good)
            block->lost += pack_.lost.lane[l] / pack_.yield.lane[l];
        else
            hand_over(lane, redo);
        clock.advance();
        if (clock.begun < last_) return start_substep(lane, !good);
        moves_[l] = true;
        layout().report_tensions(lane, *block, report_substep);
        block = nullptr;
        pack_.active.lane[l] = 0;
    }

    template <class Redo> void hand_over(int lane, Redo&& redo) {
        const auto& [block, clock] = lanes_[std::size_t(lane)];
        kernel_.store_nodes(exchange_, lane, lane + 1);
        layout().put_tensions(lane, *block);
        const double from = double(clock.begun) / last_, to = double(clock.end()) / last_;
        block->lost += redo(*block, from, to, int(clock.depth) / 2);
        kernel_.load_nodes(exchange_, lane, lane + 1);
        layout().take_tensions(lane, *block);
    }
};

} // namespace sinew::detail
