#pragma once

#include "sinew/prefab/prefabs.h"
#include "sinew/topology/cut.h"

#include "tests/worlds.h"

#include <array>

/// Random calls of everything that changes a world, on random worlds. Handles are kept for good: most calls meet some
/// that are stale.
namespace sinew::test {

enum class Numbers { usual, extreme };

template <class WorldT> class RandomCalls {
  public:
    using World = WorldT;
    using Real = typename World::Real;
    static constexpr int D = World::dimension;
    using Vector = Vec<D, Real>;

    World world;
    std::vector<ParticleId> particles;
    std::vector<ConstraintId> constraints;
    std::vector<PinId> pins;
    std::vector<FigureId> figures;

    explicit RandomCalls(std::uint64_t seed, Numbers numbers = Numbers::usual) : seed_(seed), numbers_(numbers) {
        fall(world, 10);
        if (one_in(3)) world.forces.push_back(Drag<D, Real>{Real(0.1)});
        if (one_in(4)) world.bounds.push_back({Vector::axis(1), -4, Real(0.5), Real(0.3)});
        for (int i = 0, count = 1 + below(4); i < count; ++i)
            one_in(2) ? add_prefab() : one_in(2) ? add_rope() : add_cloth();
    }

    void call() {
        if (particles.size() < 2) return add_rope();
        using Call = void (RandomCalls::*)();
        static constexpr std::array calls = {
            &RandomCalls::add_rope,    &RandomCalls::add_prefab, &RandomCalls::add_cloth,  &RandomCalls::join_some,
            &RandomCalls::unjoin,      &RandomCalls::take_away,  &RandomCalls::remove_one, &RandomCalls::hold,
            &RandomCalls::let_go,      &RandomCalls::let_go,     &RandomCalls::let_all_go, &RandomCalls::carry,
            &RandomCalls::drive_one,   &RandomCalls::drive_one,  &RandomCalls::drive_one,  &RandomCalls::weaken,
            &RandomCalls::put,         &RandomCalls::speed_up,   &RandomCalls::weigh,      &RandomCalls::push,
            &RandomCalls::kick,        &RandomCalls::move_all,   &RandomCalls::release,    &RandomCalls::spoil,
            &RandomCalls::slash,       &RandomCalls::cut_one,    &RandomCalls::set_up,     &RandomCalls::set_up,
            &RandomCalls::change_walls};
        (this->*Call(calls[std::size_t(below(int(calls.size())))]))();
    }

    int below(int count) { return int(random::whole(0, count - 1, seed_, 0, drawn_++)); }
    bool one_in(int count) { return below(count) == 0; }
    double between_numbers(double low, double high) { return low + (high - low) * random::uniform(seed_, 1, drawn_++); }
    template <class List> auto one_of(const List& list) { return list[std::size_t(below(int(list.size())))]; }

    /// Usually what is asked for; among extreme numbers, any.
    Real number(double low, double high) {
        constexpr auto max = double(std::numeric_limits<float>::max());
        constexpr std::array extremes = {0.0, 1e-38, 1e-12, 1e-3, 1.0, 1e8, 1e12, 1e30, max};
        if (numbers_ == Numbers::usual || one_in(3)) return Real(between_numbers(low, high));
        return Real(one_of(extremes) * (one_in(2) ? 1 : -1));
    }
    Vector vector(double reach) {
        return Vector::map([&](int) { return number(-reach, reach); });
    }

  private:
    std::uint64_t seed_, drawn_ = 0;
    Numbers numbers_;
    static constexpr std::size_t many = 600; ///< particles: of more, no more are made
    static constexpr Real endless = std::numeric_limits<Real>::infinity();

    FigureIndex any_figure() { return FigureIndex(below(int(world.figures.size()) + 2)); }

    // --- what comes ------------------------------------------------------------------------------------------------

    ParticleId add_particle(const Vector& position) {
        particles.push_back(sinew::add_particle(world, {.position = position,
                                                        .velocity = one_in(3) ? vector(1) : Vector{},
                                                        .mass = one_in(12) ? endless : number(0.1, 3),
                                                        .radius = one_in(2) ? number(0, 0.1) : 0,
                                                        .figure = any_figure()}));
        return particles.back();
    }

    ConstraintSpec<Real> any_spec(double natural) {
        const Interval<Real> limits[] = {at_most(number(0, natural)), at_least(number(0, natural)),
                                         between(number(0, natural), number(natural, 2 * natural))};
        ConstraintSpec<Real> spec;
        if (one_in(2)) spec.limits = limits[below(3)];
        if (one_in(5)) spec.compliance = number(0, 1e-2);
        if (one_in(9)) spec.relaxation = number(0, 1);
        if (one_in(9)) spec.split = number(0, 1);
        if (one_in(9)) spec.max_force = number(0, 50);
        if (one_in(14)) spec.damping_time = number(0, 0.01);
        if (one_in(8)) spec.breaking_strain = number(0.01, 0.5);
        if (one_in(14)) spec.damage_limit = number(0, 0.1);
        spec.figure = any_figure();
        return spec;
    }
    void join(int kind, const std::vector<ParticleId>& members) {
        const auto spec = one_in(3) ? any_spec(0.3) : ConstraintSpec<Real>{};
        if (const auto id = add_constraint<D, Real>(world, kind, members, spec)) constraints.push_back(*id);
    }
    void join_some() {
        const int kind = below(Kinds<D>::size);
        int arity = 0, number = 0;
        Kinds<D>::for_each([&](auto tag) {
            if (number++ == kind) arity = decltype(tag)::type::arity;
        });
        std::vector<ParticleId> members(std::size_t(arity == any_arity ? 3 + below(3) : arity));
        for (auto& member : members) member = one_of(particles);
        join(kind, members);
    }

    void add_rope() {
        if (world.particles.size() > many) return;
        auto position = vector(3);
        std::vector<ParticleId> rope;
        const bool plain = one_in(2);
        for (int i = 0, count = 3 + below(8); i < count; ++i) {
            position += at<Vector>(0.3, between_numbers(-0.05, 0.05));
            rope.push_back(add_particle(position));
            if (i > 0 && plain) keep(add<Distance>(world, {rope[std::size_t(i) - 1], rope.back()}));
            if (i > 0 && !plain) join(kind_number<Distance, D>, {rope[std::size_t(i) - 1], rope.back()});
            if (i > 1 && one_in(5)) join(kind_number<Angle, D>, {rope.end() - 3, rope.end()});
        }
        if (one_in(2)) keep(pin(world, rope[0]));
    }

    /// Tethered or not, solved at once or not, and torn by a strong pull or not.
    void add_cloth() {
        if (world.particles.size() > many) return;
        const auto figure = name_figure(add_figure(world, "cloth", "cloth"));
        world.figures[figure].tethers = one_in(2);
        if (one_in(2)) world.figures[figure].direct = Direct(below(3));
        const int columns = 2 + below(12), rows = 2 + below(12);
        const auto corner = vector(3);
        std::vector<ParticleId> spots;
        for (int i = 0; i < columns * rows; ++i)
            spots.push_back(
                sinew::add_particle(world, {.position = corner + at<Vector>(0.1 * (i % columns), -0.1 * (i / columns)),
                                            .mass = Real(0.05),
                                            .figure = figure}));
        for (const auto id : spots) particles.push_back(id), world.figures[figure].particles.push_back(id);
        const ConstraintSpec<Real> spec{.breaking_strain = one_in(3) ? Real(0.3) : endless, .figure = figure};
        const auto link = [&](int i, int k) {
            keep(add<Distance>(world, {spots[std::size_t(i)], spots[std::size_t(k)]}, spec));
        };
        for (int i = 0; i < columns * rows; ++i) {
            if (i % columns + 1 < columns) link(i, i + 1);
            if (i + columns < columns * rows) link(i, i + columns);
        }
        for (const int i : {0, columns - 1})
            if (!one_in(4)) keep(pin(world, spots[std::size_t(i)]));
    }

    void add_prefab() {
        static constexpr std::array names = {"polygon",  "box",          "tire",   "rope",   "chain",
                                             "swing",    "bridge",       "crank",  "tree",   "limb",
                                             "humanoid", "stick_figure", "puppet", "ragdoll"};
        const auto prefab = make_prefab(one_of(names));
        if (world.particles.size() > many || !prefab || problem_of(*prefab, D)) return;
        const auto figure = build(world, *prefab, name_of(*prefab), {.at = vector(3)});
        if (!figure) return;
        name_figure(*figure);
        for (const auto id : world.figures[*figure].particles) particles.push_back(id);
        for (const auto id : world.figures[*figure].constraints) constraints.push_back(id);
    }

    FigureIndex name_figure(FigureIndex figure) {
        figures.push_back(figure_id(world, figure));
        return figure;
    }
    void keep(const std::optional<ConstraintId>& id) {
        if (id) constraints.push_back(*id);
    }
    void keep(const std::optional<PinId>& id) {
        if (id) pins.push_back(*id);
    }

    // --- what goes -------------------------------------------------------------------------------------------------

    void unjoin() {
        if (!constraints.empty()) remove_constraints(world, std::vector{one_of(constraints)});
    }
    void take_away() {
        std::vector<ParticleId> some(std::size_t(1 + below(4)));
        for (auto& id : some) id = one_of(particles);
        remove_particles(world, some);
    }
    void remove_one() {
        if (!figures.empty()) remove_figure(world, one_of(figures));
    }
    void slash() { cut(world, Blade{{{between_numbers(-4, 4), -4}}, {{between_numbers(-4, 4), 4}}}); }
    void cut_one() {
        if (!constraints.empty()) cut<D, Real>(world, std::vector{one_of(constraints)});
    }

    // --- what is held and driven -----------------------------------------------------------------------------------

    void hold() {
        PinSpec<D, Real> spec;
        if (one_in(2)) spec.compliance = number(0, 1e-2);
        if (one_in(3)) spec.max_force = number(0, 50);
        if (one_in(3)) spec.target = vector(2);
        keep(pin(world, one_of(particles), spec));
    }
    void let_go() {
        if (!pins.empty()) unpin(world, one_of(pins));
    }
    void let_all_go() { unpin_all(world, one_of(particles)); }
    void carry() {
        if (!pins.empty()) move_pin(world, one_of(pins), vector(3));
    }
    void drive_one() {
        if (!constraints.empty()) drive(world, one_of(constraints), one_in(3) ? 0 : number(-5, 5));
    }
    void weaken() {
        if (!constraints.empty()) set_max_force(world, one_of(constraints), one_in(3) ? endless : number(0, 100));
    }

    // --- what is moved ---------------------------------------------------------------------------------------------

    void put() { set_position(world, one_of(particles), vector(3)); }
    void speed_up() { set_velocity(world, one_of(particles), vector(3)); }
    void weigh() { set_mass(world, one_of(particles), one_in(3) ? endless : number(0.1, 5)); }
    void push() { apply_force(world, one_of(particles), vector(100)); }
    void kick() { apply_impulse(world, one_of(particles), vector(3)); }
    void move_all() {
        for (int i = 0; i < 2; ++i) teleport(world, any_figure(), vector(1), Momentum(below(2)));
    }
    void release() { release_quarantine(world, any_figure()); }
    void spoil() {
        if (numbers_ == Numbers::usual && one_in(4))
            set_position(world, one_of(particles), Vector::axis(0) * Real(NAN));
    }

    // --- settings --------------------------------------------------------------------------------------------------

    void set_up() {
        auto& settings = world.settings;
        const int what = below(7);
        if (what == 0) settings.mode = one_in(3) ? Mode::classic : Mode::physical;
        if (what == 1) settings.substeps = below(6);
        if (what == 2) settings.iterations = 1 + below(3);
        if (what == 3) settings.damping = one_in(2) ? 0 : number(0, 0.5);
        if (what == 4) settings.classic.moves_each_pass = one_in(2);
        if (what == 5) settings.classic.order = PassOrder(below(3));
        if (what == 6) world.solver.options.threads = 1 + below(3);
    }
    void change_walls() {
        if (!world.bounds.empty() && one_in(2)) return world.bounds.pop_back();
        world.bounds.push_back({Vector::axis(below(D)), number(-5, -3), number(0, 1), number(0, 1)});
    }
};

} // namespace sinew::test
