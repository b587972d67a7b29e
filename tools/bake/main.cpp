// SPDX-License-Identifier: Apache-2.0
// filament-bake MODEL [options]: what a path tracer finds in a scene that does not move, as textures for the engine, or
// as irradiance grids.
// Exit status 0: baked and written. 130: stopped by Ctrl-C; the same command continues.
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/image/Ktx2Encoder.h"
#include "toolkit/program/Program.h"
#include "tools/bake/BakeScene.h"
#include "tools/bake/GridProgram.h"
#include "tools/bake/Journal.h"
#include "tools/bake/Report.h"
#include "tools/reference/TracedScene.h"

#include <algorithm>
#include <chrono>

namespace filament_core::bake {
namespace {

using tools::failed;

std::string progressLine(uint64_t done, uint64_t total, uint64_t before, double seconds) {
    const double left = done > before ? seconds * double(total - done) / double(done - before) : 0;
    return fmt::format("{:3.0f} %  {}/{} points  {:.0f} s left", 100.0 * double(done) / double(total), done, total,
                       left);
}

/// Of those that are traced, from `first` to `last`, which are all beyond the texels.
std::vector<AtlasTexel> heldOutTexels(BakeScene const& bake, size_t first, size_t last) {
    std::vector<AtlasTexel> points;
    for (size_t i = first; i < last; ++i) points.push_back(bake.heldOut[i - bake.texels.size()].texel);
    return points;
}

/// Bakes a range of the texels and held-out points into its journal. Empty: interrupted.
Result<std::optional<Journal>> bakeRange(Options const& options, BakeScene const& bake, TexelRange range,
                                         jobs::JobSystem& jobs) {
    Result<Journal> journal = Journal::open(options.out / kJournalName, { bake.hash, range });
    if (!journal) return journal.error();
    const uint64_t before = journal->lights().size();
    const auto begin = std::chrono::steady_clock::now();
    Result<void> written;
    const auto finished = [&](size_t, std::span<const TexelLight> lights) {
        written = journal->append(lights);
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        tools::showProgress(progressLine(journal->lights().size(), range.count, before, seconds));
        return written.ok() && !tools::isInterrupted();
    };
    const size_t first = range.first + before, last = range.first + range.count, texels = bake.texels.size();
    if (first < texels)
        bakeTexels(*bake.scene, bake.model.surfaces, bake.atlas,
                   std::span(bake.texels).subspan(first, std::min(last, texels) - first), options.light, jobs,
                   finished);
    const size_t from = range.first + journal->lights().size();
    if (written && !tools::isInterrupted() && from < last)
        bakeTexels(*bake.scene, bake.model.surfaces, bake.atlas, heldOutTexels(bake, from, last),
                   heldOutSettings(options.light), jobs, finished);
    tools::clearProgress();
    if (!written) return written.error();
    if (!journal->isComplete()) return std::optional<Journal>{};
    return std::optional(std::move(*journal));
}

int writeLightmap(Options const& options, BakeScene const& bake, std::span<const TexelLight> lights) {
    const auto texels = lights.first(bake.texels.size());
    const LightmapImage image = makeImage(bake.atlas, bake.texels, texels);
    const LightmapEntry entry{ assets::encodeKtx2(halvesOf(image)), image.intensity, options.light.directLight };
    const Result<std::vector<std::byte>> file = writeBakedModel(bake.model, bake.atlas, entry);
    if (!file) return failed(file.error());
    const std::filesystem::path path = options.out / "baked.glb";
    if (auto done = assets::replaceFile(path, *file); !done) return failed(done.error());
    if (auto done = writeReport(options, bake, lights, image); !done) return failed(done.error());
    for (std::string const& warning : bake.warnings) tools::printWarning(warning);
    const bool isDark =
            std::ranges::all_of(texels, [](TexelLight const& texel) { return texel.irradiance == double3(0); });
    if (isDark) tools::printWarning("no light reaches a surface; give --environment or --sun, or a model with lights");
    std::printf("%s: %zu texels of %zu charts in %u x %u\n", path.c_str(), bake.texels.size(), bake.atlas.charts.size(),
                image.side, image.side);
    return 0;
}

int writeGrid(Options const& options, jobs::JobSystem& jobs) {
    std::vector<std::string> warnings;
    const Result<reference::TracedScenePtr> scene = traceScene(options, jobs, warnings);
    if (!scene) return failed(scene.error());
    for (std::string const& warning : warnings) tools::printWarning(warning);
    tools::showProgress("baking probes until held-out points agree");
    const auto written = runGrid(**scene, options.grid, double(options.light.exposure.factor()), options.out, jobs);
    return written ? 0 : failed(written.error());
}

int run(Options const& options) {
    std::error_code error;
    std::filesystem::create_directories(options.out, error);
    if (error)
        return failed(fail(ErrorCode::Unreadable, "{}: {}; give another --out", options.out.string(), error.message()));
    jobs::JobSystem jobs({ .workers = options.workers });
    if (!options.grid.empty()) return writeGrid(options, jobs);
    tools::showProgress("cutting surfaces into charts");
    const Result<BakeScene> bake = prepareBake(options, jobs);
    tools::clearProgress();
    if (!bake) return failed(bake.error());
    if (!options.merge.empty()) {
        const Result<std::vector<TexelLight>> lights = mergeJournals(options.merge, bake->hash, bake->traced());
        return lights ? writeLightmap(options, *bake, *lights) : failed(lights.error());
    }
    const tools::StopOnInterrupt scope;
    const tools::Shard shard = options.shard.value_or(tools::Shard{});
    const TexelRange range = rangeOfPart(bake->traced(), shard.index, shard.count);
    const Result<std::optional<Journal>> journal = bakeRange(options, *bake, range, jobs);
    if (!journal) return failed(journal.error());
    const std::filesystem::path part = options.out / kJournalName;
    if (!*journal) {
        tools::printWarning(fmt::format("interrupted; the same command continues from {}", part.string()));
        return tools::kInterruptedStatus;
    }
    if (options.shard) {
        std::printf("%s: points %llu to %llu of %zu\n", part.c_str(), static_cast<unsigned long long>(range.first),
                    static_cast<unsigned long long>(range.first + range.count), bake->traced());
        return 0;
    }
    const int status = writeLightmap(options, *bake, (*journal)->lights());
    if (status == 0) std::filesystem::remove(part, error);
    return status;
}

} // namespace
} // namespace filament_core::bake

int main(int argc, char** argv) {
    using namespace filament_core;
    return tools::runProgram("filament-bake", argc, argv, bake::parseOptions, bake::run,
                             "try a smaller model or --density");
}
