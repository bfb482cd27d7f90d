#pragma once

#include "sinew/math/matrix.h"
#include "sinew/solver/bonds.h"
#include "sinew/solver/elimination.h"
#include "sinew/solver/ports/ports.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

/// What is solved at once instead of in a sweep: ropes, chains, trees, and figures with few loops. A block is a
/// connected part of the world whose equations have a sparse factorisation; it depends on nothing outside it, so it is
/// moved by itself, with substeps of its own. In double whatever the world's precision: a heavy weight on light links
/// has no digits to spare.
namespace sinew {

/// A particle of a block. Its equation is   diagonal move + sum of entries = residual.
template <int D> struct BlockNode {
    Row row = 0;
    std::uint32_t slot = 0; ///< which stays the same when rows move (block_rows.h)
    double mass = 0;
    Vec<D, double> start{};    ///< where the substep began
    Vec<D, double> place{};    ///< where it is going to be
    Vec<D, double> velocity{}; ///< when the substep began, less what drag took
    Vec<D, double> push{};     ///< the acceleration of all force fields
    Vec<D, double> aim{};      ///< where it would go by itself
    double inertia = 0;        ///< what holds it there
    Matrix<D, double> diagonal{};
    Vec<D, double> residual{}, move{};
};

/// A measure held in [low, high], and its multiplier on the way to the solution.
struct BlockLimit {
    Row constraint = 0;
    std::uint32_t slot = 0; ///< which stays the same when rows move
    double low = 0, high = 0, compliance = 0;
    double before = 0;  ///< the tension when the substep began
    double tension = 0; ///< the multiplier; of a distance, of (length^2 - limit^2) / 2
    double pull = 0;    ///< what it is in this iteration
    double stiffness = 0;
    int side = 0;           ///< at its high limit: 1, at its low one: -1, between them: 0
    int flips = 0;          ///< how often it came to a limit in this substep
    bool slackened = false; ///< it let go in a solve of this substep, of a block with ports

    bool one_sided() const { return low < high; }
    void come_to_a_limit(double above, double below, double margin) {
        if (!(above > margin || below < -margin)) return;
        side = above > margin ? 1 : -1;
        ++flips;
    }
    /// How far a measure so much above its high limit and its low one breaks what it is held to.
    double outside(double above, double below) const {
        return side > 0 ? absolute(above) : side < 0 ? absolute(below) : maximum(above, -below);
    }
};

/// Of a limit that is driven, or gives way.
struct BlockDrive {
    double most = 1e300;                  ///< it pulls or pushes with
    double lead = 0, rate = 0;            ///< of a damper; of the limits
    double low_begun = 0, high_begun = 0; ///< the limits when the step began
    bool driven = false;
    bool slips = false; ///< in this iteration
    int doubts = 0;     ///< how often it changed its mind about that in this substep

