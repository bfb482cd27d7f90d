#include "player/names.h"
#include "player/scene_edit.h"
#include "player/tool.h"

#include <algorithm>

namespace sinew::play {
namespace {

constexpr double wall_width = 14, shortest_line = 8; // nominal pixels

/// Depth at which a pixel becomes a place: that of the camera's target.
double depth_of(const Play& play) {
    const auto& scene = play.session().scene();
    return scene.dimension == 3 ? norm(scene.view.camera.eye - scene.view.camera.target) : 0;
}

json::Value coordinates_of(const Play& play, const Point& point) {
    json::Array items;
    for (int i = 0; i < play.session().scene().dimension; ++i) items.push_back(point[i]);
    return items;
}

Point minus(const Point& a, const Point& b) {
    Point difference;
    for (int i = 0; i < 3; ++i) difference[i] = a[i] - b[i];
    return difference;
}

/// Adds an obstacle to the scene of each pane.
void put(Play& play, const char* stem, json::Object shape) {
    const auto name = free_obstacle(play.session().scene(), stem);
    json::Object obstacle{{"name", name}};
    for (auto& member : shape) obstacle.push_back(std::move(member));
    if (play.add("colliders", std::move(obstacle), name)) play.tell("add", {{"obstacle", name}});
}

/// A straight wall, round at its ends, from where it is pressed to where it is let go.
class WallTool final : public Tool {
    std::string_view name() const override { return "wall"; }
    std::string_view key() const override { return "k"; }
    std::string_view about() const override { return "draws a wall from where it is pressed to where it is let go"; }

    void press(Play& play) override { from_ = play.pointer(); }

    void release(Play& play) override {
        if (distance(from_, play.pointer()) < shortest_line * play.density()) return;
        play.each_pane([&] { add(play); });
    }

    void add(Play& play) const {
        const auto view = play.view();
        const double depth = depth_of(play), half = wall_width * play.density() / 2;
        const auto a = view.position_of(from_, depth), b = view.position_of(play.pointer(), depth);
        const auto side = view.position_of(from_ + Vec2<double>{{half, 0}}, depth);
        Point middle;
        for (int i = 0; i < 3; ++i) middle[i] = (a[i] + b[i]) / 2;
        put(play, "wall",
            {{"shape", "capsule"},
             {"at", coordinates_of(play, middle)},
             {"from", coordinates_of(play, minus(a, middle))},
             {"to", coordinates_of(play, minus(b, middle))},
             {"radius", norm(minus(side, a).as<3, double>())}});
    }

    void draw(const Play& play, Picture& picture) const override {
        const std::array line = {cast<float>(from_), cast<float>(play.pointer())};
        picture.add(Shape::polyline, line, float(wall_width * play.density()), theme_called(play.shown_theme()).wall);
    }

    Vec2<double> from_{};
};

/// Ground drawn by hand: solid below the line.
class TerrainTool final : public Tool {
    std::string_view name() const override { return "terrain"; }
    std::string_view key() const override { return "z"; }
    std::string_view about() const override { return "draws ground by hand, solid below (2D)"; }

    void press(Play& play) override { line_.assign(1, play.pointer()); }

    void move(Play& play) override {
        constexpr std::size_t max = 500;
        if (distance(line_.back(), play.pointer()) >= shortest_line * play.density() && line_.size() < max)
            line_.push_back(play.pointer());
    }

    void release(Play& play) override {
        if (play.session().scene().dimension == 3)
            return void(play.message = "ground is drawn in the plane; in space, draw walls");
        if (line_.size() < 2) return;
        if (line_.front()[0] > line_.back()[0]) std::ranges::reverse(line_); // the free side is above
        play.each_pane([&] { add(play); });
    }

    void add(Play& play) const {
        const auto view = play.view();
        const auto at = view.position_of(line_.front(), 0);
        json::Array points;
        for (const auto& pixel : line_) points.push_back(coordinates_of(play, minus(view.position_of(pixel, 0), at)));
        put(play, "ground", {{"shape", "chain"}, {"at", coordinates_of(play, at)}, {"points", std::move(points)}});
    }

    void draw(const Play& play, Picture& picture) const override {
        std::vector<Vec2<float>> line;
        for (const auto& point : line_) line.push_back(cast<float>(point));
        line.push_back(cast<float>(play.pointer()));
        picture.add(Shape::polyline, line, 4 * float(play.density()), theme_called(play.shown_theme()).wall);
    }

    std::vector<Vec2<double>> line_;
};

} // namespace

std::unique_ptr<Tool> tool::wall() {
    return std::make_unique<WallTool>();
}

std::unique_ptr<Tool> tool::terrain() {
    return std::make_unique<TerrainTool>();
}

} // namespace sinew::play
