// SPDX-License-Identifier: Apache-2.0
#include "tools/filament-render/Options.h"

#include "jobsystem/Topology.h"
#include "toolkit/program/CommandLine.h"

#include <filament_core/Sky.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace filament_core::tools {
namespace {

constexpr uint32_t kMaxFrames = 1'000'000, kMaxCopies = 100'000, kMaxWorkers = 256;

/// The options that only this program has.
struct Words {
    std::string backend = "both", frames = "1", copies = "1", tolerance = "0", format = "png", traceJobs, workers,
                affinity = "none", driverCore = "none", requireDevice, budget, costs, measureCosts, time, animation,
                saveLook, saveGltf, saveFrame, skyAltitude, aovs, shares, explainPixel, frameRate;
    std::vector<std::string> values, sky, previousEye, previousAt;
};

Result<void> convertChoices(Words const& words, Options& options) {
    if (words.backend == "vulkan")
        options.backends = { Backend::Vulkan };
    else if (words.backend == "gles")
        options.backends = { Backend::Gles };
    else if (words.backend != "both")
        return invalidOption("--backend", words.backend, "vulkan, gles or both");

    if (words.format == "exr")
        options.format = PictureFormat::Exr;
    else if (words.format == "png16")
        options.format = PictureFormat::Png16;
    else if (words.format != "png")
        return invalidOption("--format", words.format, "png, png16 or exr");
    return {};
}

Result<void> convertCounts(Words const& words, Options& options) {
    const auto frames = wholeNumber(words.frames, 1, kMaxFrames);
    if (!frames) return invalidOption("--frames", words.frames, "a whole number from 1 to 1000000");
    options.frames = *frames;

    const auto copies = wholeNumber(words.copies, 1, kMaxCopies);
    if (!copies) return invalidOption("--copies", words.copies, "a whole number from 1 to 100000");
    options.copies = *copies;

    const auto tolerance = wholeNumber(words.tolerance, 0, 255);
    if (!tolerance) return invalidOption("--tolerance", words.tolerance, "a whole number from 0 to 255");
    options.tolerance = *tolerance;
    return {};
}

/// "last" is the core that the operating system numbers last: on telephones one of the fast ones.
Result<void> convertDriverCore(Words const& words, Options& options) {
    if (words.driverCore == "none") return {};
    if (words.driverCore == "last") {
        options.driverCore = jobs::coresOfThisThread().back();
        return {};
    }
    const auto core = wholeNumber(words.driverCore, 0, 8191);
    if (!core) return invalidOption("--driver-core", words.driverCore, "none, last or the number of a core");
    options.driverCore = static_cast<int>(*core);
    return {};
}

Result<void> convertThreads(Words const& words, Options& options) {
    if (!words.workers.empty()) {
        const auto workers = wholeNumber(words.workers, 0, kMaxWorkers);
        if (!workers) return invalidOption("--workers", words.workers, "a whole number from 0 to 256");
        options.workers = static_cast<int>(*workers);
    }
    if (words.affinity == "pin")
        options.affinity = ThreadAffinity::Pin;
    else if (words.affinity == "big-cores")
        options.affinity = ThreadAffinity::BigCores;
    else if (words.affinity != "none")
        return invalidOption("--affinity", words.affinity, "none, pin or big-cores");
    return convertDriverCore(words, options);
}

Result<void> convertBudget(Words const& words, Options& options) {
    options.saveLook = words.saveLook;
    options.saveGltf = words.saveGltf;
    options.costs = words.costs;
    options.measureCosts = words.measureCosts;
    if (words.budget.empty()) return {};
    const auto budget = finiteNumber(words.budget);
    if (!budget || *budget <= 0 || *budget > 1e6)
        return invalidOption("--budget", words.budget, "milliseconds above 0, up to 1e6");
    options.budgetMilliseconds = *budget;
    return {};
}

Result<void> convertValues(Words const& words, Options& options) {
    for (std::string const& word : words.values) {
        const size_t equals = word.find('=');
        if (equals == 0 || equals == std::string::npos)
            return invalidOption("--parameter", word, "NAME=VALUE, for instance roughness=0.3 or map=brick/color");
        options.values.emplace_back(word.substr(0, equals), word.substr(equals + 1));
    }
    return {};
}

Result<void> convertAltitude(Words const& words, Options& options) {
    if (words.skyAltitude.empty()) return {};
    const auto altitude = finiteNumber(words.skyAltitude);
    if (!options.sky || !altitude || *altitude < 0 || *altitude > 50'000)
        return invalidOption("--sky-altitude", words.skyAltitude, "metres from 0 to 50000, with --sky");
    options.sky->altitudeMeters = static_cast<float>(*altitude);
    return {};
}

/// A sky takes the place of every other environment.
Result<void> convertSky(Words const& words, Options& options) {
    if (!words.sky.empty()) {
        std::array<double, 4> sky{};
        const auto isSky = [](std::array<double, 4> const& v) {
            const double size = glm::length(double3(v[1], v[2], v[3]));
            return v[0] >= 1 && v[0] <= 10 && size >= 1e-6 && size <= 1e6;
        };
        if (auto done =
                    convertNumbers("--sky", words.sky,
                                   "a turbidity from 1 to 10 and a direction to the sun that is not zero", sky, isSky);
            !done)
            return done;
        if (!options.environment.empty() && options.environment != "none")
            return invalidOption("--sky", words.sky.front(), "either a sky or an --environment");
        options.environment = "none";
        options.iblIntensity = kSkySettings.illuminance;
        options.sky = SkyDesc{ .directionToSun = float3(double3(sky[1], sky[2], sky[3])),
                               .turbidity = static_cast<float>(sky[0]) };
    }
    if (options.skyFog && !options.sky) return invalidOption("--sky-fog", "on", "a --sky, whose air it is");
    return convertAltitude(words, options);
}

Result<void> convertAovs(Words const& words, Options& options) {
    const auto all = enumNames<Aov>().subspan(1);
    for (size_t begin = 0; begin < words.aovs.size();) {
        const size_t end = std::min(words.aovs.find(',', begin), words.aovs.size());
        const std::string word = words.aovs.substr(begin, end - begin);
        const std::optional<Aov> aov = enumFromName<Aov>(word);
        if (!aov || aov == Aov::None || std::ranges::find(options.aovs, *aov) != options.aovs.end())
            return invalidOption("--aovs", word, fmt::format("{}, each once, separated by commas", listed(all)));
        options.aovs.push_back(*aov);
        begin = end + 1;
    }
    return {};
}

/// What Aov::Motion is from.
Result<void> convertPreviousFrame(Words const& words, Options& options) {
    if (!words.frameRate.empty()) {
        const auto rate = finiteNumber(words.frameRate);
        if (!rate || !(*rate > 0) || *rate > 1e4)
            return invalidOption("--frame-rate", words.frameRate, "frames per second above 0, up to 1e4");
        options.framesPerSecond = *rate;
    }
    const auto isNear = [](std::array<double, 3> const& v) {
        return std::ranges::all_of(v, [](double c) { return std::abs(c) <= 1e12; });
    };
    std::array<double, 3> eye{ options.eye.x, options.eye.y, options.eye.z };
    std::array<double, 3> at{ options.at.x, options.at.y, options.at.z };
    constexpr const char* kCure = "three finite coordinates up to 1e12";
    if (auto done = convertNumbers("--previous-eye", words.previousEye, kCure, eye, isNear); !done) return done;
    if (auto done = convertNumbers("--previous-at", words.previousAt, kCure, at, isNear); !done) return done;
    if (eye == at)
        return fail(ErrorCode::InvalidArgument,
                    "--previous-eye and --previous-at are the same point; look at another one");
    options.previousEye = { eye[0], eye[1], eye[2] };
    options.previousAt = { at[0], at[1], at[2] };
    return {};
}

Result<void> convertShares(Words const& words, Options& options) {
    options.shares = enumFromName<ShareTerms>(words.shares);
    if (!words.shares.empty() && !options.shares)
        return invalidOption("--shares", words.shares, listed(enumNames<ShareTerms>()));
    if (words.explainPixel.empty()) return {};
    const size_t comma = words.explainPixel.find(',');
    const auto number = [&](size_t begin, size_t end, uint32_t size) {
        return wholeNumber(words.explainPixel.substr(begin, end), 0, size - 1);
    };
    const uint2 size = options.view.size;
    const auto x = number(0, comma, size.x);
    const auto y = comma == std::string::npos ? std::nullopt : number(comma + 1, std::string::npos, size.y);
    if (!x || !y)
        return invalidOption("--explain-pixel", words.explainPixel,
                             fmt::format("X,Y from the left and from the top, below {},{}", size.x, size.y));
    options.explainPixel = uint2(*x, *y);
    return {};
}

Result<void> convertTime(Words const& words, Options& options) {
    options.animation = words.animation;
    if (words.time.empty()) return {};
    options.seconds = finiteNumber(words.time);
    if (!options.seconds || std::abs(*options.seconds) > 1e6)
        return invalidOption("--time", words.time, "seconds from -1e6 to 1e6");
    return {};
}

void declare(CommandLine& app, Words& words, Options& options) {
    app.option("--backend", words.backend, "vulkan, gles or both (default)").shownDefault("both");
    app.option("--sky", words.sky,
               "TURBIDITY DX DY DZ: a clear sky and its sun, computed from the air (1 to 10; 3 is clear) and the "
               "direction to the sun, in place of --environment")
            .words(4);
    app.option("--sky-altitude", words.skyAltitude, "METRES of the camera above the sea, for --sky (0)");
    app.flag("--sky-fog", options.skyFog, "fog of the air of --sky between camera and things");
    app.option("--frames", words.frames, "frames to draw; the last one is saved (1)");
    app.option("--copies", words.copies, "number of copies of the model, on a grid (1)");
    app.option("--parameter", words.values, "NAME=VALUE: a parameter or constant of a material (repeatable)");
    app.option("--time", words.time, "SECONDS: the time of the animation and of materials (0)");
    app.option("--animation", words.animation, "NAME or INDEX of the animation to pose (with --time the first)");
    app.option("--tolerance", words.tolerance, "largest difference in 1/255 that still counts as equal (0)");
    app.option("--format", words.format,
               "png; png16: ten bits a channel, stored in 16; or exr: scene-linear half floats before the tone mapper "
               "(png)");
    app.option("--aovs", words.aovs,
               fmt::format("NAMES, separated by commas: the layers of DIR/API.aovs.exr in full floats: {}",
                           listed(enumNames<Aov>().subspan(1))));
    app.option("--frame-rate", words.frameRate,
               "HZ: frames per second; motion among --aovs is from the animation 1/HZ before --time (24)");
    app.option("--previous-eye", words.previousEye,
               "X Y Z of the camera of the frame before, for motion among --aovs (as --eye)")
            .words(3);
    app.option("--previous-at", words.previousAt, "X Y Z that it looked at (as --at)").words(3);
    app.option("--shares", words.shares,
               "lights, effects or all: what each light and each effect adds to the picture before the tone mapper, as "
               "layers of DIR/API.shares.exr that add up to its bits");
    app.option("--explain-pixel", words.explainPixel,
               "X,Y: print what each light and each effect adds to this pixel, and its surface; also to "
               "DIR/API.pixel.json");
    app.option("--save-look", words.saveLook,
               "FILE.cube: write grading, tone mapper and look as a cube for other programs");
    app.option("--save-gltf", words.saveGltf, "FILE.glb or FILE.gltf: write the scene as glTF for other programs");
    app.flag("--timing", options.timing, "print the time taken by start-up and frames");
    app.flag("--explain", options.explain, "print what ran, what was culled, and why");
    app.flag("--trace", options.trace, "write every command as text to DIR/vulkan.trace and DIR/gles.trace");
    app.option("--save-frame", words.saveFrame,
               "FOLDER: save the frame with its commands for each API, for filament-replay and for bug reports");
    app.option("--trace-jobs", words.traceJobs,
               "FILE: the timeline of every thread, for chrome://tracing or tools/plot/plot.py jobs");
    app.option("--workers", words.workers, "job threads besides the app thread (one per remaining core)");
    app.option("--affinity", words.affinity, "none, pin or big-cores: where the job threads run (none)");
    app.option("--driver-core", words.driverCore,
               "none, last or a number: the core of the driver thread, which job threads avoid (none)");
    app.flag("--repin", options.repinAfterWaits, "threads with cores of their own take them again after every wait");
    app.option(
            "--budget", words.budget,
            "MS: device time per frame; chooses the quality with the least error within it, and explains the choice");
    app.option("--costs", words.costs, "FILE: the cost table for --budget (the library's own)");
    app.option("--measure-costs", words.measureCosts,
               "FILE: measure what every quality choice costs in this scene, for --costs");
    app.flag("--check-asset", options.checkAsset,
             "draw nothing; print which texels of the model's materials have values that no real material has");
    app.flag("--list-devices", options.listDevices, "print the devices of every backend");
    app.option("--require-device", words.requireDevice, "fail unless the device's name contains this");
}

/// Of a scene file --set edits keys, and the file says what the other options of a scene would.
Result<void> convertSceneFile(SceneWords& words, Words const& own, Options& options) {
    if (std::filesystem::path(words.model).extension() != ".json") return {};
    for (std::string const& word : std::exchange(words.set, {})) {
        const size_t equals = word.find('=');
        if (equals == std::string::npos) return invalidOption("--set", word, "KEY=VALUE, see docs/scene-files.md");
        options.sceneEdits.emplace_back(word.substr(0, equals), word.substr(equals + 1));
    }
    const SceneWords usual{};
    const std::pair<const char*, bool> given[] = {
        { "--environment", !words.environment.empty() },
        { "--size", words.size != usual.size },
        { "--fov", words.fov != usual.fov },
        { "--ibl-intensity", words.iblIntensity != usual.iblIntensity },
        { "--skybox", !words.skybox.empty() },
        { "--ground", words.ground != usual.ground },
        { "--look", !words.look.empty() },
        { "--dither", !words.dither.empty() },
        { "--eye", !words.eye.empty() },
        { "--at", !words.at.empty() },
        { "--exposure", !words.exposure.empty() },
        { "--sun", !words.sun.empty() },
        { "--preset", !words.preset.empty() },
        { "--quality", !words.quality.empty() },
        { "--tone-mapper", words.toneMapper != usual.toneMapper },
        { "--variant", !options.variant.empty() },
        { "--sky", !own.sky.empty() },
        { "--parameter", !own.values.empty() },
        { "--copies", own.copies != "1" },
        { "--frames", own.frames != "1" },
        { "--time", !own.time.empty() },
        { "--animation", !own.animation.empty() },
        { "--aovs", !own.aovs.empty() },
        { "--frame-rate", !own.frameRate.empty() },
        { "--previous-eye", !own.previousEye.empty() },
        { "--previous-at", !own.previousAt.empty() },
        { "--budget", !own.budget.empty() },
        { "--measure-costs", !own.measureCosts.empty() },
        { "--save-look", !own.saveLook.empty() },
        { "--save-frame", !own.saveFrame.empty() },
    };
    for (auto const& [name, isGiven] : given)
        if (isGiven)
            return fail(ErrorCode::InvalidArgument,
                        "{}: '{}' is a scene file: leave it out, or change a key of the file, as --set "
                        "camera.eye=0,1,4 does",
                        name, words.model);
    return {};
}

} // namespace

Result<std::optional<Options>> parseOptions(int argc, const char* const* argv) {
    Options options;
    SceneWords sceneWords;
    Words words;
    CommandLine app{
        "Draws a glTF model, or a material on a sphere, with image-based light on Vulkan, OpenGL ES or both, "
        "and compares the bits.",
        "filament-render"
    };
    declareSceneOptions(app, sceneWords, options);
    declare(app, words, options);
    const Result<bool> parsed = app.parse(argc, argv);
    if (!parsed) return parsed.error();
    if (!*parsed) return std::optional<Options>{};
    options.requireDevice = words.requireDevice;
    options.traceJobs = words.traceJobs;
    options.saveFrame = words.saveFrame;
    if (argc > 1) options.arguments.assign(argv + 1, argv + argc);
    if (const Result<void> done = convertSceneFile(sceneWords, words, options); !done) return done.error();
    if (const Result<void> done = convertSceneOptions(sceneWords, options); !done) return done.error();
    for (auto convert : { convertChoices, convertCounts, convertThreads, convertBudget, convertValues, convertAovs,
                          convertPreviousFrame, convertShares, convertTime, convertSky }) {
        if (const Result<void> done = convert(words, options); !done) return done.error();
    }
    return std::optional(std::move(options));
}

} // namespace filament_core::tools