    bool gives() const { return most < 1e25; }
    /// A force as it is tried in an iteration, by one that pulls so far: from one end of what it can do it does not go
    /// straight to the other.
    double held(double force, double tension, bool pulls_only) {
        const bool turns = (pulls_only && force < 0) || (force * tension < 0 && absolute(tension) >= most);
        const bool should = !turns && absolute(force) > most;
        constexpr int most_doubts = 4; // then it stays as it is
        if (should != slips && doubts++ < most_doubts) slips = should;
        if (!slips) return force;
        return absolute(force) > most && !turns ? clamp(force, -most, most) : clamp(tension, -most, most);
    }
};

/// A way over several nodes: a pulley; or a distance that is driven or gives way.
struct BlockWay : BlockLimit, BlockDrive {
    bool is_pulley = false;
    std::uint32_t first = 0, nodes = 0; ///< of way_nodes
    std::uint32_t first_entry = 0;      ///< of way_entries: of each pair of its nodes
    double length = 0;                  ///< at the places of this iteration
};
template <int D> struct BlockWayNode {
    std::uint32_t node = 0;
    Vec<D, double> start{};    ///< the leg to the next one, when the substep began
    Vec<D, double> gradient{}; ///< of the length
    Vec<D, double> along{};    ///< where it is pulled
};

/// A distance between two nodes.
template <int D> struct BlockLink : BlockLimit {
    std::uint32_t a = 0, b = 0; ///< nodes
    std::uint32_t entry = 0;    ///< of the matrix; none if one of them is fixed
    double length = 0;          ///< the limit that counts for its scale
    double per_length2 = 0;     ///< 1 / length^2
    double give = 0;            ///< how far beyond its limit it is held, of (length^2 - limit^2) / 2
    bool strikes = false;       ///< it has come to its end (block_bounce.h)
    Vec<D, double> start{}, along{};

    /// A joint's range: it may become much longer than it may become short.
    bool is_range() const { return low > 0 && low < 0.9 * high; }
};

/// A limit of a joint's turn: an angle at the middle one of three nodes; or in space a fold, the volume of a
/// tetrahedron as a part of the largest one allowed.
template <int D> struct BlockBend : BlockLimit, BlockDrive {
    static constexpr std::size_t most_nodes = D == 2 ? 3 : 4, most_pairs = most_nodes * (most_nodes - 1) / 2;

    double unit = 1;  ///< of a fold: the volume that counts as 1
    double begun = 0; ///< the angle when the substep began
    double give = 0;  ///< how far beyond its limit it is held
    bool strikes = false;
    double taut = 1;              ///< of a spring: the share that acts, in this substep
    std::array<double, 2> arms{}; ///< squares of the lengths at which its arms are taut; 0 of one that is never slack
    std::size_t arity = 3;
    std::array<std::uint32_t, most_nodes> nodes{};
    std::array<std::uint32_t, most_pairs> entries{}; ///< of the pairs 0 1, 0 2, .. 1 2, ..
    std::array<Vec<D, double>, most_nodes> gradient{};
    std::array<Vec<D, double>, most_nodes> along{}; ///< where it is pulled

    bool is_fold() const { return arity == 4; }
};

/// What couples a node to a later one.
template <int D> struct BlockEntry {
    std::uint32_t node = 0;
    Matrix<D, double> lower{}, upper{}; ///< in the later node's rows, and in its columns
};

/// Nodes stand in the order of elimination; those that cannot move come last and are no unknowns.
struct Block {
    std::uint32_t first_node = 0, unknowns = 0, nodes = 0;
    std::uint32_t first_link = 0, links = 0;
    std::uint32_t first_bend = 0, bends = 0;
    std::uint32_t first_way = 0, ways = 0;
    std::uint32_t particle = 0;  ///< the slot of one that is in it
    std::uint32_t row_moves = 0; ///< how often rows had moved when it looked its own up
    bool motored = false;        ///< its limits may do work
    bool springy = false;        ///< some of it gives
    double lost = 0;             ///< energy, in the last step
    std::uint32_t ranges = 0;    ///< links that are a joint's range, and seldom hold

    // Of one that is joined to what is swept.
    std::uint32_t first_port = 0, ports = 0; ///< of Ports::list
    std::uint32_t first_response = 0;        ///< of Ports::responses: ports x ports
    std::uint32_t load_tethers = 0;          ///< the last of its links, each to a fixed node of its own

    /// Some of its links may hold what others hold too.
    bool braced() const { return links - ranges - load_tethers > unknowns + 1; }
    /// Something that does not move holds it, load tethers aside.
    bool fixed() const { return nodes > unknowns + load_tethers; }
};

/// Rows [first, last) of a table.
struct Rows {
    Row first = 0, last = 0;
};

struct SweepRun {
    int kind = 0;
    Rows rows;
};

/// What has happened to a particle.
enum class Touch : char {
    joined,   ///< it is new, or what it is joined by
    mobility, ///< it can move, or can no more: all that it is joined to is concerned
    weight
};

/// Room for finding the blocks.
struct BlockRoom {
    /// What hangs together, as far as it matters to whether it becomes a block.
    struct Part {
        std::uint32_t first = 0, particles = 0; ///< of `members`
        std::uint32_t links = 0, inner_links = 0;
        bool suits = true;
        bool wanted = false; ///< however many loops it has
    };
    struct Constraint {
        int kind = 0;
        Row row = 0;
    };
    std::vector<Part> parts;
    std::vector<Row> members;            ///< of the parts, one after the other
    std::vector<Constraint> constraints; ///< all that join or hold them
    std::vector<std::uint32_t> met;      ///< per particle: the last look in which it was met
    std::vector<Row> part_of;            ///< per particle: the block it is in, by one of its particles
    std::vector<Row> node_of;            ///< per particle
    std::vector<Row> bonds, parent, peeled, tree;
    std::vector<std::pair<Row, Row>> trees; ///< particles of pieces, behind the first of their piece
    std::vector<Row> hung;                  ///< those of them that are in blocks
    std::vector<char> direct; ///< per particle: it is of a tree, or of a figure that is as good as a block
    std::vector<std::pair<FigureIndex, Row>> figures; ///< of the particles of a part

