#include "sinew/prefab/problem.h"
#include "sinew/scene/forces.h"
#include "sinew/scene/text.h"
#include "sinew/world/edit.h"

#include "bindings/c/native/sized.h"
#include "bindings/c/simulation.h"

/// Force fields, added, read, changed and removed by calls.
using namespace sinew;
using namespace sinew::c;

namespace {

/// The value of the caller; in place of 0 the usual one.
double or_usual(double given, double usual) {
    return given == 0 ? usual : given;
}

/// Section of a scene that says the same; nothing for an unknown kind.
std::optional<ForceSection> section_of(const sinew_force_spec& spec, const Units& units) {
    const auto seed = std::int64_t(spec.seed);
    switch (spec.kind) {
    case SINEW_GRAVITY:
        return ForceSection{GravityForce{point_of(spec.acceleration)}};
    case SINEW_DRAG:
        return ForceSection{DragForce{spec.strength}};
    case SINEW_WIND:
        return ForceSection{WindForce{.velocity = point_of(spec.velocity),
                                      .strength = spec.strength,
                                      .density = spec.density,
                                      .drag_coefficient = or_usual(spec.drag_coefficient, WindForce{}.drag_coefficient),
                                      .gust = point_of(spec.gust),
                                      .gust_period = or_usual(spec.gust_period, units.per_second),
                                      .gust_size = spec.gust_size,
                                      .seed = seed}};
    case SINEW_ATTRACTOR:
        return ForceSection{AttractorForce{point_of(spec.center), spec.strength,
                                           or_usual(spec.softness, AttractorForce{}.softness * units.per_metre),
                                           spec.figure ? spec.figure : ""}};
    case SINEW_RANDOM_PUSH:
        return ForceSection{RandomPushForce{point_of(spec.low), point_of(spec.high), seed}};
    default:
        return std::nullopt;
    }
}

// --- checks ----------------------------------------------------------------------------------------------------------

/// A field with the range that its numbers have in these units.
Field in_units(Field field, const Units& units) {
    const auto [low, high] = range_in_file(field, units);
    constexpr double largest = 1e30; // as in scenes, within the range of float
    field.low = std::max(low, -largest), field.high = std::min(high, largest);
    return field;
}

std::optional<std::string> problem_of(const Point& point, const Field& field) {
    std::optional<std::string> problem;
    for (int i = 0; i < 3 && !problem; ++i) problem = sinew::detail::problem_of(field, point[i]);
    return problem;
}
template <class Member> std::optional<std::string> problem_of(const Member& member, const Field& field) {
    if constexpr (std::is_same_v<Member, std::int64_t>)
        return std::nullopt; // any seed
    else
        return sinew::detail::problem_of_member(field, member);
}

/// The first number out of the range that scenes allow; nothing if all are right.
std::optional<std::string> problem_of(const ForceSection& section, const Units& units) {
    std::optional<std::string> problem;
    const auto check = [&](const auto& member, const Field& field) {
        if (!problem) problem = ::problem_of(member, in_units(field, units));
    };
    std::visit([&]<class Made>(const Made& force) { Made::fields(force, check); }, section.force);
    return problem;
}

// --- both ways -------------------------------------------------------------------------------------------------------

/// Calls work(law) with the field that a spec describes in a world.
template <int D, class Real, class Work>
sinew_status with_law(const Session& session, const World<D, Real>& world, const sinew_force_spec& spec,
                      const Work& work) {
    const auto units = session.scene().measures();
    const auto section = section_of(spec, units);
    if (!section) return fail(SINEW_BAD_ARGUMENT, "no kind of force has this number");
    if (const auto problem = problem_of(*section, units)) return fail(SINEW_BAD_ARGUMENT, *problem);
    const auto name = pulled_by(*section);
    const auto figure = find_figure(world, name);
    if (!name.empty() && !figure) return fail(SINEW_NOT_FOUND, concat("no figure is called ", in_quotes(name)));
    return work(force_of<D, Real>(session.scene(), *section, figure.value_or(no_figure)));
}

template <int D, class Real> sinew_point as_point(const Vec<D, Real>& vector) {
    Point wide;
    for (int i = 0; i < D; ++i) wide[i] = double(vector[i]);
    return {wide[0], wide[1], wide[2]};
}

/// The spec of a field of a world.
template <class WorldT> class SpecOf {
    static constexpr int D = WorldT::dimension;
    using Real = typename WorldT::Real;

  public:
    SpecOf(const Scene& scene, const WorldT& world) : scene_(scene), world_(world) {}

    sinew_force_spec of(const Force<D, Real>& law) {
        spec_.kind = std::uint32_t(law.index());
        std::visit([&](const auto& force) { set(force); }, law);
        return spec_;
    }

  private:
    const Scene& scene_;
    const WorldT& world_;
    sinew_force_spec spec_{};

    void set(const Gravity<D, Real>& gravity) { spec_.acceleration = as_point(gravity.acceleration); }
    void set(const Drag<D, Real>& drag) { spec_.strength = double(drag.strength); }
    void set(const Wind<D, Real>& wind) {
        spec_.velocity = as_point(wind.velocity), spec_.gust = as_point(wind.gust);
        spec_.strength = double(wind.strength), spec_.density = double(wind.density);
        spec_.drag_coefficient = double(wind.drag_coefficient);
        spec_.gust_period = double(wind.gust_period), spec_.gust_size = double(wind.gust_size);
        spec_.seed = seed_of(scene_, wind.seed);
    }
    void set(const Attractor<D, Real>& attractor) {
        spec_.center = as_point(attractor.center);
        spec_.strength = double(attractor.strength), spec_.softness = double(attractor.softness);
        if (has_figure(world_, attractor.figure)) spec_.figure = world_.figures[attractor.figure].name.c_str();
    }
    void set(const RandomPush<D, Real>& push) {
        spec_.low = as_point(push.low), spec_.high = as_point(push.high);
        spec_.seed = seed_of(scene_, push.seed);
    }
};

/// True for the field that sinew_world_set_gravity() sets.
template <int D, class Real> bool is_gravity_of(const World<D, Real>& world, Row row) {
    return world.forces.tag_of(row) == 0;
}

} // namespace

