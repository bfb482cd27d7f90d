#include "sinew/session/session.h"

#include "sinew/scene/reader.h"
#include "sinew/session/driver.h"
#include "sinew/session/view.h"
#include "sinew/solver/cut.h"
#include "sinew/solver/edit.h"
#include "sinew/solver/islands.h"
#include "sinew/solver/measure.h"
#include "sinew/solver/sever.h"
#include "sinew/solver/step.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew {
namespace {

template <class WorldT> using VectorOf = typename WorldT::Vector;

template <class WorldT> Gravity<WorldT::dimension, typename WorldT::Real>* gravity_of(WorldT& world) {
    return world.forces.empty() ? nullptr
                                : std::get_if<Gravity<WorldT::dimension, typename WorldT::Real>>(&world.forces.front());
}

template <class WorldT> bool is_link(const Event& torn) {
    return torn.constraint.kind == kind_number<Distance, WorldT::dimension>;
}

/// What an event does to a world. Returns where it happened, as the scene calls it.
template <class WorldT> struct Doer {
    using Real = typename WorldT::Real;
    static constexpr int D = WorldT::dimension;
    WorldT& world;

    std::string operator()(const ImpulseEvent& impulse) const {
        const auto by = impulse.by.template as<D, Real>();
        if (const auto particle = find_particle(world, impulse.target)) {
            apply_impulse(world, *particle, by);
        } else if (const auto figure = find_figure(world, impulse.target)) {
            strike(world.figures[*figure], by);
        }
        return impulse.target;
    }

    std::string operator()(const SnipEvent& snip) const {
        std::vector<ConstraintId> ids;
        for (const auto& name : snip.constraints)
            if (const auto id = find_constraint(world, name)) ids.push_back(*id);
        cut(world, std::span<const ConstraintId>(ids));
        return snip.constraints.empty() ? "" : snip.constraints.front();
    }

    std::string operator()(const SetEvent& set) const {
        const auto& to = set.changes;
        auto& settings = world.settings;
        if (auto* gravity = gravity_of(world); gravity && to.gravity)
            gravity->acceleration = to.gravity->template as<D, Real>();
        if (to.damping) (settings.mode == Mode::classic ? settings.classic.keep : settings.damping) = Real(*to.damping);
        if (to.bounce) settings.classic.bounce = Real(*to.bounce);
        for (auto& plane : world.bounds) {
            if (to.bounce) plane.restitution = Real(*to.bounce);
            if (to.friction) plane.friction = Real(*to.friction);
        }
        if (to.time_scale) settings.classic.time_scale = Real(*to.time_scale);
        if (to.substeps) settings.substeps = *to.substeps;
        if (to.iterations) settings.iterations = *to.iterations;
        if (to.passes) settings.classic.passes = *to.passes;
        return "";
    }

  private:
    /// A figure takes a blow as one body: every particle gets the same change of velocity.
    void strike(const Figure& figure, const Vec<D, Real>& by) const {
        Real mass = 0;
        for (const auto id : figure.particles)
            if (const auto row = row_of(world, id)) mass += inverse_or_zero(world.particles.mobility[*row]);
        for (const auto id : figure.particles)
            if (const auto row = row_of(world, id); row && world.particles.mobility[*row] > Real(0))
                set_velocity(world, id, world.particles.velocity[*row] + by * inverse_or_zero(mass));
    }
};

} // namespace

Session::Session(Opened opened)
    : scene_(std::move(opened.scene)), world_(std::move(opened.world)), images_(std::move(opened.images)),
      focus_(focus_of(scene_, world_)) {
    std::stable_sort(scene_.events.begin(), scene_.events.end(),
                     [](const EventSection& a, const EventSection& b) { return a.at < b.at; });
    find_driven();
    note_parted();
}

void Session::restart() {
    world_ = instantiate(scene_);
    islands_.clear();
    note_parted();
    find_driven();
    next_event_ = 0;
    held_.clear();
    blowing_.clear();
    happenings_.clear();
    happening_count_ = 0;
}

double Session::seconds() const {
    const double time = std::visit([](const auto& world) { return world.time; }, world_);
    return time / scene_.measures().per_second;
}

void Session::run_until(double seconds) {
    const double half_a_step = 0.5 / scene_.solver.rate; // time is a sum of steps: never one more for its rounding
    while (this->seconds() < seconds - half_a_step) step();
}

