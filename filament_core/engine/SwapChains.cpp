// SPDX-License-Identifier: Apache-2.0
// Swap chains: rings of images, and the windows that show them.
#include "base/ApiCall.h"
#include "filament_core/engine/EngineImpl.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>

namespace filament_core {

using engine::PublicCall;

namespace {

using namespace backend;

void requireSize(uint2 size) { FILAMENT_ASSERT(size.x > 0 && size.y > 0, "a swap chain has at least one pixel"); }

void checkSystem(NativeDisplay const& display, NativeWindow window) {
    if (window.system == display.system) return;
    misused(fmt::format("a window of {} needs an engine whose EngineOptions::display is of {}, not of {}",
                        toString(window.system), toString(window.system), toString(display.system)));
}

void checkWindow(NativeDisplay const& display, SwapChainDesc const& desc) {
    if (!desc.window) return;
    checkSystem(display, desc.window);
    const bool isLinear = desc.outputSpace == OutputSpace::LinearRec709;
    FILAMENT_ASSERT(isLinear || desc.format != Format::RGBA16F,
                    "a window shows RGBA8 or RGB10A2: tone map linear light first");
    FILAMENT_ASSERT(!isLinear || desc.format == Format::RGBA16F, "a window of LinearRec709 (scRGB) shows RGBA16F");
    FILAMENT_ASSERT(desc.outputSpace != OutputSpace::Rec2020Pq || desc.format == Format::RGB10A2,
                    "a window of Rec2020Pq (HDR10) shows RGB10A2: eight bits would show bands");
    FILAMENT_ASSERT(desc.peakNits > 0 && desc.peakNits <= 10'000, "a peak is in (0, 10 000] cd/m^2");
}

/// All of them, or none.
std::vector<Texture> createImages(Engine::Impl& engine, engine::SwapChainState const& state, uint32_t count) {
    std::vector<Texture> images;
    images.reserve(count);
    try {
        for (uint32_t i = 0; i < count; ++i) {
            images.push_back(engine.createTexture({ .format = state.format,
                                                    .width = state.size.x,
                                                    .height = state.size.y,
                                                    .renderable = true,
                                                    .name = state.name }));
        }
    } catch (...) {
        for (Texture image : images) engine.destroy(image);
        throw;
    }
    return images;
}

SurfaceHandle createSurface(Engine::Impl& engine, SwapChainDesc const& desc, uint64_t gate) {
    NewHandle surface(*engine.stream, engine.stream->allocateSurface());
    engine.pending.record(CmdCreateSurface{ surface,
                                            { .window = desc.window.handle,
                                              .presentMode = desc.presentMode,
                                              .space = desc.outputSpace,
                                              .peakNits = desc.peakNits,
                                              .gate = gate,
                                              .debugName = desc.name } });
    return surface.keep();
}

} // namespace

SwapChain Engine::Impl::createSwapChain(SwapChainDesc const& desc) {
    requireSize(desc.size);
    FILAMENT_ASSERT(!formatInfo(desc.format).isSrgb,
                    "a swap chain of sRGB codes has format RGBA8: nothing samples it, so nothing decodes them");
    FILAMENT_ASSERT(desc.imageCount >= 1 && desc.imageCount <= 4, "a swap chain has 1 to 4 images");
    checkWindow(options.display, desc);
    engine::Draft draft(swapChains);
    engine::SwapChainState& state = draft.state();
    state.size = desc.size;
    state.format = desc.format;
    state.name = desc.name;
    state.images = createImages(*this, state, desc.imageCount);
    try {
        if (desc.window) {
            const NumberedGate numbered = makeWindowGate();
            state.gate = numbered.gate;
            state.surface = createSurface(*this, desc, numbered.number);
        }
    } catch (...) {
        for (Texture image : state.images) destroy(image);
        throw;
    }
    return draft.keep();
}

void Engine::Impl::resize(engine::SwapChainState& state, uint2 size) {
    requireSize(size);
    if (size == state.size) return;
    const uint2 before = std::exchange(state.size, size);
    try {
        // The new images before the old ones go: without memory the swap chain stays as it was.
        std::vector<Texture> images = createImages(*this, state, static_cast<uint32_t>(state.images.size()));
        images.swap(state.images);
        for (Texture image : images) destroy(image);
        state.current = 0;
    } catch (...) {
        state.size = before;
        throw;
    }
}

namespace {

/// Longer than a slow display takes for two images; a hidden window may take none.
constexpr std::chrono::milliseconds kLongestRefresh{ 250 };

/// The driver thread serves other windows meanwhile. False: the window takes no image now.
bool waitForWindow(engine::SwapChainState& state) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point end = Clock::now() + kLongestRefresh;
    while (!state.takesImage()) {
        if (state.isAsleep || Clock::now() > end) {
            state.isAsleep = true;
            return false;
        }
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    state.isAsleep = false;
    return true;
}

} // namespace

void Engine::Impl::present(engine::SwapChainState& state) {
    engine::TextureState const& image = textures.get(state.images[state.current]);
    if (!state.surface || !image.hasContents) return;
    auto& [older, newer] = state.presents;
    // Two presentations behind: the app stays close to what is shown, and the driver thread still has work.
    stream->waitReplayed(older);
    if (!waitForWindow(state)) return;
    ++state.submitted;
    FrameCommands commands(*stream);
    drainPending(*commands);
    commands->record(CmdPresent{ state.surface, image.handle });
    older = std::exchange(newer, stream->submissions() + 1);
}

void Engine::Impl::destroy(SwapChain swapChain) {
    if (!swapChain) return;
    engine::SwapChainState const& state = swapChains.get(swapChain);
    const SurfaceHandle surface = state.surface;
    for (Texture image : state.images) destroy(image);
    swapChains.remove(swapChain);
    if (!surface) return;
    stream->destroy(pending, surface);
    orReport("letting go of a window", {}, [&] { flush(); });
    stream->waitIdle(); // the app may close the window now
}

Result<std::vector<OutputSpace>> Engine::Impl::outputSpaces(NativeWindow window) {
    checkSystem(options.display, window);
    FILAMENT_ASSERT(window, "the window is none");
    const Ticket ticket = stream->nextTicket();
    NewHandle surface(*stream, stream->allocateSurface());
    pending.record(CmdCreateSurface{ surface, { .window = window.handle, .spaces = ticket, .debugName = "asked" } });
    stream->destroy(pending, surface.keep());
    flush();
    const Result<std::vector<std::byte>> answer = stream->waitReadback(ticket);
    if (!answer) return answer.error();
    std::vector<OutputSpace> spaces;
    for (const std::byte space : *answer) spaces.push_back(static_cast<OutputSpace>(space));
    return spaces;
}

// ---------------------------------------------------------------------------------------------- the public functions

SwapChain Engine::create(SwapChainDesc const& desc) {
    const PublicCall call(mImpl, "Engine::create(SwapChainDesc)", desc.name);
    return mImpl->orNone("swap chain", desc.name, [&] { return mImpl->createSwapChain(desc); });
}

Result<std::vector<OutputSpace>> Engine::outputSpaces(NativeWindow window) {
    const PublicCall call(mImpl, "Engine::outputSpaces(NativeWindow)");
    try {
        return mImpl->outputSpaces(window);
    } catch (std::bad_alloc const&) {
        return fail(ErrorCode::OutOfMemory, "there is no memory to ask a window for its colour spaces");
    }
}

void Engine::resize(SwapChain swapChain, uint2 size) {
    const PublicCall call(mImpl, "Engine::resize(SwapChain, uint2)");
    engine::SwapChainState& state = mImpl->swapChains.get(swapChain);
    mImpl->orReport("resizing a swap chain", state.name, [&] { mImpl->resize(state, size); });
}

} // namespace filament_core
