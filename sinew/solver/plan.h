#pragma once

#include "sinew/assert/assert.h"
#include "sinew/solver/batch_parameters.h"
#include "sinew/solver/block.h"
#include "sinew/solver/level_structure.h"
#include "sinew/solver/simd/kernel.h"
#include "sinew/world/slack_links.h"

#include <algorithm>
#include <array>
#include <compare>
#include <utility>
#include <vector>

/// Plan of the sweep, made once per topology (plan.cpp): the order of particles in slots, and batches of simple
/// distances. A simple distance is a link between limits, rigid or elastic, and has no other feature.
namespace sinew {

/// Tile of a component: slots [first, last) of SweepState, such as a row of a cloth.
struct Tile {
    std::uint32_t first = 0, last = 0;
    std::uint32_t first_pin = 0, last_pin = 0; ///< range of Plan::pins
    std::uint32_t span_repairs = 0;            ///< sweeps along the tile after each tether pass, from pin to pin; or 0
    bool overstretched = false;                ///< links starting here were found overstretched
    std::uint32_t again = 0;                   ///< most tiles repaired from here in this step
};

/// Distances solved together: of one direction, or of one or more greedy colours of a mesh. Links starting in tile j
/// end in tiles j to j + tile_span.
struct LinkColor {
    std::uint32_t first_batch = 0; ///< index in Plan::first_batch of the first tile's offset; one more entry than tiles
    std::uint32_t tile_span = 0;
    std::uint32_t wavefront_offset = 0; ///< sum of the spans up to and including this colour's
};

/// Offsets into the lists of a plan, at the start or end of a component.
struct PlanPlace {
    std::uint32_t slot = 0, tile = 0, color = 0, first_batch = 0, run = 0, parameter = 0, scattered = 0, listed = 0;
};

/// Range of rows [first, last], with the id slots of both ends. After removals elsewhere, no row in between is gone if
/// and only if the ends are as far apart as before.
struct Extent {
    Row first = ~Row(0), last = 0;
    std::uint32_t first_id = 0, last_id = 0;

    bool empty() const { return first > last; }
    void include(Row row) { first = std::min(first, row), last = std::max(last, row); }
    void shift(Row by) { first += by, last += by; }
};

/// Connected component of simple distances; or several laid out together, being copies of one shape or particles
/// without links. No component depends on another.
struct Component {
    std::uint32_t first_tile = 0, tiles = 0;
    std::uint32_t first_color = 0, colors = 0;
    std::uint32_t wavefront_offset = 0; ///< delay of the last colour, on the way back if there is one
    std::uint32_t tile_span = 0;        ///< largest span of a colour
    std::uint32_t first_tether = 0, tethers = 0;
    PlanPlace begin{}; ///< offsets of the component's entries
    Extent particles{}, links{};
    bool small = false;                       ///< may be laid out with others of the same shape (batch/components.h)
    bool both_ways = false;                   ///< each iteration sweeps the links there and back
    bool is_elastic = false;                  ///< some links are compliant
    bool is_tied = false;                     ///< so do constraints of other kinds, which are swept there and back
    bool is_gathered = false;                 ///< in this step pins are nearer to each other than the cloth reaches
    bool is_crushed = false;                  ///< in this step rigid links are far too short: nothing only pulls
    std::uint32_t copies = 0;                 ///< interleaved copies of one shape; 0 for a single one
    std::uint32_t first_body = 0, bodies = 0; ///< range of FreeBodies::list that begins here

    bool has_links() const { return colors > 0; }
    bool goes_back() const { return both_ways || is_tied; }
};

/// Pin of the world, and the slot of the pinned particle.
struct PinnedSlot {
    std::uint32_t slot = 0, pin = 0;
};

/// Largest number of tethers of a component.
inline constexpr std::size_t max_tethers = 4;

/// Long-range attachments of a component to a pin: no particle is further from the pin than along the shortest path of
/// rigid links (Kim, Chentanez and Mueller 2012).
struct Tether {
    std::uint32_t pin = 0;   ///< index in World::pins
    std::uint32_t at = 0;    ///< slot of the pinned particle, from the component's first
    std::uint32_t first = 0; ///< offset in Plan::half_per_max_length_square for the component's first slot
};

/// Scratch memory of the planner.
struct PlanRoom {
    std::vector<Row> links, left;   ///< rows of distances
    RowLists<Row> members, link_at; ///< particles and distances of each component
    std::vector<Row> part_of, rank; ///< of a particle: the component, and the number among the component's particles
    std::vector<Row> at;
    UnionFind sets;               ///< of rows in search of components, of slots in search of free bodies
    RowLists<std::uint32_t> near; ///< neighbours in a component, by rank
    std::vector<PinnedSlot> anchors;
    struct Direction {
        std::uint32_t step = 0;
        std::size_t first = 0, last = 0; ///< range of the part's links with all of the direction
    };
    std::vector<Direction> directions;
    std::vector<unsigned char> chained, colour;
    std::vector<std::uint64_t> used; ///< colours of the links of each particle, as bits
    /// Entry in the order of the plan: a new component, or one kept from before.
    struct Piece {
        Row first = 0; ///< first particle
        std::uint32_t number = 0;
        bool stays = false;
    };
    std::vector<Piece> order;
    std::vector<char> kept; ///< flag by component
    struct Link {
        std::uint32_t offset = 0, lower = 0; ///< difference and minimum of the slots of the ends
        Row row = 0;
        auto operator<=>(const Link&) const = default;
    };
    struct Sequence {
        std::uint32_t first = 0, end = 0; ///< range of `sorted`
        std::uint32_t tile = 0, color = 0;
    };
    std::vector<Row> sorted, left_over; ///< rows of distances
    std::vector<SweepRun> others;
    std::vector<SlackLink> slack_links;
    std::vector<Link> of_tile, left_of_tile;
    std::vector<Sequence> sequences;
    LevelStructure levels;