void Session::step() {
    const double now = std::visit([](const auto& world) { return world.time; }, world_);
    const double dt = step_length(scene_);
    while (next_event_ < scene_.events.size() && scene_.events[next_event_].at <= now + dt * 1e-6)
        happen(scene_.events[next_event_++]);
    still_gusts();
    drive();
    winder_.run(scene_, world_);
    carry_held();
    std::visit([&]<class WorldT>(WorldT& world) { sinew::step(world, typename WorldT::Real(dt)); }, world_);
    note_events();
}

void Session::happen(const EventSection& event) {
    const double now = std::visit([](const auto& world) { return world.time; }, world_);
    std::visit(
        [&]<class WorldT>(WorldT& world) {
            using Real = typename WorldT::Real;
            constexpr int D = WorldT::dimension;
            const auto let_go = [&](const std::string& particle) {
                std::erase_if(held_, [&](const Held& held) {
                    if (held.particle != particle) return false;
                    unpin(world, held.pin);
                    return true;
                });
            };
            detail::visit_held(event.event, [&]<class Event>(const Event& happening) {
                std::string where;
                if constexpr (std::is_same_v<Event, GrabEvent>) {
                    where = happening.particle;
                    let_go(where);
                    const auto id = find_particle(world, where);
                    if (!id) return;
                    Point from;
                    for (int i = 0; i < D; ++i) from[i] = double((*position_of(world, *id))[i]);
                    const auto held = pin(world, *id,
                                          PinSpec<D, Real>{.compliance = Real(happening.compliance),
                                                           .max_force = Real(happening.max_force)});
                    held_.push_back({where, *held, from, happening.to.value_or(from), now, happening.over});
                } else if constexpr (std::is_same_v<Event, ReleaseEvent>) {
                    where = happening.particle;
                    let_go(where);
                    if (const auto id = find_particle(world, where)) unpin_all(world, *id);
                } else if constexpr (std::is_same_v<Event, GustEvent>) {
                    blowing_.push_back({world.forces.size(), now + happening.over});
                    world.forces.push_back(Wind<D, Real>{.velocity = happening.velocity.template as<D, Real>(),
                                                         .strength = Real(happening.strength)});
                } else if constexpr (std::is_same_v<Event, CutEvent>) {
                    if (cut(happening.line, happening.within) > 0) return; // has told of it
                } else {
                    where = Doer<WorldT>{world}(happening);
                }
                note(std::string(Event::name), where);
                if constexpr (std::is_same_v<Event, SnipEvent>) note_parted();
            });
        },
        world_);
}

std::size_t Session::cut(const std::array<Point, 2>& line, std::optional<double> within) {
    const double reach = within.value_or(scene_.pointer.cuts_within);
    return std::visit(
        [&]<class WorldT>(WorldT& world) {
            Cut done;
            if constexpr (WorldT::dimension == 2) {
                done = sinew::cut(world, Blade{line[0].as<2, double>(), line[1].as<2, double>(), reach});
            } else {
                const View view(scene_, focus_, scene_.view.size[0], scene_.view.size[1]);
                const auto from = view.see(line[0].as<3, double>()), to = view.see(line[1].as<3, double>());
                if (!from || !to) return done.links;
                std::vector<Vec2<double>> pixels;
                pixels.reserve(world.particles.size());
                for (const auto& place : world.particles.position) {
                    constexpr double nowhere = std::numeric_limits<double>::infinity();
                    const auto seen = view.see(cast<double>(place));
                    pixels.push_back(seen ? cast<double>(seen->pixel) : Vec2<double>{{nowhere, nowhere}});
                }
                const double scale = (double(from->scale) + double(to->scale)) / 2;
                done = sinew::cut(world, Blade{cast<double>(from->pixel), cast<double>(to->pixel), reach * scale},
                                  std::span<const Vec2<double>>(pixels));
            }
            for (const auto figure : done.figures)
                note(std::string(CutEvent::name), figure < world.figures.size() ? world.figures[figure].name : "");
            if (done.links > 0) note_parted();
            return done.links;
        },
        world_);
}

