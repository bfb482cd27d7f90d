#include "sinew/math/random.h"

#include "player/recording.h"
#include "player/timeline.h"
#include "tests/scene/scene_runs.h"
#include "tests/thorough.h"

/// Recordings: written as things happen, read back whole or up to where they end, and played.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace play;
using Bytes = std::vector<std::byte>;

SceneOpener opener() {
    return [](const std::string& text, const std::string&) {
        auto document = load(text, "recording");
        return open_scene(document, {}, models_beside(std::filesystem::path(test::scenes_dir()) / "any.json"));
    };
}

RecordingSink sink_to(Bytes& bytes) {
    return [&bytes](std::span<const std::byte> more) {
        bytes.insert(bytes.end(), more.begin(), more.end());
        return canvas::Failure();
    };
}

/// A recorded timeline.
struct Recorded {
    Bytes bytes;
    Timeline timeline;
    explicit Recorded(const std::string& scene, const char* mode = "physical")
        : timeline(std::move(*open(scene, mode))) {
        timeline.record(std::make_shared<Recorder>(sink_to(bytes), timeline.session(), ""));
    }
    void step(int count) {
        while (count-- > 0) timeline.step();
    }
};

/// Drags a ragdoll about, cuts, undoes, restarts, and goes back.
void play_around(Recorded& recorded, int rounds) {
    auto& timeline = recorded.timeline;
    recorded.step(10);
    for (int round = 0; round < rounds; ++round) {
        timeline.act(Grab{{Row(3 + round)}, {{300, 200, 0}}});
        for (int i = 0; i < 8; ++i) {
            timeline.act(play::Drag{{{300.0 + 7 * i, 200.0 - 3.1 * i, 0}}});
            timeline.step();
        }
        timeline.act(LetGo{});
        timeline.edit(Slash{{{{{0, 100, 0}}, {{640, 300, 0}}}},
                            {timeline.session().scene().view, timeline.session().focus(), 640, 480}},
                      "cut");
        recorded.step(5);
        if (round % 2 == 0) timeline.undo();
        recorded.step(5);
        timeline.go_to(timeline.now() - 7);
        timeline.act(Tweak{.particle = 2, .position = {}, .velocity = Point{{3, 4, 0}}, .mass = {}});
        recorded.step(4);
    }
    timeline.act(Restart{});
    recorded.step(6);
}

std::optional<Recording> read(const Bytes& bytes, SnapshotError& error) {
    return read_recording(bytes, opener(), error);
}

struct Outcome {
    std::uint64_t steps = 0, hash = 0;
    std::optional<Divergence> divergence;
};
Outcome replay(Recording recording) {
    SnapshotError error;
    auto replay = Replay::begin(std::move(recording), opener(), error);
    EXPECT_TRUE(replay) << error.text();
    if (!replay) return {};
    while (replay->step()) {
    }
    return {replay->steps(), replay->session().report().hash, replay->divergence()};
}

TEST(Recording, IsReplayedToTheSameBits) {
    for (const auto* mode : {"physical", "classic"}) {
        Recorded recorded("ragdoll", mode);
        play_around(recorded, few_or_many(2, 6));
        SnapshotError error;
        auto recording = read(recorded.bytes, error);
        ASSERT_TRUE(recording) << error.text();
        EXPECT_FALSE(recording->cut_short);
        EXPECT_EQ(recording->steps, recorded.timeline.now());
        const auto outcome = replay(std::move(*recording));
        EXPECT_FALSE(outcome.divergence) << "step " << outcome.divergence->step;
        EXPECT_EQ(outcome.steps, recorded.timeline.now());
        EXPECT_EQ(outcome.hash, recorded.timeline.session().report().hash);
    }
}

// A key that is held while an edit is undone is held afterwards, in a replay as well.
TEST(Recording, OfAKeyHeldThroughAnUndoIsReplayed) {
    for (const auto* scene : {"platformer", "rally"}) {
        Recorded recorded(scene);
        recorded.step(10);
        recorded.timeline.act(play::Steer{{.along = 1}});
        recorded.step(10);
        recorded.timeline.edit(Tweak{.particle = 0, .position = {}, .velocity = Point{{1, 2, 0}}, .mass = {}}, "throw");
        recorded.step(5);
        recorded.timeline.undo();
        recorded.step(20);
        SnapshotError error;
        auto recording = read(recorded.bytes, error);
        ASSERT_TRUE(recording) << error.text();
        const auto outcome = replay(std::move(*recording));
        EXPECT_FALSE(outcome.divergence) << scene << ", step " << outcome.divergence->step;
        EXPECT_EQ(outcome.hash, recorded.timeline.session().report().hash);
    }
}

// Whatever ends the program: all up to the last complete step.
TEST(Recording, ThatEndsAnywhereIsReadUpToThere) {
    Recorded recorded("ragdoll");
    play_around(recorded, 1);
    std::uint64_t most = 0;
    for (std::size_t size = 0; size <= recorded.bytes.size(); size += few_or_many(37, 1)) {
        const Bytes part(recorded.bytes.begin(), recorded.bytes.begin() + std::ptrdiff_t(size));
        SnapshotError error;
        auto recording = read(part, error);
        if (!recording) {
            EXPECT_EQ(most, 0U) << error.text() << ", " << size << " bytes";
            continue;
        }
        most = std::max(most, recording->steps);
        if (size % 5 != 0) continue;
        EXPECT_FALSE(replay(std::move(*recording)).divergence) << size << " bytes";
    }
    EXPECT_GT(most, 10U);
}

