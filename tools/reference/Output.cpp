// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/Output.h"

#include "filament_core/assets/image/ImageWriter.h"
#include "filament_core/assets/tables/DisplayColor.h"
#include "shaders/lib/LibCpp.h"
#include "toolkit/json/JsonFile.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace filament_core::reference {
namespace {

namespace lib = shader::lib;

using tools::Json;

// Like shaders/post/tonemap.mat, followed by the conversion to UNORM.
float3 ditheredColor(float3 result, bool dither, float2 pixelCenter) {
    if (dither) result += (lib::interleavedGradientNoise(pixelCenter) - 0.5f) * (1.0f / 255.0f);
    return lib::saturate(result);
}

double largestError(ReferenceImage const& image) {
    float largest = 0;
    for (float3 const& error : image.standardError) largest = std::max({ largest, error.x, error.y, error.z });
    return double(largest);
}

} // namespace

std::vector<std::byte> displayPixels(ReferenceImage const& image, DisplayTransform const& display) {
    std::vector<std::byte> pixels;
    pixels.reserve(image.color.size() * 4);
    const assets::DisplayColor displayColor(display);
    for (size_t i = 0; i < image.color.size(); ++i) {
        const float2 center(static_cast<float>(i % image.width) + 0.5f, static_cast<float>(i / image.width) + 0.5f);
        const float3 shown = ditheredColor(displayColor(image.color[i]), display.dither, center);
        for (int c = 0; c < 3; ++c) pixels.push_back(static_cast<std::byte>(std::lround(shown[c] * 255.0f)));
        pixels.push_back(std::byte{ 255 });
    }
    return pixels;
}

Result<void> writePictures(Options const& options, ReferenceImage const& image) {
    if (Result<void> written = assets::writeExr(options.out / "reference.exr", image.width, image.height, image.color,
                                                assets::ExrPrecision::Float);
        !written) {
        return written;
    }
    if (options.writesErrors) {
        if (Result<void> written = assets::writeExr(options.out / "error.exr", image.width, image.height,
                                                    image.standardError, assets::ExrPrecision::Float);
            !written) {
            return written;
        }
    }
    return assets::writePng(options.out / "reference.png", image.width, image.height,
                            displayPixels(image, options.view.display));
}

Result<void> writeReport(Options const& options, ReferenceImage const& image,
                         std::vector<std::string> const& warnings) {
    RenderStatistics const& statistics = image.statistics;
    const Json report{ { "model", options.model.string() },
                       { "environment", options.environment.string() },
                       { "size", { image.width, image.height } },
                       { "integrator", options.settings.integrator == Integrator::Path ? "path" : "unoccluded" },
                       { "seed", options.settings.seed },
                       { "samplesPerPixel", statistics.samplesPerPixel },
                       { "passes", statistics.passes },
                       { "relativeStandardError", statistics.relativeError },
                       { "largestStandardError", largestError(image) },
                       { "meanLuminance", statistics.meanLuminance },
                       { "rays", statistics.rays },
                       { "lostSamples", statistics.lostSamples },
                       { "warnings", warnings } };
    if (auto written = tools::writeJson(options.out / "report.json", report); !written) return written;
    return tools::writeJson(options.out / "times.json", { { "seconds", statistics.seconds } });
}

} // namespace filament_core::reference
