#include "sinew/scene/json_syntax.h"

#include "sinew/scene/text.h"

#include <algorithm>
#include <array>

namespace sinew::json::detail {
namespace {

std::string shortened(std::string_view token) {
    return printable(token, 40);
}

std::string found(std::string_view token) {
    return token.starts_with('"') ? concat("the string ", shortened(token)) : in_quotes(token, 40);
}

std::string hint(std::string_view token, bool want_key) {
    if (token == "'") return "strings are in double quotes";
    if (want_key) return in_word(token[0]) ? concat("write ", in_quotes(token, 40)) : "";
    constexpr std::array<std::string_view, 7> not_finite = {"NaN",      "nan", "Infinity", "-Infinity",
                                                            "infinity", "inf", "-inf"};
    if (std::ranges::find(not_finite, token) != not_finite.end()) return "numbers are finite";
    if (is_digit(token[0]) || token[0] == '-' || token[0] == '+' || token[0] == '.')
        return "a number looks like 12, -0.5 or 1e-3";
    constexpr std::array<std::string_view, 3> words = {"true", "false", "null"};
    if (const auto word = nearest(token, words); !word.empty()) return concat("did you mean ", word, "?");
    return in_word(token[0]) ? "strings are in double quotes" : "";
}

} // namespace

void SyntaxReport::error(Span span, std::string message, std::string help) {
    diagnostics_.error(span, state_.path, std::move(message), std::move(help));
}

void SyntaxReport::report_rest(Span rest) {
    error(rest, concat("expected the end of the file, found ", found(diagnostics_.text(rest))));
}

void SyntaxReport::report(bool overflow, std::string_view reason) {
    cursor_.skip_space();
    const bool in_object = state_.in_object, first = state_.first, after_key = state_.after_key;
    const char separator = after_key ? ':' : ',';
    const auto before_separator = cursor_.at();
    const bool separated = (after_key || !first) && cursor_.skip(separator);
    cursor_.skip_space();
    const Span span = cursor_.token(state_.source);
    const std::string_view token = diagnostics_.text(span);

    if (overflow) return error(span, concat("the number ", shortened(token), " is too large"));
    if (cursor_.open_comment()) return report_open_comment();
    if (cursor_.at_end()) return report_end();
    const Span word = cursor_.whole_word(state_.source);
    const bool closes = token == "}" || token == "]"; // the wrong bracket after a number is no part of it
    if (word.begin < span.begin && !separated && !(closes && is_digit(text_[span.begin - 1])))
        return report_value(word, false);
    if (state_.complete) return report_rest(span);
    if (after_key && !separated) return error(span, concat("expected \":\" after the key, found ", found(token)));
    if (!after_key && !first && !separated)
        return error(span, concat("expected \",\" or \"", in_object ? "}" : "]", "\", found ", found(token)));
    if (separated && !after_key && closes) {
        const Span comma{state_.source, std::uint32_t(before_separator), std::uint32_t(before_separator + 1)};
        return error(comma, concat("a comma before ", in_quotes(token)), "remove it");
    }
    if (token.starts_with('"')) return report_string(span, reason);
    report_value(span, in_object && !after_key);
}

void SyntaxReport::report_value(Span span, bool want_key) {
    const auto token = diagnostics_.text(span);
    error(span, concat("expected ", want_key ? "a key in double quotes" : "a value", ", found ", found(token)),
          hint(token, want_key));
}

void SyntaxReport::report_open_comment() {
    const auto begin = std::uint32_t(*cursor_.open_comment());
    error({state_.source, begin, begin + 2}, "the comment is not closed", "it ends with */");
}

void SyntaxReport::report_end() {
    const Span end{state_.source, std::uint32_t(text_.size()), std::uint32_t(text_.size())};
    if (!state_.opened) return error(end, "the file is empty", "the smallest scene is {\"sinew\": 1}");
    const Span opened = *state_.opened;
    const Place place = place_of(diagnostics_, opened);
    error(end, "the file ends too early",
          concat(in_quotes(text_.substr(opened.begin, 1)), " of line ", place.line, ", column ", place.column,
                 " is not closed"));
}

/// Reports the first invalid character of a string.
void SyntaxReport::report_string(Span span, std::string_view reason) {
    constexpr std::string_view escapes = "\"\\/bfnrtu";
    for (std::uint32_t i = span.begin + 1; i < span.end; ++i) {
        const char c = text_[i];
        if (static_cast<unsigned char>(c) < 0x20)
            return error({state_.source, i, i + 1}, "a control character inside a string",
                         c == '\t' ? "a tab is written \\t" : "");
        if (c != '\\') continue;
        if (i + 1 >= text_.size() || escapes.find(text_[i + 1]) == std::string_view::npos)
            return error({state_.source, i, std::min(i + 2, span.end)}, "unknown escape in a string",
                         "allowed: \\\" \\\\ \\/ \\b \\f \\n \\r \\t and \\u with four hexadecimal digits");
        ++i;
    }
    const auto token = diagnostics_.text(span);
    if (token.size() < 2 || !token.ends_with('"')) return error(span, "the string is not closed on its line");
    const auto begin = reason.find("invalid string: ");
    const auto end = reason.find("; last read");
    error(span, begin == std::string_view::npos ? concat("expected a value, found the string ", shortened(token))
                                                : std::string(reason.substr(begin, end - begin)));
}

} // namespace sinew::json::detail
