#pragma once

#include "sinew/constraint/kind_table.h"
#include "sinew/math/format.h"
#include "sinew/scene/check.h"

#include <string>
#include <string_view>
#include <vector>

/// Checks of constraints, which figures, scenes and events have.
namespace sinew {

/// Checks a constraint at a JSON pointer; `members` is the key of its particles.
void check_constraint(const Scene& scene, const ConstraintSection& section, const std::string& place,
                      Document& document, std::string_view members = "between");

/// Reports motors without a max_force beside a rigid limit of the same particles, which they would break.
void check_motors(const std::vector<ConstraintSection>& list, const std::string& place, Document& document);

/// Checks a rest, or the limits low and high, of a constraint or of an event.
template <class Section> void check_limits(const Section& section, const std::string& place, Document& document) {
    if (section.rest && (section.low || section.high))
        document.error(place + "/rest", "a constraint has either a rest or limits low and high, not both");
    if (section.low && section.high && *section.low > *section.high)
        document.error(place + "/low", format_text("low ({}) is above high ({})", *section.low, *section.high));
}

/// Checks the rest and the limits of a constraint or of an event: lengths are never negative, and angles in space have
/// no sign and reach 180 degrees.
void check_measure(const KindInfo& kind, int dimension, const std::optional<double>& value, const std::string& place,
                   Document& document);
template <class Section>
void check_signs(const KindInfo& kind, int dimension, const Section& section, const std::string& place,
                 Document& document) {
    check_measure(kind, dimension, section.rest, place + "/rest", document);
    if (kind.angle) check_measure(kind, dimension, section.low, place + "/low", document);
    check_measure(kind, dimension, section.high, place + "/high", document);
}

/// Checks that keys are in the order of time.
template <class Key> void check_keys(const std::vector<Key>& keys, const std::string& place, Document& document) {
    for (std::size_t i = 1; i < keys.size(); ++i)
        if (keys[i].at <= keys[i - 1].at)
            document.error(
                format_text("{}/{}/at", place, i),
                format_text("{} is not after {}, the time of the key before it", keys[i].at, keys[i - 1].at));
}

} // namespace sinew