TEST(Recording, WithAFlippedBitIsRefused) {
    Recorded recorded("ragdoll");
    play_around(recorded, 1);
    std::size_t cut_short = 0, tried = 0;
    for (std::size_t at = 0; at < recorded.bytes.size(); at += few_or_many(41, 3)) {
        auto damaged = recorded.bytes;
        damaged[at] ^= std::byte(1U << (at % 8));
        SnapshotError error;
        ++tried;
        const auto recording = read(damaged, error);
        if (recording && recording->cut_short) ++cut_short; // the type or the length of the last entry
        EXPECT_TRUE(!recording || recording->cut_short) << "byte " << at;
        if (recording) continue;
        EXPECT_LE(error.at, at) << error.text();
    }
    EXPECT_LE(cut_short, 1U) << "of " << tried;
}

TEST(Recording, OfOthersIsRefusedByName) {
    SnapshotError error;
    EXPECT_FALSE(read({}, error));
    EXPECT_EQ(error.text(), "byte 0: not a recording of Sinew");
    Recorded recorded("ragdoll");
    recorded.bytes[8] = std::byte{7};
    EXPECT_FALSE(read(recorded.bytes, error));
    EXPECT_EQ(error.text(), "byte 8: version 7 of the format; this program reads version 1");
}

// A push that no recording knows of is found at its step, and the particle with it.
TEST(Recording, TellsWhereAReplayParts) {
    auto session = open("ragdoll", "physical");
    ASSERT_TRUE(session);
    Bytes bytes;
    Recorder recorder(sink_to(bytes), *session, "");
    for (int i = 0; i < 200; ++i) {
        if (i == 90)
            std::visit(
                []<int D, class Real>(World<D, Real>& world) {
                    apply_impulse(world, world.particles.handles.id_of(0), Vec<D, Real>::axis(0));
                },
                session->world());
        session->step();
        recorder.step(*session);
    }
    SnapshotError error;
    auto recording = read(bytes, error);
    ASSERT_TRUE(recording) << error.text();
    const auto outcome = replay(std::move(*recording));
    ASSERT_TRUE(outcome.divergence);
    EXPECT_EQ(outcome.divergence->step, 91U);
    ASSERT_TRUE(outcome.divergence->place);
    EXPECT_GE(outcome.divergence->place->step, 91U);
    EXPECT_LE(outcome.divergence->place->step, 91U + 61);
    EXPECT_FALSE(outcome.divergence->place->name.empty());
    EXPECT_NE(outcome.divergence->place->recorded, outcome.divergence->place->found);
}

TEST(Recording, OfAMinuteIsSmall) {
    Recorded recorded("ragdoll");
    const int steps = int(60 * recorded.timeline.session().scene().solver.rate);
    for (int i = 0; i < steps; ++i) {
        if (i % 180 == 0) recorded.timeline.act(Grab{{3}, {{300, 200, 0}}});
        if (i % 180 < 90) recorded.timeline.act(play::Drag{{{300 + 0.37 * (i % 90), 200 + 0.1 * (i % 13), 0}}});
        if (i % 180 == 90) recorded.timeline.act(LetGo{});
        recorded.timeline.step();
    }
    EXPECT_LT(recorded.bytes.size(), 100'000U) << "half of the time is spent dragging";
}

// A recording of a run that began in the midst of its scene begins with the run.
TEST(Recording, MayBeginAnywhere) {
    auto session = open("ragdoll", "physical");
    ASSERT_TRUE(session);
    for (int i = 0; i < 40; ++i) session->step();
    Bytes bytes;
    Recorder recorder(sink_to(bytes), *session, "");
    for (int i = 0; i < 30; ++i) session->step(), recorder.step(*session);
    SnapshotError error;
    auto recording = read(bytes, error);
    ASSERT_TRUE(recording) << error.text();
    const auto outcome = replay(std::move(*recording));
    EXPECT_FALSE(outcome.divergence);
    EXPECT_EQ(outcome.hash, session->report().hash);
}

// Watched and taken over: the rest of what was recorded no longer counts.
TEST(Recording, IsWatchedAndTakenOver) {
    Recorded recorded("ragdoll");
    play_around(recorded, 1);
    SnapshotError error;
    auto recording = read(recorded.bytes, error);
    ASSERT_TRUE(recording) << error.text();
    auto actions = actions_of(*recording, opener());
    const auto steps = recording->steps;
    auto begun = Replay::begin(std::move(*recording), opener(), error);
    ASSERT_TRUE(begun);
    Timeline watched(std::move(begun->session()), std::move(actions), steps);
    EXPECT_EQ(watched.end(), steps);
    while (watched.now() < steps) watched.step();
    EXPECT_EQ(watched.session().report().hash, recorded.timeline.session().report().hash);
    watched.go_to(5);
    watched.act(Tweak{.particle = 1, .position = {}, .velocity = Point{{9, 0, 0}}, .mass = {}});
    EXPECT_EQ(watched.end(), 5U);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE
