#pragma once

#include "sinew/prefab/prefabs.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

/// What a built figure shows of a prefab: its names, its parts, its extent.
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
    std::vector<std::string> parts;     ///< in the order in which they are drawn
    std::map<std::string, Piece> drawn; ///< the first piece of each part, of those that are not hidden if any is
    std::string at;                     ///< the particle at the origin; empty where none is
    std::vector<double> low, high;      ///< corners of the figure's box, metres
};

/// The figure of a prefab placed at the origin; nothing where its parameters do not go together.
std::optional<Survey> survey(const AnyPrefab& prefab);

/// A prefab with one parameter changed.
struct Variation {
    std::string parameter, value;
    bool counts = false; ///< the parameter is an integer, and was raised by one
    long before = 0;     ///< its default
    AnyPrefab prefab;
};

/// Each parameter that can change what there is: integers raised, words and switches set to each value, numbers that
/// are 0 set to 1.
std::vector<Variation> variations_of(const AnyPrefab& prefab);

} // namespace sinew::cli
