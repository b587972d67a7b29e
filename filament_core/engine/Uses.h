// SPDX-License-Identifier: Apache-2.0
/// Uses: which objects of an engine something uses, by their addresses and the handles of their buffers and textures.
///   In      add...() for everything that uses something.   Out: has...(), after sort().
///   Thread  the app thread.
///   Memory  keeps what it once needed. Adding throws std::bad_alloc.
///   Cost    linear in the drawables of all scenes, and a sort; only in frames after a use ended while something is
///           retired.
#pragma once

#include "backend/api/Handles.h"
#include "filament_core/scene/SceneData.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace filament_core::engine {

class Uses {
public:
    void clear();
    void add(scene::SceneData const& scene);
    void add(scene::MaterialInstance const& instance);
    void add(backend::TextureHandle texture) {
        if (texture) mTextures.push_back(texture.bits);
    }
    void sort();

    bool hasObject(const void* object) const { return std::ranges::binary_search(mObjects, object); }
    bool has(backend::BufferHandle buffer) const { return std::ranges::binary_search(mBuffers, buffer.bits); }
    bool has(backend::TextureHandle texture) const { return std::ranges::binary_search(mTextures, texture.bits); }

private:
    std::vector<const void*> mObjects; ///< material instances and morph targets
    std::vector<uint32_t> mBuffers, mTextures;
};

} // namespace filament_core::engine
