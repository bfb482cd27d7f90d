#include "sinew/math/trig.h"
#include "sinew/scene/check.h"

#include "player/names.h"
#include "player/obstacle_pick.h"
#include "player/tool.h"

#include <algorithm>

namespace sinew::play {
namespace {

constexpr double margin = 10, handle = 7, stalk = 26; // nominal pixels

/// A box of the picture, pixels.
struct PixelBox {
    Vec2<double> low{{1e9, 1e9}}, high{{-1e9, -1e9}};

    void add(Vec2<double> point) {
        for (int i = 0; i < 2; ++i) low[i] = std::min(low[i], point[i]), high[i] = std::max(high[i], point[i]);
    }
    bool is_empty() const { return high[0] < low[0]; }
    bool has(Vec2<double> p) const { return p[0] >= low[0] && p[1] >= low[1] && p[0] <= high[0] && p[1] <= high[1]; }
    bool has(const PixelBox& other) const { return !other.is_empty() && has(other.low) && has(other.high); }
    Vec2<double> middle() const { return (low + high) * 0.5; }
    std::array<Vec2<float>, 4> corners() const {
        const auto a = cast<float>(low), b = cast<float>(high);
        return {{a, {{b[0], a[1]}}, b, {{a[0], b[1]}}}};
    }
};

PixelBox box_of(const Play& play, const Part& part) {
    PixelBox box;
    const auto view = play.view();
    const auto add = [&](const Vec3<double>& position) {
        if (const auto seen = view.see(position)) box.add(cast<double>(seen->pixel));
    };
    const auto& scene = play.session().scene();
    if (part.is_obstacle) {
        const auto number = obstacle_called(scene, part.name);
        if (!number) return box;
        for (const auto& corner : outline_of(scene.colliders[*number], scene.units.up == "-y" ? -1 : 1))
            add({{corner[0], corner[1], 0}});
        return box;
    }
    std::visit(
        [&](const auto& world) {
            const auto known = find_figure(world, part.name);
            if (!known) return;
            for (const auto id : world.figures[*known].particles)
                if (const auto at = position_of(world, id)) {
                    Vec3<double> wide{};
                    for (int i = 0; i < world.dimension; ++i) wide[i] = double((*at)[i]);
                    add(wide);
                }
        },
        play.session().world());
    return box;
}

std::vector<Part> parts_of(const Scene& scene) {
    std::vector<Part> all;
    for (const auto& figure : scene.figures) all.push_back({std::string(sinew::name_of(figure)), false});
    for (std::size_t i = 0; i < scene.colliders.size(); ++i) all.push_back({obstacle_name(scene, i), true});
    return all;
}

/// Chooses figures and obstacles, and moves, turns and scales the chosen ones by the frame around them.
class SelectTool final : public Tool {
    std::string_view name() const override { return "select"; }
    std::string_view key() const override { return "q"; }
    std::string_view about() const override {
        return "chooses what is pressed, with shift more; drag to move, the ring turns, the square scales";
    }

    void press(Play& play) override {
        from_ = last_ = play.pointer();
        moved_ = false;
        const auto frame = frame_of(play);
        const double near = 2 * handle * play.density();
        if (!frame.is_empty() && distance(ring_of(frame, play), from_) < near)
            deed_ = Deed::turn;
        else if (!frame.is_empty() && distance(frame.high, from_) < near)
            deed_ = Deed::scale;
        else if (const auto part = play.part_here())
            take(play, *part);
        else
            deed_ = Deed::frame;
        middle_ = frame.middle();
    }

    void take(Play& play, const Part& part) {
        if (play.shift_held || !play.is_chosen(part)) play.choose(part, play.shift_held);
        deed_ = play.is_chosen(part) ? Deed::move : Deed::nothing;
    }

