#include "canvas/writer.h"

#include "canvas/interrupt.h"

#include <utility>

namespace sinew::canvas {

Writer::Writer(std::filesystem::path target_, const FrameFormat& format_)
    : target(std::move(target_)), format(format_) {}

/// Passes a step's outcome on. A failure or an interruption is final.
Failure Writer::settle(const Failure& failure) {
    if (!failure && !interrupted()) return {};
    abandon();
    partial.discard();
    return settled = interrupted() ? "interrupted; " + name() + " was not written"
                                   : "cannot write " + name() + ": " + reason_told(*failure, name());
}

Failure Writer::begin() {
    Failure failure = partial.create(target);
    if (!failure) failure = start();
    return settle(failure);
}

Failure Writer::frame(const Picture& picture) {
    if (settled) return settled;
    Failure failure = interrupted() ? Failure() : add(picture);
    ++frames;
    return settle(failure);
}

Failure Writer::finish() {
    if (settled) return settled;
    if (frames == 0) return settle("no picture was given");
    if (auto failure = settle(complete())) return failure;
    if (auto failure = settle(partial.commit())) return failure;
    abandon(); // nothing more is to be written
    settled = name() + " is already complete";
    return {};
}

Opened begun(std::unique_ptr<Writer> writer) {
    if (auto failure = writer->begin()) return {nullptr, failure};
    return {std::move(writer), {}};
}

} // namespace sinew::canvas
