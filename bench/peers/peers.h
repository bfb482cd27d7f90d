#pragma once

#include "bench/bodies.h"
#include "bench/simulation.h"

/// Other engines, from Debian's packages, on the same work. Built with -D SINEW_PEERS=ON.
namespace sinew::bench {

/// List of peers. A new peer takes one new file here and one word.
#define SINEW_PEER_LIST(X) X(bullet) X(box2d) X(box2d_rope) X(chipmunk)

/// List of peers of contact. A new one takes one new file here and one word.
#define SINEW_BODY_PEER_LIST(X) X(chipmunk_bodies) X(bullet_bodies) X(box2d_bodies)

namespace peer {
#define SINEW_DECLARE(name) Solver name();
SINEW_PEER_LIST(SINEW_DECLARE)
#undef SINEW_DECLARE
#define SINEW_DECLARE(name) BodySolver name();
SINEW_BODY_PEER_LIST(SINEW_DECLARE)
#undef SINEW_DECLARE
/// A solver whose simulations are of one class.
template <class Simulation> BodySolver body_solver(std::string_view name) {
    return {name, [](const ContactWork& work, const Bodies& bodies, int substeps) -> std::unique_ptr<BodySimulation> {
                return std::make_unique<Simulation>(work, bodies, substeps);
            }};
}
} // namespace peer

} // namespace sinew::bench
