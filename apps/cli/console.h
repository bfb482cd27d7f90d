#pragma once

#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

/// Output on standard output and standard error.
namespace sinew::cli {

/// Exception that ends the command with a message on standard error.
struct CommandError {
    int code = 0; ///< an ExitCode
    std::string message;
};

/// Throws CommandError with bad_input. `where`: subject of the message, a file or the command.
[[noreturn]] void refuse(std::string_view where, std::string_view message, std::string_view help = {});
/// Throws CommandError with wrong_usage.
[[noreturn]] void usage_error(std::string_view message, std::string_view help = {});

/// Message in the format of a scene file's diagnostics:
///
///     nowhere.json: error: No such file or directory
///           = help: ...
std::string error_text(std::string_view where, std::string_view message, std::string_view help = {});

/// Writes to standard output. A reader that leaves early (`sinew list | head -1`) is no error.
void print(std::string_view text);
/// Flushes standard output.
void flush_output();
void print_error(std::string_view text);

/// Exit code of main: `code`, unless writing to standard output failed.
int close_output(int code);

/// True on a terminal, unless NO_COLOR is set (no-color.org).
bool has_color(std::FILE* stream);
/// The text in bold if standard output has colour.
std::string bold(std::string_view text);

/// "1 figure", "2 figures"
std::string count_of(std::size_t count, std::string_view thing);

/// Rows in columns two spaces apart, indented by two. On a terminal the last column is wrapped.
std::string table(const std::vector<std::vector<std::string>>& rows);

} // namespace sinew::cli
