#include "sinew/scene/text.h"

#include "player/scene_edit.h"
#include "player/tool.h"

namespace sinew::play {
namespace {

/// A line drawn by hand, as points at even distances.
class Stroke {
  public:
    void begin(const Play& play) { points_.assign(1, play.pointer()); }

    void go_on(const Play& play) {
        const double min = 14 * play.density(); // nominal pixels between points
        for (double left = distance(points_.back(), play.pointer()); left >= min && points_.size() < max;
             left = distance(points_.back(), play.pointer()))
            points_.push_back(points_.back() + (play.pointer() - points_.back()) * (min / left));
    }

    std::size_t size() const { return points_.size(); }

    /// Particles of the figure: p0, p1, ...
    json::Object particles(const Play& play, double mass) const {
        const auto view = play.view();
        const auto& scene = play.session().scene();
        const double depth = scene.dimension == 3 ? norm(scene.view.camera.eye - scene.view.camera.target) : 0;
        json::Object all;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const auto position = view.position_of(points_[i], depth);
            json::Array at;
            for (int k = 0; k < scene.dimension; ++k) at.push_back(position[k]);
            all.push_back({name(i), json::Object{{"at", std::move(at)}, {"mass", mass}}});
        }
        return all;
    }

    json::Array names() const {
        json::Array all;
        for (std::size_t i = 0; i < points_.size(); ++i) all.push_back(name(i));
        return all;
    }

    void draw(const Play& play, Picture& picture, Shape shape) const {
        std::vector<Vec2<float>> line;
        for (const auto& point : points_) line.push_back(cast<float>(point));
        line.push_back(cast<float>(play.pointer()));
        picture.add(shape, line, 3 * float(play.density()), theme_called(play.shown_theme()).palette[0]);
    }

    static std::string name(std::size_t i) { return concat("p", i); }

  private:
    static constexpr std::size_t max = 400;
    std::vector<Vec2<double>> points_;
};

json::Value link(std::size_t a, std::size_t b) {
    return json::Object{{"between", json::Array{Stroke::name(a), Stroke::name(b)}}};
}

/// Length in scene units of a number of nominal pixels.
double nominal_width(const Play& play, double pixels) {
    const auto view = play.view();
    const double depth = 1;
    return distance(view.position_of({{0, 0}}, depth).as<3, double>(),
                    view.position_of({{pixels * play.density(), 0}}, depth).as<3, double>());
}

class RopeTool final : public Tool {
    std::string_view name() const override { return "rope"; }
    std::string_view key() const override { return "d"; }
    std::string_view about() const override { return "draws a rope by hand"; }

    void press(Play& play) override { stroke_.begin(play); }
    void move(Play& play) override { stroke_.go_on(play); }

    void release(Play& play) override {
        if (stroke_.size() >= 2) play.each_pane([&] { add(play); });
    }

    void add(Play& play) const {
        json::Array links;
        for (std::size_t i = 0; i + 1 < stroke_.size(); ++i) links.push_back(link(i, i + 1));
        const auto name = free_name(play.session().scene(), "drawn_rope");
        play.add_figure({{"name", name},
                         {"particles", stroke_.particles(play, 1.0 / double(stroke_.size()))},
                         {"constraints", std::move(links)},
                         {"pieces", json::Array{json::Object{{"mark", "curve"},
                                                             {"part", "rope"},
                                                             {"through", stroke_.names()},
                                                             {"width", nominal_width(play, 6)}}}},
                         {"looks", json::Object{{"all", json::Object{{"hidden", true}}},
                                                {"rope", json::Object{{"hidden", false}}}}}},
                        name);
    }

    void draw(const Play& play, Picture& picture) const override { stroke_.draw(play, picture, Shape::polyline); }

    Stroke stroke_;
};

/// A closed form: links along the outline, links to the next but one corner, and links across.
class PolygonTool final : public Tool {
    std::string_view name() const override { return "polygon"; }
    std::string_view key() const override { return "f"; }
    std::string_view about() const override { return "draws a closed form by hand"; }

    void press(Play& play) override { stroke_.begin(play); }
    void move(Play& play) override { stroke_.go_on(play); }

    void release(Play& play) override {
        if (stroke_.size() >= 3) play.each_pane([&] { add(play); });
    }

    void add(Play& play) const {
        const auto n = stroke_.size();
        json::Array links;
        for (std::size_t i = 0; i < n; ++i) links.push_back(link(i, (i + 1) % n));
        if (n > 3)
            for (std::size_t i = 0; i < n; ++i) links.push_back(link(i, (i + 2) % n));
        for (std::size_t i = 0; i < n / 2 && n > 4; ++i) links.push_back(link(i, i + n / 2));
        const auto name = free_name(play.session().scene(), "drawn_form");
        play.add_figure(
            {{"name", name},
             {"particles", stroke_.particles(play, 1.0 / double(n))},
             {"constraints", std::move(links)},
             {"pieces", json::Array{json::Object{{"mark", "fill"}, {"part", "form"}, {"through", stroke_.names()}}}},
             {"looks",
              json::Object{{"all", json::Object{{"hidden", true}}}, {"form", json::Object{{"hidden", false}}}}}},
            name);
    }

    void draw(const Play& play, Picture& picture) const override { stroke_.draw(play, picture, Shape::loop); }

    Stroke stroke_;
};

} // namespace

std::unique_ptr<Tool> tool::rope() {
    return std::make_unique<RopeTool>();
}

std::unique_ptr<Tool> tool::polygon() {
    return std::make_unique<PolygonTool>();
}

} // namespace sinew::play
