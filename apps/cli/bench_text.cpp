#include "apps/cli/bench_text.h"

#include "apps/cli/console.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <fstream>

namespace sinew::cli {

std::string stretch_text(double fraction) {
    return std::isfinite(fraction) ? fmt::format("{:.2g} %", 100 * fraction) : "lost";
}

std::string bench_table(const std::vector<std::vector<std::string>>& rows, const BenchOptions& options) {
    if (!options.as_markdown) return table(rows);
    std::string text;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        for (const auto& cell : rows[i]) text += "| " + cell + (cell.empty() ? "" : " ");
        text += "|\n";
        for (std::size_t k = 0; i == 0 && k < rows[i].size(); ++k) text += "|---";
        if (i == 0) text += "|\n";
    }
    return text;
}

void write_plot(const std::string& path, const bench::Plot& plot) {
    std::ofstream file(path, std::ios::binary);
    file << to_svg(plot);
    if (!file.flush()) refuse(path, std::strerror(errno));
}

} // namespace sinew::cli
