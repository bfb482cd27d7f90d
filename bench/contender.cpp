#include "bench/contender.h"

#include "bench/textbook.h"

namespace sinew::bench {

std::vector<Contender> rivals(const Work& work) {
    const auto textbook = [&work](Textbook::Order order) {
        return [&work, order](const Effort& effort) { return std::make_unique<Textbook>(work, effort, order); };
    };
    std::vector<Contender> all{{"textbook", textbook(Textbook::Order::listed)},
                               {"textbook, shuffled", textbook(Textbook::Order::shuffled)}};
    for (const auto& peer : peers())
        if (peer.takes(work))
            all.push_back({std::string(peer.name), [&](const Effort& effort) { return peer.make(work, effort); }});
    return all;
}

} // namespace sinew::bench
