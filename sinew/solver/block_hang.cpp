#include "sinew/solver/block_rows.h"
#include "sinew/solver/block_solve.h"
#include "sinew/solver/phases.h"

/// Trees that hang on what is swept are one constraint of the sweep, solved exactly: where their particles would fly is
/// corrected so that every link has its length, for the least change of momentum. Of what they hang on they move one
/// particle, and the sweep hands on the rest. Links pull along their new directions: lengths of at most so much are a
/// convex set, and moving to its nearest point adds no energy. Along their old ones (SHAKE) they keep a swing's, but
/// the sweep's pulls are no smooth forces: what it leaves undone is worked off across the swing, and adds up.
namespace sinew {
namespace {

using detail::Rule;

template <int D, class Real> class Hanging {
  public:
    Hanging(World<D, Real>& world, const Block& block, Real h)
        : s_(world.swept), d_(std::get<kind_number<Distance, D>>(world.constraints)),
          a_(std::get<kind_number<Angle, D>>(world.constraints)), blocks_(world.blocks), block_(block), h_(h) {}

    void correct(bool first_iteration) {
        load(first_iteration);
        detail::BlockSolve<D> solve(blocks_, block_, double(h_));
        constexpr int few = 8, many = 40;
        if (!solve.run(Rule::implicit, few, [] {})) {
            for (auto& node : unknowns()) node.start += node.velocity * double(h_), node.velocity = {};
            forget_tensions();
            for (int i = 0; i < 3 && !solve.run(Rule::place, many, [] {}); ++i) {
                solve.sweep(); // comes nearer from anywhere
                for (auto& node : unknowns()) node.start = node.place;
                forget_tensions();
            }
        }
        store(first_iteration);
    }

  private:
    Swept<D, Real>& s_;
    Constraints<Distance<D>, Real>& d_;
    Constraints<Angle<D>, Real>& a_;
    Blocks<D>& blocks_;
    const Block& block_;
    Real h_;

    std::span<BlockNode<D>> unknowns() { return std::span(blocks_.nodes).subspan(block_.first_node, block_.unknowns); }
    std::span<BlockNode<D>> fixed() {
        return std::span(blocks_.nodes).subspan(block_.first_node, block_.nodes).subspan(block_.unknowns);
    }
    std::span<BlockLink<D>> links() { return std::span(blocks_.links).subspan(block_.first_link, block_.links); }
    std::span<BlockBend<D>> bends() { return std::span(blocks_.bends).subspan(block_.first_bend, block_.bends); }

    void load(bool first_iteration) {
        for (auto& node : unknowns()) {
            const Row slot = s_.slot_of[node.row];
            node.start = cast<double>(s_.place_at(slot));
            node.velocity = cast<double>(s_.velocity_at(slot));
            node.push = {};
            node.mass = inverse_or_zero(double(s_.mobility[slot]));
        }
        for (auto& node : fixed()) {
            node.velocity = node.move = {};
            const Row slot = s_.slot_of[node.row];
            node.start = cast<double>(s_.place_at(slot));
            node.place = node.start + cast<double>(s_.move_at(slot)); // a pin may carry it
        }
        forget_tensions();
        if (!first_iteration) return; // what the last substep needed is near to what this one will
        const double per = inverse_or_zero(square(double(h_)));
        for (auto& link : links()) link.tension = -double(d_.multiplier[link.constraint]) * per / link.length;
        for (auto& bend : bends()) bend.tension = -double(a_.multiplier[bend.constraint]) * per;
    }

    void forget_tensions() {
        for (auto& link : links()) link.tension = 0;
        for (auto& bend : bends()) bend.tension = 0;
    }

    void store(bool first_iteration) {
        const double per_h = 1 / double(h_);
        const double furthest = double(furthest_move(h_));
        const auto drift = fixed().empty() ? drift_of(per_h) : Vec<D, double>{};
        for (auto& node : unknowns()) {
            const Row slot = s_.slot_of[node.row];
            const auto move = node.place - cast<double>(s_.place_at(slot)) - drift * double(h_);
            s_.set_move(slot, cast<Real>(clamp_components(move, furthest)));
        }
        for (const auto& link : links())
            note(d_.multiplier[link.constraint], link.tension * link.length, first_iteration);
        for (const auto& bend : bends()) note(a_.multiplier[bend.constraint], bend.tension, first_iteration);
    }

    /// Links only act within: what rounding adds to the momentum is taken out again.
    Vec<D, double> drift_of(double per_h) {
        double mass = 0;
        Vec<D, double> gained{};
        for (const auto& node : unknowns()) {
            const Row slot = s_.slot_of[node.row];
            const auto position = cast<double>(s_.place_at(slot)), velocity = cast<double>(s_.velocity_at(slot));
            gained += ((node.place - position) * per_h - velocity) * node.mass;
            mass += node.mass;
        }
        return gained * inverse_or_zero(mass);
    }

    /// Multipliers are those of a sweep: what all iterations of a substep did.
    void note(Real& multiplier, double force, bool first_iteration) {
        constexpr double most = double(limit::multiplier<Real>);
        const double before = first_iteration ? 0 : double(multiplier);
        multiplier = Real(clamp(before - force * square(double(h_)), -most, most));
    }
};

} // namespace

template <int D, class Real> void correct_hanging(World<D, Real>& world, Real h, bool first_iteration) {
    for (auto& block : world.blocks.hanging) {
        detail::look_up_rows(world, block);
        Hanging<D, Real>(world, block, h).correct(first_iteration);
    }
}

#define SINEW_HANG(D, Real) template void correct_hanging(World<D, Real>&, Real, bool);
SINEW_INSTANTIATE(SINEW_HANG)

} // namespace sinew
