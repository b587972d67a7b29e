// SPDX-License-Identifier: Apache-2.0
/// Stage: draws a Document on one engine. Two stages given the same Document draw the same bits, whatever they drew
/// before and whichever backend they use; with history (temporal anti-aliasing, exposure, the shadow
/// maps) after forgetFrames().
///   Use     apply(document); poll(); render(target);  once a frame.
///   Loads   apply() starts them and poll() continues them: neither waits, and both stay below 16 ms of their thread
///           (tests/tools/view/app/ResponsivenessTest.cpp). What was there stays until what is new is complete, and for
///           good if that fails or is cancelled; takeMessages() then says why. Edits of a model that is not there yet
///           wait for it; lights, environment settings and the view do not.
///   Cost    apply() with an equal document compares it and does nothing else. Values change in place; lists of lights,
///           variants, and the first edit of a parameter build the scene again from what is loaded.
///   Watch   files that change on disk are loaded again.
///   Handles of the scene (nodes, renderables, lights) and of materials are valid while generation() stays.
///   Thread  the app thread of the engine: the one that calls create().
///   Fails   create(): as Engine::create(). Everything else: takeMessages(), one line each.
#pragma once

#include "tools/view/document/Document.h"

#include <filament_core/Engine.h>
#include <filament_core/ModelCopy.h>
#include <filament_core/Renderer.h>
#include <filament_core/Scene.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::view {

struct StageOptions {
    EngineOptions engine{};
    RendererOptions renderer{};
    bool watchesFiles = true;              ///< loads files again that change on disk; looks four times a second
    size_t sliceBytes = size_t{ 1 } << 20; ///< that one poll() copies to the device; LoadTicket::poll()
};

/// What is being loaded, for a progress bar. Idle: nothing.
struct StageProgress {
    bool isLoading = false;
    std::string what{};         ///< "helmet.glb, decoding"; several files: the first of model, environment, look, dirt
    size_t done = 0, total = 0; ///< of its steps; a total of 0 is not known yet
    uint32_t files = 0;         ///< how many are being loaded
};

/// What a frame has besides the document.
struct FrameExtras {
    std::optional<Viewport> viewport{};
    DebugDraw const* debugDraw = nullptr; ///< until render() returns
    Layers visibleLayers = kAllLayers;    ///< of those that the document's view shows
};

class Stage {
public:
    static Result<std::unique_ptr<Stage>> create(StageOptions const& options);
    /// On an engine that lives longer; StageOptions::engine means nothing.
    static std::unique_ptr<Stage> on(Engine& engine, StageOptions const& options = {});
    ~Stage();
    Stage(Stage const&) = delete;
    Stage& operator=(Stage const&) = delete;

    /// A document that check() refuses changes nothing and gives a message, once.
    void apply(Document const& document);
    Document const& document() const; ///< the last one that was applied and not refused

    /// Continues loads, and puts what is complete in the place of what was there. Never waits for a device or a worker.
    void poll();
    StageProgress progress() const;
    /// Waits for all loads, or until `isCancelled` is true, which is polled once a millisecond.
    void finishLoading(std::function<bool()> const& isCancelled = {});
    /// Stops loads; what is there stays, until the document names other files or reload().
    void cancel();
    /// Loads all files of the document again.
    void reload();

    void render(SwapChain swapChain, FrameExtras const& extras = {});
    void render(RenderTarget target, FrameExtras const& extras = {});
    /// Waits for the pixels: display-referred RGBA8 of the document's size.
    Result<Image> renderToImage();

    /// The next frame is drawn as a new stage would draw it: nothing is accumulated, and shadow maps find new places.
    void forgetFrames();

    /// What went wrong or needs to be known since the last call: failed loads with file and reason, edits that name
    /// what the file does not have, warnings of a loaded model, errors of the device.
    std::vector<std::string> takeMessages();
    /// Of the first model, environment, look or dirt that could not be loaded, also in takeMessages().
    std::optional<Error> const& loadError() const;

    // ---- what is drawn now, for panels and picking

    uint64_t generation() const; ///< grows when the handles below become others
    Engine& engine();
    Scene& scene();
    Renderer& renderer();
    View const& view() const; ///< as render() draws it, except for FrameExtras

    std::filesystem::path const& shownFile() const; ///< of the model that is drawn; empty: none
    Model const* model() const;                     ///< null: none, or a .mat file
    /// Null without a model. Read with it; edits belong into the Document. It lists no lights that are off.
    ModelCopy const* modelCopy() const;
    Node root() const;               ///< of the model or of the .mat file's meshes; none: nothing
    Box bounds() const;              ///< of what is drawn of it, in the world; may be larger than necessary
    std::vector<Node> nodes() const; ///< those that NodeEdit::node counts; Scene has their names and parents
    /// Of the node, or the nearest above it, among nodes(): what a pick found.
    std::optional<uint32_t> indexOf(Node node) const;
    std::vector<CopyMaterial> materials() const; ///< of the model or of the .mat file
    /// The value that a parameter has now. NotFound names what is near; Unsupported for textures and arrays.
    Result<ParameterValue> parameter(MaterialInstance instance, std::string_view parameter) const;
    /// Those that ModelLightEdit::light counts. A light that is off has no handle.
    std::vector<CopyLight> modelLights() const;
    /// As in the file, before any edit: a transform of nodes(), a light of modelLights().
    double4x4 nodeOfFile(uint32_t node) const;
    LightDesc lightOfFile(uint32_t light) const;
    /// Handles of Document::lights; none for one that is off.
    std::vector<Light> documentLights() const;
    bool hasModelEnvironment() const; ///< the model's own is what lights it
    /// What was found in the environment's file, a line each; empty if nothing was looked for.
    std::string environmentLights() const;

    struct Impl;

private:
    explicit Stage(std::unique_ptr<Impl> impl);

    std::unique_ptr<Impl> mImpl;
};

} // namespace filament_core::view
