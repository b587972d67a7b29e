// SPDX-License-Identifier: Apache-2.0
/// Vertices: vertex array objects, one per vertex layout, and the buffers bound to them.
///   Thread  the driver thread.
///   Memory  one GL object per distinct layout of any pipeline; layouts are few, so none is dropped.
#pragma once

#include "backend/gles/Buffer.h"

#include <memory>
#include <vector>

namespace filament_core::backend::gles {

struct VertexArray {
    struct Slot {
        GLuint buffer = 0;
        GLintptr offset = 0;
        bool operator==(Slot const&) const = default;
    };
    GLuint name = 0;
    VertexLayout layout{};
    std::array<Slot, kMaxVertexBuffers> slots{}; ///< as bound in the object
    GLuint indexBuffer = 0;                      ///< as bound in the object
};

/// What a pass has bound so far. Names are 0 if nothing usable is bound.
struct VertexSources {
    std::array<VertexArray::Slot, kMaxVertexBuffers> slots{};
    GLuint indexBuffer = 0;
    uint64_t indexOffset = 0;
    IndexFormat indexFormat = IndexFormat::UInt16;
};

/// First vertex of a draw, for devices that cannot pass it in the draw call.
struct DrawBase {
    uint32_t instance = 0;
    int32_t vertex = 0;
};

class Vertices {
public:
    explicit Vertices(Device& device) : mDevice(device) {}
    ~Vertices();

    /// Stays valid as long as this object.
    VertexArray& get(VertexLayout const& layout);
    /// Makes the object current with these buffers. False if a buffer that the layout needs is missing.
    bool bind(VertexArray& array, VertexSources const& sources, bool indexed, DrawBase base);
    /// Removes a buffer from every object, before its name is deleted.
    void forget(GLuint buffer);

private:
    void describe(VertexArray const& array);

    Device& mDevice;
    std::vector<std::unique_ptr<VertexArray>> mArrays;
};

} // namespace filament_core::backend::gles
