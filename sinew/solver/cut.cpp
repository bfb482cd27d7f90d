#include "sinew/solver/cut.h"

#include "sinew/solver/split.h"

#include <algorithm>

namespace sinew {
namespace {

double side_of(const Vec2<double>& from, const Vec2<double>& to, const Vec2<double>& point) {
    return cross(to - from, point - from);
}

double distance_to(const Vec2<double>& point, const Vec2<double>& a, const Vec2<double>& b) {
    const double share = dot(point - a, b - a) * inverse_or_zero(dot(b - a, b - a));
    return distance(point, a + (b - a) * clamp(share, 0.0, 1.0));
}

bool crosses(const Blade& blade, const Vec2<double>& a, const Vec2<double>& b) {
    const bool apart = (side_of(blade.from, blade.to, a) > 0) != (side_of(blade.from, blade.to, b) > 0);
    if (apart && (side_of(a, b, blade.from) > 0) != (side_of(a, b, blade.to) > 0)) return true;
    return blade.reach > 0 &&
           (distance_to(a, blade.from, blade.to) <= blade.reach ||
            distance_to(b, blade.from, blade.to) <= blade.reach || distance_to(blade.from, a, b) <= blade.reach ||
            distance_to(blade.to, a, b) <= blade.reach);
}

/// Finds what holds both ends of a link that is cut: each particle knows its cut links, and a constraint counts the
/// ends it meets.
class Dangling {
  public:
    Dangling(std::size_t particles, std::span<const std::array<Row, 2>> links)
        : first_(particles + 1, 0), link_(2 * links.size()), met_(links.size(), nobody) {
        for (const auto& ends : links)
            for (const Row end : ends) ++first_[end + 1];
        for (std::size_t i = 0; i < particles; ++i) first_[i + 1] += first_[i];
        auto next = first_;
        for (std::size_t i = 0; i < links.size(); ++i)
            for (const Row end : links[i]) link_[next[end]++] = i;
    }

    /// Whether both ends of a cut link are among the members; `number` is another one for every constraint asked about.
    bool is_on_one(std::span<const Row> members, std::size_t number) {
        for (const Row member : members)
            for (std::size_t i = first_[member]; i < first_[member + 1]; ++i) {
                if (met_[link_[i]] == number) return true;
                met_[link_[i]] = number;
            }
        return false;
    }

  private:
    static constexpr std::size_t nobody = ~std::size_t(0);
    std::vector<std::size_t> first_, link_; // the links of each row, one row's after the other's
    std::vector<std::size_t> met_;          // the last constraint that has an end of it
};

/// Distances, in the order of their rows, and then what hangs on them.
template <int D, class Real>
std::vector<ConstraintId> with_what_hangs(const World<D, Real>& world, std::span<const ConstraintId> ids) {
    constexpr int link_kind = kind_number<Distance, D>;
    const auto& distances = std::get<link_kind>(world.constraints);
    std::vector<ConstraintId> all(ids.begin(), ids.end());
    std::vector<std::array<Row, 2>> links;
    for (const auto& id : ids)
        if (const auto row = id.kind == link_kind ? distances.slots.find(id.id) : std::nullopt)
            links.push_back(distances.members.rows[*row]);
    if (links.empty()) return all;
    Dangling hanging(world.particles.size(), links);
    std::size_t number = 0;
    int kind = 0;
    for_each_table(world, [&](const auto& table) {
        if (kind != link_kind)
            for (Row row = 0; row < table.size(); ++row)
                if (hanging.is_on_one(table.members[row], number++)) all.push_back({kind, table.slots.id_of(row)});
        ++kind;
    });
    return all;
}

} // namespace

template <int D, class Real> std::vector<Vec2<double>> flat_places(const World<D, Real>& world) {
    std::vector<Vec2<double>> places;
    places.reserve(world.particles.size());
    for (const auto& place : world.particles.position) places.push_back({{double(place[0]), double(place[1])}});
    return places;
}

template <int D, class Real> Cut cut(World<D, Real>& world, const Blade& blade, std::span<const Vec2<double>> places) {
    const auto& distances = std::get<kind_number<Distance, D>>(world.constraints);
    std::vector<ConstraintId> crossed;
    for (Row row = 0; row < distances.size(); ++row) {
        const auto ends = distances.members[row];
        const auto &a = places[ends[0]], &b = places[ends[1]];
        if (ties(distances, row) && is_finite(a) && is_finite(b) && crosses(blade, a, b))
            crossed.push_back({kind_number<Distance, D>, distances.slots.id_of(row)});
    }
    return cut(world, std::span<const ConstraintId>(crossed));
}

template <int D, class Real> Cut cut(World<D, Real>& world, std::span<const ConstraintId> ids) {
    constexpr int link_kind = kind_number<Distance, D>;
    const auto& distances = std::get<link_kind>(world.constraints);
    Cut done;
    if (ids.empty()) return done;
    std::vector<Ends> gone;
    for (const auto& id : ids) {
        const auto row = id.kind == link_kind ? distances.slots.find(id.id) : std::nullopt;
        if (!row) continue;
        const auto ends = distances.members[*row];
        gone.push_back({world.particles.slots.id_of(ends[0]), world.particles.slots.id_of(ends[1])});
        done.figures.push_back(distances.figure[*row]);
    }
    done.links = gone.size();
    std::sort(done.figures.begin(), done.figures.end());
    done.figures.erase(std::unique(done.figures.begin(), done.figures.end()), done.figures.end());
    const auto all = with_what_hangs(world, ids);
    remove_constraints(world, std::span<const ConstraintId>(all));
    sever(world, std::span<const Ends>(gone));
    done.doubled = split(world, std::span<const Ends>(gone));
    return done;
}

#define SINEW_CUT(D, Real)                                                                                             \
    template std::vector<Vec2<double>> flat_places(const World<D, Real>&);                                             \
    template Cut cut(World<D, Real>&, const Blade&, std::span<const Vec2<double>>);                                    \
    template Cut cut(World<D, Real>&, std::span<const ConstraintId>);
SINEW_INSTANTIATE(SINEW_CUT)

} // namespace sinew
