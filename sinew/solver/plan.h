#pragma once

#include "sinew/solver/block.h"
#include "sinew/solver/kernel.h"
#include "sinew/solver/levels.h"

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
};

/// Distances of one direction, or of one colour. Those of band j touch the bands j to j + reach.
struct Family {
    std::uint32_t first_run = 0; ///< of Plan::first_run: where those of each band begin, and one more
    std::uint32_t reach = 0;
    std::uint32_t delay = 0; ///< what it and those before it reach together
};

/// Particles that plain distances join, or several such heaps. Nothing in one sheet depends on another.
struct Sheet {
    std::uint32_t first_band = 0, bands = 0;
    std::uint32_t first_family = 0, families = 0;
    std::uint32_t lag = 0; ///< the delay of its last family
    std::uint32_t first_tether = 0, tethers = 0;
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
    std::uint32_t first = 0; ///< of Plan::per_reach_square: that of the sheet's first slot
};

/// Room for working out a plan.
struct PlanRoom {
    struct Part {
        std::uint32_t first_member = 0, members = 0, first_link = 0, links = 0;
    };
    std::vector<Part> parts;
    std::vector<Row> links, link_at, left; ///< rows of distances
    std::vector<Row> parent, part_of, members, rank, at, first_near, near, near_link;
    std::vector<std::uint32_t> anchors; ///< pins
    struct RigidLink {
        Row other;
        double length;
    };
    std::vector<RigidLink> rigid; ///< of each particle by its rank, from first_rigid on
    std::vector<std::uint32_t> first_rigid;
    std::vector<double> way, length_to;
    std::vector<std::pair<double, Row>> heap;
    std::vector<std::uint32_t> directions;
    std::vector<unsigned char> chained, colour;
    std::vector<std::uint64_t> used; ///< colours, a bit each
    struct Link {
        std::uint32_t band = 0, apart = 0, lower = 0; ///< slots of its ends
        Row number = 0;
        auto operator<=>(const Link&) const = default;
    };
    struct Sequence {
        std::uint32_t first = 0, end = 0; ///< of `sorted`
        std::uint32_t family = 0;
    };
    std::vector<Link> sorted, left_over;
    std::vector<Sequence> sequences;
    Levels levels;

    void reserve(std::size_t particles, std::size_t distances) {
        parts.reserve(particles + 1);
        for (auto* column : {&links, &link_at, &left}) column->reserve(distances);
        for (auto* column : {&parent, &part_of, &members, &rank, &at, &first_near}) column->reserve(particles + 1);
        near.reserve(2 * distances);
        near_link.reserve(2 * distances);
        directions.reserve(32);
        chained.reserve(particles);
        colour.reserve(distances);
        used.reserve(particles);
        sorted.reserve(distances);
        left_over.reserve(distances);
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
    std::vector<Real> low, high, compliance;   ///< one of each for a uniform run, else for each distance
    std::vector<Real> per_square;              ///< 1 / low^2, of each of them
    std::vector<std::uint32_t> ends_a, ends_b; ///< of what is scattered
    std::vector<std::uint32_t> rows;           ///< of runs without a step
    std::vector<PinnedSlot> pins;              ///< by slot
    std::vector<Tether> tethers;
    std::vector<Real> per_reach_square; ///< of each tether, by slot; 0 where it reaches anywhere
    bool may_tear = true;               ///< something in the world
    std::vector<SweepRun> others;       ///< constraints that are not plain, in the order of the sweep

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
        for (auto* column : {&low, &high, &compliance, &per_square}) column->reserve(distances + 17);
        for (auto* column : {&ends_a, &ends_b, &rows}) column->reserve(distances);
        others.reserve(constraints);
    }
    void clear() {
        for (auto* column : {&low, &high, &compliance}) column->clear();
        for (auto* column : {&first_run, &ends_a, &ends_b, &rows}) column->clear();
        sheets.clear();
        bands.clear();
        families.clear();
        runs.clear();
        pins.clear();
        tethers.clear();
        per_reach_square.clear();
        others.clear();
    }
};

} // namespace sinew
