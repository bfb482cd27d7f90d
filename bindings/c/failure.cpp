#include "bindings/c/failure.h"

#include "sinew/scene/utf8.h"

#include "bindings/c/native/sized.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace sinew::c {
namespace {

/// A diagnostic with its texts, as handed out.
struct Kept {
    std::string source, path, message, help, text;
    Place place;
    std::size_t length = 0;
    bool is_override = false;
};

struct Last {
    std::string message;
    std::vector<Kept> diagnostics;
    bool is_telling = false; ///< the log is running
};

Last& last() {
    static thread_local Last failure;
    return failure;
}

/// One error as the command prints it.
std::string text_of(const Diagnostics& all, const Diagnostic& one) {
    Diagnostics single;
    for (std::uint32_t i = 0; i < all.source_count(); ++i) single.add_source(all.source(i).name, all.source(i).text);
    single.error(one.span, one.path, one.message, one.help);
    return to_text(single);
}

std::size_t characters_in(std::string_view text) {
    return text.size() - std::size_t(std::count_if(text.begin(), text.end(), utf8::continues));
}

} // namespace

sinew_status fail(sinew_status status, std::string message) {
    auto& kept = last();
    kept.message = message;
    const auto log = failure_log();
    if (!log.tell || kept.is_telling) return status;
    kept.is_telling = true;
    [&]() noexcept { log.tell(log.context, status, message.c_str()); }(); // an exception would leave it telling
    kept.is_telling = false;
    kept.message = std::move(message); // the log's own calls may have failed
    return status;
}

Log& failure_log() {
    static Log log;
    return log;
}

sinew_status bad_handle() {
    return fail(SINEW_BAD_HANDLE, "nothing open has this handle");
}

sinew_status bad_id(const char* of) {
    return fail(SINEW_BAD_ID, std::string("no ") + of + " has this id");
}

sinew_status null_argument() {
    return fail(SINEW_BAD_ARGUMENT, "an argument is null");
}

sinew_status not_finite() {
    return fail(SINEW_BAD_ARGUMENT, "a number is not finite");
}

void forget_diagnostics() {
    last().diagnostics.clear();
}

sinew_status keep_diagnostics(const Diagnostics& diagnostics) {
    forget_diagnostics();
    if (diagnostics.ok()) return SINEW_OK;
    for (const auto& one : diagnostics.in_order())
        last().diagnostics.push_back({diagnostics.source(one.span.source).name, one.path, one.message, one.help,
                                      text_of(diagnostics, one), place_of(diagnostics, one.span),
                                      characters_in(diagnostics.text(one.span)), one.span.source != 0});
    return fail(SINEW_BAD_SCENE, to_text(diagnostics));
}

} // namespace sinew::c

using namespace sinew::c;

extern "C" {

const char* sinew_message(void) {
    return last().message.c_str();
}

size_t sinew_diagnostic_count(void) {
    return last().diagnostics.size();
}

sinew_status sinew_diagnostic_at(size_t index, sinew_diagnostic* diagnostic) {
    if (const auto status = can_fill(diagnostic)) return status;
    if (index >= last().diagnostics.size()) return fail(SINEW_NOT_FOUND, "there are fewer diagnostics");
    const auto& kept = last().diagnostics[index];
    const sinew_diagnostic found{0,
                                 kept.source.c_str(),
                                 kept.path.c_str(),
                                 kept.message.c_str(),
                                 kept.help.c_str(),
                                 kept.text.c_str(),
                                 std::uint32_t(kept.place.line),
                                 std::uint32_t(kept.place.column),
                                 std::uint32_t(kept.length),
                                 kept.is_override};
    fill_sized(found, diagnostic);
    return SINEW_OK;
}

} // extern "C"
