#include "sinew/session/pick.h"
#include "sinew/snapshot/compare.h"
#include "sinew/world/measure.h"

#include "apps/cli/arguments.h"
#include "apps/cli/command.h"
#include "apps/cli/console.h"
#include "apps/cli/diff_picture.h"
#include "apps/cli/diff_trace.h"
#include "apps/cli/json_line.h"
#include "apps/cli/recording_file.h"
#include "apps/cli/scene_file.h"
#include "apps/cli/scrap.h"
#include "apps/cli/session_file.h"
#include "apps/cli/stepping.h"
#include "canvas/formats.h"
#include "canvas/interrupt.h"

#include <fmt/format.h>
#include <limits>
#include <variant>

namespace sinew::cli {
namespace {

/// A run that goes on step by step.
class Runner {
  public:
    explicit Runner(const std::string& word) {
        if (is_recording_file(word))
            made_.emplace<RecordingFile>(read_recording_file(word));
        else
            made_.emplace<Session>(open_session({.scene = word, .overrides = {}}).session);
    }

    const Session& session() const {
        const auto* recording = std::get_if<RecordingFile>(&made_);
        return recording ? recording->replay.session() : std::get<Session>(made_);
    }
    /// False at the end of a recording.
    bool step() {
        if (auto* recording = std::get_if<RecordingFile>(&made_)) return recording->replay.step();
        std::get<Session>(made_).step();
        return true;
    }
    double seconds() const {
        const auto* recording = std::get_if<RecordingFile>(&made_);
        return recording ? std::numeric_limits<double>::infinity() : session().scene().seconds;
    }

  private:
    std::variant<std::monostate, Session, RecordingFile> made_;
};

/// Difference of the states of two sessions; nothing where the hashes are equal.
std::optional<WorldDifference> difference_of(const Session& a, const Session& b) {
    return std::visit(
        [&]<class WorldT>(const WorldT& first) -> std::optional<WorldDifference> {
            const auto* second = std::get_if<WorldT>(&b.world());
            if (!second) return WorldDifference{.field = "dimension or precision"};
            if (state_hash(first) == state_hash(*second)) return std::nullopt;
            auto found = difference(first, *second);
            return found ? found : WorldDifference{.field = "figures, constraints or handles"};
        },
        a.world());
}

struct Found {
    std::uint64_t step = 0;
    WorldDifference what;
    std::string particle; ///< name; empty for anything else
};

/// First step of two runs after which they differ.
std::optional<Found> first_difference(Runner& a, Runner& b, std::uint64_t steps, std::uint64_t& taken) {
    for (taken = 0;; ++taken) {
        give_up_if_interrupted();
        if (auto what = difference_of(a.session(), b.session())) {
            std::string name;
            if (what->field.starts_with("particles."))
                name = std::visit(
                    [&](const auto& world) {
                        const auto row = Row(what->row);
                        return row < world.particles.size()
                                   ? name_of(a.session().world(), world.particles.handles.id_of(row))
                                   : std::string();
                    },
                    a.session().world());
            return Found{taken, std::move(*what), std::move(name)};
        }
        if (taken == steps) return std::nullopt;
        const bool first = a.step(), second = b.step();
        if (!first || !second) return std::nullopt;
    }
}

std::string text_of(const Found& found) {
    const auto& what = found.what;
    if (what.rows == 0) return fmt::format("after step {}: {} differ\n", found.step, what.field);
    return fmt::format("after step {}: {} of row {}{} is {:.17g} in the first and {:.17g} in the second\n"
                       "{} of its rows differ, by {:.3g} at most\n",
                       found.step, what.field, what.row, found.particle.empty() ? "" : " (" + found.particle + ")",
                       what.first, what.second, what.rows, what.most);
}

json::Object json_of(const Found& found) {
    const auto& what = found.what;
    return {{"step", found.step},
            {"field", what.field},
            {"row", std::uint64_t(what.row)},
            {"component", std::uint64_t(what.component)},
            {"particle", found.particle},
            {"first", what.first},
            {"second", what.second},
            {"rows", std::uint64_t(what.rows)},
            {"most", what.most}};
}

std::string text_of(const TraceDifference& found, std::size_t rows) {
    return fmt::format("line {}, {}: {} is {} in the first and {} in the second\n"
                       "{} of {} rows differ, by {:.3g} at most\n",
                       found.line, found.row, found.field, found.first, found.second, found.rows, rows, found.most);
}

json::Object json_of(const TraceDifference& found, std::size_t rows) {
    return {{"line", std::uint64_t(found.line)},
            {"row", found.row},
            {"field", found.field},
            {"first", found.first},
            {"second", found.second},
            {"rows", std::uint64_t(found.rows)},
            {"compared", std::uint64_t(rows)},
            {"most", found.most}};
}

class DiffCommand final : public Command {
    Manual manual() const override {
        return {
            .name = "diff",
            .usage = "A B [-o FILE] [--seconds S] [--json]",
            .about = "compares two scenes, snapshots, recordings or traces and tells where they part",
            .details =
                "The first step after which any number of the two states differs is told, with the first field\n"
                "and row that does, both values, and how much the field differs at most. Two snapshots are\n"
                "compared as they are, and go on for --seconds if it is given; recordings are played to the\n"
                "end of the shorter one. Traces (run --trace) are compared row by row, and have the same rows and\n"
                "columns. Exit code 0 if all are equal to the last bit, 1 if not.\n"
                "The picture of -o has both beside each other after that step, and a ring around the\n"
                "particle; with --later S the runs go on before it is drawn, until the difference is seen.\n",
            .examples = "sinew diff before.sinew after.sinew\n"
                        "sinew diff monday.rec tuesday.rec --json | jq .field\n"
                        "sinew diff here.csv there.csv\n"
                        "sinew diff old/ragdoll.json ragdoll.json --seconds 2\n"
                        "sinew diff old/ragdoll.json ragdoll.json -o parted.png --later 2\n",
        };
    }

