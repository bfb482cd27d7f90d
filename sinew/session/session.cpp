#include "sinew/session/session.h"

#include "sinew/assert/assert.h"
#include "sinew/scene/check.h"
#include "sinew/scene/reader.h"
#include "sinew/scene/surroundings.h"
#include "sinew/scene/text.h"
#include "sinew/session/collider_motion.h"
#include "sinew/session/event_applier.h"
#include "sinew/session/focus.h"
#include "sinew/session/pair_contacts.h"
#include "sinew/session/view.h"
#include "sinew/solver/solver.h"
#include "sinew/topology/cut.h"
#include "sinew/topology/vertex_split.h"
#include "sinew/world/edit.h"
#include "sinew/world/islands.h"
#include "sinew/world/measure.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew {
namespace {

/// The solver of a type of world; made anew, with the same options, where the type has changed.
template <class WorldT> auto& solver_of(AnySolver& any) {
    using Own = Solver<WorldT::dimension, typename WorldT::Real>;
    if (!std::holds_alternative<Own>(any)) any = Own(std::visit([](const auto& other) { return other.options; }, any));
    return std::get<Own>(any);
}

template <class WorldT> using VectorOf = typename WorldT::Vector;

/// Touches are reported for sensors; of obstacles and the ground there would be too many.
template <class WorldT> bool is_worth_noting(const WorldT& world, const Event& event) {
    if (event.type == EventType::torn || event.type == EventType::quarantined) return true;
    const auto row = world.collider_handles.find(event.collider);
    return row && world.colliders[*row].is_sensor;
}

template <class WorldT> bool is_link(const Event& torn) {
    return torn.constraint.kind == kind_number<Distance, WorldT::dimension>;
}

} // namespace

Session::Session(Opened opened)
    : scene_(std::move(opened.scene)), world_(std::move(opened.world)), images_(std::move(opened.images)),
      focus_(focus_of(scene_, world_)) {
    plan_events();
    find_driven();
    note_parted();
    history_.restart(scene_, world_);
}

Session::Session(const Session&) = default;
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(const Session&) = default;
Session& Session::operator=(Session&&) noexcept = default;
Session::~Session() = default;

void Session::restart() {
    world_ = instantiate(scene_);
    if (shows_nothing(focus_of(scene_, world_))) focus_ = {};
    find_driven();
    build_level();
    islands_.clear();
    note_parted();
    plan_events();
    hand_.reset();
    hands_.clear();
    stroke_.reset();
    taken_over_ = false;
    grabs_.clear();
    collider_moves_.clear();
    blowing_.clear();
    happenings_.clear();
    happening_count_ = 0;
    history_.restart(scene_, world_);
}

void Session::play(std::shared_ptr<Level> level) {
    level_ = std::move(level);
    restart();
}

void Session::build_level() {
    level_memory_.assign(level_ ? level_->memory() : 0, std::byte{});
    steering_.restart();
    added_.clear();
    if (!level_) return;
    set_contact_filter({}); // that of the code before
    level_->build(*this);
}

std::array<Point, 2> Session::focus() const {
    return shows_nothing(focus_) ? focus_of(scene_, world_) : focus_;
}

double Session::seconds() const {
    const double time = std::visit([](const auto& world) { return world.time; }, world_);
    return time / scene_.measures().per_second;
}

void Session::run_until(double seconds) {
    const double half_a_step = 0.5 / scene_.solver.rate; // the clock is a sum of steps: rounding must not add one more
    while (this->seconds() < seconds - half_a_step) step();
}

void Session::set_options(const SolverOptions& options) {
    auto reports = std::visit([](auto& solver) { return std::move(solver.reports); }, solver_);
    std::visit([&]<class WorldT>(
                   const WorldT&) { solver_.emplace<Solver<WorldT::dimension, typename WorldT::Real>>(options); },
               world_);
    set_reports(reports);
}

