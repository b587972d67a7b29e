// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfEnvironment.h"

#include "base/math/Rgbd.h"
#include "filament_core/assets/image/ChannelTransfer.h"
#include "filament_core/assets/image/ImageDecoder.h"
#include "filament_core/assets/image/ImageSize.h"

#include <cmath>
#include <cstring>
#include <exception>
#include <numbers>

namespace filament_core::assets {

const std::array<double, 9> kHarmonicConstants = [] {
    const double unit = 1 / std::sqrt(4 * std::numbers::pi);
    const double one = std::sqrt(3.0) * unit, two = std::sqrt(15.0) * unit, zonal = std::sqrt(5.0) / 2 * unit;
    return std::array{ unit, one, one, one, two, two, zonal, two, two / 2 };
}();

namespace {

std::array<float4, 9> irradianceOf(GltfImageBasedLight const& light) {
    std::array<float4, 9> sh{};
    for (size_t i = 0; i < sh.size(); ++i) {
        const double factor = kHarmonicConstants[i] * double{ light.intensity } / std::numbers::pi;
        sh[i] = float4(float3(light.irradiance[i] * factor), 0);
    }
    return sh;
}

/// The cube's z turned round, then the light's rotation.
float3x3 worldFromCubeOf(GltfImageBasedLight const& light) {
    const double3x3 rotation(matrixFrom({ .rotation = light.rotation }));
    return float3x3(double3x3(rotation[0], rotation[1], -rotation[2]));
}

std::string pathOf(GltfDocument const& document, GltfFaceJob const& job) {
    return fmt::format("extensions.EXT_lights_image_based.lights[{}].specularImages[{}][{}]", document.imageBasedLight,
                       job.level, job.face);
}

class FaceReader {
public:
    FaceReader(Image const& image, bool isRgbd, float intensity) : mImage(image), mIsRgbd(isRgbd), mFactor(intensity) {}

    Texel at(uint32_t x, uint32_t y) {
        uint32_t bits = 0;
        std::memcpy(&bits, &mImage.data[(size_t{ y } * mImage.width + x) * 4], sizeof(bits));
        const float3 light = glm::min((mIsRgbd ? rgbd(bits) : color(bits)) * mFactor, float3(kMaxRadiance));
        return Texel{ light.x, light.y, light.z, 0 };
    }

    uint64_t withoutAlpha() const { return mWithoutAlpha; }

private:
    float3 rgbd(uint32_t bits) {
        mWithoutAlpha += bits >> 24 == 0;
        return unpackRgbd(bits);
    }

    static float3 color(uint32_t bits) {
        const auto linear = [&](uint32_t shift) {
            return static_cast<float>(colorTransfer().linearFromCode[bits >> shift & 0xFFu]) / 65535.0f;
        };
        return { linear(0), linear(8), linear(16) };
    }

    Image const& mImage;
    bool mIsRgbd;
    float mFactor;
    uint64_t mWithoutAlpha = 0;
};

void decode(GltfDocument const& document, GltfFaceJob& job, CubeLight& light) {
    const std::string name = imageName(document, job.source.image);
    const Result<Image> image = decodeImage(job.source.bytes, name);
    if (!image)
        return job.diagnostics.refuse(image.error().code, "{}: {}", pathOf(document, job), image.error().message);
    IblCubeLevel& level = light.levels[job.level];
    const uint32_t size = level.size();
    if (image->width != size || image->height != size) // an image whose header says something else
        return job.diagnostics.refuse(ErrorCode::Corrupt,
                                      "{}: {} changes its size while it is decoded; export it again",
                                      pathOf(document, job), name);
    const float intensity = document.imageBasedLights[document.imageBasedLight].intensity;
    FaceReader reader(*image, hasAlphaPng(job.source.bytes), intensity);
    for (uint32_t y = 0; y < size; ++y) {
        for (uint32_t x = 0; x < size; ++x)
            level.at(job.face, static_cast<int>(x), static_cast<int>(size - 1 - y)) = reader.at(x, y);
    }
    if (reader.withoutAlpha() > 0)
        job.diagnostics.warn("{}: {} has {} pixels with alpha 0, which RGBD cannot divide by; they are black",
                             pathOf(document, job), name, reader.withoutAlpha());
}

} // namespace

GltfEnvironment planEnvironment(GltfDocument const& document) {
    GltfEnvironment environment;
    if (document.imageBasedLight == kNone) return environment;
    GltfImageBasedLight const& light = document.imageBasedLights[document.imageBasedLight];
    environment.light.irradianceSh = irradianceOf(light);
    environment.light.worldFromCube = worldFromCubeOf(light);
    for (uint32_t level = 0; level < light.levels.size(); ++level) {
        for (uint32_t face = 0; face < 6; ++face) {
            GltfFaceJob& job = environment.faces.emplace_back();
            job.source.image = light.levels[level][face];
            job.level = level;
            job.face = face;
        }
    }
    return environment;
}

void checkFaces(GltfDocument const& document, GltfEnvironment const& environment, Diagnostics& diagnostics) {
    if (environment.faces.empty()) return;
    const uint32_t first = document.imageBasedLights[document.imageBasedLight].size;
    for (GltfFaceJob const& job : environment.faces) {
        const uint32_t size = first >> job.level;
        const uint2 found = job.source.size;
        if (found == uint2(size)) continue;
        if (const Result<Image> image = decodeImage(job.source.bytes, imageName(document, job.source.image)); !image)
            return diagnostics.refuse(image.error().code, "{}: {}", pathOf(document, job), image.error().message);
        return diagnostics.refuse(ErrorCode::Corrupt,
                                  "{}: {} is {} x {} pixels instead of {} x {}, which level {} of specularImageSize {} "
                                  "has; export the light again",
                                  pathOf(document, job), imageName(document, job.source.image), found.x, found.y, size,
                                  size, job.level, first);
    }
}

void decodeFace(GltfDocument const& document, GltfFaceJob& job, CubeLight& light) {
    try {
        decode(document, job, light);
    } catch (std::bad_alloc const&) {
        job.diagnostics.refuse(ErrorCode::OutOfMemory, "images[{}]: out of memory; free some and try again",
                               job.source.image);
    } catch (std::exception const& exception) {
        job.diagnostics.refuse(ErrorCode::OutOfMemory, "images[{}]: {}", job.source.image, exception.what());
    }
}

std::optional<ImageBasedLightData> finishEnvironment(GltfDocument const& document, GltfEnvironment environment) {
    if (environment.faces.empty()) return std::nullopt;
    for (IblCubeLevel& level : environment.light.levels) level.fillBorder();
    return ImageBasedLightData{ document.imageBasedLights[document.imageBasedLight].name,
                                std::move(environment.light) };
}

} // namespace filament_core::assets
