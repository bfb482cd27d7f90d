#include "canvas/formats.h"
#include "canvas/interrupt.h"
#include "tests/canvas/scratch_folder.h"
#include "tests/canvas/tumbling_figure.h"

#include <chrono>
#include <csignal>
#include <functional>
#include <gtest/gtest.h>
#include <string>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace sinew::SINEW_TEST_FILE {
namespace {

using canvas::Failure;
using namespace std::chrono_literals;

constexpr const char* every_name[] = {"a.png", "a.svg", "a.pdf", "a.gif", "a.mp4", "a.webm", "a.webp"};
constexpr const char* film_names[] = {"a.gif", "a.mp4", "a.webm", "a.webp"};

Failure write(const std::filesystem::path& path, int frames = 1, int width = 320, int height = 240) {
    auto [writer, failure] = canvas::open(path, {width, height, 25});
    TumblingFigure figure;
    for (int i = 0; i < frames && !failure; ++i) failure = writer->frame(figure.at(float(i) / 25, width, height));
    return failure ? failure : writer->finish();
}

void expect_contains(const Failure& failure, const std::string& part) {
    ASSERT_TRUE(failure) << "expected: " << part;
    EXPECT_TRUE(failure->find(part) != std::string::npos) << *failure << "\nlacks: " << part;
}

/// Another PATH, for as long as it lives.
struct WithPath {
    std::string before = getenv("PATH");
    explicit WithPath(const std::filesystem::path& path) { setenv("PATH", path.c_str(), 1); }
    WithPath(const WithPath&) = delete;
    WithPath& operator=(const WithPath&) = delete;
    ~WithPath() { setenv("PATH", before.c_str(), 1); }
};

/// Puts a script in the place of ffmpeg.
struct FakeFfmpeg {
    ScratchFolder folder;
    WithPath path{folder.path.string() + ":" + getenv("PATH")};
    explicit FakeFfmpeg(const std::string& script) {
        std::ofstream(folder / "ffmpeg") << "#!/bin/sh\n" << script << '\n';
        chmod((folder / "ffmpeg").c_str(), 0755);
    }
};

/// Does something in a process of its own, with a process group of its own as a shell would give it.
pid_t in_child(const std::function<int()>& work) {
    const pid_t child = fork();
    if (child != 0) return setpgid(child, child), child;
    setpgid(0, 0);
    _exit(work());
}

/// How it ended: its exit code, or minus the signal.
int end_of(pid_t child) {
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

/// How a process ended that was sent one signal after the other. A busy machine may be late to deliver the first, and
/// two that wait are one: so there are as many as it takes. One that none ends is killed.
int end_by_signals(pid_t child, int signal_number) {
    for (int sent = 0; sent < 200; ++sent) {
        kill(child, signal_number);
        std::this_thread::sleep_for(50ms);
        siginfo_t ended{};
        if (waitid(P_PID, id_t(child), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 && ended.si_pid == child)
            return end_of(child);
    }
    kill(child, SIGKILL);
    return end_of(child);
}

/// Writes until it is interrupted, as a command would. 99 if a failure was not what it should be.
int write_for_ever(const std::filesystem::path& path) {
    canvas::catch_interrupts();
    auto [writer, failure] = canvas::open(path, {320, 240, 25});
    TumblingFigure figure;
    const bool film = canvas::format_of(path)->moves;
    if (!failure) failure = writer->frame(figure.at(0, 320, 240));
    for (int i = 1; film && !failure; ++i) failure = writer->frame(figure.at(float(i) / 25, 320, 240));
    while (!film && !canvas::interrupted()) std::this_thread::sleep_for(1ms);
    if (!failure) failure = writer->finish();
    if (failure != "interrupted; " + path.string() + " was not written") return 99;
    return canvas::interrupt_exit_code();
}

void wait_for_files(const ScratchFolder& folder) {
    for (int i = 0; i < 5000 && folder.names().empty(); ++i) std::this_thread::sleep_for(1ms);
    std::this_thread::sleep_for(100ms); // well into it
}

TEST(Folder, IsCreatedWhereItIsMissing) {
    ScratchFolder folder;
    EXPECT_EQ(write(folder / "new/deep/a.png"), Failure());
    EXPECT_TRUE(std::filesystem::exists(folder / "new/deep/a.png"));
}

TEST(Folder, ThatIsAFileIsNamed) {
    ScratchFolder folder;
    std::ofstream(folder / "file") << "not a folder";
    for (const std::string name : every_name) {
        const auto path = folder / ("file/" + name);
        EXPECT_EQ(write(path),
                  "cannot write " + path.string() + ": " + (folder / "file").string() + " is not a folder");
    }
    expect_contains(write(folder / "file/deeper/a.png"), "not a folder");
}

TEST(Folder, ThatMayNotBeWrittenIsNamed) {
    ScratchFolder folder;
    std::filesystem::create_directory(folder / "closed");
    std::filesystem::permissions(folder / "closed", std::filesystem::perms(0555));
    std::filesystem::permissions(folder.path, std::filesystem::perms(0755));
    const pid_t child = in_child([&] {
        if (geteuid() == 0 && seteuid(65534) != 0) return 1; // root may write everywhere
        const Failure file = write(folder / "closed/a.png"), deeper = write(folder / "closed/new/a.mp4");
        const auto closed = (folder / "closed").string();
        if (file != "cannot write " + closed + "/a.png: the folder " + closed + " takes no file: Permission denied")
            return 2;
        if (deeper !=
            "cannot write " + closed + "/new/a.mp4: the folder " + closed + "/new cannot be created: Permission denied")
            return 3;
        return 0;
    });
    EXPECT_EQ(end_of(child), 0);
}

TEST(Target, ThatIsAFolderIsLeftAlone) {
    ScratchFolder folder;
    std::filesystem::create_directory(folder / "a.png");
    EXPECT_EQ(write(folder / "a.png"), "cannot write " + (folder / "a.png").string() + ": it is a folder");
}

TEST(Target, WithALongNameCanBeWritten) {
    ScratchFolder folder;
    EXPECT_EQ(write(folder / (std::string(250, 'x') + ".png")), Failure());
    expect_contains(write(folder / (std::string(300, 'x') + ".png")), "File name too long");
}

TEST(MissingFfmpeg, IsNamedWithTheWayToInstallIt) {
    ScratchFolder folder;
    const WithPath nowhere(folder.path);
    for (const std::string name : film_names)
        EXPECT_EQ(write(folder / name),
                  "cannot write " + (folder / name).string() + ": ffmpeg is needed for " + name.substr(1) +
                      "; install it with: apt-get install ffmpeg (.png, .svg and .pdf need nothing)");
    EXPECT_EQ(folder.names(), std::vector<std::string>());
    EXPECT_EQ(write(folder / "a.png"), Failure()) << "images do not need it";
}

TEST(FailingFfmpeg, IsQuotedWithItsLastLines) {
    ScratchFolder folder;
    const FakeFfmpeg fake("head -c 1000000 >/dev/null; for i in 1 2 3 4 5 6 7 8; do echo line $i >&2; done; exit 3");
    for (const std::string name : film_names) {
        const Failure failure = write(folder / name, 100);
        expect_contains(failure,
                        "cannot write " + (folder / name).string() + ": ffmpeg stopped before the end (exit code 3)");
        expect_contains(failure, "\n    line 3\n    line 4\n    line 5\n    line 6\n    line 7\n    line 8");
        EXPECT_TRUE(failure->find("line 2") == std::string::npos);
    }
    EXPECT_EQ(folder.names(), std::vector<std::string>());
}

TEST(FailingFfmpeg, AtTheVeryEndIsAFailureToo) {
    ScratchFolder folder;
    const FakeFfmpeg fake("cat >/dev/null; echo disk trouble >&2; exit 1");
    for (const std::string name : film_names)
        expect_contains(write(folder / name, 3), "(exit code 1)\n    disk trouble");
    EXPECT_EQ(folder.names(), std::vector<std::string>());
}

TEST(FailingFfmpeg, ThatIsKilledMidwayIsAFailureNotTheEndOfUs) {
    ScratchFolder folder;
    const FakeFfmpeg fake("head -c 1000000 >/dev/null; kill -9 $$");
    for (const std::string name : film_names)
        expect_contains(write(folder / name, 100), "ffmpeg stopped before the end (ended by a signal: Killed)");
    EXPECT_EQ(folder.names(), std::vector<std::string>());
}

TEST(FailingFfmpeg, StaysFailed) {
    ScratchFolder folder;
    const FakeFfmpeg fake("exit 1");
    auto [writer, none] = canvas::open(folder / "a.mp4", {320, 240, 25});
    ASSERT_TRUE(writer);
    TumblingFigure figure;
    Failure first;
    for (int i = 0; i < 100 && !first; ++i) first = writer->frame(figure.at(0, 320, 240));
    expect_contains(first, "exit code 1");
    EXPECT_EQ(writer->frame(figure.at(0, 320, 240)), first);
    EXPECT_EQ(writer->finish(), first);
}

TEST(Abandoned, WriterLeavesNothingBehind) {
    for (const std::string name : every_name) {
        ScratchFolder folder;
        auto [writer, failure] = canvas::open(folder / name, {320, 240, 25});
        ASSERT_EQ(failure, Failure());
        EXPECT_FALSE(std::filesystem::exists(folder / name));
        TumblingFigure figure;
        ASSERT_EQ(writer->frame(figure.at(0)), Failure());
        writer.reset();
        std::this_thread::sleep_for(20ms); // time for a child that survived to do harm
        EXPECT_EQ(folder.names(), std::vector<std::string>()) << name;
    }
}

TEST(FullDisk, IsReportedAndLeavesNothingBehind) {
    for (const std::string name : every_name) {
        ScratchFolder folder;
        const pid_t child = in_child([&] {
            canvas::catch_interrupts();
            const rlimit limit{1000, 1000}; // the nearest thing to a full disk: files may not grow beyond 1000 bytes
            setrlimit(RLIMIT_FSIZE, &limit);
            const Failure failure = write(folder / name, canvas::format_of(name)->moves ? 200 : 1);
            return failure && failure->find("File") != std::string::npos ? 0 : 1;
        });
        EXPECT_EQ(end_of(child), 0) << name;
        EXPECT_EQ(folder.names(), std::vector<std::string>()) << name;
    }
}

TEST(ClosedStandardStreams, DoNotMixUpTheChild) {
    ScratchFolder folder;
    const pid_t child = in_child([&] {
        for (int stream : {0, 1, 2}) close(stream);
        return write(folder / "a.mp4", 10) || write(folder / "a.gif", 10) ? 1 : 0;
    });
    EXPECT_EQ(end_of(child), 0);
    EXPECT_EQ(folder.names().size(), 2u);
}

TEST(Interruption, LeavesNothingBehindAndEndsWith128PlusTheSignal) {
    for (const std::string name : every_name)
        for (int signal_number : {SIGINT, SIGTERM, SIGHUP}) {
            ScratchFolder folder;
            const pid_t child = in_child([&] { return write_for_ever(folder / name); });
            wait_for_files(folder);
            EXPECT_FALSE(folder.names().empty());
            kill(-child, signal_number); // to all of its group, as a terminal does
            EXPECT_EQ(end_of(child), 128 + signal_number) << name;
            EXPECT_EQ(folder.names(), std::vector<std::string>()) << name;
        }
}

TEST(Interruption, WhileFfmpegCompletesTheFileEndsItToo) {
    ScratchFolder folder;
    const FakeFfmpeg fake("cat >/dev/null; sleep 100");
    const pid_t child = in_child([&] {
        canvas::catch_interrupts();
        const Failure failure = write(folder / "a.mp4", 3);
        return failure && failure->starts_with("interrupted") ? canvas::interrupt_exit_code() : 99;
    });
    wait_for_files(folder);
    kill(child, SIGINT);
    EXPECT_EQ(end_of(child), 130);
    EXPECT_EQ(folder.names(), std::vector<std::string>());
}

TEST(Interruption, OfAStuckProcessTakesASecondSignalAndLeavesNothingBehind) {
    for (const std::string name : every_name) {
        ScratchFolder folder;
        int ready[2];
        ASSERT_EQ(pipe(ready), 0);
        const pid_t child = in_child([&] {
            canvas::catch_interrupts();
            auto [writer, failure] = canvas::open(folder / name, {320, 240, 25});
            TumblingFigure figure;
            if (!failure) failure = writer->frame(figure.at(0));
            if (failure || ::write(ready[1], "!", 1) != 1) return 99;
            for (;;) std::this_thread::sleep_for(1s);
        });
        close(ready[1]);
        char mark = 0;
        EXPECT_EQ(read(ready[0], &mark, 1), 1);
        close(ready[0]);
        EXPECT_FALSE(folder.names().empty());
        EXPECT_EQ(end_by_signals(child, SIGINT), 130) << name;
        std::this_thread::sleep_for(50ms);
        EXPECT_EQ(folder.names(), std::vector<std::string>()) << name;
    }
}

TEST(Interruption, StaysIgnoredWhereItWasIgnored) {
    ScratchFolder folder;
    const pid_t child = in_child([&] {
        std::signal(SIGHUP, SIG_IGN); // as under nohup
        canvas::catch_interrupts();
        raise(SIGHUP);
        return write(folder / "a.png") ? 1 : 0;
    });
    EXPECT_EQ(end_of(child), 0);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
