#pragma once

#include "apps/cli/bench_options.h"
#include "bench/plot.h"

#include <string>
#include <vector>

/// Formatting of measurements.
namespace sinew::cli {

/// "1.2 %", or "lost" for infinities and NaN.
std::string stretch_text(double fraction);

/// The rows as a table for the terminal, or in Markdown; the first row holds the titles.
std::string bench_table(const std::vector<std::vector<std::string>>& rows, const BenchOptions& options);

/// Throws CommandError if the file cannot be written.
void write_plot(const std::string& path, const bench::Plot& plot);

} // namespace sinew::cli
