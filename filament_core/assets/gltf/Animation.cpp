// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/Animation.h"

#include "filament_core/assets/gltf/NodePose.h"

#include <algorithm>
#include <cmath>

namespace filament_core::assets {
namespace {

/// The keys before and after a moment, and the position between them, in [0, 1).
struct Moment {
    size_t key = 0, next = 0;
    double fraction = 0, seconds = 0; ///< between the two keys
};

Moment momentAt(std::vector<float> const& times, double seconds) {
    if (std::isnan(seconds)) seconds = 0;
    const auto after =
            std::ranges::upper_bound(times, seconds, {}, [](float time) { return static_cast<double>(time); });
    if (after == times.begin()) return {};
    const auto key = static_cast<size_t>(after - times.begin()) - 1;
    if (after == times.end()) return { key, key };
    const double from = static_cast<double>(times[key]), length = static_cast<double>(*after) - from;
    return { key, key + 1, (seconds - from) / length, length };
}

class Keys {
public:
    explicit Keys(AnimationSampler const& sampler) : mSampler(sampler) {}

    enum Part { kIn, kValue, kOut };
    double at(size_t key, size_t i, Part part = kValue) const {
        const bool isCubic = mSampler.interpolation == Interpolation::CubicSpline;
        const size_t row = isCubic ? key * 3 + static_cast<size_t>(part) : key;
        return static_cast<double>(mSampler.values[row * mSampler.width + i]);
    }
    double4 rotation(size_t key) const { return { at(key, 0), at(key, 1), at(key, 2), at(key, 3) }; }

private:
    AnimationSampler const& mSampler;
};

// glTF 2.0, appendix C.4: the Hermite polynomials.
double cubic(Keys const& keys, Moment const& moment, size_t i) {
    const double t = moment.fraction, t2 = t * t, t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * keys.at(moment.key, i) +
           moment.seconds * (t3 - 2 * t2 + t) * keys.at(moment.key, i, Keys::kOut) +
           (3 * t2 - 2 * t3) * keys.at(moment.next, i) +
           moment.seconds * (t3 - t2) * keys.at(moment.next, i, Keys::kIn);
}

void normalize(std::span<double> quaternion) {
    double length2 = 0;
    for (const double x : quaternion) length2 += x * x;
    if (!(length2 > 1e-12)) return;
    for (double& x : quaternion) x /= std::sqrt(length2);
}

} // namespace

void sampleAnimation(AnimationSampler const& sampler, double seconds, std::span<double> out) {
    const Moment moment = momentAt(sampler.times, seconds);
    const Keys keys(sampler);
    if (moment.fraction == 0 || sampler.interpolation == Interpolation::Step) {
        for (size_t i = 0; i < out.size(); ++i) out[i] = keys.at(moment.key, i);
    } else if (sampler.interpolation == Interpolation::CubicSpline) {
        for (size_t i = 0; i < out.size(); ++i) out[i] = cubic(keys, moment, i);
        if (sampler.isRotation) normalize(out);
    } else if (sampler.isRotation) {
        const double4 rotation = slerp(keys.rotation(moment.key), keys.rotation(moment.next), moment.fraction);
        for (int i = 0; i < 4; ++i) out[static_cast<size_t>(i)] = rotation[i];
    } else {
        for (size_t i = 0; i < out.size(); ++i) {
            const double from = keys.at(moment.key, i);
            out[i] = from + (keys.at(moment.next, i) - from) * moment.fraction;
        }
    }
}

} // namespace filament_core::assets
