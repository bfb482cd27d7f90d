#pragma once

#include <cstddef>
#include <string>

namespace sinew {

class Session;

/// Code of a program beside a scene: adds to the worlds of the scene, and acts before each step.
class Level {
  public:
    virtual ~Level() = default;

    /// Adds to the world of a session, which is that of the scene at its start.
    virtual void build(Session& session) = 0;
    /// Acts before a step; may change the world, but takes no step.
    virtual void step(Session& session) = 0;
    /// After the step.
    virtual void stepped(Session& session) = 0;
    /// Bytes of memory that a session keeps for the code, zero at first (Session::level_memory).
    virtual std::size_t memory() const { return 0; }

    std::string problem{}; ///< failure of the code, for whoever shows the session; empty if there is none
};

} // namespace sinew
