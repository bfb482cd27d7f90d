#include "sinew/math/sort.h"
#include "sinew/solver/contact/behind_walls.h"
#include "sinew/solver/contact/cloth_features.h"
#include "sinew/solver/contact/collider_sweep.h"
#include "sinew/solver/contact/contact_room.h"
#include "sinew/solver/contact/face_features.h"
#include "sinew/solver/contact/kept_contacts.h"
#include "sinew/solver/contact/polyhedron_features.h"
#include "sinew/world/body_shape.h"

#include <algorithm>
#include <utility>

/// Features of figures that are near something.
namespace sinew {
namespace {

template <int D, class Real> class FeatureFinder {
  public:
    FeatureFinder(World<D, Real>& world, Solver<D, Real>& solver)
        : world_(world), solver_(solver), room_(contact_room(solver)) {}

    void run() {
        auto& state = solver_.sweep_state;
        room_.particles.clear();
        room_.segments.clear();
        room_.by_rows.assign(state.size(), 0);
        if (room_.is_stale) {
            detail::ClothFeatures<D, Real>(world_, state, room_.cloth).find();
            room_.thin.vertices.clear();
            detail::ClothMeshBuilder<D, Real>(world_, state, room_.thin.mesh).build(detail::MeshOf::thin);
            room_.thin.reserve();
        }
        for (FigureIndex i = 0; i < world_.figures.size(); ++i)
            if (world_.figures[i].in_use() && any_near(world_.figures[i])) add_segments(i);
        list_particles();
        number_segments();
        room_.projector.find(world_, solver_, room_.by_rows, room_.is_exact);
        if constexpr (D == 3) detail::PolyhedronFeatures<Real>(world_, room_).find();
        room_.list.note_features(room_.particles, room_.segments, room_.polyhedra.solids);
        if (room_.is_stale) room_.list.is_valid = false;
        room_.all_by_rows = std::ranges::find(room_.by_rows, char(0)) == room_.by_rows.end();
        divide();
        find_buried();
        for (const Row slot : room_.cloth.slots) room_.is_exact[slot] = 0;
        room_.joints.find(world_, solver_,
                          [&](Row slot) { return slot < state.size() && is_held_exactly(solver_, slot); });
        room_.exact_components.clear();
        room_.cloth_components.clear();
        for (const auto& component : state.plan.components) {
            room_.exact_components.push_back(is_held_exactly(solver_, component));
            room_.cloth_components.push_back(has_cloth(component));
        }
        detail::FaceFeatures<D, Real>(world_, state, room_).find(room_.is_stale);
        if (std::exchange(room_.is_stale, false)) list_links();
    }

  private:
    World<D, Real>& world_;
    Solver<D, Real>& solver_;
    ContactRoom<D, Real>& room_;
    static constexpr std::uint32_t none = ~std::uint32_t(0);

    void find_buried() {
        const auto& links = room_.projector.links();
        room_.is_buried.assign(links.components.size(), 0);
        room_.islands.reserve(room_.projector.bodies());
        room_.island_rows.reserve(4 * room_.particles.size());
        room_.held_rows.reserve(room_.particles.size());
        for (const auto& link : links.list)
            for (const auto& [held, moving] : {std::pair{link.a, link.b}, {link.b, link.a}})
                if (const Row row = solver_.sweep_state.row_of[held]; world_.particles.mobility[row] == Real(0))
                    if (detail::is_behind_walls(world_, row)) room_.is_buried[links.component_of[moving]] = 1;
    }
    bool has_cloth(const Component& component) const {
        const auto& slots = room_.cloth.slots; // ascending
        const auto next = std::lower_bound(slots.begin(), slots.end(), component.begin.slot);
        return next != slots.end() && *next < solver_.sweep_state.plan.end_of(component).slot;
    }

    /// Walls hold cloth as they hold everything swept, and faces meet other figures (face_contact.h); rows hold the
    /// rest. Particles of cloth are listed where a segment ends.
    void list_particles() {
        const auto& state = solver_.sweep_state;
        bool any_other = false;
        room_.number_of.assign(world_.particles.size(), none);
        constexpr auto is_end = none - 1;
        for (const auto& s : room_.segments) room_.number_of[s.a] = room_.number_of[s.b] = is_end;
        for (Row row = 0; row < world_.particles.size(); ++row) {
            const bool is_unlisted = room_.is_of_cloth(row) && room_.number_of[row] != is_end;
            room_.number_of[row] = none;
            if (is_unlisted) continue;
            const auto figure = world_.particles.figure[row];
            if (figure >= world_.figures.size() || !world_.particles.near[row]) continue;
            if (state.slot_of[row] >= state.size()) continue;
            room_.number_of[row] = std::uint32_t(room_.particles.size());
            room_.particles.push_back({.row = row,
                                       .slot = state.slot_of[row],
                                       .figure = figure,
                                       .radius = world_.particles.radius[row],
                                       .friction = Real(world_.figures[figure].friction),
                                       .restitution = Real(world_.figures[figure].bounce)});
            room_.by_rows[state.slot_of[row]] = !room_.is_of_cloth(row);
            any_other = any_other || !room_.is_of_cloth(row);
        }
        if (!any_other) room_.particles.clear();
    }
    /// Segments by their ends among the particles; those of particles that take no part are dropped.
    void number_segments() {
        const auto number = [&](Row row) { return room_.particles.empty() ? none : room_.number_of[row]; };
        SINEW_ASSERT(std::all_of(room_.segments.begin(), room_.segments.end(),
                                 [&](const auto& s) { return (number(s.a) == none) == (number(s.b) == none); }),
                     "a segment takes part with both ends");
        std::erase_if(room_.segments, [&](const auto& s) { return number(s.a) == none || number(s.b) == none; });
        auto& first = room_.first_segment_at;
        first.assign(room_.particles.size() + 2, 0);
        for (auto& segment : room_.segments) {
            segment.number_a = number(segment.a), segment.number_b = number(segment.b);
            const Real radius = min(radius_at(segment.number_a), radius_at(segment.number_b));
            for (const auto end : {segment.number_a, segment.number_b}) {
                room_.particles[end].in_segment = true;
                room_.particles[end].beside = segment.number_a + segment.number_b - end;
                room_.particles[end].is_covered |= radius_at(end) <= radius;
            }
            ++first[segment.number_a + 2];
        }
        for (std::size_t i = 2; i < first.size(); ++i) first[i] += first[i - 1];
        room_.segments_at.resize(room_.segments.size());
        for (std::uint32_t i = 0; i < room_.segments.size(); ++i)
            room_.segments_at[first[room_.segments[i].number_a + 1]++] = i;
    }

    Real radius_at(std::uint32_t number) const { return room_.particles[number].radius; }
    using Parts = detail::ContactParts<D, Real>;

    /// Strips of equal numbers of particles, by the places at the start of the step. A figure with segments is in one
    /// strip, and so is a rigid cluster.
    void divide() {
        auto& across = room_.parts.across;
        across.clear();
        const auto count = room_.particles.size();
        auto& first_of = room_.parts.first_of_figure;
        first_of.assign(world_.figures.size(), none);
        for (std::uint32_t i = 0; i < count; ++i) {
            auto& lead = first_of[room_.particles[i].figure];
            if (lead == none) lead = i;
            across.push_back(
                world_.particles.position[room_.particles[room_.particles[i].in_segment ? lead : i].row][0]);
        }
        gather_clusters();
        auto& sorted = room_.parts.sorted;
        std::array<Real, Parts::strips> ends;
        const std::uint32_t strips = count < Parts::worth_it ? 1 : Parts::strips;
        sorted.assign(across.begin(), across.end());
        for (std::uint32_t k = 1; k < strips; ++k) {
            const auto at = sorted.begin() + std::ptrdiff_t(count * k / strips);
            std::nth_element(sorted.begin() + std::ptrdiff_t(count * (k - 1) / strips), at, sorted.end());
            ends[k - 1] = *at;
        }
        bool is_same = room_.list.strip.size() == count;
        room_.list.strip.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            const auto strip =
                std::uint32_t(std::upper_bound(ends.begin(), ends.begin() + (strips - 1), across[i]) - ends.begin());
            is_same = is_same && room_.list.strip[i] == strip;
            room_.particles[i].strip = room_.list.strip[i] = strip;
        }
        if (!is_same) room_.list.is_valid = false;
        share_out_walls();
    }
    void gather_clusters() {
        const auto cluster_of = room_.projector.cluster_of();
        auto& first_of = room_.parts.first_of_cluster;
        first_of.assign(room_.projector.links().clusters.clusters.size(), none);
        for (std::uint32_t i = 0; i < room_.particles.size(); ++i) {
            const auto cluster = cluster_of[room_.particles[i].slot];
            if (cluster == none) continue;
            if (first_of[cluster] == none) first_of[cluster] = i;
            room_.parts.across[i] = room_.parts.across[first_of[cluster]];
        }
    }
    void share_out_walls() {
        auto& parts = room_.parts.list;
        for (auto& part : parts) part.particles.clear(), part.segments.clear(), part.solids.clear();
        for (std::uint32_t i = 0; i < room_.particles.size(); ++i)
            if (!room_.is_of_cloth(room_.particles[i].row)) parts[room_.particles[i].strip].particles.push_back(i);
        if (world_.colliders.empty()) return;
        for (std::uint32_t i = 0; i < room_.polyhedra.solids.size(); ++i)
            parts[room_.particles[room_.polyhedra.lead(i)].strip].solids.push_back(i);
        for (std::uint32_t i = 0; i < room_.segments.size(); ++i) {
            const auto& s = room_.segments[i];
            const auto ends = std::minmax(room_.particles[s.number_a].strip, room_.particles[s.number_b].strip);
            if (!s.is_inner) parts[Parts::part_of(ends.first, ends.second)].segments.push_back(i);
        }
    }

