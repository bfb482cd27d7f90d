#include "bench/bodies.h"
#include "bench/simulation.h"

/// Empty lists of peers, for builds without SINEW_PEERS.
namespace sinew::bench {

std::span<const Solver> peers() {
    return {};
}

std::span<const BodySolver> body_peers() {
    return {};
}

} // namespace sinew::bench
