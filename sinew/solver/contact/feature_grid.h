#pragma once

#include "sinew/collide/bounding_box.h"
#include "sinew/collide/grid_cell.h"
#include "sinew/math/lane.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace sinew::detail {

/// Balls of unequal radius around points, for search by boxes and along segments. Cells of a grid that repeats itself
/// in all directions: those of a row lie one after the other, so that a search reads few runs of points, many of them
/// abreast. The few balls of far more than the mean radius are kept apart, else all searches would be as wide as
/// theirs.
template <int D, class Real> class FeatureGrid {
  public:
    using Vector = Vec<D, Real>;

    void fill(std::span<const Vector> points, std::span<const Real> radii) {
        set_apart(points, radii);
        choose_size(points);
        sort(points, radii);
    }
    /// Also for search along segments: velocity, size and group of each point.
    void fill(std::span<const Vector> points, std::span<const Real> radii, std::span<const Vector> velocities,
              std::span<const Real> sizes, std::span<const std::uint32_t> groups) {
        fill(points, radii);
        for (auto& column : velocity_) column.resize(usual_.size() + width);
        size_.resize(usual_.size() + width), group_.resize(usual_.size());
        for (std::size_t i = 0; i < usual_.size(); ++i) {
            const auto number = number_[i];
            for (int k = 0; k < D; ++k) velocity_[std::size_t(k)][i] = velocities[number][k];
            size_[i] = sizes[number], group_[i] = groups[number];
        }
    }

    /// Segment that looks for points.
    struct SearchedFeature {
        Vector a{}, b{}, velocity_a{}, velocity_b{};
        Real radius = 0;         ///< of the search, as for a ball
        Real near = 0;           ///< distance beyond a point's size at which it counts, without the approach
        Real ahead = 0;          ///< time for which relative speed brings a point nearer
        std::uint32_t group = 0; ///< whose points do not count
    };

    /// Calls visit(number) for all points whose balls may meet the box, in no useful order.
    template <class Visit> void each_near(const collide::BoundingBox<D, Real>& box, Visit&& visit) const {
        each_run(box.grown(widest_), [&](std::uint32_t first, std::uint32_t last) {
            for (auto i = first; i < last; ++i) visit(number_[i]);
        });
        for (const auto number : large_) visit(number);
    }

    /// Calls visit(number) for all points that count for a segment, and for some more, in no useful order.
    template <class Visit> void each_near(const SearchedFeature& searched, Visit&& visit) const {
        collide::BoundingBox<D, Real> box;
        box.include(searched.a);
        box.include(searched.b);
        const auto along = searched.b - searched.a;
        const Real per_square = inverse_or_zero(dot(along, along));
        each_run(box.grown(searched.radius + widest_), [&](std::uint32_t first, std::uint32_t last) {
            for (; first < last; first += width) {
                const auto near = find_near(first, searched, along, per_square);
                if (!any(near)) continue;
                const auto count = std::min(last - first, width);
                for (std::uint32_t i = 0; i < count; ++i)
                    if (near[i] != Real(0) && group_[first + i] != searched.group) visit(number_[first + i]);
            }
        });
        for (const auto number : large_) visit(number);
    }

  private:
    using Cell = std::array<std::int64_t, D>;
    static constexpr std::uint32_t width = lane::widest<Real>;
    using Flags = std::array<Real, width>;

    Real per_size_ = 1, widest_ = 0;            ///< largest radius of the usual points
    std::array<std::uint32_t, D> cells_{};      ///< along each axis, a power of two
    std::vector<std::uint32_t> start_;          ///< first point of each cell, and the end
    std::array<std::vector<Real>, D> position_; ///< by cells, with room for a pack at the end
    std::array<std::vector<Real>, D> velocity_;
    std::vector<Real> radius_, size_; ///< likewise
    std::vector<std::uint32_t> number_, group_, cell_of_, usual_, large_;

    void set_apart(std::span<const Vector> points, std::span<const Real> radii) {
        constexpr Real far_more = 4, cell = 2; // mean radii: a search visits few cells, and few points in vain
        Real sum = 0;
        for (const Real radius : radii) sum += radius;
        const Real mean = radii.empty() ? Real(1) : sum / Real(radii.size());
        per_size_ = mean > Real(0) ? Real(1) / (cell * mean) : Real(1);
        usual_.clear(), large_.clear();
        widest_ = 0;
        for (std::uint32_t i = 0; i < points.size(); ++i)
            if (radii[i] > far_more * mean)
                large_.push_back(i);
            else
                usual_.push_back(i), widest_ = max(widest_, radii[i]);
    }

    /// About two cells a point, more of them along the axes along which the points are spread out; a stray point among
    /// many changes little.
    void choose_size(std::span<const Vector> points) {
        const Real per = inverse_or_zero(Real(usual_.size()));
        Vector mean{}, spread{};
        for (const auto i : usual_) mean += points[i];
        mean *= per;
        for (const auto i : usual_) spread += Vector::map([&](int k) { return absolute(points[i][k] - mean[k]); });
        cells_.fill(1);
        for (std::size_t all = 1; all < 2 * usual_.size(); all *= 2) {
            int widest = 0;
            const auto repeats = [&](int k) { return spread[k] / Real(cells_[std::size_t(k)]); };
            for (int k = 1; k < D; ++k)
                if (repeats(k) > repeats(widest)) widest = k;
            cells_[std::size_t(widest)] *= 2;
        }
    }

    void sort(std::span<const Vector> points, std::span<const Real> radii) {
        std::size_t cells = 1;
        for (const auto count : cells_) cells *= count;
        start_.assign(cells + 2, 0);
        cell_of_.clear();
        for (const auto i : usual_) {
            cell_of_.push_back(index_of(cell_at(points[i])));
            ++start_[cell_of_.back() + 2];
        }
        for (std::size_t i = 2; i < start_.size(); ++i) start_[i] += start_[i - 1];
        for (auto& column : position_) column.resize(usual_.size() + width);
        radius_.resize(usual_.size() + width), number_.resize(usual_.size());
        for (std::size_t i = 0; i < usual_.size(); ++i) {
            const auto number = usual_[i], at = start_[cell_of_[i] + 1]++;
            for (int k = 0; k < D; ++k) position_[std::size_t(k)][at] = points[number][k];
            radius_[at] = radii[number], number_[at] = number;
        }
    }

    Cell cell_at(const Vector& point) const { return collide::cell_at<std::int64_t>(point, per_size_); }
    std::uint32_t index_of(const Cell& cell) const {
        std::uint32_t index = 0;
        for (std::size_t i = D; i-- > 0;) index = index * cells_[i] + wrapped(cell[i], i);
        return index;
    }
    std::uint32_t wrapped(std::int64_t cell, std::size_t axis) const {
        return std::uint32_t(cell) & (cells_[axis] - 1);
    }

    /// Calls visit(first, last) for the runs of points in the cells that the box meets.
    template <class Visit> void each_run(const collide::BoundingBox<D, Real>& box, Visit&& visit) const {
        const auto low = cell_at(box.low), high = cell_at(box.high);
        Cell cell = low;
        const auto count = [&](std::size_t i) { return std::min<std::int64_t>(high[i] - low[i] + 1, cells_[i]); };
        const auto across = std::uint32_t(count(0));
        for (std::size_t axis = 0; axis < D;) {
            visit_row(index_of(cell), across, visit);
            for (axis = 1; axis < D; ++axis) {
                if (++cell[axis] < low[axis] + count(axis)) break;
                cell[axis] = low[axis];
            }
        }
    }
    /// A row ends where the next one begins, and goes on at its start.
    template <class Visit> void visit_row(std::uint32_t index, std::uint32_t across, Visit&& visit) const {
        const auto begin = index & ~(cells_[0] - 1), end = begin + cells_[0], last = std::min(index + across, end);
        visit(start_[index], start_[last]);
        if (index + across > end) visit(start_[begin], start_[index + across - cells_[0]]);
    }

    using Pack = lane::Pack<Real, int(width)>;
    static Pack load(const std::vector<Real>& column, std::uint32_t first) {
        return lane::load<Pack>(column.data() + first);
    }
    /// Flags of the next points: 1 where the point counts for a segment.
    Flags find_near(std::uint32_t first, const SearchedFeature& searched, const Vector& along, Real per_square) const {
        const Pack zero{}, one = lane::spread<Pack>(Real(1));
        Pack from[D], part{}, far{};
        for (int k = 0; k < D; ++k) {
            from[k] = load(position_[std::size_t(k)], first) - searched.a[k];
            part = part + from[k] * along[k];
        }
        part = part * per_square;
        part = part < zero ? zero : part;
        part = part > one ? one : part;
        for (int k = 0; k < D; ++k) {
            from[k] = from[k] - part * along[k];
            far = far + from[k] * from[k];
        }
        const Pack max = load(radius_, first) + searched.radius;
        Flags flags;
        lane::store(flags.data(), Pack(far <= max * max ? one : zero));
        if (any(flags)) find_near(flags, first, searched, far);
        return flags;
    }
    /// Leaves 1 where the point is near enough for its speed relative to the ends.
    void find_near(Flags& flags, std::uint32_t first, const SearchedFeature& searched, const Pack& far) const {
        const Pack zero{}, one = lane::spread<Pack>(Real(1));
        Pack square_a{}, square_b{};
        for (int k = 0; k < D; ++k) {
            const Pack velocity = load(velocity_[std::size_t(k)], first);
            const Pack off_a = velocity - searched.velocity_a[k], off_b = velocity - searched.velocity_b[k];
            square_a = square_a + off_a * off_a, square_b = square_b + off_b * off_b;
        }
        const Pack speed = lane::root(lane::max(square_a, square_b));
        const Pack max = load(size_, first) + (speed * searched.ahead + searched.near);
        const Pack near = far <= max * max ? one : zero;
        lane::store(flags.data(), Pack(near * lane::load<Pack>(flags.data())));
    }
    static bool any(const Flags& flags) {
        Real sum = 0;
        for (const Real flag : flags) sum += flag;
        return sum > Real(0);
    }
};

} // namespace sinew::detail
