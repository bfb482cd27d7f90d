#include "sinew/solver/contact/cloth_features.h"
#include "sinew/solver/contact/collider_sweep.h"
#include "sinew/solver/contact/contact_room.h"

#include <algorithm>
#include <utility>

/// Features of colliding figures, and the pairs of them that may touch.
namespace sinew {
namespace {

/// Closed outlines and lines between particles are capsules; areas of cloth are spheres at the particles.
bool has_segments(const Piece& piece) {
    return !piece.hidden && (piece.mark == Mark::stroke || piece.mark == Mark::curve || piece.mark == Mark::limb ||
                             piece.mark == Mark::loop || piece.mark == Mark::fill || piece.mark == Mark::ring);
}
bool is_closed(const Piece& piece) {
    return piece.mark == Mark::loop || piece.mark == Mark::fill;
}

template <int D, class Real> class FeatureFinder {
  public:
    FeatureFinder(World<D, Real>& world, Solver<D, Real>& solver)
        : world_(world), solver_(solver), room_(contact_room(solver)) {}

    void run() {
        auto& state = solver_.sweep_state;
        room_.particles.clear();
        room_.segments.clear();
        room_.by_rows.assign(state.size(), 0);
        room_.in_segment.assign(world_.particles.size(), 0);
        if (room_.is_stale) detail::ClothFeatures<D, Real>(world_, state, room_.cloth).find();
        for (FigureIndex i = 0; i < world_.figures.size(); ++i)
            if (world_.figures[i].in_use() && world_.figures[i].collides) add_segments(i);
        list_particles();
        room_.projector.find(world_, solver_, room_.by_rows, room_.is_exact);
        for (const Row slot : room_.cloth.slots) room_.is_exact[slot] = 0;
        const auto is_exact = [&](Row slot) { return slot < state.size() && is_held_exactly(solver_, slot); };
        room_.joints.find(world_, solver_, is_exact);
        room_.exact_components.clear();
        for (const auto& component : state.plan.components)
            room_.exact_components.push_back(is_held_exactly(solver_, component));
        if (std::exchange(room_.is_stale, false)) list_links();
    }

  private:
    World<D, Real>& world_;
    Solver<D, Real>& solver_;
    ContactRoom<D, Real>& room_;

    /// Walls hold cloth as they hold everything swept; rows hold the rest. Cloth alone has no pairs with others.
    void list_particles() {
        const auto& state = solver_.sweep_state;
        bool any_other = false;
        for (Row row = 0; row < world_.particles.size(); ++row) {
            const auto figure = world_.particles.figure[row];
            if (figure >= world_.figures.size() || !world_.figures[figure].collides) continue;
            if (state.slot_of[row] >= state.size()) continue;
            room_.particles.push_back(row);
            room_.by_rows[state.slot_of[row]] = !room_.is_of_cloth(row);
            any_other = any_other || !room_.is_of_cloth(row);
        }
        if (!any_other) room_.particles.clear();
    }

    Row row_at(const Piece& piece, std::size_t i) const {
        return world_.particles.slots.find(piece.particles[i % piece.particles.size()]).value_or(no_row);
    }
    bool is_swept(Row row) const {
        return row != no_row && solver_.sweep_state.slot_of[row] < solver_.sweep_state.size();
    }

    /// A filled area is solid on the inner side of its outline; its outline needs no second set of segments.
    void add_segments(FigureIndex index) {
        const auto& figure = world_.figures[index];
        const auto first_of_figure = room_.segments.size();
        for (const bool filled : {true, false})
            for (const auto& piece : figure.pieces)
                if (has_segments(piece) && (piece.mark == Mark::fill) == filled)
                    add_segments(index, piece, first_of_figure);
    }
    void add_segments(FigureIndex figure, const Piece& piece, std::size_t first_of_figure) {
        const auto n = piece.particles.size();
        const auto first = std::uint32_t(room_.segments.size());
        const int side = D == 2 && piece.mark == Mark::fill ? solid_side(piece) : 0;
        for (std::size_t i = 0; i + (is_closed(piece) ? 0 : 1) < n; ++i) {
            const Row a = row_at(piece, i), b = row_at(piece, i + 1);
            if (!is_swept(a) || !is_swept(b) || a == b || is_known(a, b, first_of_figure)) continue;
            if (room_.is_of_cloth(a) && room_.is_of_cloth(b)) continue;
            room_.segments.push_back({.a = a, .b = b, .figure = figure, .side = side});
            room_.in_segment[a] = room_.in_segment[b] = 1;
        }
        const auto count = std::uint32_t(room_.segments.size()) - first;
        for (auto i = first; i < room_.segments.size(); ++i)
            room_.segments[i].first = first, room_.segments[i].count = count;
    }
    bool is_known(Row a, Row b, std::size_t first) const {
        return std::any_of(room_.segments.begin() + std::ptrdiff_t(first), room_.segments.end(),
                           [&](const auto& s) { return (s.a == a && s.b == b) || (s.a == b && s.b == a); });
    }
    /// Counter-clockwise outlines are solid on their left.
    int solid_side(const Piece& piece) const {
        if constexpr (D == 2) {
            Real area = 0;
            for (std::size_t i = 0; i < piece.particles.size(); ++i) {
                const Row a = row_at(piece, i), b = row_at(piece, i + 1);
                if (a != no_row && b != no_row)
                    area += cross(world_.particles.position[a], world_.particles.position[b]);
            }
            return area > Real(0) ? -1 : 1;
        }
        return 0;
    }

    void list_links() {
        room_.links.clear();
        const auto& table = std::get<kind_number<Distance, D>>(world_.constraints);
        for (Row row = 0; row < table.size(); ++row) {
            const auto ends = table.members[row];
            const auto figure = world_.particles.figure[ends[0]];
            if (figure >= world_.figures.size() || !world_.figures[figure].touches_itself) continue;
            if (room_.is_of_cloth(ends[0]) && room_.is_of_cloth(ends[1])) continue;
            room_.links.push_back({std::min(ends[0], ends[1]), std::max(ends[0], ends[1])});
        }
        std::sort(room_.links.begin(), room_.links.end());
    }
};

/// Lists pairs of features by the boxes that they sweep in the rest of a step.
template <int D, class Real> class CandidateFinder {
  public:
    CandidateFinder(World<D, Real>& world, Solver<D, Real>& solver, Real left, Real h)
        : world_(world), solver_(solver), p_(world.particles), state_(solver.sweep_state), room_(contact_room(solver)),
          left_(left), h_(h) {}

    /// A list holds while nothing deviates by more than the margin from its expected motion: a blow hands on speed.
    bool holds() {
        room_.listed_at += h_;
        if (room_.expected.size() != room_.particles.size() || room_.margin == Real(0)) return false;
        for (std::size_t i = 0; i < room_.particles.size(); ++i) {
            const Row slot = state_.slot_of[room_.particles[i]];
            const auto off = state_.place_at(slot) - room_.expected[i] - room_.velocity[i] * room_.listed_at;
            if (!(dot(off, off) <= square(room_.margin))) return false;
        }
        return true;
    }

    void run() {
        note_motion();
        make_boxes();
        room_.candidates.clear();
        const auto& pairs =
            room_.broadphase.find(room_.boxes, [&](std::uint32_t i, std::uint32_t k) { return may_touch(i, k); });
        for (const auto& pair : pairs) room_.candidates.push_back({pair.first, pair.second});
    }

  private:
    World<D, Real>& world_;
    Solver<D, Real>& solver_;
    Particles<D, Real>& p_;
    SweepState<D, Real>& state_;
    ContactRoom<D, Real>& room_;
    Real left_, h_; ///< rest of the step, and a substep

    void note_motion() {
        room_.expected.clear();
        room_.velocity.clear();
        room_.listed_at = 0;
        Real widest = 0;
        for (const Row row : room_.particles) {
            const Row slot = state_.slot_of[row];
            room_.expected.push_back(state_.place_at(slot));
            room_.velocity.push_back(state_.move_at(slot) * (Real(1) / h_));
            widest = maximum(widest, p_.radius[row]);
        }
        const Real fall = norm(state_.gravity) * square(left_);
        room_.margin = maximum(Real(0.5) * widest, fall) + Real(1e-4) * widest + std::numeric_limits<Real>::min();
    }
    void make_boxes() {
        room_.boxes.clear();
        const auto count = room_.particles.size();
        std::size_t i = 0;
        for (const Row row : room_.particles) {
            collide::BoundingBox<D, Real> box;
            box.include(room_.expected[i]);
            box.include(room_.expected[i] + room_.velocity[i] * left_);
            const Real radius = maximum(p_.radius[row], room_.cover_of(row));
            room_.boxes.push_back(box.grown(radius + Real(2) * room_.margin));
            ++i;
        }
        for (const auto& segment : room_.segments) {
            auto box = room_.boxes[number(segment.a, count)];
            const auto& other = room_.boxes[number(segment.b, count)];
            box.include(other.low);
            box.include(other.high);
            room_.boxes.push_back(box);
        }
    }
    /// Number of a particle in the list, which is in the order of rows.
    std::size_t number(Row row, std::size_t count) const {
        const auto end = room_.particles.begin() + std::ptrdiff_t(count);
        return std::size_t(std::lower_bound(room_.particles.begin(), end, row) - room_.particles.begin());
    }

    bool may_touch(std::uint32_t first, std::uint32_t second) const {
        const auto count = room_.particles.size();
        if (first >= count) return D == 3 && may_touch(room_.segments[first - count], room_.segments[second - count]);
        const Row row = room_.particles[first];
        if (second >= count) return may_touch(row, room_.segments[second - count]);
        const Row other = room_.particles[second];
        return !room_.in_segment[row] && !room_.in_segment[other] && meets(row, other) && !are_linked(row, other);
    }
    bool may_touch(Row row, const ContactSegment& segment) const {
        return row != segment.a && row != segment.b && meets(row, segment.a) && !are_linked(row, segment.a) &&
               !are_linked(row, segment.b);
    }
    bool may_touch(const ContactSegment& s, const ContactSegment& t) const {
        return meets(s.a, t.a) && s.a != t.a && s.a != t.b && s.b != t.a && s.b != t.b && !are_linked(s.a, t.a) &&
               !are_linked(s.a, t.b) && !are_linked(s.b, t.a) && !are_linked(s.b, t.b);
    }
    bool meets(Row a, Row b) const {
        if (room_.is_of_cloth(a) && room_.is_of_cloth(b)) return false; // cloth_contact.h
        if (p_.figure[a] == p_.figure[b]) return world_.figures[p_.figure[a]].touches_itself;
        return touch(detail::filter_of(world_, a), detail::filter_of(world_, b));
    }
    bool are_linked(Row a, Row b) const {
        const std::array<Row, 2> pair = {std::min(a, b), std::max(a, b)};
        return std::binary_search(room_.links.begin(), room_.links.end(), pair);
    }
};

} // namespace

template <int D, class Real> void find_contact_features(World<D, Real>& world, Solver<D, Real>& solver) {
    const bool any = std::any_of(world.figures.begin(), world.figures.end(),
                                 [](const Figure& figure) { return figure.in_use() && figure.collides; });
    if (!any && !solver.contacts) return;
    auto& room = contact_room(solver);
    room.is_active = any;
    room.margin = 0;
    if (!any) return world.contacts.kept.clear();
    FeatureFinder(world, solver).run();
}

template <int D, class Real>
void find_contact_candidates(World<D, Real>& world, Solver<D, Real>& solver, Real left, Real h) {
    CandidateFinder finder(world, solver, left, h);
    if (!finder.holds()) finder.run();
}

#define SINEW_CONTACT_FEATURES(D, Real)                                                                                \
    template void find_contact_features(World<D, Real>&, Solver<D, Real>&);                                            \
    template void find_contact_candidates(World<D, Real>&, Solver<D, Real>&, Real, Real);
SINEW_INSTANTIATE(SINEW_CONTACT_FEATURES)

} // namespace sinew
