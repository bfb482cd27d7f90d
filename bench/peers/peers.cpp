#include "bench/peers/peers.h"

namespace sinew::bench {

std::span<const Solver> peers() {
#define SINEW_CALL(name) peer::name(),
    static const std::vector<Solver> all{SINEW_PEER_LIST(SINEW_CALL)};
    return all;
}

std::span<const BodySolver> body_peers() {
    static const std::vector<BodySolver> all{SINEW_BODY_PEER_LIST(SINEW_CALL)};
#undef SINEW_CALL
    return all;
}

} // namespace sinew::bench
