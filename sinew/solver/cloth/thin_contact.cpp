#include "sinew/solver/cloth/thin_contact.h"

#include "sinew/solver/cloth/feature_search.h"
#include "sinew/solver/layer_correction.h"

#include <algorithm>
#include <cmath>

namespace sinew::detail {
namespace {

template <class Real> class ThinContact {
  public:
    using Vector = Vec3<Real>;

    ThinContact(const World<3, Real>& world, SweepState<3, Real>& state, ThinRoom<3, Real>& room,
                const SubstepSpan<Real>& span)
        : world_(world), state_(state), room_(room), span_(span) {}

    void solve() {
        read();
        if (span_.number == 1) begin_step();
        keep_list();
        look_at_all();
        for (auto& pairs : room_.pairs) list_touching(pairs);
        for (auto& pairs : room_.pairs)
            for (const auto i : pairs.touching) part(pairs.near[i]);
        write();
    }

    void truncate() {
        read();
        do {
            if (!room_.is_calm)
                look_again();
            else if (largest_move_ > room_.skin)
                look_at_all_ahead();
        } while (separate_all());
        write();
    }

  private:
    const World<3, Real>& world_;
    SweepState<3, Real>& state_;
    ThinRoom<3, Real>& room_;
    SubstepSpan<Real> span_;

    // --- motion ------------------------------------------------------------------------------------------------------

    void read() {
        auto& vertices = room_.vertices;
        if (vertices.size() != room_.mesh.size()) vertices.assign(room_.mesh.size(), {}), room_.is_listed = false;
        Vector shift{};
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const Row slot = room_.mesh.slots[i];
            shift += state_.position_at(slot) - vertices[i].position;
        }
        const Real share = Real(1) / Real(vertices.size());
        shift *= share;
        room_.drift += shift;
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            auto& vertex = vertices[i];
            const auto position = state_.position_at(room_.mesh.slots[i]),
                       displacement = state_.displacement_at(room_.mesh.slots[i]);
            vertex.travel += double(norm(position - vertex.position - shift));
            vertex.last_displacement = position == vertex.position ? displacement : position - vertex.position;
            vertex.position = position, vertex.displacement = displacement,
            vertex.mobility = state_.mobility[room_.mesh.slots[i]];
        }
        look_ahead();
    }
    /// Travel until the end of the substep, by the displacements as they are now.
    void look_ahead() {
        Vector mean{};
        for (const auto& vertex : room_.vertices) mean += vertex.displacement;
        mean *= Real(1) / Real(room_.vertices.size());
        largest_move_ = 0;
        for (auto& vertex : room_.vertices) {
            const Real ahead = norm(vertex.displacement - mean);
            vertex.ahead = vertex.travel + double(ahead);
            largest_move_ = max(largest_move_, ahead);
        }
    }
    void write() {
        for (std::size_t i = 0; i < room_.vertices.size(); ++i)
            state_.set_displacement(room_.mesh.slots[i], room_.vertices[i].displacement);
    }
    Real largest_move_ = 0; ///< relative to the mean
    bool any_truncated_ = false;
    std::array<std::size_t, 2> near_in_order_{}; ///< pairs that are near, before those found later

    // --- list --------------------------------------------------------------------------------------------------------

