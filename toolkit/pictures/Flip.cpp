// SPDX-License-Identifier: Apache-2.0
#include "toolkit/pictures/Flip.h"

#include "base/Assert.h"
#include "base/math/Elementary.h"
#include "toolkit/pictures/Picture.h"

#include <filament_core/Math.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace filament_core::tools {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kPixelsPerDegree = 0.7 * 3840 / 0.7 * kPi / 180;
constexpr float kQc = 0.7f, kPc = 0.4f, kPt = 0.95f; // exponent and redistribution of colour errors, eq. 4
constexpr float kQf = 0.5f;                          // exponent of feature errors, eq. 5
constexpr double kFeatureWidth = 0.082;              // degrees

/// One or three channels, row by row.
template <class T>
struct Plane {
    int width = 0, height = 0;
    std::vector<T> at;
    Plane(int w, int h) : width(w), height(h), at(static_cast<size_t>(w) * static_cast<size_t>(h)) {}
    T& operator()(int x, int y) { return at[static_cast<size_t>(y) * width + x]; }
    // Clamps to the border.
    T const& clamped(int x, int y) const {
        x = std::clamp(x, 0, width - 1), y = std::clamp(y, 0, height - 1);
        return at[static_cast<size_t>(y) * width + x];
    }
};

// ---- colour spaces: linear Rec. 709, XYZ, the linearised L*a*b* YCxCz, L*a*b*; all relative to the white point D65

const float3x3 kXyzFromRgb{ 0.4124564f, 0.2126729f, 0.0193339f, 0.3575761f, 0.7151522f,
                            0.1191920f, 0.1804375f, 0.0721750f, 0.9503041f };
const float3 kWhitePoint = kXyzFromRgb * float3(1.0f);

float3 yccFromXyz(float3 xyz) {
    const float3 n = xyz / kWhitePoint;
    return { 116 * n.y - 16, 500 * (n.x - n.y), 200 * (n.y - n.z) };
}

float3 xyzFromYcc(float3 ycc) {
    const float y = (ycc.x + 16) / 116;
    return float3(y + ycc.y / 500, y, y - ycc.z / 200) * kWhitePoint;
}

float3 labFromXyz(float3 xyz) {
    constexpr float kDelta = 6.0f / 29;
    const auto f = [](float t) {
        return t > kDelta * kDelta * kDelta ? elementary::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0f / 29;
    };
    const float3 n = xyz / kWhitePoint;
    return { 116 * f(n.y) - 16, 500 * (f(n.x) - f(n.y)), 200 * (f(n.y) - f(n.z)) };
}

// Hunt effect: dark colours appear less colourful.
float3 hunt(float3 lab) { return { lab.x, 0.01f * lab.x * lab.y, 0.01f * lab.x * lab.z }; }

// Distance for large colour differences, eq. 3.
float hyab(float3 a, float3 b) {
    const float3 d = a - b;
    return std::abs(d.x) + std::sqrt(d.y * d.y + d.z * d.z);
}

float3 huntLabFromRgb(float3 rgb) { return hunt(labFromXyz(kXyzFromRgb * rgb)); }

Plane<float3> yccOf(Image const& image) {
    Plane<float3> plane(static_cast<int>(image.width), static_cast<int>(image.height));
    const Picture light = pictureOf(image);
    for (size_t i = 0; i < plane.at.size(); ++i)
        plane.at[i] = yccFromXyz(kXyzFromRgb * glm::clamp(light.pixels[i], float3(0.0f), float3(1.0f)));
    return plane;
}

// ---- filters

/// Weights at -radius..radius.
using Kernel = std::vector<float>;

template <class T>
Plane<T> convolve(Plane<T> const& in, Kernel const& alongX, Kernel const& alongY) {
    const auto pass = [](Plane<T> const& from, Kernel const& kernel, int dx, int dy) {
        const int radius = static_cast<int>(kernel.size() / 2);
        Plane<T> to(from.width, from.height);
        for (int y = 0; y < from.height; ++y) {
            for (int x = 0; x < from.width; ++x) {
                T sum(0);
                for (int i = -radius; i <= radius; ++i)
                    sum += kernel[i + radius] * from.clamped(x + i * dx, y + i * dy);
                to(x, y) = sum;
            }
        }
        return to;
    };
    return pass(pass(in, alongX, 1, 0), alongY, 0, 1);
}

Kernel gaussian(double scale, int radius) {
    Kernel kernel;
    for (int i = -radius; i <= radius; ++i) kernel.push_back(static_cast<float>(elementary::exp(-scale * i * i)));
    return kernel;
}

float sum(Kernel const& kernel) {
    float total = 0;
    for (const float weight : kernel) total += weight;
    return total;
}

Kernel scaled(Kernel kernel, float factor) {
    for (float& weight : kernel) weight *= factor;
    return kernel;
}

/// Contrast sensitivity of the eye, one row for each channel of YCxCz: a1 sqrt(pi / b1) exp(-pi^2 x^2 / b1) + the same
/// with a2, b2; x in degrees. Table 1.
struct Sensitivity {
    double a1, b1, a2, b2;
};
constexpr Sensitivity kSensitivity[3] = { { 1, 0.0047, 0, 1e-5 }, { 1, 0.0053, 0, 1e-5 }, { 34.1, 0.04, 13.5, 0.025 } };

Plane<float> channelOf(Plane<float3> const& in, int channel) {
    Plane<float> plane(in.width, in.height);
    for (size_t i = 0; i < in.at.size(); ++i) plane.at[i] = in.at[i][channel];
    return plane;
}

