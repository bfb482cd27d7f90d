#pragma once

#include "bench/cases.h"

#include <optional>
#include <string>
#include <vector>

namespace sinew::cli {

/// What `sinew bench` was told.
struct BenchOptions {
    std::optional<double> threads, steps;         ///< of cases and quality
    std::optional<double> links, weight, seconds; ///< of rope
    std::string only, start;                      ///< of rope
    std::string precision;                        ///< float or double; empty: the usual one
    std::string plot;                             ///< of quality and weights: an SVG file
    bool as_json = false, as_markdown = false;
};

/// What it can measure; each prints its own table, or its lines of JSON.
void bench_ropes(const BenchOptions& options);
void bench_cases(const BenchOptions& options, const std::vector<bench::Case>& cases);

void bench_quality(const BenchOptions& options, const bench::Case& chosen);
void bench_weights(const BenchOptions& options);

/// What help says about them.
std::string rope_details();
std::string case_details();
std::string quality_details();
std::string weights_details();

} // namespace sinew::cli
