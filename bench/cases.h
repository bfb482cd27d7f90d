#pragma once

#include "sinew/world/world.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Benchmark cases: families of worlds of any size.
namespace sinew::bench {

struct CaseFamily {
    std::string_view name;          ///< cases are NAME-SIZE: cloth-256
    std::string_view about;         ///< meaning of the size, and the world's contents
    std::vector<std::string> sizes; ///< sizes measured by default
    double max = 0;                 ///< largest size
    bool has_direct = false;        ///< true: cases also run with the direct solver
    void (*build_float)(World<3, float>& world, int size) = nullptr;
    void (*build_double)(World<3, double>& world, int size) = nullptr;

    void build(World<3, float>& world, int size) const { build_float(world, size); }
    void build(World<3, double>& world, int size) const { build_double(world, size); }
};

/// List of families. A new family takes one new file in bench/families/ and one word here.
#define SINEW_FAMILIES(X) X(cloth) X(mesh) X(ragdolls) X(ropes) X(swing) X(heavy) X(scale)

namespace family {
#define SINEW_DECLARE(name) CaseFamily name();
SINEW_FAMILIES(SINEW_DECLARE)
#undef SINEW_DECLARE
} // namespace family

struct Case {
    std::string name; ///< ragdolls-1000, ragdolls-1000-direct
    const CaseFamily* family = nullptr;
    int size = 0;
    bool direct = false; ///< true: the direct solver where eligible, the engine's default; false: swept throughout,
                         ///< like the textbook
};

std::span<const CaseFamily> families();

/// Case by name: FAMILY-SIZE or FAMILY-SIZE-direct; empty if unknown. A size is a whole number, also written as 4e6.
std::optional<Case> find_case(std::string_view name);
std::vector<Case> all_cases();

/// World of a case before the first step: gravity, 10 substeps of 1 iteration (direct: the engine's choice of
/// substeps), and the family's contents.
template <class Real> World<3, Real> world_of(const Case& chosen);

} // namespace sinew::bench
