// SPDX-License-Identifier: Apache-2.0
/// TextureStreaming: of the textures of models, only the mip levels that frames need are on the device, within a budget
/// of bytes. The rest is decoded from the files again when a view needs it.
///   On       for models that are loaded with GltfLoadOptions::textureBudgetMegabytes. Without one nothing changes.
///   Needed   the level that a view chooses follows from the texture coordinates of each mesh, the transform of its
///            renderables, and the nearest point of their boxes; of what is out of view, the coarsest levels are
///            enough, and finer ones stay while the budget has room. Where it is short, the textures with the largest
///            errors on the screen come first.
///   Frames   Renderer::render() never waits for a texture: until one arrives, coarser levels are drawn. When
///            waitForTextures() was called after each frame, the images of the frames are the same on both APIs,
///            for any number of workers.
///   Image    once settled within the budget, that of whole textures: the levels are the same, and their weights may
///            be rounded differently, by less than 2^-21 (docs/texture-streaming.md).
///   Memory   the files of the textures as they are, and the coarsest levels, on the CPU. The budget counts what is on
///            the device; besides it, a frame replaces textures of at most `uploadMegabytes`, or a single larger one.
///   Life     streaming of a texture ends when its model is destroyed: copies in scenes keep the levels they have.
///   Fails    a file that cannot be decoded again, or without memory for it: the texture keeps its levels, and
///            Engine::takeErrors() gets one line.
///   Thread   the app thread of the engine. Files are decoded by background threads; without workers, by the app
///            thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace filament_core {

class Engine;

struct TextureStreaming {
    /// Of all streamed textures of an engine, in units of 2^20 bytes, [1, 2^20]. The coarsest levels are always there,
    /// even if the budget is smaller.
    uint32_t budgetMegabytes = 256;
    uint32_t uploadMegabytes = 32; ///< that one frame gives to the device, [1, 2^20], or a single larger texture
};

/// What is on the device after the last frame.
struct TextureResidency {
    uint32_t textures = 0;        ///< that are streamed
    uint32_t loading = 0;         ///< of them, how many are being decoded or wait for their frame
    uint64_t residentBytes = 0;   ///< of their levels on the device
    uint64_t neededBytes = 0;     ///< of the mip levels that recent frames sample
    uint64_t wholeBytes = 0;      ///< of all levels
    uint64_t fileBytes = 0;       ///< of their files, in memory
    float largestErrorPixels = 0; ///< a texel of the finest level that is there covers as many pixels; 1 and less: none
    std::string largestError{};   ///< the model and the number of that texture; empty if nothing is missing
    bool isSettled = true;        ///< frames like the last one change nothing any more
};

/// For all models of the engine. Loading a model with a larger GltfLoadOptions::textureBudgetMegabytes raises the
/// budget to it.
void setTextureStreaming(Engine& engine, TextureStreaming const& options);
TextureStreaming textureStreaming(Engine& engine);

TextureResidency textureResidency(Engine& engine);

/// Requests what the last frames need and waits until it is decoded. The next frame draws with it, as far as
/// `uploadMegabytes` allow. Returns whether frames may still change:
///   do renderer.render(scene, view, target); while (waitForTextures(engine));
bool waitForTextures(Engine& engine);

} // namespace filament_core
