#pragma once

#include "sinew/assert/assert.h"
#include "sinew/solver/solver.h"
#include "sinew/world/world.h"

/// Writes the runs of a plan link by link: a link that follows the last one continues the run.
namespace sinew::detail {

template <int D, class Real> class RunWriter {
  public:
    RunWriter(World<D, Real>& world, Solver<D, Real>& solver)
        : world_(world), solver_(solver), distances_(std::get<kind_number<Distance, D>>(world.constraints)),
          plan_(solver.sweep_state.plan) {}

    /// Begins a component. With `old_gradient`, links are corrected along their old directions.
    void begin_sheet(bool old_gradient) {
        swings_ = old_gradient;
        first_parameter_ = std::uint32_t(plan_.parameters.size());
        links_ = {};
    }
    /// Rows of the links of the component so far.
    const Extent& links() const { return links_; }

    void begin_family(std::uint32_t tile_span = 0) {
        plan_.colors.push_back({.first_batch = std::uint32_t(plan_.first_batch.size()), .tile_span = tile_span});
    }
    void begin_band() {
        SINEW_ASSERT(!plan_.colors.empty(), "a tile's batches belong to a color");
        plan_.first_batch.push_back(std::uint32_t(plan_.runs.size()));
        fresh_ = true;
    }
    void break_run() { fresh_ = true; }

    /// Adds the next link of the color: continues the run if possible.
    void add(Row link, Row a, Row b) {
        links_.include(link);
        constexpr std::uint32_t max_lanes = 32; // in two packs
        if (!fresh_) {
            auto& run = plan_.runs.back();
            const auto offset = run.a < run.b ? run.b - run.a : run.a - run.b;
            const bool follows = a == run.a + run.count && b == run.b + run.count && !run.scattered &&
                                 is_at_port(link) == is_at_port(plan_.row_of(run, 0)) &&
                                 (offset >= max_lanes || run.count < offset) &&
                                 (run.count == 1 ? link > run.row : link == run.row + run.count * run.row_step);
            if (follows) {
                if (run.count == 1) run.row_step = link - run.row;
                extend(run, link);
                return;
            }
        }
        begin_run(link, a, b);
    }

    void begin_run(Row link, Row a, Row b) {
        SINEW_ASSERT(a != b, "a link has two ends");
        SINEW_ASSERT(!plan_.first_batch.empty(), "a batch belongs to a tile");
        links_.include(link);
        auto parameters = std::uint32_t(plan_.parameters.size());
        if (parameters > first_parameter_ && has_parameters(link, parameters - 1))
            --parameters; // equal to the last parameters: shared
        else
            add_parameters(link);
        plan_.runs.push_back({.a = a,
                              .b = b,
                              .count = 1,
                              .row = link,
                              .row_step = 1,
                              .parameters = parameters,
                              .uniform = true,
                              .compliant = !distances_.is_rigid(link),
                              .equality = is_exact(link),
                              .old_gradient = swings_,
                              .equal_mass = is_even(link)});
        fresh_ = false;
    }

    /// Updates `even` after a change of masses.
    void weigh(LinkBatch& run) const {
        run.equal_mass = true;
        for (std::uint32_t i = 0; i < run.count; ++i) run.equal_mass = run.equal_mass && is_even(plan_.row_of(run, i));
    }

    /// Adds the next link of a run whose rows are listed one by one.
    void add_listed(Row link, Row a, Row b, bool begins) {
        links_.include(link);
        if (begins) {
            begin_run(link, a, b);
            plan_.runs.back().row = std::uint32_t(plan_.rows.size());
            plan_.runs.back().row_step = 0;
        } else {
            extend(plan_.runs.back(), link);
        }
        plan_.rows.push_back(link);
    }

    void add_scattered(Row link, Row a, Row b) {
        links_.include(link);
        if (fresh_ || !plan_.runs.back().scattered) {
            plan_.runs.push_back({.a = std::uint32_t(plan_.ends_a.size()),
                                  .row = std::uint32_t(plan_.rows.size()),
                                  .parameters = std::uint32_t(plan_.parameters.size()),
                                  .old_gradient = swings_,
                                  .scattered = true});
            fresh_ = false;
        }
        plan_.ends_a.push_back(a);
        plan_.ends_b.push_back(b);
        plan_.rows.push_back(link);
        add_parameters(link);
        note(plan_.runs.back(), link);
    }

  private:
    World<D, Real>& world_;
    Solver<D, Real>& solver_;
    const Constraints<Distance<D>, Real>& distances_;
    Plan<Real>& plan_;
    bool fresh_ = true; ///< the next link begins a run
    bool swings_ = true;
    std::uint32_t first_parameter_ = 0; ///< first one of the component
    Extent links_;

    void add_parameters(Row link) { plan_.parameters.add(low(link), high(link), distances_.compliance[link]); }
    bool has_parameters(Row link, std::uint32_t number) const {
        return plan_.parameters.are(number, low(link), high(link), distances_.compliance[link]);
    }
    /// Lower limit, m. A link at a port stays in the plan, because tethers lead over the link, but is inactive: the
    /// port solves the link after all others (ports/port_mover.h).
    Real low(Row link) const { return is_at_port(link) ? Real(0) : max(distances_.low(link), Real(0)); }
    /// Upper limit, m, small enough for finite squares and products.
    Real high(Row link) const {
        constexpr Real max = limit::coordinate<Real> * Real(100);
        return is_at_port(link) ? max : min(distances_.high(link), max);
    }
    bool is_at_port(Row link) const {
        const auto& ports = solver_.blocks.ports;
        if (ports.list.empty()) return false;
        return ports.at[end(link, 0)] != ports.none || ports.at[end(link, 1)] != ports.none;
    }

    /// True if both ends are movable and have equal inverse masses, drag aside.
    bool is_even(Row link) const {
        const auto& p = world_.particles;
        const Row a = end(link, 0), b = end(link, 1);
        return p.mobility[a] > Real(0) && p.mobility[b] > Real(0) && p.inverse_mass[a] == p.inverse_mass[b];
    }

    Row end(Row link, std::size_t i) const { return distances_.members.rows[link][i]; }
    bool is_exact(Row link) const { return distances_.low(link) == distances_.high(link) && !is_at_port(link); }

    void extend(LinkBatch& run, Row link) {
        if (run.uniform && !has_parameters(link, run.parameters)) {
            const auto of = run.parameters;
            run.uniform = false;
            run.parameters = std::uint32_t(plan_.parameters.size());
            for (std::uint32_t i = 0; i < run.count; ++i) plan_.parameters.add_copy(plan_.parameters, of);
        }
        if (!run.uniform) add_parameters(link);
        note(run, link);
    }

    void note(LinkBatch& run, Row link) {
        run.compliant = run.compliant || !distances_.is_rigid(link);
        run.equality = run.equality && is_exact(link);
        run.equal_mass = run.equal_mass && is_even(link);
        ++run.count;
    }
};

} // namespace sinew::detail