SolverOptions Session::options() const {
    return std::visit([](const auto& solver) { return solver.options; }, solver_);
}

void Session::set_contact_filter(const ContactFilter& filter) {
    std::visit([&](auto& solver) { solver.options.contact_filter = filter; }, solver_);
}

void Session::set_reports(const SolverReports& reports) {
    std::visit([&](auto& solver) { solver.reports = reports; }, solver_);
}

void Session::prepare() {
    std::visit([&]<class WorldT>(WorldT& world) { solver_of<WorldT>(solver_).prepare(world); }, world_);
}

void Session::step() {
    const double dt = step_length(scene_);
    focus_ = focus();
    happen_now();
    still_gusts();
    drive();
    winder_.run(scene_, world_);
    if (level_) level_->step(*this);
    steering_.run(scene_, world_);
    grabs_.carry(world_, dt);
    const auto frozen = freeze_hovered();
    if (hand_) hand_->carry(world_);
    for (const auto& hand : hands_) hand.carry(world_);
    if (stroke_) stroke_->go(world_, stroke_to_);
    std::visit(
        [&]<class WorldT>(WorldT& world) {
            auto& solver = solver_of<WorldT>(solver_);
            const PairContacts<WorldT> pairs(scene_, world, solver.options.contact_filter);
            solver.step(world, typename WorldT::Real(dt));
            if (frozen) unpin(world, *frozen);
        },
        world_);
    if (level_) level_->stepped(*this);
    note_events();
    happen_on_contact();
    history_.record(scene_, world_);
}

void Session::plan_events() {
    due_.clear();
    for (std::size_t i = 0; i < scene_.events.size(); ++i)
        if (!scene_.events[i].on) due_.push_back({scene_.events[i].first(), i});
    std::make_heap(due_.begin(), due_.end());
    rules_.restart(scene_, world_);
}

void Session::happen_on_contact() {
    for (auto& met : rules_.met(scene_, world_)) {
        const auto& event = scene_.events[met.event];
        note({.what = event.on->phase, .where = event.on->of, .with = std::move(met.with), .impulse = met.impulse});
        happen(event, met.before);
    }
}

void Session::happen_now() {
    const double now = std::visit([](const auto& world) { return world.time; }, world_);
    while (!due_.empty() && due_.front().at <= now + step_length(scene_) * 1e-6) {
        std::pop_heap(due_.begin(), due_.end());
        auto& due = due_.back();
        SINEW_ASSERT(due.event < scene_.events.size(), "a due event is one of the scene");
        const auto& event = scene_.events[due.event];
        happen(event, due.before++);
        if (event.every > 0 && (event.times == 0 || due.before < std::uint64_t(event.times))) {
            due.at = event.first() + event.every * double(due.before);
            std::push_heap(due_.begin(), due_.end());
        } else {
            due_.pop_back();
        }
    }
}

void Session::happen(const EventSection& event, std::uint64_t before) {
    detail::visit_held(event.event, [&]<class Event>(const Event& happening) {
        const auto where = apply(happening, before);
        if (!where) return;
        note(std::string(Event::name), *where);
        if constexpr (std::is_same_v<Event, RemoveEvent>) note_parted();
    });
}

Session::Noted Session::apply(const GrabEvent& grab, std::uint64_t) {
    if (taken_over_ || !grabs_.begin(world_, scene_, grab)) return std::nullopt;
    return grab.particle;
}

Session::Noted Session::apply(const ReleaseEvent& release, std::uint64_t) {
    grabs_.release(world_, release.particle);
    std::visit(
        [&](auto& world) {
            if (const auto id = find_particle(world, release.particle)) unpin_all(world, *id);
        },
        world_);
    return release.particle;
}

Session::Noted Session::apply(const GustEvent& gust, std::uint64_t) {
    std::visit(
        [&]<int D, class Real>(World<D, Real>& world) {
            const auto wind = world.forces.push_back(wind_of<D, Real>(gust, scene_.measures()));
            blowing_.push_back({wind, world.time + gust.duration});
        },
        world_);
    return "";
}

