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
    std::string plot;                             ///< of quality: an SVG file
    bool as_json = false;
};

/// What it can measure; each prints its own table, or its lines of JSON.
void bench_ropes(const BenchOptions& options);
void bench_cases(const BenchOptions& options, const std::vector<bench::Case>& cases);

/// What help says about them.
std::string rope_details();
std::string case_details();

} // namespace sinew::cli
