#pragma once

#include "sinew/scene/diagnostic.h"
#include "sinew/scene/json.h"
#include "sinew/scene/limits.h"

#include <array>
#include <span>
#include <string>
#include <string_view>

namespace sinew {

/// The words that `solver.mode` can be; the first is meant where a scene does not say.
inline constexpr std::array<std::string_view, 2> modes = {"physical", "classic"};

/// A scene file as read, before anything is made of it.
struct Document {
    Diagnostics diagnostics; ///< begins with the file as source 0; then the overrides
    json::Value root; ///< an object, also where the text was no JSON (then it is empty and the diagnostics say why)
    std::string mode; ///< one of `modes`
    Limits limits;

    /// Reports what a check of the whole scene found at a JSON pointer: "/figures/3/name". Where the file has no such
    /// value (a default is at fault), the error points at the value around it.
    void error(std::string_view pointer, std::string message, std::string help = {});
};

/// key=value, as on a command line or in the address of a page.
struct Override {
    std::string pair;
    std::string origin = "<command line>";
};

/// Makes one document of a scene file and what it is overridden with, in this order:
///
/// 1. `limits.*` of the overrides say what is refused.
/// 2. The mode is that of an override `mode=` or `solver.mode=`, else that of the file, else the first of `modes`.
/// 3. `"modes": {"classic": {...}}` in the file holds a merge patch for each mode (RFC 7386: objects are merged, null
///    removes, anything else replaces). The patch of the mode is merged into the document. Where the document has an
///    array and the patch an object, its keys are names or indices of the array's elements.
/// 4. Overrides set values by path: `solver.substeps=16`, `figures.bob.height=200`, `figures.0.height=200`. The value
/// is JSON,
///    or else a string as it stands; null removes. `mode` and `precision` are short for `solver.mode` and
///    `solver.precision`.
///
/// An element of an array goes by its "name", or by its "prefab" where it has none and is the only one of that kind.
/// Whether the values make sense is for the reader to say; every value knows which text it came from. "modes" and
/// "$schema" are not part of the result.
Document load(std::string text, std::string name, std::span<const Override> overrides = {});

} // namespace sinew
