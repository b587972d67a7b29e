// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/GridProgram.h"

#include "base/Hash.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/scenefile/BoxFields.h"
#include "toolkit/json/JsonFile.h"
#include "toolkit/json/JsonReader.h"
#include "toolkit/program/Console.h"
#include "tools/bake/BakeScene.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace filament_core::bake {
namespace {

void readNamedBox(tools::JsonReader& reader, IrradianceGridDesc& box) {
    scenefile::readBox(reader, box);
    reader.read("name", box.name);
    const bool isName = !box.name.empty() && box.name.size() <= 64 && std::ranges::all_of(box.name, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    });
    if (!isName) reader.complain("name", "expected 1 to 64 letters, digits, - and _: it names the file");
}

tools::Json listOf(float3 v) { return { v.x, v.y, v.z }; }

tools::Json reportOf(BakedGrid const& baked) {
    GridReport const& report = baked.report;
    GridJudgement const& judgement = report.judgement;
    const uint3 count = baked.grid.probes->count;
    float largest = 0;
    for (Leak const& leak : report.leaks.found) largest = std::max(largest, leak.share);
    return {
        { "name", baked.grid.name },
        { "probes", { count.x, count.y, count.z } },
        { "inside", report.inside },
        { "mean", report.mean },
        { "standardError", report.standardError },
        { "refinement",
          { { "grids", report.rounds },
            { "isWithinBound", report.isWithinBound },
            { "points", report.heldOutPoints },
            { "error", report.heldOutError },
            { "noise", report.heldOutNoise } } },
        { "judged",
          { { "points", judgement.points },
            { "inside", judgement.inside },
            { "dark", judgement.dark },
            { "share", kBoundShare },
            { "confidence", kBoundConfidence },
            { "interpolation", judgement.interpolation ? tools::Json(*judgement.interpolation) : tools::Json() },
            { "rms", judgement.rms },
            { "worst", judgement.worst },
            { "worstPlace", listOf(judgement.worstPlace) } } },
        { "leaks",
          { { "points", report.leaks.points }, { "found", report.leaks.found.size() }, { "largestShare", largest } } },
        { "rays", report.rays }
    };
}

} // namespace

Result<GridSettings> readGridSettings(std::filesystem::path const& file) {
    const Result<tools::Json> json = tools::readJson(file);
    if (!json) return json.error();
    if (!json->is_object()) return fail(ErrorCode::InvalidArgument, "{}: expected an object", file.string());
    GridSettings settings;
    settings.box.name = "grid";
    tools::JsonReader reader(*json, file.filename().string());
    readNamedBox(reader, settings.box);
    reader.read("spacing", settings.spacingMeters, 1e-6, 1e6);
    reader.read("maxProbes", settings.maxProbes, 1, IrradianceProbes::kMaxProbes);
    reader.read("maxError", settings.maxError, 0, 1e6);
    reader.read("heldOut", settings.heldOutPoints, 1, 65536);
    reader.read("judged", settings.judgedPoints, 0, 65536);
    reader.read("paths", settings.probes.rays, 1, 1u << 24);
    reader.read("depthSize", settings.probes.depthSize, 0, IrradianceProbes::kMaxDepthSize);
    reader.read("maxBounces", settings.probes.maxBounces, 1, 4096);
    reader.read("seed", settings.probes.seed, 0, ~0u);
    reader.read("leakPoints", settings.leakPointsPerSide, 0, 16);
    if (const Result<void> done = reader.finish(); !done) return done.error();
    return settings;
}

Result<GridInput> readGridInput(Options const& options, jobs::JobSystem& jobs, std::vector<std::string>& warnings) {
    Result<GridSettings> settings = readGridSettings(options.grid);
    if (!settings) return settings.error();
    settings->probes.exposure = double(options.light.exposure.factor());
    if (const Result<void> valid = checkGridSettings(*settings); !valid) return valid.error();
    const Result<std::vector<std::byte>> file = assets::readFileBytes(options.grid);
    if (!file) return file.error();
    GridInput input{ .settings = std::move(*settings) };
    Result<reference::TracedScenePtr> scene = traceScene(options, jobs, warnings, input.hash);
    if (!scene) return scene.error();
    input.scene = std::move(*scene);
    input.hash = hashBytes(*file, input.hash);
    return input;
}

Result<void> writeGrid(BakedGrid const& baked, std::filesystem::path const& folder) {
    const std::filesystem::path path = folder / (baked.grid.name + ".grid");
    if (Result<void> done = assets::replaceFile(path, writeIrradianceGrid(baked.grid)); !done) return done;
    if (auto done = tools::writeJson(folder / (baked.grid.name + "-report.json"), reportOf(baked)); !done) return done;
    if (baked.report.mean <= 0 && baked.report.inside < baked.grid.probes->probes.size())
        tools::printWarning("no light reaches a probe; give --environment or --sun, or a model with lights");
    if (baked.report.inside == baked.grid.probes->probes.size())
        tools::printWarning("all probes are inside of geometry, and light nothing; move the box, or give a smaller "
                            "spacing");
    std::printf("%s: %s", path.c_str(), describe(baked).c_str());
    return {};
}

} // namespace filament_core::bake
