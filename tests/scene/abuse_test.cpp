#include "sinew/math/random.h"
#include "sinew/session/focus.h"

#include "tests/sanitized.h"
#include "tests/scene/scene_runs.h"
#include "tests/thorough.h"

/// A minute of grabs, throws and cuts by a pointer that knows nothing, in every scene.
namespace sinew::SINEW_TEST_FILE {
namespace {

/// The numbers a fool would choose.
class Whim {
  public:
    explicit Whim(std::uint64_t seed) : seed_(seed) {}
    double between(double low, double high) { return low + (high - low) * random::uniform(seed_, 0, drawn_++); }
    std::size_t below(std::size_t count) { return std::min(std::size_t(between(0, double(count))), count - 1); }

  private:
    std::uint64_t seed_, drawn_ = 0;
};

/// Takes hold of a particle, drags it about within the focus of the scene, lets it go or throws it, cuts across now and
/// then.
class Abuser {
  public:
    Abuser(Session& session, std::uint64_t seed)
        : session_(session), focus_(focus_of(session.scene(), session.world())), whim_(seed) {}

    void step() {
        if (session_.seconds() >= next_) act();
        carry();
        session_.step();
    }

    void let_go() {
        std::visit([&](auto& world) { unpin(world, held_); }, session_.world());
        held_ = {};
    }

  private:
    Session& session_;
    std::array<Point, 2> focus_;
    Whim whim_;
    double next_ = 0;
    PinId held_{};
    ParticleId grabbed_{};
    Point from_{}, to_{};
    double since_ = 0, over_ = 1;

    static Point between(const Point& a, const Point& b, double share) {
        Point place{};
        for (int i = 0; i < 3; ++i) place[i] = a[i] + (b[i] - a[i]) * share;
        return place;
    }

    Point anywhere() {
        Point place{};
        for (int i = 0; i < session_.scene().dimension; ++i) place[i] = whim_.between(focus_[0][i], focus_[1][i]);
        return place;
    }

    void act() {
        const double now = session_.seconds();
        next_ = now + whim_.between(0.05, 0.8);
        const double choice = whim_.between(0, 1);
        if (choice < 0.06) {
            const auto a = anywhere(), b = anywhere();
            session_.cut({a, between(a, b, 0.3)});
        } else if (choice < 0.5 && held_ != PinId{}) {
            throw_it();
        } else {
            grab();
        }
        since_ = now;
        over_ = whim_.between(0.05, 1);
        to_ = anywhere();
    }

    /// With a hand that lifts the figure it holds at a hundred times the acceleration of gravity, and no harder.
    void grab() {
        let_go();
        std::visit(
            [&]<class WorldT>(WorldT& world) {
                using Real = typename WorldT::Real;
                const auto& p = world.particles;
                const Row row = Row(whim_.below(p.size()));
                if (p.mobility[row] == 0) return;
                double mass = 0;
                for (Row i = 0; i < p.size(); ++i)
                    if (p.figure[i] == p.figure[row]) mass += inverse_or_zero(double(p.inverse_mass[i]));
                const auto units = session_.scene().measures();
                const double strongest = 1000 * units.per_metre / (units.per_second * units.per_second);
                grabbed_ = p.handles.id_of(row);
                for (int i = 0; i < WorldT::dimension; ++i) from_[i] = double(p.position[row][i]);
                held_ = *pin(world, grabbed_, PinSpec<WorldT::dimension, Real>{.max_force = Real(mass * strongest)});
            },
            session_.world());
    }

    void throw_it() {
        let_go();
        std::visit(
            [&]<class WorldT>(WorldT& world) {
                using Real = typename WorldT::Real;
                const auto units = session_.scene().measures();
                Point by{};
                for (int i = 0; i < WorldT::dimension; ++i)
                    by[i] = whim_.between(-20, 20) * units.per_metre / units.per_second;
                if (const auto now = velocity_of(world, grabbed_))
                    set_velocity(world, grabbed_, *now + by.template as<WorldT::dimension, Real>());
            },
            session_.world());
    }

    void carry() {
        const double share = clamp((session_.seconds() - since_) / over_, 0.0, 1.0);
        const auto place = between(from_, to_, share);
        std::visit(
            [&]<class WorldT>(WorldT& world) {
                auto goal = place.template as<WorldT::dimension, typename WorldT::Real>();
                for (const auto& plane : world.bounds) // no hand reaches through a wall
                    if (const auto below = plane.offset - dot(plane.normal, goal); below > 0)
                        goal += plane.normal * below;
                move_pin(world, held_, goal);
            },
            session_.world());
    }
};

std::vector<SceneRun> doubles() {
    auto all = runs();
    std::erase_if(all, [](const SceneRun& run) { return run.precision != "double"; });
    return all;
}

class Abuse : public testing::TestWithParam<SceneRun> {};

/// How far outside its bounds something may be that has a smaller radius: a centimetre. Where an original sweeps after
/// its walls, a stick pushes a point out again until the next frame, by up to its length (measured: two thirds of it).
double farthest_outside(const Session& session) {
    double farthest = 0.01 * session.scene().measures().per_metre;
    const auto sticks_out = [&](const auto& world) {
        const auto& distances = std::get<0>(world.constraints);
        if (world.settings.mode != Mode::classic || world.settings.classic.order != PassOrder::sweeps_last) return;
        for (Row row = 0; row < distances.size(); ++row)
            if (distances.low(row) == distances.high(row)) farthest = std::max(farthest, double(distances.high(row)));
    };
    std::visit(sticks_out, session.world());
    return farthest;
}

/// The mean over a second from now on: some swing for long, and no moment tells.
double strain_of_a_second(Session& session) {
    double sum = 0;
    int steps = 0;
    for (const double end = session.seconds() + 1; session.seconds() < end; ++steps) {
        session.step();
        sum += rigid_strain(session.world());
    }
    return sum / steps;
}

void abuse(const std::string& name, const std::string& mode, const std::string& precision, std::uint64_t seed) {
    auto session = open(name, mode, precision);
    ASSERT_TRUE(session);
    Abuser abuser(*session, seed);
    const double size = farthest_outside(*session), abused = test::sanitized ? 0.3 : few_or_many(2, 60);
    double outside = 0;
    while (session->seconds() < abused) {
        abuser.step();
        ASSERT_TRUE(is_finite(session->world())) << "after " << session->seconds() << " seconds";
        outside = std::max(outside, distance_outside(session->world(), size));
    }
    EXPECT_LE(outside, 1);
    for (const auto& happening : session->happenings()) EXPECT_NE(happening.what, "quarantined");
    if (mode != "physical" || test::sanitized) return;
    abuser.let_go();
    double strain = 1;
    while (strain >= 0.01 && session->seconds() < abused + 4.5) strain = strain_of_a_second(*session);
    EXPECT_LT(strain, 0.01);
}

TEST_P(Abuse, LeavesItWhole) {
    const auto& [name, mode, precision] = GetParam();
    abuse(name, mode, precision, 7);
    if (is_thorough()) abuse(name, mode, "float", 16);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Abuse, testing::ValuesIn(doubles()), name_of_run);

} // namespace
} // namespace sinew::SINEW_TEST_FILE
