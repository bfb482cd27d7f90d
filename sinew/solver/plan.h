#pragma once

#include "sinew/solver/block.h"
#include "sinew/solver/kernel.h"
#include "sinew/solver/levels.h"
#include "sinew/solver/run_parameters.h"

#include <algorithm>
#include <compare>
#include <utility>
#include <vector>

/// How the sweep goes about its work, worked out once for a topology (plan.cpp): which particles lie side by side, and
/// which plain distances are solved together. A plain distance has no feature but limits and compliance.
namespace sinew {

/// Slots [first, last) of Swept: a row of a cloth.
struct Band {
    std::uint32_t first = 0, last = 0;
    std::uint32_t first_pin = 0, last_pin = 0; ///< of Plan::pins
    std::uint32_t tightened = 0;               ///< how often, after each tether: where it spans from pin to pin
    bool strained = false;                     ///< links that begin in it were found much too long
    std::uint32_t again = 0;                   ///< the most bands that were swept again at its turn, in this step
};

/// Distances of one direction, or of one colour. Those of band j touch the bands j to j + reach.
struct Family {
    std::uint32_t first_run = 0; ///< of Plan::first_run: where those of each band begin, and one more
    std::uint32_t reach = 0;
    std::uint32_t delay = 0; ///< what it and those before it reach together
};

/// Where each list of a plan begins, for a sheet; or ends.
struct PlanPlace {
    std::uint32_t slot = 0, band = 0, family = 0, first_run = 0, run = 0, parameter = 0, scattered = 0, listed = 0;
};

/// The rows between the first and the last of something, and by which slots of their ids these two are known: where
/// others have gone, both are as far apart as before only if nothing in between has.
struct Extent {
    Row first = ~Row(0), last = 0;
    std::uint32_t first_id = 0, last_id = 0;

    bool empty() const { return first > last; }
    void include(Row row) { first = std::min(first, row), last = std::max(last, row); }
    void shift(Row by) { first += by, last += by; }
};

/// Particles that plain distances join, or several such heaps. Nothing in one sheet depends on another.
struct Sheet {
    std::uint32_t first_band = 0, bands = 0;
    std::uint32_t first_family = 0, families = 0;
    std::uint32_t lag = 0;   ///< the delay of its last family
    std::uint32_t reach = 0; ///< the most that one of them has
    std::uint32_t first_tether = 0, tethers = 0;
    PlanPlace begin{}; ///< of what is its own
    Extent particles{}, links{};
    bool small = false; ///< it may lie with others of its shape (plan_sheets.h)
    bool copies = false;

    bool has_links() const { return families > 0; }
};

/// A pin of the world, and where its particle is.
struct PinnedSlot {
    std::uint32_t slot = 0, pin = 0;
};

/// Of one sheet.
inline constexpr std::size_t most_tethers = 4;

/// Keeps the particles of a sheet within reach of a pin: no further than the shortest way along rigid links is long
/// (long-range attachments: Kim, Chentanez and Mueller 2012).
struct Tether {
    std::uint32_t pin = 0;   ///< of the world
    std::uint32_t at = 0;    ///< its particle, from the sheet's first slot on
    std::uint32_t first = 0; ///< of Plan::half_per_reach_square: that of the sheet's first slot
};

/// Room for working out a plan.
struct PlanRoom {
    struct Part {
        std::uint32_t first_member = 0, members = 0, first_link = 0, links = 0;
    };
    std::vector<Part> parts;
    std::vector<Row> links, link_at, left; ///< rows of distances
    std::vector<Row> parent, part_of, members, rank, at, first_near, near;
    std::vector<PinnedSlot> anchors;
    struct Direction {
        std::uint32_t step = 0;
        std::size_t first = 0, last = 0; ///< of a part's links: all of them lie in between
    };
    std::vector<Direction> directions;
    std::vector<unsigned char> chained, colour;
    std::vector<std::uint64_t> used; ///< colours, a bit each
    /// What comes after what in the plan: a part, or a sheet that stays.
    struct Piece {
        Row first = 0; ///< of its particles
        std::uint32_t number = 0;
        bool stays = false;
    };
    std::vector<Piece> order;
    std::vector<char> kept; ///< sheets
    struct Link {
        std::uint32_t apart = 0, lower = 0; ///< slots of its ends
        Row row = 0;
        auto operator<=>(const Link&) const = default;
    };
    struct Sequence {
        std::uint32_t first = 0, end = 0; ///< of `sorted`
        std::uint32_t band = 0, family = 0;
    };
    std::vector<Row> sorted, left_over; ///< of distances
    std::vector<Link> of_band, left_of_band;
    std::vector<Sequence> sequences;
    Levels levels;

