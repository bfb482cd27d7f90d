#pragma once

#include "bench/cases.h"
#include "bench/contact.h"

#include <optional>
#include <string>
#include <vector>

namespace sinew::cli {

/// Options of `sinew bench`.
struct BenchOptions {
    std::optional<double> threads, steps; ///< for cases and quality
    std::optional<double> links, weight;  ///< for rope
    std::optional<double> seconds;        ///< for rope and contact
    std::optional<double> substeps;       ///< for contact; empty: the engine's choice
    std::string only, start;              ///< for rope
    std::string precision;                ///< float or double; empty: the default
    std::string plot;                     ///< for quality and weights: path of an SVG file
    bool as_json = false, as_markdown = false;
};

/// Measurements of `sinew bench`; each prints a table, or lines of JSON.
void bench_ropes(const BenchOptions& options);
void bench_cases(const BenchOptions& options, const std::vector<bench::Case>& cases);

void bench_quality(const BenchOptions& options, const bench::Case& chosen);
void bench_weights(const BenchOptions& options);
void bench_contacts(const BenchOptions& options, const std::vector<bench::ContactCase>& cases);
void bench_budget(const BenchOptions& options);

/// Help texts of the measurements.
std::string rope_details();
std::string case_details();
std::string quality_details();
std::string weights_details();
std::string contact_details();
std::string budget_details();

} // namespace sinew::cli
