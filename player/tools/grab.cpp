#include "player/tool.h"

namespace sinew::play {
namespace {

json::Array numbers(const Point& point) {
    json::Array items;
    for (int i = 0; i < 3; ++i) items.push_back(point[i]);
    return items;
}

/// Grabs the nearest particle or particles and drags, in 3D in the plane parallel to the picture.
class GrabTool final : public Tool {
    std::string_view name() const override { return "grab"; }
    std::string_view key() const override { return "a"; }
    std::string_view about() const override {
        return "takes hold of what is nearest, and lets it fly; while time stands, carries a whole figure elsewhere";
    }

    /// In other panes of a split view grabs the particles of the same names, at any position; without such names, the
    /// particles under the pointer.
    void press(Play& play) override {
        const auto picked = play.pick_here();
        play.select(picked);
        placed_.clear();
        last_ = play.pointer();
        holds_.assign(play.pane_count(), {});
        if (!picked) return;
        const auto& world = play.session().world();
        const auto under_pointer = play.active_pane();
        play.each_pane([&] {
            const bool other = play.active_pane() != under_pointer;
            auto own = other ? counterpart(world, *picked, play.session().world(), play.view()) : picked;
            if (own) return hold(play, *own, other);
            own = play.pick_here();
            if (own) hold(play, *own, false);
        });
        if (holds_[under_pointer].held)
            play.tell("grab", {{"particle", name_of(play.session().world(), picked->members.front())}});
    }

    void hold(Play& play, const Picked& picked, bool other) {
        auto& hold = holds_[play.active_pane()];
        play.timeline().act(Grab{rows_of(play.session().world(), picked.members), picked.position});
        hold.held = play.session().holds();
        hold.depth = picked.depth;
        if (other && play.session().hand()) hold.offset = cast<double>(picked.pixel) - play.pointer();
    }

    void move(Play& play) override {
        if (!placed_.empty() || begins_to_place(play)) return place(play);
        play.each_pane([&] {
            if (!is_held(play)) return;
            const auto& hold = holds_[play.active_pane()];
            play.timeline().act(Drag{play.view().position_of(play.pointer() + hold.offset, hold.depth)});
        });
    }

    /// A drag while time stands: the hand lets go, and the figure is carried.
    bool begins_to_place(Play& play) {
        const auto* hand = play.session().hand();
        if (!play.clock().paused() || !hand || !play.selected) return false;
        const Part part{play.figure_name(*play.selected), false};
        if (part.name.empty()) return false;
        play.each_pane([&] {
            if (is_held(play)) play.timeline().act(LetGo{});
        });
        holds_.assign(play.pane_count(), {});
        placed_ = play.is_chosen(part) ? play.chosen : std::vector{part};
        goes_on_ = false;
        return true;
    }

    /// Carries the figure with the pointer. A whole drag is one edit.
    void place(Play& play) {
        const auto middle = middle_of(play.session().scene(), play.session().world(), placed_.front());
        if (!middle) return;
        const Reshape by{.shift = play.shift_of(*middle, play.pointer() - last_)};
        last_ = play.pointer();
        if (play.reshape(placed_, by, "move " + placed_.front().name, goes_on_)) goes_on_ = true;
    }

    void release(Play& play) override {
        if (goes_on_ && !placed_.empty()) play.tell("place", {{"figure", placed_.front().name}});
        placed_.clear();
        const bool held = is_held(play);
        play.each_pane([&] {
            if (is_held(play)) play.timeline().act(LetGo{});
        });
        holds_.clear();
        if (!held) return;
        const auto at = play.selected ? position_of(play.session().world(), play.selected->members) : std::nullopt;
        play.tell("let_go", at ? json::Object{{"at", numbers(*at)}} : json::Object{});
    }

    void draw(const Play& play, Picture& picture) const override {
        const auto* hand = play.session().hand();
        const auto position = hand ? position_of(play.session().world(), hand->members) : std::nullopt;
        const auto seen = position ? play.view().see(position->as<3, double>()) : std::nullopt;
        if (!seen || !is_held(play)) return;
        const auto& theme = theme_called(play.shown_theme());
        const std::array line = {seen->pixel, cast<float>(play.pointer() + holds_[play.active_pane()].offset)};
        const auto unit = float(play.density());
        picture.add(Shape::polyline, line, 2 * unit, mix(theme.background, theme.pen, 0.6F));
        picture.add(Shape::disc, std::span(&line[1], 1), 7 * unit, theme.pen);
    }

    bool is_held(const Play& play) const {
        return play.active_pane() < holds_.size() && holds_[play.active_pane()].held;
    }

    struct Hold {
        bool held = false;
        double depth = 0;      ///< distance of the grabbed point from the camera
        Vec2<double> offset{}; ///< from the pointer to the grabbed point, pixels
    };
    std::vector<Hold> holds_;  ///< per pane
    std::vector<Part> placed_; ///< carried while time stands
    Vec2<double> last_{};      ///< pointer of the last move, pixels
    bool goes_on_ = false;     ///< the drag has become an edit
};

} // namespace

std::unique_ptr<Tool> tool::grab() {
    return std::make_unique<GrabTool>();
}

} // namespace sinew::play