Session::Noted Session::apply(const CutEvent& event, std::uint64_t) {
    if (cut(event.line, event.within) > 0) return std::nullopt;
    return "";
}

Session::Noted Session::apply(const AddEvent& event, std::uint64_t before) {
    const auto original = std::ranges::find(scene_.figures, event.figure, [](const auto& one) { return name_of(one); });
    if (original == scene_.figures.end() || before >= AddEvent::most) return std::nullopt;
    auto copy = *original;
    const auto exists = [&](const std::string& name) {
        return std::visit([&](const auto& world) { return find_figure(world, name).has_value(); }, world_);
    };
    for (auto number = before + 1; copy.name = concat(event.figure, "_", number), exists(copy.name);) ++number;
    if (event.to) copy.at = *event.to;
    if (event.velocity) copy.velocity = *event.velocity;
    add(copy, event.figure);
    note_parted();
    return copy.name;
}

Session::Noted Session::apply(const ColliderEvent& event, std::uint64_t before) {
    collider_moves_.begin(world_, scene_, event);
    return std::visit(
        [&]<class WorldT>(WorldT& world) {
            return EventApplier<WorldT>{world, scene_, before}(event);
        },
        world_);
}

template <class Event> Session::Noted Session::apply(const Event& event, std::uint64_t before) {
    auto where = std::visit(
        [&]<class WorldT>(WorldT& world) {
            return EventApplier<WorldT>{world, scene_, before}(event);
        },
        world_);
    if (std::is_same_v<Event, JoinEvent> && where.empty()) return std::nullopt;
    return where;
}

std::size_t Session::cut(const std::array<Point, 2>& line, std::optional<double> within) {
    return cut(line, within, view(scene_.view.size[0], scene_.view.size[1]));
}

std::size_t Session::cut(const std::array<Point, 2>& line, std::optional<double> within, const View& view) {
    const double radius = within.value_or(scene_.pointer.cut_radius);
    return std::visit(
        [&]<class WorldT>(WorldT& world) {
            Cut done;
            if constexpr (WorldT::dimension == 2) {
                done = sinew::cut(world, Blade{line[0].as<2, double>(), line[1].as<2, double>(), radius});
            } else {
                const auto from = view.see(line[0].as<3, double>()), to = view.see(line[1].as<3, double>());
                if (!from || !to) return done.links;
                const Projection<3> see = [&view](const Vec3<double>& position) {
                    constexpr double nowhere = std::numeric_limits<double>::infinity();
                    const auto seen = view.see(position);
                    return seen ? cast<double>(seen->pixel) : Vec2<double>{{nowhere, nowhere}};
                };
                const double scale = (double(from->scale) + double(to->scale)) / 2;
                done =
                    sinew::cut(world, Blade{cast<double>(from->pixel), cast<double>(to->pixel), radius * scale}, see);
            }
            for (const auto figure : done.figures)
                note(std::string(CutEvent::name), figure < world.figures.size() ? world.figures[figure].name : "");
            if (done.links > 0) note_parted();
            return done.links;
        },
        world_);
}

/// The scene's pins are the last pins of the world, in the scene's order; a name with a star stands for several pins.
void Session::find_driven() {
    winder_.find(scene_, world_);
    const double now = std::visit([](const auto& world) { return world.time; }, world_);
    move_colliders(scene_, pointer_, now, Arrival::at_once, world_);
    driven_.clear();
    std::visit(
        [&]<class WorldT>(WorldT& world) {
            std::size_t row = world.pins.size();
            for (std::size_t i = scene_.pins.size(); i-- > 0;)
                for (auto left = find_particles(world, scene_.pins[i].particle).size(); left-- > 0 && row-- > 0;) {
                    if (!scene_.pins[i].driver) continue;
                    Point rest;
                    for (int k = 0; k < WorldT::dimension; ++k) rest[k] = double(world.pins[row].target[k]);
                    driven_.push_back({world.pin_handles.id_of(Row(row)), i, rest});
                }
        },
        world_);
}

