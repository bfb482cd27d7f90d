#include "sinew/session/event_json.h"

namespace sinew {

json::Object event_details(const SessionEvent& event) {
    json::Object details{{"seconds", event.seconds}, {"where", event.where}};
    if (event.islands > 0) details.push_back({"islands", event.islands});
    if (!event.with.empty()) details.push_back({"with", event.with});
    if (event.impulse > 0) details.push_back({"impulse", event.impulse});
    return details;
}

} // namespace sinew
