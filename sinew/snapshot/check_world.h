#pragma once

#include "sinew/snapshot/check_figures.h"
#include "sinew/world/fields.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

/// Check that a world of a file could have been built here: sizes, indices and ranges, before anything reads
/// them. Numbers that a step itself holds in its limits (positions, velocities, forces, walls) may be anything.
namespace sinew::snapshot {

template <int D, class Real> class WorldCheck {
  public:
    explicit WorldCheck(const World<D, Real>& world) : world_(world), p_(world.particles) {}

    /// The first fault; nothing if the world is sound.
    std::optional<Fault> run() {
        check_settings();
        check_particles();
        for_each_table(world_, [&](const auto& table) { check_table(table); });
        check_sweep();
        check_pins();
        check_surroundings();
        check_colliders();
        check_contacts();
        if (!fault_) fault_ = check_figures(world_);
        return fault_;
    }

  private:
    using Vector = Vec<D, Real>;
    static constexpr Real most = limit::measure<Real>;
    const World<D, Real>& world_;
    const Particles<D, Real>& p_;
    std::string part_ = "world";
    std::optional<Fault> fault_;

    void fail(std::string_view field, std::string what) {
        if (!fault_) fault_ = Fault{part_ + "." + std::string(field), std::move(what)};
    }
    void expect(bool holds, std::string_view field, std::string_view what) {
        if (!holds) fail(field, std::string(what));
    }

    // --- numbers -----------------------------------------------------------------------------------------------------

    void within(std::string_view field, double value, double low, double high) {
        if (!(value >= low && value <= high)) fail(field, range_text(value, low, high));
    }
    template <class ColumnT>
    void rows_within(std::string_view field, const ColumnT& column, std::size_t rows, double low, double high) {
        if (!has_rows(field, column, rows)) return;
        for (std::size_t row = 0; row < rows; ++row)
            if (const double value = double(column[row]); !(value >= low && value <= high))
                return fail(field, "row " + std::to_string(row) + ": " + range_text(value, low, high));
    }
    void finite_rows(std::string_view field, const std::vector<Vector>& column, std::size_t rows) {
        if (!has_rows(field, column, rows)) return;
        expect(std::ranges::all_of(column, [](const Vector& v) { return is_finite(v); }), field, "not a finite number");
    }
    template <class ColumnT> bool has_rows(std::string_view field, const ColumnT& column, std::size_t rows) {
        if (column.size() == rows) return true;
        fail(field, std::to_string(column.size()) + " rows where " + std::to_string(rows) + " are expected");
        return false;
    }
    template <class Tag> void has_handles(std::string_view field, const HandleMap<Tag>& handles, std::size_t rows) {
        std::size_t known = 0;
        HandleMap<Tag>::fields(handles, [&](const auto& count, const auto&...) { known = count; });
        if (known != rows) fail(field, "handles of " + std::to_string(known) + " rows, not of " + std::to_string(rows));
    }

    // --- parts -------------------------------------------------------------------------------------------------------

    void check_settings() {
        const auto& s = world_.settings;
        within("substeps", s.substeps, 0, max_substeps);
        within("iterations", s.iterations, 0, max_substeps);
        within("passes", s.classic.passes, 0, max_substeps);
        expect(is_finite(s.damping), "damping", "not a finite number");
        within("frame", double(s.frame), 0, double(limit::step<Real>));
        for (const Real value : {s.classic.keep, s.classic.bounce, s.classic.floor_keep, s.classic.time_scale})
            within("classic", double(value), -1e6, 1e6);
        within("longest_step", double(s.classic.longest_step), 0, 1e6);
        within("sleep", double(s.sleep.speed), 0, double(limit::speed<Real>));
        within("sleep", double(s.sleep.delay), 0, double(most));
        within("time", world_.time, -1e30, 1e30);
        within("last_step", double(world_.last_step), 0, double(limit::step<Real>));
        within("last_substep", double(world_.last_substep), 0, double(limit::step<Real>));
        within("repair_window", world_.repair_window, 0, 1 << 20);
    }

    void check_particles() {
        part_ = "particles";
        const auto n = p_.position.size();
        expect(n <= limit::rows, "position", "too many particles");
        has_handles("handles", p_.handles, n);
        for (const auto* column : {&p_.previous, &p_.velocity, &p_.force}) has_rows("previous", *column, n);
        finite_rows("residual", p_.residual, n);
        if (!p_.any_force)
            expect(std::ranges::all_of(p_.force, [](const Vector& f) { return f == Vector{}; }), "force",
                   "a force where there is none");
        has_rows("inverse_mass", p_.inverse_mass, n);
        expect(std::ranges::none_of(p_.inverse_mass, [](Real w) { return w < Real(0); }), "inverse_mass", "negative");
        rows_within("mobility", p_.mobility, n, 0, double(limit::mass<Real>));
        has_rows("radius", p_.radius, n);
        check_figure_column(p_.figure, n);
        for (const auto* flags : {&p_.quarantined, &p_.at_end}) rows_within("quarantined", *flags, n, 0, 1);
        rows_within("asleep", p_.asleep, n, 0, 1);
        rows_within("near", p_.near, n, 0, 1);
        rows_within("rest_time", p_.rest_time, n, 0, double(most));
        for (Row row = 0; has_rows("rolls", p_.rolls, n) && row < n; ++row)
            expect(p_.rolls[row] <= Rolls::never, "rolls", "an unknown word of a list");
        rows_within("inertia", p_.inertia, n, 1e-9, 1e9);
        for (Row row = 0; has_rows("spin", p_.spin, n) && row < n; ++row)
            expect(is_finite(p_.spin[row]), "spin", "not a finite number");
        for (Row row = 0; has_rows("turn", p_.turn, n) && row < n; ++row)
            expect(absolute(norm(p_.turn[row].number) - Real(1)) < Real(1e-3), "turn", "not a rotation");
        rows_within("energy_debt", p_.energy_debt, n, -1e300, 1e300);
    }
    template <class ColumnT> void check_figure_column(const ColumnT& column, std::size_t rows) {
        if (!has_rows("figure", column, rows)) return;
        for (std::size_t row = 0; row < rows; ++row)
            if (column[row] != no_figure && !has_figure(world_, column[row])) return fail("figure", "no such figure");
    }

    template <class Table> void check_table(const Table& table) {
        part_ = Table::Kind::name;
        const auto n = table.limits.size();
        expect(n <= limit::rows, "limits", "too many constraints");
        has_handles("handles", table.handles, n);
        if (has_rows("members", table.members, n)) check_members(table);
        constexpr auto max = double(most);
        rows_within("multiplier", table.multiplier, n, -double(limit::multiplier<Real>),
                    double(limit::multiplier<Real>));
        rows_within("compliance", table.compliance, n, 0, max);
        rows_within("relaxation", table.relaxation, n, 0, 1);
        rows_within("split", table.split, n, 0, 1);
        rows_within("max_force", table.max_force, n, 0, max);
        rows_within("damping_time", table.damping_time, n, 0, double(limit::step<Real>));
        rows_within("motor_speed", table.motor_speed, n, -double(limit::speed<Real>), double(limit::speed<Real>));
        rows_within("motorized", table.motorized, n, 0, 1);
        rows_within("breaking_strain", table.breaking_strain, n, 0, max);
        rows_within("break_force", table.break_force, n, 0, max);
        rows_within("damage_limit", table.damage_limit, n, 0, max);
        rows_within("damage", table.damage, n, 0, double(std::numeric_limits<Real>::max()));
        rows_within("limits", table.limits.lows(), n, -max, max);
        for (Row row = 0; row < n && !fault_; ++row)
            expect(table.low(row) <= table.high(row) && table.high(row) <= most, "limits", "not an interval");
        check_figure_column(table.figure, n);
    }
    template <class Table> void check_members(const Table& table) {
        using Kind = typename Table::Kind;
        std::vector<Row> sorted;
        for (Row row = 0; row < table.members.size() && !fault_; ++row) {
            const auto members = table.members[row];
            sorted.assign(members.begin(), members.end());
            std::sort(sorted.begin(), sorted.end());
            if constexpr (Kind::arity == any_arity)
                expect(members.size() >= std::size_t(Kind::min_arity), "members", "too few");
            expect(sorted.empty() || sorted.back() < p_.size(), "members", "no such particle");
            expect(std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end(), "members", "a particle twice");
        }
    }
    void check_sweep() {
        part_ = "world";
        std::array<std::uint64_t, std::size_t(Kinds<D>::size)> counts{};
        for (const auto& run : world_.sweep) {
            if (run.kind < 0 || run.kind >= Kinds<D>::size) return fail("sweep", "no such kind");
            expect(run.count > 0, "sweep", "an empty run");
            counts[std::size_t(run.kind)] += run.count;
        }
        std::size_t kind = 0;
        for_each_table(world_, [&](const auto& table) {
            expect(counts[kind++] == table.size(), "sweep", "not every constraint once");
        });
    }

    void check_pins() {
        has_handles("pin_handles", world_.pin_handles, world_.pins.size());
        for (const auto& pin : world_.pins) {
            within("pins", double(pin.compliance), 0, double(most));
            within("pins", double(pin.damping), 0, double(most));
            within("pins", double(pin.max_force), 0, double(most));
            within("pins", double(pin.steer_damping), -double(most), double(most));
            expect(is_finite(pin.multiplier) && is_finite(pin.steer), "pins", "not a finite number");
        }
    }
    void check_surroundings() {
        for (const auto& plane : world_.bounds) {
            within("bounds", double(norm(plane.normal)), 0.99, 1.01);
        }
        ForceTable<D, Real>::fields(world_.forces, [&](const auto& laws, const auto& tags, const auto& handles) {
            has_handles("forces", handles, laws.size());
            has_rows("forces", tags, laws.size());
        });
        for (const auto& force : world_.forces) std::visit([&](const auto& field) { check_force(field); }, force);
    }
    void check_force(const Gravity<D, Real>& gravity) { finite_force(gravity.acceleration); }
    void check_force(const Drag<D, Real>& drag) { finite_force(drag.strength); }
    void check_force(const Wind<D, Real>& wind) {
        finite_force(wind.velocity), finite_force(wind.gust), finite_force(wind.strength);
        within("forces", double(wind.gust_period), 0, double(most));
        within("forces", double(wind.gust_size), 0, double(most));
        within("forces", double(wind.density), 0, double(most));
        within("forces", double(wind.drag_coefficient), 0, double(most));
        within("forces", double(wind.metre), 0, double(most));
    }
    void check_force(const Attractor<D, Real>& attractor) {
        finite_force(attractor.center), finite_force(attractor.strength);
        within("forces", double(attractor.softness), 0, double(most));
    }
    void check_force(const RandomPush<D, Real>& push) { finite_force(push.low), finite_force(push.high); }
    template <class T> void finite_force(const T& value) { expect(is_finite(value), "forces", "not a finite number"); }

    // --- colliders ---------------------------------------------------------------------------------------------------

    void check_colliders() {
        has_handles("collider_handles", world_.collider_handles, world_.colliders.size());
        for (const auto& collider : world_.colliders) {
            for (const auto* pose : {&collider.from, &collider.target}) {
                expect(is_finite(pose->position), "colliders", "a pose that is not finite");
                within("colliders", double(norm(pose->rotation.number)), 0.99, 1.01);
            }
            within("colliders", double(collider.restitution), 0, 1);
            within("colliders", double(collider.friction), 0, double(most));
            expect(is_finite(collider.one_way) && is_finite(collider.surface_velocity), "colliders",
                   "not a finite number");
            std::visit([&](const auto& shape) { check_shape(shape); }, collider.shape);
        }
    }
    void finite_points(const std::vector<Vector>& points) {
        expect(std::ranges::all_of(points, [](const Vector& v) { return is_finite(v); }), "colliders",
               "a corner that is not finite");
    }
    void size_within(Real size) { within("colliders", double(size), 0, double(limit::coordinate<Real>)); }
    void check_shape(const collide::HalfSpace<D, Real>& plane) {
        within("colliders", double(norm(plane.normal)), 0.99, 1.01);
        expect(is_finite(plane.offset), "colliders", "not a finite number");
    }
    void check_shape(const collide::Sphere<D, Real>& sphere) { size_within(sphere.radius); }
    void check_shape(const collide::Capsule<D, Real>& capsule) {
        size_within(capsule.radius);
        expect(is_finite(capsule.a) && is_finite(capsule.b), "colliders", "not a finite number");
    }
    void check_shape(const collide::Box<D, Real>& box) {
        for (int i = 0; i < D; ++i) size_within(box.half()[i]);
    }
    void check_shape(const collide::Polygon<2, Real>& polygon) {
        finite_points(polygon.corners);
        expect(!polygon.corners.empty(), "colliders", "a polygon without corners");
    }
    void check_shape(const collide::Chain<2, Real>& chain) { finite_points(chain.points); }
    void check_shape(const collide::Mesh<3, Real>&) {} // when read
    void check_shape(const collide::HeightField<3, Real>& field) {
        expect(field.spacing > Real(0) && is_finite(field.spacing), "colliders", "no distance between heights");
        expect(std::ranges::all_of(field.height, [](Real y) { return is_finite(y); }), "colliders",
               "a height that is not finite");
        expect(field.height.size() < (std::uint64_t(1) << 31) && field.columns <= field.height.size(), "colliders",
               "too many heights");
    }

    // --- contacts ----------------------------------------------------------------------------------------------------

    void check_contacts() {
        part_ = "contacts";
        const auto& contacts = world_.contacts;
        within("kept_substep", double(contacts.kept_substep), 0, double(limit::step<Real>));
        expect(std::ranges::is_sorted(contacts.kept, {}, &KeptContact<D, Real>::key), "kept", "not in order");
        for (const auto* list : {&contacts.kept, &contacts.passing})
            for (const auto& contact : *list) {
                for (const auto slot : contact.key.particle) expect_slot(slot, "kept");
                expect_collider(contact.key.collider, "kept");
                expect(is_finite(contact.multiplier) && contact.multiplier >= Real(0) && is_finite(contact.friction),
                       "kept", "not a force");
            }
        expect(std::is_sorted(contacts.touching.begin(), contacts.touching.end()), "touching", "not in order");
        for (const auto& touch : contacts.touching) {
            expect(touch.particle < p_.handles.indices(), "touching", "no such particle");
            expect_collider(touch.collider, "touching");
        }
        expect(std::is_sorted(contacts.figures.begin(), contacts.figures.end()), "figures", "not in order");
        for (const auto& touch : contacts.figures) {
            for (const auto slot : touch.particle) expect_slot(slot, "figures");
            expect(touch.first < world_.figures.size() && touch.second < world_.figures.size(), "figures",
                   "no such figure");
        }
    }
    void expect_slot(std::uint32_t slot, std::string_view field) {
        expect(slot == ContactKey::none || slot < p_.handles.indices(), field, "no such particle");
    }
    void expect_collider(std::uint32_t slot, std::string_view field) {
        const bool is_known = slot == ContactKey::none || slot < world_.collider_handles.indices() ||
                              is_plane(slot); // one that was removed is not looked up
        expect(is_known, field, "no such collider");
    }
};

} // namespace sinew::snapshot
