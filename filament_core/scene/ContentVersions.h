// SPDX-License-Identifier: Apache-2.0
/// ContentVersions: how often the contents of buffers and textures changed since they were created: data drawn from
/// an older version, such as a cached shadow map, is out of date.
///   Thread  the app thread between frames; read-only while a frame is prepared.
///   Memory  4 bytes for each object up to the highest index that changed. changed() throws std::bad_alloc.
#pragma once

#include "backend/api/Handles.h"

#include <cstdint>
#include <vector>

namespace filament_core::scene {

class ContentVersions {
public:
    void changed(backend::BufferHandle buffer) { ++at(mBuffers, buffer.index()); }
    void changed(backend::TextureHandle texture) { ++at(mTextures, texture.index()); }
    uint32_t of(backend::BufferHandle buffer) const { return versionAt(mBuffers, buffer.index()); }
    uint32_t of(backend::TextureHandle texture) const { return versionAt(mTextures, texture.index()); }

private:
    static uint32_t& at(std::vector<uint32_t>& versions, uint32_t index) {
        if (index >= versions.size()) versions.resize(index + 1);
        return versions[index];
    }
    static uint32_t versionAt(std::vector<uint32_t> const& versions, uint32_t index) {
        return index < versions.size() ? versions[index] : 0;
    }

    std::vector<uint32_t> mBuffers, mTextures;
};

} // namespace filament_core::scene
