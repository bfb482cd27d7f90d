#pragma once

#include "sinew/picture/draw.h"

#include "player/action_log.h"
#include "player/interpolator.h"
#include "player/recording.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

namespace sinew::play {

/// Timeline of a session: its actions by step, and snapshots at intervals. Any step of the last minute is restored by
/// replaying the actions since the nearest earlier snapshot.
///
/// Steps are counted from the start of the timeline and only grow: restart and undo are actions like others.
class Timeline {
  public:
    explicit Timeline(Session session);
    /// Continues from a session with a past: `log` leads to the present state.
    Timeline(Session session, ActionLog log);
    /// Continues from a session in the midst of its scene, with a future of so many steps and the actions in them, in
    /// order. An action of its own replaces the rest of it.
    Timeline(Session session, std::vector<LoggedAction> future, std::uint64_t steps);

    /// Records everything from now on; null ends it. Call before the first step.
    void record(std::shared_ptr<Recorder> recorder) { recorder_ = std::move(recorder); }
    const Recorder* recorder() const { return recorder_.get(); }
    /// True if recipe() leads to the present state: the timeline begins at the start of a scene.
    bool has_recipe() const { return has_recipe_; }

    const Session& session() const { return session_; }
    /// Goes on with other code beside the scene, which may be another one, too; the past was that of the old code.
    void change_level(std::shared_ptr<Level> level, const Scene& scene);
    void report(const SolverReports& reports) { session_.set_reports(reports); }
    /// All actions from the start of a scene to now.
    Recipe recipe() const { return log_.recipe(); }

    std::uint64_t now() const { return now_; }
    /// Number of changes of the state so far: by steps, actions and ways back.
    std::uint64_t revision() const { return revision_; }
    std::uint64_t first() const { return marks_.front().step; } ///< earliest restorable step
    std::uint64_t end() const { return end_; }                  ///< latest step reached

    /// Takes a step: replays recorded actions, or continues beyond the end.
    void step();
    /// Restores a step, clamped to [first(), end()].
    void go_to(std::uint64_t step);

    /// Draws the state interpolated from the step before the last (share 0) to the last (share 1). An empty theme means
    /// the scene's own.
    void draw(Picture& picture, OverlaySet overlay, const View& view, double share, const std::string& theme = "");

    /// Carries out an action now. Recorded actions after now are dropped.
    void act(Action action);

    /// Carries out an undoable action. Undo of a scene edit (Become) restores the scene alone; undo of any
    /// other edit, such as a cut, restores the state before the edit and drops all later actions. `goes_on` merges an
    /// edit with the preceding one of the same name, as while a slider is dragged.
    void edit(Action action, std::string name, bool goes_on = false);
    /// Moves the end of the last edit to now: redo leads here.
    void finish_edit();
    /// Drops the last edit, which changed nothing.
    void forget_edit();
    bool undo();
    bool redo();
    /// Edits between the opened scene and the current one: equal counts, equal scenes.
    std::int64_t edits() const { return edits_made_; }
    /// Names of the edits that undo and redo would apply; empty if none.
    std::string undo_name() const { return undone_ < edits_.size() ? edits_[edits_.size() - 1 - undone_].name : ""; }
    /// Reason why the last action has lost something that calls, events or tools had changed; empty if all goes on.
    const std::string& lost() const { return lost_; }
    std::string redo_name() const { return undone_ > 0 ? edits_[edits_.size() - undone_].name : ""; }

  private:
    struct Mark {
        std::uint64_t step = 0;
        Session session; ///< on arrival at the step, before its actions
        Branch at;       ///< moment of the log on arrival
    };
    struct Done {
        std::uint64_t step = 0;
        Action action;
    };
    struct Edit {
        std::string name;
        Action back, again;
    };

    void apply(const Action& action);
    Return return_here() const;
    void arrive(bool is_recorded = false);
    void mark();
    void forget_the_future();

    Session session_;
    ActionLog log_;
    Interpolator between_;
    std::uint64_t now_ = 0, end_ = 0, revision_ = 0;
    std::uint64_t spacing_ = 0; ///< steps between marks
    std::string lost_{};
    std::deque<Mark> marks_;
    std::deque<Done> done_;
    std::deque<Edit> edits_;
    std::int64_t edits_made_ = 0;
    std::size_t undone_ = 0; ///< undone edits, counted from the back of edits_
    bool has_recipe_ = true;
    std::shared_ptr<Recorder> recorder_;
};

} // namespace sinew::play