/// Each of the two Gaussians is separable; together they are normalised over the window.
Plane<float> filterChannel(Plane<float> const& in, Sensitivity const& s) {
    const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * kPi * kPi)) * kPixelsPerDegree));
    const auto kernelOf = [&](double b) {
        return gaussian(kPi * kPi / (b * kPixelsPerDegree * kPixelsPerDegree), radius);
    };
    const Kernel first = kernelOf(s.b1), second = kernelOf(s.b2);
    const double w1 = s.a1 * std::sqrt(kPi / s.b1), w2 = s.a2 * std::sqrt(kPi / s.b2);
    const double total = w1 * sum(first) * sum(first) + w2 * sum(second) * sum(second);
    Plane<float> result = convolve(in, scaled(first, static_cast<float>(w1 / total)), first);
    if (s.a2 == 0) return result;
    const Plane<float> other = convolve(in, scaled(second, static_cast<float>(w2 / total)), second);
    for (size_t i = 0; i < result.at.size(); ++i) result.at[i] += other.at[i];
    return result;
}

/// What the eye can resolve, as Hunt-adjusted L*a*b*.
Plane<float3> perceived(Plane<float3> const& ycc) {
    const float3x3 rgbFromXyz = glm::inverse(kXyzFromRgb);
    Plane<float3> result(ycc.width, ycc.height);
    for (int c = 0; c < 3; ++c) {
        const Plane<float> filtered = filterChannel(channelOf(ycc, c), kSensitivity[c]);
        for (size_t i = 0; i < result.at.size(); ++i) result.at[i][c] = filtered.at[i];
    }
    for (float3& value : result.at)
        value = huntLabFromRgb(glm::clamp(rgbFromXyz * xyzFromYcc(value), float3(0.0f), float3(1.0f)));
    return result;
}

/// Small errors take most of [0, 1]; the largest error is green against blue. Eq. 4.
float colorError(float3 a, float3 b) {
    static const float sMax = elementary::pow(hyab(huntLabFromRgb({ 0, 1, 0 }), huntLabFromRgb({ 0, 0, 1 })), kQc);
    const float error = elementary::pow(hyab(a, b), kQc), knee = kPc * sMax;
    return error < knee ? kPt / knee * error : kPt + (error - knee) / (sMax - knee) * (1 - kPt);
}

// ---- features

/// Positive weights sum to 1, negative ones to -1.
Kernel balanced(Kernel kernel) {
    float positive = 0, negative = 0;
    for (const float weight : kernel) (weight > 0 ? positive : negative) += weight;
    for (float& weight : kernel) weight /= weight > 0 ? positive : -negative;
    return kernel;
}

/// Strength of edges (x) and points (y) at each pixel: first and second derivatives of a Gaussian as wide as a feature.
Plane<float2> features(Plane<float3> const& ycc) {
    const double deviation = 0.5 * kFeatureWidth * kPixelsPerDegree;
    const int radius = static_cast<int>(std::ceil(3 * deviation));
    const Kernel bell = gaussian(1 / (2 * deviation * deviation), radius);
    const Kernel smooth = scaled(bell, 1 / sum(bell));
    Kernel edge = bell, point = bell;
    for (int i = -radius; i <= radius; ++i) {
        edge[i + radius] *= static_cast<float>(-i);
        point[i + radius] *= static_cast<float>(i * i / (deviation * deviation) - 1);
    }
    edge = balanced(edge), point = balanced(point);
    Plane<float> light = channelOf(ycc, 0);
    for (float& value : light.at) value = (value + 16) / 116;

    const Plane<float> edgeX = convolve(light, edge, smooth), edgeY = convolve(light, smooth, edge);
    const Plane<float> pointX = convolve(light, point, smooth), pointY = convolve(light, smooth, point);
    Plane<float2> result(ycc.width, ycc.height);
    for (size_t i = 0; i < result.at.size(); ++i)
        result.at[i] = { elementary::hypot(edgeX.at[i], edgeY.at[i]), elementary::hypot(pointX.at[i], pointY.at[i]) };
    return result;
}

float featureError(float2 a, float2 b) {
    const float2 difference = glm::abs(a - b);
    return elementary::pow(std::max(difference.x, difference.y) / std::sqrt(2.0f), kQf); // eq. 5
}

} // namespace

FlipError flip(Image const& reference, Image const& test) {
    FILAMENT_ASSERT(reference.width == test.width && reference.height == test.height, "pictures of one size compare");
    const Plane<float3> a = yccOf(reference), b = yccOf(test);
    const Plane<float3> colorA = perceived(a), colorB = perceived(b);
    const Plane<float2> featureA = features(a), featureB = features(b);
    FlipError result;
    for (size_t i = 0; i < a.at.size(); ++i) {
        const float ofColor = std::min(1.0f, colorError(colorA.at[i], colorB.at[i]));
        const float ofFeature = std::min(1.0f, featureError(featureA.at[i], featureB.at[i]));
        result.pixels.push_back(elementary::pow(ofColor, 1 - ofFeature)); // eq. 6
        result.mean += static_cast<double>(result.pixels.back());
    }
    if (result.pixels.empty()) return result;
    result.mean /= static_cast<double>(result.pixels.size());
    std::vector<float> sorted = result.pixels;
    const size_t rank = (sorted.size() * 99 + 99) / 100 - 1;
    std::nth_element(sorted.begin(), sorted.begin() + rank, sorted.end());
    result.p99 = static_cast<double>(sorted[rank]);
    return result;
}

} // namespace filament_core::tools
