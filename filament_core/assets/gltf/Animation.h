// SPDX-License-Identifier: Apache-2.0
/// Animation: keys over time as plain values, and what lies between them (glTF 2.0, section 3.11 and appendix C).
///   Thread  plain values; the functions are pure.
///   Times   seconds. Before the first key the first counts, behind the last one the last. At a key the result is the
///           key, to the bit.
///   Fails   never: the loader has proven the counts, and that times grow.
#pragma once

#include "base/math/Math.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace filament::assets {

enum class Interpolation : uint8_t { Step, Linear, CubicSpline };
enum class AnimationPath : uint8_t { Translation, Rotation, Scale, Weights };

struct AnimationSampler {
    Interpolation interpolation = Interpolation::Linear;
    bool isRotation = false; ///< linear goes along the sphere, cubic ends on it
    uint32_t width = 1;      ///< numbers a key
    std::vector<float> times;
    std::vector<float> values; ///< width a key; cubic: in-tangent, value, out-tangent, each of `width`
};

struct AnimationChannel {
    uint32_t sampler = 0;
    uint32_t node = 0; ///< into ModelData::nodes
    AnimationPath path = AnimationPath::Translation;
};

struct AnimationData {
    std::string name;
    double durationSeconds = 0; ///< the last key of all channels
    std::vector<AnimationSampler> samplers;
    std::vector<AnimationChannel> channels;
};

/// out.size() == sampler.width. A time that is not a number counts as 0.
void sampleAnimation(AnimationSampler const& sampler, double seconds, std::span<double> out);

} // namespace filament::assets
