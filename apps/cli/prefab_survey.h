#pragma once

#include "sinew/prefab/prefabs.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

/// Facts about a prefab, read from a built figure: names, parts, extent.
namespace sinew::cli {

/// Names that differ by numbers: link_0 to link_19, particle_0_0 to particle_31_20. A single name has no numbers.
struct NameRun {
    std::string stem;
    struct Index {
        long first = 0, last = 0;
    };
    std::vector<Index> indices;
};

struct Survey {
    std::vector<NameRun> particles, constraints;
    std::vector<std::string> parts;     ///< in drawing order
    std::map<std::string, Piece> drawn; ///< first piece of each part, a visible piece if there is any
    std::string at;                     ///< name of the particle at the origin; empty if none
    std::vector<double> low, high;      ///< corners of the box around the centres of its particles, metres
    bool has_radii = false;             ///< particles reach beyond their centres
};

/// Surveys the figure of a prefab placed at the origin; empty if the parameters are inconsistent.
std::optional<Survey> survey(const AnyPrefab& prefab);

/// A prefab with one parameter changed.
struct Variation {
    std::string parameter, value;
    bool counts = false; ///< true: an integer parameter, raised by one
    long before = 0;     ///< value before the change
    AnyPrefab prefab;
};

/// Variations of every parameter that can change the structure: integers raised by one, choices and switches set to
/// each other value, numbers of 0 set to 1.
std::vector<Variation> variations_of(const AnyPrefab& prefab);

} // namespace sinew::cli
