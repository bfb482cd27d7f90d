#pragma once

#include "sinew/session/session.h"

#include <string>
#include <vector>

/// Reports of run and info about a scene, for people and as JSON.
namespace sinew::cli {

/// "2D, px kg frame; classic, double, 60 steps a second, 6 passes"
std::string scene_text(const Scene& scene);

/// Names and values.
std::vector<std::vector<std::string>> report_rows(const Report& report, const Scene& scene);

/// Members scene, mode, precision, dimension, units.
json::Object scene_json(const std::string& name, const Scene& scene);
/// All members of a report.
json::Object report_json(const Report& report);

/// "1.25 px/frame"
std::string quantity(double value, Unit unit, const Scene& scene);
/// "0.12 %"
std::string percent(double fraction);

} // namespace sinew::cli
