#include "sinew/assert/assert.h"
#include "sinew/scene/check.h"
#include "sinew/scene/join.h"
#include "sinew/scene/scene.h"
#include "sinew/scene/surroundings.h"
#include "sinew/scene/types.h"
#include "sinew/world/edit.h"

#include <algorithm>

namespace sinew {
namespace {

/// Builds the world of a scene: first the surroundings, then figures, constraints between them and pins.
template <int D, class Real> class WorldBuilder {
  public:
    /// `world`: empty, or one that figures are added to.
    WorldBuilder(const Scene& scene, World<D, Real>& world) : scene_(scene), world_(world) {}

    void make() {
        Surroundings<D, Real>(scene_, world_).build();
        for (const auto& figure : scene_.figures) add(figure);
        for (const auto& constraint : scene_.constraints) join(world_, constraint);
        for (const auto& section : scene_.pins) hold(section);
    }
    void add(const FigureSection& section) { add(section, name_of(section)); }

  private:
    using Vector = Vec<D, Real>;
    const Scene& scene_;
    World<D, Real>& world_;

    static Vector vector(const Point& point) { return point.as<D, Real>(); }

    void touch(FigureIndex figure, const ContactSection& contact) {
        set_contact(world_, figure,
                    {.figures = contact.figures,
                     .itself = contact.itself,
                     .cloth = cloth_contact(contact.cloth),
                     .friction = contact.friction,
                     .filter = filter_of(contact.layers, contact.touches),
                     .bounce = contact.bounce,
                     .wall_friction = contact.wall_friction});
        if (!contact.radius) return;
        for (const auto id : world_.figures[figure].particles)
            if (const auto row = row_of(world_, id)) world_.particles.radius[*row] = Real(*contact.radius);
    }

    void add(const FigureSection& section, std::string_view name) {
        FigureIndex figure = no_figure;
        detail::visit_held(section.made, [&](const auto& made) { figure = build_figure(made, name, section); });
        SINEW_ASSERT(has_figure(world_, figure), "a section of the scene makes a figure");
        if (auto& own = world_.figures[figure].direct; !section.direct.empty() || own == Direct::automatic)
            own = direct(section.direct.empty() ? scene_.solver.direct : section.direct);
        if (!section.integrator.empty()) world_.figures[figure].integrator = integrator_called(section.integrator);
        world_.figures[figure].internal_damping = section.internal_damping;
        touch(figure, section.contact);
        for (const auto id : world_.figures[figure].particles) speed_up(id, section.velocity);
        for (const auto& [particle, kick] : section.kicks)
            if (const auto id = find_particle(world_, std::string(name) + "/" + particle)) speed_up(*id, kick);
        override_column(
            figure, section.relaxation, [](auto& table) -> auto& { return table.relaxation; });
        override_column(
            figure, section.split, [](auto& table) -> auto& { return table.split; });
    }

    static Direct direct(std::string_view name) {
        const auto found = std::find(direct_names.begin(), direct_names.end(), name);
        SINEW_ASSERT(found != direct_names.end(), "the reader accepts these names only");
        return Direct(found - direct_names.begin());
    }

    static ClothContactKind cloth_contact(std::string_view name) {
        const auto found = std::find(cloth_contact_names.begin(), cloth_contact_names.end(), name);
        SINEW_ASSERT(found != cloth_contact_names.end(), "the reader accepts these names only");
        return ClothContactKind(found - cloth_contact_names.begin());
    }

    static Rolls rolls(std::string_view name) {
        const auto found = std::find(rolls_names.begin(), rolls_names.end(), name);
        SINEW_ASSERT(found != rolls_names.end(), "the reader accepts these names only");
        return Rolls(found - rolls_names.begin());
    }
    Vec<spins<D>, Real> spin_of(const ParticleSection& particle) const {
        const Real rate = Real(particle.spin * up_of(scene_));
        if constexpr (D == 2)
            return {{rate}};
        else
            return direction(vector(particle.axis)) * rate;
    }

    void speed_up(ParticleId id, const Point& velocity) {
        if (velocity == Point{}) return;
        set_velocity(world_, id, *velocity_of(world_, id) + vector(velocity));
    }

    template <class Column> void override_column(FigureIndex figure, std::optional<double> value, Column&& column) {
        if (!value) return;
        for_each_table(world_, [&](auto& table) {
            for (Row row = 0; row < table.size(); ++row)
                if (table.figure[row] == figure) column(table).set(row, Real(*value));
        });
    }

    template <class Prefab>
    FigureIndex build_figure(const Prefab& prefab, std::string_view name, const FigureSection& section) {
        if constexpr (Prefab::dimensions.include(D))
            return build_checked(
                world_, prefab, name,
                Placement<D, Real>{.at = vector(section.at), .turn = section.turn, .up = up_of(scene_)});
        else
            return no_figure;
    }

    /// Builds a hand-made figure. Positions are in the scene's own axes: rotated and translated, never mirrored.
    FigureIndex build_figure(const ByHand& by_hand, std::string_view name, const FigureSection& section) {
        const auto figure = add_figure(world_, name, ByHand::name);
        const Placement<D, Real> placement{.at = vector(section.at), .turn = section.turn * up_of(scene_), .up = 1};
        for (const auto& [called, particle] : by_hand.particles) {
            const auto position = placement.to_world(particle.at.template as<D, double>());
            std::optional<Vector> previous;
            if (particle.previous) previous = placement.to_world(particle.previous->template as<D, double>());
            const auto id = add_particle(world_, {.position = position,
                                                  .velocity = vector(particle.velocity),
                                                  .previous = previous,
                                                  .mass = Real(particle.mass),
                                                  .radius = Real(particle.radius),
                                                  .figure = figure,
                                                  .rolls = rolls(particle.rolls),
                                                  .inertia = Real(particle.inertia.value_or(solid_inertia<D>)),
                                                  .spin = spin_of(particle)});
            world_.figures[figure].particles.push_back(id);
            world_.figures[figure].particle_names.emplace_back(called, id);
            if (particle.pinned) pin(world_, id);
        }
        for (const auto& constraint : by_hand.constraints) join(world_, constraint, figure, std::string(name) + "/");
        for (const auto& piece : by_hand.pieces) add_piece(piece, figure, std::string(name) + "/");
        for (std::size_t i = 0; i < by_hand.particles.size(); ++i)
            world_.figures[figure].pieces.push_back({.mark = Mark::dot,
                                                     .part = by_hand.particles[i].first,
                                                     .particles = {world_.figures[figure].particles[i]},
                                                     .width = by_hand.particles[i].second.size});
        return figure;
    }

    /// Adds a drawn piece. The enum Mark has the order of mark_names. Unknown particles get an empty id;
    /// check_references reports such names.
    void add_piece(const PieceSection& section, FigureIndex figure, const std::string& prefix) {
        const auto mark = std::find(mark_names.begin(), mark_names.end(), section.mark) - mark_names.begin();
        Piece piece{.mark = Mark(mark),
                    .part = section.part.empty() ? section.mark : section.part,
                    .width = section.width,
                    .end_width = section.width > 0 ? section.end_width : 0};
        for (const auto& particle : section.through)
            piece.particles.push_back(find_particle(world_, full_name(particle, prefix)).value_or(ParticleId{}));
        world_.figures[figure].pieces.push_back(std::move(piece));
    }

    void hold(const PinSection& section) {
        for (const auto id : find_particles(world_, section.particle)) {
            auto spec = section.grip.spec<D, Real>(section.driver ? hold_rule(scene_) : Hold::fixed);
            if (section.to) spec.target = vector(*section.to);
            spec.damping = Real(section.damping);
            if (section.steer) steer(spec, section, id);
            pin(world_, id, spec);
        }
    }

    /// In physical mode the pin becomes a spring of the mean stiffness k m, damped by a fraction of the critical
    /// damping 2 sqrt(k) m.
    void steer(PinSpec<D, Real>& spec, const PinSection& section, ParticleId id) const {
        const auto gain = vector(*section.steer);
        if (world_.settings.mode == Mode::classic) {
            spec.steer = gain;
            spec.steer_damping = Real(section.steer_damping);
            return;
        }
        Real mean = 0;
        for (int i = 0; i < D; ++i) mean += gain[i] / Real(D);
        spec.compliance = world_.particles.inverse_mass[*row_of(world_, id)] * inverse_or_zero(mean);
        spec.damping = Real(section.steer_damping) * inverse_or_zero(Real(2) * square_root(mean));
    }
};

} // namespace

Hold hold_rule(const Scene& scene) {
    const auto& rules = scene.solver.rules;
    if (rules.displaced_hold) return Hold::displaced;
    return Hold(std::find(RulesSection::holds.begin(), RulesSection::holds.end(), rules.hold) -
                RulesSection::holds.begin());
}

namespace {

template <class Real> constexpr std::string_view name_of_precision = std::is_same_v<Real, float> ? "float" : "double";

template <class WorldT> bool is_of(int dimension, std::string_view precision) {
    return dimension == WorldT::dimension && precision == name_of_precision<typename WorldT::Real>;
}

template <class... Each> AnyWorld instantiate_any(const Scene& scene, std::type_identity<std::variant<Each...>>) {
    AnyWorld made;
    const auto make = [&]<int D, class Real>(std::type_identity<World<D, Real>>) {
        if (!is_of<World<D, Real>>(scene.dimension, scene.solver.precision)) return;
        World<D, Real> world;
        WorldBuilder<D, Real>(scene, world).make();
        made = std::move(world);
    };
    (make(std::type_identity<Each>{}), ...);
    return made;
}

template <class... Each>
bool has_world(int dimension, std::string_view precision, std::type_identity<std::variant<Each...>>) {
    return (is_of<Each>(dimension, precision) || ...);
}

} // namespace

AnyWorld instantiate(const Scene& scene) {
    return instantiate_any(scene, std::type_identity<AnyWorld>{});
}

void add_figure(const Scene& scene, const FigureSection& section, AnyWorld& world) {
    std::visit([&]<int D, class Real>(World<D, Real>& known) { WorldBuilder<D, Real>(scene, known).add(section); },
               world);
}

bool has_world(int dimension, std::string_view precision) {
    return has_world(dimension, precision, std::type_identity<AnyWorld>{});
}

} // namespace sinew
