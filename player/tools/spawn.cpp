#include "player/scene_edit.h"
#include "player/tool.h"

namespace sinew::play {
namespace {

/// Adds a figure at a point.
void put(Play& play, const std::string& prefab, json::Object parameters, const Point& at) {
    const auto& scene = play.session().scene();
    const auto name = free_name(scene, prefab);
    json::Array position;
    for (int i = 0; i < scene.dimension; ++i) position.push_back(at[i]);
    json::Object figure{{"prefab", prefab}, {"name", name}, {"at", std::move(position)}};
    for (auto& parameter : parameters) figure.push_back(std::move(parameter));
    play.add_figure(std::move(figure), name);
}

double depth_of_middle(const Play& play) {
    const auto& scene = play.session().scene();
    return scene.dimension == 3 ? norm(scene.view.camera.eye - scene.view.camera.target) : 0;
}

class SpawnTool final : public Tool {
    std::string_view name() const override { return "spawn"; }
    std::string_view key() const override { return "i"; }
    std::string_view about() const override { return "puts the chosen prefab where it is pressed"; }

    void press(Play& play) override {
        play.each_pane([&] {
            put(play, play.prefab, play.prefab_parameters,
                play.view().position_of(play.pointer(), depth_of_middle(play)));
        });
    }
};

/// A cloth of the size of the drawn rectangle.
class ClothTool final : public Tool {
    std::string_view name() const override { return "cloth"; }
    std::string_view key() const override { return "l"; }
    std::string_view about() const override { return "draws a cloth from corner to corner"; }

    void press(Play& play) override { from_ = play.pointer(); }

    void release(Play& play) override {
        play.each_pane([&] { add(play); });
    }

    void add(Play& play) const {
        constexpr double cell = 14; // nominal pixels
        constexpr int max = 60;
        const auto view = play.view();
        const double depth = depth_of_middle(play);
        const auto a = from_, b = play.pointer();
        const auto width = std::abs(b[0] - a[0]), height = std::abs(b[1] - a[1]);
        const double pixels = std::max({cell * play.density(), width / max, height / max});
        const int columns = int(width / pixels) + 1, rows = int(height / pixels) + 1;
        if (columns < 2 || rows < 2) return;
        const double spacing = distance(view.position_of({{0, 0}}, depth).as<3, double>(),
                                        view.position_of({{pixels, 0}}, depth).as<3, double>());
        const Vec2<double> middle{{(a[0] + b[0]) / 2, std::min(a[1], b[1])}};
        put(play, "cloth", {{"columns", columns}, {"rows", rows}, {"spacing", spacing}, {"drawn", "both"}},
            view.position_of(middle, depth));
    }

    void draw(const Play& play, Picture& picture) const override {
        const auto a = cast<float>(from_), b = cast<float>(play.pointer());
        const std::array<Vec2<float>, 4> corners = {{a, {{b[0], a[1]}}, b, {{a[0], b[1]}}}};
        picture.add(Shape::loop, corners, 2 * float(play.density()), theme_called(play.shown_theme()).palette[0]);
    }

    Vec2<double> from_{};
};

} // namespace

std::unique_ptr<Tool> tool::spawn() {
    return std::make_unique<SpawnTool>();
}

std::unique_ptr<Tool> tool::cloth() {
    return std::make_unique<ClothTool>();
}

} // namespace sinew::play
