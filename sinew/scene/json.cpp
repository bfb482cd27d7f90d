#include "sinew/scene/json.h"

#include "sinew/scene/utf8.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <iterator>

#define JSON_NO_IO 1
#include <nlohmann/json.hpp>

namespace sinew::json {
namespace {

/// Of a JSON pointer in a message, in bytes: keys can be long.
constexpr std::size_t longest_path = 500;

bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

bool in_word(char c) {
    return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '-' || c == '+' ||
           c == '.' || c == '$' || static_cast<unsigned char>(c) >= 0x80;
}

std::optional<std::int64_t> whole(double number) {
    constexpr double limit = 9223372036854775808.0; // 2^63
    if (!(number >= -limit && number < limit) || std::trunc(number) != number) return {};
    return std::int64_t(number);
}

/// Finds in the source the tokens that the parser reports: they come in the order of the text, so a cursor is enough.
class Cursor {
  public:
    explicit Cursor(std::string_view text, std::size_t at) : text_(text), at_(at) {}

    std::size_t at() const { return at_; }
    bool at_end() const { return at_ >= text_.size(); }
    char peek() const { return at_end() ? '\0' : text_[at_]; }
    void move_to(std::size_t at) { at_ = at; }

    void skip_space() {
        while (!at_end()) {
            const auto rest = text_.substr(at_);
            if (is_space(rest[0]))
                ++at_;
            else if (rest.starts_with("//"))
                skip_comment("\n");
            else if (rest.starts_with("/*"))
                skip_comment("*/");
            else
                return;
        }
    }

    bool at_space() const {
        const auto rest = text_.substr(at_, 2);
        return !rest.empty() && (is_space(rest[0]) || rest == "//" || rest == "/*");
    }

    bool skip(char separator) {
        if (peek() != separator || at_end()) return false;
        ++at_;
        return true;
    }

    /// The token here: a string with its quotes, a word or number, or one character.
    Span token(std::uint32_t source) const {
        std::size_t end = at_;
        if (peek() == '"')
            end = string_end();
        else if (peek() == '0' || text_.substr(at_).starts_with("-0"))
            end = leading_zero_end();
        else
            end = word_end(at_);
        if (end == at_ && !at_end()) end += utf8::decode(text_, at_).bytes;
        return {source, std::uint32_t(at_), std::uint32_t(end)};
    }

    /// The word or number around the place: of 01 the parser takes 0 and trips over 1.
    Span whole_word(std::uint32_t source) const {
        std::size_t begin = at_;
        while (begin > 0 && in_word(text_[begin - 1])) --begin;
        return {source, std::uint32_t(begin), std::uint32_t(word_end(at_))};
    }

    /// Where a comment begins that has no end.
    std::optional<std::size_t> open_comment() const { return open_comment_; }

  private:
    void skip_comment(std::string_view mark) {
        const auto found = text_.find(mark, at_ + 2);
        if (found == std::string_view::npos && mark == "*/") open_comment_ = at_;
        at_ = found == std::string_view::npos ? text_.size() : found + mark.size();
    }

    std::size_t word_end(std::size_t at) const {
        while (at < text_.size() && in_word(text_[at])) ++at;
        return at;
    }

    std::size_t leading_zero_end() const {
        const auto after = at_ + (peek() == '-' ? 2 : 1);
        return after < text_.size() && is_digit(text_[after]) ? after : word_end(after);
    }

    std::size_t string_end() const {
        for (std::size_t end = at_ + 1; end < text_.size(); ++end) {
            if (text_[end] == '"') return end + 1;
            if (text_[end] == '\n') return end;
            if (text_[end] == '\\') ++end;
        }
        return text_.size();
    }

    std::string_view text_;
    std::size_t at_;
    std::optional<std::size_t> open_comment_;
};

/// The text as the parser gets it: a run of blanks and comments is one blank. nlohmann's lexer keeps every byte since
/// the last token for its messages, a newline as eight: 16 MB of newlines took 3.3 s and 550 MB.
class Condensed {
  public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = char;

    Condensed(std::string_view text, std::size_t at) : cursor_(text, at) { find_blank(); }

    char operator*() const { return blank_ ? ' ' : cursor_.peek(); }
    Condensed& operator++() {
        const char passed = cursor_.peek();
        if (blank_)
            cursor_.skip_space();
        else
            cursor_.move_to(cursor_.at() + 1);
        if (passed == '"' && !escaped_) in_string_ = !in_string_;
        escaped_ = in_string_ && passed == '\\' && !escaped_;
        find_blank();
        return *this;
    }
    friend bool operator==(const Condensed& a, const Condensed& b) { return a.cursor_.at() == b.cursor_.at(); }

  private:
    void find_blank() { blank_ = !in_string_ && cursor_.at_space(); }

    Cursor cursor_;
    bool in_string_ = false, escaped_ = false, blank_ = false;
};

/// Builds the tree from the parser's events (nlohmann's SAX interface, whose names the methods have).
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
    template <class Binary> bool binary(Binary&) { return false; } // JSON text has none

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
        report_syntax(exception.id == 406, exception.what());
        return false;
    }

