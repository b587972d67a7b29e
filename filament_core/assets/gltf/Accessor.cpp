// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/Accessor.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace filament_core::assets {
namespace {

constexpr uint64_t kMaxZeroElements = uint64_t{ 1 } << 22;

template <class Component>
Component loadComponent(std::byte const* bytes) {
    Component value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

template <class Component>
float asFloat(Component value, bool normalized) {
    if constexpr (std::is_same_v<Component, float>) {
        return value;
    } else {
        if (!normalized) return static_cast<float>(value);
        constexpr auto kOne = static_cast<float>(std::numeric_limits<Component>::max());
        return std::max(static_cast<float>(value) / kOne, -1.0f);
    }
}

/// Calls visit(Component{}) with the type that `component` stands for.
template <class Visit>
void withComponentType(ComponentType component, Visit&& visit) {
    switch (component) {
    case ComponentType::Byte:
        return visit(int8_t{});
    case ComponentType::UByte:
        return visit(uint8_t{});
    case ComponentType::Short:
        return visit(int16_t{});
    case ComponentType::UShort:
        return visit(uint16_t{});
    case ComponentType::UInt:
        return visit(uint32_t{});
    case ComponentType::Float:
        return visit(float{});
    }
}

uint64_t elementBytes(GltfAccessor const& accessor) {
    return uint64_t{ componentBytes(accessor.component) } * accessor.components;
}

uint64_t strideOf(GltfDocument const& document, GltfAccessor const& accessor) {
    const uint32_t stride = accessor.view == kNone ? 0 : document.views[accessor.view].byteStride;
    return stride != 0 ? stride : elementBytes(accessor);
}

/// Whether `count` elements fit into the view. Counts are below 2^28, strides below 2^13 and offsets below 2^54.
bool fits(GltfDocument const& document, uint32_t view, uint64_t offset, uint64_t stride, uint64_t bytes, uint64_t count,
          std::string const& path, Diagnostics& diagnostics) {
    if (count == 0) return true;
    const uint64_t end = offset + stride * (count - 1) + bytes;
    const uint64_t size = document.viewBytes[view].size();
    if (end <= size) return true;
    diagnostics.refuse(ErrorCode::Corrupt, "{}: {} elements end at byte {}, bufferViews[{}] has {}", path, count, end,
                       view, size);
    return false;
}

bool checkSparse(GltfDocument const& document, GltfAccessor const& accessor, std::string const& path,
                 Diagnostics& diagnostics) {
    GltfSparse const& sparse = *accessor.sparse;
    if (sparse.count > accessor.count) {
        diagnostics.refuse(ErrorCode::Corrupt, "{}.sparse.count: {} is beyond the {} elements", path, sparse.count,
                           accessor.count);
        return false;
    }
    const uint32_t indexBytes = componentBytes(sparse.indicesType);
    const uint64_t bytes = elementBytes(accessor);
    if (!fits(document, sparse.indicesView, sparse.indicesOffset, indexBytes, indexBytes, sparse.count,
              path + ".sparse.indices", diagnostics) ||
        !fits(document, sparse.valuesView, sparse.valuesOffset, bytes, bytes, sparse.count, path + ".sparse.values",
              diagnostics)) {
        return false;
    }
    if (sparse.count == 0) return true;
    // The indices are read only now that they are known to lie within their view.
    bool isInside = true;
    withComponentType(sparse.indicesType, [&]<class Index>(Index) {
        std::byte const* indices = document.viewBytes[sparse.indicesView].data() + sparse.indicesOffset;
        for (uint64_t i = 0; i < sparse.count; ++i) {
            const Index index = loadComponent<Index>(indices + i * sizeof(Index));
            isInside =
                    isInside && index >= Index{ 0 } && static_cast<double>(index) < static_cast<double>(accessor.count);
        }
    });
    if (!isInside) diagnostics.refuse(ErrorCode::Corrupt, "{}.sparse.indices: an index is out of range", path);
    return isInside;
}

/// Calls store(index of the element's first number in the output, bytes of the element) for the base, then for the
/// sparse elements.
template <class Store>
void forEachElement(GltfDocument const& document, GltfAccessor const& accessor, Store&& store) {
    if (accessor.view != kNone && accessor.count > 0) {
        const uint64_t stride = strideOf(document, accessor);
        std::byte const* base = document.viewBytes[accessor.view].data() + accessor.byteOffset;
        for (uint64_t i = 0; i < accessor.count; ++i) store(i * accessor.components, base + i * stride);
    }
    if (!accessor.sparse || accessor.sparse->count == 0) return;
    GltfSparse const& sparse = *accessor.sparse;
    withComponentType(sparse.indicesType, [&]<class Index>(Index) {
        std::byte const* indices = document.viewBytes[sparse.indicesView].data() + sparse.indicesOffset;
        std::byte const* values = document.viewBytes[sparse.valuesView].data() + sparse.valuesOffset;
        for (uint64_t i = 0; i < sparse.count; ++i) {
            // NOLINTNEXTLINE(bugprone-signed-char-misuse): checkAccessor() has refused negative ones
            const auto index = static_cast<uint64_t>(loadComponent<Index>(indices + i * sizeof(Index)));
            store(index * accessor.components, values + i * elementBytes(accessor));
        }
    });
}

} // namespace

bool checkAccessor(GltfDocument const& document, uint32_t accessor, std::span<const uint8_t> componentCounts,
                   std::string_view use, Diagnostics& diagnostics) {
    GltfAccessor const& checked = document.accessors[accessor];
    const std::string path = fmt::format("accessors[{}]", accessor);
    if (std::find(componentCounts.begin(), componentCounts.end(), checked.components) == componentCounts.end()) {
        diagnostics.refuse(ErrorCode::Corrupt, "{}: {} components do not serve as {}", path, checked.components, use);
        return false;
    }
    if (checked.view == kNone && checked.count > kMaxZeroElements) {
        diagnostics.refuse(ErrorCode::Unsupported, "{}: {} elements without a bufferView", path, checked.count);
        return false;
    }
    if (checked.view != kNone && !fits(document, checked.view, checked.byteOffset, strideOf(document, checked),
                                       elementBytes(checked), checked.count, path, diagnostics)) {
        return false;
    }
    return !checked.sparse || checkSparse(document, checked, path, diagnostics);
}

void readFloatsAsStored(GltfDocument const& document, uint32_t accessor, std::span<float> out) {
    GltfAccessor const& source = document.accessors[accessor];
    withComponentType(source.component, [&]<class Component>(Component) {
        forEachElement(document, source, [&](uint64_t first, std::byte const* bytes) {
            for (uint32_t c = 0; c < source.components; ++c) {
                out[first + c] = asFloat(loadComponent<Component>(bytes + c * sizeof(Component)), source.normalized);
            }
        });
    });
}

void readFloats(GltfDocument const& document, uint32_t accessor, std::span<float> out, Diagnostics& diagnostics) {
    readFloatsAsStored(document, accessor, out);
    if (document.accessors[accessor].component != ComponentType::Float) return;
    if (const size_t broken = replaceNonFinite(out); broken > 0) {
        diagnostics.warn("accessors[{}]: {} numbers are not finite and became 0", accessor, broken);
    }
}

void readIntegers(GltfDocument const& document, uint32_t accessor, std::span<uint32_t> out) {
    GltfAccessor const& source = document.accessors[accessor];
    withComponentType(source.component, [&]<class Component>(Component) {
        forEachElement(document, source, [&](uint64_t first, std::byte const* bytes) {
            for (uint32_t c = 0; c < source.components; ++c) {
                // floats and negative numbers are no indices: both end up out of range for every caller
                const auto value = loadComponent<Component>(bytes + c * sizeof(Component));
                out[first + c] = std::is_same_v<Component, float> ? kNone : static_cast<uint32_t>(value);
            }
        });
    });
}

std::vector<uint32_t> readIntegerList(GltfDocument const& document, uint32_t accessor, uint8_t components,
                                      std::string_view use, Diagnostics& diagnostics) {
    std::vector<uint32_t> values;
    if (accessor == kNone || !checkAccessor(document, accessor, { &components, 1 }, use, diagnostics)) return values;
    values.resize(document.accessors[accessor].count * components);
    readIntegers(document, accessor, values);
    return values;
}

size_t replaceNonFinite(std::span<float> values) {
    size_t broken = 0;
    for (float& value : values) {
        if (std::isfinite(value)) continue;
        value = 0;
        ++broken;
    }
    return broken;
}

} // namespace filament_core::assets
