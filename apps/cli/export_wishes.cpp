#include "apps/cli/export_wishes.h"

#include "sinew/scene/event_section.h"
#include "sinew/scene/text.h"
#include "sinew/scene/types.h"
#include "sinew/session/session.h"

#include "apps/cli/arguments.h"
#include "apps/cli/console.h"

#include <algorithm>
#include <fmt/format.h>

namespace sinew::cli {
namespace {

constexpr auto& contact_phases = ContactRule::phases;

} // namespace

void check_until(const std::string& kind, const Scene& scene) {
    std::vector<std::string_view> known(world_event_names.begin(), world_event_names.end());
    known.insert(known.end(), contact_phases.begin(), contact_phases.end());
    const auto& scene_kinds = detail::alternative_names<decltype(EventSection::event)>;
    known.insert(known.end(), scene_kinds.begin(), scene_kinds.end());
    if (std::ranges::find(known, kind) == known.end())
        usage_error(fmt::format("there is no event called {}", in_quotes(kind)), suggest(kind, known));
    if (std::ranges::find(contact_phases, kind) == contact_phases.end()) return;
    const auto waits = [&](const EventSection& event) { return event.on && event.on->phase == kind; };
    if (std::ranges::none_of(scene.events, waits))
        refuse("sinew", fmt::format("the scene waits for no contact of the kind {}", in_quotes(kind)),
               fmt::format(R"(an event such as {{"on": {{"contact": "{}", "of": FIGURE}}, "note": "contact"}} does)",
                           kind));
}

std::vector<std::string> unused_wishes(const files::ExportFormat& format, const files::ExportRequest& request,
                                       bool has_size) {
    std::vector<std::string> unused;
    const auto tell = [&](bool is_given, bool is_used, std::string_view option, std::string_view use) {
        if (is_given && !is_used)
            unused.push_back(fmt::format("{} is for {}: a {} has no use for it", option, use, format.ending));
    };
    const bool has_keys = format.ending == ".glb" || (format.is_drawn && !format.is_painted);
    tell(has_size, format.is_drawn, "--size or --scale", "pictures");
    tell(request.background.has_value(), format.is_drawn, "--background", "pictures");
    tell(!request.follow.empty(), format.is_drawn, "--follow", "pictures");
    tell(!request.caption.empty(), format.is_drawn, "--caption", "pictures");
    tell(request.joints > 0, format.ending == ".glb", "--joints", "a .glb");
    tell(request.tolerance.has_value(), has_keys, "--error", "a .glb and moving vectors");
    return unused;
}

} // namespace sinew::cli
