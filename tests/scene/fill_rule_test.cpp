#include "sinew/math/random.h"
#include "sinew/scene/fill_rule.h"

#include <gtest/gtest.h>

namespace sinew::SINEW_TEST_FILE {
namespace {

/// Area of the convex parts of a path's solids.
double solid_area(const std::string& path, std::string_view rule) {
    const auto found = solids_of(read_svg_path(path).outlines, rule);
    EXPECT_TRUE(found.error.empty()) << found.error;
    double sum = 0;
    for (const auto& [outline, holes] : found.solids)
        for (const auto& part : collide::convex_parts(outline, holes)) sum += collide::twice_area(part) / 2;
    return sum;
}
/// A square about a point, counter-clockwise in a y-up frame or clockwise.
std::string square(double x, double y, double half, bool clockwise) {
    const auto text = [](double number) { return std::to_string(number); };
    const auto at = [&](double sx, double sy) { return text(x + sx * half) + " " + text(y + sy * half) + " "; };
    const std::string middle = clockwise ? at(-1, 1) + at(1, 1) + at(1, -1) : at(1, -1) + at(1, 1) + at(-1, 1);
    return "M" + at(-1, -1) + "L" + middle + "Z ";
}

// Area of a ring, of a ring with an island, and of squares side by side, by both rules and all orientations.
TEST(FillRule, HolesAreLeftOut) {
    for (const bool outer : {false, true})
        for (const bool inner : {false, true})
            for (const bool island : {false, true}) {
                const bool is_hole = outer != inner;
                const auto ring = square(0, 0, 2, outer) + square(0.3, -0.2, 1, inner);
                EXPECT_NEAR(solid_area(ring, "evenodd"), 12, 1e-9);
                EXPECT_NEAR(solid_area(ring, "nonzero"), is_hole ? 12 : 16, 1e-9);
                const auto target = ring + square(0.3, -0.2, 0.5, island);
                EXPECT_NEAR(solid_area(target, "evenodd"), 13, 1e-9);
                const double expected = is_hole ? 13 : 16; // around the island two windings, or none
                EXPECT_NEAR(solid_area(target, "nonzero"), expected, 1e-9);
                EXPECT_NEAR(solid_area(square(-3, 0, 1, outer) + square(3, 0, 1, inner), "nonzero"), 8, 1e-9);
            }
}

// Many holes, wherever they lie.
TEST(FillRule, ManyHoles) {
    for (int trial = 0; trial < 20; ++trial) {
        std::string path = square(0, 0, 10, false);
        double left = 400;
        for (int i = 0; i < 9; ++i) {
            const auto drawn = [&](std::uint64_t k) {
                return random::uniform(std::uint64_t(trial), std::uint64_t(i), k);
            };
            const double half = 0.3 + 1.5 * drawn(1);
            path += square((i % 3 - 1) * 6 + drawn(2), (i / 3 - 1) * 6 + drawn(3), half, true);
            left -= 4 * half * half;
        }
        EXPECT_NEAR(solid_area(path, "nonzero"), left, 1e-4 * left) << path; // numbers have six digits
    }
}

TEST(FillRule, CrossingHolesAreRefused) {
    const auto crossing = square(0, 0, 1, false) + square(1, 1, 1, true);
    EXPECT_FALSE(solids_of(read_svg_path(crossing).outlines, "nonzero").error.empty());
    EXPECT_FALSE(solids_of(read_svg_path(crossing).outlines, "evenodd").error.empty());
    const auto united = square(0, 0, 1, false) + square(1, 1, 1, false);
    EXPECT_TRUE(solids_of(read_svg_path(united).outlines, "nonzero").error.empty());
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
