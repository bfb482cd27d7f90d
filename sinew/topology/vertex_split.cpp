#include "sinew/topology/vertex_split.h"

#include "sinew/topology/cell_fans.h"
#include "sinew/world/changes.h"
#include "sinew/world/constraint_graph.h"
#include "sinew/world/edit.h"

#include <algorithm>

namespace sinew {
namespace {

/// Vertex split: the new owner of each neighbour of a split particle.
struct VertexSplit {
    Row row = 0;
    std::vector<Row> neighbours; ///< sorted
    std::vector<Row> goes_to;    ///< the split particle, or one of the doubles

    /// Owner of a neighbour; nothing for other rows.
    std::optional<Row> side_of(Row neighbour) const {
        const auto found = std::lower_bound(neighbours.begin(), neighbours.end(), neighbour);
        if (found == neighbours.end() || *found != neighbour) return std::nullopt;
        return goes_to[std::size_t(found - neighbours.begin())];
    }
};

struct Fan {
    Row first = 0; ///< first neighbour
    Row was = 0;   ///< first neighbour of the former fan
    std::size_t size = 0;
};

template <int D, class Real> class Splitter {
  public:
    Splitter(World<D, Real>& world, std::span<const Ends> gone) : world_(world), particles_(world.particles.size()) {
        for (const auto& [a, b] : gone) {
            const auto from = row_of(world, a), to = row_of(world, b);
            if (from && to) gone_.push_back({*from, *to});
        }
    }

    std::size_t split() {
        if (!find_cells()) return 0;
        parting_of_.assign(particles_, none);
        auto all = links_;
        all.insert(all.end(), gone_.begin(), gone_.end());
        const auto whole = neighbours_of(particles_, all), left = neighbours_of(particles_, links_);
        Fans before(whole, particles_), after(left, particles_);
        for (const Row row : around_the_gaps(whole)) {
            const auto fans = fans_of(row, whole[row], before.around(row), left[row], after);
            if (fans.size() > 1) part(row, left[row], after.around(row), fans);
        }
        if (partings_.empty()) return 0;
        follow_constraints();
        for (auto& figure : world_.figures) follow_pieces(figure);
        return world_.particles.size() - particles_;
    }

  private:
    static constexpr std::size_t none = ~std::size_t(0);

    World<D, Real>& world_;
    std::size_t particles_;
    std::vector<VertexSplit> partings_;
    std::vector<std::size_t> parting_of_; // row -> index of the split, or none
    std::vector<std::array<Row, 2>> links_, gone_;

    /// Collects the links around the gaps, as far as needed for the fans of neighbours. False if the links form no
    /// loop.
    bool find_cells() {
        const auto& distances = std::get<kind_number<Distance, D>>(world_.constraints);
        std::vector<char> seen(particles_, 0);
        std::vector<Row> near;
        const auto meet = [&](Row row) {
            if (seen[row] != 0) return false;
            seen[row] = 1;
            near.push_back(row);
            return true;
        };
        for (const auto& ends : gone_)
            for (const Row end : ends) meet(end);
        constexpr int rings = 3;
        constexpr char done = 2;
        bool loops = false;
        std::size_t next = 0;
        for (int ring = 0; ring < rings; ++ring)
            for (const auto last = near.size(); next < last; ++next) {
                const Row row = near[next];
                seen[row] = done;
                for_each_link(world_, row, [&](Row link, Row other) {
                    if (!ties(distances, link) || seen[other] == done) return;
                    links_.push_back(distances.members.rows[link]);
                    loops = !meet(other) || loops;
                });
            }
        return loops;
    }

    /// Particles with a lost link, or next to one: without any pin.
    std::vector<Row> around_the_gaps(const Neighbours& whole) const {
        std::vector<char> there(particles_, 0);
        for (const auto& ends : gone_)
            for (const Row end : ends) {
                there[end] = 1;
                for (const Row near : whole[end]) there[near] = 1;
            }
        for (const auto& pin : world_.pins)
            if (const auto row = row_of(world_, pin.particle); row && *row < particles_) there[*row] = 0;
        std::vector<Row> rows;
        for (Row row = 0; row < particles_; ++row)
            if (there[row]) rows.push_back(row);
        return rows;
    }

    /// Remaining fans of a particle; single links do not count.
    static std::vector<Fan> fans_of(Row row, std::span<const Row> once, const std::vector<Row>& was,
                                    std::span<const Row> near, Fans& after) {
        std::vector<Fan> fans;
        const auto now = after.around(row);
        for (std::size_t i = 0; i < near.size(); ++i) {
            const auto known =
                std::find_if(fans.begin(), fans.end(), [&](const Fan& fan) { return fan.first == now[i]; });
            if (known != fans.end()) {
                ++known->size;
                continue;
            }
            const auto place = std::lower_bound(once.begin(), once.end(), near[i]) - once.begin();
            fans.push_back({now[i], was[std::size_t(place)], 1});
        }
        std::erase_if(fans, [](const Fan& fan) { return fan.size == 1; });
        return fans;
    }

    /// Gives each fan a new particle, except the largest of each former fan.
    void part(Row row, std::span<const Row> near, const std::vector<Row>& now, const std::vector<Fan>& fans) {
        VertexSplit parting{row, {near.begin(), near.end()}, std::vector<Row>(near.size(), row)};
        std::size_t leaving = 0;
        for (const auto& fan : fans) {
            const bool stays = std::none_of(fans.begin(), fans.end(), [&](const Fan& other) {
                return other.was == fan.was &&
                       (other.size > fan.size || (other.size == fan.size && other.first < fan.first));
            });
            if (stays) continue;
            const Row twin = double_of(row, Real(fan.size) / Real(near.size()));
            leaving += fan.size;
            for (std::size_t i = 0; i < near.size(); ++i)
                if (now[i] == fan.first) parting.goes_to[i] = twin;
        }
        if (leaving == 0) return;
        lighten(row, Real(near.size() - leaving) / Real(near.size()));
        parting_of_[row] = partings_.size();
        partings_.push_back(std::move(parting));
    }

    Row double_of(Row row, Real share) {
        auto& p = world_.particles;
        p.columns(p, [&](auto& column) {
            const auto value = column[row];
            column.push_back(value);
        });
        const auto id = p.slots.append();
        detail::note_particle(world_);
        const Row twin = Row(p.size() - 1);
        lighten(twin, share);
        if (const auto figure = p.figure[row]; figure < world_.figures.size())
            world_.figures[figure].particles.push_back(id);
        return twin;
    }

    void lighten(Row row, Real share) {
        auto& p = world_.particles;
        p.inverse_mass[row] = minimum(p.inverse_mass[row] / share, limit::mass<Real>);
        p.mobility[row] = minimum(p.mobility[row] / share, limit::mass<Real>);
    }

    const VertexSplit* parting_of(Row row) const {
        return row < particles_ && parting_of_[row] != none ? &partings_[parting_of_[row]] : nullptr;
    }

    // --- constraints and pieces --------------------------------------------------------------------------------------

    /// Moves constraints to the particle on the side of their other members; removes constraints with members on
    /// several sides.
    void follow_constraints() {
        std::vector<ConstraintId> torn_apart;
        int kind = 0;
        std::vector<Row> moved;
        for_each_table(world_, [&](auto& table) {
            for (Row row = 0; row < table.size(); ++row) {
                const auto members = table.members[row];
                moved.assign(members.begin(), members.end());
                bool whole = true;
                for (std::size_t i = 0; i < members.size(); ++i)
                    if (const auto* parting = parting_of(members[i]))
                        whole = follow(*parting, members, moved[i]) && whole;
                if (!whole) torn_apart.push_back({kind, table.slots.id_of(row)});
                for (std::size_t i = 0; i < members.size(); ++i) move(table, kind, row, i, moved[i]);
            }
            ++kind;
        });
        remove_constraints(world_, std::span<const ConstraintId>(torn_apart));
    }

    template <class Table> void move(Table& table, int kind, Row row, std::size_t member, Row to) {
        Row& from = table.members[row][member];
        if (from == to) return;
        detail::note_member_gone(world_, table, kind, row, from);
        detail::note_member(world_, table, kind, row, to);
        from = to;
    }

    static bool follow(const VertexSplit& parting, std::span<const Row> members, Row& moved) {
        bool followed = false;
        for (const Row member : members) {
            const auto side = parting.side_of(member);
            if (!side) continue;
            if (followed && *side != moved) return false;
            moved = *side;
            followed = true;
        }
        return true;
    }

    /// Divides a line at a split particle if the two sides have different owners.
    void follow_pieces(Figure& figure) {
        std::vector<Piece> pieces;
        pieces.reserve(figure.pieces.size());
        for (auto& piece : figure.pieces) {
            const bool parted = std::any_of(piece.particles.begin(), piece.particles.end(), [&](ParticleId id) {
                const auto row = row_of(world_, id);
                return row && parting_of(*row);
            });
            if (parted && piece.mark == Mark::fragment)
                pieces.push_back(followed(std::move(piece)));
            else if (parted && piece.mark != Mark::dot)
                follow(piece, pieces);
            else
                pieces.push_back(std::move(piece));
        }
        figure.pieces = std::move(pieces);
    }

    /// Moves a fragment's particles to the side of their neighbours within the fragment.
    Piece followed(Piece piece) const {
        IdList<ParticleId> ids;
        for (const auto id : piece.particles) {
            const auto row = row_of(world_, id);
            const auto* parting = row ? parting_of(*row) : nullptr;
            std::optional<Row> side;
            for (const auto other : piece.particles)
                if (const auto near = row_of(world_, other); parting && near && !side) side = parting->side_of(*near);
            ids.push_back(side ? world_.particles.slots.id_of(*side) : id);
        }
        piece.particles = std::move(ids);
        return piece;
    }

    void follow(const Piece& piece, std::vector<Piece>& pieces) const {
        const bool closed = piece.mark == Mark::loop || piece.mark == Mark::fill || is_cloth(piece.mark);
        const auto& ids = piece.particles;
        const std::size_t size = ids.size();
        const auto id_on = [&](const VertexSplit& parting, ParticleId other) -> std::optional<ParticleId> {
            const auto row = row_of(world_, other);
            const auto side = row ? parting.side_of(*row) : std::nullopt;
            return side ? std::optional(world_.particles.slots.id_of(*side)) : std::nullopt;
        };
        Piece part = piece;
        part.particles.clear();
        for (std::size_t i = 0; i < size; ++i) {
            const auto row = row_of(world_, ids[i]);
            const auto* parting = row ? parting_of(*row) : nullptr;
            const bool has_last = closed || i > 0, has_next = closed || i + 1 < size;
            const auto from = parting && has_last ? id_on(*parting, ids[(i + size - 1) % size]) : std::nullopt;
            const auto on = parting && has_next ? id_on(*parting, ids[(i + 1) % size]) : std::nullopt;
            part.particles.push_back(from ? *from : on ? *on : ids[i]);
            if (closed || !from || !on || *from == *on) continue;
            pieces.push_back(part);
            part.particles = {*on};
        }
        pieces.push_back(std::move(part));
    }
};

} // namespace

template <int D, class Real> std::size_t split(World<D, Real>& world, std::span<const Ends> gone) {
    if (gone.empty()) return 0;
    detail::list_constraints(world);
    return Splitter<D, Real>(world, gone).split();
}

#define SINEW_SPLIT(D, Real) template std::size_t split(World<D, Real>&, std::span<const Ends>);
SINEW_INSTANTIATE(SINEW_SPLIT)

} // namespace sinew
