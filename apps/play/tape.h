#pragma once

#include "apps/play/action_log.h"
#include "apps/play/between.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

namespace sinew::play {

/// A session and its past: what was done to it at which step, and what it was every now and then. Any step of the last
/// minute can be gone to, by doing again what was done since the snapshot before it.
///
/// Steps are counted from where the tape begins and only grow: a restart or an undo is one more thing that was done.
class Tape {
  public:
    explicit Tape(Session session);
    /// Goes on from a session that has a past: `log` leads to it.
    Tape(Session session, ActionLog log);

    const Session& session() const { return session_; }
    /// All that led from the start of a scene to now.
    Recipe recipe() const { return log_.recipe(); }

    std::uint64_t now() const { return now_; }
    std::uint64_t first() const { return marks_.front().step; } ///< that can be gone to
    std::uint64_t end() const { return end_; }                  ///< last one that was reached

    /// Steps on: as it was recorded, or beyond that.
    void step();
    /// Held between first() and end().
    void go_to(std::uint64_t step);

    /// The picture of a moment between the last step but one (share 0) and the last (1). An empty theme is the scene's.
    void draw(Picture& picture, OverlaySet overlay, const View& view, double share, const std::string& theme = "");

    /// Does something now. What was recorded after now did not happen then.
    void act(Deed deed);

    /// An act that can be undone. An edit of the scene is undone by itself; of anything else (a cut), all that came
    /// after it is undone too.
    /// One that goes on with the last (a slider on its way) is undone together with it.
    void edit(Deed deed, std::string name, bool goes_on = false);
    /// The last edit ends only now: to do it again leads here.
    void finish_edit();
    /// The last edit changed nothing.
    void forget_edit();
    bool undo();
    bool redo();
    /// How many edits lead from the scene as it was opened to this one: the same number, the same scene.
    std::int64_t edits() const { return edits_made_; }
    /// What undo and redo would do; empty where there is nothing.
    std::string undo_name() const { return undone_ < edits_.size() ? edits_[edits_.size() - 1 - undone_].name : ""; }
    std::string redo_name() const { return undone_ > 0 ? edits_[edits_.size() - undone_].name : ""; }

  private:
    struct Mark {
        std::uint64_t step = 0;
        Session session; ///< on arrival, before what was done there
        Branch at;       ///< of the log, then
    };
    struct Done {
        std::uint64_t step = 0;
        Deed deed;
    };
    struct Edit {
        std::string name;
        Deed back, again;
    };

    void apply(const Deed& deed);
    Return return_here() const;
    void arrive();
    void mark();
    void forget_the_future();

    Session session_;
    ActionLog log_;
    Between between_;
    std::uint64_t now_ = 0, end_ = 0;
    std::uint64_t spacing_ = 0; ///< steps between marks
    std::deque<Mark> marks_;
    std::deque<Done> done_;
    std::deque<Edit> edits_;
    std::int64_t edits_made_ = 0;
    std::size_t undone_ = 0; ///< of edits_, from the back
};

} // namespace sinew::play