void Session::drive() {
    const int up = scene_.units.up == "-y" ? -1 : 1;
    const double now = std::visit([](const auto& world) { return world.time; }, world_);
    move_colliders(scene_, pointer_, now + step_length(scene_), Arrival::in_a_step, world_);
    collider_moves_.carry(world_, scene_, step_length(scene_));
    std::visit(
        [&]<class WorldT>(WorldT& world) {
            const double then = world.time + step_length(scene_);
            for (auto& driven : driven_) {
                SINEW_ASSERT(scene_.pins[driven.section].driver.has_value(), "pins with a driver are driven");
                const auto& driver = *scene_.pins[driven.section].driver;
                const auto* follower = std::get_if<PointerDriver>(&driver);
                const auto position = pointer_ && follower ? *pointer_ : driven_to(driver, driven.rest, then, up);
                move_pin(world, driven.pin, position.template as<WorldT::dimension, typename WorldT::Real>());
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

/// Classic mode: pins, for one step, the last added particle whose square contains the pointer.
std::optional<PinId> Session::freeze_hovered() {
    if (!scene_.solver.rules.hover_freezes || scene_.solver.mode != "classic" || !pointer_) return std::nullopt;
    return std::visit(
        [&]<class WorldT>(WorldT& world) -> std::optional<PinId> {
            using Real = typename WorldT::Real;
            const auto& p = world.particles;
            const auto position = pointer_->as<WorldT::dimension, Real>();
            const Real half = Real(scene_.pointer.hover_size / 2);
            for (Row row = Row(p.size()); row-- > 0;) {
                const auto away = p.position[row] - position;
                if (p.mobility[row] > Real(0) && clamp_components(away, half) == away)
                    return pin(world, p.handles.id_of(row), {.hold = Hold::frozen});
            }
            return std::nullopt;
        },
        world_);
}

void Session::still_gusts() {
    std::visit(
        [&](auto& world) {
            std::erase_if(blowing_, [&](const Blowing& gust) {
                const bool is_over = world.time >= gust.until;
                if (is_over) world.forces.remove(gust.force);
                return is_over;
            });
        },
        world_);
}

void Session::note(std::string what, std::string where, std::size_t islands) {
    note({.what = std::move(what), .where = std::move(where), .islands = islands});
}

void Session::note(SessionEvent event) {
    event.seconds = seconds();
    if (happening_count_++ < max_happenings) happenings_.push_back(std::move(event));
}

/// Notes every figure whose number of islands has grown.
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
                if (is_worth_noting(world, event))
                    note(std::string(world_event_names[std::size_t(event.type)]),
                         event.figure < world.figures.size() ? world.figures[event.figure].name : "");
                if (event.type == EventType::torn && is_link<std::decay_t<decltype(world)>>(event))
                    gone.push_back(event.ends);
            }
            if (!gone.empty()) come_apart(world, std::span<const Ends>(gone));
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
                          .energy_lost = energies.lost,
                          .stretch_max = strains.max,
                          .stretch_mean = strains.mean,
                          .max_speed = max_speed(world)};
            for_each_table(world, [&](const auto& table) { report.constraints += table.size(); });
            return report;
        },
        world_);
}

Vec2<double> Session::position_of(Vec2<double> pixel, int width, int height) const {
    return view(width, height).position_of(pixel);
}

std::vector<ParticleId> Session::held_particles() const {
    std::vector<ParticleId> all;
    if (hand_) all = hand_->members;
    for (const auto& hand : hands_) all.insert(all.end(), hand.members.begin(), hand.members.end());
    const auto held = grabs_.particles(world_);
    all.insert(all.end(), held.begin(), held.end());
    return all;
}

} // namespace sinew
