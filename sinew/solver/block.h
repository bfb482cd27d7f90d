#pragma once

#include "sinew/constraint/kinds.h"
#include "sinew/math/limit.h"
#include "sinew/math/matrix.h"
#include "sinew/math/union_find.h"
#include "sinew/solver/chains.h"
#include "sinew/solver/elimination.h"
#include "sinew/solver/ports.h"
#include "sinew/solver/programs.h"
#include "sinew/solver/sweep_run.h"
#include "sinew/world/constraint_adjacency.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

/// Blocks: parts of the world that are solved directly instead of swept: ropes, chains, trees, and figures with few
/// loops. A block is a connected component whose equations have a sparse factorisation. Nothing outside acts on a block
/// through constraints, so the block moves alone, with its own substeps; blocks in `attached_trees` are joined to the
/// sweep by ports. Numbers are double whatever the precision of the world: a heavy weight on light links has no digits
/// to spare.
namespace sinew {

/// A particle of a block. Equation of a node:   diagonal move + sum of entries = residual.
template <int D> struct BlockNode {
    Row row = 0;
    std::uint32_t slot = 0; ///< slot of the particle, stable while rows move (direct/look_up_rows.h)
    double mass = 0;
    Vec<D, double> start{};        ///< position at the start of the substep, m
    Vec<D, double> position{};     ///< position at the end of the substep, m
    Vec<D, double> velocity{};     ///< at the start of the substep, drag taken off; in the end the new velocity, m/s
    Vec<D, double> acceleration{}; ///< acceleration by all force fields, m/s^2
    Vec<D, double>
        predicted{};    ///< position without constraints, m; in project_block_velocities the velocity before, m/s
    double inertia = 0; ///< stiffness towards `predicted`: mass / h^2, twice as much in a midpoint step, kg/s^2
    double behind = 0, rest = 0; ///< masses on both sides of the link to the next node, kg (direct/light_trees.h)
    Matrix<D, double> diagonal{};
    Vec<D, double> residual{}, displacement{};
};

/// Answer of the program's filter about a particle of a block and a wall, for the rest of a step.
struct WallAnswer {
    Row particle = 0;
    std::uint32_t wall = 0; ///< index of a collider, or of a plane after all colliders
    bool is_admitted = true;
    double friction = 0, restitution = 0;
};

/// A measure constrained to [low, high], and the multiplier while a solve runs.
struct BlockLimit {
    Row constraint = 0;
    std::uint32_t slot = 0; ///< slot of the constraint, stable while rows move; no_row for a load tether
    double low = 0, high = 0, compliance = 0;
    double before = 0;  ///< tension at the start of the substep
    double tension = 0; ///< multiplier; for a distance, of (length^2 - limit^2) / 2
    double pull = 0;    ///< multiplier in the current iteration
    double stiffness = 0;
    int side = 0;           ///< active limit: 1 high, -1 low, 0 none
    int flips = 0;          ///< number of activations in this substep
    bool slackened = false; ///< released in a solve of this substep; only in a block with ports

    bool one_sided() const { return low < high; }
    bool is_compliant() const { return compliance > 0; }
    /// Distance of a measure from the limits, signed.
    double error_of(double measure) const { return measure - clamp(measure, low, high); }
    bool is_softer_than(double k) const { return compliance * k > 1; }
    /// Stiffness of a compliant limit, at most `hardest`; `share` of the spring acts.
    double spring_stiffness(double hardest = 1e300, double share = 1) const { return min(share / compliance, hardest); }
    /// Energy of a compliant limit, J; `share` of the spring acts.
    double spring_energy(double measure, double share = 1) const {
        return 0.5 * share * square(error_of(measure)) / compliance;
    }
    void activate(double above, double below, double margin) {
        if (!(above > margin || below < -margin)) return;
        side = above > margin ? 1 : -1;
        ++flips;
    }
    /// Violation of the active limit, given the measure's excess `above` the high limit and over the low one (`below`).
    /// Without an active limit: the larger violation, negative inside the limits.
    double outside(double above, double below) const {
        return side > 0 ? absolute(above) : side < 0 ? absolute(below) : max(above, -below);
    }
};

/// Further parts of a limit that is driven or has a maximum force.
struct BlockDrive {
    double max = 1e300;                       ///< maximum force, N; of an angle, torque, N m
    double damping_time = 0, motor_speed = 0; ///< damping time, s; rate of change of the limits, per second
    double low_begun = 0, high_begun = 0;     ///< limits at the start of the step
    bool motorized = false;
    bool is_motor = false; ///< drive() has set a rate: a limit that slips does not spring back
    bool slips = false;    ///< the force is saturated in this iteration
    int doubts = 0;        ///< changes of `slips` in this substep

