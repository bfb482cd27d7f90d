#pragma once

#include "sinew/scene/scene.h"

#include "files/out/export_formats.h"

namespace sinew::cli {

/// Throws CommandError for a kind of event that there is not, or of contacts that no event of the scene waits for.
void check_until(const std::string& kind, const Scene& scene);

/// Sentences about options that were given although the format has no use for them. `has_size`: one for pixels was.
std::vector<std::string> unused_wishes(const files::ExportFormat& format, const files::ExportRequest& request,
                                       bool has_size);

} // namespace sinew::cli
