// SPDX-License-Identifier: Apache-2.0
/// Renderer: scene and view in, pixels out.
///   Thread  the app thread of the engine.
///   Wait    render() returns when the scene has been read and the frame is submitted; it waits only when the driver
///           thread is two frames behind. The blocking forms wait for the pixels.
///   Memory  after warm-up a frame allocates nothing from the heap.
///   Fails   a frame for which memory runs out is left out: takeErrors() says so, its target keeps the picture it had,
///           and the next frame is drawn as if it had not been tried. On a lost device everything returns at once.
#pragma once

#include <filament/Engine.h>
#include <filament/Image.h>
#include <filament/Scene.h>
#include <filament/View.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace filament {

/// Names pixels that are on their way.
struct PixelTicket {
    uint64_t value = 0;
    explicit operator bool() const { return value != 0; }
};

struct PassTiming {
    std::string name;
    double gpuMilliseconds = 0;
};

/// Of one frame; complete when the driver thread and the device are done with it.
struct FrameTimings {
    uint64_t frame = 0;
    double prepareMilliseconds = 0;             ///< app thread and workers: cull, sort, upload data
    double recordMilliseconds = 0;              ///< app thread: graph and commands
    double replayMilliseconds = 0;              ///< driver thread
    double gpuMilliseconds = 0;                 ///< device, sum of passes; 0 without RendererOptions::passTimers
    double beginSeconds = 0, submitSeconds = 0; ///< app thread, since the engine started
    double replayBeginSeconds = 0, replayEndSeconds = 0; ///< driver thread
    double workerBusyMilliseconds = 0;                   ///< all workers together, from render() to submitted
    /// With EngineOptions::hashFrames: contents of what was prepared and of the commands. They do not depend on the
    /// number of workers or on where these run.
    uint64_t packetHash = 0, streamHash = 0;
    std::vector<PassTiming> passes;
};

/// Counts of the frame rendered last.
struct FrameStatistics {
    uint64_t frame = 0;
    uint32_t renderables = 0, visible = 0, culled = 0;
    uint32_t draws = 0, triangles = 0;
    uint32_t lights = 0;
    uint32_t passesRun = 0, passesCulled = 0;
};

struct RendererOptions {
    /// Time every pass on the device (FrameTimings::passes). Costs two flushes a pass on OpenGL ES.
    bool passTimers = false;
};

class Renderer {
public:
    explicit Renderer(Engine& engine, RendererOptions const& options = {});
    Renderer(Renderer&&) noexcept;
    ~Renderer();

    /// Into the next image of a swap chain / into a render target of view.size. Returns at once.
    void render(Scene const& scene, View const& view, SwapChain swapChain);
    void render(Scene const& scene, View const& view, RenderTarget target);

    /// Makes the passes of frames like this one known to Engine::compile(), and asks for their own pipelines, without
    /// drawing: what is in the scene does not matter, its environment does.
    void expect(Scene const& scene, View const& view, SwapChain swapChain);
    void expect(Scene const& scene, View const& view, RenderTarget target);

    /// Asks for the pixels rendered last; poll takePixels(). A ticket of 0: out of memory. Pixels that never come, of
    /// an image that the device refused or on a lost device, are an image without bytes, or the error of waitPixels().
    PixelTicket readPixels(SwapChain swapChain);
    PixelTicket readPixels(RenderTarget target);
    std::optional<Image> takePixels(PixelTicket ticket);
    Result<Image> waitPixels(PixelTicket ticket);

    /// The blocking form: one frame into an image of its own. Display-referred RGBA8.
    Result<Image> renderToImage(Scene const& scene, View const& view);

    FrameStatistics statistics() const;
    std::vector<FrameTimings> takeTimings(); ///< finished frames, oldest first
    /// What the last frame ran, what it did not, and why: one decision a line.
    std::string explain() const;
    /// The frame graph of the last frame, for graphviz.
    std::string graphviz() const;

    struct Impl;

private:
    std::unique_ptr<Impl> mImpl;
};

} // namespace filament
