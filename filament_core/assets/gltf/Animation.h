// SPDX-License-Identifier: Apache-2.0
/// Animation: keys over time as plain values, and interpolation between them (glTF 2.0, section 3.11 and appendix C).
///   Thread  plain values; the functions are pure.
///   Times   seconds. Times outside the range use the first or last key. At the time of a key the result is the key, to
///           the bit; of several keys at one time the last one.
///   Fails   never: the loader has checked the counts, and that times are finite and never decrease (KeyTimes.h).
#pragma once

#include "base/math/Math.h"
#include "filament_core/assets/files/NoIndex.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace filament_core::assets {

enum class Interpolation : uint8_t { Step, Linear, CubicSpline };
enum class AnimationPath : uint8_t { Translation, Rotation, Scale, Weights, Property };

struct AnimationSampler {
    Interpolation interpolation = Interpolation::Linear;
    bool isRotation = false; ///< linear interpolates along the sphere, cubic is normalised onto it
    uint32_t width = 1;      ///< numbers per key
    std::vector<float> times;
    std::vector<float> values; ///< `width` per key; cubic: in-tangent, value, out-tangent, each of `width`
};

struct AnimationChannel {
    uint32_t sampler = 0;
    uint32_t node = 0; ///< into ModelData::nodes; AnimationPath::Property: into ModelData::animatedProperties
    AnimationPath path = AnimationPath::Translation;
    uint32_t weight = kNone; ///< AnimationPath::Weights: the only one that the channel moves; kNone: all
};

struct AnimationData {
    std::string name;
    double durationSeconds = 0; ///< time of the last key of all channels
    std::vector<AnimationSampler> samplers;
    std::vector<AnimationChannel> channels;
};

/// out.size() == sampler.width. A time that is not a number counts as 0.
void sampleAnimation(AnimationSampler const& sampler, double seconds, std::span<double> out);

} // namespace filament_core::assets
