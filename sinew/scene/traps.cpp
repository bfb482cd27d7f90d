#include "sinew/math/format.h"
#include "sinew/math/union_find.h"
#include "sinew/scene/check.h"
#include "sinew/scene/check_breaking.h"
#include "sinew/scene/check_classic.h"
#include "sinew/scene/check_events.h"
#include "sinew/scene/check_far.h"
#include "sinew/scene/check_floats.h"
#include "sinew/scene/check_overlaps.h"
#include "sinew/scene/types.h"
#include "sinew/world/edit.h"
#include "sinew/world/islands.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

/// Warnings of values that are allowed, and seldom meant.
namespace sinew {
namespace {

template <int D, class Real> class TrapCheck {
  public:
    TrapCheck(const Scene& scene, const World<D, Real>& world, Document& document)
        : scene_(scene), world_(world), document_(document) {}

    void run() {
        strains();
        models();
        jumps();
        slack_bends();
    }

  private:
    const Scene& scene_;
    const World<D, Real>& world_;
    Document& document_;

    /// Strains of rigid constraints. Rigid links in few loops are solved exactly and have no strain; those of a mesh
    /// have the error of the sweep, at which cloth does tear.
    void strains() {
        if (scene_.solver.mode == "classic") return;
        bool any = false;
        for_each_table(world_, [&](const auto& table) { any = any || table.may_tear(); });
        if (!any) return;
        const auto loops = loops_of_components();
        std::vector<char> warned(world_.figures.size() + 1, 0);
        for_each_table(world_, [&](const auto& table) {
            using Kind = typename std::decay_t<decltype(table)>::Kind;
            for (Row row = 0; row < table.size(); ++row) {
                if (table.breaking_strain[row] >= limit::measure<Real> || !table.is_rigid(row) || table.gives(row) ||
                    table.break_force[row] < limit::measure<Real> || loops[table.members[row][0]] > few)
                    continue;
                const auto figure = std::min<std::size_t>(table.figure[row], warned.size() - 1);
                if (!std::exchange(warned[figure], 1)) warn_of_strain(Kind::name, figure);
            }
        });
    }

    static constexpr std::uint32_t few = 2; ///< loops of a component that is surely solved directly

    void warn_of_strain(std::string_view kind, std::size_t figure) {
        document_.warn(place_of_strain(kind, figure),
                       format_text("a rigid {} is never strained, so a breaking_strain tears nothing here", kind),
                       "give it a compliance, or a break_force in newtons");
    }

    /// Place of the breaking strain: of a prefab its own, of constraints by hand that of the first which is rigid.
    std::string place_of_strain(std::string_view kind, std::size_t figure) const {
        const bool in_figure = figure < scene_.figures.size();
        const auto* by_hand = in_figure ? std::get_if<ByHand>(&scene_.figures[figure].made) : nullptr;
        if (in_figure && !by_hand) return under("figures", figure, "breaking_strain");
        const auto prefix = in_figure ? under("figures", figure) : std::string();
        const auto& list = in_figure ? by_hand->constraints : scene_.constraints;
        const auto found = std::ranges::find_if(list, [&](const auto& constraint) {
            return constraint.kind == kind && constraint.is_rigid() && constraint.strength.breaking_strain > 0;
        });
        if (found == list.end()) return prefix + "/constraints";
        return prefix + under("constraints", std::size_t(found - list.begin()), "breaking_strain");
    }

    /// Loops of links in the component of each particle.
    std::vector<std::uint32_t> loops_of_components() const {
        const auto particles = world_.particles.size();
        UnionFind joined(particles);
        std::vector<std::uint32_t> extra(particles, 0), loops(particles, 0);
        for_each_table(world_, [&](const auto& table) {
            using Kind = typename std::decay_t<decltype(table)>::Kind;
            for (Row row = 0; row < table.size(); ++row) {
                const auto members = table.members[row];
                for (std::size_t i = 1; i < members.size(); ++i)
                    if (!joined.join(members[0], members[i]) && std::is_same_v<Kind, Distance<D>>) ++extra[members[0]];
            }
        });
        for (Row row = 0; row < particles; ++row) loops[joined.first_of(row)] += extra[row];
        for (Row row = 0; row < particles; ++row) extra[row] = loops[joined.first_of(row)];
        return extra;
    }

    void models() {
        const auto parts = islands(world_);
        for (std::size_t i = 0; i < scene_.figures.size(); ++i)
            detail::visit_held(scene_.figures[i].made, [&](const auto& made) {
                if constexpr (requires { made.model; })
                    if (made.model && i < parts.size())
                        model(*made.model, made.file, parts[i], under("figures", i, "file"));
            });
    }

    /// Rigid bends, and ranges of angles, at links that may go slack: such a link gives way in place of the angle. A
    /// bend with a compliance is a spring that fades with its legs, as of a whip: meant so.
    void slack_bends() {
        const auto is_rigid_angle = [](const ConstraintSection& section) {
            return section.kind == Angle<D>::name && section.is_rigid();
        };
        const auto warn = [&](const auto& list, const std::string& prefix, const std::string& place) {
            if (!std::ranges::any_of(list, is_rigid_angle)) return;
            const auto slack = slack_pairs();
            std::vector<std::size_t> found;
            for (std::size_t i = 0; i < list.size(); ++i)
                if (is_rigid_angle(list[i]) && is_at_slack_link(list[i], prefix, slack)) found.push_back(i);
            if (found.empty()) return;
            document_.warn(place + under("constraints", found.front()),
                           format_text("{} at a link that may go slack: the link gets shorter where the angle should "
                                       "hold, so that the angle has no effect",
                                       found.size() == 1 ? "an angle" : format_text("{} angles", found.size())),
                           "give the link a \"rest\", or a \"low\" above 0");
        };
        for (std::size_t i = 0; i < scene_.figures.size(); ++i)
            if (const auto* by_hand = std::get_if<ByHand>(&scene_.figures[i].made))
                warn(by_hand->constraints, std::string(name_of(scene_.figures[i])) + "/", under("figures", i));
        warn(scene_.constraints, "", "");
    }
    using Pair = std::pair<Row, Row>;
    static Pair pair_of(Row a, Row b) { return {std::min(a, b), std::max(a, b)}; }

    /// Pairs of particles that links join, and none of them keeps apart.
    std::map<Pair, bool> slack_pairs() const {
        std::map<Pair, bool> pairs;
        const auto& links = std::get<kind_number<Distance, D>>(world_.constraints);
        for (Row row = 0; row < links.size(); ++row) {
            const auto ends = links.members[row];
            const auto [known, is_first] = pairs.try_emplace(pair_of(ends[0], ends[1]), true);
            known->second = known->second && !(links.low(row) > Real(0));
        }
        return pairs;
    }

    bool is_at_slack_link(const ConstraintSection& angle, const std::string& prefix,
                          const std::map<Pair, bool>& slack) const {
        std::vector<Row> rows;
        for (const auto& name : angle.between)
            if (const auto ids = find_particles(world_, full_name(name, prefix)); !ids.empty())
                rows.push_back(*row_of(world_, ids.front()));
        const auto is_slack = [&](Row a, Row b) {
            const auto known = slack.find(pair_of(a, b));
            return known != slack.end() && known->second;
        };
        return rows.size() == 3 && (is_slack(rows[0], rows[1]) || is_slack(rows[1], rows[2]));
    }

    /// Paths of pins that begin elsewhere at time 0: each key is reached evenly from the one before.
    void jumps() {
        for (std::size_t i = 0; i < scene_.pins.size(); ++i) {
            const auto& pin = scene_.pins[i];
            const auto* path = pin.driver ? std::get_if<PathDriver>(&*pin.driver) : nullptr;
            const auto held = find_particle(world_, pin.particle);
            if (!path || !held || path->keys.empty() || path->keys.front().at > 0) continue;
            const auto from = pin.to ? pin.to->as<D, Real>() : *position_of(world_, *held);
            const auto to = path->keys.front().to.as<D, Real>();
            constexpr Real rounding = Real(1e-6);
            if (distance(from, to) > rounding * (Real(1) + norm(to)))
                document_.warn(under("pins", i, "keys/0"),
                               "a key at time 0 is a jump: the particle is held elsewhere and moves there in one step",
                               "give the key the time at which it is to be reached, or begin at the held position");
        }
    }

    void model(const MeshModel& model, std::string_view file, std::size_t parts, const std::string& place) {
        const auto left = model.points.size();
        if (model.welded > 0)
            document_.warn(
                place,
                format_text("{} of the {} points of {} coincide with others and are welded to them, which leaves {}",
                            model.welded, model.welded + left, in_quotes(file), left),
                "the names vertex_N count the points that are left");
        if (parts > 1)
            document_.warn(place, format_text("{} falls into {} parts that nothing joins", in_quotes(file), parts),
                           "a point that no face uses is a part, too");
    }
};

} // namespace

void warn_of_traps(const Scene& scene, const AnyWorld& world, Document& document) {
    std::visit(
        [&]<int D, class Real>(const World<D, Real>& w) {
            TrapCheck(scene, w, document).run();
            BreakingCheck(scene, w, document).run();
            EventCheck(scene, w, document).run();
            FarCheck(scene, w, document).run();
            OverlapCheck(scene, w, document).run();
            if constexpr (std::is_same_v<Real, float>) FloatCheck(scene, w, document).run();
        },
        world);
    ClassicCheck(scene, document).run();
}

} // namespace sinew