    bool gives() const {
        static_assert(limit::measure<double> <= double(limit::measure<float>), "one limit serves both precisions");
        return max < limit::measure<double>;
    }
    /// Force to apply in an iteration, clamped to [-most, most]. A saturated force that would change sign keeps the
    /// last `tension` instead: the solve does not jump from one bound straight to the other.
    double held(double force, double tension, bool pulls_only) {
        const bool turns = (pulls_only && force < 0) || (force * tension < 0 && absolute(tension) >= max);
        const bool should = !turns && absolute(force) > max;
        constexpr int max_doubts = 4; // from then on `slips` stays fixed for the substep
        if (should != slips && doubts++ < max_doubts) slips = should;
        if (!slips) return force;
        return absolute(force) > max && !turns ? clamp(force, -max, max) : clamp(tension, -max, max);
    }
};

/// A cable over several nodes: a pulley, or a distance that is driven or has a maximum force.
struct CableRow : BlockLimit, BlockDrive {
    bool is_pulley = false;
    std::uint32_t first = 0, nodes = 0; ///< range in way_nodes
    std::uint32_t first_entry = 0;      ///< in way_entries, one for each pair of nodes
    double length = 0;                  ///< at the positions of this iteration, m

    /// Elongation of a compliant cable at the maximum force, m.
    double max_stretch() const { return max * compliance; }
};
template <int D> struct CableNode {
    std::uint32_t node = 0;
    Vec<D, double> start{};    ///< leg to the next node at the start of the substep, m
    Vec<D, double> gradient{}; ///< gradient of the length
    Vec<D, double> along{};    ///< direction of the force
};

/// A distance between two nodes.
template <int D> struct DistanceRow : BlockLimit {
    std::uint32_t a = 0, b = 0; ///< nodes
    std::uint32_t entry = 0;    ///< index in the matrix; none if an end is fixed
    double length = 0;          ///< limit used for scaling, m
    double per_length2 = 0;     ///< 1 / length^2
    double give = 0;            ///< offset of the active limit, in (length^2 - limit^2) / 2
    double share = 1;           ///< mass that hangs on the link, as a fraction of the block's (direct/light_trees.h)
    bool strikes = false;       ///< moves out past a limit at the end of a swing (direct/joint_stops.h)
    Vec<D, double> start{}, along{};

    /// True for a joint's range: a low limit well below the high one.
    bool is_range() const { return low > 0 && low < 0.9 * high; }
};

/// A limit of a joint: the angle at the middle one of three nodes, or in 3D a fold: the volume of a tetrahedron as a
/// fraction of the largest volume allowed.
template <int D> struct AngleRow : BlockLimit, BlockDrive {
    static constexpr std::size_t max_nodes = D == 2 ? 3 : 4, max_pairs = max_nodes * (max_nodes - 1) / 2;

    double unit = 1;  ///< volume of a fold that counts as 1, m^3
    double begun = 0; ///< angle at the start of the substep, rad; of a fold, volume as a fraction of `unit`
    double give = 0;  ///< offset of the active limit, as `begun`
    bool strikes = false;
    double taut = 1;              ///< fraction of a spring's stiffness that acts in this substep, 0..1
    std::array<double, 2> arms{}; ///< squared lengths at which the arms are taut, m^2; 0 for an arm that is never slack
    bool replaces_link = false;   ///< volume zero of a flat square, `constraint` a distance (direct/flat_squares.h)
    std::size_t arity = 3;
    std::array<std::uint32_t, max_nodes> nodes{};
    std::array<std::uint32_t, max_pairs> entries{}; ///< matrix entries of the pairs 0 1, 0 2, .. 1 2, ..
    std::array<Vec<D, double>, max_nodes> gradient{};
    std::array<Vec<D, double>, max_nodes> along{}; ///< direction of the force

    bool is_fold() const { return arity == 4; }
};

/// Coupling of a node with a later one.
template <int D> struct BlockEntry {
    std::uint32_t node = 0;
    Matrix<D, double> lower{}, upper{}; ///< in the rows, and in the columns, of the later node
};

/// Nodes stand in elimination order; immovable nodes come last and are no unknowns.
struct Block {
    std::uint32_t first_node = 0, unknowns = 0, nodes = 0;
    std::uint32_t first_link = 0, links = 0;
    std::uint32_t first_bend = 0, bends = 0;
    std::uint32_t first_way = 0, ways = 0;
    std::uint32_t particle = 0;     ///< slot of one member
    std::uint32_t row_moves = 0;    ///< `Journal::row_moves` at the last look-up of rows
    bool is_motorized = false;      ///< some limits are driven, and may do work
    bool springy = false;           ///< some constraints are compliant
    bool is_factorised = false;     ///< of a block with ports: factors of an earlier substep of this step are in use
    double lost = 0;                ///< energy lost in the last step, J
    std::uint32_t ranges = 0;       ///< links that are a joint's range, and seldom active
    std::uint32_t flat_squares = 0; ///< distances replaced by angle rows (direct/flat_squares.h)
    std::uint32_t chain = ~std::uint32_t(0);   ///< index in Chains::list; none if the block is no chain
    std::uint32_t program = ~std::uint32_t(0); ///< index in Programs::list; none if the block is solved by itself

