#include "bench/simulation.h"

/// Empty list of peers, for builds without SINEW_PEERS.
namespace sinew::bench {

std::span<const Solver> peers() {
    return {};
}

} // namespace sinew::bench
