// SPDX-License-Identifier: Apache-2.0
/// TextureStreamer: which mip levels of the textures of models are on the device (<filament_core/TextureStreaming.h>).
///   In      models that were loaded for it, and after each frame which levels its views needed.
///   Out     between frames, textures with the chosen mip levels replace the old ones in the bindings of material
///           instances.
///   Choice  each texture begins with its coarsest levels. The one with the largest error in pixels gets the next finer
///           level, as long as the budget has room and a view needs it; of equal ones the first. What is left of the
///           budget keeps finer levels of what was in view most recently. A view needs what it needed in one of the
///           last kHeldFrames frames, so that several views a frame are counted together.
///   Order   requests begin and end in the order of the choice: with wait() after each frame no result depends on how
///           long files take. A request begins only if the budget has room for what it adds, so that none waits for
///           another one's end.
///   Device  a texture cannot change its levels: another one takes its place in the instances, with the next frame, and
///           the old one is destroyed with the frame after, which no longer binds it.
///   Thread  the app thread; decoding by background jobs, which read the store of their model alone.
///   Memory  about 300 bytes a texture, its coarsest levels and the files; decoded textures on their way.
///   Fails   as the public header says. beginFrame() and note() throw std::bad_alloc, which leaves the frame out.
#pragma once

#include "filament_core/assets/gltf/GltfImageStore.h"
#include "filament_core/engine/EngineImpl.h"
#include "filament_core/engine/SharedBytes.h"
#include "filament_core/prepare/NeededLevels.h"

#include <filament_core/TextureStreaming.h>

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace filament_core::engine {

using ImageStore = std::shared_ptr<const assets::GltfImageStore>;

class TextureStreamer {
public:
    static constexpr uint32_t kHeldFrames = 8;

    explicit TextureStreamer(Engine::Impl& engine) : mEngine(engine) {}
    ~TextureStreamer();

    // ---------------------------------------------------------------- what there is

    /// A texture of the device that begins with the coarsest level of `slot`; `bytes`: its texels.
    void add(Texture texture, ImageStore const& store, uint32_t slot, SharedBytes const& bytes);
    /// The map of an instance that shows `texture`, if that is streamed.
    void addMap(MaterialInstance instance, std::string const& parameter, std::string const& matrix, Texture texture,
                uint32_t uvSet);
    void addMesh(backend::BufferHandle vertices, scene::UvDensity const& density);
    /// A copy of an instance shows what the instance shows.
    void addClone(uint32_t source, uint32_t copy);

    // ---------------------------------------------------------------- frames

    /// Before a frame is prepared.
    void beginFrame();
    void note(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene, prepare::FramePacket const& packet);
    /// Whether frames may still change.
    bool wait();

    TextureStreaming options{};
    TextureResidency residency() const;
    std::string explain() const;

private:
    /// A texture on its way from its file.
    struct Load {
        uint32_t level = 0;
        std::mutex mutex;
        std::condition_variable ended;
        bool hasEnded = false; ///< by `mutex`, and then what follows
        std::optional<assets::Image> image;
        std::string error;

        bool isDone();
        void wait();
    };

    struct Stream {
        Texture texture; ///< none: its model is gone
        ImageStore store;
        uint32_t slot = 0;
        SharedBytes coarse; ///< texels of the coarsest levels
        backend::Format format{};
        uint2 size{}; ///< of level 0
        uint32_t coarsest = 0, resident = 0, target = 0;
        float lod = 0;         ///< that frames need; infinity: none
        uint32_t unseen = ~0u; ///< frames since one needed `lod` or less
        uint64_t lastSeen = 0; ///< the frame that needed it last
        std::shared_ptr<Load> load;
        bool hasFailed = false; ///< its file cannot be decoded any more

        uint32_t wanted() const;
        double errorPixels(uint32_t level) const;
        uint64_t bytes(uint32_t level) const;
    };

    void dropDead();
    void choose();
    void evict();
    void request();
    void takeFinished();
    void replace(uint32_t at, uint32_t level, SharedBytes const& texels);
    void start(Stream& stream);
    uint64_t residentBytes() const;
    uint64_t budgetBytes() const { return uint64_t{ options.budgetMegabytes } << 20; }
    uint64_t uploadBytes() const { return uint64_t{ options.uploadMegabytes } << 20; }

    Engine::Impl& mEngine;
    std::vector<Stream> mStreams; ///< parallel to mKnown.textures
    prepare::StreamedTextures mKnown;
    /// Of choose(): the next finer level of a texture.
    struct Step {
        float error = 0; ///< logarithm of base 2 of the pixels that a texel covers
        uint32_t at = 0;
        auto operator<=>(Step const& other) const {
            return error != other.error ? error <=> other.error : std::partial_ordering(other.at <=> at);
        }
        bool operator==(Step const&) const = default;
    };
    std::vector<Step> mSteps;
    std::vector<uint32_t> mKept;
    std::vector<uint32_t> mQueue;                  ///< streams with a load, in the order of their requests
    std::vector<uint32_t> mOrder;                  ///< of the last choice: the largest error first
    std::vector<backend::TextureHandle> mOutgoing; ///< replaced, and no longer bound by the next frame
    uint64_t mFrame = 0;
    bool mHasNeeds = false;
};

} // namespace filament_core::engine
