// SPDX-License-Identifier: Apache-2.0
/// Renderer: draws a scene as seen by a view.
///   Thread  the app thread of the engine.
///   Wait    render() returns when the scene has been read and the frame is submitted; it waits only when the driver
///           thread is two frames behind. The blocking forms wait for the pixels.
///   Memory  after warm-up a frame allocates nothing from the heap, for any scene and view.
///   Fails   without memory a frame is skipped: takeErrors() reports it, its target keeps its contents,
///           and the next frame is drawn as if it had not been tried. On a lost device everything returns at once.
#pragma once

#include <filament_core/Engine.h>
#include <filament_core/Image.h>
#include <filament_core/MeshPass.h>
#include <filament_core/Scene.h>
#include <filament_core/View.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace filament_core {

/// Refers to pixels that are being read back.
struct PixelTicket {
    uint64_t value = 0;
    explicit operator bool() const { return value != 0; }
};

/// Refers to a pending pick.
struct PickTicket {
    uint64_t value = 0;
    explicit operator bool() const { return value != 0; }
};

/// What a pixel of a view shows: the nearest surface at its centre.
struct PickHit {
    Renderable renderable{};   ///< none and no light: nothing is drawn there, and the other fields mean nothing
    Light light{};             ///< a rectangle, disc or tube that is drawn; then there is no renderable
    Node node{};               ///< that carries the renderable or the light; none: it has a place of its own
    uint32_t primitive = 0;    ///< which of the node's renderables it is, in the order in which they were added
    double distanceMeters = 0; ///< along the view
    double3 positionWorld{ 0 };
    explicit operator bool() const { return static_cast<bool>(renderable) || static_cast<bool>(light); }
};

struct PassTiming {
    std::string name;
    double gpuMilliseconds = 0;
};

/// Timings of one frame, available when the driver thread and the device have finished it.
struct FrameTimings {
    uint64_t frame = 0;
    double prepareMilliseconds = 0;             ///< app thread and workers: cull, sort, plan the passes
    double recordMilliseconds = 0;              ///< app thread and workers: upload data, record commands
    double replayMilliseconds = 0;              ///< driver thread
    double gpuMilliseconds = 0;                 ///< device, sum of passes; 0 without RendererOptions::passTimers
    double beginSeconds = 0, submitSeconds = 0; ///< app thread, since the engine started
    double replayBeginSeconds = 0, replayEndSeconds = 0; ///< driver thread
    double workerBusyMilliseconds = 0;                   ///< all workers together, from render() to submission
    /// With EngineOptions::hashFrames: hashes of the prepared data and of the commands. They do not depend on the
    /// number of workers or on the cores that these run on.
    uint64_t packetHash = 0, streamHash = 0;
    std::vector<PassTiming> passes;
};

/// Counts for the last frame.
struct FrameStatistics {
    uint64_t frame = 0;
    uint32_t renderables = 0, visible = 0, culled = 0;
    uint32_t draws = 0, triangles = 0;
    uint32_t lights = 0;
    uint32_t passesRun = 0, passesCulled = 0;
};

/// The outcome of an effect or a pass in a frame.
struct EffectDecision {
    enum class State : uint8_t { Needed, NotNeeded, Ran, Culled }; ///< the first two: effects; the others: passes

    std::string name; ///< "light list", "tone map"
    State state = State::NotNeeded;
    std::string reason;
    double gpuMilliseconds = 0;   ///< of a pass, and those merged with it, in the last timed frame; 0: unknown
    uint64_t attachmentBytes = 0; ///< of a pass: its attachments
};
constexpr const char* toString(EffectDecision::State state) {
    constexpr std::array<const char*, 4> kWords{ "needed", "not needed", "ran", "culled" };
    return kWords[static_cast<size_t>(state)];
}

struct RendererOptions {
    /// Times every pass on the device (FrameTimings::passes). Costs two flushes per pass on OpenGL ES.
    bool passTimers = false;
};

class Renderer {
public:
    explicit Renderer(Engine& engine, RendererOptions const& options = {});
    Renderer(Renderer&&) noexcept = default;
    ~Renderer();

    /// Renders into the next image of a swap chain, or into a render target; either has view.size, or contains
    /// view.viewport. A view that keeps contents is drawn into the swap chain's last image. Returns at once.
    void render(Scene const& scene, View const& view, SwapChain swapChain);
    void render(Scene const& scene, View const& view, RenderTarget target);

