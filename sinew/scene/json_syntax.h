#pragma once

#include "sinew/scene/diagnostic.h"
#include "sinew/scene/json_cursor.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace sinew::json::detail {

/// State of a parser after the last valid token.
struct ParserState {
    std::uint32_t source = 0;
    Cursor cursor;              ///< behind the last token
    std::string path;           ///< JSON pointer of the value being read
    std::optional<Span> opened; ///< the innermost open object or array, if any
    bool in_object = false;     ///< the innermost is an object
    bool first = false;         ///< nothing is in it yet
    bool after_key = false;     ///< a value is due
    bool complete = false;      ///< the whole value has been read
};

/// Error messages for invalid text: the first token that cannot be here, and why.
class SyntaxReport {
  public:
    /// Keeps a reference to the diagnostics.
    SyntaxReport(Diagnostics& diagnostics, ParserState state)
        : diagnostics_(diagnostics), state_(std::move(state)), text_(diagnostics.source(state_.source).text),
          cursor_(state_.cursor) {}

    /// Reports the token behind the last valid one. `overflow`: the token is a number beyond double; `reason`: the
    /// message of the parser.
    void report(bool overflow, std::string_view reason);
    void report_open_comment();
    /// Reports text behind the end.
    void report_rest(Span rest);

  private:
    void error(Span span, std::string message, std::string help = {});
    void report_end();
    void report_value(Span span, bool want_key);
    void report_string(Span span, std::string_view reason);

    Diagnostics& diagnostics_;
    const ParserState state_;
    const std::string_view text_;
    Cursor cursor_;
};

} // namespace sinew::json::detail
