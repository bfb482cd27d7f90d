#include "sinew/solver/phases.h"
#include "sinew/solver/plan_sheets.h"
#include "sinew/solver/plan_tethers.h"

#include <algorithm>

/// Working out the plan: what plain distances join is laid out sheet by sheet, then tied to its pins.
namespace sinew {
namespace {

template <int D, class Real> class Planner {
  public:
    explicit Planner(World<D, Real>& world)
        : world_(world), swept_(world.swept), plan_(world.swept.plan), room_(world.swept.room), parts_(world),
          sheets_(world, parts_), tethers_(world, parts_) {}

    void run() {
        plan_.clear();
        look_around();
        swept_.row_of.clear();
        swept_.slot_of.assign(world_.particles.size(), none);
        parts_.find();
        Waiting::tell(0.3);
        for (std::size_t part = 0; part < parts_.size();) {
            const auto alike = parts_.count_alike(part);
            constexpr std::size_t many = 8, small = 1024;
            if (alike >= many && parts_.members(part).size() <= small) {
                sheets_.lay_out_copies(part, alike);
            } else {
                for (std::size_t i = part; i < part + alike; ++i) sheets_.lay_out(i);
            }
            part += alike;
        }
        Waiting::tell(tethers_.tethered(0));
        plan_.first_run.push_back(std::uint32_t(plan_.runs.size()));
        constexpr std::size_t lanes = 16; // a pack reads on behind the last
        for (auto* column : {&plan_.low, &plan_.high, &plan_.compliance}) column->resize(column->size() + lanes);
        square_lengths();
        list_pins();
        if (!plan_.may_tear)
            for (auto& sheet : plan_.sheets) tethers_.add_tethers(sheet);
        plan_.per_reach_square.resize(plan_.per_reach_square.size() + (plan_.per_reach_square.empty() ? 0 : lanes));
        swept_.make_room();
    }

  private:
    static constexpr Row none = ~Row(0);

    World<D, Real>& world_;
    Swept<D, Real>& swept_;
    Plan<Real>& plan_;
    PlanRoom& room_;
    detail::PlanParts<D, Real> parts_;
    detail::SheetMaker<D, Real> sheets_;
    detail::TetherMaker<D, Real> tethers_;

    /// What tears must not make a step allocate: room for all that could be, where that is no waste.
    void look_around() {
        plan_.may_tear = false;
        std::size_t constraints = 0;
        for_each_table(world_, [&](const auto& table) {
            constraints += table.size();
            for (Row row = 0; row < table.size(); ++row) {
                plan_.may_tear = plan_.may_tear || table.breaking_strain[row] < limit::measure<Real>;
            }
        });
        constexpr std::size_t small = 100'000;
        if (!plan_.may_tear || constraints > small) return;
        plan_.reserve(world_.particles.size(), std::get<kind_number<Distance, D>>(world_.constraints).size(),
                      constraints);
        room_.reserve(world_.particles.size(), std::get<kind_number<Distance, D>>(world_.constraints).size());
        swept_.reserve(world_.particles.size());
    }

    /// As the kernels would (kernel_length.h), which divide more slowly than they read.
    void square_lengths() {
        plan_.per_square.resize(plan_.low.size());
        for (std::size_t i = 0; i < plan_.low.size(); ++i)
            plan_.per_square[i] = minimum(Real(1) / (plan_.low[i] * plan_.low[i]), Real(1e30));
    }

    void list_pins() {
        plan_.pins.clear();
        for (std::uint32_t i = 0; i < world_.pins.size(); ++i)
            if (const auto row = world_.particles.slots.find(world_.pins[i].particle);
                row && swept_.slot_of[*row] != none)
                plan_.pins.push_back({swept_.slot_of[*row], i});
        std::sort(plan_.pins.begin(), plan_.pins.end(),
                  [](const auto& a, const auto& b) { return std::pair(a.slot, a.pin) < std::pair(b.slot, b.pin); });
        std::size_t pin = 0;
        for (auto& band : plan_.bands) {
            band.first_pin = std::uint32_t(pin);
            while (pin < plan_.pins.size() && plan_.pins[pin].slot < band.last) ++pin;
            band.last_pin = std::uint32_t(pin);
        }
    }
};

} // namespace

template <int D, class Real> void make_plan(World<D, Real>& world) {
    Planner<D, Real>(world).run();
}

#define SINEW_PLAN(D, Real) template void make_plan(World<D, Real>&);
SINEW_INSTANTIATE(SINEW_PLAN)

} // namespace sinew