    // Only for a block joined to the sweep.
    std::uint32_t first_port = 0, ports = 0; ///< range in Ports::list
    std::uint32_t first_response = 0;        ///< in Ports::responses, a matrix of ports x ports
    std::uint32_t load_tethers = 0;          ///< at the end of the links, each with a fixed node apart

    /// True if some links may be redundant.
    bool braced() const { return links - ranges - load_tethers > unknowns + 2 * flat_squares + 1; }
    /// True if an immovable particle holds the block, load tethers aside.
    bool fixed() const { return nodes > unknowns + load_tethers; }
};

/// Flags by the slots of ids, which do not change when rows move.
class IndexFlags {
  public:
    bool empty() const { return flags_.empty(); }
    bool has(std::uint32_t slot) const { return slot < flags_.size() && flags_[slot]; }
    void set(std::uint32_t slot, bool flag) {
        if (slot >= flags_.size() && flag) flags_.resize(slot + 1, 0);
        if (slot < flags_.size()) flags_[slot] = flag;
    }
    void clear() { flags_.clear(); }
    void reserve(std::size_t slots) { flags_.reserve(slots); }

  private:
    std::vector<char> flags_;
};

/// A rigid link between two nodes, while flat squares are looked for.
struct SquareSide {
    std::uint32_t link = 0; ///< none if two nodes are coupled by fill only
    bool is_taken = false;  ///< in a square
    bool is_replaced = false;
};

/// Work space for finding the blocks.
struct BlockRoom {
    /// A connected component, with the properties that decide whether a block is built.
    struct Part {
        std::uint32_t first = 0, particles = 0; ///< range in `members`
        std::uint32_t links = 0, inner_links = 0, folds = 0;
        double mass = 0;            ///< kg
        double lightest_end = 1e30; ///< mass of the lightest particle that is linked to an immovable one, kg
        bool suits = true;
        bool wanted = false; ///< a direct solution is requested, however many loops there are
    };
    std::vector<Part> parts;
    std::vector<Row> members;       ///< particles of the parts, one part after the other
    std::vector<std::uint32_t> met; ///< per particle: number of the last search that reached the particle
    std::vector<Row> part_of;       ///< per particle: the block, named by one of the block's particles
    std::vector<Row> node_of;       ///< per particle: index of the node
    UnionFind pieces;
    std::vector<Row> adjacency, parent, peeled, tree;
    std::vector<std::pair<Row, Row>> trees; ///< particles of pieces, each after the first of the piece
    std::vector<Row> attached;              ///< direct particles of pieces that became blocks
    std::vector<char> direct;               ///< per particle: in a tree, or in a figure that alone would be a block
    std::vector<std::pair<FigureIndex, Row>> figures; ///< pairs (figure, particle) of a part
    std::vector<SquareSide> sides;                    ///< by entry of a block

