// SPDX-License-Identifier: Apache-2.0
// cmgen: bakes an environment into NAME.ktx2, which loadEnvironment() takes in place of the image, and shows what the
// engine will look up: cube faces per mip level, spherical harmonics, the DFG table. Exit status 0: done; 1: it failed,
// or the arguments are wrong (one line on standard error).
#include "base/math/Half.h"
#include "base/math/Rgbm.h"
#include "base/math/SharedExponent.h"
#include "filament_core/assets/environment/Environment.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/image/ImageWriter.h"
#include "filament_core/assets/tables/DfgTable.h"
#include "shaders/lib/LibCpp.h"
#include "toolkit/program/CommandLine.h"
#include "toolkit/program/Program.h"

#include <filament_core/LoadOptions.h>

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <map>
#include <optional>
#include <string>

using namespace filament_core;
using namespace filament_core::assets;

namespace {

enum class PackageKind { Ktx2, Fenv };

struct Arguments {
    std::filesystem::path environment, out = ".";
    PackageKind package = PackageKind::Ktx2;
    uint32_t size = 256, samples = 512, dfgSize = 64;
    int workers = -1;
    backend::Format format = backend::Format::RGBA16F;
    RoughnessMapping mapping = RoughnessMapping::Quadratic;
    EnvironmentSun sun = EnvironmentSun::Keep;
    uint32_t lights = 1;
    bool previews = false; // .png beside .exr
    float exposure = 1;
};

// One level of a cube as a horizontal cross: the sides in a row, top and bottom above and below +z.
struct Cross {
    uint32_t size = 0; // of a face
    std::vector<float3> pixels;
    uint32_t width() const { return 4 * size; }
    uint32_t height() const { return 3 * size; }
};

constexpr std::array<uint2, 6> kCrossPlaces{ { { 2, 1 }, { 0, 1 }, { 1, 0 }, { 1, 2 }, { 1, 1 }, { 3, 1 } } };

float3 decodeTexel(const std::byte* at, backend::Format format) {
    if (format == backend::Format::RGBA16F) {
        std::array<uint16_t, 4> halves{};
        std::memcpy(halves.data(), at, sizeof(halves));
        return { floatFromHalf(halves[0]), floatFromHalf(halves[1]), floatFromHalf(halves[2]) };
    }
    uint32_t bits = 0;
    std::memcpy(&bits, at, sizeof(bits));
    if (format == backend::Format::R11G11B10F) return unpackR11G11B10F(bits);
    return format == backend::Format::RGB9E5 ? unpackRgb9E5(bits) : unpackRgbm(bits);
}

Cross crossOf(Image const& cube, uint32_t level) {
    Cross cross{ .size = std::max(1u, cube.width >> level), .pixels = {} };
    cross.pixels.resize(size_t(cross.width()) * cross.height());
    const size_t texelBytes = backend::formatInfo(cube.format).bytesPerBlock;
    const std::byte* at = cube.data.data() + cube.levelOffset(level);
    for (uint2 place : kCrossPlaces) {
        for (uint32_t y = 0; y < cross.size; ++y) {
            for (uint32_t x = 0; x < cross.size; ++x, at += texelBytes) {
                const size_t row = place.y * cross.size + y, column = place.x * cross.size + x;
                cross.pixels[row * cross.width() + column] = decodeTexel(at, cube.format);
            }
        }
    }
    return cross;
}

Result<void> writePreview(std::filesystem::path const& path, Cross const& cross, float exposure) {
    namespace lib = shader::lib;
    std::vector<std::byte> rgba;
    rgba.reserve(cross.pixels.size() * 4);
    for (float3 const& pixel : cross.pixels) {
        const float3 display = lib::srgbFromLinear(lib::toneMap(pixel * exposure, lib::kToneMapAces));
        for (const float value : { display.x, display.y, display.z }) {
            rgba.push_back(static_cast<std::byte>(value * 255.0f + 0.5f));
        }
        rgba.push_back(std::byte{ 255 });
    }
    return writePng(path, cross.width(), cross.height(), rgba);
}

Result<void> writeCube(Arguments const& arguments, Image const& cube, std::string const& name) {
    for (uint32_t level = 0; level < cube.levels; ++level) {
        const Cross cross = crossOf(cube, level);
        const std::string file = cube.levels > 1 ? fmt::format("{}-{}", name, level) : name;
        auto written = writeExr(arguments.out / (file + ".exr"), cross.width(), cross.height(), cross.pixels);
        if (written && arguments.previews)
            written = writePreview(arguments.out / (file + ".png"), cross, arguments.exposure);
        if (!written) return written;
    }
    return {};
}

Result<void> writeSh(std::filesystem::path const& path, std::array<float4, 9> const& sh) {
    static constexpr const char* kPolynomials[9] = { "1", "y", "z", "x", "xy", "yz", "3zz-1", "zx", "xx-yy" };
    std::string text = "# irradiance / pi = sum of coefficient * polynomial of the normal; red, green, blue\n";
    for (size_t i = 0; i < 9; ++i)
        text += fmt::format("{:12.8f} {:12.8f} {:12.8f}  # {}\n", sh[i].x, sh[i].y, sh[i].z, kPolynomials[i]);
    return replaceFile(path, std::as_bytes(std::span(text)));
}

Result<void> writeDfg(std::filesystem::path const& path, Image const& table) {
    std::vector<float3> pixels;
    for (size_t i = 0; i < table.data.size(); i += 8) {
        std::array<uint16_t, 3> halves{};
        std::memcpy(halves.data(), table.data.data() + i, sizeof(halves));
        pixels.emplace_back(floatFromHalf(halves[0]), floatFromHalf(halves[1]), floatFromHalf(halves[2]));
    }
    return writeExr(path, table.width, table.height, pixels);
}

void printProgress(std::string_view stage, size_t done, size_t total) {
    tools::showProgress(fmt::format("{} {}/{}", stage, done, total));
}

void printLoss(const char* name, EncodeLoss const& loss) {
    if (loss.clippedTexels == 0) return;
    std::printf("%s: %llu texels clipped, %.3g %% of the energy lost\n", name,
                static_cast<unsigned long long>(loss.clippedTexels), 100 * loss.lostEnergy);
}

std::filesystem::path packageFile(Arguments const& arguments) {
    const char* const ending = arguments.package == PackageKind::Ktx2 ? ".ktx2" : ".fenv";
    return arguments.out / (arguments.environment.stem().string() + ending);
}

Result<void> checkPackageFile(Arguments const& arguments) {
    const std::filesystem::path file = packageFile(arguments);
    std::error_code error; // one of them is missing: they are not the same
    if (!std::filesystem::equivalent(file, arguments.environment, error)) return {};
    return fail(ErrorCode::InvalidArgument, "'{}' would replace its own picture; choose another folder with --out",
                file.string());
}

Result<void> writePackage(Arguments const& arguments, EnvironmentData const& data) {
    const std::filesystem::path file = packageFile(arguments);
    return arguments.package == PackageKind::Ktx2 ? writeEnvironmentPackage(data, file)
                                                  : writeBakedEnvironment(data, file);
}

Result<void> bake(Arguments const& arguments) {
    if (Result<void> checked = checkPackageFile(arguments); !checked) return checked;
    jobs::JobSystem jobs({ .workers = arguments.workers });
    const EnvironmentOptions options{ .useCache = false,
                                      .faceSize = arguments.size,
                                      .samples = arguments.samples,
                                      .format = arguments.format,
                                      .mapping = arguments.mapping,
                                      .sun = arguments.sun,
                                      .lights = arguments.lights,
                                      .progress = printProgress };
    const auto start = std::chrono::steady_clock::now();
    const Result<EnvironmentData> data = loadEnvironment(arguments.environment, jobs, options);
    tools::clearProgress();
    if (!data) return data.error();
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;

    std::error_code error;
    std::filesystem::create_directories(arguments.out, error); // a failure shows when the first file is written
    auto done = writeCube(arguments, data->specular, "specular");
    if (done) done = writeCube(arguments, data->sky, "sky");
    if (done) done = writeCube(arguments, data->irradiance, "irradiance");
    if (done) done = writeSh(arguments.out / "sh.txt", data->irradianceSh);
    if (done) done = writePackage(arguments, *data);
    if (done) done = writeDfg(arguments.out / "dfg.exr", bakeDfgTable(jobs, arguments.dfgSize));
    if (!done) return done;
    std::printf("%u x %u -> %u levels from %u texels a face, %s in %.0f ms\n", data->statistics.sourceWidth,
                data->statistics.sourceHeight, data->specular.levels, data->specular.width,
                data->statistics.fromCache ? "read" : "baked", elapsed.count());
    std::fputs(explain(data->lights, { .illuminance = Lux{ 1 } }).c_str(), stdout);
    printLoss("specular", data->statistics.specularLoss);
    printLoss("sky", data->statistics.skyLoss);
    return {};
}

/// Empty after the help text.
Result<std::optional<Arguments>> parse(int argc, const char* const* argv) {
    Arguments arguments;
    tools::CommandLine app(
            "Bakes an equirectangular .hdr or .exr, or a cube map in a .ktx2: NAME.ktx2 for the engine, and to look at "
            "specular-N.exr, sky.exr, irradiance.exr, sh.txt, dfg.exr",
            "cmgen");
    app.option("environment", arguments.environment, "the picture").required();
    app.choice("--package", arguments.package,
               "ktx2, or fenv: the layout of the cache, which only this version of the engine reads",
               { { "ktx2", PackageKind::Ktx2 }, { "fenv", PackageKind::Fenv } });
    app.option("--size", arguments.size, "texels of a cube face, power of two in [16, 2048]").showsDefault();
    app.option("--samples", arguments.samples, "approximate number of sky pieces that each texel integrates")
            .showsDefault();
    app.choice("--format", arguments.format, "rgba16f, r11g11b10f, rgb9e5 or rgbm",
               { { "rgba16f", backend::Format::RGBA16F },
                 { "r11g11b10f", backend::Format::R11G11B10F },
                 { "rgb9e5", backend::Format::RGB9E5 },
                 { "rgbm", backend::Format::RGBA8 } });
    app.choice("--mapping", arguments.mapping, "of roughness to levels: quadratic, logarithmic or linear",
               { { "quadratic", RoughnessMapping::Quadratic },
                 { "logarithmic", RoughnessMapping::Logarithmic },
                 { "linear", RoughnessMapping::Linear } });
    app.choice("--sun", arguments.sun,
               "keep, extract or fit: lights that cast shadows instead of the brightest regions",
               { { "keep", EnvironmentSun::Keep },
                 { "extract", EnvironmentSun::Extract },
                 { "fit", EnvironmentSun::Fit } });
    app.option("--lights", arguments.lights, "of --sun fit, at most").inRange(1, 4);
    app.option("--out", arguments.out, "directory for the results").showsDefault();
    app.option("--workers", arguments.workers, "threads besides the main one; -1: all cores").inRange(-1, 256);
    app.flag("--png", arguments.previews, "tone-mapped previews beside the .exr files");
    app.option("--exposure", arguments.exposure, "factor of the previews").showsDefault();
    const Result<bool> parsed = app.parse(argc, argv);
    if (!parsed) return parsed.error();
    return *parsed ? std::optional(std::move(arguments)) : std::nullopt;
}

int run(Arguments const& arguments) {
    const Result<void> done = bake(arguments);
    return done ? 0 : tools::failed(done.error());
}

} // namespace

int main(int argc, char** argv) { return tools::runProgram("cmgen", argc, argv, parse, run); }
