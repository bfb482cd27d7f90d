#pragma once

#include "sinew/prefab/prefabs.h"

#include "tests/constants.h"
#include "tests/stepped.h"

#include <algorithm>
#include <functional>
#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace sinew {

/// A world with one figure in it, called "it".
template <int D, class Real> struct Made {
    test::Stepped<D, Real> world;
    FigureIndex index = 0;

    const Figure& figure() const { return world.figures[index]; }
    std::size_t particles() const { return world.particles.size(); }
    std::size_t constraints() const { return figure().constraints.size(); }

    Vec<D, double> position(std::string_view name) const {
        return cast<double>(position_of(world, find_particle(world, "it/" + std::string(name)).value()).value());
    }
    double mass(std::string_view name) const {
        const auto id = find_particle(world, "it/" + std::string(name)).value();
        return 1 / double(world.particles.inverse_mass[row_of(world, id).value()]);
    }
    ConstraintState constraint(std::string_view name) const {
        return constraint_state(world, find_constraint(world, "it/" + std::string(name)).value()).value();
    }
};

template <int D = 2, class Real = double, class Prefab>
Made<D, Real> make(const Prefab& prefab, Mode mode = Mode::physical, const Placement<D, Real>& placement = {}) {
    Made<D, Real> made;
    made.world.settings.mode = mode;
    made.index = build(made.world, prefab, "it", placement);
    return made;
}

template <class WorldT> double whole_mass(const WorldT& world) {
    double sum = 0;
    for (const auto inverse : world.particles.inverse_mass) sum += 1 / double(inverse);
    return sum;
}

/// Any value that a field allows, but of a size that a test has time for.
struct AnyValue {
    void operator()(int& value, const Field& field) const {
        constexpr double max = 30;
        value = *rc::gen::inRange(int(field.low), int(std::min(field.high, max)) + 1);
    }
    void operator()(double& value, const Field& field) const {
        const double low = std::max(field.low, -1e3), high = std::min(field.high, 1e3);
        const double share = *rc::gen::inRange(0, 1001) / 1000.0;
        value = low + (high - low) * share * share * share * share; // more small ones than large ones
    }
    void operator()(bool& value, const Field&) const { value = *rc::gen::arbitrary<bool>(); }
    void operator()(std::string& value, const Field& field) const {
        if (!field.choices.empty()) value = field.choices[*rc::gen::inRange(std::size_t(0), field.choices.size())];
    }
    void operator()(std::vector<double>& values, const Field&) const {
        values.resize(*rc::gen::inRange(std::size_t(0), std::size_t(4)));
        for (auto& value : values) value = *rc::gen::inRange(0, 4);
    }
};

/// A prefab with random parameters in their ranges, that fit together.
template <class Prefab> Prefab any(int dimension) {
    for (int tries = 0; tries < 100; ++tries) {
        Prefab prefab;
        Prefab::fields(prefab, AnyValue{});
        if (!problem_of(prefab, dimension)) return prefab;
    }
    RC_DISCARD("no parameters that fit together");
}

/// Calls check(D, Real, prefab) with every prefab in every world it exists in; each with random parameters.
template <class Check> void for_every_prefab(Check&& check) {
    Prefabs::for_each([&]<class Prefab>(std::type_identity<Prefab>) {
        const auto in = [&]<int D, class Real>(test::Stepped<D, Real>) {
            if constexpr (Prefab::dimensions.include(D)) {
                // One type for all of them: RapidCheck's machinery is compiled anew for every other type.
                const std::function<void()> law = [&] { check.template operator()<D, Real>(any<Prefab>(D)); };
                const bool passed = rc::check(std::string(Prefab::name), law);
                EXPECT_TRUE(passed) << Prefab::name << " in " << D << "D";
            }
        };
        in(test::Stepped<2, float>{});
        in(test::Stepped<2, double>{});
        in(test::Stepped<3, float>{});
        in(test::Stepped<3, double>{});
    });
}

} // namespace sinew
