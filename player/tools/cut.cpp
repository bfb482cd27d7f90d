#include "player/tool.h"

namespace sinew::play {
namespace {

std::size_t count_constraints(const AnyWorld& world) {
    return std::visit(
        [](const auto& any) {
            std::size_t count = 0;
            for_each_table(any, [&](const auto& table) { count += table.size(); });
            return count;
        },
        world);
}

/// Cuts along the path of the pointer. A whole stroke is undone at once.
class CutTool final : public Tool {
    std::string_view name() const override { return "cut"; }
    std::string_view key() const override { return "x"; }
    std::string_view about() const override { return "cuts what the pointer is drawn across"; }

    void press(Play& play) override {
        from_ = play.pointer();
        cut_ = 0;
        trail_.assign(1, cast<float>(from_));
    }

    void move(Play& play) override {
        const auto to = play.pointer();
        if (to == from_) return;
        std::size_t gone = 0;
        play.each_pane([&] { gone += slash(play, to); });
        if (cut_ == 0 && gone == 0) play.each_pane([&] { play.timeline().forget_edit(); });
        cut_ += gone;
        from_ = to;
        trail_.push_back(cast<float>(to));
        if (trail_.size() > longest_trail) trail_.erase(trail_.begin());
    }

    /// Cuts in the active pane; returns the number of constraints removed.
    std::size_t slash(Play& play, Vec2<double> to) const {
        const auto look = play.camera().look(play.session());
        const auto view = play.view();
        constexpr double depth = 1; // any depth: only the direction counts
        const Slash slash{{view.position_of(from_, depth), view.position_of(to, depth)}, look};
        const auto before = count_constraints(play.session().world());
        if (cut_ == 0)
            play.timeline().edit(slash, "cut");
        else
            play.timeline().act(slash);
        return before - count_constraints(play.session().world());
    }

    void release(Play& play) override {
        trail_.clear();
        if (cut_ == 0) return;
        play.each_pane([&] { play.timeline().finish_edit(); });
        play.tell("cut", {{"constraints", cut_}});
    }

    void draw(const Play& play, Picture& picture) const override {
        if (trail_.size() < 2) return;
        picture.add(Shape::polyline, trail_, 2.5F * float(play.density()), {0.89F, 0.20F, 0.18F, 0.9F});
    }

    static constexpr std::size_t longest_trail = 24;
    Vec2<double> from_{};
    std::vector<Vec2<float>> trail_;
    std::size_t cut_ = 0;
};

} // namespace

std::unique_ptr<Tool> tool::cut() {
    return std::make_unique<CutTool>();
}

} // namespace sinew::play
