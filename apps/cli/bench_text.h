#pragma once

#include "apps/cli/bench_options.h"
#include "bench/plot.h"

#include <string>
#include <vector>

/// How measurements are told.
namespace sinew::cli {

/// "1.2 %", or "lost" for what is no number.
std::string stretch_text(double fraction);

/// The rows as a table of the terminal, or of Markdown; the first are the titles.
std::string bench_table(const std::vector<std::vector<std::string>>& rows, const BenchOptions& options);

/// Throws GiveUp where the file cannot be written.
void write_plot(const std::string& path, const bench::Plot& plot);

} // namespace sinew::cli