    void begin_step() {
        room_.thickest = 0;
        for (const Real half : room_.mesh.half_thickness) room_.thickest = max(room_.thickest, Real(2) * half);
        room_.skin = skin * room_.thickest;
        Real furthest = 0;
        for (const auto& vertex : room_.vertices)
            for (int axis = 0; axis < 3; ++axis) furthest = max(furthest, absolute(vertex.position[axis]));
        room_.min_gap = max(min_gap * room_.thickest, Real(16) * std::numeric_limits<Real>::epsilon() * furthest);
        for (std::size_t i = 0; i < room_.vertices.size(); ++i) {
            auto& vertex = room_.vertices[i];
            vertex.step_began_at = vertex.travel;
            vertex.last_displacement = world_.particles.velocity[state_.row_of[room_.mesh.slots[i]]] * span_.h;
        }
        room_.is_calm = is_slow();
    }
    /// By the velocities before the step: links pull and contacts push back within a substep, even at rest.
    bool is_slow() const {
        const auto velocity = [&](std::size_t i) {
            return world_.particles.velocity[state_.row_of[room_.mesh.slots[i]]];
        };
        Vector mean{};
        for (std::size_t i = 0; i < room_.vertices.size(); ++i) mean += velocity(i);
        mean *= Real(1) / Real(room_.vertices.size());
        const Real slow = Real(0.5) * room_.skin / (span_.h * Real(span_.count));
        std::size_t failed = 0;
        for (std::size_t i = 0; i < room_.vertices.size(); ++i) failed += !(norm(velocity(i) - mean) <= slow);
        return failed * few <= room_.vertices.size();
    }
    static constexpr std::size_t few = 20; ///< the few are this part of all
    /// True if not more than a few vertices fail a test.
    template <class Test> bool has_few(Test&& test) const {
        std::size_t failed = 0;
        for (const auto& vertex : room_.vertices) failed += !test(vertex);
        return failed * few <= room_.vertices.size();
    }
    /// Skin as a share of the thickness: how far a vertex may be off its forecast. Thickness and two skins stay within
    /// the 0.7 cells between vertices without a face in common.
    static constexpr Real skin = Real(0.2);
    /// Floor under gaps, as a share of the thickness: else each substep takes its share of the rest, down to rounding.
    static constexpr Real min_gap = Real(0.004);

    /// In a calm step a list of an earlier step serves, renewed for the few vertices that have travelled: any such list
    /// has the same pairs that touch. In others all follows from the beginning of the step.
    void keep_list() {
        FeatureSearch<Real> search(world_, room_, span_.number);
        const bool was_calm = room_.is_calm;
        room_.is_calm = was_calm && has_few([&](const auto& vertex) {
                            return vertex.ahead - vertex.step_began_at <= double(room_.skin);
                        });
        if (room_.is_calm && !(room_.is_listed && room_.is_static))
            search.list(true, span_.number);
        else if (!room_.is_calm && (was_calm || span_.number == 1))
            search.list(false, span_.count);
        search.renew();
    }

    // --- pairs -------------------------------------------------------------------------------------------------------

