// SPDX-License-Identifier: Apache-2.0
// filament-bake MODEL [options]: what a path tracer finds in a scene that does not move, as textures for the engine, or
// as irradiance grids.
// Exit status 0: baked and written. 130: stopped by Ctrl-C; the same command continues.
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/image/ImageWriter.h"
#include "toolkit/program/Program.h"
#include "tools/bake/BakeScene.h"
#include "tools/bake/GridProgram.h"
#include "tools/bake/GridTrace.h"
#include "tools/bake/Journal.h"
#include "tools/bake/OcclusionImage.h"
#include "tools/bake/Report.h"
#include "tools/bake/VertexFit.h"
#include "tools/bake/page/BakePage.h"
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

/// The held-out points with the numbers [first, last) of what is traced; the numbers of texels come before theirs.
std::vector<AtlasTexel> heldOutTexels(BakeScene const& bake, size_t first, size_t last) {
    std::vector<AtlasTexel> points;
    for (size_t i = first; i < last; ++i) points.push_back(bake.heldOut[i - bake.texels.size()].texel);
    return points;
}

/// Appends to a journal, with a line of progress.
class Recorder {
public:
    Recorder(Journal& journal, uint64_t total)
            : mJournal(journal), mTotal(total), mBefore(journal.count()), mBegin(std::chrono::steady_clock::now()) {}
    ~Recorder() { tools::clearProgress(); }
    Recorder(Recorder const&) = delete;
    Recorder& operator=(Recorder const&) = delete;

    /// False: stop.
    bool operator()(std::span<const std::byte> records) {
        mWritten = mJournal.append(records);
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - mBegin).count();
        tools::showProgress(progressLine(mJournal.count(), mTotal, mBefore, seconds));
        return goesOn();
    }
    bool goesOn() const { return mWritten.ok() && !tools::isInterrupted(); }
    Result<void> const& written() const { return mWritten; }

private:
    Journal& mJournal;
    uint64_t mTotal, mBefore;
    std::chrono::steady_clock::time_point mBegin;
    Result<void> mWritten;
};

/// Bakes a range of the texels and held-out points into its journal, which is complete then, or was interrupted.
Result<Journal> bakeRange(Options const& options, BakeScene const& bake, RecordRange range, jobs::JobSystem& jobs) {
    Result<Journal> journal = Journal::open(options.out / kJournalName, { bake.hash, range, sizeof(TexelLight) });
    if (!journal) return journal.error();
    Recorder recorder(*journal, range.count);
    const auto finished = [&](size_t, std::span<const TexelLight> lights) { return recorder(std::as_bytes(lights)); };
    const size_t first = range.first + journal->count(), last = range.first + range.count, texels = bake.texels.size();
    if (first < texels && first < last)
        bakeTexels(*bake.scene, bake.model.surfaces, bake.atlas,
                   std::span(bake.texels).subspan(first, std::min(last, texels) - first), options.light, jobs,
                   finished);
    const size_t from = range.first + journal->count();
    if (recorder.goesOn() && from < last)
        bakeTexels(*bake.scene, bake.model.surfaces, bake.atlas, heldOutTexels(bake, from, last),
                   heldOutSettings(options.light), jobs, finished);
    if (!recorder.written()) return recorder.written().error();
    return journal;
}

int interrupted(Options const& options) {
    tools::printWarning(
            fmt::format("interrupted; the same command continues from {}", (options.out / kJournalName).string()));
    return tools::kInterruptedStatus;
}

int finishedPart(Options const& options, RecordRange range, size_t all) {
    std::printf("%s: points %llu to %llu of %zu\n", (options.out / kJournalName).c_str(),
                static_cast<unsigned long long>(range.first),
                static_cast<unsigned long long>(range.first + range.count), all);
    return 0;
}

/// The model whose lightmap shows its charts, at about the brightness of the light; of occlusion, that below an even
/// environment.
Result<void> writeCharts(Options const& options, BakeScene const& bake, std::span<const TexelLight> lights,
                         jobs::JobSystem& jobs) {
    double lux = 0;
    for (TexelLight const& light : lights) lux += luminanceOf(light.irradiance) / double(lights.size());
    if (options.light.occlusionMeters) lux *= double(options.iblIntensity.value);
    const LightmapImage image = makeChartImage(bake.atlas, lux > 0 ? lux : 1);
    StoredLightmap stored = storeLightmap(image, {}, {}, { .hasOpenness = false }, jobs);
    const LightmapEntry entry{ std::move(stored.pages), {}, image.intensity, options.light.directLight };
    const Result<std::vector<std::byte>> file = writeBakedModel(bake.model, bake.atlas, entry);
    return file ? assets::replaceFile(options.out / "charts.glb", *file) : file.error();
}

/// The model with the lightmap, or with ambient occlusion, and the image that reports judge.
struct BakedModel {
    std::vector<std::byte> file;
    LightmapImage image;
    StoredLightmap stored; ///< of occlusion `read` alone
};

