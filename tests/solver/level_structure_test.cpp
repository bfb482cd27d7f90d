#include "sinew/solver/level_structure.h"

#include "bench/shuffle.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace sinew::SINEW_TEST_FILE {
namespace {

using Number = std::uint32_t;

/// Who is whose neighbour, under numbers in no order but for those that keep theirs.
struct Joined {
    std::vector<Number> number;   ///< of a place
    std::vector<Number> position; ///< of a number
    RowLists<Number> near;

    Joined(Number positions, Number kept, const std::set<std::pair<Number, Number>>& links) : number(positions) {
        std::iota(number.begin(), number.end(), Number(0));
        std::vector<Number> others(number.begin() + kept, number.end());
        bench::shuffle(others, 7);
        std::copy(others.begin(), others.end(), number.begin() + kept);
        position.resize(positions);
        for (Number i = 0; i < positions; ++i) position[number[i]] = i;
        near.fill(positions, [&](auto&& visit) {
            for (const auto& [a, b] : links) visit(number[a], number[b]), visit(number[b], number[a]);
        });
    }

    /// As places.
    std::vector<std::vector<Number>> rows() const {
        LevelStructure levels;
        levels.find(near);
        std::vector<std::vector<Number>> rows(levels.size());
        for (std::size_t i = 0; i < rows.size(); ++i)
            for (const Number at : levels[i]) rows[i].push_back(position[at]);
        return rows;
    }
};

enum class Diagonals { none, one, both };

std::set<std::pair<Number, Number>> grid(Number columns, Number rows, Diagonals diagonals) {
    std::set<std::pair<Number, Number>> links;
    for (Number r = 0; r < rows; ++r)
        for (Number c = 0; c < columns; ++c) {
            const Number at = r * columns + c;
            if (c + 1 < columns) links.insert({at, at + 1});
            if (r + 1 < rows) links.insert({at, at + columns});
            if (c + 1 == columns || r + 1 == rows) continue;
            if (diagonals != Diagonals::none) links.insert({at, at + columns + 1});
            if (diagonals == Diagonals::both) links.insert({at + 1, at + columns});
        }
    return links;
}

class GridsInNoOrder : public testing::TestWithParam<Diagonals> {};

TEST_P(GridsInNoOrder, LieInTheirRowsAgain) {
    constexpr Number columns = 17, rows = 23;
    const Joined joined(columns * rows, columns, grid(columns, rows, GetParam()));
    const auto found = joined.rows();
    ASSERT_EQ(found.size(), rows);
    for (Number r = 0; r < rows; ++r) {
        ASSERT_EQ(found[r].size(), columns) << r;
        for (Number c = 0; c < columns; ++c) EXPECT_EQ(found[r][c], r * columns + c) << r << ", " << c;
    }
}

INSTANTIATE_TEST_SUITE_P(LevelStructure, GridsInNoOrder,
                         testing::Values(Diagonals::none, Diagonals::one, Diagonals::both), [](const auto& grid) {
                             return std::string(grid.param == Diagonals::none  ? "Without"
                                                : grid.param == Diagonals::one ? "WithOneDiagonal"
                                                                               : "WithBothDiagonals");
                         });

/// Each once, and never further from its neighbours than a row.
void expect_rows_of_neighbours(const Joined& joined) {
    const auto rows = joined.rows();
    std::vector<Number> row_of(joined.position.size(), ~Number(0));
    for (Number r = 0; r < rows.size(); ++r)
        for (const Number position : rows[r]) {
            EXPECT_EQ(row_of[position], ~Number(0)) << position;
            row_of[position] = r;
        }
    for (Number i = 0; i < joined.position.size(); ++i)
        for (const Number near : joined.near[i]) {
            const auto a = row_of[joined.position[i]], b = row_of[joined.position[near]];
            EXPECT_LE(std::max(a, b) - std::min(a, b), 1U);
        }
}

TEST(LevelStructure, BeginAtOneParticleOfWhatHasNoEdge) {
    constexpr Number around = 12;
    std::set<std::pair<Number, Number>> links; // a torus
    for (Number r = 0; r < around; ++r)
        for (Number c = 0; c < around; ++c) {
            links.insert({r * around + c, r * around + (c + 1) % around});
            links.insert({r * around + c, (r + 1) % around * around + c});
        }
    const Joined joined(around * around, 0, links);
    expect_rows_of_neighbours(joined);
    EXPECT_EQ(joined.rows().front().size(), 1U);
}

TEST(LevelStructure, HoldAnyHeapOfLinks) {
    for (Number seed = 1; seed <= 20; ++seed) {
        constexpr Number positions = 60;
        std::set<std::pair<Number, Number>> links; // a tree and some more
        for (Number i = 1; i < positions; ++i) links.insert({Number(random::whole(0, i - 1, seed, 0, i)), i});
        for (Number i = 0; i < 2 * seed; ++i) {
            const auto a = Number(random::whole(0, positions - 1, seed, 1, i));
            const auto b = Number(random::whole(0, positions - 1, seed, 2, i));
            if (a < b) links.insert({a, b});
        }
        expect_rows_of_neighbours(Joined(positions, 0, links));
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
