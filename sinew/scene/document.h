#pragma once

#include "sinew/scene/diagnostic.h"
#include "sinew/scene/json.h"
#include "sinew/scene/limits.h"

#include <array>
#include <span>
#include <string>
#include <string_view>

namespace sinew {

/// Values of `solver.mode`; the first is the default.
inline constexpr std::array<std::string_view, 2> modes = {"physical", "classic"};

/// A scene file as parsed JSON, with patches and overrides applied, before sections are read.
struct Document {
    Diagnostics diagnostics; ///< errors and sources: source 0 is the file, overrides follow
    json::Value root;        ///< an object, empty where the text is no JSON object
    std::string mode;        ///< an element of `modes`
    Limits limits;

    /// Reports an error at a JSON pointer: "/figures/3/name". Where the file has no such value (a default is at fault),
    /// the error points at the enclosing value.
    void error(std::string_view pointer, std::string message, std::string help = {});
    /// Warns, likewise.
    void warn(std::string_view pointer, std::string message, std::string help = {});

  private:
    Span span_at(std::string_view pointer) const;
};

/// key=value, as on a command line or in a page address.
struct Override {
    std::string pair;
    std::string origin = "<command line>";
};

/// Combines a scene file and overrides into one document, in this order:
///
/// 1. Overrides `limits.*` set the limits.
/// 2. The mode is that of an override `mode=` or `solver.mode=`, else that of the file, else the first of `modes`.
/// 3. `"modes": {"classic": {...}}` in the file holds a merge patch for each mode (RFC 7386: objects are merged, null
///    removes, anything else replaces). The patch of the mode is merged into the document. Where the document has an
///    array and the patch an object, the keys of the object are names or indices of the array's elements.
/// 4. Overrides set values by path: `solver.substeps=16`, `figures.bob.height=200`, `figures.0.height=200`. The
///    value is JSON, or else a plain string; null removes. `mode` and `precision` are short for `solver.mode` and
///    `solver.precision`.
///
/// An element of an array is named by its "name", or by its "prefab" where no other unnamed element has the same
/// prefab. Values are not validated here; the reader does so, and every value knows its source. "modes" and "$schema"
/// are not part of the result.
Document load(std::string text, std::string name, std::span<const Override> overrides = {});

} // namespace sinew
