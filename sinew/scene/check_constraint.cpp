#include "sinew/scene/check_constraint.h"

#include "sinew/constraint/kind_table.h"

#include <algorithm>
#include <map>
#include <set>

namespace sinew {
namespace {

std::string_view article(std::string_view noun) {
    return std::string_view("aeiou").find(noun.front()) == std::string_view::npos ? "a" : "an";
}

class ConstraintCheck {
  public:
    ConstraintCheck(const Scene& scene, Document& document) : scene_(scene), document_(document) {}

    void constraint(const ConstraintSection& section, const std::string& place, std::string_view members) {
        const auto between = format_text("{}/{}", place, members);
        check_limits(section, place, document_);
        const auto kind = *kind_called(section.kind);
        check_signs(kind, scene_.dimension, section, place, document_);
        for (std::size_t i = 0; section.drive && i < section.drive->keys.size(); ++i)
            check_measure(kind, scene_.dimension, section.drive->keys[i].to,
                          place + format_text("/drive/keys/{}/to", i), document_);
        const auto size = section.between.size(), wanted = std::size_t(kind.min_arity);
        if (kind.any_arity ? size < wanted : size != wanted)
            document_.error(between,
                            format_text("{} {} needs {}{} particle{}, found {}", article(kind.name), kind.name,
                                        kind.any_arity ? "at least " : "", wanted, wanted == 1 ? "" : "s", size));
        if (section.damping_time > 0 && section.is_rigid())
            document_.error(place + "/damping_time",
                            "only a constraint with a compliance has a damping time: a rigid one has nothing to damp");
        if (section.drive) drive(*section.drive, section, place + "/drive");
        if (std::ranges::count_if(section.between, [](const auto& name) { return name.ends_with('*'); }) > 1)
            document_.error(between, "one of the names can end in a star, not more");
        std::set<std::string_view> seen;
        for (const auto& name : section.between)
            if (!seen.insert(name).second) document_.error(between, format_text("\"{}\" is named twice", name));
        if (!kind.dimensions.include(scene_.dimension))
            document_.error(place + "/kind",
                            format_text("there is no {} in {} dimensions", kind.name, scene_.dimension));
    }

  private:
    const Scene& scene_;
    Document& document_;

    /// Checks that a drive moves: by a speed, by keys, or by both.
    void drive(const DriveSection& drive, const ConstraintSection& section, const std::string& place) {
        check_keys(drive.keys, place + "/keys", document_);
        const bool stands = drive.speed && *drive.speed == 0;
        if (!drive.has_targets() && drive.keys.empty() && (!drive.speed || stands))
            return document_.error(
                place, "this drive never moves: it has neither a speed nor keys",
                "a \"speed\" turns or winds for ever; \"keys\" such as {\"at\": 2, \"to\": 1} say where "
                "the limit is at which time");
        if (!drive.has_targets() && (!drive.speed || stands)) strengths(drive, section, place);
        if (drive.speed && !drive.has_targets() && section.low && section.high && *section.low < *section.high)
            document_.warn(place + "/speed",
                           "the motor moves both limits, \"low\" and \"high\", along: they never stop it",
                           "limits that stop a motor belong to a second constraint between the same particles, and the "
                           "motor has a max_force");
        if (drive.has_targets() && stands)
            document_.error(place + "/speed", "with a speed of 0 the keys are never reached",
                            "leave it out to be at each key in time");
        if (drive.has_targets() && !drive.speed) jump(drive, section, place);
    }

    /// Checks the keys of a drive that moves no limit: a strength is a share of the largest force, for which the limit
    /// is held.
    void strengths(const DriveSection& drive, const ConstraintSection& section, const std::string& place) {
        const auto has_strength = [](const DriveKey& key) { return key.strength.has_value(); };
        if (std::ranges::none_of(drive.keys, has_strength))
            return document_.error(place + "/keys",
                                   "this drive never moves: its keys have neither \"to\" nor \"strength\"",
                                   "\"to\" says where the limit is at the time of the key; or give the drive a "
                                   "\"speed\"");
        if (section.max_force == 0)
            document_.warn(
                place + "/keys",
                "this drive does nothing: it has no speed, and its keys change a max_force that is not given",
                "give the constraint a \"max_force\", of which a strength is a share; and the keys a "
                "\"to\", or the drive a \"speed\", to move it");
    }

    /// Reports a first key at time 0 that is not the initial value, without a speed to get there.
    void jump(const DriveSection& drive, const ConstraintSection& section, const std::string& place) {
        const auto first = std::ranges::find_if(drive.keys, [](const DriveKey& key) { return key.to.has_value(); });
        const auto initial = section.rest ? section.rest : section.high;
        const bool moves_later =
            std::any_of(first + 1, drive.keys.end(), [](const DriveKey& key) { return key.to.has_value(); });
        if (first->at == 0 && (initial ? *initial != *first->to : !moves_later))
            document_.error(place, "a key at time 0 is a jump, which needs a \"speed\"",
                            "or give the key the time at which it is to be reached");
    }
};

} // namespace

void check_measure(const KindInfo& kind, int dimension, const std::optional<double>& value, const std::string& place,
                   Document& document) {
    constexpr double half_turn = 180;
    const bool is_plane_angle = dimension == 3 && kind.name == Angle<3>::name;
    if (!value) return;
    if (kind.never_negative && *value < 0)
        document.error(place, format_text("a {} is never negative, found {}", kind.name, *value));
    if (is_plane_angle && *value < 0)
        document.error(place, format_text("an angle in 3 dimensions has no sign, found {}", *value),
                       "from 0 (in line) to 180 (folded back); a joint that bends to one side only has a volume of "
                       "four particles beside it, as the elbows of a ragdoll");
    if (is_plane_angle && *value > half_turn)
        document.error(place, format_text("an angle in 3 dimensions reaches 180, found {}", *value),
                       "180 is folded back; a limit that nothing reaches can be left out");
}

void check_constraint(const Scene& scene, const ConstraintSection& section, const std::string& place,
                      Document& document, std::string_view members) {
    ConstraintCheck(scene, document).constraint(section, place, members);
}

namespace {

/// Kind and particles of a constraint, alike in both directions.
std::string twin_key(const ConstraintSection& section) {
    std::string forward = section.kind, backward = section.kind;
    for (const auto& name : section.between) forward += "\n" + name;
    for (auto name = section.between.rbegin(); name != section.between.rend(); ++name) backward += "\n" + *name;
    return std::min(forward, backward);
}

bool is_absolute(const ConstraintSection& section) {
    return section.is_rigid() && section.max_force == 0;
}

} // namespace

void check_motors(const std::vector<ConstraintSection>& list, const std::string& place, Document& document) {
    std::map<std::string, std::vector<std::size_t>> motors;
    for (std::size_t i = 0; i < list.size(); ++i)
        if (list[i].drive && is_absolute(list[i])) motors[twin_key(list[i])].push_back(i);
    for (std::size_t k = 0; k < list.size() && !motors.empty(); ++k) {
        const auto found = is_absolute(list[k]) ? motors.find(twin_key(list[k])) : motors.end();
        if (found == motors.end()) continue;
        for (const auto i : found->second) {
            if (document.diagnostics.full()) return document.diagnostics.count_one_more();
            if (i != k)
                document.error(place + under("constraints", i, "drive"),
                               format_text("a motor of unlimited force against the rigid limits of {}",
                                           place + under("constraints", k)),
                               "give the motor a max_force: it then stops at the limits, and goes on between them");
        }
    }
}

} // namespace sinew