    void move(Play& play) override {
        const auto to = play.pointer();
        Reshape by;
        if (deed_ == Deed::move) {
            const auto middle =
                middle_of(play.session().scene(), play.session().world(), play.chosen.front()).value_or(Point{});
            by.shift = play.shift_of(middle, to - last_);
            reshape(play, by, "move");
        } else if (deed_ == Deed::turn) {
            const auto a = last_ - middle_, b = to - middle_;
            const double up = play.session().scene().units.up == "-y" ? -1 : 1;
            by.turn = -up * arctangent(cross(a, b), dot(a, b)); // pixels count downwards
            reshape(play, by, "turn");
        } else if (deed_ == Deed::scale) {
            const double before = norm(last_ - middle_), after = norm(to - middle_);
            constexpr double close = 4; // pixels
            if (before < close || after < close) return;
            by.scale = after / before;
            reshape(play, by, "scale");
        }
        last_ = to;
    }

    /// A whole drag is one edit.
    void reshape(Play& play, const Reshape& by, const char* what) {
        if (play.reshape(play.chosen, by, what, moved_)) moved_ = true;
    }

    void release(Play& play) override {
        if (deed_ == Deed::frame) choose_in_frame(play);
        if (moved_)
            play.tell("reshape", {{"how", deed_ == Deed::move ? "move" : deed_ == Deed::turn ? "turn" : "scale"}});
        deed_ = Deed::nothing;
    }

    void choose_in_frame(Play& play) const {
        PixelBox frame;
        frame.add(from_), frame.add(play.pointer());
        if (!play.shift_held) play.choose({}, false);
        for (const auto& part : parts_of(play.session().scene()))
            if (!play.is_chosen(part) && frame.has(box_of(play, part))) play.choose(part, true);
    }

    void draw(const Play& play, Picture& picture) const override {
        if (deed_ != Deed::frame) return;
        PixelBox frame;
        frame.add(from_), frame.add(play.pointer());
        picture.add(Shape::loop, frame.corners(), 1.5F * float(play.density()), theme_called(play.shown_theme()).pen);
    }

    static PixelBox frame_of(const Play& play) {
        PixelBox all;
        for (const auto& part : play.chosen)
            if (const auto box = box_of(play, part); !box.is_empty()) all.add(box.low), all.add(box.high);
        const double wide = margin * play.density();
        if (all.is_empty()) return all;
        all.low -= Vec2<double>{{wide, wide}}, all.high += Vec2<double>{{wide, wide}};
        return all;
    }

    static Vec2<double> ring_of(const PixelBox& frame, const Play& play) {
        return {{frame.middle()[0], frame.low[1] - stalk * play.density()}};
    }

    void draw_idle(const Play& play, Picture& picture) const override {
        const auto frame = frame_of(play);
        if (frame.is_empty()) return;
        const auto& theme = theme_called(play.shown_theme());
        const auto unit = float(play.density());
        const auto& color = theme.palette[0];
        for (const auto& part : play.chosen)
            if (auto box = box_of(play, part); !box.is_empty())
                picture.add(Shape::loop, box.corners(), unit, mix(color, theme.background, 0.5F));
        picture.add(Shape::loop, frame.corners(), 2 * unit, color);
        const auto ring = cast<float>(ring_of(frame, play));
        const std::array line = {Vec2<float>{{ring[0], float(frame.low[1])}}, ring};
        picture.add(Shape::polyline, line, 2 * unit, color);
        for (const auto& [size, shade] : {std::pair{2 * handle, color}, {2 * handle - 5, theme.background}})
            picture.add(Shape::disc, std::span(&ring, 1), float(size) * unit, shade);
        PixelBox square;
        for (const double side : {-1.0, 1.0})
            square.add(frame.high + Vec2<double>{{side, side}} * (handle * play.density()));
        picture.add(Shape::polygon, square.corners(), 0, color);
    }

    enum class Deed { nothing, move, turn, scale, frame };
    Deed deed_ = Deed::nothing;
    Vec2<double> from_{}, last_{}, middle_{};
    bool moved_ = false;
};

} // namespace

std::unique_ptr<Tool> tool::select() {
    return std::make_unique<SelectTool>();
}

} // namespace sinew::play
