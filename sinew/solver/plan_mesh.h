#pragma once

#include "sinew/solver/plan_parts.h"
#include "sinew/solver/plan_runs.h"

#include <algorithm>
#include <array>
#include <bit>
#include <tuple>

/// The sheet of any mesh. Its particles lie in rows (levels.h). Links from one particle after the other to one after
/// the other are a run, as in a cloth, and runs of a band that share no particle are of one family. What is left over
/// is coloured: each link gets the first colour that none at its ends has.
namespace sinew::detail {

template <int D, class Real> class MeshMaker {
  public:
    MeshMaker(World<D, Real>& world, const PlanParts<D, Real>& parts, RunWriter<D, Real>& runs)
        : swept_(world.swept), plan_(world.swept.plan), room_(world.swept.room), parts_(parts), runs_(runs) {}

    void lay_out(std::size_t part) {
        begin_ = Row(swept_.row_of.size());
        lie_in_rows(part);
        sort_links(part);
        room_.used.assign(parts_.members(part).size(), 0);
        find_sequences();
        for (std::uint32_t family = 0; family < families_; ++family) add_sequences(family);
        colour();
    }

  private:
    using Link = PlanRoom::Link;
    static constexpr std::uint32_t most_families = 63;
    static constexpr std::uint32_t least_in_sequence = 6; ///< below that they are faster from anywhere

    Swept<D, Real>& swept_;
    Plan<Real>& plan_;
    PlanRoom& room_;
    const PlanParts<D, Real>& parts_;
    RunWriter<D, Real>& runs_;
    Row begin_ = 0; ///< the sheet's first slot
    std::uint32_t families_ = 0;
    std::array<std::uint32_t, most_families> reaches_{}; ///< of each, in bands

    std::uint32_t first_band() const { return plan_.sheets.back().first_band; }

    /// Every second of a row and then those in between, for neighbours share a link.
    void lie_in_rows(std::size_t part) {
        const auto all = parts_.members(part);
        constexpr Row least_in_band = 128;
        parts_.list_neighbours(part);
        auto& levels = room_.levels;
        levels.find(room_.first_near, room_.near);
        Row band = begin_;
        for (std::size_t i = 0; i < levels.size(); ++i) {
            for (std::size_t c = 0; c < 2; ++c)
                for (std::size_t k = c; k < levels[i].size(); k += 2) swept_.give_slot(all[levels[i][k]]);
            if (swept_.size() - band < least_in_band && i + 1 < levels.size()) continue;
            plan_.bands.push_back({band, swept_.size()});
            band = swept_.size();
        }
    }

    /// By band, how far apart its ends lie, and the lower one.
    void sort_links(std::size_t part) {
        auto& sorted = room_.sorted;
        sorted.clear();
        for (const Row link : parts_.links(part)) {
            const auto [a, b] = std::minmax({swept_.slot_of[parts_.end(link, 0)], swept_.slot_of[parts_.end(link, 1)]});
            sorted.push_back({plan_.band_of(first_band(), a), b - a, a, link});
        }
        std::sort(sorted.begin(), sorted.end());
    }

    /// Of each, how many links it has and its family are noted with its first link.
    void find_sequences() {
        auto& sorted = room_.sorted;
        auto& sequences = room_.sequences;
        auto& left = room_.left_over;
        sequences.clear();
        left.clear();
        families_ = 0;
        std::size_t of_band = 0; // the first sequence of it
        for (std::size_t i = 0, end; i < sorted.size(); i = end) {
            end = sequence_end(i);
            if (i == 0 || sorted[i].band != sorted[i - 1].band) forget(of_band), of_band = sequences.size();
            const auto family = end - i < least_in_sequence ? most_families : family_for(i, end);
            if (family == most_families) {
                left.insert(left.end(), sorted.begin() + std::ptrdiff_t(i), sorted.begin() + std::ptrdiff_t(end));
                continue;
            }
            use(i, end, std::uint64_t(1) << family);
            families_ = std::max(families_, family + 1);
            sequences.push_back({std::uint32_t(i), std::uint32_t(end), family});
        }
        forget(of_band);
    }

    std::size_t sequence_end(std::size_t first) const {
        constexpr std::uint32_t most_lanes = 32; // in two packs
        const auto& sorted = room_.sorted;
        const auto& begun = sorted[first];
        const auto most = begun.apart < most_lanes ? begun.apart : std::uint32_t(sorted.size());
        const auto into = plan_.bands[plan_.band_of(begun.band, begun.lower + begun.apart)].last;
        auto end = first + 1;
        while (end < sorted.size() && end - first < most && sorted[end].band == begun.band &&
               sorted[end].apart == begun.apart && sorted[end].lower == sorted[end - 1].lower + 1 &&
               sorted[end].lower + sorted[end].apart < into)
            ++end;
        return end;
    }

    std::uint64_t used(const Link& link) const {
        return room_.used[link.lower - begin_] | room_.used[link.lower + link.apart - begin_];
    }
    /// The first that reaches as far and has hardly any of its particles yet. What reaches nowhere holds up nothing.
    std::uint32_t family_for(std::size_t first, std::size_t end) {
        constexpr std::size_t shared = 8; // at most one of so many
        const auto& begun = room_.sorted[first];
        const auto reach = plan_.band_of(begun.band, begun.lower + begun.apart) - begun.band;
        for (std::uint32_t family = 0; family < families_; ++family) {
            std::size_t taken = 0;
            for (auto i = first; i < end; ++i) taken += used(room_.sorted[i]) >> family & 1;
            if (reaches_[family] == reach && taken * shared <= end - first) return family;
        }
        if (families_ < most_families) reaches_[families_] = reach;
        return families_;
    }
    void use(std::size_t first, std::size_t end, std::uint64_t families) {
        for (auto i = first; i < end; ++i) {
            const auto& link = room_.sorted[i];
            room_.used[link.lower - begin_] |= families;
            room_.used[link.lower + link.apart - begin_] |= families;
        }
    }
    /// What the sequences from this one on use.
    void forget(std::size_t sequence) {
        for (; sequence < room_.sequences.size(); ++sequence)
            for (auto i = room_.sequences[sequence].first; i < room_.sequences[sequence].end; ++i) {
                const auto& link = room_.sorted[i];
                room_.used[link.lower - begin_] = room_.used[link.lower + link.apart - begin_] = 0;
            }
    }

    void add_sequences(std::uint32_t family) {
        std::size_t next = 0;
        add_family([&](std::uint32_t band, auto&& note) {
            for (; next < room_.sequences.size(); ++next) {
                const auto& sequence = room_.sequences[next];
                if (room_.sorted[sequence.first].band != band) break;
                if (sequence.family != family) continue;
                for (auto i = sequence.first; i < sequence.end; ++i) {
                    const auto& link = room_.sorted[i];
                    runs_.add_listed(link.number, link.lower, link.lower + link.apart, i == sequence.first);
                    note(link);
                }
            }
        });
    }

    void colour() {
        auto& left = room_.left_over;
        if (left.empty()) return;
        std::sort(left.begin(), left.end(), [](const Link& a, const Link& b) {
            return std::tuple(a.lower, a.apart, a.number) < std::tuple(b.lower, b.apart, b.number);
        });
        constexpr auto last_colour = most_families; // of those too many; they come one by one
        std::uint32_t colours = 0;
        bool any_last = false;
        room_.colour.clear();
        for (const auto& link : left) {
            const auto colour = std::min(std::uint32_t(std::countr_one(used(link))), last_colour);
            room_.colour.push_back((unsigned char)(colour));
            if (colour == last_colour) {
                any_last = true;
                continue;
            }
            room_.used[link.lower - begin_] |= std::uint64_t(1) << colour;
            room_.used[link.lower + link.apart - begin_] |= std::uint64_t(1) << colour;
            colours = std::max(colours, colour + 1);
        }
        constexpr std::size_t few = 8; // one of so many: band by band, which holds up less
        if (left.size() * few < room_.sorted.size()) return add_colours(0, any_last ? last_colour : colours - 1);
        for (std::uint32_t colour = 0; colour < colours; ++colour) add_colours(colour, colour);
        if (any_last) add_colours(last_colour, last_colour);
    }

    /// Colours [first, last] as one family, in each band one after the other.
    void add_colours(std::uint32_t first, std::uint32_t last) {
        const auto& left = room_.left_over;
        std::size_t begin = 0, end = 0;
        add_family([&](std::uint32_t band, auto&& note) {
            for (begin = end; end < left.size() && left[end].band == band;) ++end;
            for (auto colour = first; colour <= last; ++colour) {
                runs_.break_run();
                for (auto i = begin; i < end; ++i) {
                    if (room_.colour[i] != colour) continue;
                    if (colour == most_families)
                        runs_.begin_run(left[i].number, left[i].lower, left[i].lower + left[i].apart);
                    else
                        runs_.add_scattered(left[i].number, left[i].lower, left[i].lower + left[i].apart);
                    note(left[i]);
                }
            }
        });
    }

    /// Calls add(band, note) for each band, which is to note the links it adds.
    template <class Add> void add_family(Add&& add) {
        runs_.begin_family();
        std::uint32_t reach = 0;
        for (auto band = first_band(); band < plan_.bands.size(); ++band) {
            runs_.begin_band();
            auto furthest = plan_.bands[band].first;
            add(band, [&](const Link& link) { furthest = std::max(furthest, link.lower + link.apart); });
            reach = std::max(reach, plan_.band_of(first_band(), furthest) - band);
        }
        plan_.families.back().reach = reach;
    }
};

} // namespace sinew::detail