    void reserve(std::size_t particles, std::size_t distances, std::size_t constraints) {
        others.reserve(constraints);
        slack_links.reserve(distances);
        members.reserve(particles + 1, particles);
        link_at.reserve(particles + 1, distances);
        order.reserve(particles + 1);
        kept.reserve(particles + 1);
        for (auto* column : {&links, &left}) column->reserve(distances);
        for (auto* column : {&part_of, &rank, &at}) column->reserve(particles + 1);
        sets.reserve(particles + 1);
        near.reserve(particles, 2 * distances);
        directions.reserve(32);
        chained.reserve(particles);
        colour.reserve(distances);
        used.reserve(particles);
        for (auto* column : {&sorted, &left_over}) column->reserve(distances);
        for (auto* column : {&of_tile, &left_of_tile}) column->reserve(distances);
        sequences.reserve(distances);
        levels.reserve(particles);
    }
};

template <class Real> struct Plan {
    std::vector<Component> components;
    std::vector<Tile> tiles;
    std::vector<LinkColor> colors;
    std::vector<std::uint32_t> first_batch;
    std::vector<LinkBatch> runs;
    BatchParameters<Real> parameters;
    std::vector<std::uint32_t> ends_a, ends_b; ///< slots of scattered batches
    std::vector<std::uint32_t> rows;           ///< rows of batches with row_step 0
    std::vector<PinnedSlot> pins;              ///< sorted by slot
    std::vector<Tether> tethers;
    std::vector<Real> half_per_max_length_square; ///< 1 / (2 max_length^2) by tether and slot; 0: unlimited
    bool may_tear = true;                         ///< some constraint of the world can tear
    std::vector<SweepRun> others; ///< constraints other than simple distances, in the order of the sweep
    static constexpr Row no_link = ~Row(0);
    std::vector<std::array<Row, 2>>
        bend_links;              ///< by row of a bend: links that are its legs and can shrink, or no_link
    std::uint32_t row_moves = 0; ///< Journal::row_moves when the plan was made

    PlanPlace end() const {
        const auto size = [](const auto& column) { return std::uint32_t(column.size()); };
        return {.slot = tiles.empty() ? 0 : tiles.back().last,
                .tile = size(tiles),
                .color = size(colors),
                .first_batch = size(first_batch),
                .run = size(runs),
                .parameter = std::uint32_t(parameters.size()),
                .scattered = size(ends_a),
                .listed = size(rows)};
    }
    /// End of a component's entries.
    PlanPlace end_of(std::size_t component) const {
        SINEW_ASSERT(component < components.size(), "the component is in the plan");
        return component + 1 < components.size() ? components[component + 1].begin : end();
    }
    PlanPlace end_of(const Component& component) const { return end_of(std::size_t(&component - components.data())); }

    /// Delay of a colour on the way back, from the last tile to the first, after the way there.
    std::uint32_t offset_of_return(const Component& component, std::uint32_t color) const {
        const auto there = colors[component.first_color + component.colors - 1].wavefront_offset + component.tiles - 1;
        return there + (component.colors - 1 - color) * component.tile_span;
    }

    /// Calls visit(row, slot a, slot b) for the links of a batch.
    template <class Visit> void each_link(const LinkBatch& run, Visit&& visit) const {
        for (std::uint32_t i = 0; i < run.count; ++i)
            if (run.scattered)
                visit(row_of(run, i), ends_a[run.a + i], ends_b[run.a + i]);
            else
                visit(row_of(run, i), run.a + i, run.b + i);
    }

    static constexpr std::size_t lanes = 16; ///< padding: a pack may read beyond the last entry

    void close() {
        first_batch.push_back(std::uint32_t(runs.size()));
        parameters.resize(parameters.size() + lanes);
    }
    void open() {
        if (first_batch.empty()) return;
        SINEW_ASSERT(parameters.size() >= lanes, "a closed plan ends with padding");
        first_batch.pop_back();
        parameters.resize(parameters.size() - lanes);
    }

    /// Row of link i of a batch.
    Row row_of(const LinkBatch& run, std::uint32_t i) const {
        SINEW_ASSERT(i < run.count, "the link is in the batch");
        return run.row_step == 0 ? rows[run.row + i] : run.row + i * run.row_step;
    }
    /// Tile of a slot, searched from `first_tile` on.
    std::uint32_t tile_of(std::uint32_t first_tile, std::uint32_t slot) const {
        const auto found = std::upper_bound(tiles.begin() + first_tile, tiles.end(), slot,
                                            [](std::uint32_t value, const Tile& tile) { return value < tile.last; });
        return std::uint32_t(found - tiles.begin());
    }

    void reserve(std::size_t particles, std::size_t distances, std::size_t constraints) {
        components.reserve(particles + 1);
        tiles.reserve(particles + 1);
        colors.reserve(distances + 1);
        first_batch.reserve(2 * distances + particles + 1);
        runs.reserve(distances);
        parameters.reserve(distances + lanes + 1);
        for (auto* column : {&ends_a, &ends_b, &rows}) column->reserve(distances);
        others.reserve(constraints);
        bend_links.reserve(constraints);
    }
    void clear() {
        parameters.clear();
        for (auto* column : {&first_batch, &ends_a, &ends_b, &rows}) column->clear();
        components.clear();
        tiles.clear();
        colors.clear();
        runs.clear();
        pins.clear();
        tethers.clear();
        half_per_max_length_square.clear();
        others.clear();
        bend_links.clear();
    }
};

} // namespace sinew