Result<BakedModel> bakedModel(BakeScene const& bake, Atlas const& atlas, OcclusionEntry const& entry,
                              LightmapImage visible) {
    Result<std::vector<std::byte>> file = writeBakedModel(bake.model, atlas, entry);
    if (!file) return file.error();
    StoredLightmap stored{ .read = halvesOf(visible) };
    return BakedModel{ std::move(*file), std::move(visible), std::move(stored) };
}

Result<BakedModel> occludedVertices(Options const& options, BakeScene const& bake, std::span<const TexelLight> texels) {
    std::vector<BakeSurface> const& surfaces = bake.model.surfaces;
    const std::vector<std::byte> ramp = rampTexels();
    const std::filesystem::path path = options.out / "ramp.png";
    const auto width = static_cast<uint32_t>(ramp.size() / 4);
    if (auto done = assets::writePng(path, width, 1, ramp); !done) return done.error();
    Result<std::vector<std::byte>> png = assets::readFileBytes(path);
    if (!png) return png.error();
    OcclusionEntry entry{ .pages = { std::move(*png) }, .hasBentNormals = false };
    entry.vertices = fitVertices(surfaces, bake.atlas, bake.texels, texels);
    return bakedModel(bake, rampAtlas(entry.vertices, surfaces), entry,
                      visibleOf(entry.vertices, surfaces, bake.atlas, bake.texels, texels));
}

Result<BakedModel> occludedTexels(Options const& options, BakeScene const& bake, std::span<const TexelLight> texels) {
    OcclusionImage occlusion = makeOcclusionImage(bake.model.surfaces, bake.atlas, bake.texels, texels);
    // They stay in the folder for people to see.
    if (auto done = writePictures(options, "occlusion", occlusion.visible, occlusion.rgba8); !done) return done.error();
    OcclusionEntry entry;
    for (uint32_t page = 0; page < bake.atlas.pages; ++page) {
        Result<std::vector<std::byte>> png = assets::readFileBytes(options.out / pictureName("occlusion", page));
        if (!png) return png.error();
        entry.pages.push_back(std::move(*png));
    }
    return bakedModel(bake, bake.atlas, entry, std::move(occlusion.visible));
}

Result<BakedModel> litTexels(Options const& options, BakeScene const& bake, std::span<const TexelLight> texels,
                             jobs::JobSystem& jobs) {
    LightmapImage image = makeImage(bake.atlas, bake.texels, texels);
    StoredLightmap stored = storeLightmap(image, bake.texels, texels, options.storage, jobs);
    const LightmapEntry entry{ std::move(stored.pages), std::move(stored.openness), image.intensity,
                               options.light.directLight };
    Result<std::vector<std::byte>> file = writeBakedModel(bake.model, bake.atlas, entry);
    if (!file) return file.error();
    return BakedModel{ std::move(*file), std::move(image), std::move(stored) };
}

void warn(Options const& options, BakeScene const& bake, std::span<const TexelLight> texels) {
    for (std::string const& warning : bake.warnings) tools::printWarning(warning);
    const bool isDark =
            std::ranges::all_of(texels, [](TexelLight const& texel) { return texel.irradiance == double3(0); });
    if (texels.empty())
        tools::printWarning(
                "no triangle has an area in the lightmap; give a larger --density, or a model with surfaces");
    else if (isDark && !options.light.occlusionMeters)
        tools::printWarning("no light reaches a surface; give --environment or --sun, or a model with lights");
    const bool hasOcclusion = std::ranges::any_of(bake.model.document->materials, [](assets::GltfMaterial const& one) {
        return one.occlusion.texture != assets::kNone;
    });
    if (hasOcclusion && options.light.occlusionMeters)
        tools::printWarning("baked surfaces lose the occlusion textures that the model has");
}

int writeBake(Options const& options, BakeScene const& bake, std::span<const TexelLight> lights,
              jobs::JobSystem& jobs) {
    const auto texels = lights.first(bake.texels.size());
    const Result<BakedModel> baked = options.occlusionOfVertices     ? occludedVertices(options, bake, texels)
                                     : options.light.occlusionMeters ? occludedTexels(options, bake, texels)
                                                                     : litTexels(options, bake, texels, jobs);
    if (!baked) return failed(baked.error());
    const auto& [file, image, stored] = *baked;
    const std::filesystem::path path = options.out / "baked.glb";
    if (auto done = assets::replaceFile(path, file); !done) return failed(done.error());
    if (options.showsCharts) {
        if (auto done = writeCharts(options, bake, texels, jobs); !done) return failed(done.error());
    }
    if (auto done = writeReport(options, bake, lights, image, stored); !done) return failed(done.error());
    if (!options.report.file.empty()) {
        if (auto done = writeLightmapPage(options, bake, lights, image, stored, path, jobs); !done)
            return failed(done.error());
    }
    warn(options, bake, texels);
    const std::string pages = image.pages == 1 ? std::string() : fmt::format(" on {} pages", image.pages);
    std::printf("%s: %zu texels of %zu charts in %u x %u%s\n", path.c_str(), bake.texels.size(),
                bake.atlas.charts.size(), image.side, image.side, pages.c_str());
    return 0;
}

