#include "apps/cli/arguments.h"

#include "sinew/scene/text.h"

#include "apps/cli/command.h"
#include "apps/cli/console.h"
#include "apps/cli/process_limits.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <fmt/format.h>
#include <functional>
#include <memory>

namespace sinew::cli {
namespace {

std::vector<std::string> option_names(const CLI::App& parser) {
    std::vector<std::string> names;
    for (const auto* option : parser.get_options())
        for (const auto& name : option->get_lnames()) names.push_back("--" + name);
    return names;
}

/// Options of other programs, and ours.
constexpr std::array<std::array<std::string_view, 2>, 4> foreign_options = {
    {{"--format", "--json"}, {"--output-format", "--json"}, {"--duration", "--seconds"}, {"--time", "--seconds"}}};

/// "did you mean --seconds?", or a pointer to the manual.
std::string option_help(const CLI::App& parser, std::string_view word) {
    const auto names = option_names(parser);
    const std::vector<std::string_view> views(names.begin(), names.end());
    const auto option = word.substr(0, word.find('='));
    for (const auto& [theirs, ours] : foreign_options)
        if (option == theirs && std::ranges::find(views, ours) != views.end())
            return fmt::format("did you mean {}?", ours);
    const auto meant = nearest(option, views);
    return meant.empty() ? fmt::format("see `sinew help {}`", parser.get_name())
                         : fmt::format("did you mean {}?", meant);
}

void refuse_unknown_options(const CLI::App& parser) {
    for (const auto& word : parser.remaining())
        if (word != "--")
            usage_error(fmt::format("{} has no option {}", parser.get_name(), printable(word)),
                        option_help(parser, word));
}

/// Suggestion for an unexpected word.
std::string stray_help(const CLI::App& parser, const std::string& word, const std::string* next) {
    if (word == "classic" || word == "physical") return fmt::format("did you mean mode={}?", word);
    if (word == "float" || word == "double") return fmt::format("did you mean precision={}?", word);
    if (next && word.find('.') != std::string::npos) return fmt::format("did you mean {}={}?", word, *next);
    return option_help(parser, "--" + word);
}

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$';
}

/// Overrides begin with a letter and have no slash before the `=`: solver.substeps=16 is an override, ./a=b.json a
/// file.
bool is_override(std::string_view word) {
    const auto equals = word.find('=');
    return equals != std::string_view::npos && equals > 0 && is_letter(word[0]) &&
           word.substr(0, equals).find('/') == std::string_view::npos;
}

template <class Number> std::optional<Number> number_of(std::string_view text) {
    Number number{};
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (problem != std::errc() || end != text.data() + text.size()) return {};
    return number;
}

Words sorted(const std::vector<std::string>& words) {
    Words all;
    for (const auto& word : words) {
        if (is_override(word))
            all.overrides.push_back({word});
        else
            all.plain.push_back(word);
    }
    return all;
}

SceneWords scene_of(const CLI::App& parser, Words words) {
    const auto& plain = words.plain;
    if (plain.empty())
        usage_error(
            fmt::format("{}: no scene given", parser.get_name()),
            fmt::format("sinew {} SCENE, where SCENE is a file or a name that `sinew list` tells", parser.get_name()));
    if (plain.size() > 1)
        usage_error(fmt::format("{} is neither an option nor key=value", in_quotes(plain[1])),
                    stray_help(parser, plain[1], plain.size() > 2 ? &plain[2] : nullptr));
    return {plain[0], std::move(words.overrides)};
}

void declare_taken(CLI::App& parser, const std::string& names, const std::string& placeholder, const std::string& help,
                   const std::function<void(const std::string&)>& take) {
    parser.add_option_function<std::string>(names, take, help)->type_name(placeholder)->take_last();
}

std::string long_name(const std::string& names) {
    return names.substr(names.find("--"));
}

template <class Number>
void declare_in_range(CLI::App& parser, const std::string& names, std::optional<Number>& target, Range range,
                      const std::string& placeholder, const std::string& help, std::string_view kind) {
    declare_taken(parser, names, placeholder, help, [=, &target](const std::string& text) {
        target = number_of<Number>(text);
        if (!target || !(*target >= range.low && *target <= range.high))
            usage_error(fmt::format("{}: expected {} {}, found {}", long_name(names), kind, range_text(range),
                                    in_quotes(text)));
    });
}

void declare_all(Command& command, CLI::App& parser, ProcessLimits& limits) {
    parser.set_help_flag("-h,--help", "this text");
    command.declare(parser);
    declare_limits(parser, limits);
}

} // namespace

