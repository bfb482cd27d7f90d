#include "sinew/scene/document.h"
#include "sinew/scene/reader.h"

#include "tests/scene/sample.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>

/// Any input is read as a scene or refused, with every diagnostic's span inside the source. Bytes after the first zero
/// byte are an override.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string text(reinterpret_cast<const char*>(data), size);
    std::vector<sinew::Override> overrides;
    if (const auto zero = text.find('\0'); zero != std::string::npos) {
        overrides.push_back({text.substr(zero + 1)});
        text.resize(zero);
    }
    auto document = sinew::load(std::move(text), "fuzz.json", overrides);
    sinew::sample::Scene scene;
    const bool good = sinew::read(document.root, scene, sinew::Reading{document.diagnostics});
    const auto& diagnostics = document.diagnostics;
    if (!good && diagnostics.ok()) std::abort();
    for (const auto& diagnostic : diagnostics.in_order()) {
        const auto end = diagnostic.span.end;
        if (diagnostic.span.begin > end || end > diagnostics.source(diagnostic.span.source).text.size()) std::abort();
    }
    if (to_text(diagnostics).empty() != diagnostics.ok()) std::abort();
    return 0;
}