    /// After the last event: nothing may follow the document.
    std::optional<Value> result() {
        cursor_.skip_space();
        if (cursor_.open_comment()) return report_open_comment(), std::nullopt;
        if (cursor_.at_end()) return std::move(root_);
        const Span rest = cursor_.token(source_); // the parser takes a zero byte for the end
        error(rest, concat("expected the end of the file, found ", found(diagnostics_.text(rest))));
        return {};
    }

  private:
    struct Open {
        Value container;
        std::string key; ///< of the member being read
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

    /// The JSON pointer of the value being read.
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

    /// Of members with one name the first stays; the others are errors.
    void remove_duplicates(Object& members) {
        std::vector<std::uint32_t> order(members.size());
        for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
        std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return members[a].key < members[b].key; });
        std::vector<std::uint32_t> repeated;
        for (std::size_t i = 1; i < order.size(); ++i)
            if (members[order[i]].key == members[order[i - 1]].key) repeated.push_back(order[i]);
        for (const auto i : repeated) {
            if (diagnostics_.full())
                diagnostics_.count_one_more();
            else
                error(members[i].key_span, concat("duplicate property ", in_quotes(members[i].key)));
        }
        std::sort(repeated.begin(), repeated.end(), std::greater<>());
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

    // --- what a wrong text says instead -------------------------------------------------------------------------

    void report_syntax(bool overflow, std::string_view reason) {
        cursor_.skip_space();
        const bool in_object = !open_.empty() && open_.back().container.as<Object>();
        const bool first = open_.empty() || open_.back().empty;
        const char separator = after_key_ ? ':' : ',';
        const auto before_separator = cursor_.at();
        const bool separated = (after_key_ || !first) && cursor_.skip(separator);
        cursor_.skip_space();
        const Span span = cursor_.token(source_);
        const std::string_view token = diagnostics_.text(span);

        if (overflow) return error(span, concat("the number ", shortened(token), " is too large"));
        if (cursor_.open_comment()) return report_open_comment();
        if (cursor_.at_end()) return report_end();
        if (const Span word = cursor_.whole_word(source_); word.begin < span.begin && !separated)
            return report_value(word, false);
        if (root_) return error(span, concat("expected the end of the file, found ", found(token)));
        if (after_key_ && !separated) return error(span, concat("expected \":\" after the key, found ", found(token)));
        if (!after_key_ && !first && !separated)
            return error(span, concat("expected \",\" or \"", in_object ? "}" : "]", "\", found ", found(token)));
        if (separated && !after_key_ && (token == "}" || token == "]")) {
            const Span comma{source_, std::uint32_t(before_separator), std::uint32_t(before_separator + 1)};
            return error(comma, concat("a comma before ", in_quotes(token)), "remove it");
        }
        if (token.starts_with('"')) return report_string(span, reason);
        report_value(span, in_object && !after_key_);
    }

    void report_value(Span span, bool want_key) {
        const auto token = diagnostics_.text(span);
        error(span, concat("expected ", want_key ? "a key in double quotes" : "a value", ", found ", found(token)),
              hint(token, want_key));
    }

    void report_open_comment() {
        const auto begin = std::uint32_t(*cursor_.open_comment());
        error({source_, begin, begin + 2}, "the comment is not closed", "it ends with */");
    }

    void report_end() {
        const Span end{source_, std::uint32_t(text_.size()), std::uint32_t(text_.size())};
        if (open_.empty()) return error(end, "the file is empty", "the smallest scene is {\"sinew\": 1}");
        const Span opened = open_.back().container.span;
        const Place place = place_of(diagnostics_, opened);
        error(end, "the file ends too early",
              concat(in_quotes(text_.substr(opened.begin, 1)), " of line ", place.line, ", column ", place.column,
                     " is not closed"));
    }

