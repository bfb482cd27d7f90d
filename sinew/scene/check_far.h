#pragma once

#include "sinew/math/format.h"
#include "sinew/scene/check.h"
#include "sinew/scene/types.h"
#include "sinew/world/edit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

/// Warnings of holds and joints over a long way.
namespace sinew {

/// Pins, grabs and joints with speeds of more than `fastest` at hand: soft ones by energy, rigid ones by the distance
/// closed in one step. Damping and lagging links take some of the speed.
template <int D, class Real> class FarCheck {
  public:
    using Vector = Vec<D, Real>;

    FarCheck(const Scene& scene, const World<D, Real>& world, Document& document)
        : scene_(scene), world_(world), document_(document) {}

    void run() {
        if (scene_.solver.mode == "classic") return;
        note_motion();
        for (std::size_t i = 0; i < scene_.pins.size(); ++i) pin(scene_.pins[i], i);
        for (std::size_t i = 0; i < scene_.events.size(); ++i) {
            if (!is_foreseen(scene_.events[i])) continue;
            if (const auto* grab = std::get_if<GrabEvent>(&scene_.events[i].event)) this->grab(*grab, i);
            if (const auto* join = std::get_if<JoinEvent>(&scene_.events[i].event)) this->join(*join, i);
        }
    }

  private:
    static constexpr double fastest = 100; ///< m/s: three times the speed of a fall of 50 m
    const Scene& scene_;
    const World<D, Real>& world_;
    Document& document_;
    std::map<FigureIndex, double> masses_; ///< moving mass of a figure, once asked for
    bool is_driven_ = false;               ///< by more than gravity
    /// Times of the first and the second event with an effect on motion.
    std::array<double, 2> moves_{limit::measure<double>, limit::measure<double>};

    double bound() const { return fastest * scene_.measures().scale(unit::speed); }
    std::string with_unit(double value, Unit unit) const {
        constexpr double large = 1000; // whole numbers from there on
        return concat(value < large ? number_text(value, 3) : number_text(std::round(value), 6), " ",
                      scene_.measures().text(unit));
    }

    std::optional<Row> row_called(std::string_view name) const {
        const auto id = find_particle(world_, name);
        return id ? row_of(world_, *id) : std::nullopt;
    }
    bool is_held(Row row) const { return world_.particles.mobility[row] == Real(0); }
    const Vector& position(Row row) const { return world_.particles.position[row]; }

    double mass(Row row) const { return inverse_or_zero(double(world_.particles.inverse_mass[row])); }
    /// Moving mass of the figure of a particle.
    double mass_with(Row row) {
        const auto figure = world_.particles.figure[row];
        if (!has_figure(world_, figure)) return mass(row);
        const auto [known, is_first] = masses_.try_emplace(figure, 0);
        if (is_first)
            for (const auto id : world_.figures[figure].particles)
                if (const auto member = row_of(world_, id); member && !is_held(*member)) known->second += mass(*member);
        return known->second;
    }

    /// Largest speed of a mass held from so far away.
    double speed(double far, double compliance, double max_force, double mass, double time) const {
        double energy = compliance > 0 ? 0.5 * square(far) / compliance : limit::measure<double>;
        if (max_force > 0) energy = std::min(energy, max_force * far);
        const bool is_soft = compliance > 0 || max_force > 0;
        return is_soft ? std::sqrt(2 * energy / mass) : far / std::max(time, step_length(scene_));
    }

    void pin(const PinSection& pin, std::size_t i) {
        if (pin.steer || !pin.to) return;
        double fast = 0, distant = 0;
        for (const auto id : find_particles(world_, pin.particle)) {
            const Row row = *row_of(world_, id);
            const double far = double(distance(position(row), pin.to->as<D, Real>())), heavy = mass_with(row);
            const double by = speed(far, pin.grip.compliance, pin.grip.max_force, heavy > 0 ? heavy : 1, 0);
            if (by > fast) fast = by, distant = far;
        }
        if (fast > bound())
            document_.warn(under("pins", i, "to"),
                           format_text("this pin begins {} from {}, which it throws at up to {}: more than {}",
                                       with_unit(distant, unit::length), in_quotes(pin.particle),
                                       with_unit(fast, unit::speed), with_unit(bound(), unit::speed)),
                           "begin nearer, or give the pin more compliance, a max_force or a driver that carries it");
    }

    /// Notes causes of motion beside gravity.
    void note_motion() {
        const auto has_drive = [](const ConstraintSection& constraint) { return constraint.drive.has_value(); };
        const auto is_driven = [&](const FigureSection& figure) {
            const auto* by_hand = std::get_if<ByHand>(&figure.made);
            return std::holds_alternative<Character>(figure.made) || std::holds_alternative<Car>(figure.made) ||
                   (by_hand && std::ranges::any_of(by_hand->constraints, has_drive));
        };
        is_driven_ = !scene_.world.forces.empty() || std::ranges::any_of(scene_.constraints, has_drive) ||
                     std::ranges::any_of(scene_.figures, is_driven) ||
                     std::ranges::any_of(scene_.pins, [](const auto& pin) { return pin.driver || pin.to; }) ||
                     std::ranges::any_of(scene_.colliders, [](const auto& one) { return one.motion.has_value(); });
        for (const auto& section : scene_.events) {
            if (std::holds_alternative<NoteEvent>(section.event)) continue;
            if (section.first() < moves_[1]) moves_[1] = section.first();
            if (moves_[1] < moves_[0]) std::swap(moves_[0], moves_[1]);
        }
    }
    /// True if places at the time of an event are about those of free flight: no event has moved anything before.
    bool is_foreseen(const EventSection& section) const {
        if (section.on || section.every > 0) return false;
        return section.first() == 0 || (!is_driven_ && section.first() == moves_[0] && moves_[0] < moves_[1]);
    }
    /// Way of a particle until a time, by speed or by gravity.
    double flight(Row row, double time) const {
        return is_held(row) ? 0 : double(norm(world_.particles.velocity[row])) * time;
    }
    double fall(double time) const { return 0.5 * double(norm(scene_.world.gravity.as<D, Real>())) * square(time); }

    void grab(const GrabEvent& grab, std::size_t i) {
        const auto row = row_called(grab.particle);
        const bool is_soft = grab.grip.compliance > 0 || grab.grip.max_force > 0;
        if (!row || !grab.to || (is_soft && grab.duration > 0)) return;
        const double time = scene_.events[i].first();
        const double far = double(distance(position(*row), grab.to->as<D, Real>())) - flight(*row, time) -
                           (is_held(*row) ? 0 : fall(time));
        const double heavy = mass_with(*row);
        const double fast = speed(far, grab.grip.compliance, grab.grip.max_force, heavy > 0 ? heavy : 1, grab.duration);
        if (far > 0 && fast > bound())
            document_.warn(under("events", i, "grab"),
                           format_text("this grab takes {} at least {} away, at up to {}: more than {}",
                                       in_quotes(grab.particle), with_unit(far, unit::length),
                                       with_unit(fast, unit::speed), with_unit(bound(), unit::speed)),
                           is_soft ? "give it a duration, more compliance or a smaller max_force"
                                   : "give it a longer duration, or a compliance and a max_force");
    }

    void join(const JoinEvent& join, std::size_t i) {
        const auto& section = join.constraint;
        const auto a = row_called(section.between.front()), b = row_called(section.between.back());
        const bool has_limits = section.rest || section.low || section.high;
        if (!a || !b || !has_limits || join.within > 0 || section.kind != Distance<D>::name) return;
        const double high = section.rest.value_or(section.high.value_or(limit::measure<double>));
        const double time = scene_.events[i].first();
        const double far = double(distance(position(*a), position(*b))) - high - flight(*a, time) - flight(*b, time) -
                           (is_held(*a) && is_held(*b) ? 0 : fall(time));
        const double fast = speed(far, section.compliance, section.max_force, reduced_mass(*a, *b), 0);
        if (far > 0 && fast > bound())
            document_.warn(under("events", i, "join"),
                           format_text("{} and {} are at least {} too far apart for this join, which throws them at "
                                       "each other at up to {}: more than {}",
                                       in_quotes(section.between.front()), in_quotes(section.between.back()),
                                       with_unit(far, unit::length), with_unit(fast, unit::speed),
                                       with_unit(bound(), unit::speed)),
                           "\"within\" joins them only where they are near; or join them at their distance, and draw "
                           "them together by a max_force");
    }
    double reduced_mass(Row a, Row b) {
        const double one = is_held(a) ? 0 : mass_with(a), other = is_held(b) ? 0 : mass_with(b);
        if (one == 0 || other == 0) return std::max({one, other, 1e-12});
        return one * other / (one + other);
    }
};

} // namespace sinew
