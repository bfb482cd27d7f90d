#include "apps/cli/arguments.h"
#include "apps/cli/command.h"
#include "apps/cli/console.h"
#include "apps/cli/scene_file.h"

#include <fmt/format.h>

namespace sinew::cli {
namespace {

std::string counts_text(const Opened& opened) {
    return std::visit(
        [&](const auto& world) {
            std::size_t constraints = 0;
            for_each_table(world, [&](const auto& table) { constraints += table.size(); });
            return fmt::format("{}, {}, {}, {}", count_of(world.figures.size(), "figure"),
                               count_of(world.particles.size(), "particle"), count_of(constraints, "constraint"),
                               count_of(opened.scene.events.size(), "event"));
        },
        opened.world);
}

class CheckCommand final : public Command {
    Manual manual() const override {
        return {
            .name = "check",
            .usage = "SCENE... [key=value...]",
            .about = "says what is wrong with scene files, all of it",
            .details =
                "Every file is read and its world is made. Good ones are called ok with what they hold. Where one\n"
                "is not, all its errors are told with file, line and column, and the exit code is 1.\n",
            .examples = "sinew check my.json\n"
                        "sinew check scenes/*.json\n"
                        "sinew check ragdoll mode=classic\n"
                        "sinew check big.json limits.particles=5000000\n",
        };
    }

    void declare(CLI::App& parser) override { declare_words(parser, words); }

    int run() override {
        if (words.plain.empty()) usage_error("check: no scene given", "sinew check FILE...");
        bool good = true;
        for (const auto& word : words.plain) good &= check(word);
        return good ? done : bad_input;
    }

    bool check(const std::string& word) const {
        try {
            print(fmt::format("{}: ok ({})\n", word, counts_text(open_file(word, words.overrides))));
            return true;
        } catch (const CommandError& end) {
            print_error(end.message);
            return false;
        }
    }

    Words words;
};

} // namespace

std::unique_ptr<Command> command::check() {
    return std::make_unique<CheckCommand>();
}

} // namespace sinew::cli
