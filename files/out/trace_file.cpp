#include "sinew/math/format.h"

#include "files/out/export_formats.h"
#include "files/out/trace_rows.h"

#include <algorithm>
#include <optional>

/// Positions and velocities of all particles in each frame.
namespace sinew::files {
namespace {

class TraceExporter final : public Exporter {
  public:
    TraceExporter(const ExportRequest& request, bool is_table) : request_(request), is_table_(is_table) {}

    Failure frame(const Session& session) override {
        if (!rows_) begin(session);
        if (request_.figures.empty()) rows_->trace_all(session);
        rows_->add(session, text_);
        constexpr std::size_t most = std::size_t(1) << 30; // bytes
        if (text_.size() > most)
            return format_text("a trace has at most {} MB; `sinew run --trace` writes as it goes", most >> 20U);
        return {};
    }

    Failure finish() override {
        written_ = {request_.path};
        return request_.take(request_.path, text_);
    }

  private:
    const ExportRequest request_;
    const bool is_table_;
    std::optional<TraceRows> rows_;
    std::string text_;

    void begin(const Session& session) {
        rows_.emplace(is_table_, session.scene().dimension);
        text_ = rows_->heading();
        std::visit(
            [&](const auto& world) {
                for (const auto& figure : world.figures)
                    if (std::ranges::find(request_.figures, figure.name) != request_.figures.end())
                        for (const auto particle : figure.particles) rows_->trace(session, particle);
            },
            session.world());
    }
};

} // namespace

std::unique_ptr<Exporter> open_trace_table(const ExportRequest& request) {
    return std::make_unique<TraceExporter>(request, true);
}

std::unique_ptr<Exporter> open_trace_lines(const ExportRequest& request) {
    return std::make_unique<TraceExporter>(request, false);
}

} // namespace sinew::files