    void reserve(std::size_t particles) {
        parts.reserve(particles);
        for (auto* column : {&members, &peeled, &tree}) column->reserve(particles);
        trees.reserve(particles);
        figures.reserve(particles);
        direct.reserve(particles);
        attached.reserve(particles);
    }
};

template <int D> struct Blocks {
    static constexpr auto none = ~std::uint32_t(0);

    std::vector<Block> list;
    std::vector<Block>
        attached_trees; ///< trees attached to swept particles, each solved as one constraint of the sweep
    std::vector<BlockNode<D>> nodes;
    std::vector<DistanceRow<D>> links;
    std::vector<AngleRow<D>> bends;
    std::vector<CableRow> ways;
    std::vector<CableNode<D>> way_nodes;
    std::vector<std::uint32_t> way_entries;
    std::vector<std::uint32_t> first_entry; ///< first of a node's entries; one element more than nodes
    std::vector<BlockEntry<D>> entries;
    std::vector<std::uint32_t> first_pair; ///< first of a node's pairs of entries e < g
    std::vector<std::uint32_t> pairs;      ///< entry that receives the product of a pair

    IndexFlags particles;                                            ///< moved by a block of `list`, not by the sweep
    std::array<IndexFlags, std::size_t(Kinds<D>::size)> constraints; ///< by kind: held by a block, not by the sweep
    std::vector<SweepRun> runs;                                      ///< constraints left to the sweep, in sweep order
    Ports<D> ports;       ///< joints between blocks of `attached_trees` and the rest
    Chains<D> chains;     ///< blocks of `list` that are chains
    Programs<D> programs; ///< other blocks of `list` that are solved side by side

    // Work space of a step.
    std::vector<WallAnswer> answers;             ///< of the program's filter of contacts
    std::vector<std::uint32_t> pin_of, next_pin; ///< first pin of each particle, next pin of the same particle

    Elimination elimination;
    BlockRoom room;
    std::uint32_t searches = 0;

    void clear() {
        columns([](auto& column) { column.clear(); });
        list.clear();
        attached_trees.clear();
        ports.clear();
        particles.clear();
        for (auto& flags : constraints) flags.clear();
    }
    template <class Table> IndexFlags& constraints_of(const Table&) {
        return constraints[std::size_t(Kinds<D>::template index_of<typename Table::Kind>)];
    }
    /// True for a row of a table that is held by a block.
    template <class Table> bool holds(const Table& table, Row row) const {
        return constraints[std::size_t(Kinds<D>::template index_of<typename Table::Kind>)].has(
            table.handles.index_of(row));
    }
    /// Calls visit(column) for each column that grows with every block.
    template <class Visit> void columns(Visit&& visit) {
        visit(nodes);
        visit(links);
        visit(bends);
        visit(ways);
        visit(way_nodes);
        visit(way_entries);
        visit(first_entry);
        visit(entries);
        visit(first_pair);
        visit(pairs);
        visit(chains.list);
        visit(chains.links);
        visit(programs.list);
        visit(programs.numbers);
    }

    /// Reserves for every state that so many particles and constraints can reach by tearing.
    void reserve(std::size_t particle_count, std::size_t distance_count, std::size_t angle_count) {
        for (auto* blocks : {&list, &attached_trees}) blocks->reserve(particle_count / 2 + 1);
        const auto max_nodes = 2 * (3 * particle_count + distance_count + 2 * angle_count);
        const auto max_entries = 8 * distance_count + 16 * angle_count + 1024;
        nodes.reserve(max_nodes);
        links.reserve(2 * distance_count + 4 * particle_count);
        bends.reserve(2 * angle_count);
        for (auto* column : {&first_entry, &first_pair}) column->reserve(max_nodes + 1);
        entries.reserve(max_entries);
        pairs.reserve(2 * max_entries);
        runs.reserve(2 * (distance_count + angle_count) + particle_count);
        elimination.reserve(particle_count, 2 * distance_count + 6 * angle_count);
        ports.reserve(particle_count, distance_count + angle_count);
        chains.reserve(particle_count, distance_count);
        programs.reserve(particle_count, 2 * distance_count + 4 * particle_count + 2 * angle_count, max_entries);
        room.reserve(particle_count);
        room.sides.reserve(max_entries);
    }

    /// True if each column has room for `more` elements: changed blocks are appended behind all others.
    bool has_room(std::size_t more) {
        bool enough = true;
        columns([&](const auto& column) { enough = enough && column.size() + more <= column.capacity(); });
        return enough;
    }
    void leave_room() {
        constexpr std::size_t little = 1024;
        columns([&](auto& column) {
            if (column.capacity() < column.size() + column.size() / 2 + little / 2)
                column.reserve(2 * column.size() + little);
        });
    }
};

} // namespace sinew