    Row row_at(const Piece& piece, std::size_t i) const {
        return world_.particles.handles.find(piece.particles[i % piece.particles.size()]).value_or(no_row);
    }
    bool takes_part(Row row) const {
        return row != no_row && world_.particles.near[row] != 0 &&
               solver_.sweep_state.slot_of[row] < solver_.sweep_state.size();
    }
    bool any_near(const Figure& figure) const {
        return std::any_of(figure.particles.begin(), figure.particles.end(), [&](const auto& id) {
            const auto row = world_.particles.handles.find(id);
            return row && world_.particles.near[*row] != 0;
        });
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
            if (!takes_part(a) || !takes_part(b) || a == b) continue;
            if (room_.is_of_cloth(a) && room_.is_of_cloth(b)) continue;
            ContactSegment segment{.a = a, .b = b, .figure = figure, .side = side};
            if (auto* known = find(a, b, first_of_figure)) {
                if (!are_back_to_back(*known, segment)) continue;
                known->is_inner = segment.is_inner = true;
            }
            room_.segments.push_back(segment);
        }
        const auto count = std::uint32_t(room_.segments.size()) - first;
        for (auto i = first; i < room_.segments.size(); ++i)
            room_.segments[i].first = first, room_.segments[i].count = count;
    }
    ContactSegment* find(Row a, Row b, std::size_t first) {
        const auto found =
            std::find_if(room_.segments.begin() + std::ptrdiff_t(first), room_.segments.end(),
                         [&](const auto& s) { return (s.a == a && s.b == b) || (s.a == b && s.b == a); });
        return found == room_.segments.end() ? nullptr : &*found;
    }
    /// True for two segments between the same particles that are solid on different sides.
    static bool are_back_to_back(const ContactSegment& a, const ContactSegment& b) {
        return a.side != 0 && b.side != 0 && (a.side == b.side) != (a.a == b.a);
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
        sinew::sort(room_.links.begin(), room_.links.end());
    }
};

/// True if something swept may touch something. Figures far from everything are not swept.
template <int D, class Real> bool any_meets(const World<D, Real>& world, const Solver<D, Real>& solver) {
    if (!any_near(world.particles)) return false;
    const auto& slots = solver.sweep_state.row_of;
    return std::any_of(slots.begin(), slots.end(), [&](Row row) {
        return world.particles.mobility[row] > Real(0) && world.particles.near[row] != 0;
    });
}

} // namespace

template <int D, class Real> void find_contact_features(World<D, Real>& world, Solver<D, Real>& solver) {
    const bool any = any_meets(world, solver);
    if (!any) forget_contacts(world);
    if (!any && !solver.contacts) return;
    auto& room = contact_room(solver);
    room.is_active = any;
    if (!any) return;
    FeatureFinder(world, solver).run();
}

#define SINEW_CONTACT_FEATURES(D, Real) template void find_contact_features(World<D, Real>&, Solver<D, Real>&);
SINEW_INSTANTIATE(SINEW_CONTACT_FEATURES)

} // namespace sinew
