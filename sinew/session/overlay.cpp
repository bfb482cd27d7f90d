#include "sinew/session/overlay.h"

#include "sinew/session/forces.h"

#include <algorithm>
#include <fmt/format.h>

namespace sinew {
namespace {

/// Sizes in a picture of the nominal height; they grow with it.
constexpr float line = 3, casing = 1.8F /* times a line */, letters = 11, pin_size = 11;
constexpr float longest_arrow = 70, contact_size = 8, legend_row = 34;

constexpr Color stretched{0.85F, 0.15F, 0.12F, 1}, squeezed{0.12F, 0.35F, 0.85F, 1};

/// The smallest of 1, 2, 5, 10, 20, 50, ... times `least` that is at least as large: a scale that seldom changes.
double round_up(double value, double least) {
    double scale = least;
    for (int i = 0; scale < value && i < 300; ++i) scale *= i % 3 == 1 ? 2.5 : 2;
    return scale;
}

template <class WorldT> class Overlayer {
  public:
    Overlayer(const Scene& scene, const WorldT& world, const View& view, Picture& picture)
        : scene_(scene), world_(world), view_(view), picture_(picture), theme_(theme_called(scene.view.theme)),
          unit_(float(picture.height / Picture::nominal_height)), text_(theme_.pen) {}

    void strain() {
        color_lines([](const ConstraintState& state) { return state.strain * 100; }, 0.1, "strain", "%");
    }

    void tension() {
        if (world_.settings.mode == Mode::classic) return legend("tension: classic mode knows no forces", 0, "");
        const auto units = scene_.measures();
        const double newtons = square(units.per_second) / units.per_metre;
        color_lines([&](const ConstraintState& state) { return state.tension * newtons; }, 1, "tension", "N");
    }

    void pins() {
        for (const auto& pin : world_.pins) {
            const auto at = pixel_of(pin.particle);
            if (!at) continue;
            const auto to = view_.see(in_space(pin.target));
            const float size = pin_size * unit_;
            if (to && !pin.hard()) {
                const std::array way = {*at, to->pixel};
                picture_.add(Shape::polyline, way, 1.5F * unit_, text_);
            }
            const auto place = to ? to->pixel : *at;
            picture_.add(Shape::disc, std::span(&place, 1), size, theme_.background);
            picture_.add(Shape::disc, std::span(&place, 1), size * 0.75F, text_);
            picture_.add(Shape::disc, std::span(&place, 1), size * 0.3F, theme_.background);
        }
    }

    /// The first of two that would lie on each other: figures before their particles.
    void names() {
        for (const auto& figure : world_.figures) {
            Vec2<float> top{{0, 1e9F}};
            float left = 1e9F, right = -1e9F;
            for (const auto id : figure.particles)
                if (const auto at = pixel_of(id)) {
                    top[1] = minimum(top[1], (*at)[1]);
                    left = minimum(left, (*at)[0]), right = maximum(right, (*at)[0]);
                }
            top[0] = (left + right) / 2;
            if (right >= left) write(figure.name, top - Vec2<float>{{0, 2 * letters * unit_}}, 1.3F * letters);
        }
        for (const auto& figure : world_.figures)
            for (const auto& [name, id] : figure.particle_names)
                if (const auto at = pixel_of(id)) write(name, *at + Vec2<float>{{0, letters * unit_}}, letters);
    }

    /// Of particles that can move, all force fields; of those that a pin holds, the pin's reaction.
    void forces() {
        if (!knows_forces("forces")) return;
        const Forces<WorldT> forces(world_);
        const auto& p = world_.particles;
        std::vector<char> pinned(p.size());
        for (const auto& pin : world_.pins)
            if (const auto row = row_of(world_, pin.particle)) pinned[*row] = 1;
        std::vector<Arrow> arrows;
        for (Row row = 0; row < p.size(); ++row)
            if (pinned[row])
                arrows.push_back({cast<double>(p.position[row]), forces.of_pin(row), stretched});
            else if (p.mobility[row] > 0)
                arrows.push_back({cast<double>(p.position[row]), forces.of_fields(row), squeezed});
        draw_arrows(arrows, "forces");
    }

    /// In classic mode walls exert no force: places only.
    void contacts() {
        const bool known = knows_forces("contacts");
        const Forces<WorldT> forces(world_);
        const auto& p = world_.particles;
        std::vector<Arrow> arrows;
        for (const auto& plane : world_.bounds)
            for (Row row = 0; row < p.size(); ++row) {
                if (p.mobility[row] == 0 || !touches(row, plane)) continue;
                const double push = known ? forces.of_plane(row, plane) : 0;
                arrows.push_back({touching_point(row, plane), cast<double>(plane.normal) * push, stretched});
            }
        if (known) draw_arrows(arrows, "contacts");
        for (const auto& arrow : arrows) mark_contact(arrow.from);
    }

  private:
    static constexpr int D = WorldT::dimension;
    using Plane = HalfSpace<D, typename WorldT::Real>;
    const Scene& scene_;
    const WorldT& world_;
    const View& view_;
    Picture& picture_;
    const Theme& theme_;
    const float unit_;
    const Color text_;
    int legends_ = 0;

    struct Box {
        Vec2<float> middle, size;
    };
    std::vector<Box> taken_;

    template <class T> static Vec3<double> in_space(const Vec<D, T>& place) {
        Vec3<double> wide{};
        for (int i = 0; i < D; ++i) wide[i] = double(place[i]);
        return wide;
    }

    std::optional<Vec2<float>> pixel_of(ParticleId id) const {
        const auto row = row_of(world_, id);
        const auto seen = row ? view_.see(in_space(world_.particles.position[*row])) : std::nullopt;
        return seen ? std::optional(seen->pixel) : std::nullopt;
    }

    struct Arrow {
        Vec<D, double> from, force;
        Color color;
    };

    bool knows_forces(const std::string& overlay) {
        if (world_.settings.mode == Mode::physical) return true;
        legend(overlay + ": classic mode knows no forces", 0, "");
        return false;
    }

    /// A particle at rest on a plane is above it by no more than rounding and a step's fall leave.
    bool touches(Row row, const Plane& plane) const {
        constexpr double near = 1e-3; // metres
        const auto& p = world_.particles;
        const double gap = double(dot(plane.normal, p.position[row]) - plane.offset - p.radius[row]);
        return gap <= near * scene_.measures().per_metre;
    }

    Vec<D, double> touching_point(Row row, const Plane& plane) const {
        const auto& p = world_.particles;
        return cast<double>(p.position[row]) - cast<double>(plane.normal) * double(p.radius[row]);
    }

    void mark_contact(const Vec<D, double>& place) {
        const auto seen = view_.see(in_space(place));
        if (!seen) return;
        picture_.add(Shape::disc, std::span(&seen->pixel, 1), contact_size * unit_, theme_.background);
        picture_.add(Shape::disc, std::span(&seen->pixel, 1), 0.7F * contact_size * unit_, stretched);
    }

    /// The scale of all arrows is a round number of newtons, which the legend tells.
    void draw_arrows(const std::vector<Arrow>& arrows, std::string_view what) {
        const auto units = scene_.measures();
        const double newtons = square(units.per_second) / units.per_metre;
        double largest = 0;
        for (const auto& arrow : arrows) largest = maximum(largest, norm(arrow.force) * newtons);
        const double scale = round_up(largest, 0.01);
        for (const auto& arrow : arrows)
            if (const auto from = view_.see(in_space(arrow.from))) {
                const double length = longest_arrow * double(unit_) / double(from->scale);
                const auto to = view_.see(in_space(arrow.from + arrow.force * (length * newtons / scale)));
                if (to) draw_arrow(from->pixel, to->pixel, arrow.color);
            }
        arrow_legend(what, largest > 0 ? scale : 0);
    }

    void draw_arrow(Vec2<float> from, Vec2<float> to, const Color& color) {
        const auto along = to - from;
        const float length = norm(along), head = minimum(8 * unit_, 0.4F * length);
        if (length < unit_) return;
        const auto ahead = along * (1 / length);
        const Vec2<float> across{{-ahead[1], ahead[0]}};
        const auto neck = to - ahead * head;
        const std::array shaft = {from, neck};
        const std::array<Vec2<float>, 3> tip = {{to, neck + across * (0.5F * head), neck - across * (0.5F * head)}};
        picture_.add(Shape::polyline, shaft, (line + 1.5F) * unit_, theme_.background);
        picture_.add(Shape::polyline, shaft, line * unit_, color);
        picture_.add(Shape::polygon, tip, 0, color);
    }

    /// An arrow as long as the scale, and its name beside it.
    void arrow_legend(std::string_view what, double scale) {
        const float margin = 14 * unit_, long_as = longest_arrow * unit_, letter = 0.6F * letters * unit_;
        const float y = float(picture_.height) - margin - float(legends_++) * legend_row * unit_;
        const auto text = scale > 0 ? fmt::format("{}: {:g} N", what, scale) : fmt::format("{}: none", what);
        const float left = scale > 0 ? margin + long_as + letter : margin;
        picture_.add_text(text, {{left + letter * float(text.size()) / 2, y}}, letters * unit_, text_);
        if (scale > 0) draw_arrow({{margin, y}}, {{margin + long_as, y}}, text_);
    }

    /// Every distance as a line, in the colour of its value; the palest has none. What only keeps apart is one while it
    /// does.
    template <class Value>
    void color_lines(Value&& value_of, double least, std::string_view what, std::string_view unit) {
        struct Line {
            std::array<Vec2<float>, 2> ends;
            double value;
        };
        std::vector<Line> lines;
        double largest = 0;
        const auto& table = std::get<kind_number<Distance, D>>(world_.constraints);
        for (Row row = 0; row < table.size(); ++row) {
            const auto state = constraint_state(world_, {kind_number<Distance, D>, table.slots.id_of(row)});
            const auto a = view_.see(in_space(world_.particles.position[table.members[row][0]]));
            const auto b = view_.see(in_space(world_.particles.position[table.members[row][1]]));
            if (!state || !a || !b) continue;
            if (!ties(table, row) && state->strain == 0 && state->tension == 0) continue;
            lines.push_back({{a->pixel, b->pixel}, value_of(*state)});
            largest = maximum(largest, absolute(lines.back().value));
        }
        const double scale = round_up(largest, least);
        // Thinner where they lie closely.
        const auto thick = [&](const auto& ends) { return minimum(line * unit_, 0.25F * distance(ends[0], ends[1])); };
        for (const auto& [ends, value] : lines) picture_.add(Shape::polyline, ends, casing * thick(ends), theme_.ink);
        for (const auto& [ends, value] : lines)
            picture_.add(Shape::polyline, ends, thick(ends), color_of(value / scale));
        legend(what, scale, unit);
    }

    /// -1 squeezed, 0 neither, 1 stretched.
    static Color color_of(double share) {
        constexpr Color rest{0.93F, 0.91F, 0.84F, 1};
        return mix(rest, share < 0 ? squeezed : stretched, float(clamp(absolute(share), 0.0, 1.0)));
    }

    /// A bar of the colours with what they stand for, in the lower left corner; further ones above it.
    void legend(std::string_view what, double scale, std::string_view unit) {
        const float margin = 14 * unit_, wide = 150 * unit_, high = 7 * unit_;
        const float y = float(picture_.height) - margin - float(legends_++) * legend_row * unit_;
        const auto label = [&](std::string text, float x) {
            picture_.add_text(std::move(text), {{x, y - high - 7 * unit_}}, letters * unit_, text_);
        };
        if (scale == 0) return label(std::string(what), margin + wide);
        constexpr int parts = 30;
        for (int i = 0; i < parts; ++i) {
            const float left = margin + wide * float(i) / parts, right = margin + wide * float(i + 1) / parts + 0.5F;
            const std::array<Vec2<float>, 4> box = {
                {{{left, y - high}}, {{right, y - high}}, {{right, y}}, {{left, y}}}};
            picture_.add(Shape::polygon, box, 0, color_of(2 * (i + 0.5) / parts - 1));
        }
        label(fmt::format("-{:g} {}", scale, unit), margin + 18 * unit_);
        label(std::string(what), margin + wide / 2);
        label(fmt::format("{:g} {}", scale, unit), margin + wide - 15 * unit_);
    }

    void write(const std::string& text, Vec2<float> middle, float height) {
        constexpr float letter_width = 0.6F; // of its height
        const Vec2<float> half{{float(text.size()) * letter_width * height * unit_ / 2, height * unit_ / 2}};
        middle[0] = clamp(middle[0], half[0], maximum(half[0], float(picture_.width) - half[0]));
        middle[1] = clamp(middle[1], half[1], maximum(half[1], float(picture_.height) - half[1]));
        const Box box{middle, half * 2.0F};
        for (const auto& other : taken_) {
            const auto apart = box.middle - other.middle, room = (box.size + other.size) * 0.5F;
            if (absolute(apart[0]) < room[0] && absolute(apart[1]) < room[1]) return;
        }
        taken_.push_back(box);
        picture_.add_text(text, middle, height * unit_, text_);
    }
};

/// In the order of `overlays`.
template <class WorldT>
constexpr std::array<void (Overlayer<WorldT>::*)(), overlays.size()> functions = {
    &Overlayer<WorldT>::strain, &Overlayer<WorldT>::tension, &Overlayer<WorldT>::pins,
    &Overlayer<WorldT>::names,  &Overlayer<WorldT>::forces,  &Overlayer<WorldT>::contacts};

} // namespace

void draw_overlays(OverlaySet which, const Scene& scene, const AnyWorld& world, const View& view, Picture& picture) {
    std::visit(
        [&]<class WorldT>(const WorldT& known) {
            Overlayer<WorldT> overlayer(scene, known, view, picture);
            for (std::size_t i = 0; i < overlays.size(); ++i)
                if (which[i]) (overlayer.*functions<WorldT>[i])();
        },
        world);
}

} // namespace sinew
