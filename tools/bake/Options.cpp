// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/Options.h"

#include "toolkit/program/CommandLine.h"
#include "toolkit/program/SceneOptions.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace filament_core::bake {
namespace {

using tools::finiteNumber;
using tools::invalidOption;
using tools::wholeNumber;

struct Words {
    std::string iblIntensity = "30000", rotation = "0", density = "16", texels, maxSize = "4096", maxPages = "16",
                levels = "4", store = "half", openness, showCharts, samples = "1024", error, maxBounces = "64",
                seed = "1", heldOut = "256", direct, shard, threads;
    std::string occlusion, occlusionDistance;
    std::string fov = "50", size = "480x272", spp = "64"; // of the report
    std::vector<std::string> sun, exposure, merge, eye, at;
};

void declare(tools::CommandLine& app, Words& words, Options& options) {
    app.option("MODEL", options.model, ".gltf or .glb").required();
    app.option("--environment", options.environment,
               "equirectangular .hdr or .exr: the sky; or none (that of the model's file)");
    app.option("--ibl-intensity", words.iblIntensity, "lux that radiance 1 of the environment stands for (30000)");
    app.option("--ibl-rotation", words.rotation, "rotation of the environment around +Y in degrees (0)");
    app.option("--sun", words.sun, "LUX DX DY DZ: a sun and the direction in which its light travels").words(4);
    app.option("--exposure", words.exposure,
               "APERTURE SHUTTER_SECONDS ISO for which glowing surfaces are authored (16 0.008 100)")
            .words(3);
    app.option("--density", words.density, "texels a metre (16)");
    app.option("--texels", words.texels,
               "N: a budget instead of a density: a coarse bake finds where the light changes, and surfaces get more "
               "texels there (16 to 1e9)");
    app.option("--max-size", words.maxSize, "largest side of a page of the lightmap in texels (4096)");
    app.option("--max-pages", words.maxPages,
               "most pages; charts go on to a further one where they do not fit (16; 1 to 256)");
    app.option(
            "--levels", words.levels,
            "mip levels of the lightmap; each needs more padding around its charts, from the fourth on twice as much "
            "(4; 1 to 6)");
    app.option("--store", words.store,
               "half (8 bytes a texel), rgb9e5 (5) or bc6h (1.5), with an error that the report states (half)");
    app.option(
            "--openness", words.openness,
            "on or off: store the part of the sky that a texel sees, which dims reflections of the environment (on)");
    app.option("--samples", words.samples, "paths a texel; with --error the maximum (1024)");
    app.option("--error", words.error, "stop at a texel when its relative standard error is below this");
    app.option(
            "--direct", words.direct,
            "on or off: light straight from lamps and the sun counts, too; the engine must then not draw them (off)");
    app.option("--occlusion", words.occlusion,
               "bake ambient occlusion and bent normals instead of light: texture, into occlusion textures; vertex, "
               "into values of the vertices")
            .typeName("texture|vertex");
    app.option("--occlusion-distance", words.occlusionDistance, "metres beyond which nothing occludes (no limit)");
    app.option("--max-bounces", words.maxBounces, "maximum number of reflections per path (64)");
    app.option("--seed", words.seed, "seed of the noise (1)");
    app.option("--held-out", words.heldOut,
               "points between the texels that are traced to judge the lightmap; fewer than 59 bound nothing (256)");
    app.option("--show-charts", words.showCharts,
               "on or off: also write charts.glb, the model with its charts, texels and levels as colours (off)");
    app.option("--grid", options.grid, "a JSON file: bake the irradiance grid that it describes instead of a lightmap")
            .typeName("FILE");
    app.option("--shard", words.shard, "bake part I of N; or auto, from the scheduler").typeName("I/N");
    app.option("--merge", words.merge,
               "do not trace: write the lightmap or the grid of parts, files or folders of them")
            .typeName("FILE...");
    app.option("--out", options.out, "folder for what is written (out)");
    app.option("--report", options.report.file,
               "write an HTML page with every error, and with images before, after and traced")
            .typeName("FILE.html");
    app.option("--eye", words.eye, "X Y Z: the camera of these images (one that sees much of what was baked)").words(3);
    app.option("--at", words.at, "X Y Z: what it looks at (the middle)").words(3);
    app.option("--fov", words.fov, "its vertical field of view in degrees (50)");
    app.option("--size", words.size, "size of these images (480x272)");
    app.option("--spp", words.spp, "paths a pixel of the traced image (64)");
    app.option("--threads", words.threads, "number of tracing threads (one per core)");
}

template <class T>
Result<void> number(const char* option, std::string const& word, double low, double high, const char* cure, T& value) {
    const auto parsed = finiteNumber(word);
    if (!parsed || *parsed < low || *parsed > high) return invalidOption(option, word, cure);
    value = static_cast<T>(*parsed);
    return {};
}

Result<void> whole(const char* option, std::string const& word, uint32_t low, uint32_t high, uint32_t& value) {
    const auto parsed = wholeNumber(word, low, high);
    if (!parsed) return invalidOption(option, word, fmt::format("a whole number from {} to {}", low, high));
    value = *parsed;
    return {};
}

Result<void> convertScene(Words const& words, Options& options) {
    if (auto done =
                number("--ibl-intensity", words.iblIntensity, 0, 1e9, "lux from 0 to 1e9", options.iblIntensity.value);
        !done)
        return done;
    if (auto done = number("--ibl-rotation", words.rotation, -360, 360, "degrees from -360 to 360",
                           options.rotationDegrees);
        !done)
        return done;
    std::array<double, 4> sun{};
    const char* const cure = "LUX DX DY DZ: a finite illuminance >= 0 and a direction that is not zero";
    const auto isSun = [](std::array<double, 4> const& s) {
        return s[0] >= 0 && s[0] <= 1e9 && (s[1] != 0 || s[2] != 0 || s[3] != 0);
    };
    if (auto done = tools::convertNumbers("--sun", words.sun, cure, sun, isSun); !done) return done;
    if (!words.sun.empty())
        options.sun = SunLight{ .directionWorld = float3(sun[1], sun[2], sun[3]),
                                .illuminance = Lux{ static_cast<float>(sun[0]) } };
    std::array<double, 3> exposure{ 16, 0.008, 100 };
    const auto isExposure = [](std::array<double, 3> const& e) {
        return e[0] > 0 && e[1] > 0 && e[2] > 0 && e[0] < 1e6 && e[1] < 1e6 && e[2] < 1e9;
    };
    if (auto done = tools::convertNumbers("--exposure", words.exposure, "three numbers above 0", exposure, isExposure);
        !done)
        return done;
    options.light.exposure = { static_cast<float>(exposure[0]), static_cast<float>(exposure[1]),
                               static_cast<float>(exposure[2]) };
    return {};
}

Result<void> convertLight(Words const& words, Options& options) {
    if (auto done = number("--density", words.density, 1e-6, 1e6, "texels a metre from 1e-6 to 1e6",
                           options.atlas.texelsPerMeter);
        !done)
        return done;
    if (!words.texels.empty()) {
        if (auto done = whole("--texels", words.texels, 16, 1'000'000'000, options.texels); !done) return done;
    }
    if (auto done = whole("--max-size", words.maxSize, 16, 16384, options.atlas.maxSide); !done) return done;
    if (auto done = whole("--max-pages", words.maxPages, 1, 256, options.atlas.maxPages); !done) return done;
    if (auto done = whole("--levels", words.levels, 1, kMostLevels, options.atlas.levels); !done) return done;
    const auto format = std::ranges::find(kLightmapFormatNames, words.store);
    if (format == kLightmapFormatNames.end()) return invalidOption("--store", words.store, "half, rgb9e5 or bc6h");
    options.storage.format = static_cast<LightmapFormat>(format - kLightmapFormatNames.begin());
    if (auto done = tools::convertSwitch("--openness", words.openness, options.storage.hasOpenness); !done) return done;
    if (auto done = tools::convertSwitch("--show-charts", words.showCharts, options.showsCharts); !done) return done;
    if (auto done = whole("--samples", words.samples, kLeastPasses, 1u << 20, options.light.samplesPerTexel); !done)
        return done;
    if (auto done = whole("--max-bounces", words.maxBounces, 1, 4096, options.light.maxBounces); !done) return done;
    if (auto done = whole("--seed", words.seed, 0, ~0u, options.light.seed); !done) return done;
    if (auto done = whole("--held-out", words.heldOut, 0, 65536, options.heldOutPoints); !done) return done;
    if (!words.error.empty()) {
        if (auto done = number("--error", words.error, 1e-6, 1, "a number from 1e-6 to 1", options.light.relativeError);
            !done)
            return done;
    }
    return tools::convertSwitch("--direct", words.direct, options.light.directLight);
}

Result<void> convertOcclusion(Words const& words, Options& options) {
    if (words.occlusion.empty()) {
        if (words.occlusionDistance.empty()) return {};
        return fail(ErrorCode::InvalidArgument, "--occlusion-distance needs --occlusion");
    }
    options.occlusionOfVertices = words.occlusion == "vertex";
    if (words.occlusion != "texture" && !options.occlusionOfVertices)
        return invalidOption("--occlusion", words.occlusion, "texture or vertex");
    if (!options.grid.empty())
        return fail(ErrorCode::InvalidArgument, "--grid bakes light; give --occlusion without it");
    if (options.storage.format != LightmapFormat::Half || !options.storage.hasOpenness || options.light.directLight)
        return fail(ErrorCode::InvalidArgument,
                    "--store, --openness and --direct are about light; give --occlusion without them");
    double meters = std::numeric_limits<double>::infinity();
    if (!words.occlusionDistance.empty()) {
        if (auto done = number("--occlusion-distance", words.occlusionDistance, 1e-6, 1e6, "metres from 1e-6 to 1e6",
                               meters);
            !done)
            return done;
    }
    options.light.occlusionMeters = meters;
    return {};
}

/// An absent place does not change `result`.
Result<void> convertPlace(const char* option, std::vector<std::string> const& words, std::optional<double3>& result) {
    std::array<double, 3> place{};
    const auto isNear = [](std::array<double, 3> const& p) {
        return std::abs(p[0]) <= 1e12 && std::abs(p[1]) <= 1e12 && std::abs(p[2]) <= 1e12;
    };
    if (auto done = tools::convertNumbers(option, words, "three finite coordinates up to 1e12", place, isNear); !done)
        return done;
    if (!words.empty()) result = double3(place[0], place[1], place[2]);
    return {};
}

Result<void> convertReport(Words const& words, Options& options) {
    ReportOptions& report = options.report;
    if (auto done = convertPlace("--eye", words.eye, report.eye); !done) return done;
    if (auto done = convertPlace("--at", words.at, report.at); !done) return done;
    if (report.eye && report.eye == report.at)
        return fail(ErrorCode::InvalidArgument, "--eye and --at are the same point; look at another one");
    if (auto done = number("--fov", words.fov, 0.01, 179, "degrees from 0.01 to 179", report.fovDegrees); !done)
        return done;
    if (auto done = tools::convertSize(words.size, report.size); !done) return done;
    return whole("--spp", words.spp, 1, 1u << 20, report.samples);
}

Result<void> convertRun(Words const& words, Options& options) {
    options.merge.assign(words.merge.begin(), words.merge.end());
    if (!words.shard.empty()) {
        if (!options.merge.empty())
            return fail(ErrorCode::InvalidArgument, "--merge traces nothing; give --shard without it");
        const Result<tools::Shard> shard = tools::parseShard(words.shard);
        if (!shard) return shard.error();
        options.shard = *shard;
    }
    if (words.threads.empty()) return {};
    uint32_t threads = 1;
    if (auto done = whole("--threads", words.threads, 1, 256, threads); !done) return done;
    options.workers = static_cast<int>(threads) - 1; // this thread works, too
    return {};
}

} // namespace

Result<std::optional<Options>> parseOptions(int argc, const char* const* argv) {
    Options options;
    Words words;
    tools::CommandLine app{ "Bakes the light of a scene that does not move into textures.", "filament-bake" };
    declare(app, words, options);
    const Result<bool> parsed = app.parse(argc, argv);
    if (!parsed) return parsed.error();
    if (!*parsed) return std::optional<Options>{};
    for (auto convert : { convertScene, convertLight, convertOcclusion, convertReport, convertRun }) {
        if (const Result<void> done = convert(words, options); !done) return done.error();
    }
    return std::optional(std::move(options));
}

} // namespace filament_core::bake
