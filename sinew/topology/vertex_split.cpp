#include "sinew/topology/vertex_split.h"

#include "sinew/topology/cell_fans.h"
#include "sinew/topology/split_follower.h"
#include "sinew/world/changes.h"
#include "sinew/world/constraint_graph.h"
#include "sinew/world/edit.h"

#include <algorithm>

namespace sinew {
namespace {

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
        partings_ = VertexSplits(particles_);
        auto all = links_;
        all.insert(all.end(), gone_.begin(), gone_.end());
        const auto whole = neighbours_of(particles_, all), left = neighbours_of(particles_, links_);
        Fans before(whole, particles_), after(left, particles_);
        for (const Row row : around_the_gaps(whole)) {
            const auto cell_fans = cell_fans_of(row, whole[row], before.around(row), left[row], after);
            if (cell_fans.size() > 1) part(row, left[row], after.around(row), cell_fans);
        }
        if (partings_.empty()) return 0;
        SplitFollower<D, Real>(world_, partings_).follow();
        return world_.particles.size() - particles_;
    }

  private:
    World<D, Real>& world_;
    std::size_t particles_;
    VertexSplits partings_;
    std::vector<std::array<Row, 2>> links_, gone_;

    /// Collects the links around the gaps, as far as needed for the cell_fans of neighbours. False if the links form no
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

    /// Remaining cell_fans of a particle; single links do not count.
    static std::vector<Fan> cell_fans_of(Row row, std::span<const Row> once, const std::vector<Row>& was,
                                         std::span<const Row> near, Fans& after) {
        std::vector<Fan> cell_fans;
        const auto now = after.around(row);
        for (std::size_t i = 0; i < near.size(); ++i) {
            const auto known =
                std::find_if(cell_fans.begin(), cell_fans.end(), [&](const Fan& fan) { return fan.first == now[i]; });
            if (known != cell_fans.end()) {
                ++known->size;
                continue;
            }
            const auto found = std::lower_bound(once.begin(), once.end(), near[i]) - once.begin();
            cell_fans.push_back({now[i], was[std::size_t(found)], 1});
        }
        std::erase_if(cell_fans, [](const Fan& fan) { return fan.size == 1; });
        return cell_fans;
    }

    /// Gives each fan a new particle, except the largest of each former fan.
    void part(Row row, std::span<const Row> near, const std::vector<Row>& now, const std::vector<Fan>& cell_fans) {
        VertexSplit parting{row, {near.begin(), near.end()}, std::vector<Row>(near.size(), row)};
        std::size_t leaving = 0;
        for (const auto& fan : cell_fans) {
            const bool stays = std::none_of(cell_fans.begin(), cell_fans.end(), [&](const Fan& other) {
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
        partings_.add(std::move(parting));
    }

    Row double_of(Row row, Real share) {
        auto& p = world_.particles;
        p.columns(p, [&](auto& column) {
            const auto value = column[row];
            column.push_back(value);
        });
        const auto id = p.handles.append();
        detail::note_particle(world_);
        const Row twin = Row(p.size() - 1);
        p.energy_debt.set(twin, 0); // stays with the original
        lighten(twin, share);
        if (const auto figure = p.figure[row]; figure < world_.figures.size())
            world_.figures[figure].particles.push_back(id);
        return twin;
    }

    void lighten(Row row, Real share) {
        auto& p = world_.particles;
        p.inverse_mass[row] = min(p.inverse_mass[row] / share, limit::mass<Real>);
        p.mobility[row] = min(p.mobility[row] / share, limit::mass<Real>);
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
