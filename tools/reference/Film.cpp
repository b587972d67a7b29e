// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/Film.h"

#include "shaders/lib/LibCppDouble.h"

#include <cmath>

namespace filament::reference {

double3 Film::variance(Pixel const& pixel) const {
    if (mPasses < 2) return double3(0.0);
    const double n = mPasses;
    const double3 spread = pixel.sumOfSquares - pixel.sum * pixel.sum / n;
    return glm::max(spread, 0.0) / (n * (n - 1));
}

// Assumes that the errors of the components are fully dependent, as for noise of the brightness; never underestimates
// the error.
void Film::measure(RenderStatistics& statistics) const {
    double luminance = 0, squares = 0;
    for (Pixel const& pixel : mPixels) {
        luminance += shader::lib64::luminance(mean(pixel));
        const double error = shader::lib64::luminance(glm::sqrt(variance(pixel)));
        squares += error * error;
    }
    const auto count = static_cast<double>(mPixels.size());
    statistics.passes = mPasses;
    statistics.meanLuminance = luminance / count;
    statistics.relativeError = luminance > 0 ? std::sqrt(squares / count) / statistics.meanLuminance : 0;
}

void Film::develop(ReferenceImage& image) const {
    image.width = mWidth;
    image.height = mHeight;
    image.color.reserve(mPixels.size());
    image.standardError.reserve(mPixels.size());
    for (Pixel const& pixel : mPixels) {
        image.color.emplace_back(mean(pixel));
        image.standardError.emplace_back(glm::sqrt(variance(pixel)));
    }
    measure(image.statistics);
}

} // namespace filament::reference
