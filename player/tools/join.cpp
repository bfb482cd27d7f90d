#include "sinew/math/trig.h"
#include "sinew/world/edit.h"

#include "player/joints.h"
#include "player/scene_edit.h"
#include "player/tool.h"

#include <algorithm>

namespace sinew::play {
namespace {

/// One end of a joint: particles of a figure, the one that was pressed first, or none on the background.
struct End {
    std::vector<std::string> names;
    std::vector<Point> positions;
    double mass = 0; ///< of the figure
    Point at{};
};

/// The named particles of a figure by their distance from the first.
End end_of(const Play& play, const Picked& picked) {
    constexpr std::size_t most = 3;
    End end;
    std::visit(
        [&]<class WorldT>(const WorldT& world) {
            const auto own = row_of(world, picked.members.front());
            if (!own || picked.figure >= world.figures.size()) return;
            const auto& p = world.particles;
            std::vector<std::pair<double, ParticleId>> near;
            for (const auto id : world.figures[picked.figure].particles)
                if (const auto row = row_of(world, id)) {
                    near.emplace_back(double(distance(p.position[*row], p.position[*own])), id);
                    end.mass += double(inverse_or_zero(p.inverse_mass[*row]));
                }
            std::ranges::stable_sort(near, {}, [](const auto& one) { return one.first; });
            for (const auto& [away, id] : near) {
                auto name = name_of(play.session().world(), id);
                if (name.find('/') == std::string::npos || end.names.size() >= most) continue;
                end.names.push_back(std::move(name));
                end.positions.push_back(*position_of(play.session().world(), {&id, 1}));
            }
        },
        play.session().world());
    if (!end.positions.empty()) end.at = end.positions.front();
    return end;
}

double length_of(const Point& a, const Point& b) {
    return distance(a.as<3, double>(), b.as<3, double>());
}

json::Value coordinates(const Point& point, int dimension) {
    json::Array items;
    for (int i = 0; i < dimension; ++i) items.push_back(point[i]);
    return items;
}

/// The hand-made figure of a joint: constraints, and pinned particles where an end is on the background.
class JointMaker {
  public:
    JointMaker(const Play& play, End from, End to) : play_(play), a_(std::move(from)), b_(std::move(to)) {
        if (b_.names.empty()) anchor();
    }

    json::Object made(const std::string& kind, const std::string& name) {
        if (kind == "weld")
            weld();
        else if (kind == "spring")
            spring();
        else if (kind == "winch")
            winch();
        else
            hinge();
        if (kind == "motor") motor();
        json::Object figure{{"name", name}};
        if (!anchors_.empty()) figure.push_back({"particles", std::move(anchors_)});
        figure.push_back({"constraints", std::move(constraints_)});
        return figure;
    }

  private:
    const Play& play_;
    End a_, b_;
    json::Object anchors_;
    json::Array constraints_;

    const Scene& scene() const { return play_.session().scene(); }

    void anchor() {
        const double beside = std::max(length_of(a_.at, b_.at), 20 / std::max(play_.view().scale(), 1e-9));
        for (const auto& [name, x, y] : {std::tuple{"anchor", 0.0, 0.0}, {"beside", 1.0, 0.0}, {"above", 0.0, 1.0}}) {
            auto at = b_.at;
            at[0] += x * beside, at[1] += y * beside;
            anchors_.push_back({name, json::Object{{"at", coordinates(at, scene().dimension)}, {"pinned", true}}});
            b_.names.push_back(name);
            b_.positions.push_back(at);
        }
    }

    json::Object& link(std::size_t i, std::size_t k, const char* called) {
        constraints_.push_back(json::Object{{"name", called}, {"between", json::Array{a_.names[i], b_.names[k]}}});
        return *constraints_.back().as<json::Object>();
    }
    double length(std::size_t i, std::size_t k) const { return length_of(a_.positions[i], b_.positions[k]); }

    /// Ends that lie on each other become one place; else a rod keeps them apart.
    void hinge() {
        const double seen = length(0, 0) * play_.view().scale();
        const bool is_one = seen <= pick_radius * play_.density() || is_in_space();
        link(0, 0, "hinge").push_back({"rest", is_one ? 0.0 : length(0, 0)});
    }
    bool is_in_space() const { return scene().dimension == 3 && length(0, 0) == 0; }

    /// Links of each with each; the one between the ends is drawn.
    void weld() {
        for (std::size_t i = 0; i < a_.names.size(); ++i)
            for (std::size_t k = 0; k < b_.names.size(); ++k) {
                if (length(i, k) == 0) continue;
                auto& weld = link(i, k, "weld");
                weld.push_back({"rest", length(i, k)});
                if (i + k > 0) weld.push_back({"hidden", true});
            }
        if (length(0, 0) == 0) link(0, 0, "weld").push_back({"rest", 0.0});
    }

