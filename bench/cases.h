#pragma once

#include "sinew/solver/world.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// What is measured: kinds of worlds, of any size.
namespace sinew::bench {

struct Family {
    std::string_view name;          ///< cases are NAME-SIZE: cloth-256
    std::string_view about;         ///< what the size is, and what stands there
    std::vector<std::string> sizes; ///< that are measured when nothing is asked for
    double most = 0;                ///< largest size
    bool has_direct = false;        ///< it can also be solved at once
    void (*build_float)(World<3, float>& world, int size) = nullptr;
    void (*build_double)(World<3, double>& world, int size) = nullptr;

    void build(World<3, float>& world, int size) const { build_float(world, size); }
    void build(World<3, double>& world, int size) const { build_double(world, size); }
};

/// The list of families. A new one is one new file in bench/families/ and one word here.
#define SINEW_FAMILIES(X) X(cloth) X(mesh) X(ragdolls) X(ropes) X(swing) X(heavy) X(scale)

namespace family {
#define SINEW_DECLARE(name) Family name();
SINEW_FAMILIES(SINEW_DECLARE)
#undef SINEW_DECLARE
} // namespace family

struct Case {
    std::string name; ///< ragdolls-1000, ragdolls-1000-direct
    const Family* family = nullptr;
    int size = 0;
    bool direct = false; ///< what can be solved at once is, as the engine does by default; else all is swept, as the
                         ///< textbook does
};

std::span<const Family> families();

/// The case of that name: FAMILY-SIZE or FAMILY-SIZE-direct. A size is a whole number, also written as 4e6.
std::optional<Case> find_case(std::string_view name);
std::vector<Case> all_cases();

/// The world of a case, before its first step: gravity, 10 substeps of 1 iteration, what the family builds.
template <class Real> World<3, Real> world_of(const Case& chosen);

} // namespace sinew::bench
