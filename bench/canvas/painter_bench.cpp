#include "canvas/raster.h"
#include "tests/canvas/tumbling_figure.h"

#include <benchmark/benchmark.h>

namespace sinew {
namespace {

/// A figure of some 60 items, frame after frame, as for a film.
void paint_figure(benchmark::State& state) {
    const int width = int(state.range(0)), height = int(state.range(1));
    canvas::Raster raster(width, height);
    TumblingFigure figure;
    float seconds = 0;
    for (auto _ : state) {
        if (raster.paint(figure.at(seconds, width, height))) state.SkipWithError("painting failed");
        benchmark::DoNotOptimize(raster.bytes().data());
        seconds += 1.f / 60;
    }
}
BENCHMARK(paint_figure)->Args({640, 480})->Args({1280, 720})->Args({1920, 1080})->Unit(benchmark::kMillisecond);

} // namespace
} // namespace sinew