    /// Draws a pass of the app into a target, without a scene: a material of domain postprocess whose textures are all
    /// the app's, and whose `outputs` are the colours of the target, in the order of `color`, `others`. It may blend
    /// with what they hold. Of `view` it sees camera, timeSeconds and materialGlobals. Returns at once. A pass that
    /// cannot be drawn is left out, and takeErrors() names the material, the reason and the cure. History, statistics
    /// and explain() of views do not change.
    void render(MaterialInstance pass, RenderTarget target, View const& view = {});
    /// Draws the objects of a scene with one material into a target (MeshPass.h). Of `view` it sees camera, lod,
    /// timeSeconds, materialGlobals, visibleLayers and quality.textureFilter; its size is that of the target. Returns
    /// at once. History, statistics and explain() of views do not change.
    void render(Scene const& scene, MeshPass const& pass, RenderTarget target, View const& view = {});

    /// Shows the image that was drawn last in the window of the swap chain. Returns at once, unless two images before
    /// it have not reached the window yet: then it waits for the first of them, so that the app is never further ahead.
    /// A swap chain without a window, or without an image: no effect.
    void present(SwapChain swapChain);
    /// Whether present() would not wait: an app that has other work can do that first.
    bool canPresent(SwapChain swapChain) const;

    /// Announces the passes of such frames to Engine::compile() and requests the passes' own pipelines, without
    /// drawing. Only the scene's environment matters, not its contents.
    void prewarm(Scene const& scene, View const& view, SwapChain swapChain);
    void prewarm(Scene const& scene, View const& view, RenderTarget target);
    /// Of render() of these arguments. Of a mesh pass: for the objects that it would draw now; the depths that
    /// keepsHoles draws are those of the objects' own materials, for Engine::compile().
    void prewarm(MaterialInstance pass, RenderTarget target, View const& view = {});
    void prewarm(Scene const& scene, MeshPass const& pass, RenderTarget target, View const& view = {});

    /// Requests the pixels rendered last; poll takePixels() for them. A ticket of 0 means out of memory. If pixels
    /// never arrive, because the device refused the image or was lost, takePixels() returns an image without bytes, and
    /// waitPixels() an error, which is Timeout after 15 minutes.
    PixelTicket readPixels(SwapChain swapChain);
    PixelTicket readPixels(RenderTarget target);
    std::optional<Image> takePixels(PixelTicket ticket);
    Result<Image> waitPixels(PixelTicket ticket);

    /// Picks a pixel of the view in the current scene: bones, morph targets, holes of masked materials and
    /// layers count. Transparent objects are hit wherever their geometry is, at any alpha. Draws that one pixel of
    /// everything that may cover it, in a submission of its own; frames cost nothing for it. `pixel`: from the left and
    /// from the top of the view, below View::size. A ticket of 0 means out of memory. Up to 4096 renderables along the
    /// pixel are tried, the nearest first. docs/views.md, "Picking".
    /// Passes through nodes that are not to be hit by `aim` (Scene::setPickable()).
    PickTicket pick(Scene const& scene, View const& view, uint2 pixel, PickAim aim = PickAim::Select);
    /// None: not answered yet. A hit without a renderable also when the device was lost.
    std::optional<PickHit> takePick(PickTicket ticket);
    Result<PickHit> waitPick(PickTicket ticket);

    /// Renders one frame into its own image and waits for the pixels: display-referred RGBA8. A viewport is ignored.
    Result<Image> renderToImage(Scene const& scene, View const& view);

    FrameStatistics statistics() const;
    /// Of the frames that finished since the last call, oldest first. Among them are those whose pixels arrived, and
    /// all after Engine::waitIdle().
    std::vector<FrameTimings> takeTimings();
    /// Needed and unneeded parts of the last frame, with reasons: effects first, then passes in the order of their
    /// declaration. docs/demand.md describes the savings of unneeded effects.
    std::vector<EffectDecision> decisions() const;
    /// decisions() as a table, followed by the frame graph in words.
    std::string explain() const;
    /// The frame graph of the last frame in graphviz format.
    std::string graphviz() const;

    struct Impl;

private:
    std::shared_ptr<Impl> mImpl; ///< not shared
};

} // namespace filament_core
