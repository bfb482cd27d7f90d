#include "sinew/solver/phases.h"
#include "sinew/solver/waiting.h"
#include "sinew/solver/world.h"

#include <algorithm>

/// Working out the plan. What plain distances join is one sheet. Where they lead in few directions - a cloth, as it is
/// built - each direction is a family: all of one direction and then all of the next leaves a quarter of the stretch of
/// a random order, and cell by cell can grow without bound. Any other mesh is coloured. What comes many times in the
/// same shape lies copy by copy, and each copy is solved in its own order.
namespace sinew {
namespace {

using Links = std::span<const Row>;

template <int D, class Real> class Planner {
  public:
    explicit Planner(World<D, Real>& world)
        : world_(world), distances_(std::get<kind_number<Distance, D>>(world.constraints)), swept_(world.swept),
          plan_(world.swept.plan), room_(world.swept.room) {}

    void run() {
        plan_.clear();
        look_around();
        swept_.row_of.clear();
        swept_.slot_of.assign(particles(), none);
        take_plain();
        join();
        sort_into_parts();
        Waiting::tell(0.3);
        for (std::size_t part = 0; part < room_.parts.size();) {
            const auto alike = count_alike(part);
            constexpr std::size_t many = 8, small = 1024;
            if (alike >= many && members(part).size() <= small) {
                lay_out_copies(part, alike);
            } else {
                for (std::size_t i = part; i < part + alike; ++i) lay_out(i);
            }
            part += alike;
        }
        Waiting::tell(tethered(0));
        plan_.first_run.push_back(std::uint32_t(plan_.runs.size()));
        constexpr std::size_t lanes = 16; // a pack reads on behind the last
        for (auto* column : {&plan_.low, &plan_.high, &plan_.compliance}) column->resize(column->size() + lanes);
        list_pins();
        if (!plan_.may_tear)
            for (auto& sheet : plan_.sheets) add_tethers(sheet);
        plan_.per_reach_square.resize(plan_.per_reach_square.size() + (plan_.per_reach_square.empty() ? 0 : lanes));
        swept_.make_room();
    }

  private:
    static constexpr Row none = ~Row(0);

    World<D, Real>& world_;
    const Constraints<Distance<D>, Real>& distances_;
    Swept<D, Real>& swept_;
    Plan<Real>& plan_;
    PlanRoom& room_;

    std::size_t particles() const { return world_.particles.size(); }
    Row end(Row link, std::size_t i) const { return distances_.members.rows[link][i]; }
    Row slot(Row row) const { return swept_.slot_of[row]; }

    template <class Visit> void each_swept(Visit&& visit) const {
        const std::span<const char> in_block = world_.particles.in_block;
        for (std::size_t row = 0, end = 0; (row = next_flag(in_block, end, 0)) < in_block.size();)
            for (end = next_flag(in_block, row, 1); row < end; ++row) visit(Row(row));
    }

    // --- what there is ----------------------------------------------------------------------------------------------

    /// Larger limits are none, or too large for products of three of them.
    bool is_plain(Row link) const {
        constexpr Real far = limit::coordinate<Real>;
        return distances_.split[link] == Real(0.5) && distances_.relaxation[link] == Real(1) &&
               !distances_.gives(link) && distances_.lead[link] == Real(0) && !distances_.driven[link] &&
               distances_.low[link] <= far && distances_.high[link] >= Real(0);
    }

    /// What tears must not make a step allocate: room for all that could be, where that is no waste.
    void look_around() {
        plan_.may_tear = false;
        std::size_t constraints = 0;
        for_each_table(world_, [&](const auto& table) {
            constraints += table.size();
            for (Row row = 0; row < table.size(); ++row) {
                plan_.may_tear = plan_.may_tear || table.breaking_strain[row] < limit::measure<Real>;
            }
        });
        constexpr std::size_t small = 100'000;
        if (!plan_.may_tear || constraints > small) return;
        plan_.reserve(particles(), distances_.size(), constraints);
        room_.reserve(particles(), distances_.size());
        swept_.reserve(particles());
    }

    void take_plain() {
        room_.links.clear();
        for (const auto& run : world_.blocks.runs) {
            const bool distances = run.kind == kind_number<Distance, D>;
            for (Row row = run.rows.first; row < run.rows.last; ++row) {
                if (distances && is_plain(row)) {
                    room_.links.push_back(row);
                    continue;
                }
                auto* last = plan_.others.empty() ? nullptr : &plan_.others.back();
                if (!last || last->kind != run.kind || last->rows.last != row)
                    plan_.others.push_back({run.kind, {row, row}});
                plan_.others.back().rows.last = row + 1;
            }
        }
    }

    Row first_of(Row row) {
        auto& parent = room_.parent;
        while (parent[row] != row) row = parent[row] = parent[parent[row]];
        return row;
    }

    void join() {
        room_.parent.resize(particles());
        each_swept([&](Row row) { room_.parent[row] = row; });
        for (const Row link : room_.links) {
            const Row a = first_of(end(link, 0)), b = first_of(end(link, 1));
            room_.parent[std::max(a, b)] = std::min(a, b);
        }
    }

    /// Particles and links by the part they are in, both in their order; parts by their first particle. Particles
    /// without links are one part.
    void sort_into_parts() {
        auto& parts = room_.parts;
        parts.clear();
        room_.part_of.resize(particles());
        each_swept([&](Row row) { room_.part_of[row] = none; });
        for (const Row link : room_.links) room_.part_of[end(link, 0)] = room_.part_of[end(link, 1)] = 0;
        bool any_alone = false;
        each_swept([&](Row row) {
            if (room_.part_of[row] == none) {
                any_alone = true;
            } else if (const Row first = first_of(row); first == row) {
                room_.part_of[row] = Row(parts.size());
                parts.push_back({});
            } else {
                room_.part_of[row] = room_.part_of[first];
            }
        });
        if (any_alone) parts.push_back({});
        each_swept([&](Row row) {
            if (room_.part_of[row] == none) room_.part_of[row] = Row(parts.size() - 1);
            ++parts[room_.part_of[row]].members;
        });
        for (const Row link : room_.links) ++parts[room_.part_of[end(link, 0)]].links;
        std::uint32_t member = 0, link = 0;
        for (auto& part : parts) {
            part.first_member = member, part.first_link = link;
            member += part.members, link += part.links;
            part.members = part.links = 0;
        }
        room_.members.resize(member);
        room_.link_at.resize(link);
        room_.rank.resize(particles());
        each_swept([&](Row row) {
            auto& part = parts[room_.part_of[row]];
            room_.rank[row] = part.members;
            room_.members[part.first_member + part.members++] = row;
        });
        for (const Row row : room_.links) {
            auto& part = parts[room_.part_of[end(row, 0)]];
            room_.link_at[part.first_link + part.links++] = row;
        }
    }
    std::span<const Row> members(std::size_t part) const {
        return std::span(room_.members).subspan(room_.parts[part].first_member, room_.parts[part].members);
    }
    Links links(std::size_t part) const {
        return std::span(room_.link_at).subspan(room_.parts[part].first_link, room_.parts[part].links);
    }
    Row rank(Row link, std::size_t i) const { return room_.rank[end(link, i)]; }

    // --- runs -------------------------------------------------------------------------------------------------------

    void begin_family(std::uint32_t reach = 0) {
        plan_.families.push_back({.first_run = std::uint32_t(plan_.first_run.size()), .reach = reach});
    }
    void begin_band() {
        plan_.first_run.push_back(std::uint32_t(plan_.runs.size()));
        fresh_ = true;
    }

    void add_parameters(Row link) {
        // squares and products of limits have to be finite
        constexpr Real far = limit::coordinate<Real> * Real(100);
        plan_.low.push_back(maximum(distances_.low[link], Real(0)));
        plan_.high.push_back(minimum(distances_.high[link], far));
        plan_.compliance.push_back(distances_.compliance[link]);
    }
    void copy_parameters(std::uint32_t of) {
        for (auto* column : {&plan_.low, &plan_.high, &plan_.compliance}) {
            const Real value = (*column)[of];
            column->push_back(value);
        }
    }

    /// The next link of the family: it continues the run if it can.
    void add(Row link, Row a, Row b) {
        constexpr std::uint32_t most_lanes = 32; // in two packs
        if (!fresh_) {
            auto& run = plan_.runs.back();
            const auto apart = run.a < run.b ? run.b - run.a : run.a - run.b;
            const bool follows = a == run.a + run.count && b == run.b + run.count && !run.scattered &&
                                 (apart >= most_lanes || run.count < apart) &&
                                 (run.count == 1 ? link > run.row : link == run.row + run.count * run.row_step);
            if (follows) {
                if (run.count == 1) run.row_step = link - run.row;
                extend(run, link);
                return;
            }
        }
        begin_run(link, a, b);
    }

    void begin_run(Row link, Row a, Row b) {
        std::uint32_t parameters = std::uint32_t(plan_.low.size());
        add_parameters(link);
        // one like the last needs no room of its own
        if (parameters > 0 && plan_.low[parameters] == plan_.low[parameters - 1] &&
            plan_.high[parameters] == plan_.high[parameters - 1] &&
            plan_.compliance[parameters] == plan_.compliance[parameters - 1]) {
            for (auto* column : {&plan_.low, &plan_.high, &plan_.compliance}) column->pop_back();
            --parameters;
        }
        plan_.runs.push_back({.a = a,
                              .b = b,
                              .count = 1,
                              .row = link,
                              .row_step = 1,
                              .parameters = parameters,
                              .uniform = true,
                              .soft = distances_.compliance[link] > Real(0),
                              .exact = is_exact(link),
                              .swings = swings_,
                              .even = is_even(link)});
        fresh_ = false;
    }
    /// Its ends can move, and equally readily whatever slows them down.
    bool is_even(Row link) const {
        const auto& p = world_.particles;
        const Row a = end(link, 0), b = end(link, 1);
        return p.mobility[a] > Real(0) && p.mobility[b] > Real(0) && p.inverse_mass[a] == p.inverse_mass[b];
    }
    bool is_exact(Row link) const { return distances_.low[link] == distances_.high[link]; }

    void extend(LinkRun& run, Row link) {
        if (run.uniform) {
            const auto size = plan_.low.size();
            add_parameters(link);
            const bool alike = plan_.low.back() == plan_.low[run.parameters] &&
                               plan_.high.back() == plan_.high[run.parameters] &&
                               plan_.compliance.back() == plan_.compliance[run.parameters];
            for (auto* column : {&plan_.low, &plan_.high, &plan_.compliance}) column->resize(size);
            if (!alike) {
                const auto of = run.parameters;
                run.uniform = false;
                run.parameters = std::uint32_t(size);
                for (std::uint32_t i = 0; i < run.count; ++i) copy_parameters(of);
            }
        }
        if (!run.uniform) add_parameters(link);
        run.soft = run.soft || distances_.compliance[link] > Real(0);
        run.exact = run.exact && is_exact(link);
        run.even = run.even && is_even(link);
        ++run.count;
    }

    void add_scattered(Row link) {
        if (fresh_ || !plan_.runs.back().scattered) {
            plan_.runs.push_back({.a = std::uint32_t(plan_.ends_a.size()),
                                  .parameters = std::uint32_t(plan_.low.size()),
                                  .swings = swings_,
                                  .scattered = true});
            fresh_ = false;
        }
        plan_.ends_a.push_back(slot(end(link, 0)));
        plan_.ends_b.push_back(slot(end(link, 1)));
        plan_.rows.push_back(link);
        add_parameters(link);
        auto& run = plan_.runs.back();
        run.soft = run.soft || distances_.compliance[link] > Real(0);
        run.exact = run.exact && is_exact(link);
        run.even = run.even && is_even(link);
        ++run.count;
    }

    // --- copies -----------------------------------------------------------------------------------------------------

    bool are_alike(std::size_t a, std::size_t b) const {
        const auto first = links(a), second = links(b);
        if (first.empty() || first.size() != second.size() || members(a).size() != members(b).size()) return false;
        for (std::size_t i = 0; i < first.size(); ++i)
            if (rank(first[i], 0) != rank(second[i], 0) || rank(first[i], 1) != rank(second[i], 1)) return false;
        return true;
    }

    /// How many parts from this one on are like it.
    std::size_t count_alike(std::size_t part) const {
        std::size_t count = 1;
        while (part + count < room_.parts.size() && are_alike(part, part + count)) ++count;
        return count;
    }

    /// Particle i of all copies, then i + 1: as many copies a sheet as stay in the fastest cache.
    void lay_out_copies(std::size_t part, std::size_t copies) {
        constexpr std::size_t cached = 2048, least = 64, lanes = 16;
        const auto fitting = cached / members(part).size() / lanes * lanes;
        const auto each = std::max(least, fitting);
        for (std::size_t first = 0; first < copies; first += each) {
            const auto count = std::min(each, copies - first);
            const auto begin = Row(swept_.row_of.size());
            for (std::size_t i = 0; i < members(part).size(); ++i)
                for (std::size_t copy = 0; copy < count; ++copy) give_slot(members(part + first + copy)[i]);
            begin_sheet(part);
            plan_.bands.push_back({begin, Row(swept_.row_of.size())});
            begin_family();
            begin_band();
            for (std::size_t i = 0; i < links(part).size(); ++i) {
                fresh_ = true;
                for (std::size_t copy = 0; copy < count; ++copy) {
                    const Row link = links(part + first + copy)[i];
                    add(link, slot(end(link, 0)), slot(end(link, 1)));
                }
            }
            end_sheet();
        }
    }

    void give_slot(Row row) {
        swept_.slot_of[row] = Row(swept_.row_of.size());
        swept_.row_of.push_back(row);
    }

    /// Corrections along the links as they were keep the energy of a swing, where a sweep comes near to a solution. In
    /// a mesh it does not, and they buy nothing (docs/step.md).
    void begin_sheet(std::size_t part) {
        swings_ = 2 * links(part).size() <= 3 * members(part).size();
        plan_.sheets.push_back(
            {.first_band = std::uint32_t(plan_.bands.size()), .first_family = std::uint32_t(plan_.families.size())});
    }
    void end_sheet() {
        auto& sheet = plan_.sheets.back();
        sheet.bands = std::uint32_t(plan_.bands.size()) - sheet.first_band;
        sheet.families = std::uint32_t(plan_.families.size()) - sheet.first_family;
        std::uint32_t delay = 0;
        for (auto f = sheet.first_family; f < plan_.families.size(); ++f)
            plan_.families[f].delay = delay += plan_.families[f].reach;
        sheet.lag = delay;
    }

    // --- one part ---------------------------------------------------------------------------------------------------

    void lay_out(std::size_t part) {
        begin_sheet(part);
        constexpr std::size_t few = 64; // links: in their own order
        if (find_directions(part))
            lay_out_directions(part);
        else if (links(part).size() < few)
            lay_out_list(part);
        else
            lay_out_colours(part);
        end_sheet();
    }

    // --- tethers ----------------------------------------------------------------------------------------------------

    bool is_anchor(const Pin<D, Real>& pin, std::size_t part) const {
        const auto row = world_.particles.slots.find(pin.particle);
        if (!row || !pin.hard() || slot(*row) == none || room_.part_of[*row] != part) return false;
        const auto figure = world_.particles.figure[*row];
        return figure < world_.figures.size() && world_.figures[figure].tethers;
    }

    /// Of all there is to get ready, when such a share of the sheets has its tethers.
    static double tethered(double share) { return 0.45 + 0.55 * share; }

    /// To a few of its pins: of many those that lie furthest apart. What may tear has none, nor what gives.
    void add_tethers(Sheet& sheet) {
        const Row begin = plan_.bands[sheet.first_band].first;
        const auto part = room_.part_of[swept_.row_of[begin]];
        const auto slots = plan_.bands[sheet.first_band + sheet.bands - 1].last - begin;
        sheet.first_tether = std::uint32_t(plan_.tethers.size());
        if (plan_.pins.empty() || links(part).empty() || slots != members(part).size()) return;
        auto& pins = room_.anchors;
        pins.clear();
        for (const auto& pinned : plan_.pins) // where there are several, the last one holds it
            if (is_anchor(world_.pins[pinned.pin], part)) {
                if (!pins.empty() && world_.pins[pins.back()].particle == world_.pins[pinned.pin].particle)
                    pins.pop_back();
                pins.push_back(pinned.pin);
            }
        if (pins.empty()) return;
        list_rigid_links(part);
        constexpr std::size_t most = most_tethers;
        const auto size = members(part).size();
        for (std::size_t i = 0; i < std::min(most, pins.size()); ++i) {
            const auto pin = pins.size() <= most ? pins[i] : pins[i * (pins.size() - 1) / (most - 1)];
            const auto first = plan_.per_reach_square.size();
            plan_.tethers.push_back({.pin = pin, .first = std::uint32_t(first)});
            plan_.per_reach_square.resize(first + size);
            reach_from(part, *world_.particles.slots.find(world_.pins[pin].particle), begin, first);
            ++sheet.tethers;
            const auto share = double(i + 1) / double(std::min(most, pins.size()));
            Waiting::tell(tethered((double(&sheet - plan_.sheets.data()) + share) / double(plan_.sheets.size())));
        }
    }

    /// The shortest ways (Dijkstra 1959), along rigid links and across the triangles they span: as from one particle
    /// the others come in the order of their distance, a third corner is reached on the straight line from where the
    /// way to two of them would have begun if all lay flat (Mitchell, Mount and Papadimitriou 1987, of the edges the
    /// first step only). A trace longer, so that nothing that hangs straight is pulled.
    void reach_from(std::size_t part, Row anchor, Row begin, std::size_t first) {
        constexpr double far = double(limit::coordinate<Real>) * 100, slack = 1.0001;
        const auto all = members(part);
        auto& way = room_.way;
        way.assign(all.size(), Real(far));
        auto& done = room_.chained;
        done.assign(all.size(), 0);
        constexpr double apart = -1;
        auto& length_to = room_.length_to; // of the particle that is looked at
        length_to.assign(all.size(), apart);
        auto& heap = room_.heap;
        heap.assign(1, {0, room_.rank[anchor]});
        way[room_.rank[anchor]] = 0;
        const auto later = [](const auto& a, const auto& b) { return a > b; };
        const auto shorten = [&](Row r, double length) {
            if (!(Real(length) < way[r])) return;
            way[r] = Real(length);
            heap.push_back({length, r});
            std::push_heap(heap.begin(), heap.end(), later);
        };
        while (!heap.empty()) {
            std::pop_heap(heap.begin(), heap.end(), later);
            const Row r = heap.back().second;
            heap.pop_back();
            if (done[r]) continue;
            done[r] = 1;
            for (const auto& [other, length] : rigid(r)) length_to[other] = length;
            for (const auto& [other, length] : rigid(r)) {
                if (done[other]) continue;
                shorten(other, double(way[r]) + length);
                for (const auto& [third, side] : rigid(other))
                    if (length_to[third] != apart && done[third])
                        shorten(other, across(double(way[r]), double(way[third]), length_to[third], length, side));
            }
            for (const auto& [other, length] : rigid(r)) length_to[other] = apart;
        }
        for (Row r = 0; r < all.size(); ++r) {
            const double reach = minimum(way[r] * slack, far);
            plan_.per_reach_square[first + (slot(all[r]) - begin)] = reach > 0 ? Real(1 / square(reach)) : Real(0);
        }
    }

    using RigidLink = PlanRoom::RigidLink;
    std::span<const RigidLink> rigid(Row r) const {
        return std::span(room_.rigid).subspan(room_.first_rigid[r], room_.first_rigid[r + 1] - room_.first_rigid[r]);
    }
    void list_rigid_links(std::size_t part) {
        list_neighbours(part);
        room_.rigid.clear();
        room_.first_rigid.assign(1, 0);
        for (Row r = 0; r < members(part).size(); ++r) {
            for (auto i = room_.first_near[r]; i < room_.first_near[r + 1]; ++i) {
                const Row link = room_.near_link[i];
                if (distances_.compliance[link] == Real(0) && distances_.high[link] < limit::coordinate<Real>)
                    room_.rigid.push_back({room_.near[i], double(distances_.high[link])});
            }
            room_.first_rigid.push_back(std::uint32_t(room_.rigid.size()));
        }
    }

    /// How far c is from where a is `to_a` and b `to_b` away, on the other side of ab and in the plane of abc.
    static double across(double to_a, double to_b, double ab, double ac, double bc) {
        constexpr double nowhere = 1e300;
        if (!(ab > 0)) return nowhere;
        const auto place = [&](double a, double b) { // along ab, and beside it
            const double along = (a * a - b * b + ab * ab) / (2 * ab);
            return std::pair(along, square_root(maximum(a * a - along * along, 0.0)));
        };
        const auto [from, below] = place(to_a, to_b);
        const auto [to, above] = place(ac, bc);
        if (!(below + above > 0)) return nowhere;
        const double crossing = from + (to - from) * below / (below + above);
        if (!(crossing >= 0 && crossing <= ab)) return nowhere;
        return square_root(square(to - from) + square(below + above));
    }

    void lay_out_list(std::size_t part) {
        const auto begin = Row(swept_.row_of.size());
        for (const Row row : members(part)) give_slot(row);
        plan_.bands.push_back({begin, Row(swept_.row_of.size())});
        if (links(part).empty()) return;
        begin_family();
        begin_band();
        for (const Row link : links(part)) add(link, slot(end(link, 0)), slot(end(link, 1)));
    }

    /// The steps from one end's rank to the other's, in the order in which they come. False where they are too many.
    bool find_directions(std::size_t part) {
        constexpr std::size_t most = 24, least_each = 16;
        auto& directions = room_.directions;
        directions.clear();
        std::uint32_t last = 0;
        for (const Row link : links(part)) {
            const auto direction = direction_of(link);
            if (direction == last) continue;
            last = direction;
            if (std::find(directions.begin(), directions.end(), direction) == directions.end())
                directions.push_back(direction);
            if (directions.size() > most) return false;
        }
        return !directions.empty() && links(part).size() / directions.size() >= least_each;
    }
    Row direction_of(Row link) const {
        const Row a = rank(link, 0), b = rank(link, 1);
        return a < b ? b - a : a - b;
    }

    /// Neighbours in a row share links one after the other; every second of them (or fourth, where links reach
    /// further) do not. So a row's particles lie by their number modulo that.
    void lay_out_directions(std::size_t part) {
        const auto all = members(part);
        auto& chained = room_.chained; // with the next one
        chained.assign(all.size(), 0);
        std::uint32_t classes = 1;
        for (const Row link : links(part)) {
            const auto direction = direction_of(link);
            if (direction > 3) continue;
            classes = std::max(classes, direction == 1 ? 2U : 4U);
            if (direction == 1) chained[std::min(rank(link, 0), rank(link, 1))] = 1;
        }
        const auto begin = Row(swept_.row_of.size());
        Row band = begin;
        constexpr Row least_in_band = 128;
        for (std::size_t first = 0, last; first < all.size(); first = last) {
            last = first + 1;
            while (last < all.size() && chained[last - 1]) ++last;
            for (std::size_t c = 0; c < classes; ++c)
                for (std::size_t i = first + c; i < last; i += classes) give_slot(all[i]);
            if (Row(swept_.row_of.size()) - band < least_in_band && last < all.size()) continue;
            plan_.bands.push_back({band, Row(swept_.row_of.size())});
            band = Row(swept_.row_of.size());
        }
        for (const auto direction : room_.directions) add_direction(part, direction);
    }

    std::uint32_t band_of(std::uint32_t first_band, Row at) const {
        const auto found = std::upper_bound(plan_.bands.begin() + first_band, plan_.bands.end(), at,
                                            [](Row value, const Band& band) { return value < band.last; });
        return std::uint32_t(found - plan_.bands.begin());
    }

    /// The links of a direction by the slot of their first particle. Where two begin at the same, each is of a family
    /// of its own.
    void add_direction(std::size_t part, std::uint32_t direction) {
        auto& at = room_.at;
        const auto first_band = plan_.sheets.back().first_band;
        const Row begin = plan_.bands[first_band].first;
        auto& left = room_.left;
        left.clear();
        for (const Row link : links(part))
            if (direction_of(link) == direction) left.push_back(link);
        while (!left.empty()) {
            at.assign(members(part).size(), none);
            std::size_t kept = 0;
            for (const Row link : left) {
                Row& place = at[lower_slot(link) - begin];
                if (place == none)
                    place = link;
                else
                    left[kept++] = link;
            }
            left.resize(kept);
            add_family(first_band, begin);
        }
    }
    Row lower_end(Row link) const { return rank(link, 0) < rank(link, 1) ? end(link, 0) : end(link, 1); }
    Row upper_end(Row link) const { return rank(link, 0) < rank(link, 1) ? end(link, 1) : end(link, 0); }
    Row lower_slot(Row link) const { return slot(lower_end(link)); }

    void add_family(std::uint32_t first_band, Row begin) {
        begin_family();
        std::uint32_t reach = 0;
        for (auto band = first_band; band < plan_.bands.size(); ++band) {
            begin_band();
            auto furthest = plan_.bands[band].first;
            for (Row s = plan_.bands[band].first; s < plan_.bands[band].last; ++s) {
                const Row link = room_.at[s - begin];
                if (link == none) continue;
                const Row other = slot(upper_end(link));
                add(link, s, other);
                furthest = std::max(furthest, other);
            }
            reach = std::max(reach, band_of(first_band, furthest) - band);
        }
        plan_.families.back().reach = reach;
    }

    // --- any mesh ---------------------------------------------------------------------------------------------------

    /// Breadth first, so that neighbours lie near each other; then each link gets the first colour that none at its
    /// ends has.
    void lay_out_colours(std::size_t part) {
        const auto begin = Row(swept_.row_of.size());
        walk(part);
        constexpr Row in_band = 512;
        for (Row first = begin; first < swept_.row_of.size(); first += in_band)
            plan_.bands.push_back({first, std::min(first + in_band, Row(swept_.row_of.size()))});

        auto& sorted = room_.left; // links by their lower slot
        sorted.assign(links(part).begin(), links(part).end());
        const auto key = [&](Row link) {
            const auto ends = std::minmax({slot(end(link, 0)), slot(end(link, 1))});
            return std::tuple(ends.first, ends.second, link);
        };
        std::sort(sorted.begin(), sorted.end(), [&](Row a, Row b) { return key(a) < key(b); });

        constexpr std::uint32_t last_colour = 63; // of those too many; they come one by one
        auto& used = room_.used;
        used.assign(members(part).size(), 0);
        room_.colour.resize(sorted.size());
        std::uint32_t colours = 0;
        bool any_last = false;
        for (std::size_t i = 0; i < sorted.size(); ++i) {
            auto &a = used[slot(end(sorted[i], 0)) - begin], &b = used[slot(end(sorted[i], 1)) - begin];
            std::uint32_t colour = 0;
            while (colour < last_colour && ((a | b) >> colour & 1) != 0) ++colour;
            room_.colour[i] = (unsigned char)(colour);
            if (colour == last_colour) any_last = true;
            if (colour == last_colour) continue;
            a |= std::uint64_t(1) << colour, b |= std::uint64_t(1) << colour;
            colours = std::max(colours, colour + 1);
        }
        for (std::uint32_t colour = 0; colour < colours; ++colour) add_colour(colour, false);
        if (any_last) add_colour(last_colour, true);
    }

    void add_colour(std::uint32_t colour, bool one_by_one) {
        const auto first_band = plan_.sheets.back().first_band;
        begin_family();
        std::uint32_t reach = 0;
        std::size_t i = 0;
        for (auto band = first_band; band < plan_.bands.size(); ++band) {
            begin_band();
            auto furthest = plan_.bands[band].first;
            for (; i < room_.left.size(); ++i) {
                const Row link = room_.left[i];
                const auto ends = std::minmax({slot(end(link, 0)), slot(end(link, 1))});
                if (ends.first >= plan_.bands[band].last) break;
                if (room_.colour[i] != colour) continue;
                if (one_by_one)
                    begin_run(link, slot(end(link, 0)), slot(end(link, 1)));
                else
                    add_scattered(link);
                furthest = std::max(furthest, ends.second);
            }
            reach = std::max(reach, band_of(first_band, furthest) - band);
        }
        plan_.families.back().reach = reach;
    }

    void list_neighbours(std::size_t part) {
        const auto all = members(part);
        auto& first = room_.first_near;
        first.assign(all.size() + 1, 0);
        for (const Row link : links(part)) ++first[rank(link, 0) + 1], ++first[rank(link, 1) + 1];
        for (std::size_t i = 0; i < all.size(); ++i) first[i + 1] += first[i];
        room_.near.resize(first[all.size()]);
        room_.near_link.resize(first[all.size()]);
        auto& next = room_.at;
        next.assign(first.begin(), first.end());
        for (const Row link : links(part))
            for (std::size_t i = 0; i < 2; ++i) {
                auto& at = next[rank(link, i)];
                room_.near[at] = rank(link, 1 - i);
                room_.near_link[at++] = link;
            }
    }

    void walk(std::size_t part) {
        const auto all = members(part);
        const auto& first = room_.first_near;
        const auto& near = room_.near;
        list_neighbours(part);
        std::size_t visited = swept_.row_of.size();
        give_slot(all[0]);
        for (; visited < swept_.row_of.size(); ++visited) {
            const Row r = room_.rank[swept_.row_of[visited]];
            for (auto i = first[r]; i < first[r + 1]; ++i)
                if (slot(all[near[i]]) == none) give_slot(all[near[i]]);
        }
    }

    // ----------------------------------------------------------------------------------------------------------------

    void list_pins() {
        plan_.pins.clear();
        for (std::uint32_t i = 0; i < world_.pins.size(); ++i)
            if (const auto row = world_.particles.slots.find(world_.pins[i].particle); row && slot(*row) != none)
                plan_.pins.push_back({slot(*row), i});
        std::sort(plan_.pins.begin(), plan_.pins.end(),
                  [](const auto& a, const auto& b) { return std::pair(a.slot, a.pin) < std::pair(b.slot, b.pin); });
        std::size_t pin = 0;
        for (auto& band : plan_.bands) {
            band.first_pin = std::uint32_t(pin);
            while (pin < plan_.pins.size() && plan_.pins[pin].slot < band.last) ++pin;
            band.last_pin = std::uint32_t(pin);
        }
    }

    bool fresh_ = true; ///< the next link begins a run
    bool swings_ = true;
};

} // namespace

template <int D, class Real> void make_plan(World<D, Real>& world) {
    Planner<D, Real>(world).run();
}

#define SINEW_PLAN(D, Real) template void make_plan(World<D, Real>&);
SINEW_INSTANTIATE(SINEW_PLAN)

} // namespace sinew
