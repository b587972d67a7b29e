// SPDX-License-Identifier: Apache-2.0
#include "toolkit/program/SceneOptions.h"

#include "toolkit/program/CommandLine.h"
#include "toolkit/program/SceneChoices.h"

#include <filament_core/Look.h>
#include <filament_core/RenderPreset.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace filament_core::tools {
namespace {

constexpr uint32_t kMaxSide = 16384;

Result<void> convertPicture(SceneWords const& words, SceneOptions& options) {
    const auto toneMapper = enumFromName<ToneMapper>(words.toneMapper);
    if (!toneMapper) return invalidOption("--tone-mapper", words.toneMapper, listed(enumNames<ToneMapper>()));
    options.view.display.toneMapper = *toneMapper;

    if (!words.look.empty()) {
        auto look = loadLook(words.look);
        if (!look) return fail(look.error().code, "--look {}", look.error().message);
        options.view.display.look = std::move(*look);
        options.lookFile = words.look;
    }
    if (auto done = convertSwitch("--skybox", words.skybox, options.skybox); !done) return done;
    if (auto done = convertSwitch("--dither", words.dither, options.view.display.dither); !done) return done;
    if (words.out.empty()) return invalidOption("--out", words.out, "the path of a folder");
    return {};
}

Result<void> convertCamera(SceneWords const& words, SceneOptions& options) {
    constexpr double kFarthest = 1e12;
    const auto isNear = [](std::array<double, 3> const& p) {
        return std::abs(p[0]) <= kFarthest && std::abs(p[1]) <= kFarthest && std::abs(p[2]) <= kFarthest;
    };
    std::array eye{ options.eye.x, options.eye.y, options.eye.z }, at{ options.at.x, options.at.y, options.at.z };
    if (auto done = convertNumbers("--eye", words.eye, "three finite coordinates up to 1e12", eye, isNear); !done)
        return done;
    if (auto done = convertNumbers("--at", words.at, "three finite coordinates up to 1e12", at, isNear); !done)
        return done;
    if (eye == at) return fail(ErrorCode::InvalidArgument, "--eye and --at are the same point; look at another one");
    options.eye = { eye[0], eye[1], eye[2] };
    options.at = { at[0], at[1], at[2] };

    const auto fov = finiteNumber(words.fov);
    if (!fov || *fov < 0.01 || *fov > 179) return invalidOption("--fov", words.fov, "degrees from 0.01 to 179");
    options.fovDegrees = static_cast<float>(*fov);
    return {};
}

Result<void> convertLight(SceneWords const& words, SceneOptions& options) {
    const auto isExposure = [](std::array<double, 3> const& v) {
        return std::all_of(v.begin(), v.end(), [](double value) { return value >= 1e-6 && value <= 1e6; });
    };
    std::array<double, 3> exposure{ options.exposure.aperture, options.exposure.shutterSeconds, options.exposure.iso };
    if (auto done = convertNumbers("--exposure", words.exposure,
                                   "aperture, shutter seconds and ISO, each from 1e-6 to 1e6", exposure, isExposure);
        !done) {
        return done;
    }
    options.exposure = { static_cast<float>(exposure[0]), static_cast<float>(exposure[1]),
                         static_cast<float>(exposure[2]) };

    const auto lux = finiteNumber(words.iblIntensity);
    if (!lux || *lux < 0 || *lux > 1e9)
        return invalidOption("--ibl-intensity", words.iblIntensity, "lux from 0 to 1e9");
    options.iblIntensity = Lux{ static_cast<float>(*lux) };

    const auto ground = finiteNumber(words.ground);
    if (!ground || *ground < 0 || *ground > 1e4) return invalidOption("--ground", words.ground, "metres from 0 to 1e4");
    options.groundHeightMeters = static_cast<float>(*ground);

    if (words.sun.empty()) return {};
    std::array<double, 4> sun{};
    const auto isSun = [](std::array<double, 4> const& v) {
        const double size = glm::length(double3(v[1], v[2], v[3]));
        return v[0] >= 0 && v[0] <= 1e9 && size >= 1e-6 && size <= 1e6;
    };
    if (auto done =
                convertNumbers("--sun", words.sun, "lux from 0 to 1e9 and a direction that is not zero", sun, isSun);
        !done) {
        return done;
    }
    options.sun = SunLight{ .directionWorld = float3(double3(sun[1], sun[2], sun[3])),
                            .illuminance = Lux{ static_cast<float>(sun[0]) } };
    return {};
}

Result<void> convertPreset(SceneWords const& words, SceneOptions& options) {
    if (words.preset.empty()) return {};
    const auto preset = enumFromName<RenderPreset>(words.preset);
    if (!preset) return invalidOption("--preset", words.preset, listed(enumNames<RenderPreset>()));
    applyPreset(options.view, *preset);
    return {};
}

Result<void> convertQuality(SceneWords const& words, SceneOptions& options) {
    if (const Result<void> done = convertPreset(words, options); !done) return done;
    if (!words.quality.empty()) {
        const auto preset = enumFromName<QualityPreset>(words.quality);
        if (!preset) return invalidOption("--quality", words.quality, listed(enumNames<QualityPreset>()));
        options.view.quality = qualityPreset(*preset);
    }
    for (std::string const& word : words.set) {
        const size_t equals = word.find('=');
        if (equals == std::string::npos) return invalidOption("--set", word, "NAME=VALUE, see docs/quality.md");
        const std::string name = word.substr(0, equals), value = word.substr(equals + 1);
        const auto chosen = setSceneChoice(options, name, value);
        const Result<void> done = chosen ? *chosen : setOption(options.view, name, value);
        if (!done) return fail(done.error().code, "--set {}: {}", word, done.error().message);
    }
    return {};
}

} // namespace

