#include "player/timeline.h"

#include "sinew/picture/draw.h"

#include <algorithm>
#include <utility>

namespace sinew::play {
namespace {

constexpr double remembered = 60;          // seconds of restorable past
constexpr double between_marks = 0.25;     // seconds between snapshots, doubled when `memory` is used up
constexpr std::size_t memory = 256u << 20; // bytes of all snapshots, estimated; beyond, half are dropped
constexpr std::size_t max_edits = 64;

/// Estimated bytes of a copied session, and of each of its parts.
constexpr std::size_t empty = 50'000, a_particle = 200, a_constraint = 100, a_piece = 150;

std::size_t bytes_of(const Session& session) {
    return std::visit(
        [](const auto& world) {
            std::size_t bytes = empty + world.particles.size() * a_particle;
            for_each_table(world, [&](const auto& table) { bytes += a_constraint * table.size(); });
            for (const auto& figure : world.figures) bytes += figure.pieces.size() * a_piece;
            return bytes;
        },
        session.world());
}

std::uint64_t steps_in(double seconds, const Session& session) {
    return std::max<std::uint64_t>(std::uint64_t(seconds * session.scene().solver.rate), 1);
}

/// A new position replaces an earlier one at the same step.
template <class Moved, class Dones> bool replace_last(Dones& done, std::uint64_t step, Action& action) {
    if (!std::holds_alternative<Moved>(action) || done.empty()) return false;
    auto& last = done.back();
    if (last.step != step || !std::holds_alternative<Moved>(last.action)) return false;
    last.action = std::move(action);
    return true;
}

/// True if the state jumps, so that positions before and after must not be interpolated.
bool leaps(const Action& action) {
    return std::holds_alternative<Become>(action) || std::holds_alternative<Return>(action) ||
           std::holds_alternative<Restart>(action);
}

} // namespace

Timeline::Timeline(Session session)
    : session_(std::move(session)), log_(session_), spacing_(steps_in(between_marks, session_)),
      has_recipe_(!session_.level()) {
    mark();
}

Timeline::Timeline(Session session, ActionLog log)
    : session_(std::move(session)), log_(std::move(log)), spacing_(steps_in(between_marks, session_)) {
    mark();
}

Timeline::Timeline(Session session, std::vector<LoggedAction> future, std::uint64_t steps)
    : session_(std::move(session)), log_(session_), end_(steps), spacing_(steps_in(between_marks, session_)),
      has_recipe_(false) {
    mark();
    for (auto& logged : future) done_.push_back({logged.step, std::move(logged.action)});
    arrive();
}

void Timeline::step() {
    ++revision_;
    between_.remember(session_.world());
    session_.step();
    log_.step();
    ++now_;
    end_ = std::max(end_, now_);
    const bool is_recorded = recorder_ && now_ > recorder_->steps();
    if (is_recorded) recorder_->step(session_);
    if (now_ >= marks_.back().step + spacing_) mark();
    arrive(is_recorded);
}

void Timeline::apply(const Action& action) {
    ++revision_;
    lost_ = carry_out(action, session_);
    log_.note(action, session_);
    if (leaps(action)) between_.forget();
}

/// Steps of the past would be taken by other code: the timeline begins anew, and so do the edits.
void Timeline::change_level(std::shared_ptr<Level> level, const Scene& scene) {
    session_.become(scene, std::move(level));
    *this = Timeline(std::move(session_));
    has_recipe_ = false;
}

Return Timeline::return_here() const {
    return {std::make_shared<const Session>(session_), log_.now()};
}

/// Carries out the actions known for this step. `is_recorded`: for the first time, and to be recorded.
void Timeline::arrive(bool is_recorded) {
    const auto here = std::lower_bound(done_.begin(), done_.end(), now_,
                                       [](const Done& done, std::uint64_t step) { return done.step < step; });
    for (auto done = here; done != done_.end() && done->step == now_; ++done) {
        apply(done->action);
        if (is_recorded) recorder_->act(done->action, session_);
    }
}

void Timeline::go_to(std::uint64_t step) {
    step = std::clamp(step, first(), end());
    if (step >= now_ && step < now_ + spacing_) {
        while (now_ < step) this->step();
        return;
    }
    const auto after = std::upper_bound(marks_.begin(), marks_.end(), step,
                                        [](std::uint64_t at, const Mark& mark) { return at < mark.step; });
    const auto& mark = *std::prev(after);
    ++revision_;
    between_.forget();
    session_ = mark.session;
    log_.go_to(mark.at);
    now_ = mark.step;
    arrive();
    while (now_ < step) this->step();
}

void Timeline::draw(Picture& picture, OverlaySet overlay, const View& view, double share, const std::string& theme) {
    const auto own = session_.scene().view.theme;
    if (!theme.empty()) session_.set_theme(theme);
    between_.show(session_.world(), share, [&] { sinew::draw(session_, view, picture, overlay); });
    session_.set_theme(own);
}

void Timeline::act(Action action) {
    forget_the_future();
    apply(action);
    if (recorder_) recorder_->act(action, session_);
    if (!replace_last<Drag>(done_, now_, action) && !replace_last<PointAt>(done_, now_, action))
        done_.push_back({now_, std::move(action)});
}

void Timeline::forget_the_future() {
    while (!done_.empty() && done_.back().step > now_) done_.pop_back();
    while (marks_.size() > 1 && marks_.back().step > now_) marks_.pop_back();
    end_ = now_;
    if (recorder_) recorder_->go_to(now_);
}

/// Adds a snapshot; drops snapshots older than `remembered`, with the actions before the first one left.
void Timeline::mark() {
    marks_.push_back({now_, session_, log_.now()});
    const auto kept = steps_in(remembered, session_);
    while (marks_.size() > 1 && marks_[1].step + kept <= now_) marks_.pop_front();
    while (!done_.empty() && done_.front().step < marks_.front().step) done_.pop_front();
    const auto max = std::max<std::size_t>(memory / bytes_of(session_), 4);
    if (marks_.size() <= max) return;
    spacing_ *= 2;
    std::deque<Mark> every_second;
    for (std::size_t i = 0; i < marks_.size(); i += 2) every_second.push_back(std::move(marks_[i]));
    marks_ = std::move(every_second);
}

void Timeline::edit(Action action, std::string name, bool goes_on) {
    if (goes_on && undone_ == 0 && !edits_.empty() && edits_.back().name == name) {
        auto& last = edits_.back();
        last.again = action;
        act(std::move(action));
        if (!std::holds_alternative<Become>(last.again)) finish_edit();
        return;
    }
    while (undone_ > 0) edits_.pop_back(), --undone_;
    ++edits_made_;
    Edit edit{std::move(name), Return{}, action};
    if (std::holds_alternative<Become>(action))
        edit.back = Become{std::make_shared<const Scene>(session_.scene())};
    else
        edit.back = return_here();
    act(std::move(action));
    if (!std::holds_alternative<Become>(edit.again)) edit.again = return_here();
    edits_.push_back(std::move(edit));
    if (edits_.size() > max_edits) edits_.pop_front();
}

void Timeline::finish_edit() {
    if (!edits_.empty()) edits_.back().again = return_here();
}

void Timeline::forget_edit() {
    if (edits_.empty()) return;
    edits_.pop_back();
    --edits_made_;
}

bool Timeline::undo() {
    if (undone_ == edits_.size()) return false;
    --edits_made_;
    act(edits_[edits_.size() - 1 - undone_++].back);
    return true;
}

bool Timeline::redo() {
    if (undone_ == 0) return false;
    ++edits_made_;
    act(edits_[edits_.size() - undone_--].again);
    return true;
}

} // namespace sinew::play