bool parse(Command& command, std::span<const std::string> arguments) {
    CLI::App parser("", std::string(command.manual().name));
    ProcessLimits limits;
    declare_all(command, parser, limits);
    parser.allow_extras();
    try {
        std::vector<std::string> from_the_end(arguments.rbegin(), arguments.rend()); // CLI11 expects the reverse order
        if (command.takes_options_as_words()) from_the_end.emplace_back("--");
        parser.parse(std::move(from_the_end));
    } catch (const CLI::CallForHelp&) {
        return false;
    } catch (const CLI::ParseError& error) {
        usage_error(error.what(), fmt::format("see `sinew help {}`", parser.get_name()));
    }
    refuse_unknown_options(parser);
    set_limits(limits);
    return true;
}

std::vector<std::vector<std::string>> option_rows(Command& command) {
    CLI::App parser;
    ProcessLimits limits;
    declare_all(command, parser, limits);
    std::vector<std::vector<std::string>> rows;
    for (const auto* option : parser.get_options([](const CLI::Option* o) { return o->nonpositional(); })) {
        const bool takes_value = option->get_items_expected_max() > 0;
        rows.push_back({option->get_name(false, true) + (takes_value ? " " + option->get_type_name() : ""),
                        option->get_description()});
    }
    if (rows.size() > 1) std::rotate(rows.begin(), rows.begin() + 1, rows.end()); // help last
    return rows;
}

void declare_words(CLI::App& parser, Words& target) {
    const auto words = std::make_shared<std::vector<std::string>>();
    parser.add_option("words", *words);
    parser.final_callback([&parser, &target, words] {
        refuse_unknown_options(parser); // first: the word after an unknown option may be the option's value
        target = sorted(*words);
    });
}

void declare_scene(CLI::App& parser, SceneWords& target) {
    const auto words = std::make_shared<std::vector<std::string>>();
    parser.add_option("words", *words);
    parser.final_callback([&parser, &target, words] {
        refuse_unknown_options(parser);
        target = scene_of(parser, sorted(*words));
    });
}

void declare_flag(CLI::App& parser, const std::string& names, bool& target, const std::string& help) {
    parser.add_flag(names, target, help)->disable_flag_override();
}

void declare_text(CLI::App& parser, const std::string& names, std::string& target, const std::string& placeholder,
                  const std::string& help) {
    declare_taken(parser, names, placeholder, help, [=, &target](const std::string& text) {
        if (text.empty()) usage_error(fmt::format("{}: expected {}, found nothing", long_name(names), placeholder));
        target = text;
    });
}

void declare_number(CLI::App& parser, const std::string& names, std::optional<double>& target, Range range,
                    const std::string& placeholder, const std::string& help) {
    declare_in_range(parser, names, target, range, placeholder, help, "a number");
}

void declare_whole(CLI::App& parser, const std::string& names, std::optional<int>& target, Range range,
                   const std::string& placeholder, const std::string& help) {
    declare_in_range(parser, names, target, range, placeholder, help, "a whole number");
}

void declare_pair(CLI::App& parser, const std::string& names, std::optional<std::array<int, 2>>& target,
                  const std::string& placeholder, const std::string& help) {
    declare_taken(parser, names, placeholder, help, [=, &target](const std::string& text) {
        const auto cross = std::min(text.find('x'), text.size());
        const auto first = number_of<int>(std::string_view(text).substr(0, cross));
        const auto second = number_of<int>(std::string_view(text).substr(std::min(cross + 1, text.size())));
        if (!first || !second || *first < 1 || *second < 1)
            usage_error(fmt::format("{}: expected {}, two whole numbers, found {}", long_name(names), placeholder,
                                    in_quotes(text)));
        target = {*first, *second};
    });
}

} // namespace sinew::cli
