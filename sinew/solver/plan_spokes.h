#pragma once

#include "sinew/solver/world.h"

#include <algorithm>
#include <span>
#include <vector>

/// The rigid links of each particle of a sheet. In what is woven most particles have the same as others, to particles
/// that lie as many slots further on; these share one list.
namespace sinew::detail {

template <int D, class Real> class Spokes {
  public:
    struct Spoke {
        std::uint32_t apart; ///< from the particle's number to that of the other end, modulo 2^32
        Real length;
        friend bool operator==(const Spoke&, const Spoke&) = default;
    };

    explicit Spokes(const World<D, Real>& world)
        : distances_(std::get<kind_number<Distance, D>>(world.constraints)), swept_(world.swept),
          plan_(world.swept.plan) {}

    /// Of a sheet's particles, by their number in it: in the order of the plan.
    void list(const Sheet& sheet, std::size_t particles) {
        std::vector<std::uint32_t> first(particles + 2);
        each_rigid(sheet, [&](Row, std::uint32_t a, std::uint32_t b) { ++first[a + 2], ++first[b + 2]; });
        for (std::size_t s = 2; s < first.size(); ++s) first[s] += first[s - 1];
        std::vector<Row> links(first.back());
        each_rigid(sheet, [&](Row link, std::uint32_t a, std::uint32_t b) {
            links[first[a + 1]++] = links[first[b + 1]++] = link;
        });
        all_.clear();
        begin_.assign(1, 0);
        list_of_.resize(particles);
        for (std::uint32_t s = 0; s < particles; ++s) {
            for (auto i = first[s]; i < first[s + 1]; ++i) {
                const Row link = links[i];
                const auto a = number_of(sheet, link, 0), b = number_of(sheet, link, 1);
                all_.push_back({(a == s ? b : a) - s, distances_.high[link]});
            }
            list_of_[s] = share_last_list(s);
        }
    }
    void forget() {
        all_ = std::vector<Spoke>();
        begin_ = list_of_ = std::vector<std::uint32_t>();
    }

    /// The last one to there.
    static const Spoke* find(std::span<const Spoke> spokes, std::uint32_t apart) {
        for (auto i = spokes.size(); i-- > 0;)
            if (spokes[i].apart == apart) return &spokes[i];
        return nullptr;
    }
    std::span<const Spoke> of(std::uint32_t s) const { return spokes(list_of(s)); }
    std::uint32_t list_of(std::uint32_t s) const { return list_of_[s]; }
    /// Of the spokes of all lists.
    std::size_t size() const { return all_.size(); }
    std::size_t number_of(const Spoke& spoke) const { return std::size_t(&spoke - all_.data()); }
    double longest() const {
        double longest = 0;
        for (const auto& spoke : all_) longest = maximum(longest, double(spoke.length));
        return longest;
    }

  private:
    const Constraints<Distance<D>, Real>& distances_;
    const Swept<D, Real>& swept_;
    const Plan<Real>& plan_;
    std::vector<Spoke> all_;           ///< of one list after the other
    std::vector<std::uint32_t> begin_; ///< of each list, and one more
    std::vector<std::uint32_t> list_of_;

    std::span<const Spoke> spokes(std::size_t list) const {
        return std::span(all_).subspan(begin_[list], begin_[list + 1] - begin_[list]);
    }
    std::uint32_t number_of(const Sheet& sheet, Row link, std::size_t end) const {
        return swept_.slot_of[distances_.members.rows[link][end]] - sheet.begin.slot;
    }

    /// What is behind the last list is that of particle s: the list of the one before it, or one of the last ones, or
    /// the next.
    std::uint32_t share_last_list(std::uint32_t s) {
        constexpr std::size_t looked_at = 64;
        const auto lists = begin_.size() - 1;
        const auto own = std::span<const Spoke>(all_).subspan(begin_.back());
        const auto is_own = [&](std::size_t list) {
            const auto other = spokes(list);
            return std::equal(own.begin(), own.end(), other.begin(), other.end());
        };
        auto found = s > 0 && is_own(list_of_[s - 1]) ? list_of_[s - 1] : lists;
        for (auto list = lists; found == lists && list > 0 && lists - list < looked_at;)
            if (is_own(--list)) found = list;
        if (found == lists)
            begin_.push_back(std::uint32_t(all_.size()));
        else
            all_.resize(begin_.back());
        return std::uint32_t(found);
    }

    template <class Visit> void each_rigid(const Sheet& sheet, Visit&& visit) const {
        plan_.each_link(sheet, [&](Row link, std::uint32_t a, std::uint32_t b) {
            if (distances_.compliance[link] == Real(0) && distances_.high[link] < limit::coordinate<Real>)
                visit(link, a - sheet.begin.slot, b - sheet.begin.slot);
        });
    }
};

} // namespace sinew::detail
