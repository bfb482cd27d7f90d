#pragma once

#include "tests/paths.h"
#include "tests/sanitized.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <vector>

/// Runs the built command as a shell would.
namespace sinew::cli_test {

using test::sanitized;

using Arguments = std::vector<std::string>;

struct Setting {
    std::string input = {};                              ///< on standard input
    std::map<std::string, std::string> environment = {}; ///< besides a catalogue of its own; empty values are unset
    std::filesystem::path folder = {};                   ///< to be in; where the tests are, if empty
    std::filesystem::path command = test::command_path();
    std::size_t max_memory = 0;   ///< bytes of address space; 0: as much as it likes
    std::size_t largest_file = 0; ///< bytes it can write into one; 0: as many as it likes
    bool reader_leaves = false;   ///< standard output is a pipe that nobody reads
    std::string output = {};      ///< a file for standard output: "/dev/full"
    bool terminal = false;        ///< standard error is a terminal
};

struct Outcome {
    int code = 0; ///< exit code, or minus the signal that ended it
    std::string out, err;
    double seconds = 0; ///< of the processor

    /// The last line of standard output.
    std::string last_line() const;
};

/// A command that is still running.
class Running {
  public:
    Running(const Arguments& arguments, const Setting& setting);
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

    void interrupt() const;
    /// At once, without a chance to clean up.
    void kill() const;
    Outcome wait();

  private:
    std::string read_errors();

    pid_t child = 0;
    int output, errors;
    bool terminal;
};

Outcome sinew(const Arguments& arguments, const Setting& setting = {});

/// The catalogue of these tests.
std::filesystem::path catalogue();

/// Whether a text has, begins with, ends with a part: an assertion that shows both.
testing::AssertionResult has(const std::string& text, std::string_view part);
testing::AssertionResult begins(const std::string& text, std::string_view part);
testing::AssertionResult ends(const std::string& text, std::string_view part);

} // namespace sinew::cli_test
