#pragma once

#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

/// What is said on standard output and standard error.
namespace sinew::cli {

/// Ends the command with a message on standard error.
struct GiveUp {
    int code = 0; ///< an ExitCode
    std::string message;
};

/// The exit code is bad_input. `where` is what the message is about: a file, or else the command itself.
[[noreturn]] void refuse(std::string_view where, std::string_view message, std::string_view help = {});
/// The exit code is wrong_usage.
[[noreturn]] void misused(std::string_view message, std::string_view help = {});

/// In the shape of a diagnostic of a scene file:
///
///     nowhere.json: error: No such file or directory
///           = help: ...
std::string error_text(std::string_view where, std::string_view message, std::string_view help = {});

/// To standard output. Whoever reads it may leave early (`sinew list | head -1`): that is no error.
void print(std::string_view text);
/// So that who reads it sees it now.
void flush_output();
void print_error(std::string_view text);

/// What main returns in the end: `code`, unless standard output could not be written.
int close_output(int code);

/// On a terminal, unless NO_COLOR is set (no-color.org).
bool has_color(std::FILE* stream);
/// The text in bold, where standard output has colour.
std::string bold(std::string_view text);

/// "1 figure", "2 figures"
std::string count_of(std::size_t count, std::string_view thing);

/// Rows in columns that are two spaces apart, indented by two. On a terminal the last column is wrapped.
std::string table(const std::vector<std::vector<std::string>>& rows);

} // namespace sinew::cli
