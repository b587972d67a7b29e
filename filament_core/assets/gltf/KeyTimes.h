// SPDX-License-Identifier: Apache-2.0
/// KeyTimes: repairs keys whose times do not grow, which glTF 2.0, section 3.11.2 requires, so that they can be played.
///   In      a sampler with as many values as its times require; both may be any floats.
///   Out     times are finite and never decrease, and each key has the values that it had. Keys with a time or a value
///           that is not finite are left out, the others are sorted; of equal times all stay, in the order of the file.
///   Why     other loaders play such files. gltfio sorts keys by time and keeps the last of equal ones (a map from
///           times to keys); three.js plays the interval that contains the time, so that equal times are a jump. Both
///           show the last of equal keys at its time. Before it this loader shows what three.js does: the way to the
///           first of them, because exporters write two keys at one time for a cut.
///   Thread  any; pure.   Cost: one pass over the times of a sampler that is in order.
#pragma once

#include "filament_core/assets/gltf/Animation.h"

#include <cstddef>
#include <span>
#include <string>

namespace filament_core::assets {

/// What was wrong with keys.
struct KeyRepairs {
    size_t endless = 0;  ///< not finite: left out
    size_t broken = 0;   ///< with values that are not finite: left out
    size_t earlier = 0;  ///< earlier than the key before
    size_t repeated = 0; ///< at the time of another key
    size_t negative = 0; ///< before 0; they stay, and act on what follows

    bool any() const { return endless + broken + earlier + repeated + negative > 0; }
    KeyRepairs& operator+=(KeyRepairs const& other);
};

/// The sampler is left without keys if none is finite.
KeyRepairs mendKeys(AnimationSampler& sampler);

/// "58 keys at the time of another (the last of them holds from there on), 2 out of order (sorted)".
std::string toString(KeyRepairs const& repairs);

/// "2, 4, 6-9" of growing numbers; at most 16 numbers and ranges, and a count of the rest.
std::string listOfNumbers(std::span<const size_t> numbers);

} // namespace filament_core::assets
