#include "sinew/collide/decompose.h"
#include "sinew/math/random.h"

#include "files/in/uncrossed.h"
#include "tests/files/imported.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

/// Outlines that cross enclose the same area once they are cut, by either rule of SVG.
namespace sinew::SINEW_TEST_FILE {
namespace {

using files::Outline;
using test::has_note;

/// Holes are negative.
double area_of(const std::vector<Outline>& borders) {
    double sum = 0;
    for (const auto& border : borders) sum += collide::twice_area(border) / 2;
    return sum;
}

double filled_area(const std::vector<Outline>& outlines, std::string_view rule) {
    return area_of(files::uncrossed(outlines, rule));
}

/// Length of a horizontal line inside of outlines, from the winding numbers along it.
double filled_length(const std::vector<Outline>& outlines, bool is_even_odd, double y) {
    std::vector<std::pair<double, int>> crossings;
    for (const auto& outline : outlines)
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const auto &a = outline[i], &b = outline[(i + 1) % outline.size()];
            if ((a[1] > y) != (b[1] > y))
                crossings.push_back({a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]), b[1] > a[1] ? 1 : -1});
        }
    std::ranges::sort(crossings);
    double length = 0;
    int winding = 0;
    for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
        winding += crossings[i].second;
        if (is_even_odd ? winding % 2 != 0 : winding != 0) length += crossings[i + 1].first - crossings[i].first;
    }
    return length;
}

/// A star of five points drawn in one line, of radius 100 about a place.
Outline pentagram(double x, double y) {
    Outline star;
    for (int i = 0; i < 5; ++i) {
        const double angle = pi<double> * (0.8 * i - 0.5);
        star.push_back({{x + 100 * std::cos(angle), y + 100 * std::sin(angle)}});
    }
    return star;
}

constexpr double degrees = pi<double> / 180;

TEST(Uncrossed, APentagramIsFilledOrHollowAsTheRuleSays) {
    const double grid = 5 * 600.0 / 1024; // a cell beside each edge
    // Ten triangles from the middle, with a tip and a corner of the pentagon between the tips, r from the middle.
    const double r = 100 * std::cos(72 * degrees) / std::cos(36 * degrees);
    const double star = 5 * 100 * r * std::sin(36 * degrees), pentagon = 2.5 * r * r * std::sin(72 * degrees);
    EXPECT_NEAR(filled_area({pentagram(0, 0)}, "nonzero"), star, grid);
    const auto tips = files::uncrossed({pentagram(0, 0)}, "evenodd");
    EXPECT_EQ(tips.size(), 5U); // they touch at corners alone
    EXPECT_NEAR(area_of(tips), star - pentagon, grid);
}

TEST(Uncrossed, SquaresThatOverlapAreOneOrHaveAHoleWhereTheyDo) {
    const Outline a{{{0, 0}}, {{4, 0}}, {{4, 4}}, {{0, 4}}}, b{{{2, 2}}, {{6, 2}}, {{6, 6}}, {{2, 6}}};
    EXPECT_EQ(filled_area({a, b}, "nonzero"), 28);
    EXPECT_EQ(filled_area({a, b}, "evenodd"), 24);
    const Outline back(b.rbegin(), b.rend());
    EXPECT_EQ(filled_area({a, back}, "nonzero"), 24); // windings of opposite sense cancel
    EXPECT_EQ(filled_area({a, a}, "nonzero"), 16);
    EXPECT_EQ(filled_area({a, a}, "evenodd"), 0);
}

TEST(Uncrossed, AHoleStays) {
    const Outline a{{{0, 0}}, {{20, 0}}, {{20, 20}}, {{0, 20}}}, hole{{{4, 4}}, {{4, 8}}, {{8, 8}}, {{8, 4}}},
        across{{{15, 5}}, {{30, 5}}, {{30, 9}}, {{15, 9}}};
    const auto borders = files::uncrossed({a, hole, across}, "nonzero");
    EXPECT_EQ(borders.size(), 2U);
    EXPECT_EQ(area_of(borders), 400 - 16 + 40);
}

TEST(Uncrossed, TanglesHaveTheAreaOfTheirWindingNumbers) {
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        std::vector<Outline> outlines(1 + seed % 3);
        for (std::size_t k = 0; k < outlines.size(); ++k)
            for (std::uint64_t i = 0; i < 9; ++i)
                outlines[k].push_back(
                    {{100 * random::symmetric(seed, 2 * k, i), 100 * random::symmetric(seed, 2 * k + 1, i)}});
        for (const bool is_even_odd : {false, true}) {
            double area = 0;
            constexpr int lines = 20000;
            for (int i = 0; i < lines; ++i)
                area += filled_length(outlines, is_even_odd, -100 + 200 * (i + 0.5) / lines) * 200 / lines;
            // Corners move by half a cell of 1/1024 pixel: at most the length of all edges times that.
            EXPECT_NEAR(filled_area(outlines, is_even_odd ? "evenodd" : "nonzero"), area, 4) << seed;
            EXPECT_FALSE(files::have_crossings(files::uncrossed(outlines, is_even_odd ? "evenodd" : "nonzero")))
                << seed;
        }
    }
}

TEST(Uncrossed, TooManyCrossingsGiveNothing) {
    Outline zigzag;
    for (int i = 0; i < 400; ++i) zigzag.push_back({{i % 2 == 0 ? 0.0 : 1000.0, double((i * 397) % 400)}});
    EXPECT_TRUE(files::uncrossed({zigzag}, "nonzero").empty());
}

TEST(ImportSvg, OutlinesThatCrossAreFilledAsBrowsersDo) {
    const auto imported = test::import_text("a.svg", R"(<svg width='400' height='200'>
<polygon id='star' points='50,0 21,90 98,35 2,35 79,90'/>
<path id='bow' d='M100 0L150 50L150 0L100 50z'/>
<path id='frame' fill-rule='evenodd' d='M200 20h40v40h-40z M220 40h40v40h-40z'/>
<path id='ground' d='M0 150L400 190L400 150L0 190z'/></svg>)");
    EXPECT_EQ(test::count_at(imported, "/figures"), 5U); // a star, two halves of a bow, two corners of squares
    EXPECT_EQ(test::count_at(imported, "/colliders"), 2U);
    EXPECT_FALSE(has_note(imported, "", "left out"));
    EXPECT_FALSE(has_note(imported, "", "no area"));
    std::string why;
    EXPECT_TRUE(test::open_imported(imported, &why)) << why;
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
