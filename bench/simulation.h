#pragma once

#include "bench/work.h"

#include <memory>
#include <span>
#include <string_view>

/// Solvers under comparison: the engine, the textbook, and the peers if built.
namespace sinew::bench {

/// Solver effort per step.
struct Effort {
    int substeps = 10;
    int iterations = 1;
};

inline constexpr double frame = 1.0 / 60; ///< duration of a step, seconds

class Simulation {
  public:
    virtual ~Simulation() = default;
    virtual void step() = 0; ///< advances by one frame
    virtual Found position(std::size_t particle) const = 0;
};

struct Solver {
    std::string_view name;           ///< name in reports
    std::string_view about;          ///< a line of help
    bool (*takes)(const Work& work); ///< true if the solver can do the work in bearable time
    std::unique_ptr<Simulation> (*make)(const Work& work, const Effort& effort);
};

/// Solvers built with -D SINEW_PEERS=ON; otherwise empty.
std::span<const Solver> peers();

} // namespace sinew::bench
