#include "apps/cli/arguments.h"
#include "apps/cli/bench_options.h"
#include "apps/cli/command.h"
#include "apps/cli/console.h"
#include "canvas/interrupt.h"

#include <array>
#include <fmt/format.h>

namespace sinew::cli {
namespace {

class BenchCommand final : public Command {
    Manual manual() const override {
        static const std::string details = case_details() + "\n" + quality_details() + "\n" + weights_details() + "\n" +
                                           budget_details() + "\n" + rope_details() + "\n" + contact_details();
        return {
            .name = "bench",
            .usage = "[CASE...] [--threads N] [--precision P] [--steps N] [--json | --markdown]\n"
                     "sinew bench quality [CASE] [--plot FILE] [--json]\n"
                     "sinew bench weights [--plot FILE] [--json]\n"
                     "sinew bench budget [--threads N] [--precision P] [--json]\n"
                     "sinew bench rope [CASE] [--links N] [--weight W] [--start hang|level] [--threads N] [--json]\n"
                     "sinew bench contact [CASE...] [--threads N] [--substeps N] [--seconds S] [--json]",
            .about = "measures how well and how fast the engine is",
            .details = details,
            .examples = "sinew bench\n"
                        "sinew bench cloth-256 ragdolls-1000 --threads 2 --json\n"
                        "sinew bench rope --links 100 --weight 100000 --start level --json\n"
                        "sinew bench contact pile-1000 stack-10\n",
        };
    }

    void declare(CLI::App& parser) override {
        declare_words(parser, words);
        declare_number(parser, "--threads", options.threads, {1, 1024}, "N",
                       "how many work on a step; else 1, 2 and 4, of rope and budget 1");
        declare_text(parser, "--precision", options.precision, "P",
                     "float or double; else both, of rope double, of budget float");
        declare_number(parser, "--steps", options.steps, {2, 1e6}, "N",
                       "how many steps a case; else a few seconds' worth");
        declare_text(parser, "--case", options.only, "C", "of rope: the case, said in another way");
        declare_number(parser, "--links", options.links, {1, 1e6}, "N", "of rope: how many; else 10, 100 and 1000");
        declare_number(parser, "--weight", options.weight, {0, 1e9}, "W",
                       "of rope: mass on the end, in links; else 1, 100, 1000 and 100000");
        declare_text(parser, "--start", options.start, "S", "of rope: hang or level; else both");
        declare_number(parser, "-s,--seconds", options.seconds, {0.1, 1e6}, "S",
                       "of rope and contact: how long, simulated; else 5 and 10");
        declare_number(parser, "--substeps", options.substeps, {1, 1e4}, "N",
                       "of contact: substeps a step; else 16, of other engines 1");
        declare_text(parser, "--plot", options.plot, "FILE", "of quality and weights: an SVG file to draw into");
        declare_flag(parser, "--json", options.as_json, "one line of JSON a case");
        declare_flag(parser, "--markdown", options.as_markdown, "tables as Markdown has them");
    }

    int run() override {
        if (!words.overrides.empty()) usage_error("bench: what is measured?", "sinew bench cloth-256");
        check_word("--start", options.start, {"hang", "level"});
        check_word("--precision", options.precision, {"float", "double"});
        canvas::catch_interrupts();
        const auto& plain = words.plain;
        const std::string first = plain.empty() ? "" : plain[0];
        if (first == "rope" && plain.size() <= 2) {
            if (plain.size() == 2) options.only = plain[1];
            bench_ropes(options);
        } else if (first == "contact")
            bench_contacts(options, contact_cases(plain));
        else if (first == "weights" && plain.size() == 1)
            bench_weights(options);
        else if (first == "budget" && plain.size() == 1)
            bench_budget(options);
        else if (first == "quality" && plain.size() <= 2)
            bench_quality(options, plain.size() == 2 ? cases({plain[1]}).front() : *bench::find_case("swing-64"));
        else
            bench_cases(options, plain.empty() ? bench::all_cases() : cases(plain));
        return done;
    }

    static std::vector<bench::Case> cases(const std::vector<std::string>& names) {
        std::vector<bench::Case> chosen;
        for (const auto& word : names) {
            auto found = bench::find_case(word);
            if (!found) usage_error(fmt::format("bench: there is no case {}", word), "sinew bench --help");
            chosen.push_back(std::move(*found));
        }
        return chosen;
    }

    static std::vector<bench::ContactCase> contact_cases(const std::vector<std::string>& names) {
        if (names.size() == 1) return bench::all_contact_cases();
        std::vector<bench::ContactCase> chosen;
        for (std::size_t i = 1; i < names.size(); ++i) {
            auto found = bench::find_contact_case(names[i]);
            if (!found)
                usage_error(fmt::format("bench: there is no case of contact {}", names[i]), "sinew bench --help");
            chosen.push_back(std::move(*found));
        }
        return chosen;
    }

    static void check_word(std::string_view option, const std::string& word, std::array<std::string_view, 2> allowed) {
        if (!word.empty() && word != allowed[0] && word != allowed[1])
            usage_error(fmt::format("bench: {} is {} or {}, found {}", option, allowed[0], allowed[1], word));
    }

    Words words;
    BenchOptions options;
};

} // namespace

std::unique_ptr<Command> command::bench() {
    return std::make_unique<BenchCommand>();
}

} // namespace sinew::cli
