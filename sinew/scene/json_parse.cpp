#include "sinew/math/sort.h"
#include "sinew/scene/json.h"
#include "sinew/scene/json_cursor.h"
#include "sinew/scene/json_syntax.h"
#include "sinew/scene/utf8.h"

#include <algorithm>
#include <functional>

#define JSON_NO_IO 1
#include <nlohmann/json.hpp>

namespace sinew::json {
namespace {

using detail::Condensed, detail::Cursor, detail::SyntaxReport;

/// Length limit of a JSON pointer in a message, bytes: keys can be long.
constexpr std::size_t longest_path = 500;

/// Builds the tree of values from parser events. The methods implement the SAX interface of nlohmann/json.
class Builder {
  public:
    Builder(std::uint32_t source, std::size_t begin, Diagnostics& diagnostics, const Limits& limits)
        : source_(source), diagnostics_(diagnostics), limits_(limits), text_(diagnostics.source(source).text),
          cursor_(text_, begin) {}

    bool null() { return leaf({}); }
    bool boolean(bool truth) { return leaf(truth); }
    bool number_integer(std::int64_t number) { return leaf(number); }
    bool number_unsigned(std::uint64_t number) {
        return number <= std::uint64_t(INT64_MAX) ? leaf(std::int64_t(number)) : leaf(Number{double(number), {}});
    }
    bool number_float(double number, const std::string&) { return leaf(number); }
    bool string(std::string& text) { return short_enough(text) && leaf(std::move(text)); }
    template <class Binary> bool binary(Binary&) { return false; } // never occurs in JSON text

    bool start_object(std::size_t) { return open(Object{}); }
    bool start_array(std::size_t) { return open(Array{}); }

    bool key(std::string& text) {
        const Span span = next_token();
        open_.back().key = std::move(text);
        open_.back().key_span = span;
        after_key_ = true;
        return short_enough(open_.back().key, span);
    }

    bool end_object() {
        close();
        remove_duplicates(*open_.back().container.as<Object>());
        return attach_container();
    }

    bool end_array() {
        close();
        return attach_container();
    }

    template <class Exception> bool parse_error(std::size_t, const std::string&, const Exception& exception) {
        syntax_report().report(exception.id == 406, exception.what());
        return false;
    }

    /// Checks after the last event that nothing follows the document, and returns the root.
    std::optional<Value> result() {
        cursor_.skip_space();
        if (cursor_.open_comment()) return syntax_report().report_open_comment(), std::nullopt;
        if (cursor_.at_end()) return std::move(root_);
        syntax_report().report_rest(cursor_.token(source_)); // the parser treats a zero byte as the end
        return {};
    }

  private:
    struct Open {
        Value container;
        std::string key; ///< key of the member being read
        Span key_span;
        bool empty = true;
    };

    bool fail(Span span, std::string message, std::string help = {}) {
        error(span, std::move(message), std::move(help));
        return false;
    }
    void error(Span span, std::string message, std::string help = {}) {
        diagnostics_.error(span, path(), std::move(message), std::move(help));
    }

    /// JSON pointer of the value being read.
    std::string path() const {
        std::string path;
        for (std::size_t i = 0; i < open_.size() && path.size() < longest_path; ++i) {
            const auto* items = open_[i].container.as<Array>();
            const bool inside = i + 1 < open_.size() || items || after_key_;
            if (inside) path += items ? concat("/", items->size()) : pointer_step(open_[i].key);
        }
        return path;
    }

    void skip_separator() {
        cursor_.skip_space();
        const char separator = after_key_ ? ':' : ',';
        const bool expected = after_key_ || (!open_.empty() && !open_.back().empty);
        if (expected && cursor_.skip(separator)) cursor_.skip_space();
    }

    Span next_token() {
        skip_separator();
        const Span span = cursor_.token(source_);
        cursor_.move_to(span.end);
        return span;
    }

    bool count(Span span) {
        if (++values_ <= limits_.values) return true;
        return fail(span, concat("more than ", limits_.values, " values"), "limits.values=N allows more");
    }

    bool short_enough(const std::string& text, Span span) {
        if (std::int64_t(text.size()) <= limits_.string_bytes) return true;
        return fail(span, concat("a string of ", text.size(), " bytes, at most ", limits_.string_bytes, " are allowed"),
                    "limits.string_bytes=N allows more");
    }
    bool short_enough(const std::string& text) {
        skip_separator();
        return short_enough(text, cursor_.token(source_));
    }

    bool leaf(Value value) {
        value.span = next_token();
        return count(value.span) && attach(std::move(value));
    }

    bool open(Value container) {
        container.span = next_token();
        after_key_ = false;
        if (std::int64_t(open_.size()) >= limits_.depth)
            return fail(container.span, concat("objects and arrays more than ", limits_.depth, " deep"),
                        "limits.depth=N allows more");
        const Span span = container.span;
        open_.push_back({.container = std::move(container), .key = {}, .key_span = {}});
        return count(span);
    }