    double travel_ahead(const PairVertices& v) const {
        double sum = 0;
        for (const auto i : v) sum += room_.vertices[i].ahead;
        return sum;
    }
    void look_at_all() {
        for (auto& pairs : room_.pairs) {
            pairs.near.clear();
            pairs.touching.clear();
            for (std::size_t i = 0; i < pairs.listed.size(); ++i) {
                if (i == pairs.in_order) near_in_order_[pairs.first_side - 1] = pairs.near.size();
                look_at(pairs, pairs.listed[i]);
            }
            if (pairs.in_order >= pairs.listed.size()) near_in_order_[pairs.first_side - 1] = pairs.near.size();
        }
    }
    /// Displacements have changed since the pairs were looked at: a pair already known does no harm again.
    void look_again() {
        FeatureSearch<Real>(world_, room_, span_.number).renew();
        for (auto& pairs : room_.pairs)
            for (auto& pair : pairs.listed)
                if (!pair.is_near) look_at(pairs, pair);
    }
    /// Calm displacements cannot bring together what was not near: after others all are looked at anew.
    void look_at_all_ahead() {
        room_.is_calm = false;
        FeatureSearch<Real> search(world_, room_, span_.number);
        search.list(false, span_.count);
        search.renew();
        look_at_all();
    }
    void look_at(FeaturePairs<Real>& pairs, FeaturePair& pair) {
        pair.is_near = false;
        const double ahead = travel_ahead(pair.vertex);
        if (!(ahead > pair.due)) return;
        FeatureCorners<Real> corner;
        for (std::size_t i = 0; i < 4; ++i) corner[i] = room_.vertices[pair.vertex[i]].position;
        const auto found = pairs.first_side == 1 ? nearest_vertex_face(corner) : nearest_edge_edge(corner);
        const Real thickness = pair_thickness(room_.mesh, pair.vertex, pairs.first_side);
        double travel = 0;
        for (const auto i : pair.vertex) travel += room_.vertices[i].travel;
        pair.due = travel + 0.999 * double(found.distance - thickness);
        pair.is_near = ahead > pair.due;
        if (!pair.is_near) return;
        NearPair<Real> near{.vertex = pair.vertex,
                            .weight = found.weight,
                            .normal = found.normal,
                            .distance = found.distance,
                            .thickness = thickness};
        for (std::size_t i = 0; i < 4; ++i) near.height[i] = dot(found.normal, corner[i] - corner[0]);
        near.is_parted = gap(near, pairs.first_side) > Real(0.7) * found.distance;
        near.is_touching = is_touching(near, found.is_inside, pairs.first_side);
        pairs.near.push_back(near);
    }
    /// Pairs found later are sorted in between: the order follows from the state alone.
    void list_touching(FeaturePairs<Real>& pairs) {
        const auto list = [&](auto& numbers, std::size_t first, std::size_t last) {
            numbers.clear();
            for (auto i = first; i < last; ++i)
                if (pairs.near[i].is_touching) numbers.push_back(std::uint32_t(i));
        };
        const auto in_order = near_in_order_[pairs.first_side - 1];
        list(room_.merged, 0, in_order);
        list(room_.tail, in_order, pairs.near.size());
        const auto before = [&](auto a, auto b) { return pairs.near[a].vertex < pairs.near[b].vertex; };
        std::sort(room_.tail.begin(), room_.tail.end(), before);
        pairs.touching.resize(room_.merged.size() + room_.tail.size());
        std::merge(room_.merged.begin(), room_.merged.end(), room_.tail.begin(), room_.tail.end(),
                   pairs.touching.begin(), before);
    }
    bool is_touching(const NearPair<Real>& near, bool is_inside, std::size_t first_side) const {
        if (!is_inside && (first_side == 2 || near.distance >= near.thickness)) return false;
        return near.distance + dot(near.normal, relative_displacement(near)) < near.thickness;
    }
    static Real gap(const NearPair<Real>& near, std::size_t first_side) { return gap_of(near.height, first_side); }
    Vector relative_displacement(const NearPair<Real>& near) const {
        Vector sum{};
        for (std::size_t i = 0; i < 4; ++i) sum += room_.vertices[near.vertex[i]].displacement * near.weight[i];
        return sum;
    }

    // --- solution ----------------------------------------------------------------------------------------------------

    void part(const NearPair<Real>& pair) {
        const auto moved = relative_displacement(pair);
        const Real overlap = pair.thickness - pair.distance - dot(pair.normal, moved);
        Real mobility = 0;
        for (std::size_t i = 0; i < 4; ++i)
            mobility += square(pair.weight[i]) * room_.vertices[pair.vertex[i]].mobility;
        if (!(overlap > Real(0)) || mobility == Real(0)) return;
        const Real friction = min(room_.mesh.friction[pair.vertex[0]], room_.mesh.friction[pair.vertex[3]]);
        const auto change = layer_correction(pair.normal, moved, overlap, friction) * inverse_or_zero(mobility);
        for (std::size_t i = 0; i < 4; ++i) {
            auto& vertex = room_.vertices[pair.vertex[i]];
            vertex.displacement += change * (pair.weight[i] * vertex.mobility);
        }
    }

    // --- truncation --------------------------------------------------------------------------------------------------

