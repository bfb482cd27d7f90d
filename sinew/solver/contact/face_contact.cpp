#include "sinew/solver/contact/face_contact.h"

#include "sinew/solver/contact/contact_room.h"
#include "sinew/solver/contact/face_guard.h"
#include "sinew/solver/contact/merge_touches.h"

namespace sinew::detail {
namespace {

/// Solves the rows round after round, until one changes little. Faces around a point of contact share corners, so the
/// push of a row opens those before it: solved once, they would carry a load while open, and cloth would never rest.
template <int D, class Real>
void solve_rows(FaceRoom<D, Real>& room, const RowSolver<D, Real>& rows, const Softness<Real>& soft) {
    constexpr int max_rounds = 8;
    constexpr Real little = Real(0.01); // of the sum of the multipliers
    for (int round = 0; round < max_rounds; ++round) {
        Real sum = 0, changed = 0;
        for (auto& row : room.rows) {
            const Real before = row.multiplier;
            rows.solve(row, soft);
            sum += row.multiplier, changed += absolute(row.multiplier - before);
        }
        if (changed <= little * sum) return;
    }
}

template <class Real> class FaceContact {
  public:
    FaceContact(World<3, Real>& world, Solver<3, Real>& solver)
        : world_(world), solver_(solver), state_(solver.sweep_state), room_(solver.contacts->faces) {}

    void find(Real near_by, Real h) {
        room_.rows.clear(), room_.touches.clear();
        FaceRows<Real> rows(state_, room_, solver_.options.contact_filter, near_by, h);
        StrikeSearch<Real> search(world_, state_, room_);
        search.each_pair([&](Real radius) { return radius + near_by; },
                         [&](const StrikePair<Real>& pair) { rows.add(pair, search.motion(pair)); });
    }
    void relax(Real h) {
        const RowSolver<3, Real> rows(state_, max_displacement(h));
        solve_rows(room_, rows, Softness<Real>::none());
        if (world_.contacts.lists_figures) note_touches(h);
    }

  private:
    World<3, Real>& world_;
    Solver<3, Real>& solver_;
    SweepState<3, Real>& state_;
    FaceRoom<3, Real>& room_;

    /// Lists the figures that press, and those so near that a touch goes on without a force.
    void note_touches(Real h) {
        for (std::size_t i = 0; i < room_.rows.size(); ++i)
            if (const auto& row = room_.rows[i]; row.max > Real(0) || row.gap <= Real(0))
                solver_.touches.figures.push_back(touch_of(room_.touches[i], double(row.multiplier / h)));
        merge_touches(solver_.touches.figures);
    }
    FigureTouch touch_of(const FaceTouch& touch, double impulse) const {
        const auto& striker = room_.strikers[touch.striker];
        const Row cloth_row = state_.row_of[room_.mesh.slots[touch.vertex]];
        auto first = striker.figure, second = room_.mesh.figure[touch.vertex];
        auto one = world_.particles.handles.index_of(striker.row[0]),
             other = world_.particles.handles.index_of(cloth_row);
        if (second < first) std::swap(first, second), std::swap(one, other);
        return {first, second, {one, other}, impulse, {.impulse = impulse}};
    }
};

} // namespace

template <int D, class Real>
void find_face_contacts(World<D, Real>& world, Solver<D, Real>& solver, Real near_by, Real h) {
    if constexpr (D == 3) FaceContact<Real>(world, solver).find(near_by, h);
}
template <int D, class Real> void solve_face_contacts(Solver<D, Real>& solver, Real h) {
    constexpr Softness<Real> quarter{Real(0.25), 1, 0}; // as layers of cloth: layer_push_out
    const RowSolver<D, Real> rows(solver.sweep_state, max_displacement(h));
    solve_rows(solver.contacts->faces, rows, quarter);
}
template <int D, class Real> bool guard_faces(World<D, Real>& world, Solver<D, Real>& solver, Real h, bool cuts_only) {
    auto& state = solver.sweep_state;
    auto& room = solver.contacts->faces;
    bool any = false;
    if constexpr (D == 3) any = FaceGuard<Real>(world, state, room, solver.options.contact_filter, h).hold(cuts_only);
    return any;
}
template <int D, class Real> void advance_face_contacts(Solver<D, Real>& solver, Real h) {
    const RowSolver<D, Real> rows(solver.sweep_state, max_displacement(h));
    for (auto& row : solver.contacts->faces.rows) row.gap += rows.change(row);
}
template <int D, class Real> void relax_face_contacts(World<D, Real>& world, Solver<D, Real>& solver, Real h) {
    if constexpr (D == 3) FaceContact<Real>(world, solver).relax(h);
}

#define SINEW_FACE_CONTACT(D, Real)                                                                                    \
    template void find_face_contacts(World<D, Real>&, Solver<D, Real>&, Real, Real);                                   \
    template void solve_face_contacts(Solver<D, Real>&, Real);                                                         \
    template bool guard_faces(World<D, Real>&, Solver<D, Real>&, Real, bool);                                          \
    template void advance_face_contacts(Solver<D, Real>&, Real);                                                       \
    template void relax_face_contacts(World<D, Real>&, Solver<D, Real>&, Real);
SINEW_INSTANTIATE(SINEW_FACE_CONTACT)

} // namespace sinew::detail