    /// Points at the character that does not belong into the string.
    void report_string(Span span, std::string_view reason) {
        constexpr std::string_view escapes = "\"\\/bfnrtu";
        for (std::uint32_t i = span.begin + 1; i < span.end; ++i) {
            const char c = text_[i];
            if (static_cast<unsigned char>(c) < 0x20)
                return error({source_, i, i + 1}, "a control character inside a string",
                             c == '\t' ? "a tab is written \\t" : "");
            if (c != '\\') continue;
            if (i + 1 >= text_.size() || escapes.find(text_[i + 1]) == std::string_view::npos)
                return error({source_, i, std::min(i + 2, span.end)}, "unknown escape in a string",
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

    static std::string shortened(std::string_view token) { return printable(token, 40); }
    static std::string found(std::string_view token) {
        return token.starts_with('"') ? concat("the string ", shortened(token)) : in_quotes(token, 40);
    }

    static std::string hint(std::string_view token, bool want_key) {
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

} // namespace

Value::Value(double number) : data(Number{number, whole(number)}) {}

const Member* find(const Object& object, std::string_view key) {
    const auto found = std::ranges::find(object, key, &Member::key);
    return found == object.end() ? nullptr : &*found;
}

Member* find(Object& object, std::string_view key) {
    return const_cast<Member*>(find(std::as_const(object), key));
}

namespace {

/// The key that a step of a pointer stands for.
std::string key_of(std::string_view step) {
    std::string key;
    for (std::size_t i = 0; i < step.size(); ++i) {
        const auto rest = step.substr(i);
        if (rest.starts_with("~0") || rest.starts_with("~1"))
            key += step[++i] == '0' ? '~' : '/';
        else
            key += step[i];
    }
    return key;
}

const Value* element(const Array& items, std::string_view digits) {
    std::size_t index = 0;
    const auto [stop, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
    const bool whole = problem == std::errc() && stop == digits.data() + digits.size();
    return whole && index < items.size() ? &items[index] : nullptr;
}

} // namespace

const Value* find(const Value& root, std::string_view pointer) {
    const Value* value = &root;
    while (value && !pointer.empty()) {
        if (pointer[0] != '/') return nullptr;
        const auto end = std::min(pointer.find('/', 1), pointer.size());
        const auto step = pointer.substr(1, end - 1);
        pointer.remove_prefix(end);
        const Member* member = nullptr;
        if (const auto* object = value->as<Object>()) member = find(*object, key_of(step));
        const auto* items = value->as<Array>();
        value = member ? &member->value : items ? element(*items, step) : nullptr;
    }
    return value;
}

std::string pointer_step(std::string_view key) {
    std::string step = "/";
    for (const char c : key) {
        if (c == '~')
            step += "~0";
        else if (c == '/')
            step += "~1";
        else
            step += c;
    }
    return step;
}

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
    Builder builder(source, begin, diagnostics, limits);
    const bool read = nlohmann::json::sax_parse(Condensed(text, begin), Condensed(text, text.size()), &builder);
    return read ? builder.result() : std::nullopt;
}

// --- writing ----------------------------------------------------------------------------------------------------

namespace {

void write_string(std::string& out, std::string_view text) {
    constexpr std::string_view digits = "0123456789abcdef";
    out += '"';
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\')
            (out += '\\') += c;
        else if (c == '\n')
            out += "\\n";
        else if (c == '\t')
            out += "\\t";
        else if (byte < 0x20 || byte == 0x7F)
            (out += "\\u00", out += digits[byte >> 4]) += digits[byte & 15];
        else
            out += c;
    }
    out += '"';
}

constexpr std::size_t line_width = 110;

void write(std::string& out, const Value& value, std::size_t indent);

/// Items between brackets: on one line where they fit, else one a line.
template <class Items, class WriteItem>
void write_items(std::string& out, const Items& items, std::string_view brackets, std::size_t indent,
                 WriteItem&& item) {
    const auto begin = out.size();
    out += brackets[0];
    for (const auto& each : items) {
        if (out.size() > begin + 1) out += ", ";
        item(out, each, indent + 2);
        if (out.size() - begin + indent > line_width || out.find('\n', begin) != std::string::npos) break;
    }
    out += brackets[1];
    if (out.size() - begin + indent <= line_width && out.find('\n', begin) == std::string::npos) return;

    out.resize(begin);
    out += brackets[0];
    for (const auto& each : items) {
        if (out.size() > begin + 1) out += ",";
        (out += "\n").append(indent + 2, ' ');
        item(out, each, indent + 2);
    }
    ((out += "\n").append(indent, ' ')) += brackets[1];
}

struct Write {
    std::string& out;
    std::size_t indent;

    void operator()(Null) { out += "null"; }
    void operator()(bool truth) { out += truth ? "true" : "false"; }
    void operator()(const Number& number) {
        out += number.integer ? std::to_string(*number.integer) : number_text(number.value);
    }
    void operator()(const std::string& text) { write_string(out, text); }
    void operator()(const Array& items) {
        write_items(out, items, "[]", indent,
                    [](std::string& to, const Value& item, std::size_t in) { write(to, item, in); });
    }
    void operator()(const Object& members) {
        write_items(out, members, "{}", indent, [](std::string& to, const Member& member, std::size_t in) {
            write_string(to, member.key);
            to += ": ";
            write(to, member.value, in);
        });
    }
};

void write(std::string& out, const Value& value, std::size_t indent) {
    std::visit(Write{out, indent}, value.data);
}

} // namespace

std::string to_text(const Value& value) {
    std::string out;
    write(out, value, 0);
    return out;
}

namespace {

struct Describe {
    std::string operator()(Null) { return "null"; }
    std::string operator()(bool truth) { return truth ? "true" : "false"; }
    std::string operator()(const Number& number) { return concat("the number ", to_text(number)); }
    std::string operator()(const std::string& text) { return concat("the string ", in_quotes(text)); }
    std::string operator()(const Array& items) {
        return items.empty() ? "an empty array" : concat("an array of ", items.size());
    }
    std::string operator()(const Object&) { return "an object"; }
};

} // namespace

std::string describe(const Value& value) {
    return std::visit(Describe{}, value.data);
}

} // namespace sinew::json
