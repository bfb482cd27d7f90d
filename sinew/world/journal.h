#pragma once

#include "sinew/world/constraint_adjacency.h"

#include <cstdint>
#include <memory>
#include <vector>

/// Journal of a world: changes since a solver has last read them. One solver reads a journal at a time; for any other,
/// and after a copy, everything counts as changed.
namespace sinew {

/// Change of a particle.
enum class Touch : char {
    joined,   ///< new, or with other constraints
    mobility, ///< became movable or immovable, which concerns all neighbours
    weight
};

struct Touched {
    std::uint32_t particle = 0; ///< slot
    Touch what = Touch::joined;
};

struct Journal {
    bool stale = true;       ///< everything may have changed, and particles are not listed
    bool changed = true;     ///< something has
    std::uint64_t edits = 0; ///< number of changes: a list found at the same number is that of the world
    std::vector<Touched> touched;
    std::uint32_t row_moves = 0;        ///< number of times that rows have moved
    ConstraintAdjacency adjacency;      ///< constraints of each particle, listed on demand (changes.h)
    std::shared_ptr<const char> reader; ///< identity of the solver that has read all but `touched`

    Journal() = default;
    Journal(const Journal&) {}
    Journal& operator=(const Journal&) {
        *this = Journal();
        return *this;
    }
    Journal(Journal&&) = default;
    Journal& operator=(Journal&&) = default;
    ~Journal() = default;

    void change() {
        changed = true;
        ++edits;
    }
    void change_all() {
        stale = true;
        change();
    }
    void touch(std::uint32_t particle, Touch what) {
        change();
        stale = stale || touched.size() == touched.capacity();
        if (!stale) touched.push_back({particle, what});
    }
    /// Marks all changes as read.
    void read() {
        touched.clear();
        stale = changed = false;
    }
};

} // namespace sinew
