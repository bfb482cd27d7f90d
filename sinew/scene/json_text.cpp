#include "sinew/scene/json.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace sinew::json {
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

/// Writes items between brackets: on one line if they fit, otherwise one item a line.
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
