// SPDX-License-Identifier: Apache-2.0
// Decoding block-compressed textures of 1024 x 1024 texels, random blocks of every mode.
#include "filament_core/assets/blocks/BlockDecoder.h"

#include <benchmark/benchmark.h>

#include <random>
#include <vector>

namespace filament_core::assets {
namespace {

constexpr uint32_t kBenchSide = 1024;

void decodeBlocksOf(benchmark::State& state, BlockFormat format) {
    std::mt19937 random(1);
    std::vector<std::byte> blocks(bytesOfBlocks(format, kBenchSide, kBenchSide));
    for (std::byte& byte : blocks) byte = static_cast<std::byte>(random());
    std::vector<std::byte> pixels(size_t{ kBenchSide } * kBenchSide * (hasHalfTexels(format.kind) ? 8 : 4));
    for ([[maybe_unused]] auto _ : state) {
        decodeBlocks(format, false, blocks, kBenchSide, kBenchSide, pixels);
        benchmark::DoNotOptimize(pixels.data());
    }
    state.counters["Mtexel/s"] =
            benchmark::Counter(kBenchSide * kBenchSide / 1e6, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK_CAPTURE(decodeBlocksOf, bc1, BlockFormat{ BlockKind::Bc1Rgba });
BENCHMARK_CAPTURE(decodeBlocksOf, bc3, BlockFormat{ BlockKind::Bc3 });
BENCHMARK_CAPTURE(decodeBlocksOf, bc5, BlockFormat{ BlockKind::Bc5 });
BENCHMARK_CAPTURE(decodeBlocksOf, bc6, BlockFormat{ BlockKind::Bc6 });
BENCHMARK_CAPTURE(decodeBlocksOf, bc7, BlockFormat{ BlockKind::Bc7 });
BENCHMARK_CAPTURE(decodeBlocksOf, etc2, BlockFormat{ BlockKind::Etc2Rgba });
BENCHMARK_CAPTURE(decodeBlocksOf, eac, BlockFormat{ BlockKind::EacRg });
BENCHMARK_CAPTURE(decodeBlocksOf, uastc, BlockFormat{ BlockKind::Uastc });
BENCHMARK_CAPTURE(decodeBlocksOf, astc8x8, BlockFormat{ BlockKind::Astc, 8, 8 });

} // namespace
} // namespace filament_core::assets