static_assert(std::is_same_v<std::variant_alternative_t<SINEW_GRAVITY, Force<2, double>>, Gravity<2, double>> &&
              std::is_same_v<std::variant_alternative_t<SINEW_DRAG, Force<2, double>>, Drag<2, double>> &&
              std::is_same_v<std::variant_alternative_t<SINEW_WIND, Force<2, double>>, Wind<2, double>> &&
              std::is_same_v<std::variant_alternative_t<SINEW_ATTRACTOR, Force<2, double>>, Attractor<2, double>> &&
              std::is_same_v<std::variant_alternative_t<SINEW_RANDOM_PUSH, Force<2, double>>, RandomPush<2, double>>);

extern "C" {

sinew_status sinew_world_add_force(sinew_world simulation, const sinew_force_spec* given, sinew_force* force) {
    sinew_force_spec spec;
    if (const auto status = take(given, spec)) return status;
    if (!force) return null_argument();
    return change(simulation, [&](Session& session) {
        return std::visit(
            [&](auto& world) {
                return with_law(session, world, spec, [&](const auto& law) {
                    *force = number_of(world.forces.push_back(law));
                    return SINEW_OK;
                });
            },
            session.world());
    });
}

sinew_status sinew_world_set_force(sinew_world simulation, sinew_force force, const sinew_force_spec* given) {
    sinew_force_spec spec;
    if (const auto status = take(given, spec)) return status;
    return change(simulation, [&](Session& session) {
        return std::visit(
            [&](auto& world) {
                const auto row = world.forces.row_of(id_of<ForceTag>(force));
                if (!row) return bad_id("force");
                if (is_gravity_of(world, *row) && spec.kind != SINEW_GRAVITY)
                    return fail(SINEW_BAD_ARGUMENT, "the world's gravity has no other kind: set it to zero");
                return with_law(session, world, spec, [&](const auto& law) {
                    world.forces[*row] = law;
                    return SINEW_OK;
                });
            },
            session.world());
    });
}

sinew_status sinew_world_get_force(sinew_world simulation, sinew_force force, sinew_force_spec* spec) {
    if (const auto status = can_fill(spec)) return status;
    return read(simulation, [&](const Simulation&, const Session& session) {
        return std::visit(
            [&](const auto& world) {
                const auto* law = world.forces.find(id_of<ForceTag>(force));
                if (!law) return bad_id("force");
                fill_sized(SpecOf(session.scene(), world).of(*law), spec);
                return SINEW_OK;
            },
            session.world());
    });
}

sinew_status sinew_world_remove_force(sinew_world simulation, sinew_force force) {
    return change(simulation, [&](Session& session) {
        return std::visit(
            [&](auto& world) {
                const auto row = world.forces.row_of(id_of<ForceTag>(force));
                if (!row) return bad_id("force");
                if (is_gravity_of(world, *row))
                    return fail(SINEW_BAD_ARGUMENT, "the world's gravity is not removed: set it to zero");
                world.forces.remove(id_of<ForceTag>(force));
                return SINEW_OK;
            },
            session.world());
    });
}

sinew_status sinew_world_force_at(sinew_world simulation, uint32_t index, sinew_force* force) {
    if (!force) return null_argument();
    return read(simulation, [&](const Simulation&, const Session& session) {
        return std::visit(
            [&](const auto& world) {
                if (index >= world.forces.size()) return fail(SINEW_NOT_FOUND, "there are fewer forces");
                *force = number_of(world.forces.id_of(index));
                return SINEW_OK;
            },
            session.world());
    });
}

} // extern "C"