int bakeLightmap(Options const& options, jobs::JobSystem& jobs) {
    tools::showProgress("cutting surfaces into charts");
    const Result<BakeScene> bake = prepareBake(options, jobs);
    tools::clearProgress();
    if (!bake) return failed(bake.error());
    const size_t all = bake->traced();
    if (!options.merge.empty()) {
        const auto records = mergeJournals(options.merge, { bake->hash, { 0, all }, sizeof(TexelLight) });
        return records ? writeBake(options, *bake, valuesOf<TexelLight>(*records), jobs) : failed(records.error());
    }
    const tools::StopOnInterrupt scope;
    const tools::Shard shard = options.shard.value_or(tools::Shard{});
    const RecordRange range = rangeOfPart(all, shard.index, shard.count);
    const Result<Journal> journal = bakeRange(options, *bake, range, jobs);
    if (!journal) return failed(journal.error());
    if (!journal->isComplete()) return interrupted(options);
    if (options.shard) return finishedPart(options, range, all);
    const int status = writeBake(options, *bake, valuesOf<TexelLight>(journal->records()), jobs);
    std::error_code ignored;
    if (status == 0) std::filesystem::remove(options.out / kJournalName, ignored);
    return status;
}

Result<void> writeGridAndPage(Options const& options, GridInput const& input, BakedGrid const& baked,
                              jobs::JobSystem& jobs) {
    if (Result<void> written = writeGrid(baked, options.out); !written || options.report.file.empty()) return written;
    return writeGridPage(options, *input.scene, baked, jobs);
}

/// Of a grid: a part, or all up to the first grid within the bound, which is written.
int traceGrid(Options const& options, GridInput const& input, jobs::JobSystem& jobs) {
    const GridTrace trace(*input.scene, input.settings);
    const tools::Shard shard = options.shard.value_or(tools::Shard{});
    const RecordRange range = rangeOfPart(trace.size(), shard.index, shard.count);
    Result<Journal> journal = Journal::open(options.out / kJournalName, { input.hash, range, trace.recordBytes() });
    if (!journal) return failed(journal.error());
    std::optional<BakedGrid> baked;
    {
        Recorder recorder(*journal, range.count);
        const auto goOn = [&](size_t last) {
            trace.trace(range.first + journal->count(), last, jobs,
                        [&](std::span<const std::byte> records) { return recorder(records); });
        };
        if (options.shard) goOn(range.first + range.count);
        for (size_t grid = 0; !options.shard && !baked && recorder.goesOn(); ++grid) {
            goOn(trace.endOfGrid(grid));
            if (recorder.goesOn()) baked = gridOfRecords(*input.scene, input.settings, journal->records());
        }
        if (!recorder.written()) return failed(recorder.written().error());
    }
    if (options.shard) return journal->isComplete() ? finishedPart(options, range, trace.size()) : interrupted(options);
    if (!baked) return interrupted(options);
    const Result<void> written = writeGridAndPage(options, input, *baked, jobs);
    if (!written) return failed(written.error());
    std::error_code ignored;
    std::filesystem::remove(options.out / kJournalName, ignored);
    return 0;
}

int bakeGrid(Options const& options, jobs::JobSystem& jobs) {
    std::vector<std::string> warnings;
    const Result<GridInput> input = readGridInput(options, jobs, warnings);
    if (!input) return failed(input.error());
    for (std::string const& warning : warnings) tools::printWarning(warning);
    if (options.merge.empty()) {
        const tools::StopOnInterrupt scope;
        return traceGrid(options, *input, jobs);
    }
    const GridTrace trace(*input->scene, input->settings);
    const auto records = mergeJournals(options.merge, { input->hash, { 0, trace.size() }, trace.recordBytes() });
    if (!records) return failed(records.error());
    const std::optional<BakedGrid> baked = gridOfRecords(*input->scene, input->settings, *records);
    const Result<void> written = writeGridAndPage(options, *input, *baked, jobs);
    return written ? 0 : failed(written.error());
}

int run(Options const& options) {
    std::error_code error;
    std::filesystem::create_directories(options.out, error);
    if (error)
        return failed(fail(ErrorCode::Unreadable, "{}: {}; give another --out", options.out.string(), error.message()));
    jobs::JobSystem jobs({ .workers = options.workers });
    return options.grid.empty() ? bakeLightmap(options, jobs) : bakeGrid(options, jobs);
}

} // namespace
} // namespace filament_core::bake

int main(int argc, char** argv) {
    using namespace filament_core;
    return tools::runProgram("filament-bake", argc, argv, bake::parseOptions, bake::run,
                             "try a smaller model or --density");
}
