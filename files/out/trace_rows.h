#pragma once

#include "sinew/session/session.h"

#include <span>
#include <string>
#include <vector>

namespace sinew::files {

/// Rows of a trace: time, name, position and velocity of a particle, in the scene's units; numbers parse back to the
/// same. A table (CSV, RFC 4180) or JSON, an object a line.
class TraceRows {
  public:
    TraceRows(bool is_table, int dimension) : is_table_(is_table), dimension_(dimension) {}

    /// First line of a table; empty for JSON.
    std::string heading() const;
    /// A particle to trace from now on.
    void trace(const Session& session, ParticleId particle);
    /// All particles of the moment; cheap where there are as many as before.
    void trace_all(const Session& session);
    /// Appends a row for each traced particle that remains.
    void add(const Session& session, std::string& text) const;

  private:
    struct Traced {
        ParticleId particle;
        std::string name; ///< as a field of the format
    };

    bool is_table_;
    int dimension_;
    std::vector<Traced> traced_;

    void add_row(double time, const std::string& name, std::span<const double> position,
                 std::span<const double> velocity, std::string& text) const;
};

} // namespace sinew::files
