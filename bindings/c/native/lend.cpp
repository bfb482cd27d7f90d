#include "bindings/c/native/lend.h"

#include "sinew/scene/text.h"

#include "bindings/c/native/sized.h"
#include "bindings/c/simulation.h"

#include <exception>
#include <utility>

/// Sessions lent to the code of a level for the length of a call.
namespace sinew::c {
namespace {

constexpr std::size_t max_memory = std::size_t(1) << 30; ///< bytes of a level

class SharedLevel final : public Level {
  public:
    SharedLevel(const sinew_level& level, std::string name) : level_(level), name_(std::move(name)) {
        handle_.id = simulations().add(std::make_unique<Simulation>());
    }
    SharedLevel(const SharedLevel&) = delete;
    SharedLevel& operator=(const SharedLevel&) = delete;
    ~SharedLevel() override { simulations().remove(handle_.id); }

    void build(Session& session) override {
        is_stopped_ = false;
        if (level_.build) call("build", session, [&] { return level_.build(handle_); });
    }

    void step(Session& session) override {
        lend(&session);
        if (!level_.step || is_stopped_) return;
        const auto& controls = session.steering().player();
        const auto pointer = session.pointer();
        const auto memory = session.level_memory();
        const auto at = pointer.value_or(Point{});
        const auto steps = std::visit([](const auto& world) { return world.steps; }, std::as_const(session).world());
        const sinew_moment moment{.struct_size = sizeof moment,
                                  .has_pointer = pointer ? 1u : 0u,
                                  .step = steps,
                                  .seconds = session.seconds(),
                                  .pointer = {at[0], at[1], at[2]},
                                  .along = controls.along,
                                  .up = controls.up,
                                  .jump = controls.jump ? 1u : 0u,
                                  .hold = controls.hold ? 1u : 0u,
                                  .memory = memory.data()};
        call("step", session, [&] { return level_.step(handle_, &moment); });
    }

    void stepped(Session&) override { lend(nullptr); }

    std::size_t memory() const override { return level_.memory; }

  private:
    sinew_level level_;
    std::string name_;
    sinew_world handle_{};
    bool is_stopped_ = false; ///< after a failure, until the world is built again

    /// While a step runs, too: it may ask the level about contacts.
    void lend(Session* session) {
        if (auto* simulation = simulations().find(handle_.id)) simulation->lent = session;
    }
    template <class Call> void call(std::string_view what, Session& session, const Call& function) {
        auto* simulation = simulations().find(handle_.id);
        if (!simulation) return stop("too many open simulations");
        auto* before = std::exchange(simulation->lent, &session);
        const auto why = reason_of(function);
        simulation->lent = before;
        if (!why.empty()) stop(concat(what, ": ", why));
    }
    /// Reason of a failure of a call; empty if there is none. Code in C++ may throw.
    template <class Call> static std::string reason_of(const Call& function) {
        try {
            const auto status = function();
            return status == SINEW_OK ? std::string() : reason(status);
        } catch (const std::exception& thrown) {
            return concat("it threw: ", thrown.what());
        } catch (...) {
            return "it threw something";
        }
    }
    static std::string reason(sinew_status status) {
        const std::string message = sinew_message();
        return message.empty() ? concat("it returned ", int(status)) : message;
    }
    void stop(std::string why) {
        problem = concat(name_, ": ", why);
        is_stopped_ = true;
    }
};

} // namespace

std::shared_ptr<Level> level_of(const sinew_level* given, const std::string& name, std::string& problem) {
    if (given && given->abi != SINEW_ABI) {
        problem = concat("it was compiled with another sinew.h, of ABI ", given->abi, "; this player has ABI ",
                         SINEW_ABI, ": compile it again");
        return nullptr;
    }
    sinew_level level;
    if (take(given, level) != SINEW_OK) {
        problem = sinew_message();
        return nullptr;
    }
    if (level.memory > max_memory) {
        problem = "its memory is above 1 GiB";
        return nullptr;
    }
    return std::make_shared<SharedLevel>(level, name);
}

} // namespace sinew::c