    void reserve(std::size_t particles, std::size_t distances) {
        parts.reserve(particles + 1);
        order.reserve(particles + 1);
        kept.reserve(particles + 1);
        for (auto* column : {&links, &link_at, &left}) column->reserve(distances);
        for (auto* column : {&parent, &part_of, &members, &rank, &at, &first_near}) column->reserve(particles + 1);
        near.reserve(2 * distances);
        directions.reserve(32);
        chained.reserve(particles);
        colour.reserve(distances);
        used.reserve(particles);
        for (auto* column : {&sorted, &left_over}) column->reserve(distances);
        for (auto* column : {&of_band, &left_of_band}) column->reserve(distances);
        sequences.reserve(distances);
        levels.reserve(particles);
    }
};

template <class Real> struct Plan {
    std::vector<Sheet> sheets;
    std::vector<Band> bands;
    std::vector<Family> families;
    std::vector<std::uint32_t> first_run;
    std::vector<LinkRun> runs;
    RunParameters<Real> parameters;
    std::vector<std::uint32_t> ends_a, ends_b; ///< of what is scattered
    std::vector<std::uint32_t> rows;           ///< of runs without a step
    std::vector<PinnedSlot> pins;              ///< by slot
    std::vector<Tether> tethers;
    std::vector<Real> half_per_reach_square; ///< of each tether, by slot; 0 where it reaches anywhere
    bool may_tear = true;                    ///< something in the world
    std::vector<SweepRun> others;            ///< constraints that are not plain, in the order of the sweep
    std::uint32_t row_moves = 0;             ///< how often rows had moved (Blocks)

    PlanPlace end() const {
        const auto size = [](const auto& column) { return std::uint32_t(column.size()); };
        return {.slot = bands.empty() ? 0 : bands.back().last,
                .band = size(bands),
                .family = size(families),
                .first_run = size(first_run),
                .run = size(runs),
                .parameter = std::uint32_t(parameters.size()),
                .scattered = size(ends_a),
                .listed = size(rows)};
    }
    /// Behind a sheet.
    PlanPlace end_of(std::size_t sheet) const { return sheet + 1 < sheets.size() ? sheets[sheet + 1].begin : end(); }
    PlanPlace end_of(const Sheet& sheet) const { return end_of(std::size_t(&sheet - sheets.data())); }

    /// Calls visit(row, slot a, slot b) for the links of a run.
    template <class Visit> void each_link(const LinkRun& run, Visit&& visit) const {
        for (std::uint32_t i = 0; i < run.count; ++i)
            if (run.scattered)
                visit(row_of(run, i), ends_a[run.a + i], ends_b[run.a + i]);
            else
                visit(row_of(run, i), run.a + i, run.b + i);
    }

    static constexpr std::size_t lanes = 16; ///< a pack reads on behind the last

    void close() {
        first_run.push_back(std::uint32_t(runs.size()));
        parameters.resize(parameters.size() + lanes);
    }
    void open() {
        if (first_run.empty()) return;
        first_run.pop_back();
        parameters.resize(parameters.size() - lanes);
    }

    /// That of link i of a run.
    Row row_of(const LinkRun& run, std::uint32_t i) const {
        return run.row_step == 0 ? rows[run.row + i] : run.row + i * run.row_step;
    }
    /// The band that a slot lies in, from that band on.
    std::uint32_t band_of(std::uint32_t first_band, std::uint32_t slot) const {
        const auto found = std::upper_bound(bands.begin() + first_band, bands.end(), slot,
                                            [](std::uint32_t value, const Band& band) { return value < band.last; });
        return std::uint32_t(found - bands.begin());
    }

    void reserve(std::size_t particles, std::size_t distances, std::size_t constraints) {
        sheets.reserve(particles + 1);
        bands.reserve(particles + 1);
        families.reserve(distances + 1);
        first_run.reserve(2 * distances + particles + 1);
        runs.reserve(distances);
        parameters.reserve(distances + lanes + 1);
        for (auto* column : {&ends_a, &ends_b, &rows}) column->reserve(distances);
        others.reserve(constraints);
    }
    void clear() {
        parameters.clear();
        for (auto* column : {&first_run, &ends_a, &ends_b, &rows}) column->clear();
        sheets.clear();
        bands.clear();
        families.clear();
        runs.clear();
        pins.clear();
        tethers.clear();
        half_per_reach_square.clear();
        others.clear();
    }
};

} // namespace sinew
