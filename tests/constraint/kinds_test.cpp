#include "sinew/constraint/kind_table.h"

#include <functional>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <vector>

/// Every kind of constraint in the list obeys these laws; a new kind is tested the moment it is in the list.
namespace sinew::SINEW_TEST_FILE {
namespace {

template <int D> using Positions = std::vector<Vec<D, double>>;

template <int D> struct Measured {
    double value = 0;
    Positions<D> gradient;
};

template <class Kind, int D> Measured<D> measure(const Positions<D>& x) {
    Measured<D> measured{0, Positions<D>(x.size())};
    if constexpr (Kind::arity == any_arity) {
        measured.value = Kind::template evaluate<double>(x, measured.gradient);
    } else {
        Points<Kind::arity, D, double> points;
        for (std::size_t i = 0; i < points.size(); ++i) points[i] = x[i];
        const auto evaluated = Kind::evaluate(points);
        measured.value = evaluated.value;
        measured.gradient.assign(evaluated.gradient.begin(), evaluated.gradient.end());
    }
    return measured;
}

double coordinate() {
    return *rc::gen::inRange(-1000, 1001) / 1000.0;
}

template <int D> Vec<D, double> any_vector() {
    return Vec<D, double>::map([](int) { return coordinate(); });
}

template <class Kind, int D> Positions<D> any_shape() {
    const int n = Kind::arity == any_arity ? *rc::gen::inRange(3, 9) : Kind::arity;
    Positions<D> x;
    for (int i = 0; i < n; ++i) x.push_back(any_vector<D>());
    return x;
}

/// The difference of two measures, the short way round for angles.
template <class Kind> double difference(double a, double b) {
    const double plain = a - b;
    return Kind::period > 0 ? plain - Kind::period * std::round(plain / Kind::period) : plain;
}

template <int D> double steepest(const Measured<D>& m) {
    double max = 0;
    for (const auto& g : m.gradient) max = std::max(max, norm(g));
    return max;
}

/// Far enough from where the measure has a corner (coincident points, a straight 3D angle) for finite differences.
template <class Kind, int D> Positions<D> smooth_shape() {
    auto x = any_shape<Kind, D>();
    for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) RC_PRE(distance(x[i], x[j]) > 0.05); // a leg without a length has no slope
    RC_PRE(steepest(measure<Kind, D>(x)) < 50.0);
    if (Kind::length_power == 0 && Kind::period == 0) {
        const double angle = measure<Kind, D>(x).value;
        RC_PRE(angle > 0.05 && angle < pi<double> - 0.05);
    }
    return x;
}

Vec<2, double> turned(const Vec<2, double>& x, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {{c * x[0] - s * x[1], s * x[0] + c * x[1]}};
}

Vec<3, double> turned(const Vec<3, double>& x, double angle) { // about (1, 2, 2) / 3, after Rodrigues
    const Vec<3, double> k{{1.0 / 3, 2.0 / 3, 2.0 / 3}};
    return x * std::cos(angle) + cross(k, x) * std::sin(angle) + k * (dot(k, x) * (1 - std::cos(angle)));
}

/// Calls law with each kind of dimension D.
template <int D, class Law> void for_each_kind(Law&& law) {
    Kinds<D>::for_each([&](auto tag) { law.template operator()<typename decltype(tag)::type, D>(); });
}

template <class Law> void for_each_kind_everywhere(Law&& law) {
    for_each_kind<2>(law);
    for_each_kind<3>(law);
}

/// Checks a law for every kind with random shapes; a failure prints the kind and the smallest shape that breaks it.
#define EVERY_KIND(law)                                                                                                \
    template <class Kind, int D> void law();                                                                           \
    TEST(EveryKind, law) {                                                                                             \
        for_each_kind_everywhere([]<class Kind, int D>() {                                                             \
            EXPECT_TRUE(rc::check(std::string(Kind::name) + " in " + std::to_string(D) + "D", law<Kind, D>));          \
        });                                                                                                            \
    }                                                                                                                  \
    template <class Kind, int D> void law()

// Central differences of step d err by d^2/6 of the third derivative (gradients up to 50 bend over 1/50, so up to
// 50^3) and by rounding / d = 1e-10.
EVERY_KIND(GradientEqualsFiniteDifferences) {
    const auto x = smooth_shape<Kind, D>();
    const auto here = measure<Kind, D>(x);
    constexpr double d = 1e-6;
    for (std::size_t i = 0; i < x.size(); ++i)
        for (int axis = 0; axis < D; ++axis) {
            auto ahead = x, behind = x;
            ahead[i][axis] += d;
            behind[i][axis] -= d;
            const double slope =
                difference<Kind>(measure<Kind, D>(ahead).value, measure<Kind, D>(behind).value) / (2 * d);
            RC_ASSERT(std::abs(slope - here.gradient[i][axis]) < 1e-6 * (1 + std::pow(steepest(here), 3)));
        }
}

// Moving everything alike changes nothing of an invariant kind, so the gradients cancel: to rounding of their size.
EVERY_KIND(GradientsSumToZero) {
    if constexpr (!is_invariant<Kind>) return;
    const auto m = measure<Kind, D>(any_shape<Kind, D>());
    Vec<D, double> sum{};
    for (const auto& g : m.gradient) sum += g;
    RC_ASSERT(norm(sum) <= 1e-14 * double(m.gradient.size()) * (1 + steepest(m)));
}

// Turning everything alike changes nothing of an invariant kind, so the gradients have no torque.
EVERY_KIND(GradientsHaveNoTorque) {
    if constexpr (!is_invariant<Kind>) return;
    const auto x = smooth_shape<Kind, D>();
    const auto m = measure<Kind, D>(x);
    for (int i = 0; i < D; ++i)
        for (int j = 0; j < i; ++j) {
            double torque = 0;
            for (std::size_t k = 0; k < x.size(); ++k)
                torque += x[k][i] * m.gradient[k][j] - x[k][j] * m.gradient[k][i];
            RC_ASSERT(std::abs(torque) <= 1e-13 * double(x.size()) * (1 + square(steepest(m))));
        }
}

EVERY_KIND(MeasuresTheSameWhereverAndHoweverItLies) {
    if constexpr (!is_invariant<Kind>) return;
    const auto x = smooth_shape<Kind, D>();
    const auto offset = any_vector<D>() * 10.0;
    const double angle = coordinate() * 3;
    Positions<D> moved;
    for (const auto& point : x) moved.push_back(turned(point, angle) + offset);
    const auto before = measure<Kind, D>(x), after = measure<Kind, D>(moved);
    // coordinates near 10 are rounded at 1e-15, which a steep gradient amplifies
    RC_ASSERT(std::abs(difference<Kind>(before.value, after.value)) < 1e-13 * (1 + square(steepest(before))));
    for (std::size_t i = 0; i < x.size(); ++i)
        RC_ASSERT(distance(turned(before.gradient[i], angle), after.gradient[i]) <
                  1e-12 * (1 + std::pow(steepest(before), 3)));
}

EVERY_KIND(GrowsWithSizeAsItsLengthPowerSays) {
    const auto x = smooth_shape<Kind, D>();
    Positions<D> larger;
    for (const auto& point : x) larger.push_back(point * 2.0);
    const double expected = measure<Kind, D>(x).value * std::pow(2, Kind::length_power);
    RC_ASSERT(std::abs(measure<Kind, D>(larger).value - expected) < 1e-12);
}

// Shapes drawn from a grid of three values a coordinate: coincident, collinear and coplanar points abound; then sizes
// from the smallest numbers there are to beyond the world's limits.
template <class Kind, int D, class Real> void stays_finite() {
    const int n = Kind::arity == any_arity ? *rc::gen::inRange(3, 6) : Kind::arity;
    const auto size = Real(std::pow(10.0, *rc::gen::inRange(-45, 9)));
    const auto grain = Real(std::pow(10.0, *rc::gen::inRange(-45, 1)));
    std::vector<Vec<D, Real>> x, gradient(std::size_t(n), Vec<D, Real>{});
    for (int i = 0; i < n; ++i)
        x.push_back(Vec<D, Real>::map([&](int) {
            return Real(*rc::gen::inRange(-1, 2)) * size + Real(*rc::gen::inRange(-1, 2)) * size * grain;
        }));
    Real value{};
    if constexpr (Kind::arity == any_arity) {
        value = Kind::template evaluate<Real>(x, gradient);
    } else {
        Points<Kind::arity, D, Real> points;
        for (std::size_t i = 0; i < points.size(); ++i) points[i] = x[i];
        const auto evaluated = Kind::evaluate(points);
        value = evaluated.value;
        gradient.assign(evaluated.gradient.begin(), evaluated.gradient.end());
    }
    RC_ASSERT(is_finite(value));
    for (const auto& g : gradient) RC_ASSERT(is_finite(g));
}

EVERY_KIND(IsFiniteForDegenerateAndExtremeShapes) {
    stays_finite<Kind, D, double>();
    stays_finite<Kind, D, float>();
}

TEST(Distance, IsTheLengthBetweenItsEnds) {
    const auto m = measure<Distance<2>, 2>({{1, 1}, {4, 5}});
    EXPECT_DOUBLE_EQ(m.value, 5);
    EXPECT_NEAR(distance(m.gradient[1], Vec2<double>{0.6, 0.8}), 0, 1e-15);
}

TEST(Rail, IsTheDistanceFromTheLineAndPositiveOnItsLeft) {
    const auto m = measure<Rail<2>, 2>({{1, 1}, {5, 1}, {3, 4}});
    EXPECT_DOUBLE_EQ(m.value, 3);
    EXPECT_NEAR(distance(m.gradient[2], Vec2<double>{0, 1}), 0, 1e-15);
    EXPECT_NEAR(distance(m.gradient[0], Vec2<double>{0, -0.5}), 0, 1e-15)
        << "both ends give way alike under its middle";
    EXPECT_DOUBLE_EQ((measure<Rail<2>, 2>({{1, 1}, {5, 1}, {9, -2}}).value), -3) << "also beyond its ends";
}

TEST(Angle, IsPositiveCounterClockwiseInTwoDimensionsAndZeroWhereStraight) {
    const auto turn = [](Vec2<double> c) { return measure<Angle<2>, 2>({{-1, 0}, {0, 0}, c}).value; };
    EXPECT_EQ(turn({2, 0}), 0);
    EXPECT_DOUBLE_EQ(turn({0, 1}), pi<double> / 2);
    EXPECT_DOUBLE_EQ(turn({0, -1}), -pi<double> / 2);
    EXPECT_DOUBLE_EQ(turn({-1, 0}), pi<double>) << "folded back on itself";
}

TEST(Angle, IsTheUnsignedTurnInThreeDimensions) {
    const auto turn = [](Vec3<double> c) { return measure<Angle<3>, 3>({{-1, 0, 0}, {0, 0, 0}, c}).value; };
    EXPECT_EQ(turn({2, 0, 0}), 0);
    EXPECT_DOUBLE_EQ(turn({0, 0, 1}), pi<double> / 2);
    EXPECT_DOUBLE_EQ(turn({0, -1, 0}), pi<double> / 2);
}

TEST(Area, IsPositiveCounterClockwise) {
    EXPECT_DOUBLE_EQ((measure<Area<2>, 2>({{0, 0}, {2, 0}, {2, 3}, {0, 3}}).value), 6);
    EXPECT_DOUBLE_EQ((measure<Area<2>, 2>({{0, 3}, {2, 3}, {2, 0}, {0, 0}}).value), -6);
}

TEST(Area, KeepsItsDigitsFarFromTheOrigin) {
    EXPECT_DOUBLE_EQ((measure<Area<2>, 2>({{1e8, 1e8}, {1e8 + 1, 1e8}, {1e8 + 1, 1e8 + 1}}).value), 0.5);
}

TEST(Volume, IsASixthOfTheBoxAndPositiveForARightHandedTetrahedron) {
    EXPECT_DOUBLE_EQ((measure<Volume<3>, 3>({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}).value), 1.0 / 6);
    EXPECT_DOUBLE_EQ((measure<Volume<3>, 3>({{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}}).value), -1.0 / 6);
}

// a b c lies in the plane z = 0 with its normal up (counter-clockwise from above); d folds up by the angle.
TEST(Dihedral, IsZeroFlatAndPositiveTowardsTheNormals) {
    const auto bend = [](double angle) {
        return measure<Dihedral<3>, 3>({{0, -1, 0}, {1, 0, 0}, {-1, 0, 0}, {0, std::cos(angle), std::sin(angle)}})
            .value;
    };
    const Vec3<double> normal = cross(Vec3<double>{1, 1, 0}, Vec3<double>{-1, 1, 0}); // (b - a) x (c - a)
    ASSERT_GT(normal[2], 0);
    EXPECT_NEAR(bend(0), 0, 1e-15);
    EXPECT_NEAR(bend(0.5), 0.5, 1e-15);
    EXPECT_NEAR(bend(-0.5), -0.5, 1e-15);
    EXPECT_NEAR(std::abs(bend(3.14159)), 3.14159, 1e-14);
}

TEST(Kinds, NamesAreUniqueAndArityFits) {
    for_each_kind_everywhere([]<class Kind, int D>() {
        int same = 0;
        Kinds<D>::for_each([&](auto tag) { same += std::string_view(decltype(tag)::type::name) == Kind::name; });
        EXPECT_EQ(same, 1) << Kind::name;
        EXPECT_TRUE(Kind::arity == any_arity || Kind::arity >= 1) << Kind::name;
        EXPECT_TRUE(Kind::dimensions.include(D)) << Kind::name;
    });
}

TEST(Kinds, AreNumberedByTheirDimensionAsTheTablesOfAWorld) {
    EXPECT_EQ((kinds_in<3>[kind_number<Volume, 3>].name), "volume");
    EXPECT_EQ((kinds_in<2>[kind_number<Rail, 2>].name), "rail");
    for_each_kind_everywhere([]<class Kind, int D>() {
        const auto& info = kinds_in<D>[std::size_t(Kinds<D>::template index_of<Kind>)];
        EXPECT_EQ(info.name, Kind::name);
        EXPECT_EQ(info.any_arity, Kind::arity == any_arity);
        EXPECT_EQ(info.angle, Kind::length_power == 0);
        EXPECT_EQ(kind_index<D>(Kind::name), (Kinds<D>::template index_of<Kind>)) << Kind::name;
        EXPECT_EQ(kind_called(Kind::name)->min_arity, info.min_arity);
    });
    EXPECT_EQ(kind_index<2>("volume"), -1);
    EXPECT_EQ(kind_index<3>("rail"), -1);
    EXPECT_FALSE(kind_called("hieght"));
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
