#include "sinew/world/rig.h"

#include "sinew/math/format.h"
#include "sinew/math/sort.h"
#include "sinew/math/union_find.h"
#include "sinew/world/edit.h"
#include "sinew/world/shortest_paths.h"

#include <algorithm>

namespace sinew {
namespace {

template <int D, class Real> class Inspector {
  public:
    Inspector(const World<D, Real>& world, std::size_t max) : world_(world), max_(max) {}

    std::vector<RigFault> inspect() {
        int kind = 0;
        for_each_table(world_, [&](const auto& table) { limits(table, kind++); });
        massless_loops();
        lengths();
        return std::move(faults_);
    }

  private:
    static constexpr int link_kind = kind_number<Distance, D>;
    static constexpr double min_strain = 1e-3;

    const World<D, Real>& world_;
    std::size_t max_;
    std::vector<RigFault> faults_;

    const auto& distances() const { return std::get<link_kind>(world_.constraints); }

    void report(std::string what, std::string where) {
        if (faults_.size() < max_) faults_.push_back({std::move(what), std::move(where)});
    }

    // --- names -------------------------------------------------------------------------------------------------------

    template <class Id>
    static std::string name_in(const NameTable<Id>& given, const std::vector<Numbered>& numbered,
                               const IdList<Id>& built, const Id& id) {
        for (const auto& [name, named] : given)
            if (named == id) return name;
        const auto found = std::find(built.begin(), built.end(), id);
        return found == built.end() ? std::string() : name_of(std::size_t(found - built.begin()), numbered);
    }

    std::string name_of_particle(Row row) const {
        const auto index = world_.particles.figure[row];
        if (index >= world_.figures.size()) return format_text("particle {}", row);
        const auto& figure = world_.figures[index];
        const auto name = name_in(figure.particle_names, figure.particle_numbers, figure.particles,
                                  world_.particles.handles.id_of(row));
        return figure.name + "/" + (name.empty() ? format_text("particle {}", row) : name);
    }

    template <class Table> std::string name_of_constraint(const Table& table, int kind, Row row) const {
        if (const auto index = table.figure[row]; index < world_.figures.size()) {
            const auto& figure = world_.figures[index];
            const auto name = name_in(figure.constraint_names, figure.constraint_numbers, figure.constraints,
                                      ConstraintId{kind, table.handles.id_of(row)});
            if (!name.empty()) return figure.name + "/" + name;
        }
        std::string text = format_text("{} of", Table::Kind::name);
        const auto members = table.members[row];
        constexpr std::size_t listed = 4;
        for (std::size_t i = 0; i < std::min(members.size(), listed); ++i)
            text += (i == 0 ? " " : ", ") + name_of_particle(members[i]);
        return members.size() > listed ? text + ", ..." : text;
    }

    // --- limits ------------------------------------------------------------------------------------------------------

    template <class Table> void limits(const Table& table, int kind) {
        using Kind = typename Table::Kind;
        constexpr double to_shown = Kind::length_power == 0 ? 180 / pi<double> : 1; // angles are shown in degrees
        for (Row row = 0; row < table.size() && faults_.size() < max_; ++row) {
            const double low = double(table.low(row)), high = double(table.high(row));
            if (const auto why = impossible<Kind>(low, high); !why.empty()) {
                report(format_text("{}: its limits are {}", why, range(low * to_shown, high * to_shown)),
                       name_of_constraint(table, kind, row));
                continue;
            }
            if (!table.is_rigid(row)) continue;
            const auto state = constraint_state(world_, ConstraintId{kind, table.handles.id_of(row)});
            if (!state || !(absolute(state->strain) > min_strain)) continue;
            const auto members = table.members[row];
            const bool stuck = std::all_of(members.begin(), members.end(),
                                           [&](Row member) { return world_.particles.mobility[member] == Real(0); });
            report(format_text("stands at {:4}, its limits are {}{}", state->measure * to_shown,
                               range(low * to_shown, high * to_shown),
                               stuck ? ", and none of its particles can move" : ""),
                   name_of_constraint(table, kind, row));
        }
    }

    template <class Kind> static std::string_view impossible(double low, double high) {
        if (low > high) return "its low limit is above its high one";
        if (std::is_same_v<Kind, Distance<D>> && high < 0) return "no distance is below 0";
        if (std::is_same_v<Kind, Angle<D>> && D == 3 && (low > pi<double> || high < 0))
            return "a turn in space is between 0 and 180 degrees";
        return "";
    }

    static std::string range(double low, double high) {
        constexpr double none = 1e20;
        if (low == high) return format_text("{:4} exactly", low);
        if (low < -none) return format_text("at most {:4}", high);
        if (high > none) return format_text("at least {:4}", low);
        return format_text("{:4} to {:4}", low, high);
    }

    // --- mass --------------------------------------------------------------------------------------------------------

    void massless_loops() {
        UnionFind joined(world_.particles.size());
        const auto& inverse_mass = world_.particles.inverse_mass;
        for (Row row = 0; row < distances().size() && faults_.size() < max_; ++row) {
            const auto [a, b] = distances().members.rows[row];
            if (inverse_mass[a] > Real(0) || inverse_mass[b] > Real(0) || joined.join(a, b)) continue;
            report("closes a loop of particles without mass: nothing moves it",
                   name_of_constraint(distances(), link_kind, row));
        }
    }

    // --- lengths -----------------------------------------------------------------------------------------------------

    /// True if a path is shorter than needed, by more than the strain allowed.
    static bool too_short(double way, double needed) { return way < needed * (1 - min_strain); }

    void lengths() {
        ShortestPaths ways(world_, max_ways);
        for (Row row = 0; row < distances().size() && faults_.size() < max_; ++row) {
            const double low = double(distances().low(row));
            if (!(low > 0) || !distances().is_rigid(row)) continue;
            const auto [a, b] = distances().members.rows[row];
            const auto way = ways.between(a, b, low * (1 - min_strain), row);
            if (way)
                report(format_text("is at least {:4}, but other links join its ends within {:4}", low, *way),
                       name_of_constraint(distances(), link_kind, row));
        }
        std::vector<Row> held;
        for (const auto& pin : world_.pins)
            if (const auto row = row_of(world_, pin.particle); row && pin.hard()) held.push_back(*row);
        sinew::sort(held.begin(), held.end());
        held.erase(std::unique(held.begin(), held.end()), held.end());
        for (std::size_t i = 0; i + 1 < held.size() && faults_.size() < max_; ++i)
            for (const auto& [other, way] : ways.from(held[i], held)) {
                const double apart =
                    double(distance(world_.particles.position[held[i]], world_.particles.position[other]));
                if (other > held[i] && too_short(way, apart))
                    report(format_text("is held {:4} from {}, but the links between them reach {:4}", apart,
                                       name_of_particle(other), way),
                           name_of_particle(held[i]));
            }
    }
};

} // namespace

template <int D, class Real> std::vector<RigFault> rig_faults(const World<D, Real>& world, std::size_t max) {
    return Inspector<D, Real>(world, max).inspect();
}

#define SINEW_RIG(D, Real) template std::vector<RigFault> rig_faults(const World<D, Real>&, std::size_t);
SINEW_INSTANTIATE(SINEW_RIG)

} // namespace sinew