    /// Truncates until all pairs are parted; true if a displacement has changed. What is held back is off its forecast,
    /// and may be met by others: they are looked at again.
    bool separate_all() {
        any_truncated_ = false;
        for (bool any = true; any;) {
            any = separate(room_.pairs[0]);
            any = separate(room_.pairs[1]) || any;
        }
        if (any_truncated_) look_ahead();
        return any_truncated_;
    }
    /// Gap that a pair keeps.
    Real kept_gap(Real distance) const {
        constexpr Real share = Real(0.2);
        return min(max(share * distance, room_.min_gap), distance);
    }
    /// Truncates the moves of pairs that their normal would not part at the end of the substep; false if there are
    /// none. A plane that parts both ends of a linear motion parts everything between.
    bool separate(FeaturePairs<Real>& pairs) {
        room_.tail.clear();
        for (std::uint32_t i = 0; i < pairs.near.size(); ++i)
            if (const auto& pair = pairs.near[i];
                !pair.is_fixed && !(pair.is_parted && gap_ahead(pair, pairs.first_side) >= kept_gap(pair.distance)))
                room_.tail.push_back(i);
        std::sort(room_.tail.begin(), room_.tail.end(),
                  [&](auto a, auto b) { return pairs.near[a].vertex < pairs.near[b].vertex; });
        for (const auto i : room_.tail) {
            pairs.near[i].is_fixed = true;
            fix(pairs.near[i], pairs.first_side);
        }
        return !room_.tail.empty();
    }
    Real gap_ahead(const NearPair<Real>& pair, std::size_t first_side) const {
        auto height = pair.height;
        for (std::size_t i = 0; i < 4; ++i) height[i] += dot(pair.normal, room_.vertices[pair.vertex[i]].displacement);
        return gap_of(height, first_side);
    }
    /// From now on the plane in the middle stays: each side stops before it.
    void fix(NearPair<Real>& pair, std::size_t first_side) {
        if (!pair.is_parted || gap(pair, first_side) < Real(0.5) * pair.distance) find_direction(pair, first_side);
        const Real distance = gap(pair, first_side);
        if (distance < Real(1e-3) * room_.min_gap) return; // in touch from the beginning: no side to stay on
        const Real half = Real(0.5) * kept_gap(distance);
        const Real low = first_side == 2 ? min(pair.height[0], pair.height[1]) : pair.height[0];
        const Real middle = low - Real(0.5) * distance;
        for (std::size_t i = 0; i < 4; ++i) {
            const Real side = i < first_side ? Real(1) : Real(-1);
            auto& displacement = room_.vertices[pair.vertex[i]].displacement;
            const Real room = side * (pair.height[i] - middle) - half, along = side * dot(pair.normal, displacement);
            if (along >= Real(0) || room + along >= Real(0)) continue;
            displacement *= clamp(Real(-0.99) * room / along, Real(0), Real(1));
            any_truncated_ = true;
        }
    }
    void find_direction(NearPair<Real>& pair, std::size_t first_side) const {
        FeatureCorners<double> corner;
        for (std::size_t i = 0; i < 4; ++i) corner[i] = cast<double>(room_.vertices[pair.vertex[i]].position);
        const auto direction = PartingDirection(corner, first_side).find();
        pair.normal = cast<Real>(direction);
        for (std::size_t i = 0; i < 4; ++i) pair.height[i] = Real(dot(direction, corner[i] - corner[0]));
    }
};

} // namespace

template <int D, class Real>
void part_thin_cloth(const World<D, Real>& world, SweepState<D, Real>& state, ThinRoom<D, Real>& room,
                     const SubstepSpan<Real>& span) {
    if constexpr (D == 3) ThinContact<Real>(world, state, room, span).solve();
}
template <int D, class Real>
void truncate_thin_cloth(const World<D, Real>& world, SweepState<D, Real>& state, ThinRoom<D, Real>& room,
                         const SubstepSpan<Real>& span) {
    if constexpr (D == 3) ThinContact<Real>(world, state, room, span).truncate();
}

#define SINEW_THIN_CONTACT(D, Real)                                                                                    \
    template void part_thin_cloth(const World<D, Real>&, SweepState<D, Real>&, ThinRoom<D, Real>&,                     \
                                  const SubstepSpan<Real>&);                                                           \
    template void truncate_thin_cloth(const World<D, Real>&, SweepState<D, Real>&, ThinRoom<D, Real>&,                 \
                                      const SubstepSpan<Real>&);
SINEW_INSTANTIATE(SINEW_THIN_CONTACT)

} // namespace sinew::detail