/// The scene's pins are the last that were made, in its order.
void Session::find_driven() {
    winder_.find(scene_, world_);
    driven_.clear();
    std::visit(
        [&]<class WorldT>(WorldT& world) {
            std::size_t row = world.pins.size();
            for (std::size_t i = scene_.pins.size(); i-- > 0 && row-- > 0;) {
                if (!scene_.pins[i].driver) continue;
                Point rest;
                for (int k = 0; k < WorldT::dimension; ++k) rest[k] = double(world.pins[row].target[k]);
                driven_.push_back({world.pin_slots.id_of(Row(row)), i, rest});
            }
        },
        world_);
}

void Session::drive() {
    const int up = scene_.units.up == "-y" ? -1 : 1;
    std::visit(
        [&]<class WorldT>(WorldT& world) {
            const double then = world.time + step_length(scene_);
            for (const auto& driven : driven_) {
                const auto& driver = *scene_.pins[driven.section].driver;
                const bool follows = pointer_ && std::holds_alternative<PointerDriver>(driver);
                const auto place = follows ? *pointer_ : driven_to(driver, driven.rest, then, up);
                move_pin(world, driven.pin, place.template as<WorldT::dimension, typename WorldT::Real>());
            }
        },
        world_);
}

std::optional<Point> Session::pointer() const {
    if (pointer_) return pointer_;
    const double now = std::visit([](const auto& world) { return world.time; }, world_);
    const int up = scene_.units.up == "-y" ? -1 : 1;
    for (const auto& driven : driven_) {
        const auto& driver = *scene_.pins[driven.section].driver;
        if (std::holds_alternative<PointerDriver>(driver)) return driven_to(driver, driven.rest, now, up);
    }
    return std::nullopt;
}

void Session::carry_held() {
    std::visit(
        [&]<class WorldT>(WorldT& world) {
            using Real = typename WorldT::Real;
            const double then = world.time + step_length(scene_);
            for (const auto& held : held_) {
                const double share = held.over > 0 ? clamp((then - held.since) / held.over, 0.0, 1.0) : 1.0;
                move_pin(world, held.pin, VectorOf<WorldT>::map([&](int i) {
                             return Real(held.from[i] + (held.to[i] - held.from[i]) * share);
                         }));
            }
        },
        world_);
}

void Session::still_gusts() {
    std::visit(
        [&](auto& world) {
            for (std::size_t i = 0; i < blowing_.size();) {
                if (world.time < blowing_[i].until) {
                    ++i;
                    continue;
                }
                world.forces.erase(world.forces.begin() + std::ptrdiff_t(blowing_[i].force));
                for (auto& other : blowing_)
                    if (other.force > blowing_[i].force) --other.force;
                blowing_.erase(blowing_.begin() + std::ptrdiff_t(i));
            }
        },
        world_);
}

void Session::note(std::string what, std::string where, std::size_t islands) {
    if (happening_count_++ < most_happenings)
        happenings_.push_back({seconds(), std::move(what), std::move(where), islands});
}

/// Tells of figures that fell into more islands than before.
void Session::note_parted() {
    std::visit(
        [&](const auto& world) {
            auto now = islands(world);
            for (std::size_t i = 0; i < now.size(); ++i)
                if (i < islands_.size() && now[i] > islands_[i]) note("parted", world.figures[i].name, now[i]);
            islands_ = std::move(now);
        },
        world_);
}

void Session::note_events() {
    std::visit(
        [&](auto& world) {
            std::vector<Ends> gone;
            bool any_torn = false;
            for (const auto& event : world.events) {
                any_torn = any_torn || event.type == EventType::torn;
                note(event.type == EventType::torn ? "torn" : "quarantined",
                     event.figure < world.figures.size() ? world.figures[event.figure].name : "");
                if (event.type == EventType::torn && is_link<std::decay_t<decltype(world)>>(event))
                    gone.push_back(event.ends);
            }
            sever(world, std::span<const Ends>(gone));
            if (any_torn) note_parted();
        },
        world_);
}

Report Session::report() const {
    return std::visit(
        [&](const auto& world) {
            const auto energies = energy(world);
            const auto strains = stretch(world);
            Report report{.seconds = seconds(),
                          .steps = world.steps,
                          .particles = world.particles.size(),
                          .hash = state_hash(world),
                          .kinetic = energies.kinetic,
                          .potential = energies.potential,
                          .stored = energies.stored,
                          .stretch_max = strains.max,
                          .stretch_mean = strains.mean,
                          .max_speed = max_speed(world)};
            for_each_table(world, [&](const auto& table) { report.constraints += table.size(); });
            return report;
        },
        world_);
}

} // namespace sinew
