#include "apps/play/tool.h"

namespace sinew::play {
namespace {

json::Array numbers(const Point& point) {
    json::Array items;
    for (int i = 0; i < 3; ++i) items.push_back(point[i]);
    return items;
}

/// Takes hold of what is nearest and carries it, in 3D in the plane across the view.
class GrabTool final : public Tool {
    std::string_view name() const override { return "grab"; }
    std::string_view key() const override { return "a"; }
    std::string_view about() const override { return "takes hold of what is nearest; let go to throw it"; }

    void press(Play& play) override {
        const auto picked = play.pick_here();
        play.select(picked);
        if (!picked) return;
        depth_ = picked->depth;
        play.tape().act(Grab{rows_of(play.session().world(), picked->members), picked->place});
        held_ = play.session().holds();
        if (held_) play.tell("grab", {{"particle", name_of(play.session().world(), picked->members.front())}});
    }

    void move(Play& play) override {
        if (held_) play.tape().act(Drag{play.view().place_of(play.pointer(), depth_)});
    }

    void release(Play& play) override {
        if (!held_) return;
        held_ = false;
        play.tape().act(LetGo{});
        const auto at = play.selected ? place_of(play.session().world(), play.selected->members) : std::nullopt;
        play.tell("let_go", at ? json::Object{{"at", numbers(*at)}} : json::Object{});
    }

    void draw(const Play& play, Picture& picture) const override {
        const auto* hand = play.session().hand();
        const auto place = hand ? place_of(play.session().world(), hand->members) : std::nullopt;
        const auto seen = place ? play.view().see(place->as<3, double>()) : std::nullopt;
        if (!seen) return;
        const auto& theme = theme_called(play.session().scene().view.theme);
        const std::array line = {seen->pixel, cast<float>(play.pointer())};
        const auto unit = float(play.density());
        picture.add(Shape::polyline, line, 2 * unit, mix(theme.background, theme.pen, 0.6F));
        picture.add(Shape::disc, std::span(&line[1], 1), 7 * unit, theme.pen);
    }

    double depth_ = 0;
    bool held_ = false;
};

} // namespace

std::unique_ptr<Tool> tool::grab() {
    return std::make_unique<GrabTool>();
}

} // namespace sinew::play
