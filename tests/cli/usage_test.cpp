#include "tests/cli/command.h"

#include <gtest/gtest.h>

/// What is said to someone who does not know how, or gets it wrong.
namespace sinew::cli_test::SINEW_TEST_FILE {
namespace {

void expect_help(const Outcome& outcome, const char* text) {
    EXPECT_EQ(outcome.code, 0);
    EXPECT_TRUE(has(outcome.out, text));
    EXPECT_EQ(outcome.err, "");
}

void expect_misuse(const Arguments& arguments, const char* message, const char* help) {
    const auto outcome = sinew(arguments);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_TRUE(begins(outcome.err, "sinew: error: "));
    EXPECT_TRUE(has(outcome.err, message));
    EXPECT_TRUE(has(outcome.err, help));
    EXPECT_EQ(outcome.out, "");
}

TEST(Help, TeachesWithoutBeingAsked) {
    expect_help(sinew({}), "sinew render ragdoll -o ragdoll.mp4");
    expect_help(sinew({"--help"}), "usage: sinew COMMAND");
    expect_help(sinew({"help"}), "usage: sinew COMMAND");
}

TEST(Help, KnowsEveryCommand) {
    const auto overview = sinew({}).out;
    for (const auto* command : {"render", "run", "check", "info", "list", "describe"}) {
        EXPECT_TRUE(has(overview, command));
        expect_help(sinew({"help", command}), "examples");
        expect_help(sinew({command, "--help"}), "-h,--help");
        expect_help(sinew({command, "x", "-h"}), "usage");
    }
}

TEST(Help, TellsTheVersion) {
    const auto outcome = sinew({"--version"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_TRUE(begins(outcome.out, "sinew 0."));
}

TEST(Usage, UnknownCommandsAreCorrected) {
    expect_misuse({"rnu"}, "no command \"rnu\"", "did you mean \"run\"?");
    expect_misuse({"rendre", "pendulum"}, "no command", "did you mean \"render\"?");
    expect_misuse({"help", "lsit"}, "no command", "did you mean \"list\"?");
    expect_misuse({"pendulum"}, "no command", "sinew render pendulum");
    expect_misuse({"--json", "run"}, "no option --json here", "options follow the command");
}

TEST(Usage, UnknownOptionsAreCorrected) {
    expect_misuse({"run", "pendulum", "--secnds", "3"}, "run has no option --secnds", "did you mean --seconds?");
    expect_misuse({"run", "pendulum", "--secnds=3"}, "no option", "did you mean --seconds?");
    expect_misuse({"render", "pendulum", "--shet", "4x3"}, "no option", "did you mean --sheet?");
    expect_misuse({"list", "--wide"}, "list has no option --wide", "sinew help list");
}

TEST(Usage, StrayWordsAreCorrected) {
    expect_misuse({"run", "pendulum", "solver.substeps", "4"}, "neither an option nor key=value",
                  "did you mean solver.substeps=4?");
    expect_misuse({"run", "pendulum", "classic"}, "neither", "did you mean mode=classic?");
    expect_misuse({"run", "pendulum", "float"}, "neither", "did you mean precision=float?");
    expect_misuse({"run", "pendulum", "seconds"}, "neither", "did you mean --seconds?");
    expect_misuse({"list", "rope"}, "no word such as rope", "sinew describe rope");
}

TEST(Usage, ValuesOfOptionsAreChecked) {
    expect_misuse({"run", "pendulum", "--seconds", "long"}, "--seconds: expected a number", "\"long\"");
    expect_misuse({"run", "pendulum", "--seconds", "nan"}, "--seconds: expected a number", "\"nan\"");
    expect_misuse({"run", "pendulum", "--seconds", "1e999"}, "--seconds: expected a number", "\"1e999\"");
    expect_misuse({"run", "pendulum", "--seconds", "-1"}, "--seconds: expected a number", "\"-1\"");
    expect_misuse({"run", "pendulum", "--seconds"}, "--seconds", "sinew help run");
    expect_misuse({"render", "pendulum", "--size", "640"}, "--size: expected WxH", "\"640\"");
    expect_misuse({"render", "pendulum", "--size", "640x480x3"}, "--size: expected WxH", "\"640x480x3\"");
    expect_misuse({"render", "pendulum", "--size", "0x480"}, "--size: expected WxH", "\"0x480\"");
    expect_misuse({"render", "pendulum", "--sheet", "-4x3"}, "--sheet: expected CxR", "\"-4x3\"");
    expect_misuse({"describe", "rope", "--schema", "--markdown"}, "not both", "");
}

TEST(Usage, ASceneIsNeeded) {
    for (const auto* command : {"render", "run", "check", "info"}) expect_misuse({command}, "no scene given", "sinew");
}

TEST(Usage, TheLastOfTwoCounts) {
    EXPECT_TRUE(has(sinew({"run", "pendulum", "--seconds", "9", "--seconds", "1"}).out, "1 s in 60 steps"));
}

TEST(Output, AReaderMayLeaveEarly) {
    for (const Arguments& arguments :
         {Arguments{"list"}, {"help"}, {"run", "pendulum", "--json"}, {"check", "pendulum"}}) {
        const auto outcome = sinew(arguments, {.reader_leaves = true});
        EXPECT_EQ(outcome.code, 0);
        EXPECT_EQ(outcome.err, "");
    }
}

TEST(Output, AFullDiskIsTold) {
    const auto outcome = sinew({"list"}, {.output = "/dev/full"});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_TRUE(ends(outcome.err, "cannot write to standard output: No space left on device\n"));
}

TEST(Output, IsColouredOnlyForPeople) {
    const auto red = "\033[1;31m";
    EXPECT_TRUE(has(sinew({"run", "nothing"}, {.terminal = true}).err, red));
    EXPECT_TRUE(has(sinew({"run", "pendulum", "solver.no=1"}, {.terminal = true}).err, "\033["));
    EXPECT_FALSE(has(sinew({"run", "nothing"}).err, "\033"));
    const Setting without{.environment = {{"NO_COLOR", "1"}}, .terminal = true};
    EXPECT_FALSE(has(sinew({"run", "nothing"}, without).err, "\033"));
    EXPECT_FALSE(has(sinew({"run", "pendulum", "solver.no=1"}, without).err, "\033"));
}

} // namespace
} // namespace sinew::cli_test::SINEW_TEST_FILE
