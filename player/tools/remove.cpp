#include "player/tool.h"

namespace sinew::play {
namespace {

class RemoveTool final : public Tool {
    std::string_view name() const override { return "remove"; }
    std::string_view key() const override { return "delete"; }
    std::string_view about() const override { return "deletes the figure or obstacle under the pointer"; }

    void press(Play& play) override {
        if (const auto part = play.part_here()) play.remove({*part});
    }
};

} // namespace

std::unique_ptr<Tool> tool::remove() {
    return std::make_unique<RemoveTool>();
}

} // namespace sinew::play
