// SPDX-License-Identifier: Apache-2.0
#include "tools/filament-render/Options.h"

#include <CLI/CLI.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace filament::tools {
namespace {

constexpr uint32_t kMaxSide = 16384;
constexpr uint32_t kMaxFrames = 1'000'000;

/// The command line as words: CLI11 sorts them out, the conversions below explain what is wrong with them.
struct Words {
    std::string model, environment, backend, size, frames, fov, iblIntensity, skybox, toneMapper, dither, tolerance,
            out, format, requireDevice;
    std::vector<std::string> eye, at, exposure, sun;
};

Error invalid(const char* option, std::string const& value, const char* cure) {
    return fail(ErrorCode::InvalidArgument, "{}: '{}' is not possible; give {}", option, value, cure);
}

std::optional<double> finiteNumber(std::string const& word) {
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) return {};
    return value;
}

std::optional<uint32_t> count(std::string const& word, uint32_t low, uint32_t high) {
    uint32_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || value < low || value > high) return {};
    return value;
}

std::string joined(std::vector<std::string> const& words) {
    std::string text;
    for (std::string const& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

/// `N` numbers that pass `accepts`; an absent option leaves `result` alone.
template <size_t N, class Accept>
Result<void> numbers(const char* option, std::vector<std::string> const& words, const char* cure,
                     std::array<double, N>& result, Accept const& accepts) {
    if (words.empty()) return {};
    for (size_t i = 0; i < N; ++i) {
        const auto value = finiteNumber(words[i]);
        if (!value) return invalid(option, joined(words), cure);
        result[i] = *value;
    }
    return accepts(result) ? Result<void>{} : invalid(option, joined(words), cure);
}

Result<void> convertSwitch(const char* option, std::string const& word, bool& result) {
    if (word.empty()) return {};
    if (word != "on" && word != "off") return invalid(option, word, "on or off");
    result = word == "on";
    return {};
}

Result<void> convertChoices(Words const& words, Options& options) {
    if (words.backend == "vulkan")
        options.backends = { Backend::Vulkan };
    else if (words.backend == "gles")
        options.backends = { Backend::Gles };
    else if (words.backend != "both")
        return invalid("--backend", words.backend, "vulkan, gles or both");

    const auto toneMapper = toneMapperFromName(words.toneMapper);
    if (!toneMapper) return invalid("--tone-mapper", words.toneMapper, "linear, aces, filmic or mobile");
    options.colorGrading.toneMapper = *toneMapper;

    if (words.format == "exr")
        options.format = PictureFormat::Exr;
    else if (words.format != "png")
        return invalid("--format", words.format, "png or exr");

    if (auto done = convertSwitch("--skybox", words.skybox, options.skybox); !done) return done;
    return convertSwitch("--dither", words.dither, options.colorGrading.dither);
}

Result<void> convertCounts(Words const& words, Options& options) {
    const size_t cross = words.size.find('x');
    const auto width = count(words.size.substr(0, cross), 1, kMaxSide);
    const auto height = cross == std::string::npos ? std::nullopt : count(words.size.substr(cross + 1), 1, kMaxSide);
    if (!width || !height) return invalid("--size", words.size, "WIDTHxHEIGHT, each from 1 to 16384 pixels");
    options.size = { *width, *height };

    const auto frames = count(words.frames, 1, kMaxFrames);
    if (!frames) return invalid("--frames", words.frames, "a whole number from 1 to 1000000");
    options.frames = *frames;

    const auto tolerance = count(words.tolerance, 0, 255);
    if (!tolerance) return invalid("--tolerance", words.tolerance, "a whole number from 0 to 255");
    options.tolerance = *tolerance;
    return {};
}

Result<void> convertCamera(Words const& words, Options& options) {
    constexpr double kFarthest = 1e12;
    const auto isNear = [](std::array<double, 3> const& p) {
        return std::abs(p[0]) <= kFarthest && std::abs(p[1]) <= kFarthest && std::abs(p[2]) <= kFarthest;
    };
    std::array eye{ options.eye.x, options.eye.y, options.eye.z }, at{ options.at.x, options.at.y, options.at.z };
    if (auto done = numbers("--eye", words.eye, "three finite coordinates up to 1e12", eye, isNear); !done) return done;
    if (auto done = numbers("--at", words.at, "three finite coordinates up to 1e12", at, isNear); !done) return done;
    if (eye == at) return fail(ErrorCode::InvalidArgument, "--eye and --at are the same point; look at another one");
    options.eye = { eye[0], eye[1], eye[2] };
    options.at = { at[0], at[1], at[2] };

    const auto fov = finiteNumber(words.fov);
    if (!fov || *fov < 0.01 || *fov > 179) return invalid("--fov", words.fov, "degrees from 0.01 to 179");
    options.fovDegrees = static_cast<float>(*fov);
    return {};
}

Result<void> convertLight(Words const& words, Options& options) {
    const auto isExposure = [](std::array<double, 3> const& v) {
        return std::all_of(v.begin(), v.end(), [](double value) { return value >= 1e-6 && value <= 1e6; });
    };
    std::array<double, 3> exposure{ options.exposure.aperture, options.exposure.shutterSeconds, options.exposure.iso };
    if (auto done = numbers("--exposure", words.exposure, "aperture, shutter seconds and ISO, each from 1e-6 to 1e6",
                            exposure, isExposure);
        !done) {
        return done;
    }
    options.exposure = { static_cast<float>(exposure[0]), static_cast<float>(exposure[1]),
                         static_cast<float>(exposure[2]) };

    const auto lux = finiteNumber(words.iblIntensity);
    if (!lux || *lux < 0 || *lux > 1e9) return invalid("--ibl-intensity", words.iblIntensity, "lux from 0 to 1e9");
    options.iblIntensity = Lux{ static_cast<float>(*lux) };

    if (words.sun.empty()) return {};
    std::array<double, 4> sun{};
    const auto isSun = [](std::array<double, 4> const& v) {
        const double size = std::hypot(v[1], v[2], v[3]);
        return v[0] >= 0 && v[0] <= 1e9 && size >= 1e-6 && size <= 1e6;
    };
    if (auto done = numbers("--sun", words.sun, "lux from 0 to 1e9 and a direction that is not zero", sun, isSun);
        !done) {
        return done;
    }
    options.sun = SunLight{ .directionWorld = float3(double3(sun[1], sun[2], sun[3])),
                            .illuminance = Lux{ static_cast<float>(sun[0]) } };
    return {};
}

void declare(CLI::App& app, Words& words, Options& options) {
    app.set_help_flag("--help", "print this text");
    app.add_option("MODEL", words.model, ".gltf or .glb; without one the showcase is drawn")->type_name("");
    app.add_option("--environment", words.environment, "equirectangular .hdr or .exr: light and background");
    app.add_option("--backend", words.backend, "vulkan, gles or both (default)")->default_str("both");
    app.add_option("--size", words.size, "WIDTHxHEIGHT in pixels (1280x720)");
    app.add_option("--frames", words.frames, "frames to draw; the last one is saved (1)");
    app.add_flag("--fit,!--no-fit", options.fit, "centre of the bounding box at the origin, largest dimension 1 (on)");
    app.add_option("--eye", words.eye, "X Y Z of the camera (0.9 0.6 1.5)")->expected(3)->allow_extra_args(false);
    app.add_option("--at", words.at, "X Y Z that it looks at (0 0 0)")->expected(3)->allow_extra_args(false);
    app.add_option("--fov", words.fov, "vertical field of view in degrees (40)");
    app.add_option("--exposure", words.exposure, "APERTURE SHUTTER_SECONDS ISO (16 0.008 100)")
            ->expected(3)
            ->allow_extra_args(false);
    app.add_option("--ibl-intensity", words.iblIntensity, "lux of radiance 1 of the environment (30000)");
    app.add_option("--sun", words.sun, "LUX DX DY DZ: a sun and the direction in which its light travels")
            ->expected(4)
            ->allow_extra_args(false);
    app.add_option("--skybox", words.skybox, "on or off: the environment as background (on)");
    app.add_option("--tone-mapper", words.toneMapper, "linear, aces, filmic or mobile (aces)");
    app.add_option("--dither", words.dither, "on or off (off)");
    app.add_option("--tolerance", words.tolerance, "largest difference in 1/255 that still counts as equal (0)");
    app.add_option("--out", words.out, "folder for pictures and report.json (out)");
    app.add_option("--format", words.format, "png, or exr: scene-linear half floats before the tone mapper (png)");
    app.add_flag("--timing", options.timing, "print what start and frames cost");
    app.add_flag("--explain", options.explain, "print what ran, what was culled, and why");
    app.add_flag("--trace", options.trace, "write every command as text: DIR/vulkan.trace, DIR/gles.trace");
    app.add_flag("--list-devices", options.listDevices, "print the devices of every backend");
    app.add_option("--require-device", words.requireDevice, "fail unless the device's name contains this");
}

/// "-.5" as "-0.5": CLI11 would take it for a short option.
std::vector<std::string> wordsBackwards(int argc, const char* const* argv) {
    std::vector<std::string> words;
    for (int i = argc - 1; i > 0; --i) {
        std::string word = argv[i];
        if (word.starts_with("-.")) word.insert(1, "0");
        words.push_back(std::move(word));
    }
    return words;
}

} // namespace

Result<std::optional<Options>> parseOptions(int argc, const char* const* argv) {
    Options options;
    Words words{ .backend = "both",
                 .size = "1280x720",
                 .frames = "1",
                 .fov = "40",
                 .iblIntensity = "30000",
                 .toneMapper = "aces",
                 .tolerance = "0",
                 .out = "out",
                 .format = "png" };
    CLI::App app{ "Draws a glTF model with image-based light on Vulkan, OpenGL ES or both, and compares the bits.",
                  "filament-render" };
    declare(app, words, options);
    try {
        app.parse(wordsBackwards(argc, argv));
    } catch (CLI::CallForHelp const&) {
        std::fputs(app.help().c_str(), stdout);
        return std::optional<Options>{};
    } catch (CLI::Error const& error) {
        std::string what = error.what();
        std::replace(what.begin(), what.end(), '\n', ' ');
        return fail(ErrorCode::InvalidArgument, "command line: {}; 'filament-render --help' lists the options", what);
    }
    options.model = words.model;
    options.environment = words.environment;
    options.requireDevice = words.requireDevice;
    options.out = words.out;
    for (auto convert : { convertChoices, convertCounts, convertCamera, convertLight }) {
        if (const Result<void> done = convert(words, options); !done) return done.error();
    }
    if (options.out.empty()) return invalid("--out", words.out, "the path of a folder");
    return std::optional(std::move(options));
}

} // namespace filament::tools
