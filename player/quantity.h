#pragma once

#include "player/play.h"

#include <optional>
#include <string>
#include <vector>

/// Quantities of a running scene that a plot can show: of everything, and of the selected particle and its links.
namespace sinew::play {

struct Quantity {
    std::string name, about;
};

/// All quantities there are at present.
std::vector<Quantity> quantities_of(const Play& play);

/// Present value in the scene's units; nothing for an unknown name, or where there is no such particle. `report`: of
/// the present state.
std::optional<double> value_of(const std::string& quantity, const Play& play, const Report& report);

/// Unit of a quantity, in words.
std::string unit_of(const std::string& quantity, const Play& play);

} // namespace sinew::play