Result<void> convertSize(std::string const& word, uint2& size) {
    const size_t cross = word.find('x');
    const auto width = wholeNumber(word.substr(0, cross), 1, kMaxSide);
    const auto height = cross == std::string::npos ? std::nullopt : wholeNumber(word.substr(cross + 1), 1, kMaxSide);
    if (!width || !height) return invalidOption("--size", word, "WIDTHxHEIGHT, each from 1 to 16384 pixels");
    size = { *width, *height };
    return {};
}

void declareSceneOptions(CommandLine& app, SceneWords& words, SceneOptions& options) {
    app.helpFlag("--help", "print this text");
    app.option("MODEL", words.model,
               ".gltf, .glb, .obj, .ply or .stl; filament-render and filament-view also draw .mat and .fmat, and "
               "filament-render a scene file (.json); without one the showcase is drawn")
            .typeName("");
    app.option("--variant", options.variant, "NAME of KHR_materials_variants (the file's own materials)");
    app.option("--environment", words.environment,
               "equirectangular .hdr or .exr, a cube map in a .ktx2, or a package that cmgen baked: light and "
               "background; or none (that of the model's file; else the showcase's sky, unless there is a --sun)");
    app.option("--size", words.size, "WIDTHxHEIGHT in pixels (1280x720)");
    app.flag("--fit,!--no-fit", options.fit, "centre of the bounding box at the origin, largest dimension 1 (on)");
    app.option("--eye", words.eye, "X Y Z of the camera (0.9 0.6 1.5)").words(3);
    app.option("--at", words.at, "X Y Z that it looks at (0 0 0)").words(3);
    app.option("--fov", words.fov, "vertical field of view in degrees (40)");
    app.option("--exposure", words.exposure, "APERTURE SHUTTER_SECONDS ISO (16 0.008 100)").words(3);
    app.option("--ibl-intensity", words.iblIntensity, "lux that radiance 1 of the environment stands for (30000)");
    app.option("--sun", words.sun, "LUX DX DY DZ: a sun and the direction in which its light travels").words(4);
    app.option("--skybox", words.skybox, "on or off: the environment as background (on)");
    app.option("--ground", words.ground,
               "METRES: the background lies on the ground under the model, so far below the panorama's camera, and "
               "shows its shadows (0: infinitely far away)");
    app.option("--tone-mapper", words.toneMapper, listed(enumNames<ToneMapper>()) + " (aces)");
    app.option("--look", words.look, "FILE.cube: a table of display values after the tone mapper");
    app.option("--dither", words.dither, "on or off (off)");
    app.option("--preset", words.preset, "fast, balanced, fine or cinematic: the whole view, effects included");
    app.option("--quality", words.quality, "low, medium, high or reference: the approximations (high)");
    app.option("--set", words.set,
               "NAME=VALUE: after --quality, one of docs/options.md: a choice of quality, an option of an effect, how "
               "files are loaded, what is shown; repeatable")
            .repeatable();
    app.option("--out", words.out, "folder for pictures and report.json (out)");
}

Result<void> convertSceneOptions(SceneWords const& words, SceneOptions& options) {
    options.model = words.model;
    options.environment = words.environment;
    options.out = words.out;
    if (Result<void> done = convertSize(words.size, options.view.size); !done) return done;
    for (auto convert : { convertPicture, convertCamera, convertLight, convertQuality }) {
        if (Result<void> done = convert(words, options); !done) return done;
    }
    return {};
}

Camera cameraOf(SceneOptions const& options) {
    return Camera::lookAt(options.eye, options.at, { .verticalFovDegrees = options.fovDegrees }, options.exposure);
}

} // namespace filament_core::tools
