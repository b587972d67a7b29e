// SPDX-License-Identifier: Apache-2.0
/// Accessor: reads typed arrays from the buffer views of a glTF file (glTF 2.0, section 3.6.2).
///   In      any component type, interleaved or not, sparse or not, normalised or not; the data is untrusted.
///   Out     vectors of floats or of unsigned integers. Normalised integers become [0, 1] or [-1, 1] (max(c / 127, -1)
///           and so on, section 3.11); other integers keep their value. Floats that are not finite become 0, with one
///           warning, or stay as they are for a caller that repairs what they belong to.
///   Thread  any; the document is only read.
///   Memory  allocates nothing before the accessor has been checked against the bytes of its views; an accessor without
///           a view (all zeros) is limited to 2^22 elements.
///   Fails   Corrupt, naming the accessor: "accessors[7]: 24 elements end at byte 300, bufferViews[2] has 288".
#pragma once

#include "filament_core/assets/files/Diagnostics.h"
#include "filament_core/assets/gltf/GltfDocument.h"

#include <span>
#include <string_view>
#include <vector>

namespace filament_core::assets {

/// Whether the accessor has one of the component counts and lies inside its views. `use` names its purpose: "POSITION".
bool checkAccessor(GltfDocument const& document, uint32_t accessor, std::span<const uint8_t> componentCounts,
                   std::string_view use, Diagnostics& diagnostics);

/// Reads a checked accessor into `out`, which has accessor.count * accessor.components numbers.
void readFloats(GltfDocument const& document, uint32_t accessor, std::span<float> out, Diagnostics& diagnostics);
/// The same, but floats that are not finite stay as they are.
void readFloatsAsStored(GltfDocument const& document, uint32_t accessor, std::span<float> out);
void readIntegers(GltfDocument const& document, uint32_t accessor, std::span<uint32_t> out);

enum class NonFinite : uint8_t {
    BecomesZero, ///< with a warning
    IsKept,      ///< the caller repairs what it belongs to
};

/// Checks and reads vectors of floats: T is float, float2, float3, float4 or float4x4. Empty on failure and for kNone.
template <class T>
std::vector<T> readVectors(GltfDocument const& document, uint32_t accessor, std::string_view use,
                           Diagnostics& diagnostics, NonFinite nonFinite = NonFinite::BecomesZero) {
    constexpr uint8_t kComponents = sizeof(T) / sizeof(float);
    std::vector<T> values;
    if (accessor == kNone || !checkAccessor(document, accessor, { &kComponents, 1 }, use, diagnostics)) return values;
    values.resize(document.accessors[accessor].count);
    const std::span<float> numbers(reinterpret_cast<float*>(values.data()), values.size() * kComponents);
    if (nonFinite == NonFinite::IsKept)
        readFloatsAsStored(document, accessor, numbers);
    else
        readFloats(document, accessor, numbers, diagnostics);
    return values;
}

/// Checks and reads unsigned integers with `components` each.
std::vector<uint32_t> readIntegerList(GltfDocument const& document, uint32_t accessor, uint8_t components,
                                      std::string_view use, Diagnostics& diagnostics);

/// Replaces floats that are not finite by 0. Returns how many there were.
size_t replaceNonFinite(std::span<float> values);

} // namespace filament_core::assets