    void declare(CLI::App& parser) override {
        declare_words(parser, words);
        declare_number(parser, "-s,--seconds", seconds, possible_seconds, "S", "how long at most");
        declare_text(parser, "-o,--output", picture, "FILE", "draws both where they part: .png, .svg, .pdf");
        declare_number(parser, "--later", later, possible_seconds, "S", "of the picture: so long after they part");
        declare_flag(parser, "--json", as_json, "ends with one line of JSON");
    }

    int run() override {
        if (words.plain.size() != 2 || !words.overrides.empty())
            usage_error("diff compares two files", "sinew diff A B");
        if (picture.empty() && later) usage_error("--later is of a picture", "sinew diff A B -o parted.png --later 2");
        if (!picture.empty()) settle(canvas::check(picture, {}));
        canvas::catch_interrupts();
        if (is_trace_file(words.plain[0]) && is_trace_file(words.plain[1])) return compare_traces();
        Runner a(words.plain[0]), b(words.plain[1]);
        std::uint64_t taken = 0;
        const auto found = first_difference(a, b, steps_of(a, b), taken);
        if (as_json)
            print(to_line(found ? json_of(*found) : json::Object{{"steps", taken}, {"same", true}}));
        else
            print(found ? text_of(*found) : fmt::format("the same, to the last bit, for {} steps\n", taken));
        if (found && !picture.empty()) draw_parted(a, b, *found);
        return found ? bad_input : done;
    }

    int compare_traces() const {
        if (!picture.empty() || seconds)
            usage_error("--output and --seconds are for what can be run, not for traces", "sinew diff A B");
        std::size_t rows = 0;
        const auto found = trace_difference(words.plain[0], words.plain[1], rows);
        if (as_json)
            print(to_line(found ? json_of(*found, rows)
                                : json::Object{{"compared", std::uint64_t(rows)}, {"same", true}}));
        else
            print(found ? text_of(*found, rows) : fmt::format("the same, to the last digit, in {} rows\n", rows));
        return found ? bad_input : done;
    }

    void draw_parted(Runner& a, Runner& b, const Found& found) const {
        for (auto left = steps_until(a.session().scene(), later.value_or(0)); left > 0; --left) {
            give_up_if_interrupted();
            if (!a.step() || !b.step()) break;
        }
        const bool is_of_particle = found.what.field.starts_with("particles.");
        draw_difference(picture, {a.session(), words.plain[0]}, {b.session(), words.plain[1]},
                        is_of_particle ? std::optional(Row(found.what.row)) : std::nullopt);
    }

    std::uint64_t steps_of(const Runner& a, const Runner& b) const {
        const bool are_snapshots = is_snapshot_file(words.plain[0]) && is_snapshot_file(words.plain[1]);
        const auto length = seconds.value_or(are_snapshots ? 0 : std::min(a.seconds(), b.seconds()));
        return length < possible_seconds.high ? steps_until(a.session().scene(), length)
                                              : std::numeric_limits<std::uint64_t>::max();
    }

    Words words;
    std::optional<double> seconds, later;
    std::string picture;
    bool as_json = false;
};

} // namespace

std::unique_ptr<Command> command::diff() {
    return std::make_unique<DiffCommand>();
}

} // namespace sinew::cli
