#include "sinew/math/format.h"

#include "player/tool.h"

namespace sinew::play {
namespace {

class MeasureTool final : public Tool {
    std::string_view name() const override { return "measure"; }
    std::string_view key() const override { return "m"; }
    std::string_view about() const override { return "measures from where it is pressed to where it is let go"; }

    void press(Play& play) override { from_ = play.pointer(); }
    void release(Play& play) override {
        const double length = measured(play);
        play.message = text_of(play, length);
        play.tell("measure", {{"length", length}});
    }

    void draw(const Play& play, Picture& picture) const override {
        const auto& theme = theme_called(play.shown_theme());
        const auto unit = float(play.density());
        const std::array line = {cast<float>(from_), cast<float>(play.pointer())};
        picture.add(Shape::polyline, line, 2 * unit, theme.pen);
        for (const auto& end : line) picture.add(Shape::disc, std::span(&end, 1), 8 * unit, theme.pen);
        picture.add_text(text_of(play, measured(play)), (line[0] + line[1]) * 0.5F - Vec2<float>{{0, 16 * unit}},
                         15 * unit, theme.pen);
    }

    double measured(const Play& play) const {
        const auto view = play.view();
        const auto& session = play.session();
        const auto& camera = session.scene().view.camera;
        const double depth = session.scene().dimension == 3 ? norm(camera.eye - camera.target) : 0;
        const auto a = view.position_of(from_, depth), b = view.position_of(play.pointer(), depth);
        return distance(a.as<3, double>(), b.as<3, double>());
    }

    static std::string text_of(const Play& play, double length) {
        return format_text("{:4} {}", length, play.session().scene().units.length);
    }

    Vec2<double> from_{};
};

} // namespace

std::unique_ptr<Tool> tool::measure() {
    return std::make_unique<MeasureTool>();
}

} // namespace sinew::play
