#pragma once

#include "bench/work.h"

#include <memory>
#include <span>
#include <string_view>

/// Whoever can do the work: the engine, the textbook, and the peers where they are built.
namespace sinew::bench {

/// How hard it tries in a step.
struct Effort {
    int substeps = 10;
    int iterations = 1;
};

inline constexpr double frame = 1.0 / 60; ///< seconds a step lasts

class Simulation {
  public:
    virtual ~Simulation() = default;
    virtual void step() = 0; ///< a frame
    virtual Found place(std::size_t particle) const = 0;
};

struct Solver {
    std::string_view name;           ///< as reports call it
    std::string_view about;          ///< one line
    bool (*takes)(const Work& work); ///< whether it can do this work at all, in a bearable time
    std::unique_ptr<Simulation> (*make)(const Work& work, const Effort& effort);
};

/// What was built with -D SINEW_PEERS=ON; else nothing.
std::span<const Solver> peers();

} // namespace sinew::bench
