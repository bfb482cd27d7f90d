#include "bench/simulation.h"

namespace sinew::bench {

std::span<const Solver> peers() {
    return {};
}

} // namespace sinew::bench
