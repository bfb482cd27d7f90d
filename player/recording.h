#pragma once

#include "sinew/session/session_snapshot.h"

#include "canvas/failure.h"
#include "player/action_log.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

/// A recording: the scene, every action at its step, and a hash of every step, appended to a file as they happen. The
/// file of a program that was killed holds all up to the last complete step.
///
/// The file begins with "SINEWREC" and a version. Frames follow, each with a checksum of itself and of all before.
namespace sinew::play {

/// Lower half of the hash of a state.
std::uint32_t short_hash(const Session& session);

/// Positions of all particles, as recorded now and then, to show a difference by.
using Positions = std::vector<Vec3<double>>;

namespace recorded {
struct Scene {
    std::string text, from; ///< `from`: file of the scene; may be empty
};                          ///< a session at the start of a scene
struct Moment {
    std::vector<std::byte> bytes;
}; ///< a session in full: an undo, or a recording that begins with a running one
struct Step {
    std::uint32_t hash = 0; ///< after the step
};
struct Act {
    Action action;
};
/// Back to a step: records of later ones no longer count.
struct Back {
    std::uint64_t step = 0;
};
struct Places {
    Positions positions;
};
} // namespace recorded

/// An entry, with its place in the file.
struct Recorded {
    std::variant<recorded::Scene, recorded::Moment, recorded::Step, recorded::Act, recorded::Back, recorded::Places>
        what;
    std::size_t at = 0;
};

/// Takes the next bytes of a recording (files.h: append_to), and keeps them whatever ends the program.
using RecordingSink = std::function<canvas::Failure(std::span<const std::byte>)>;

/// Writes a recording. After a failure nothing more is written.
class Recorder {
  public:
    /// Begins with a session at the start of its scene, or in the midst of it. `from`: file of the scene; may be empty.
    Recorder(RecordingSink sink, const Session& session, std::string from);

    /// An action that has just been carried out.
    void act(const Action& action, const Session& session);
    /// A step that has just been taken.
    void step(const Session& session);
    /// Back to an earlier step, from which other actions follow.
    void go_to(std::uint64_t step);

    const canvas::Failure& failure() const { return failure_; }
    std::uint64_t steps() const { return steps_; }

  private:
    RecordingSink sink_;
    std::string from_;
    canvas::Failure failure_;
    std::uint64_t chain_ = 0; ///< checksum of all frames so far
    std::uint64_t steps_ = 0, next_places_ = 0;

    void begin(const Session& session);
    void write(std::vector<std::byte> frame, std::size_t checksum_bytes);
    void write_places(const Session& session);
};

/// A recording that was read.
struct Recording {
    std::vector<Recorded> entries; ///< the first is a scene or a moment; undone actions are left out
    std::uint64_t steps = 0;
    /// End of the last complete entry, where the file ends within one: the program that wrote it was killed.
    std::optional<std::size_t> cut_short;
};

/// Reads a recording; nothing and an error for anything but a recording of this version, undamaged up to its end or up
/// to an entry that is not complete. Scenes of edits are opened by `open`.
std::optional<Recording> read_recording(std::span<const std::byte> bytes, const SceneOpener& open,
                                        SnapshotError& error);

/// The actions of a recording, each with the number of steps before it.
std::vector<LoggedAction> actions_of(const Recording& recording, const SceneOpener& open);

/// First difference of a replay from its recording.
struct Divergence {
    std::uint64_t step = 0;
    std::uint32_t recorded = 0, found = 0; ///< lower halves of the hashes
    /// The first particle elsewhere, in the first recorded positions from that step on.
    struct Place {
        std::uint64_t step = 0;
        Row particle = 0;
        std::string name{};
        Vec3<double> recorded{}, found{};
    };
    std::optional<Place> place{};
};

/// Plays a recording without drawing it.
class Replay {
  public:
    /// Nothing where the scene cannot be opened; the opener tells why, or `error` does.
    static std::optional<Replay> begin(Recording recording, const SceneOpener& open, SnapshotError& error);

    const Session& session() const { return session_; }
    Session& session() { return session_; }
    std::uint64_t steps() const { return taken_; }
    /// Carries out the entries before the next step, and takes it. False at the end.
    bool step();
    /// Difference found so far; its place is known once later positions were met.
    const std::optional<Divergence>& divergence() const { return divergence_; }

  private:
    Replay(Recording recording, Session session, SceneOpener open)
        : recording_(std::move(recording)), open_(std::move(open)), session_(std::move(session)) {}

    void compare(const recorded::Step& step);
    void compare(const recorded::Places& places);

    Recording recording_;
    SceneOpener open_;
    Session session_;
    std::size_t next_ = 1; ///< index of the next entry
    std::uint64_t taken_ = 0;
    std::optional<Divergence> divergence_;
};

} // namespace sinew::play
