#pragma once

#include "sinew/scene/diagnostic.h"
#include "sinew/scene/utf8.h"

#include <cstddef>
#include <iterator>
#include <optional>
#include <string_view>

/// Tokens of a JSON text.
namespace sinew::json::detail {

inline bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

inline bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

inline bool in_word(char c) {
    return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '-' || c == '+' ||
           c == '.' || c == '$' || static_cast<unsigned char>(c) >= 0x80;
}
/// Locates in the source the tokens that the parser reports. Tokens arrive in text order, so a forward cursor is
/// enough.
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

    /// Span of the token at the cursor: a string with its quotes, a word or number, or one character.
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

    /// Span of the whole word or number around the cursor. For 01 the parser reads 0 as a number and then fails at 1.
    Span whole_word(std::uint32_t source) const {
        std::size_t begin = at_;
        while (begin > 0 && in_word(text_[begin - 1])) --begin;
        return {source, std::uint32_t(begin), std::uint32_t(word_end(at_))};
    }

    /// Offset of a comment without an end, if any.
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

/// The text as passed to the parser, with each run of blanks and comments reduced to one blank. The lexer of
/// nlohmann/json keeps every byte since the last token for error messages, a newline as eight: 16 MB of newlines took
/// 3.3 s and 550 MB.
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

} // namespace sinew::json::detail
