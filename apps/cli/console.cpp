#include "apps/cli/console.h"

#include "sinew/scene/text.h"

#include "apps/cli/command.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace sinew::cli {
namespace {

// Global because standard output belongs to the process.
int output_error = 0;

std::string painted(std::string_view text, const char* code, std::FILE* stream) {
    return has_color(stream) ? fmt::format("\033[{}m{}\033[0m", code, text) : std::string(text);
}

/// Columns of the terminal behind `stream`; without a terminal, unlimited.
std::size_t columns_of(std::FILE* stream) {
    winsize size{};
    const bool known = ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return known ? size.ws_col : std::string::npos;
}

/// Width on a terminal: UTF-8 characters, not bytes.
std::size_t width_of(std::string_view text) {
    return std::size_t(std::ranges::count_if(text, [](char c) { return (c & 0xc0) != 0x80; }));
}

/// Breaks a text at spaces into lines of at most `width`, the later ones indented by `indent`.
std::string wrapped(std::string_view text, std::size_t width, std::size_t indent) {
    std::string out;
    std::size_t used = 0;
    while (!text.empty()) {
        const auto word = text.substr(0, text.find(' '));
        text.remove_prefix(std::min(word.size() + 1, text.size()));
        const bool fits = used == 0 || used + 1 + width_of(word) <= width;
        if (!fits) out += '\n' + std::string(indent, ' ');
        if (fits && used > 0) out += ' ';
        used = fits ? used + (used > 0) + width_of(word) : width_of(word);
        out += word;
    }
    return out;
}

std::vector<std::size_t> widths_of(const std::vector<std::vector<std::string>>& rows) {
    std::vector<std::size_t> widths;
    for (const auto& row : rows) {
        widths.resize(std::max(widths.size(), row.size()));
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width_of(row[i]));
    }
    return widths;
}

} // namespace

void refuse(std::string_view where, std::string_view message, std::string_view help) {
    throw CommandError{bad_input, error_text(where, message, help)};
}

void usage_error(std::string_view message, std::string_view help) {
    throw CommandError{wrong_usage, error_text("sinew", message, help)};
}

std::string error_text(std::string_view where, std::string_view message, std::string_view help) {
    auto text = fmt::format("{}: {}{}\n", printable(where, 4096), painted("error: ", "1;31", stderr), message);
    if (!help.empty()) text += fmt::format("      = help: {}\n", help);
    return text;
}

void print(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) < text.size() && output_error == 0) output_error = errno;
}

void flush_output() {
    if (std::fflush(stdout) != 0 && output_error == 0) output_error = errno;
}

void print_error(std::string_view text) {
    std::fflush(stdout); // on a terminal both streams appear in order
    std::fwrite(text.data(), 1, text.size(), stderr);
}

int close_output(int code) {
    if (std::fflush(stdout) != 0 && output_error == 0) output_error = errno;
    if (output_error == 0 || output_error == EPIPE) return code;
    print_error(error_text("sinew", fmt::format("cannot write to standard output: {}", std::strerror(output_error))));
    return code == done ? int(bad_input) : code;
}

bool has_color(std::FILE* stream) {
    const char* const no_color = std::getenv("NO_COLOR");
    const char* const terminal = std::getenv("TERM");
    const bool wanted = (!no_color || !*no_color) && (!terminal || std::string_view(terminal) != "dumb");
    return wanted && isatty(fileno(stream));
}

std::string bold(std::string_view text) {
    return painted(text, "1", stdout);
}

std::string count_of(std::size_t count, std::string_view thing) {
    return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

std::string table(const std::vector<std::vector<std::string>>& rows) {
    constexpr std::size_t narrowest = 24; // least width of the last column on a narrow terminal
    const auto widths = widths_of(rows);
    const auto columns = columns_of(stdout);
    std::string out;
    for (const auto& row : rows) {
        std::string line = "  ";
        std::size_t begin = 2;
        for (std::size_t i = 0; i < row.size(); ++i) {
            const bool last = i + 1 == row.size();
            const auto room = columns == std::string::npos ? columns : std::max(columns, begin + narrowest) - begin;
            line += last ? wrapped(row[i], room, begin) : row[i];
            if (!last) line += std::string(widths[i] - width_of(row[i]) + 2, ' ');
            begin += widths[i] + 2;
        }
        line.erase(line.find_last_not_of(' ') + 1);
        out += line + '\n';
    }
    return out;
}

} // namespace sinew::cli