    void close() {
        cursor_.skip_space();
        cursor_.move_to(cursor_.at() + 1);
        open_.back().container.span.end = std::uint32_t(cursor_.at());
    }

    bool attach_container() {
        Value container = std::move(open_.back().container);
        open_.pop_back();
        return attach(std::move(container));
    }

    bool attach(Value value) {
        after_key_ = false;
        if (open_.empty()) {
            root_ = std::move(value);
            return true;
        }
        Open& parent = open_.back();
        parent.empty = false;
        if (auto* items = parent.container.as<Array>())
            items->push_back(std::move(value));
        else
            parent.container.as<Object>()->push_back({std::move(parent.key), std::move(value), parent.key_span});
        return true;
    }

    /// Keeps the first of several members with the same key and reports the others.
    void remove_duplicates(Object& members) {
        std::vector<std::uint32_t> order(members.size());
        for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
        sinew::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return members[a].key < members[b].key; });
        std::vector<std::uint32_t> repeated;
        for (std::size_t i = 1; i < order.size(); ++i)
            if (members[order[i]].key == members[order[i - 1]].key) repeated.push_back(order[i]);
        for (const auto i : repeated) {
            if (diagnostics_.full())
                diagnostics_.count_one_more();
            else
                error(members[i].key_span, concat("duplicate property ", in_quotes(members[i].key)));
        }
        sinew::sort(repeated.begin(), repeated.end(), std::greater<>());
        if (repeated.empty()) return;
        Object kept;
        for (std::uint32_t i = 0; i < members.size(); ++i) {
            if (!repeated.empty() && repeated.back() == i)
                repeated.pop_back();
            else
                kept.push_back(std::move(members[i]));
        }
        members = std::move(kept);
    }

    SyntaxReport syntax_report() const {
        const bool is_inside = !open_.empty();
        return {diagnostics_,
                {.source = source_,
                 .cursor = cursor_,
                 .path = path(),
                 .opened = is_inside ? std::optional(open_.back().container.span) : std::nullopt,
                 .in_object = is_inside && open_.back().container.as<Object>(),
                 .first = !is_inside || open_.back().empty,
                 .after_key = after_key_,
                 .complete = root_.has_value()}};
    }

    std::uint32_t source_;
    Diagnostics& diagnostics_;
    const Limits& limits_;
    std::string_view text_;
    Cursor cursor_;
    std::vector<Open> open_;
    std::optional<Value> root_;
    std::int64_t values_ = 0;
    bool after_key_ = false;
};

std::string hexadecimal(unsigned char byte) {
    constexpr std::string_view digits = "0123456789abcdef";
    return {'0', 'x', digits[byte >> 4], digits[byte & 15]};
}

/// Finds a number or bare word longer than `limits.string_bytes`, before the parser copies and converts it.
std::optional<Span> overlong_word(std::uint32_t source, std::string_view text, std::size_t begin,
                                  const Limits& limits) {
    Cursor cursor(text, begin);
    for (cursor.skip_space(); !cursor.at_end(); cursor.skip_space()) {
        const Span token = cursor.token(source);
        if (std::int64_t(token.end - token.begin) > limits.string_bytes && text[token.begin] != '"') return token;
        cursor.move_to(token.end);
    }
    return {};
}

} // namespace

std::optional<Value> parse(std::uint32_t source, Diagnostics& diagnostics, const Limits& limits) {
    const std::string_view text = diagnostics.source(source).text;
    if (std::int64_t(text.size()) > limits.bytes) {
        diagnostics.error({source, 0, 0}, "",
                          concat("a file of ", text.size(), " bytes, at most ", limits.bytes, " are allowed"),
                          "limits.bytes=N allows more");
        return {};
    }
    if (const auto broken = utf8::first_broken(text); broken != text.size()) {
        const auto at = std::uint32_t(broken);
        diagnostics.error({source, at, at + 1}, "",
                          concat("the byte ", hexadecimal(static_cast<unsigned char>(text[at])), " is not UTF-8"),
                          "save the file as UTF-8");
        return {};
    }

    const std::size_t begin = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
    if (const auto word = overlong_word(source, text, begin, limits)) {
        diagnostics.error(*word, "",
                          concat("a word or number of ", word->end - word->begin, " bytes, at most ",
                                 limits.string_bytes, " are allowed"),
                          "limits.string_bytes=N allows more");
        return {};
    }
    Builder builder(source, begin, diagnostics, limits);
    const bool read = nlohmann::json::sax_parse(Condensed(text, begin), Condensed(text, text.size()), &builder);
    return read ? builder.result() : std::nullopt;
}

} // namespace sinew::json