    /// A spring on which the lighter side swings in half a second.
    void spring() {
        const double period = 0.5 * scene().measures().per_second, rate = 2 * pi<double> / period;
        auto& spring = link(0, 0, "spring");
        spring.push_back({"rest", length(0, 0)});
        spring.push_back({"compliance", 1 / (lighter() * rate * rate)});
        spring.push_back({"damping_time", period / 20});
    }
    double lighter() const {
        const double a = a_.mass > 0 ? a_.mass : 1, b = b_.mass > 0 ? b_.mass : a;
        return std::min(a, b);
    }

    /// A rope that is wound up, to a tenth of its length in two seconds.
    void winch() {
        const auto units = scene().measures();
        auto& rope = link(0, 0, "winch");
        const double now = length(0, 0);
        rope.push_back({"high", now});
        rope.push_back(
            {"drive", json::Object{{"keys", json::Array{json::Object{{"at", seconds() + 2 * units.per_second},
                                                                     {"to", now / 10}}}}}});
    }
    double seconds() const { return play_.session().seconds(); }

    /// Half a turn a second about the hinge, with the torque that lifts the wheel's weight at its rim.
    void motor() {
        if (a_.names.size() < 2 || b_.names.size() < 2) return;
        const auto units = scene().measures();
        const double gravity = 9.81 * units.per_metre / (units.per_second * units.per_second);
        constraints_.push_back(
            json::Object{{"kind", "angle"},
                         {"name", "motor"},
                         {"between", json::Array{b_.names[1], a_.names[0], a_.names[1]}},
                         {"rest", angle_between(b_.positions[1], a_.at, a_.positions[1]) * 180 / pi<double>},
                         {"max_force", 2 * lighter() * gravity * length_of(a_.at, a_.positions[1])},
                         {"drive", json::Object{{"speed", 180 / units.per_second}}}});
    }

    static double angle_between(const Point& a, const Point& middle, const Point& b) {
        const Vec2<double> u{{a[0] - middle[0], a[1] - middle[1]}}, v{{b[0] - middle[0], b[1] - middle[1]}};
        return arctangent(cross(u, v), dot(u, v));
    }
};

class JoinTool final : public Tool {
    std::string_view name() const override { return "join"; }
    std::string_view key() const override { return "j"; }
    std::string_view about() const override {
        return "joins what is pressed to what it is let go on, or to the background: hinge, spring, weld, motor, winch";
    }

    void press(Play& play) override {
        from_ = play.pointer();
        const auto picked = play.pick_here();
        begins_ = picked.has_value();
        if (!begins_) play.message = "a joint begins on a figure";
    }

    void release(Play& play) override {
        if (!begins_) return;
        play.each_pane([&] { add(play); });
    }

    void add(Play& play) const {
        const auto pick_at = [&](Vec2<double> pixel) {
            return pick(play.session().world(), play.view(), pixel, pick_radius * play.density());
        };
        const auto a = pick_at(from_);
        if (!a) return;
        auto b = pick_other(play, a->figure);
        auto from = end_of(play, *a);
        if (from.names.empty()) return void(play.message = "these particles have no names to join them by");
        End to = b ? end_of(play, *b) : End{};
        if (!b) to.at = play.view().position_of(play.pointer(), a->depth);
        const auto name = free_name(play.session().scene(), play.joint);
        if (play.add_figure(JointMaker(play, std::move(from), std::move(to)).made(play.joint, name), name))
            play.tell("join", {{"joint", play.joint}});
    }

    /// Particles of another figure under the pointer.
    static std::optional<Picked> pick_other(const Play& play, FigureIndex figure) {
        const auto under = play.pick_here();
        if (under && under->figure != figure) return under;
        std::optional<Picked> best;
        double nearest = pick_radius * play.density();
        std::visit(
            [&](const auto& world) {
                for (Row row = 0; row < world.particles.size(); ++row) {
                    const auto owner = world.particles.figure[row];
                    if (owner == figure || owner >= world.figures.size()) continue;
                    const auto id = world.particles.handles.id_of(row);
                    const auto at = position_of(play.session().world(), {&id, 1});
                    const auto seen = at ? play.view().see(at->template as<3, double>()) : std::nullopt;
                    if (!seen || distance(cast<double>(seen->pixel), play.pointer()) >= nearest) continue;
                    nearest = distance(cast<double>(seen->pixel), play.pointer());
                    best = Picked{.members = {id}, .position = *at, .figure = owner};
                }
            },
            play.session().world());
        return best;
    }

    void draw(const Play& play, Picture& picture) const override {
        if (!begins_) return;
        const auto& theme = theme_called(play.shown_theme());
        const auto unit = float(play.density());
        const std::array line = {cast<float>(from_), cast<float>(play.pointer())};
        picture.add(Shape::polyline, line, 3 * unit, theme.palette[0]);
        for (const auto& end : line) picture.add(Shape::disc, std::span(&end, 1), 12 * unit, theme.palette[0]);
    }

    Vec2<double> from_{};
    bool begins_ = false;
};

} // namespace

std::unique_ptr<Tool> tool::join() {
    return std::make_unique<JoinTool>();
}

} // namespace sinew::play