    void reserve(std::size_t particles) {
        parts.reserve(particles);
        for (auto* column : {&members, &peeled, &tree}) column->reserve(particles);
        trees.reserve(particles);
        figures.reserve(particles);
        direct.reserve(particles);
        hung.reserve(particles);
    }
};

/// All of it follows from the rest of the world: a copy begins without, and looks again.
template <int D> struct Blocks {
    static constexpr auto none = ~std::uint32_t(0);

    std::vector<Block> list;
    std::vector<Block> hanging; ///< trees on what is swept: solved as one constraint of the sweep
    std::vector<BlockNode<D>> nodes;
    std::vector<BlockLink<D>> links;
    std::vector<BlockBend<D>> bends;
    std::vector<BlockWay> ways;
    std::vector<BlockWayNode<D>> way_nodes;
    std::vector<std::uint32_t> way_entries;
    std::vector<std::uint32_t> first_entry; ///< of each node, and one more
    std::vector<BlockEntry<D>> entries;
    std::vector<std::uint32_t> first_pair; ///< of each node: for its entries e < g, where their product goes
    std::vector<std::uint32_t> pairs;

    std::vector<SweepRun> runs; ///< constraints that are left to the sweep, in its order
    Ports<D> ports;             ///< where blocks of `hanging` are joined to the rest

    // Room for a step.
    std::vector<std::uint32_t> pin_of, next_pin; ///< per particle its first pin, per pin the next of the same particle

    // What has changed since the blocks were found.
    struct Touched {
        std::uint32_t particle = 0; ///< its slot
        Touch what = Touch::joined;
    };
    bool stale = true;   ///< everything has to be looked at
    bool changed = true; ///< something has
    std::vector<Touched> touched;
    std::uint32_t row_moves = 0; ///< how often rows have moved
    Bonds bonds;

    Elimination elimination;
    BlockRoom room;
    std::uint32_t looks = 0;

    Blocks() = default;
    Blocks(const Blocks&) {}
    Blocks& operator=(const Blocks&) {
        stale = changed = true;
        return *this;
    }
    Blocks(Blocks&&) = default;
    Blocks& operator=(Blocks&&) = default;
    ~Blocks() = default;

    void touch(std::uint32_t particle, Touch what) {
        changed = true;
        stale = stale || touched.size() == touched.capacity();
        if (!stale) touched.push_back({particle, what});
    }

    void clear() {
        columns([](auto& column) { column.clear(); });
        list.clear();
        hanging.clear();
        ports.clear();
        touched.clear();
    }
    /// Calls visit(column) for what grows with every block.
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
    }

    /// Room for whatever becomes of so many particles and constraints as they tear.
    void reserve(std::size_t particles, std::size_t distances, std::size_t angles) {
        for (auto* blocks : {&list, &hanging}) blocks->reserve(particles / 2 + 1);
        const auto most_nodes = 2 * (3 * particles + distances + 2 * angles);
        const auto most_entries = 8 * distances + 16 * angles + 1024;
        nodes.reserve(most_nodes);
        links.reserve(2 * distances + 4 * particles);
        bends.reserve(2 * angles);
        for (auto* column : {&first_entry, &first_pair}) column->reserve(most_nodes + 1);
        entries.reserve(most_entries);
        pairs.reserve(2 * most_entries);
        runs.reserve(2 * (distances + angles) + particles);
        elimination.reserve(particles, 2 * distances + 6 * angles);
        ports.reserve(particles, distances + angles);
        room.reserve(particles);
    }

    /// What changes is found again behind all that was there, as long as there is room for so much more.
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
        touched.reserve(little + nodes.size() / 8);
        room.constraints.reserve(2 * room.constraints.size());
    }
};

} // namespace sinew
