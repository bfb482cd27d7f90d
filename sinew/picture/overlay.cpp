#include "sinew/picture/overlay.h"

#include "sinew/math/format.h"
#include "sinew/picture/annotator.h"
#include "sinew/picture/contact_points.h"
#include "sinew/picture/forces.h"

#include <algorithm>

namespace sinew {
namespace {

/// Sizes at the nominal height of a picture, nominal pixels; proportional to the height.
constexpr float casing = 1.8F /* times a line */, pin_size = 11, contact_size = 8;

/// Smallest of 1, 2, 5, 10, 20, 50, ... times `min` not below `value`: a scale that seldom changes.
double round_up(double value, double min) {
    double scale = min;
    for (int i = 0; scale < value && i < 300; ++i) scale *= i % 3 == 1 ? 2.5 : 2;
    return scale;
}

template <class WorldT> class Overlayer {
  public:
    Overlayer(const Scene& scene, const WorldT& world, const View& view, Picture& picture)
        : scene_(scene), world_(world), view_(view), picture_(picture), theme_(theme_called(scene.view.theme)),
          unit_(float(picture.height / Picture::nominal_height)), text_(theme_.pen), annotator_(picture, theme_) {}

    void strain() {
        color_lines([](const ConstraintState& state) { return state.strain * 100; }, 0.1, "strain", "%");
    }

    void tension() {
        if (world_.settings.mode == Mode::classic) return annotator_.add_words("tension: classic mode knows no forces");
        color_lines([&](const ConstraintState& state) { return state.tension * newtons(); }, 1, "tension", "N");
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
            const auto position = to ? to->pixel : *at;
            picture_.add(Shape::disc, std::span(&position, 1), size, theme_.background);
            picture_.add(Shape::disc, std::span(&position, 1), size * 0.75F, text_);
            picture_.add(Shape::disc, std::span(&position, 1), size * 0.3F, theme_.background);
        }
    }

    /// Names of figures, then of particles; an overlapping later label is left out.
    void names() {
        for (const auto& figure : world_.figures) {
            Vec2<float> top{{0, 1e9F}};
            float left = 1e9F, right = -1e9F;
            for (const auto id : figure.particles)
                if (const auto at = pixel_of(id)) {
                    top[1] = min(top[1], (*at)[1]);
                    left = min(left, (*at)[0]), right = max(right, (*at)[0]);
                }
            top[0] = (left + right) / 2;
            if (right >= left)
                annotator_.write(figure.name, top - Vec2<float>{{0, 2 * Annotator::letters * unit_}},
                                 1.3F * Annotator::letters);
        }
        for (const auto& figure : world_.figures)
            for (const auto& [name, id] : figure.particle_names)
                if (const auto at = pixel_of(id))
                    annotator_.write(name, *at + Vec2<float>{{0, Annotator::letters * unit_}}, Annotator::letters);
    }

    /// Arrows: the sum of all force fields on a movable particle, the pin's reaction on a pinned one.
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

    /// Arrows of normal forces and dots at contact points; in classic mode, where contacts exert no force, dots only.
    void contacts() {
        const bool known = knows_forces("contacts");
        const double near = 1e-3 /* metres */ * scene_.measures().per_metre;
        std::vector<Arrow> arrows;
        for (const auto& [position, force] : ContactPoints<WorldT>(world_, step_length(scene_), near).list())
            arrows.push_back({position, force, stretched});
        if (known) {
            draw_arrows(arrows, "contacts");
            if (!arrows.empty())
                annotator_.add_words(format_text("{} touch, with up to {:3} N", arrows.size(), largest(arrows)));
        }
        for (const auto& arrow : arrows) mark_contact(arrow.from);
    }

  private:
    static constexpr int D = WorldT::dimension;
    const Scene& scene_;
    const WorldT& world_;
    const View& view_;
    Picture& picture_;
    const Theme& theme_;
    const float unit_;
    const Color text_;
    Annotator annotator_;

    template <class T> static Vec3<double> in_space(const Vec<D, T>& position) {
        Vec3<double> wide{};
        for (int i = 0; i < D; ++i) wide[i] = double(position[i]);
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
        annotator_.add_words(overlay + ": classic mode knows no forces");
        return false;
    }

    void mark_contact(const Vec<D, double>& position) {
        const auto seen = view_.see(in_space(position));
        if (!seen) return;
        picture_.add(Shape::disc, std::span(&seen->pixel, 1), contact_size * unit_, theme_.background);
        picture_.add(Shape::disc, std::span(&seen->pixel, 1), 0.7F * contact_size * unit_, stretched);
    }

    /// Newtons in the world's own unit of force.
    double newtons() const {
        const auto units = scene_.measures();
        return square(units.per_second) / units.per_metre;
    }
    /// Newtons.
    double largest(const std::vector<Arrow>& arrows) const {
        double force = 0;
        for (const auto& arrow : arrows) force = max(force, norm(arrow.force));
        return force * newtons();
    }

    /// Draws all arrows to one scale: a round number of newtons, stated in the legend.
    void draw_arrows(const std::vector<Arrow>& arrows, std::string_view what) {
        const double strongest = largest(arrows), scale = round_up(strongest, 0.01);
        for (const auto& arrow : arrows)
            if (const auto from = view_.see(in_space(arrow.from))) {
                const double length = Annotator::longest_arrow * double(unit_) / double(from->scale);
                const auto to = view_.see(in_space(arrow.from + arrow.force * (length * newtons() / scale)));
                if (to) annotator_.draw_arrow(from->pixel, to->pixel, arrow.color);
            }
        annotator_.add_arrow(what, strongest > 0 ? scale : 0);
    }

    /// Every distance as a line coloured by value; neutral lines take the pale colour. A one-sided distance that only
    /// keeps particles apart is drawn only while active.
    template <class Value>
    void color_lines(Value&& value_of, double min_scale, std::string_view what, std::string_view unit) {
        struct Line {
            std::array<Vec2<float>, 2> ends;
            double value;
        };
        std::vector<Line> lines;
        double largest = 0;
        const auto& table = std::get<kind_number<Distance, D>>(world_.constraints);
        for (Row row = 0; row < table.size(); ++row) {
            const auto state = constraint_state(world_, {kind_number<Distance, D>, table.handles.id_of(row)});
            const auto a = view_.see(in_space(world_.particles.position[table.members[row][0]]));
            const auto b = view_.see(in_space(world_.particles.position[table.members[row][1]]));
            if (!state || !a || !b) continue;
            if (!ties(table, row) && state->strain == 0 && state->tension == 0) continue;
            lines.push_back({{a->pixel, b->pixel}, value_of(*state)});
            largest = max(largest, absolute(lines.back().value));
        }
        const double scale = round_up(largest, min_scale);
        // Thinner where lines are dense.
        const auto thick = [&](const auto& ends) {
            return min(Annotator::line * unit_, 0.25F * distance(ends[0], ends[1]));
        };
        for (const auto& [ends, value] : lines) picture_.add(Shape::polyline, ends, casing * thick(ends), theme_.ink);
        for (const auto& [ends, value] : lines)
            picture_.add(Shape::polyline, ends, thick(ends), color_of_share(value / scale));
        annotator_.add_bar(what, scale, unit);
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
